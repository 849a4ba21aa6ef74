//! One call for each solver, and what both give back.

use nalgebra::Vector3;

use super::{Discretization, Options};
use crate::discrete::curvature::TILT_RIDGE;
use crate::discrete::equations::{FreeCurvature, State};
use crate::paper::{self, LevelReport, PaperOptions, Problem};
use crate::quality::{NEEDLE, Surface};
use crate::solve::control::{Callback, Interrupt};
use crate::solve::globalize::diagonal;
use crate::solve::initial::STAGE;
use crate::solve::system::Collapsed;
use crate::solve::{Control, Ending, Solved};

/// The surface with everything that is reported of it.
pub(super) struct Faired {
    pub(super) solved: Solved,
    /// Evaluated at the surface.
    pub(super) state: State,
    /// Prescribed, or the surface's own where it passes a fixed vertex.
    pub(super) boundary_normals: Vec<Vector3<f64>>,
    /// Of the outer equation, without unit.
    pub(super) defect: f64,
    pub(super) iterations: usize,
    pub(super) cancelled: bool,
    pub(super) levels: Vec<LevelReport>,
    /// The limit set on `Delta_B H` lies below what rounding shows.
    pub(super) rounding: bool,
}

/// The default solver.
pub(super) fn fast<'a>(
    problem: &Problem<'_>,
    options: &Options,
    progress: Option<&'a mut Callback<'a>>,
    interrupt: &Interrupt,
) -> Result<Faired, Collapsed> {
    let curvature = match options.discretization {
        Discretization::SecondOrder => FreeCurvature::GradientCorrected {
            tilt_ridge: TILT_RIDGE,
        },
        Discretization::Paper => FreeCurvature::Paper,
    };
    let mut control = Control::new(options.tolerance, options.max_iterations, progress);
    control.interrupt = interrupt.clone();
    control.stage(0.01, STAGE);
    if control.cancelled {
        return Ok(untouched(problem, curvature));
    }
    let mut system = problem.system(curvature);
    let solved = crate::solve::solve(&mut system, &mut control)?;
    system.evaluate(&solved.x);
    let (defect, _) = system.equations().defect(&system.state);
    Ok(Faired {
        solved,
        defect: defect * system.diagonal,
        state: system.state,
        boundary_normals: system.boundary_normals,
        iterations: control.iterations,
        cancelled: control.cancelled,
        levels: Vec::new(),
        rounding: false,
    })
}

/// The paper's own scheme.
pub(super) fn paper<'a>(
    problem: &Problem<'_>,
    options: &PaperOptions,
    progress: Option<&'a mut Callback<'a>>,
) -> Result<Faired, Collapsed> {
    let mut control = Control::new(options.defect, options.max_updates, progress);
    let found = paper::solve(problem, options, &mut control)?;
    let faired = measured(problem, FreeCurvature::Paper, found.solved);
    Ok(Faired {
        defect: faired.defect * found.diagonal,
        iterations: control.iterations,
        cancelled: control.cancelled,
        levels: found.levels,
        rounding: found.rounding,
        ..faired
    })
}

/// The input as it is, for a run that is stopped before the solver has begun.
fn untouched(problem: &Problem<'_>, curvature: FreeCurvature) -> Faired {
    let x = problem.input[..problem.region.region_vertices()].to_vec();
    let unit = diagonal(&x);
    let solved = Solved {
        x,
        ending: Ending::Stopped,
        step: f64::NAN,
        poor: Vec::new(),
        even: false,
        start_seconds: 0.0,
    };
    let mut faired = measured(problem, curvature, solved);
    let surface = Surface {
        region: problem.region,
        x: &faired.solved.x,
        normals: &faired.state.corrected,
        boundary_normals: &faired.boundary_normals,
        h: &faired.state.h,
    };
    faired.solved.poor = surface.poor(NEEDLE);
    faired.defect *= unit;
    faired.cancelled = true;
    faired
}

/// A surface, evaluated; its defect still has a unit.
fn measured(problem: &Problem<'_>, curvature: FreeCurvature, solved: Solved) -> Faired {
    let equations = problem.equations(curvature);
    let mut state = State::new(problem.batches, problem.region.boundary);
    equations.evaluate(&solved.x, &mut state);
    let (defect, _) = equations.defect(&state);
    Faired {
        solved,
        boundary_normals: state.corrected[problem.region.free..].to_vec(),
        state,
        defect,
        iterations: 0,
        cancelled: false,
        levels: Vec::new(),
        rounding: false,
    }
}
