//! Options of the fairing: how they become the library's.

use super::callback::HostCallback;
use super::choices::choose;
use super::input::{CurvatureIn, LoopsIn, MeshIn, NormalsIn};
use super::option_structs::{OptionsLists, fairmesh_options};
use super::status::{CallResult, Failure};
use super::types::*;
use super::views::{Argument, Call, FieldPath, check_reserved, field};
use fairmesh::{Error, Options, Target};

/// Where the options are that the library's errors name.
pub(crate) fn place_of(argument: Argument, option: &str) -> Option<FieldPath> {
    let place = fairmesh_options::place(argument, option)?;
    Some(match option {
        "target" => field!(place, fairmesh_target.constant),
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
    lists: OptionsLists,
    /// Boundary normals, curvature and what is asked of single loops are not read yet.
    options: Options,
}

impl OptionsIn {
    pub(crate) fn new(
        options: *const fairmesh_options,
        argument: Argument,
        mesh: &MeshIn,
        call: &mut Call,
    ) -> CallResult<Self> {
        let view = call.read_options(options, argument, fairmesh_options::standard)?;
        let place = field!(argument, fairmesh_options.boundary_normals);
        let normals = NormalsIn::new(&view.boundary_normals, place, mesh.vertices(), call)?;
        let place = field!(argument, fairmesh_options.boundary_curvature);
        let curvature = CurvatureIn::new(&view.boundary_curvature, place, mesh.vertices(), call)?;
        let place = field!(argument, fairmesh_options.loop_continuity);
        let loops = LoopsIn::new(&view.loop_continuity, place, call)?;
        let lists = view.lists(argument)?;
        for list in &lists {
            call.input(list.memory());
        }
        let asked = read_options(&view, argument)?;
        asked
            .validate()
            .map_err(|error| refused(error, argument, place_of))?;
        Ok(Self {
            normals,
            curvature,
            loops,
            callback: HostCallback::new(view.progress, view.user_data),
            lists,
            options: asked,
        })
    }

    pub(crate) fn threads(&self) -> usize {
        self.options.threads
    }

    /// Whether curvature is to be continued.
    pub(crate) fn asks_continuity(&self) -> bool {
        self.options.continuity != 0.0 || self.loops.are_given()
    }

    /// With what is given per vertex of the mesh.
    pub(crate) fn read(&self, mesh: &MeshIn) -> CallResult<Options> {
        let vertices = mesh.vertices();
        let mut options = Options {
            boundary_normals: self.normals.read(vertices)?,
            boundary_curvature: self.curvature.read(vertices)?,
            loop_continuity: self.loops.read(vertices)?,
            coincident: mesh.coincident,
            ..self.options.clone()
        };
        fairmesh_options::read_lists(&self.lists, &mut options)?;
        Ok(options)
    }
}

fn read_options(view: &fairmesh_options, argument: Argument) -> CallResult<Options> {
    Ok(Options {
        target: target(&view.target, field!(argument, fairmesh_options.target))?,
        ..view.read_options(argument)?
    })
}

pub(crate) fn target(view: &fairmesh_target, base: FieldPath) -> CallResult<Target> {
    check_reserved(view.reserved, field!(base, fairmesh_target.reserved))?;
    choose(
        [
            Target::Harmonic,
            Target::Constant(view.constant),
            Target::MinimalEnergy,
        ],
        |target| target.entry().number(),
        view.kind,
        "fairmesh_target_kind",
        field!(base, fairmesh_target.kind),
    )
}
