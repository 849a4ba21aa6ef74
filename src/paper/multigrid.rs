//! The whole scheme (paper 7.4, Figure 6).

use std::sync::Arc;

use nalgebra::Vector3;

use super::estimate::Residual;
use super::iteration::{Goal, Level, LevelResult, LevelStatus};
use super::level_report::LevelReport;
use super::options::PaperOptions;
use super::prolongation::Prolongation;
use crate::discrete::equations::State;
use crate::discrete::inner_fairness::FairnessWeights;
use crate::mesh::{ProgressiveMesh, decimate, level_sizes};
use crate::quality::{NEEDLE, SurfaceState};
use crate::solve::curvature_bounds::Judged;
use crate::solve::factor::Collapsed;
use crate::solve::problem::diagonal;
use crate::solve::{Control, Domain, Problem, SolveResult, SolveStatus, System};
use crate::support::stopwatch::Stopwatch;

/// What was found.
#[derive(Debug)]
pub(crate) struct PaperResult {
    /// The surface, judged as the default solver judges its own.
    pub result: SolveResult,
    /// Its evaluation.
    pub state: State,
    /// From the base to the given mesh.
    pub levels: Vec<LevelReport>,
}

/// A level has about this many times the vertices of the one before, where their number is not given.
/// Of 3 cases, half: 2 change by up to 2e-5 edges, +26 % iterations, 1 fails; double: 1 changes by up to 8e-6 edges, -3 % iterations.
const GROWTH: f64 = 4.0;
/// The base has this many times the vertices of the boundary, where it is not given: with fewer, the triangles that the
/// boundary's edges force upon it are too thin.
/// Of 3 cases, half: 3 change by up to 2e-5 edges, +2 % iterations; double: 1 changes by up to 8e-6 edges, -3 % iterations.
const BASE: f64 = 2.5;
/// The defect to which coarse levels are solved: they only prepare.
/// Of 1 case, half: 1 changes by up to 2e-9 edges, +2 % iterations; double: 1 changes by up to 4e-9 edges, -2 % iterations.
const COARSE_DEFECT: f64 = 1e-3;
/// Updates of a coarse level, at most.
/// Half or double, of 1 case: none changes.
const COARSE_UPDATES: usize = 1000;
/// Progress is told after this many splits.
/// Half or double, of 1 case: none changes.
const SPLITS: usize = 512;

/// Fairs the region.
///
/// # Errors
/// [`Collapsed`] where not even the linear surface exists.
pub(crate) fn solve(
    problem: &Problem<'_>,
    options: &PaperOptions,
    control: &mut Control<'_>,
) -> Result<PaperResult, Collapsed> {
    let clock = Stopwatch::start();
    control.phase(0.02, "hierarchy");
    let mut run = MultigridScheme {
        problem,
        options,
        levels: Vec::new(),
        diagonal: f64::NAN,
        start_seconds: 0.0,
    };
    let mut x = match run.coarse(control, &clock)? {
        Some(x) => x,
        None => run.linear_start(problem, &clock, control)?,
    };
    let mut level = Level::new(problem);
    let goal = Goal {
        defect: options.defect,
        laplacian: options.laplacian,
        updates: usize::MAX,
    };
    let ended = run.iterate(&mut level, &mut x, goal, problem, control);
    if ended.status == LevelStatus::Diverged {
        x = linear_start(problem, control)?;
    }
    level.evaluate(&x);
    let (defect, _) = problem.equations().defect(&level.state);
    let result = SolveResult {
        spread_otherwise: false,
        status: status(problem, &level.state, &x, ended.status, control),
        poor: surface(problem, &level.state, &x).poor(NEEDLE),
        step: ended.step,
        defect: defect * run.diagonal,
        iterations: control.tally.iterations,
        along_normals: false,
        trials: Vec::new(),
        continuity: Vec::new(),
        start_seconds: run.start_seconds,
        x,
    };
    Ok(PaperResult {
        result,
        state: level.state,
        levels: run.levels,
    })
}

/// The scheme under way.
struct MultigridScheme<'a> {
    problem: &'a Problem<'a>,
    options: &'a PaperOptions,
    levels: Vec<LevelReport>,
    diagonal: f64,
    start_seconds: f64,
}

