//! The search on the coarse mesh: a solve of its own, whose surface is where the one on the fine mesh begins.

use fairmesh_linear::interrupt::unless_stopped;

use super::Ladder;
use crate::solve::attempt::COARSE;
use crate::solve::coarse::CoarseLevel;
use crate::solve::coarse_result::CoarseResult;
use crate::solve::control::{Control, SEARCHED};
use crate::solve::initial::PHASE;
use crate::solve::result::{SolveStatus, Trial};
use crate::solve::system::System;
use crate::support::stopwatch::Stopwatch;

/// Iterations there.
/// Half or double, of 10 cases: none changes.
const ITERATIONS: usize = 600;

impl Ladder {
    /// Searches the coarse mesh, where there is one, once: attempts on this mesh begin where that has led to.
    pub(super) fn search_coarse_mesh(&mut self, system: &System, control: &mut Control<'_>) {
        if self.coarse.is_some() {
            return;
        }
        let clock = Stopwatch::start();
        let (search, trials) = searched(system, control);
        if let CoarseResult::Missed { status, .. } = &search
            && status.is_least_bending()
        {
            self.shortfall = Some(status.clone());
        }
        self.coarse = Some(search);
        self.trials.extend(trials);
        self.start_seconds += clock.seconds();
    }
}

/// What the coarse mesh has led to, and what was tried there.
fn searched(system: &System, control: &mut Control<'_>) -> (CoarseResult, Vec<Trial>) {
    let fine = system.problem();
    let Some(level) = unless_stopped(|| CoarseLevel::new(&fine)).flatten() else {
        return (CoarseResult::NoCoarseMesh, Vec::new());
    };
    let solved = control.within((PHASE, SEARCHED), COARSE, ITERATIONS, |control| {
        let ladder = Ladder {
            coarse: Some(CoarseResult::NoCoarseMesh),
            is_search: true,
            ..Ladder::default()
        };
        ladder.solve(&level.problem(&fine), control)
    });
    let Ok((mut result, state)) = solved else {
        let missed = CoarseResult::Missed {
            status: SolveStatus::Failed,
            x: None,
        };
        return (missed, Vec::new());
    };
    let trials = std::mem::take(&mut result.trials);
    let x = level.prolongate(&fine, &result.x, &state.corrected);
    let member = match result.status {
        SolveStatus::Converged | SolveStatus::AboveTolerance => 0.0,
        SolveStatus::NearestMember(w) => w,
        status => return (CoarseResult::Missed { status, x: Some(x) }, trials),
    };
    let found = CoarseResult::Found {
        x,
        member,
        along_normals: result.along_normals,
    };
    (found, trials)
}
