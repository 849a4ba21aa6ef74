//! The whole scheme (paper 7.4, Figure 6).

use std::time::Instant;

use nalgebra::Vector3;

use super::estimate::Residual;
use super::iteration::{End, Ended, Goal, Level};
use super::prolongation::Prolongation;
use super::{LevelReport, PaperOptions};
use crate::discrete::equations::{Equations, FreeCurvature};
use crate::discrete::inner_fairness::FairnessWeights;
use crate::discrete::target::RightHandSide;
use crate::discrete::valence_batches::ValenceBatches;
use crate::mesh::{ProgressiveMesh, Region, Rings, decimate, level_sizes};
use crate::quality::{NEEDLE, Surface};
use crate::solve::curvature_bounds::Judged;
use crate::solve::globalize::diagonal;
use crate::solve::system::Collapsed;
use crate::solve::{Control, Ending, Solved, System};

/// Inner fairness of a mesh.
pub(crate) type Weigh = fn(&ValenceBatches, &[Vector3<f64>]) -> FairnessWeights;

/// What is to be faired, in the region's own centred and scaled frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Problem<'a> {
    /// The region.
    pub region: &'a Region,
    /// Its rings.
    pub rings: &'a Rings,
    /// The same, transposed.
    pub batches: &'a ValenceBatches,
    /// The given mesh.
    pub input: &'a [Vector3<f64>],
    /// Prescribed normals.
    pub boundary_normals: &'a [Vector3<f64>],
    /// Boundary vertices that the surface passes, as in [`crate::discrete::equations::Equations`].
    pub smooth_interior: &'a [bool],
    /// Inner fairness on the given mesh.
    pub weights: &'a FairnessWeights,
    /// How they come from a mesh, where they are not uniform: for the levels.
    pub weigh: Option<Weigh>,
    /// What `Delta_B H` has to be.
    pub right_hand_side: RightHandSide,
}

impl<'a> Problem<'a> {
    /// Both equations.
    pub(crate) fn equations(&self, curvature: FreeCurvature) -> Equations<'a> {
        Equations {
            rings: self.rings,
            batches: self.batches,
            boundary_normals: self.boundary_normals,
            smooth_interior: self.smooth_interior,
            weights: self.weights,
            curvature,
            right_hand_side: self.right_hand_side,
        }
    }

    /// The whole system of the default solver for the problem.
    pub(crate) fn system(&self, curvature: FreeCurvature) -> System<'a> {
        let mut system = System::new(
            self.region,
            self.rings,
            self.batches,
            self.input,
            self.boundary_normals.to_vec(),
            self.weights.clone(),
            curvature,
        );
        system.smooth_interior = self.smooth_interior.to_vec();
        system.right_hand_side = self.right_hand_side;
        system
    }
}

/// What was found.
#[derive(Debug, Clone)]
pub(crate) struct Found {
    /// The surface, judged as the default solver judges its own.
    pub solved: Solved,
    /// The unit of the residuals.
    pub diagonal: f64,
    /// From the base to the given mesh.
    pub levels: Vec<LevelReport>,
    /// [`PaperOptions::laplacian`] lies below what rounding shows, and only that is met.
    pub rounding: bool,
}

/// A level has about this many times the vertices of the one before, where their number is not given.
const GROWTH: f64 = 4.0;
/// The base has this many times the vertices of the boundary, where it is not given: with fewer, the triangles that the
/// boundary's edges force upon it are too thin.
const BASE: f64 = 2.5;
/// Coarse levels only prepare: to this defect,
const COARSE_DEFECT: f64 = 1e-3;
/// and for no longer than this many updates.
const COARSE_UPDATES: usize = 1000;
/// Progress is told after this many splits.
const SPLITS: usize = 512;

/// Fairs the region.
///
/// # Errors
/// [`Collapsed`] where not even the linear surface exists.
pub(crate) fn solve(
    problem: &Problem<'_>,
    options: &PaperOptions,
    control: &mut Control<'_>,
) -> Result<Found, Collapsed> {
    let clock = Instant::now();
    control.stage(0.02, "hierarchy");
    let mut run = Run {
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
    if ended.end == End::Diverged {
        x = linear_start(problem, control)?;
    }
    Ok(Found {
        solved: judged(problem, level, x, &ended, run.start_seconds),
        diagonal: run.diagonal,
        levels: run.levels,
        rounding: ended.end == End::Rounding,
    })
}

/// The scheme under way.
struct Run<'a> {
    problem: &'a Problem<'a>,
    options: &'a PaperOptions,
    levels: Vec<LevelReport>,
    diagonal: f64,
    start_seconds: f64,
}

