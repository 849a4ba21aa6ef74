//! A coarse patch, faired loosely: where the fine one is laid out.

use fairmesh_linear::interrupt::is_stopped;

use super::patch::Patch;
use super::refine::Refiner;
use crate::fairing::{BoundaryNormals, Options, Progress, ProgressCallback};
use crate::holes::patch_surface::{COARSE_SHARE, Task, is_failed};

/// The coarse patch's edges grow by this much per unit of distance from the boundary.
/// Of 32 cases, half: 25 change, 24 get another triangulation, -5 % iterations;
/// double: 25 change, 23 get another triangulation, -8 % iterations.
const COARSE_GROWTH: f64 = 0.5;
/// Between loops more of them are needed: what is far from all of them is narrow all the same.
/// Half or double, of 10 cases: 9 change, 8 get another triangulation, +1 % iterations, 1 fails.
const JOINT_GROWTH: f64 = 0.25;
/// Iterations in which the coarse patch of several loops is faired.
/// Of 10 cases, half: 2 change, 1 get another triangulation, +2 % iterations, 1 fails; double: 1 changes, 1 get another triangulation.
const JOINT_ITERATIONS: usize = 150;
/// Rounds of layout and fairing of that patch.
/// Of 10 cases, half: 9 change, 8 get another triangulation, 1 more succeeds;
/// double: 9 change, 8 get another triangulation, +2 % iterations, 1 fails.
const JOINT_ROUNDS: u32 = 2;
/// The tolerance to which the coarse patch is faired.
/// Of 41 cases, half: 7 change by up to 0.001 edges, 5 get another triangulation;
/// double: 9 change by up to 4e-4 edges, 6 get another triangulation, 1 fails.
const COARSE_TOLERANCE: f64 = 1e-3;
/// Iterations in which the coarse patch of one loop is faired.
/// Of 32 cases, half: 3 change, 2 get another triangulation; double: 2 change.
const COARSE_ITERATIONS: usize = 30;

/// First growth of edges away from the boundary, per length, when the vertices do not suffice.
/// Half or double, of 1 case: none changes.
const FIRST_GROWTH: f64 = 0.02;
/// Last growth of edges when the vertices do not suffice.
/// Half or double, of 41 cases: none changes.
const LAST_GROWTH: f64 = 3.0;

impl Task<'_> {
    /// Refines to the end; coarser inside if the vertices do not suffice. False: they did not. Where the run is stopped the patch stays
    /// as it is.
    pub(super) fn refine(&self, patch: &mut Patch) -> bool {
        self.refine_telling(patch, &mut |_| ())
    }

    /// The same; `tell` gets how far it is, never falling.
    pub(super) fn refine_telling(&self, patch: &mut Patch, tell: &mut dyn FnMut(f64)) -> bool {
        let mut growth = 0.0;
        let mut reached = 0.0_f64;
        let mut tell = |fraction: f64| {
            reached = reached.max(fraction);
            tell(reached);
        };
        loop {
            let fineness = self.fineness(growth);
            let mut refined = patch.clone();
            let mut refiner =
                Refiner::new(&mut refined, fineness, &self.surroundings.taken).telling(&mut tell);
            let is_last = growth > LAST_GROWTH;
            let enough = match is_last {
                true => refiner.run_to_end(),
                false => refiner.run(),
            };
            if is_stopped() {
                return true;
            }
            if enough || is_last {
                *patch = refined;
                return growth == 0.0;
            }
            growth = if growth == 0.0 { FIRST_GROWTH } else { 2.0 * growth };
        }
    }

    /// The same between loops. That their triangulation has few vertices where the surface is wide does not matter only if it is
    /// found; then it is laid out once more.
    pub(super) fn shape_joint(&self, patch: &mut Patch, tell: &mut ProgressCallback<'_>) {
        let rough = Options {
            tolerance: COARSE_TOLERANCE,
            max_iterations: self.options.max_iterations.max(JOINT_ITERATIONS),
            continuity: 0.0,
            boundary_normals: match &self.options.boundary_normals {
                BoundaryNormals::Fitted => BoundaryNormals::Averaged,
                other => other.clone(),
            },
            ..self.options.clone()
        };
        for round in 1..=JOINT_ROUNDS {
            let mut shaped = patch.clone();
            let fineness = self.fineness(JOINT_GROWTH);
            Refiner::new(&mut shaped, fineness, &self.surroundings.taken).run_to_end();
            if shaped.x.len() == shaped.fixed {
                return;
            }
            let mut part = |p: &Progress| {
                tell(&Progress {
                    fraction: COARSE_SHARE * (f64::from(round - 1) + p.fraction) / f64::from(JOINT_ROUNDS),
                    ..*p
                })
            };
            let Ok(solution) = self.faired(&shaped, &rough, &mut part) else {
                return;
            };
            let inner = self.inner(&solution);
            let is_sound = self.outside(&inner).is_empty() && solution.report.quality.flipped.is_empty();
            if is_failed(&solution.report) || !is_sound {
                return;
            }
            shaped.x[shaped.fixed..].copy_from_slice(&inner);
            *patch = shaped;
        }
    }

    /// Moves a patch near to the surface it will become: coarse, and faired loosely.
    pub(super) fn shape(&self, patch: &mut Patch, tell: &mut ProgressCallback<'_>) {
        let fineness = self.fineness(COARSE_GROWTH);
        let mut shaped = patch.clone();
        Refiner::new(&mut shaped, fineness, &self.surroundings.taken).run_to_end();
        if shaped.x.len() == shaped.fixed {
            return;
        }
        let mut first = |p: &Progress| {
            tell(&Progress {
                fraction: COARSE_SHARE * p.fraction,
                ..*p
            })
        };
        let mut rough = Options {
            tolerance: COARSE_TOLERANCE,
            max_iterations: COARSE_ITERATIONS,
            // Where the coarse vertices lie does not depend on it much.
            continuity: 0.0,
            ..self.options.clone()
        };
        if rough.boundary_normals == BoundaryNormals::Fitted {
            // Averages are cheap and good enough here.
            rough.boundary_normals = BoundaryNormals::Averaged;
        }
        let solution = self.faired(&shaped, &rough, &mut first);
        if let Ok(solution) = solution {
            let inner = self.inner(&solution);
            if self.outside(&inner).is_empty() && solution.report.quality.flipped.is_empty() {
                shaped.x[shaped.fixed..].copy_from_slice(&inner);
                *patch = shaped;
            }
        }
    }
}
