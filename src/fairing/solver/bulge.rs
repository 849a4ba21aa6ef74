//! The range of the bulge: how far the boundary normals can be turned with a sound surface.

use super::Solver;
use crate::fairing::edit::{Budget, Edit};
use crate::fairing::report::{Progress, ProgressCallback};
use crate::support::error::Error;

/// Trials on the walk outward are this far apart: 10 degrees.
/// Of 3 cases, half: 2 change by up to 0.5 edges, -22 % iterations; double: 2 change by up to 0.9 edges, +4 % iterations.
const STEP: f64 = std::f64::consts::PI / 18.0;
/// Trials end at 90 degrees, where the surface leaves the boundary along its normal.
/// Of 3 cases, half: 2 change by up to 0.4 edges, -19 % iterations; double: 2 change by up to 0.9 edges, +44 % iterations.
const STEPS: u32 = 9;
/// Halvings of the last step: to 1.25 degrees.
/// Of 3 cases, half: 2 change by up to 8e-13 edges; double: 2 change by up to 4e-13 edges.
const HALVINGS: u32 = 3;
/// Evaluations that one trial may cost until it has settled.
/// Of 3 cases, half: 1 changes by up to 5e-13 edges; double: none changes.
const EVALUATIONS: usize = 60;
/// Iterations of one trial from there to the tolerance, with its checks.
/// Half or double, of 3 cases: none changes.
const ITERATIONS: usize = 40;
/// At most so many trials.
/// Half or double, of 1 case: only the progress changes.
const TRIALS: f64 = (2 * (STEPS + HALVINGS)) as f64;
/// The fraction of the progress at which the surface without a bulge is found.
/// Half or double, of 3 regions of 500 to 2,000 vertices: only the progress changes.
const FOUND: f64 = 0.2;

/// What it is called in progress reports.
const PHASE: &str = "range of the bulge";

/// A search under way.
struct Walk<'s, 'p, 'c> {
    solver: &'s mut Solver,
    progress: Option<&'p mut ProgressCallback<'c>>,
    /// The edits that are no bulge.
    others: Vec<Edit>,
    trials: u32,
    is_stopped: bool,
}

impl Solver {
    /// The amounts of [`Edit::Bulge`] between which a sound surface was found, in radians, with the other edits in force: the smallest is
    /// not above 0, the largest not below. They are found by walking outward from the fair surface in steps of 10 degrees up to 90, and are told
    /// to 1.25 degrees. Where there is no sound surface without bulge both are 0. The surface at hand stays; where there is none yet, it is
    /// found first, as by [`finish`](Self::finish). After the callback has asked to stop, the range found until then.
    ///
    /// # Errors
    /// Those of [`run`](Self::run).
    pub fn bulge_range(
        &mut self,
        mut progress: Option<&mut ProgressCallback<'_>>,
    ) -> Result<[f64; 2], Error> {
        let mut is_stopped = false;
        match &mut progress {
            None => self.finish(None)?,
            Some(told) => self.finish(Some(&mut |p| {
                let answer = told(&Progress {
                    fraction: FOUND * p.fraction,
                    ..*p
                });
                is_stopped |= answer.is_break();
                answer
            }))?,
        };
        let before = (self.edited.list.clone(), self.solution.clone());
        let surfaces = self.components.surfaces();
        let others = before.0.iter().filter(|e| !matches!(e, Edit::Bulge { .. }));
        let mut walk = Walk {
            others: others.cloned().collect(),
            solver: self,
            progress,
            trials: 0,
            is_stopped,
        };
        let found = walk.both_ways();
        if found.is_ok() {
            walk.end();
        }
        self.edit(&before.0)?;
        self.components.restore(surfaces);
        self.shown.clone_from(&before.1.positions);
        self.solution = before.1;
        found
    }
}

impl Walk<'_, '_, '_> {
    fn both_ways(&mut self) -> Result<[f64; 2], Error> {
        let mut ends = [0.0; 2];
        if !self.try_amount(0.0)? {
            return Ok(ends);
        }
        let fair = self.solver.components.surfaces();
        for (end, sign) in ends.iter_mut().zip([-1.0, 1.0]) {
            self.solver.components.restore(fair.clone());
            *end = sign * self.outward(sign)?;
        }
        Ok(ends)
    }

    /// The largest amount of this sign.
    fn outward(&mut self, sign: f64) -> Result<f64, Error> {
        let (mut reached, mut beyond) = (0.0, f64::from(STEPS) * STEP);
        for k in 1..=STEPS {
            let amount = f64::from(k) * STEP;
            if self.try_amount(sign * amount)? {
                reached = amount;
            } else {
                beyond = amount;
                break;
            }
        }
        for _ in 0..HALVINGS {
            let amount = (reached + beyond) / 2.0;
            if amount == reached {
                break;
            }
            if self.try_amount(sign * amount)? {
                reached = amount;
            } else {
                beyond = amount;
            }
        }
        Ok(reached)
    }

    /// Goes on from the surface at hand with this bulge. Says whether that led to a sound one; if not, the surface at hand stays.
    fn try_amount(&mut self, amount: f64) -> Result<bool, Error> {
        if !self.goes_on() {
            return Ok(false);
        }
        let before = self.solver.components.surfaces();
        let mut edits = self.others.clone();
        edits.push(Edit::Bulge { amount });
        self.solver.edit(&edits)?;
        let budget = Budget {
            evaluations: EVALUATIONS,
            ..Budget::default()
        };
        let is_sound = self.solver.update(&budget)?.is_settled && {
            let solution = self.solver.run(ITERATIONS, None)?;
            solution.report.outcome.is_success()
        };
        if !is_sound {
            self.solver.components.restore(before);
        }
        Ok(is_sound)
    }

    /// Tells of the next trial.
    fn goes_on(&mut self) -> bool {
        self.trials += 1;
        if let (false, Some(callback)) = (self.is_stopped, &mut self.progress) {
            let told = callback(&Progress {
                fraction: FOUND + (1.0 - FOUND) * (f64::from(self.trials) / TRIALS).min(0.99),
                iterations: self.trials as usize,
                step: self.solver.solution.report.step,
                phase: PHASE,
            });
            self.is_stopped |= told.is_break();
        }
        !self.is_stopped
    }

    /// Tells that the whole is done, unless it was stopped.
    fn end(&mut self) {
        if let (false, Some(callback)) = (self.is_stopped, &mut self.progress) {
            // There is nothing left to be stopped.
            let _ = callback(&Progress {
                fraction: 1.0,
                iterations: self.trials as usize,
                step: self.solver.solution.report.step,
                phase: PHASE,
            });
        }
    }
}
