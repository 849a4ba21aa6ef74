//! The loop over [`LADDER`]: attempt after attempt, until a sound surface is found or none is left. Where the run is held up between two
//! iterations, the next call goes on as if nothing had been.

mod coarse_search;
mod curvature;
mod starts;

use fairmesh_linear::interrupt::unless_stopped;
use nalgebra::Vector3;

use super::attempt::{Kept, LADDER, Rung, Start};
use super::candidate::Candidate;
use super::coarse_result::CoarseResult;
use super::control::{ANALYSED, Control, ITERATED};
use super::factor::Collapsed;
use super::formulation::Formulation;
use super::initial;
use super::iterate_options::{IterateOptions, IterationStatus};
use super::problem::Problem;
use super::procedure::Underway;
use super::quasi_newton::Iteration;
use super::result::{SolveResult, SolveStatus, Trial};
use super::system::System;
use crate::discrete::equations::State;
use crate::quality::NEEDLE;
use crate::solve::g2::boundary_curvature::LoopCondition;
use crate::solve::g2::continuation::Continuation;
use crate::solve::transition::Transition;
use crate::support::stopwatch::Stopwatch;

/// What a call of [`Ladder::run`] has led to.
#[derive(Debug)]
pub(crate) enum LadderState {
    /// Held up: to be called again.
    Held,
    /// The end. The system stands evaluated at the surface.
    Ended(SolveResult),
    /// Stopped by the caller before there was a surface.
    Unmoved,
}

/// A solve under way.
#[derive(Debug, Default)]
pub(crate) struct Ladder {
    /// A surface to go on from.
    at_hand: Option<Vec<Vector3<f64>>>,
    /// The linear surface, once it is needed.
    linear: Option<Vec<Vector3<f64>>>,
    /// The surface of least bending and its inner fairness, once they are needed.
    least_bending: Option<(Vec<Vector3<f64>>, Formulation)>,
    /// The surface of smallest step norm at which an attempt at the solution has stalled since the last one along the normals, and that
    /// step norm.
    stalled: Option<(Vec<Vector3<f64>>, f64)>,
    /// The surface of minimal energy, if there is one.
    minimal_energy: Option<Vec<Vector3<f64>>>,
    /// What the coarse mesh has led to, once it was asked.
    coarse: Option<CoarseResult>,
    /// What was tried so far,
    trials: Vec<Trial>,
    /// and the iterations until then.
    iterations: usize,
    /// A sound surface, while another one is looked for that may be better,
    sound: Option<Candidate>,
    /// the iterations that led to it,
    until_sound: usize,
    /// and those that led to none better.
    in_vain: usize,
    /// Attempts begun or passed over.
    attempts: usize,
    underway: Option<Underway>,
    iteration: Option<Box<Iteration>>,
    /// The best of what has met the tolerance without being sound.
    fallback: Option<Candidate>,
    /// How far the first continuation came that came anywhere.
    shortfall: Option<SolveStatus>,
    /// The surface found is the start on another mesh.
    is_search: bool,
    /// The formulation of the last attempt; none: that which is asked for.
    left: Option<Formulation>,
    start_seconds: f64,
    /// To the curvature-continuous surface, once this one is found,
    continuation: Option<Continuation>,
    /// or where an iteration has paused, which goes on like this if that leads nowhere.
    paused: Option<IterateOptions>,
    /// What holds along the loops, where the iteration under way was looked at and there was nothing to continue, or no way.
    looked_at: Option<Vec<LoopCondition>>,
}

impl Ladder {
    /// A solve that goes on from a surface that solved a problem close to this one, with the matrices that are there and the inner fairness
    /// that this one has left; where that leads to no sound surface, it begins at the beginning.
    pub(crate) fn resumed(self, x: Vec<Vector3<f64>>) -> Self {
        Self {
            at_hand: Some(x),
            left: self.left,
            ..Self::default()
        }
    }

