//! Options of the fairing: the struct, its defaults, and how it becomes the library's.

use core::mem::offset_of;
use std::ffi::c_void;

use super::callback::{HostCallback, fairmesh_progress_fn};
use super::input::{CurvatureIn, LoopsIn, NormalsIn};
use super::status::{CallResult, Failure, fairmesh_status as Status};
use super::types::*;
use super::views::{AliasCheck, Argument, FieldPath, check_reserved, read_struct};
use fairmesh::{
    BoundaryCurvature, BoundaryNormals, Coincident, Discretization, Error, Estimate, InnerFairness,
    InteriorNormals,
};
use fairmesh::{Intersections, Options, OutputPrecision, PaperOptions, Solver, Target};

/// What is asked. Fill it by `fairmesh_options_init`, then change fields: every default exists once, in the library.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_options {
    /// `sizeof(fairmesh_options)`.
    pub struct_size: u32,
    /// A `fairmesh_inner_fairness`. Default: uniform.
    pub inner_fairness: u32,
    /// Boundary normals. Default: fitted.
    pub boundary_normals: fairmesh_boundary_normals,
    /// What Delta_B H has to be. Default: 0.
    pub target: fairmesh_target,
    /// A `fairmesh_interior_normals`. Default: smooth.
    pub interior_normals: u32,
    /// A `fairmesh_discretization`. Default: second order.
    pub discretization: u32,
    /// A `fairmesh_solver_kind`. Default: fast.
    pub solver: u32,
    /// Worker threads, at most 1024; 0 (default): as many as the machine has. Any number gives the same bits.
    pub threads: u32,
    /// Stop when the step norm (rms normal step + rms tangential step, over the diagonal of the component's bounding
    /// box) is below this. Default 1e-8; 1e-6 is enough for interactive use. At least 1e-15, less than 1.
    pub tolerance: f64,
    /// At most this many nonlinear iterations for each component of the region. Default 500. At least 1.
    pub max_iterations: u64,
    /// Told of the progress; may be NULL, the default.
    pub progress: fairmesh_progress_fn,
    /// Handed to `progress`.
    pub user_data: *mut c_void,
    /// A `fairmesh_estimate`. This and what follows: for `FAIRMESH_SOLVER_KIND_PAPER` only. Default: alternating.
    pub paper_estimate: u32,
    /// Iterations of the estimate. Default 10. At least 1.
    pub paper_estimate_iterations: u32,
    /// The part of each normal step that is taken. Default 0.9. Greater than 0, at most 1.
    pub paper_damping: f64,
    /// Levels of the hierarchy; 1: none; 0 (default): as many as make each level four times as large.
    pub paper_levels: u64,
    /// Vertices of the base mesh; 0 (default): two and a half times the boundary.
    pub paper_base: u64,
    /// Stop when `defect` of the report is at most this. Default 1e-6. Greater than 0.
    pub paper_defect: f64,
    /// And when max |Delta_B H| times the cube of the diagonal is at most this. Default: infinite. Greater than 0.
    pub paper_laplacian: f64,
    /// At most this many updates on all levels. Default 20000. At least 1.
    pub paper_max_updates: u64,
    /// A `fairmesh_intersections`: whether the final surface is checked for self-intersections. Default: it is; that takes
    /// about a tenth of the run, at most a fifth.
    pub intersections: u32,
    /// A `fairmesh_output_precision`: what the result will be written in; moved positions are rounded to it, and the report is of
    /// the rounded surface. Default: double. Where `positions_out` has floats, `fairmesh_fair` takes single.
    pub output_precision: u32,
    /// How far the surface continues the mean curvature of its surroundings: from 0 (default: tangent planes alone, G1) to 1 (curvature,
    /// G2), as far as the surroundings are smooth enough to tell it; see `fairmesh_result_continuity`. 0 for the paper's scheme.
    pub continuity: f64,
    /// Where that curvature comes from. Default: fitted.
    pub boundary_curvature: fairmesh_boundary_curvature,
    /// The same for single boundary loops, in place of `continuity`. Default: none.
    pub loop_continuity: fairmesh_loop_continuity,
}

