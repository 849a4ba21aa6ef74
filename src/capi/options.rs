//! Options as the library takes them, and the callback.

use core::ffi::c_void;
use core::mem::offset_of;
use std::ops::ControlFlow;

use super::input::NormalsIn;
use super::memory;
use super::status::{CallResult, Failure, Text, fairmesh_status as Status};
use super::types::*;
use super::views::{AliasCheck, Argument, FieldPath, check_reserved, read_struct};
use fairmesh::{
    BoundaryNormals, Discretization, InnerFairness, InteriorNormals, Options, Progress, Solver, Target,
};
use fairmesh::{Estimate, PaperOptions};

pub(crate) fn target(view: &fairmesh_target, base: FieldPath) -> CallResult<Target> {
    check_reserved(view.reserved, base.plus(offset_of!(fairmesh_target, reserved)))?;
    match view.kind {
        0 => Ok(Target::Harmonic),
        1 if view.constant.is_finite() => Ok(Target::Constant(view.constant)),
        1 => {
            let place = base.plus(offset_of!(fairmesh_target, constant));
            Err(place.refuse(Status::BadOption, format_args!("the constant has to be finite")))
        }
        2 => Ok(Target::MinimalEnergy),
        other => {
            let place = base.plus(offset_of!(fairmesh_target, kind));
            Err(place.refuse(
                Status::BadEnum,
                format_args!("{other} is no fairmesh_target_kind"),
            ))
        }
    }
}

/// Options, checked; arrays in them not read.
pub(crate) struct OptionsIn {
    pub normals: NormalsIn,
    pub callback: HostCallback,
    target: Target,
    interior: InteriorNormals,
    inner: InnerFairness,
    discretization: Discretization,
    pub solver: Solver,
    pub tolerance: f64,
    pub max_iterations: usize,
    pub threads: usize,
}

/// The library's defaults, which are the C interface's.
pub(crate) fn default_options() -> fairmesh_options {
    let (options, paper) = (Options::default(), PaperOptions::default());
    let no_points = fairmesh_points {
        data: core::ptr::null(),
        count: 0,
        stride: 0,
        scalar: 2,
        reserved: 0,
    };
    let no_indices = fairmesh_indices {
        data: core::ptr::null(),
        count: 0,
        stride: 0,
    };
    let Estimate::Alternating { iterations } = paper.estimate else {
        unreachable!("the default is known")
    };
    fairmesh_options {
        struct_size: size_of::<fairmesh_options>() as u32,
        inner_fairness: fairmesh_inner_fairness::Uniform as u32,
        normals: fairmesh_normals {
            kind: 0,
            reserved: 0,
            vectors: no_points,
            vertices: no_indices,
        },
        target: fairmesh_target {
            kind: 0,
            reserved: 0,
            constant: 0.0,
        },
        interior_normals: fairmesh_interior_normals::Smooth as u32,
        discretization: fairmesh_discretization::SecondOrder as u32,
        solver: fairmesh_solver_kind::Fast as u32,
        threads: options.threads as u32,
        tolerance: options.tolerance,
        max_iterations: options.max_iterations as u64,
        progress: None,
        user_data: core::ptr::null_mut(),
        paper_estimate: fairmesh_estimate::Alternating as u32,
        paper_estimate_iterations: iterations as u32,
        paper_damping: paper.damping,
        paper_levels: paper.levels as u64,
        paper_base: paper.base as u64,
        paper_defect: paper.defect,
        paper_laplacian: paper.laplacian,
        paper_max_updates: paper.max_updates as u64,
    }
}

/// More threads than anybody has.
const MOST_THREADS: u32 = 1024;

