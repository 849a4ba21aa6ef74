//! Continuation in the right-hand side, from the harmonic surface to the asked one. Where it stalls short of the end, no
//! surface with this right-hand side was found on this branch.

use nalgebra::Vector3;

use super::candidate::Candidate;
use super::control::Control;
use super::formulation::Formulation;
use super::iterate_options::IterateOptions;
use super::result::SolveStatus;
use super::system::System;
use crate::solve::transition::Transition;

/// The first part of the right-hand side after none.
/// Of 4 cases, half: 0 change, -6 % iterations; double: 0 change, +8 % iterations.
const FIRST_STEP: f64 = 0.25;
/// A step shorter than this fraction of the way is not tried.
/// Of 4 cases, half: 0 change, +17 % iterations; double: 0 change, -16 % iterations.
const SHORTEST: f64 = 1.0 / 64.0;

/// The way to the whole right-hand side.
#[derive(Debug)]
pub(crate) struct TargetContinuation {
    /// With the whole right-hand side.
    formulation: Formulation,
    /// On the way; the whole is iterated to the asked tolerance.
    options: IterateOptions,
    /// The last surface reached; `None`: the harmonic one is not there yet.
    x: Option<Vec<Vector3<f64>>>,
    /// The part of the right-hand side reached.
    reached: f64,
    /// The part that is tried.
    tried: f64,
    step: f64,
}

impl TargetContinuation {
    /// Begins with the harmonic surface.
    pub(crate) fn begin(
        formulation: Formulation,
        x: Vec<Vector3<f64>>,
        options: IterateOptions,
        system: &System,
        control: &Control<'_>,
    ) -> (Self, Transition) {
        let harmonic = formulation.part(0.0);
        let continuation = Self {
            formulation,
            options,
            x: None,
            reached: 0.0,
            tried: 0.0,
            step: FIRST_STEP,
        };
        (
            continuation,
            Transition::iterate(system, harmonic, x, options, control),
        )
    }

    /// After the iteration with the part that was tried.
    pub(crate) fn next(&mut self, last: Candidate, system: &System, control: &Control<'_>) -> Transition {
        if self.tried >= 1.0 && (last.is_converged() && !last.is_flawed() || last.is_stopped()) {
            return Transition::Done(last);
        }
        match &mut self.x {
            None => {
                if !last.is_converged() {
                    self.step = 0.0;
                }
                self.x = Some(last.x);
            }
            Some(x) if last.is_converged() && !last.is_flawed() => {
                *x = last.x;
                self.reached = self.tried;
                self.step *= 2.0;
            }
            Some(_) => self.step *= 0.5,
        }
        match &self.x {
            Some(x) if self.step >= SHORTEST && !control.exhausted() => {
                let x = x.clone();
                self.iterate(x, system, control)
            }
            _ if self.reached > 0.0 => Transition::Short(SolveStatus::TargetNotReached(self.reached)),
            _ => Transition::Short(SolveStatus::Failed),
        }
    }

    /// One step further from `x`.
    fn iterate(&mut self, x: Vec<Vector3<f64>>, system: &System, control: &Control<'_>) -> Transition {
        self.tried = (self.reached + self.step).min(1.0);
        let options = if self.tried >= 1.0 {
            self.options.to_the_end()
        } else {
            self.options
        };
        Transition::iterate(system, self.formulation.part(self.tried), x, options, control)
    }
}
