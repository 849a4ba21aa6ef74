//! The search on the coarse mesh, whose surface is where the fine one begins.

use nalgebra::Vector3;

use super::coarse::CoarseLevel;
use super::control::{Control, SEARCHED};
use super::initial::PHASE;
use super::result::{SolveStatus, Trial};
use super::system::System;

/// Step norm of surfaces on the coarse mesh: it is smaller than what lies between both meshes.
const TOLERANCE: f64 = 1e-4;
/// Iterations there.
const ITERATIONS: usize = 600;

/// What the coarse mesh has led to.
#[derive(Debug)]
pub(super) enum Search {
    /// There is none.
    NoCoarseMesh,
    /// A surface.
    Found {
        /// On the fine mesh.
        x: Vec<Vector3<f64>>,
        /// The member of the family that it is: 0 for what is asked.
        member: f64,
        /// Found along the normals alone.
        along_normals: bool,
    },
    /// None, for this reason.
    Missed(SolveStatus),
}

impl Search {
    /// Searches the coarse mesh, if there is one. Returns what was tried, too.
    pub(super) fn of_coarse_mesh(system: &System, control: &mut Control<'_>) -> (Self, Vec<Trial>) {
        let fine = system.problem();
        let Some(level) = CoarseLevel::new(&fine) else {
            return (Self::NoCoarseMesh, Vec::new());
        };
        let found = control.within((PHASE, SEARCHED), TOLERANCE, ITERATIONS, |control| {
            super::solve_on_coarsest(&level.problem(&fine), control)
        });
        let Ok((mut result, state)) = found else {
            return (Self::Missed(SolveStatus::Failed), Vec::new());
        };
        let trials = std::mem::take(&mut result.trials);
        let member = match result.status {
            SolveStatus::Converged | SolveStatus::AboveTolerance => 0.0,
            SolveStatus::NearestMember(w) => w,
            status => return (Self::Missed(status), trials),
        };
        let found = Self::Found {
            x: level.prolongate(&fine, &result.x, &state.corrected),
            member,
            along_normals: result.along_normals,
        };
        (found, trials)
    }
}