/// The library's defaults, which are the C interface's.
pub(crate) fn default_options() -> fairmesh_options {
    let (options, paper) = (Options::default(), PaperOptions::default());
    let Estimate::Alternating { iterations } = paper.estimate else {
        unreachable!("the default is known")
    };
    fairmesh_options {
        struct_size: size_of::<fairmesh_options>() as u32,
        inner_fairness: options.inner_fairness.entry().number(),
        boundary_normals: fairmesh_boundary_normals {
            kind: options.boundary_normals.entry().number(),
            reserved: 0,
            vectors: fairmesh_points {
                data: core::ptr::null(),
                count: 0,
                stride: 0,
                scalar: fairmesh_scalar::Float64 as u32,
                reserved: 0,
            },
            vertices: NO_INDICES,
        },
        target: fairmesh_target {
            kind: options.target.entry().number(),
            reserved: 0,
            constant: 0.0,
        },
        interior_normals: options.interior_normals.entry().number(),
        discretization: options.discretization.entry().number(),
        solver: options.solver.entry().number(),
        threads: options.threads as u32,
        tolerance: options.tolerance,
        max_iterations: options.max_iterations as u64,
        progress: None,
        user_data: core::ptr::null_mut(),
        paper_estimate: paper.estimate.entry().number(),
        paper_estimate_iterations: iterations as u32,
        paper_damping: paper.damping,
        paper_levels: paper.levels as u64,
        paper_base: paper.base as u64,
        paper_defect: paper.defect,
        paper_laplacian: paper.laplacian,
        paper_max_updates: paper.max_updates as u64,
        intersections: options.intersections.entry().number(),
        output_precision: options.output_precision.entry().number(),
        continuity: options.continuity,
        boundary_curvature: fairmesh_boundary_curvature {
            kind: fairmesh_boundary_curvature_kind::Estimated as u32,
            reserved: 0,
            values: NO_NUMBERS,
            vertices: NO_INDICES,
        },
        loop_continuity: fairmesh_loop_continuity {
            values: NO_NUMBERS,
            vertices: NO_INDICES,
        },
    }
}

/// No numbers.
const NO_NUMBERS: fairmesh_numbers = fairmesh_numbers {
    data: core::ptr::null(),
    count: 0,
    stride: 0,
    scalar: fairmesh_scalar::Float64 as u32,
    reserved: 0,
};

/// No list.
pub(crate) const NO_INDICES: fairmesh_indices = fairmesh_indices {
    data: core::ptr::null(),
    count: 0,
    stride: 0,
};

/// The field of an option, by the name that the library's errors give it.
macro_rules! fields {
    ($struct:ident: $($name:ident)*) => {
        |argument: Argument, option: &str| match option {
            $(stringify!($name) => Some(argument.field(offset_of!($struct, $name), stringify!($name))),)*
            _ => None,
        }
    };
}
pub(crate) use fields;

/// Where the options are that the library's errors name.
fn place_of(argument: Argument, option: &str) -> Option<FieldPath> {
    let place = FIELDS(argument, option)?;
    Some(match option {
        "target" => place.field(offset_of!(fairmesh_target, constant), "constant"),
        _ => place,
    })
}

const FIELDS: fn(Argument, &str) -> Option<FieldPath> = fields!(fairmesh_options:
    inner_fairness boundary_normals target interior_normals discretization solver threads tolerance max_iterations
    paper_estimate paper_estimate_iterations paper_damping paper_levels paper_base paper_defect paper_laplacian
    paper_max_updates output_precision continuity
);

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

/// A choice by its number.
pub(crate) fn chosen<T>(value: Option<T>, number: u32, of: &str, place: FieldPath) -> CallResult<T> {
    value.ok_or_else(|| place.refuse(Status::BadEnum, format_args!("{number} is no {of}")))
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
            default_options()
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
    let number = view.inner_fairness;
    let place = argument.field(offset_of!(fairmesh_options, inner_fairness), "inner_fairness");
    let inner_fairness = chosen(
        InnerFairness::from_number(number),
        number,
        "fairmesh_inner_fairness",
        place,
    )?;
    let number = view.interior_normals;
    let place = argument.field(offset_of!(fairmesh_options, interior_normals), "interior_normals");
    let interior_normals = chosen(
        InteriorNormals::from_number(number),
        number,
        "fairmesh_interior_normals",
        place,
    )?;
    let number = view.discretization;
    let place = argument.field(offset_of!(fairmesh_options, discretization), "discretization");
    let discretization = chosen(
        Discretization::from_number(number),
        number,
        "fairmesh_discretization",
        place,
    )?;
    let number = view.intersections;
    let place = argument.field(offset_of!(fairmesh_options, intersections), "intersections");
    let intersections = chosen(
        Intersections::from_number(number),
        number,
        "fairmesh_intersections",
        place,
    )?;
    let number = view.output_precision;
    let place = argument.field(offset_of!(fairmesh_options, output_precision), "output_precision");
    let output_precision = chosen(
        OutputPrecision::from_number(number),
        number,
        "fairmesh_output_precision",
        place,
    )?;
    let place = argument.field(offset_of!(fairmesh_options, target), "target");
    Ok(Options {
        boundary_normals: BoundaryNormals::default(),
        interior_normals,
        continuity: view.continuity,
        loop_continuity: Vec::new(),
        boundary_curvature: BoundaryCurvature::default(),
        target: target(&view.target, place)?,
        inner_fairness,
        discretization,
        solver: solver(view, argument)?,
        tolerance: view.tolerance,
        max_iterations: count(view.max_iterations),
        output_precision,
        threads: view.threads as usize,
        intersections,
        // The mesh says it.
        coincident: Coincident::default(),
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
            damping: view.paper_damping,
            levels: count(view.paper_levels),
            base: count(view.paper_base),
            defect: view.paper_defect,
            laplacian: view.paper_laplacian,
            max_updates: count(view.paper_max_updates),
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

/// A number that may exceed what this machine counts.
pub(crate) fn count(n: u64) -> usize {
    usize::try_from(n).unwrap_or(usize::MAX)
}