    /// The same after a surface along the normals alone, or not.
    pub(crate) fn resumed_after(mut self, result: &SolveResult) -> Self {
        if let Some(left) = &mut self.left {
            left.along_normals = result.along_normals;
        }
        self.resumed(result.x.clone())
    }

    /// A solve of another problem close to this one, from where this one stands.
    pub(crate) fn renewed(mut self) -> Self {
        let iterated = self.x().map(<[_]>::to_vec);
        match iterated.or(self.at_hand.take()) {
            Some(x) => self.resumed(x),
            None => Self::default(),
        }
    }

    /// The surface to go on from, before that is begun.
    pub(crate) fn at_hand(&self) -> Option<&[Vector3<f64>]> {
        self.at_hand.as_deref()
    }

    /// The surface at hand; none before the first iteration.
    pub(crate) fn x(&self) -> Option<&[Vector3<f64>]> {
        let continued = self.continuation.as_ref().map(Continuation::x);
        continued.or_else(|| self.iteration.as_ref().map(|iteration| iteration.x()))
    }

    /// Evaluates both equations at the surface at hand.
    pub(crate) fn evaluate_at_hand(&mut self, system: &mut System) {
        match (&mut self.continuation, &mut self.iteration) {
            (Some(continuation), _) => continuation.evaluate_at_hand(system),
            (None, Some(iteration)) => iteration.evaluate_at_hand(system),
            (None, None) => {}
        }
    }

    /// What the surface at hand is iterated to.
    pub(crate) fn formulation(&self, system: &System) -> Formulation {
        let iterated = self
            .iteration
            .as_ref()
            .map(|iteration| iteration.formulation().clone());
        iterated.unwrap_or_else(|| self.left(system))
    }

    /// What is asked for, with the inner fairness that the last attempt has left.
    pub(crate) fn left(&self, system: &System) -> Formulation {
        let left = self.left.as_ref().unwrap_or(system.asked()).clone();
        Formulation {
            right_hand_side: system.asked().right_hand_side,
            ..left
        }
    }

    /// The whole of it, without being held up. Returns the surface, and its evaluation.
    ///
    /// # Errors
    /// As [`Self::run`].
    pub(crate) fn solve(
        mut self,
        problem: &Problem<'_>,
        control: &mut Control<'_>,
    ) -> Result<(SolveResult, State), Collapsed> {
        if !control.phase(0.01, initial::PHASE) {
            return Ok(problem.unmoved());
        }
        let clock = Stopwatch::start();
        let Some(mut system) = unless_stopped(|| System::new(problem)) else {
            return Ok(problem.unmoved());
        };
        let analysis_seconds = clock.seconds();
        control.phase(ANALYSED, initial::PHASE);
        Ok(match self.run(&mut system, control)? {
            LadderState::Ended(mut result) => {
                result.start_seconds += analysis_seconds;
                control.phase(ITERATED, "checks");
                (result, system.into_state())
            }
            LadderState::Held | LadderState::Unmoved => problem.unmoved(),
        })
    }