impl MultigridScheme<'_> {
    /// Sizes of all levels, the given mesh last.
    fn sizes(&self) -> Vec<usize> {
        let region = &self.problem.domain.region;
        let vertices = region.region_vertices();
        let automatic = (BASE * region.boundary as f64).ceil() as usize;
        let base = if self.options.base > 0 {
            self.options.base
        } else {
            automatic
        };
        let base = base.clamp(region.boundary + 1, vertices);
        let fitting = 1 + (libm::log(vertices as f64 / base as f64) / libm::log(GROWTH)).round() as usize;
        let levels = if self.options.levels > 0 {
            self.options.levels
        } else {
            fitting
        };
        level_sizes(base, vertices, levels)
    }

    /// All levels but the given mesh: a start on that; `None` where there is only that.
    fn coarse(
        &mut self,
        control: &mut Control<'_>,
        clock: &Stopwatch,
    ) -> Result<Option<Vec<Vector3<f64>>>, Collapsed> {
        let Domain { region, input, .. } = &**self.problem.domain;
        let sizes = self.sizes();
        let count = region.region_vertices();
        if sizes.len() == 1 || sizes[0] == count {
            return Ok(None);
        }
        let mut progressive = decimate(region, input, sizes[0]);
        let mut normal = vec![Vector3::z(); region.free];
        normal.extend_from_slice(self.problem.boundary_normals);
        let original = self.problem.weigh.is_some().then_some(&input[..]);
        let mut surface = Prolongation::new(original, input[..count].to_vec(), normal, self.options.damping);
        for (k, &next) in sizes.iter().enumerate().skip(1) {
            // The base may have more vertices than asked for, where no more collapses were allowed.
            if progressive.vertices() < next && !control.exhausted() {
                self.smooth(k == 1, &progressive, &mut surface, control, clock)?;
            }
            let mut splits = 0;
            while progressive.vertices() < next && surface.refine(&mut progressive, control.exhausted()) {
                splits += 1;
                if splits % SPLITS == 0 {
                    control.phase(0.0, "refining");
                }
            }
        }
        Ok(Some(surface.x))
    }

    /// Smooths the mesh as it is now; on the base from the linear surface.
    fn smooth(
        &mut self,
        is_base: bool,
        progressive: &ProgressiveMesh,
        surface: &mut Prolongation<'_>,
        control: &mut Control<'_>,
        clock: &Stopwatch,
    ) -> Result<(), Collapsed> {
        let given = &self.problem.domain.input;
        let region = progressive.region(given).map_err(|_| Collapsed)?;
        let gather = |of: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
            let ids = region.vertex_ids[..region.region_vertices()].iter();
            ids.map(|&v| of[v as usize]).collect()
        };
        let (input, finer) = (gather(given), gather(&surface.x));
        let domain = Arc::new(Domain::new(region, input));
        let weights = Arc::new(match self.problem.weigh {
            None => FairnessWeights::uniform(),
            Some(weigh) => weigh(&domain.batches, &domain.input),
        });
        let level_problem = Problem {
            continuity: None,
            domain: &domain,
            weights: &weights,
            ..*self.problem
        };
        let mut x = if is_base {
            self.linear_start(&level_problem, clock, control)?
        } else {
            finer
        };
        let goal = Goal {
            defect: self.options.defect.max(COARSE_DEFECT),
            laplacian: f64::INFINITY,
            updates: COARSE_UPDATES,
        };
        let mut level = Level::new(&level_problem);
        self.iterate(&mut level, &mut x, goal, &level_problem, control);
        level.evaluate(&x);
        let region = &domain.region;
        for (i, &v) in region.vertex_ids[..region.free].iter().enumerate() {
            surface.x[v as usize] = x[i];
            surface.normal[v as usize] = level.state.normal[i];
        }
        Ok(())
    }

    fn linear_start(
        &mut self,
        problem: &Problem<'_>,
        clock: &Stopwatch,
        control: &mut Control<'_>,
    ) -> Result<Vec<Vector3<f64>>, Collapsed> {
        let x = linear_start(problem, control)?;
        self.diagonal = diagonal(&x);
        self.start_seconds = clock.seconds();
        Ok(x)
    }

    fn iterate(
        &mut self,
        level: &mut Level<'_>,
        x: &mut [Vector3<f64>],
        goal: Goal,
        problem: &Problem<'_>,
        control: &mut Control<'_>,
    ) -> LevelResult {
        let count = problem.domain.region.region_vertices();
        let is_last = count == self.problem.domain.region.region_vertices();
        let from = 0.05 + 0.25 * count as f64 / self.problem.domain.region.region_vertices() as f64;
        let mut tell = |control: &mut Control<'_>, step: f64, residual: &Residual| {
            let digits = libm::log10(residual.defect.max(goal.defect)) / libm::log10(goal.defect);
            let gained = if is_last {
                0.69 * digits.clamp(0.0, 1.0)
            } else {
                0.0
            };
            control.update(
                from + gained,
                step,
                if is_last { "fairing" } else { "coarse level" },
            );
        };
        let ended = level.iterate(x, self.options, (goal, self.diagonal), control, &mut tell);
        self.levels.push(LevelReport {
            vertices: count,
            triangles: problem.domain.region.triangles().len(),
            updates: ended.updates,
            defect: ended.residual.defect,
        });
        ended
    }
}

/// The surface `x`, evaluated in `state`, to be judged.
fn surface<'s>(problem: &'s Problem<'_>, state: &'s State, x: &'s [Vector3<f64>]) -> SurfaceState<'s> {
    let region = &problem.domain.region;
    SurfaceState {
        region,
        x,
        normals: &state.corrected,
        boundary_normals: &state.corrected[region.free..],
        h: &state.h,
    }
}

/// What the surface is worth, by the measures of the default solver.
fn status(
    problem: &Problem<'_>,
    state: &State,
    x: &[Vector3<f64>],
    last: LevelStatus,
    control: &Control<'_>,
) -> SolveStatus {
    let bounds = Judged {
        phi: &[],
        state,
        right_hand_side: problem.right_hand_side,
        diagonal: diagonal(x),
    };
    let has_bump = || bounds.overshoots() || surface(problem, state, x).is_detached_from_normals();
    match last {
        LevelStatus::Met | LevelStatus::Rounding if has_bump() => SolveStatus::Bump,
        LevelStatus::Met => SolveStatus::Converged,
        LevelStatus::Rounding => SolveStatus::ConvergedToRounding,
        LevelStatus::Spent | LevelStatus::Stopped if control.cancelled => SolveStatus::Cancelled,
        LevelStatus::Spent | LevelStatus::Stopped => SolveStatus::IterationLimit,
        LevelStatus::Diverged => SolveStatus::Failed,
    }
}

/// The linear surface of connectivity and boundary data, its vertices distributed by inner fairness.
fn linear_start(problem: &Problem<'_>, control: &mut Control<'_>) -> Result<Vec<Vector3<f64>>, Collapsed> {
    let mut system = System::new(problem);
    let asked = system.asked().clone();
    system.start(&asked, control)
}