macro_rules! choose {
    ($view:expr, $field:ident, $argument:expr, $name:literal, $($number:pat => $value:expr),*) => {
        match $view.$field {
            $($number => $value,)*
            other => {
                let place = $argument.field(offset_of!(fairmesh_options, $field));
                return Err(place.refuse(Status::BadEnum, format_args!("{other} is no {}", $name)));
            }
        }
    };
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
        let at = |offset| argument.field(offset);
        let inner = choose!(view, inner_fairness, argument, "fairmesh_inner_fairness",
            0 => InnerFairness::Uniform, 1 => InnerFairness::Conformal, 2 => InnerFairness::Convex);
        let normals = NormalsIn::new(
            &view.normals,
            at(offset_of!(fairmesh_options, normals)),
            vertices,
            aliases,
        )?;
        let target = target(&view.target, at(offset_of!(fairmesh_options, target)))?;
        let interior = choose!(view, interior_normals, argument, "fairmesh_interior_normals",
            0 => InteriorNormals::Smooth, 1 => InteriorNormals::Input);
        let discretization = choose!(view, discretization, argument, "fairmesh_discretization",
            0 => Discretization::SecondOrder, 1 => Discretization::Paper);
        let paper = choose!(view, solver, argument, "fairmesh_solver_kind", 0 => false, 1 => true);
        let refuse =
            |offset, what: &str| Err(at(offset).refuse(Status::BadOption, format_args!("has to be {what}")));
        if view.threads > MOST_THREADS {
            return refuse(offset_of!(fairmesh_options, threads), "at most 1024");
        }
        if !(view.tolerance > 0.0 && view.tolerance < 1.0) {
            return refuse(
                offset_of!(fairmesh_options, tolerance),
                "greater than 0 and less than 1",
            );
        }
        if view.max_iterations == 0 {
            return refuse(offset_of!(fairmesh_options, max_iterations), "at least 1");
        }
        let solver = if paper {
            Solver::Paper(Self::paper(&view, argument)?)
        } else {
            Solver::Fast
        };
        aliases.input(
            options,
            size_of::<fairmesh_options>() * usize::from(!options.is_null()),
        );
        Ok(Self {
            normals,
            callback: HostCallback::new(view.progress, view.user_data),
            target,
            interior,
            inner,
            discretization,
            solver,
            tolerance: view.tolerance,
            max_iterations: usize::try_from(view.max_iterations).unwrap_or(usize::MAX),
            threads: view.threads as usize,
        })
    }

    fn paper(view: &fairmesh_options, argument: Argument) -> CallResult<PaperOptions> {
        let refuse = |offset, what: &str| {
            let place = argument.field(offset);
            Err(place.refuse(Status::BadOption, format_args!("has to be {what}")))
        };
        let iterations = view.paper_estimate_iterations as usize;
        let estimate = choose!(view, paper_estimate, argument, "fairmesh_estimate",
            0 => Estimate::Alternating { iterations },
            1 => Estimate::GaussSeidel { sweeps: iterations },
            2 => Estimate::ConjugateGradients { iterations });
        if iterations == 0 {
            return refuse(
                offset_of!(fairmesh_options, paper_estimate_iterations),
                "at least 1",
            );
        }
        if !(view.paper_damping > 0.0 && view.paper_damping <= 1.0) {
            return refuse(
                offset_of!(fairmesh_options, paper_damping),
                "greater than 0 and at most 1",
            );
        }
        if view.paper_defect.is_nan() || view.paper_defect <= 0.0 {
            return refuse(offset_of!(fairmesh_options, paper_defect), "greater than 0");
        }
        if view.paper_laplacian.is_nan() || view.paper_laplacian <= 0.0 {
            return refuse(offset_of!(fairmesh_options, paper_laplacian), "greater than 0");
        }
        if view.paper_max_updates == 0 {
            return refuse(offset_of!(fairmesh_options, paper_max_updates), "at least 1");
        }
        let count = |n: u64| usize::try_from(n).unwrap_or(usize::MAX);
        Ok(PaperOptions {
            estimate,
            damping: view.paper_damping,
            levels: count(view.paper_levels),
            base: count(view.paper_base),
            defect: view.paper_defect,
            laplacian: view.paper_laplacian,
            max_updates: count(view.paper_max_updates),
        })
    }

    pub(crate) fn options(&self, boundary_normals: BoundaryNormals) -> Options {
        Options {
            boundary_normals,
            interior_normals: self.interior,
            target: self.target,
            inner_fairness: self.inner,
            discretization: self.discretization,
            solver: self.solver,
            tolerance: self.tolerance,
            max_iterations: self.max_iterations,
            threads: self.threads,
        }
    }
}

/// The callback, and the watch on the memory.
#[derive(Clone, Copy)]
pub(crate) struct HostCallback {
    progress: fairmesh_progress_fn,
    user_data: *mut c_void,
    failures: usize,
}

// SAFETY: the pointer is only handed back to the caller's function, on the thread that makes the call.
unsafe impl Send for HostCallback {}
// SAFETY: as above.
unsafe impl Sync for HostCallback {}

impl HostCallback {
    pub(crate) fn new(progress: fairmesh_progress_fn, user_data: *mut c_void) -> Self {
        Self {
            progress,
            user_data,
            failures: memory::failures(),
        }
    }

    /// The watch begins now.
    pub(crate) fn fresh(&self) -> Self {
        Self::new(self.progress, self.user_data)
    }

    /// Passes a message on; stops when memory has run out.
    pub(crate) fn tell(&self, progress: &Progress) -> ControlFlow<()> {
        if memory::failures() != self.failures {
            return ControlFlow::Break(());
        }
        let Some(function) = self.progress else {
            return ControlFlow::Continue(());
        };
        let stage = Text::<48>::new(format_args!("{}", progress.stage)).characters();
        let told = fairmesh_progress {
            struct_size: size_of::<fairmesh_progress>() as u32,
            reserved: 0,
            fraction: progress.fraction,
            iterations: progress.iterations as u64,
            step: progress.step,
            stage: stage.as_ptr(),
        };
        // SAFETY: the caller's function, with what its documentation says.
        let answer = unsafe { function(&raw const told, self.user_data) };
        if answer == 0 {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    }

    /// An error if memory has run out since this was made.
    pub(crate) fn memory(&self) -> CallResult {
        if memory::failures() == self.failures {
            Ok(())
        } else {
            Err(Failure::out_of_memory())
        }
    }
}