impl Run<'_> {
    /// Sizes of all levels, the given mesh last.
    fn sizes(&self) -> Vec<usize> {
        let region = self.problem.region;
        let vertices = region.region_vertices();
        let automatic = (BASE * region.boundary as f64).ceil() as usize;
        let base = if self.options.base > 0 {
            self.options.base
        } else {
            automatic
        };
        let base = base.clamp(region.boundary + 1, vertices);
        let fitting = 1 + (vertices as f64 / base as f64).log(GROWTH).round() as usize;
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
        clock: &Instant,
    ) -> Result<Option<Vec<Vector3<f64>>>, Collapsed> {
        let Problem {
            region,
            input,
            boundary_normals,
            ..
        } = *self.problem;
        let sizes = self.sizes();
        let count = region.region_vertices();
        if sizes.len() == 1 || sizes[0] == count {
            return Ok(None);
        }
        let mut progressive = decimate(region, input, sizes[0]);
        let mut normal = vec![Vector3::z(); region.free];
        normal.extend_from_slice(boundary_normals);
        let original = self.problem.weigh.is_some().then_some(input);
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
                    control.stage(0.0, "refining");
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
        clock: &Instant,
    ) -> Result<(), Collapsed> {
        let region = progressive.region(self.problem.input).map_err(|_| Collapsed)?;
        let rings = Rings::new(&region);
        let batches = ValenceBatches::new(&rings);
        let gather = |of: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
            let ids = region.vertex_ids[..region.region_vertices()].iter();
            ids.map(|&v| of[v as usize]).collect()
        };
        let input = gather(self.problem.input);
        let weights = match self.problem.weigh {
            None => FairnessWeights::uniform(),
            Some(weigh) => weigh(&batches, &input),
        };
        let level_problem = Problem {
            region: &region,
            rings: &rings,
            batches: &batches,
            input: &input,
            weights: &weights,
            ..*self.problem
        };
        let mut x = if is_base {
            self.linear_start(&level_problem, clock, control)?
        } else {
            gather(&surface.x)
        };
        let goal = Goal {
            defect: self.options.defect.max(COARSE_DEFECT),
            laplacian: f64::INFINITY,
            updates: COARSE_UPDATES,
        };
        let mut level = Level::new(&level_problem);
        self.iterate(&mut level, &mut x, goal, &level_problem, control);
        level.evaluate(&x);
        for (i, &v) in region.vertex_ids[..region.free].iter().enumerate() {
            surface.x[v as usize] = x[i];
            surface.normal[v as usize] = level.state.normal[i];
        }
        Ok(())
    }

    fn linear_start(
        &mut self,
        problem: &Problem<'_>,
        clock: &Instant,
        control: &mut Control<'_>,
    ) -> Result<Vec<Vector3<f64>>, Collapsed> {
        let x = linear_start(problem, control)?;
        self.diagonal = diagonal(&x);
        self.start_seconds = clock.elapsed().as_secs_f64();
        Ok(x)
    }

    fn iterate(
        &mut self,
        level: &mut Level<'_>,
        x: &mut [Vector3<f64>],
        goal: Goal,
        problem: &Problem<'_>,
        control: &mut Control<'_>,
    ) -> Ended {
        let count = problem.region.region_vertices();
        let is_last = count == self.problem.region.region_vertices();
        let from = 0.05 + 0.25 * count as f64 / self.problem.region.region_vertices() as f64;
        let mut tell = |control: &mut Control<'_>, step: f64, residual: &Residual| {
            let digits = residual.defect.max(goal.defect).log10() / goal.defect.log10();
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
            triangles: problem.region.triangles().len(),
            updates: ended.updates,
            defect: ended.residual.defect,
        });
        ended
    }
}

/// What the surface is worth, by the measures of the default solver.
fn judged(
    problem: &Problem<'_>,
    mut level: Level<'_>,
    x: Vec<Vector3<f64>>,
    ended: &Ended,
    start_seconds: f64,
) -> Solved {
    level.evaluate(&x);
    let surface = Surface {
        region: problem.region,
        x: &x,
        normals: &level.state.corrected,
        boundary_normals: &level.state.corrected[problem.region.free..],
        h: &level.state.h,
    };
    let bounds = Judged {
        state: &level.state,
        right_hand_side: problem.right_hand_side,
        diagonal: diagonal(&x),
    };
    let ending = match ended.end {
        End::Met | End::Rounding if bounds.overshoots() || surface.is_strained() => Ending::Doubtful,
        End::Met | End::Rounding => Ending::Converged,
        End::Spent | End::Stopped => Ending::Stopped,
        End::Diverged => Ending::Failed,
    };
    Solved {
        poor: surface.poor(NEEDLE),
        x,
        ending,
        step: ended.step,
        even: false,
        start_seconds,
    }
}

/// The linear surface of connectivity and boundary data, its vertices distributed by inner fairness.
fn linear_start(problem: &Problem<'_>, control: &mut Control<'_>) -> Result<Vec<Vector3<f64>>, Collapsed> {
    let mut system = problem.system(FreeCurvature::Paper);
    let mut x = system.linear_surface(control)?;
    system.diagonal = diagonal(&x);
    system.tangential_steps(&mut x, control);
    Ok(x)
}