    /// To the end: the search on the coarse mesh, attempts until there is a surface, and from that the one that continues the curvature,
    /// where that is asked for.
    ///
    /// # Errors
    /// [`Collapsed`] where not even the linear surface exists.
    pub(crate) fn run(
        &mut self,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Result<LadderState, Collapsed> {
        if self.continuation.is_some() {
            if let Some(state) = self.run_continuation(system, control) {
                return Ok(state);
            }
        } else {
            system.end_continuity();
        }
        let tangent = loop {
            let next = match (&mut self.iteration, &mut self.underway) {
                (Some(iteration), Some(underway)) => {
                    let Some(status) = iteration.run(system, control) else {
                        return Ok(LadderState::Held);
                    };
                    if status == IterationStatus::Paused {
                        self.look_at_curvature(system, control);
                        if self.continuation.is_some() {
                            return self.run(system, control);
                        }
                        continue;
                    }
                    let candidate = iteration.candidate(status, system);
                    underway.next(candidate, system, control)
                }
                _ => match self.next_attempt(system, control)? {
                    Some(next) => next,
                    None if self.sound.is_some() => break self.settle(system, control),
                    None if self.linear.is_none() => return Ok(LadderState::Unmoved),
                    None => break self.give_up(system, control),
                },
            };
            self.note(&next, system, control);
            self.keep_stalled(&next);
            match next {
                Transition::Iteration(mut iteration) => {
                    self.left = Some(iteration.formulation().clone());
                    self.looked_at = None;
                    self.let_pause(&mut iteration, system, control);
                    self.iteration = Some(iteration);
                }
                Transition::Done(candidate) => {
                    self.underway = None;
                    if let Some((candidate, status)) = self.consider(candidate, control) {
                        // A surface that meets the tolerance is better than one that the iterations did not suffice for.
                        if candidate.is_stopped() && !control.cancelled && self.fallback.is_some() {
                            break self.give_up(system, control);
                        }
                        break self.result(Some(candidate), status, system, control);
                    }
                }
                Transition::Member(candidate, w) => {
                    break self.result(Some(candidate), SolveStatus::NearestMember(w), system, control);
                }
                Transition::Short(status) => {
                    self.underway = None;
                    if status != SolveStatus::Failed {
                        self.shortfall.get_or_insert(status);
                    }
                }
            }
        };
        self.continue_curvature(tangent, system, control)
    }

    /// Keeps in mind how an attempt has ended.
    fn note(&mut self, next: &Transition, system: &System, control: &Control<'_>) {
        let candidate = match next {
            Transition::Iteration(_) => return,
            Transition::Done(candidate) | Transition::Member(candidate, _) => Some(candidate),
            Transition::Short(_) => None,
        };
        let iterations = control.tally.iterations;
        self.trials.push(Trial {
            free: system.free(),
            name: LADDER[self.attempts - 1].name,
            iterations: iterations - self.iterations,
            ended: candidate.map(Candidate::end),
            bending_energy: candidate.map_or(f64::NAN, |c| c.bending_energy),
        });
        self.iterations = iterations;
    }

    /// Keeps the surface of an attempt at what is asked that stalled nearest to a solution.
    fn keep_stalled(&mut self, next: &Transition) {
        let attempt = &LADDER[self.attempts - 1];
        if let Transition::Done(candidate) = next
            && attempt.kept == Kept::Result
            && candidate.status == IterationStatus::Stalled
            && !candidate.formulation.along_normals
            && self
                .stalled
                .as_ref()
                .is_none_or(|(_, step)| candidate.step < *step)
        {
            self.stalled = Some((candidate.x.clone(), candidate.step));
        }
    }

    /// What was tried so far, on the coarse mesh too.
    pub(crate) fn trials(&self) -> &[Trial] {
        &self.trials
    }

    /// Begins the next attempt whose condition holds and that has a start. `None`: there is none, or the run was stopped
    /// while the linear surface was made.
    fn next_attempt(
        &mut self,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Result<Option<Transition>, Collapsed> {
        if self.at_hand.is_none() {
            self.search_coarse_mesh(system, control);
        }
        while let Some(attempt) = LADDER.get(self.attempts) {
            self.attempts += 1;
            if !self.is_due(attempt, system, control) {
                continue;
            }
            if attempt.start == Start::Linear && !self.make_linear(system, control)? {
                return Ok(None);
            }
            if let Some((x, formulation)) = self.set_up(attempt, system, control) {
                control.begin_attempt();
                let (underway, next) =
                    attempt
                        .procedure
                        .begin(formulation, x, attempt.options, self.member(), system, control);
                self.underway = Some(underway);
                return Ok(Some(next));
            }
        }
        Ok(None)
    }

    /// Whether an attempt is to be made.
    fn is_due(&self, attempt: &Rung, system: &System, control: &Control<'_>) -> bool {
        // Beside a sound surface only those that may find another one.
        let is_rival = match attempt.start {
            Start::LeastBending => attempt.kept == Kept::Result,
            Start::BesideSound => true,
            _ => false,
        };
        let is_coarsest = matches!(self.coarse, Some(CoarseResult::NoCoarseMesh));
        // The coarse mesh has looked for others far off.
        let is_rival = is_rival && (is_coarsest || attempt.start == Start::BesideSound);
        if self.sound.is_some() && !is_rival {
            return false;
        }
        attempt.condition.holds(system, control)
    }

    /// The member of the family that the coarse mesh has.
    fn member(&self) -> f64 {
        match self.coarse {
            Some(CoarseResult::Found { member, .. }) => member,
            _ => 0.0,
        }
    }

    /// What becomes of an attempt's surface. Returns it if nothing else is to be tried.
    fn consider(&mut self, candidate: Candidate, control: &Control<'_>) -> Option<(Candidate, SolveStatus)> {
        let kept = LADDER[self.attempts - 1].kept;
        if kept == Kept::Start && !candidate.is_stopped() {
            self.minimal_energy =
                (candidate.is_converged() && candidate.poor.is_empty()).then_some(candidate.x);
        } else if candidate.is_settled() || self.is_search && candidate.is_good_start() {
            return Some((self.best_of(candidate, control)?, SolveStatus::Converged));
        } else if kept != Kept::Start && candidate.is_at_rounding() {
            return Some((candidate, SolveStatus::AboveTolerance));
        } else if kept != Kept::Sound && candidate.is_converged() {
            // Of equals the first.
            let best = self.fallback.as_ref().map(Candidate::rank);
            if best.is_none_or(|best| candidate.rank() < best) {
                self.fallback = Some(candidate);
            }
        }
        None
    }

    /// Of two sound surfaces the one of less bending energy; the first one alone where it may be the only one.
    fn best_of(&mut self, found: Candidate, control: &Control<'_>) -> Option<Candidate> {
        let Some(first) = self.sound.take() else {
            if self.looks_for_rivals(&found) {
                self.sound = Some(found);
                self.until_sound = control.tally.iterations;
                return None;
            }
            return Some(found);
        };
        if found.is_stopped() {
            self.in_vain = control.tally.iterations - self.until_sound;
            return Some(first);
        }
        let is_better = found.is_better_than(&first);
        if is_better {
            self.until_sound = control.tally.iterations;
        }
        self.sound = Some(if is_better { found } else { first });
        None
    }

    /// Whether a surface may be one of several.
    fn looks_for_rivals(&self, found: &Candidate) -> bool {
        let is_new = LADDER[self.attempts - 1].start != Start::AtHand;
        is_new && found.is_converged() && found.may_have_rival
    }

    /// The sound surface that no other one was found to be better than.
    fn settle(&mut self, system: &mut System, control: &Control<'_>) -> SolveResult {
        self.in_vain = control.tally.iterations - self.until_sound;
        let candidate = self.sound.take();
        self.result(candidate, SolveStatus::Converged, system, control)
    }

    /// After the last attempt: the best of what there is.
    fn give_up(&mut self, system: &mut System, control: &Control<'_>) -> SolveResult {
        let candidate = self.fallback.take();
        let status = match &candidate {
            Some(candidate) if candidate.has_bump() => SolveStatus::Bump,
            Some(_) => SolveStatus::Converged,
            None => self.shortfall.take().unwrap_or(SolveStatus::Failed),
        };
        self.result(candidate, status, system, control)
    }

    fn result(
        &mut self,
        candidate: Option<Candidate>,
        status: SolveStatus,
        system: &mut System,
        control: &Control<'_>,
    ) -> SolveResult {
        let is_settled = candidate.as_ref().is_some_and(Candidate::is_settled);
        let is_stopped = candidate.as_ref().is_some_and(Candidate::is_stopped);
        let status = match status {
            _ if control.cancelled && (is_stopped || !is_settled) => SolveStatus::Cancelled,
            _ if is_stopped => SolveStatus::IterationLimit,
            status => status,
        };
        let linear = self.linear.take();
        let mut formulation = Formulation {
            along_normals: false,
            ..self.left(system)
        };
        let (x, step, poor) = match (candidate, linear) {
            // Stopped on the way over poor triangles: the linear surface is the better one.
            (Some(c), Some(linear)) if c.is_stopped() && !c.poor.is_empty() => (linear, f64::NAN, None),
            (Some(c), _) => {
                formulation = c.formulation;
                self.left = Some(formulation.clone());
                (c.x, c.step, Some(c.poor))
            }
            (None, linear) => {
                let least = self.least_bending.take().map(|(x, _)| x);
                (least.or(linear).unwrap_or_default(), f64::NAN, None)
            }
        };
        system.evaluate(&x, &formulation);
        SolveResult {
            status,
            step,
            defect: system.defect(&formulation),
            spread_otherwise: formulation.spreads_otherwise(),
            iterations: control.tally.iterations - self.in_vain,
            poor: poor.unwrap_or_else(|| system.poor(&x, NEEDLE)),
            along_normals: formulation.along_normals,
            trials: std::mem::take(&mut self.trials),
            continuity: Vec::new(),
            start_seconds: self.start_seconds,
            x,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrete::inner_fairness::FairnessWeights;
    use crate::discrete::target::RightHandSide;

    fn stalled(step: f64) -> Candidate {
        Candidate {
            x: Vec::new(),
            status: IterationStatus::Stalled,
            step,
            formulation: Formulation {
                right_hand_side: RightHandSide::default(),
                weights: FairnessWeights::uniform().into(),
                of_surface: false,
                along_normals: false,
            },
            poor: Vec::new(),
            curvature_overshoot: false,
            folds: 0,
            bending_energy: 0.0,
            may_have_rival: false,
            detached_from_normals: false,
            creases: 0,
            suspicious_normals: 0,
            needles_from_input: false,
        }
    }

    /// Where rounding keeps the step above the tolerance, the sound surface is returned, and told so.
    #[test]
    fn what_stalls_at_rounding_ends_the_search() {
        let control = Control::new(1e-9, 100, None);
        let considered = |candidate: Candidate| {
            let mut ladder = Ladder {
                attempts: 2,
                ..Ladder::default()
            };
            ladder.consider(candidate, &control).map(|(_, status)| status)
        };
        assert_eq!(considered(stalled(1e-13)), Some(SolveStatus::AboveTolerance));
        assert_eq!(considered(stalled(1e-7)), None);
        let creased = Candidate {
            creases: 1,
            ..stalled(1e-13)
        };
        assert_eq!(considered(creased), None);
        let poor = Candidate {
            poor: vec![0],
            ..stalled(1e-13)
        };
        assert_eq!(considered(poor), None);
    }

    /// A neck is no answer where the tube is found too, though with other weights than those asked.
    #[test]
    fn a_surface_of_far_less_energy_is_better_whatever_its_weights() {
        let with = |bending_energy: f64, of_surface: bool| {
            let mut candidate = stalled(1e-13);
            candidate.bending_energy = bending_energy;
            candidate.formulation.of_surface = of_surface;
            candidate
        };
        let (neck, tube) = (with(10.6, false), with(4.7, true));
        assert!(tube.is_better_than(&neck) && !neck.is_better_than(&tube));
        // A third less may be the weights alone.
        assert!(!with(0.7, true).is_better_than(&with(1.0, false)));
        assert!(with(0.7, false).is_better_than(&with(1.0, false)));
    }
}
