//! The whole scheme (paper 7.4, Figure 6).

use std::time::Instant;

use nalgebra::Vector3;

use super::estimate::Residual;
use super::iteration::{End, Ended, Goal, Level};
use super::{LevelReport, PaperOptions};
use crate::discrete::equations::FreeCurvature;
use crate::discrete::groups::Groups;
use crate::discrete::inner_fairness::FairnessWeights;
use crate::mesh::{Region, Rings};
use crate::quality::{NEEDLE, Surface};
use crate::solve::globalize::diagonal;
use crate::solve::system::Collapsed;
use crate::solve::{Control, Ending, Solved, System};

/// What is to be faired, in the region's own centred and scaled frame.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    /// The region.
    pub region: &'a Region,
    /// Its rings.
    pub rings: &'a Rings,
    /// The same, transposed.
    pub groups: &'a Groups,
    /// The given mesh.
    pub input: &'a [Vector3<f64>],
    /// Prescribed normals.
    pub border_normals: &'a [Vector3<f64>],
    /// Inner fairness on the given mesh.
    pub weights: &'a FairnessWeights,
}

/// What was found.
#[derive(Debug, Clone)]
pub struct Found {
    /// The surface, judged as the default solver judges its own.
    pub solved: Solved,
    /// The unit of the residuals.
    pub diagonal: f64,
    /// From the base to the given mesh.
    pub levels: Vec<LevelReport>,
    /// [`PaperOptions::laplacian`] lies below what rounding shows, and only that is met.
    pub rounding: bool,
}

/// Fairs the region.
///
/// # Errors
/// [`Collapsed`] where not even the linear surface exists.
pub fn solve(
    problem: &Problem<'_>,
    options: &PaperOptions,
    control: &mut Control<'_>,
) -> Result<Found, Collapsed> {
    let clock = Instant::now();
    control.stage(0.05, "start surface");
    let mut x = linear_start(problem)?;
    let start_seconds = clock.elapsed().as_secs_f64();
    let diagonal = diagonal(&x);
    let goal = Goal {
        defect: options.defect,
        laplacian: options.laplacian,
        updates: usize::MAX,
    };
    let mut level = Level::new(
        problem.rings,
        problem.groups,
        problem.border_normals,
        problem.weights,
    );
    let mut tell = |control: &mut Control<'_>, step: f64, residual: &Residual| {
        let digits = residual.defect.max(goal.defect).log10() / goal.defect.log10();
        control.update(0.3 + 0.69 * digits.clamp(0.0, 1.0), step, "fairing");
    };
    let ended = level.iterate(&mut x, options, (goal, diagonal), control, &mut tell);
    let levels = vec![LevelReport {
        vertices: problem.region.region_vertices(),
        triangles: problem.region.triangles().len(),
        updates: ended.updates,
        defect: ended.residual.defect,
    }];
    if ended.end == End::Diverged {
        x = linear_start(problem)?;
    }
    Ok(Found {
        solved: judged(problem, level, x, &ended, start_seconds),
        diagonal,
        levels,
        rounding: ended.end == End::Rounding,
    })
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
        border_normals: problem.border_normals,
        h: &level.state.h,
    };
    let ending = match ended.end {
        End::Met | End::Rounding if surface.is_doubtful(diagonal(&x)) => Ending::Doubtful,
        End::Met | End::Rounding => Ending::Converged,
        End::Spent | End::Stopped => Ending::Stopped,
        End::Diverged => Ending::Failed,
    };
    Solved {
        poor: surface.poor(NEEDLE),
        x,
        ending,
        step: ended.step,
        start_seconds,
    }
}

/// The linear surface of connectivity and border data, its vertices distributed by inner fairness.
fn linear_start(problem: &Problem<'_>) -> Result<Vec<Vector3<f64>>, Collapsed> {
    let mut system = System::new(
        problem.region,
        problem.rings,
        problem.groups,
        problem.input,
        problem.border_normals.to_vec(),
        problem.weights.clone(),
        FreeCurvature::Paper,
    );
    let mut x = system.linear_surface()?;
    system.diagonal = diagonal(&x);
    system.tangential_steps(&mut x);
    Ok(x)
}
