//! Options of the fairing: how they become the library's.

use core::mem::offset_of;

use super::callback::HostCallback;
use super::choices::chosen;
use super::input::{CurvatureIn, LoopsIn, NormalsIn};
use super::option_structs::fairmesh_options;
use super::status::{CallResult, Failure, fairmesh_status as Status};
use super::types::*;
use super::views::{AliasCheck, Argument, FieldPath, check_reserved, read_struct};
use fairmesh::{Coincident, Error, Estimate, Options, PaperOptions, Solver, Target};

/// Where the options are that the library's errors name.
fn place_of(argument: Argument, option: &str) -> Option<FieldPath> {
    let place = fairmesh_options::place(argument, option)?;
    Some(match option {
        "target" => place.field(offset_of!(fairmesh_target, constant), "constant"),
        _ => place,
    })
}

/// What the library refuses, at its place in the argument.
pub(crate) fn refused(
    error: Error,
    argument: Argument,
    fields: fn(Argument, &str) -> Option<FieldPath>,
) -> Failure {
    let place = match &error {
        Error::BadOption { name, .. } => fields(argument, name),
        _ => None,
    };
    let failure = Failure::from(error);
    place.map_or(failure, |place| place.blame(failure))
}

/// Options, checked; arrays in them not read.
pub(crate) struct OptionsIn {
    pub normals: NormalsIn,
    pub curvature: CurvatureIn,
    pub loops: LoopsIn,
    pub callback: HostCallback,
    /// Boundary normals, curvature and what is asked of single loops are not read yet.
    options: Options,
}

impl OptionsIn {
    pub(crate) fn new(
        options: *const fairmesh_options,
        argument: Argument,
        vertices: usize,
        aliases: &mut AliasCheck,
    ) -> CallResult<Self> {
        let view = if options.is_null() {
            fairmesh_options::standard()
        } else {
            read_struct(options, argument)?
        };
        let place = argument.field(offset_of!(fairmesh_options, boundary_normals), "boundary_normals");
        let normals = NormalsIn::new(&view.boundary_normals, place, vertices, aliases)?;
        let place = argument.field(
            offset_of!(fairmesh_options, boundary_curvature),
            "boundary_curvature",
        );
        let curvature = CurvatureIn::new(&view.boundary_curvature, place, vertices, aliases)?;
        let place = argument.field(offset_of!(fairmesh_options, loop_continuity), "loop_continuity");
        let loops = LoopsIn::new(&view.loop_continuity, place, aliases)?;
        let asked = read_options(&view, argument)?;
        asked
            .validate()
            .map_err(|error| refused(error, argument, place_of))?;
        aliases.input(
            options,
            size_of::<fairmesh_options>() * usize::from(!options.is_null()),
        );
        Ok(Self {
            normals,
            curvature,
            loops,
            callback: HostCallback::new(view.progress, view.user_data),
            options: asked,
        })
    }

    pub(crate) fn threads(&self) -> usize {
        self.options.threads
    }

    /// For `fairmesh_solver_new`.
    pub(crate) fn check_fast(&self, argument: Argument) -> CallResult {
        if self.options.solver == Solver::Fast {
            return Ok(());
        }
        let place = argument.field(offset_of!(fairmesh_options, solver), "solver");
        Err(place.refuse(
            Status::BadOption,
            format_args!("only the fast solver runs in steps"),
        ))
    }

    /// Whether curvature is to be continued.
    pub(crate) fn asks_continuity(&self) -> bool {
        self.options.continuity > 0.0 || self.loops.are_given()
    }

    /// With what is given per vertex of a mesh of so many.
    pub(crate) fn read(&self, vertices: usize, coincident: Coincident) -> CallResult<Options> {
        Ok(Options {
            boundary_normals: self.normals.read(vertices)?,
            boundary_curvature: self.curvature.read(vertices)?,
            loop_continuity: self.loops.read(vertices)?,
            coincident,
            ..self.options.clone()
        })
    }
}

fn read_options(view: &fairmesh_options, argument: Argument) -> CallResult<Options> {
    let place = argument.field(offset_of!(fairmesh_options, target), "target");
    Ok(Options {
        target: target(&view.target, place)?,
        solver: solver(view, argument)?,
        ..view.read_options(argument)?
    })
}

pub(crate) fn target(view: &fairmesh_target, base: FieldPath) -> CallResult<Target> {
    check_reserved(
        view.reserved,
        base.field(offset_of!(fairmesh_target, reserved), "reserved"),
    )?;
    let target = [
        Target::Harmonic,
        Target::Constant(view.constant),
        Target::MinimalEnergy,
    ]
    .into_iter()
    .find(|target| target.entry().number() == view.kind);
    let place = base.field(offset_of!(fairmesh_target, kind), "kind");
    chosen(target, view.kind, "fairmesh_target_kind", place)
}

fn solver(view: &fairmesh_options, argument: Argument) -> CallResult<Solver> {
    let kinds = [Solver::Fast, Solver::Paper(PaperOptions::default())];
    let kind = kinds
        .into_iter()
        .find(|kind| kind.entry().number() == view.solver);
    let place = argument.field(offset_of!(fairmesh_options, solver), "solver");
    match chosen(kind, view.solver, "fairmesh_solver_kind", place)? {
        Solver::Fast => Ok(Solver::Fast),
        Solver::Paper(_) => Ok(Solver::Paper(PaperOptions {
            estimate: estimate(view, argument)?,
            ..view.read_paper_options(argument)?
        })),
    }
}

fn estimate(view: &fairmesh_options, argument: Argument) -> CallResult<Estimate> {
    let iterations = view.paper_estimate_iterations as usize;
    let estimate = [
        Estimate::Alternating { iterations },
        Estimate::GaussSeidel { sweeps: iterations },
        Estimate::ConjugateGradients { iterations },
    ]
    .into_iter()
    .find(|estimate| estimate.entry().number() == view.paper_estimate);
    let place = argument.field(offset_of!(fairmesh_options, paper_estimate), "paper_estimate");
    chosen(estimate, view.paper_estimate, "fairmesh_estimate", place)
}
