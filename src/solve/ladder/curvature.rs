//! From the tangent-continuous surface to the one that continues the curvature. The way begins as soon as an iteration is near enough to tell
//! where it leads, and what is to be continued there; where it comes nowhere, that iteration goes on.

use super::{Ladder, LadderState};
use crate::solve::attempt::LADDER;
use crate::solve::candidate::Candidate;
use crate::solve::control::Control;
use crate::solve::factor::Collapsed;
use crate::solve::formulation::Formulation;
use crate::solve::g2::boundary_curvature::LoopCondition;
use crate::solve::g2::continuation::{Continuation, Ended, as_they_are, conditions, is_nothing};
use crate::solve::iterate_options::{IterateOptions, IterationStatus};
use crate::solve::quasi_newton::Iteration;
use crate::solve::result::{SolveResult, SolveStatus};
use crate::solve::system::System;
use crate::solve::transition::Transition;

/// The step norm, in tolerances, from which on the surface tells its curvature along the loops. From further off, results would depend on the way there by
/// more than rounding: at 1,000 a torus of 1,000 vertices moved by 2e-11 of itself where it lies elsewhere. Seconds over those without, ellipsoid,
/// 14,000 and 100,000 vertices: 2.1, 1.9; half: 2.2, 1.9; double: 2.1, 1.9.
const NEAR: f64 = 100.0;

impl Ladder {
    /// Lets an iteration pause where curvature is to be continued from what it leads to.
    pub(super) fn let_pause(&self, iteration: &mut Iteration, system: &System, control: &Control<'_>) {
        if system.asked_continuity().is_some() && LADDER[self.attempts - 1].solves_what_is_asked() {
            iteration.pause_at(NEAR * control.tolerance);
        }
    }

    /// Looks at the curvature along the loops where the iteration has paused, and sets out from there if there is something to continue
    /// and the surface is sound.
    pub(super) fn look_at_curvature(&mut self, system: &mut System, control: &mut Control<'_>) {
        let Some(iteration) = &mut self.iteration else {
            return;
        };
        iteration.evaluate_at_hand(system);
        let Some(loops) = conditions(iteration.x(), system) else {
            return;
        };
        if is_nothing(&loops) {
            self.looked_at = Some(loops);
            return;
        }
        let candidate = iteration.candidate(IterationStatus::Converged, system);
        if !candidate.is_sound() || self.sound.is_some() || self.looks_for_rivals(&candidate) {
            return;
        }
        self.note(&Transition::Done(candidate.clone()), system, control);
        let linear = self.linear.take();
        let tangent = self.result(Some(candidate.clone()), SolveStatus::Converged, system, control);
        self.linear = linear;
        // Two histories would take too much memory.
        self.paused = self.iteration.take().map(|iteration| iteration.options());
        self.set_out((tangent, candidate), loops, system, control);
    }

    /// From the surface that was found.
    pub(super) fn continue_curvature(
        &mut self,
        tangent: SolveResult,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Result<LadderState, Collapsed> {
        let is_harmonic = matches!(
            tangent.status,
            SolveStatus::Converged | SolveStatus::ConvergedToRounding | SolveStatus::AboveTolerance
        );
        if !is_harmonic || control.exhausted() {
            return Ok(LadderState::Ended(tangent));
        }
        if let Some(loops) = self.looked_at.take() {
            return Ok(LadderState::Ended(left_as_it_is(tangent, &loops, system)));
        }
        let Some(loops) = conditions(&tangent.x, system) else {
            return Ok(LadderState::Ended(tangent));
        };
        if is_nothing(&loops) {
            return Ok(LadderState::Ended(left_as_it_is(tangent, &loops, system)));
        }
        let formulation = self.formulation_of(&tangent, system);
        let x = tangent.x.clone();
        let judged = Candidate::new(system, &formulation, x, IterationStatus::Converged, tangent.step);
        self.set_out((tangent, judged), loops, system, control);
        self.run(system, control)
    }

    fn set_out(
        &mut self,
        tangent: (SolveResult, Candidate),
        loops: Vec<LoopCondition>,
        system: &mut System,
        control: &mut Control<'_>,
    ) {
        let formulation = self.formulation_of(&tangent.0, system);
        let continuation = Continuation::new(tangent, loops, formulation, system, control);
        self.continuation = Some(continuation);
    }

    /// What that surface solves.
    fn formulation_of(&self, tangent: &SolveResult, system: &System) -> Formulation {
        Formulation {
            along_normals: tangent.along_normals,
            ..self.left(system)
        }
    }

    /// Goes on with the continuation. `None`: it came nowhere from where an iteration had paused, which is to go on.
    pub(super) fn run_continuation(
        &mut self,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Option<LadderState> {
        let ended = match self.continuation.as_mut()?.run(system, control) {
            None => return Some(LadderState::Held),
            Some(ended) => ended,
        };
        self.continuation = None;
        match ended {
            Ended::Continued(result) => Some(LadderState::Ended(result)),
            Ended::Nowhere(tangent) => {
                let loops = system.end_continuity().unwrap_or_default();
                let Some(options) = self.paused.take() else {
                    return Some(LadderState::Ended(left_as_it_is(tangent, &loops, system)));
                };
                let options = IterateOptions {
                    reuse_factor: false,
                    ..options
                };
                let formulation = self.formulation_of(&tangent, system);
                let iteration = Iteration::new(system, formulation, tangent.x, options, control);
                self.iteration = Some(Box::new(iteration));
                self.looked_at = Some(loops);
                self.trials = tangent.trials;
                self.iterations = control.tally.iterations;
                None
            }
        }
    }
}

/// The tangent-continuous surface, which was evaluated last, where curvature is not continued.
fn left_as_it_is(tangent: SolveResult, loops: &[LoopCondition], system: &System) -> SolveResult {
    SolveResult {
        continuity: as_they_are(loops, &tangent.x, system),
        ..tangent
    }
}
