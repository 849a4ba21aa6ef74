//! The iteration: quasi-Newton steps on both fairness equations with frozen matrices, Anderson-accelerated. The paper's
//! loop (section 7.1, Figure 6) but for the two problems being solved together.

use nalgebra::Vector3;

use super::candidate::Candidate;
use super::control::Control;
use super::formulation::Formulation;
use super::iterate_options::{IterateOptions, IterationStatus};
use super::iteration_round::Round;
use super::limited_step::{LARGEST_CHANGE, advance, limited_part};
use super::step::StepNorm;
use super::system::{LARGE, System};
use crate::quality::NEEDLE;
use crate::support::profile::clock;
use fairmesh_linear::anderson::{Anderson, MAX_WINDOW};

/// Below this step norm, in diagonals, the triangles show what they will be.
/// Of 125 cases, half: 4 change by up to 0.3 edges; double: 3 change by up to 0.6 edges.
const TRIANGLES_SETTLED: f64 = 1e-4;
/// Growth of the step norm over the best that an accelerated step may cause.
/// Of 125 cases, half: 13 change by up to 0.6 edges, 3 get another triangulation;
/// double: 5 change by up to 0.3 edges, 1 get another triangulation, 1 fails.
const SAFE_GROWTH: f64 = 3.0;
/// The same near the solution, where growth is mostly that of rounding or of a few slow vertices.
/// Of 121 cases, half: 2 change by up to 0.6 edges; double: 1 changes by up to 4e-8 edges.
const SAFE_GROWTH_NEAR: f64 = 6.0;
/// An accelerated step that would change an edge by more than so many times [`LARGEST_CHANGE`] extrapolates too far: its
/// direction is worth nothing either.
/// Of 125 cases, half: 31 change by up to 2 edges, 3 get another triangulation, 1 more succeeds;
/// double: 21 change by up to 3 edges, 3 get another triangulation, 2 fail.
const LARGEST_EXCESS: f64 = 2.0;
/// No vertex takes a normal step of more than this times the tolerance at the end: a mean hides single slow vertices.
/// Of 125 cases, half: 46 change by up to 3e-5 edges, 3 get another triangulation, +2 % iterations, 1 fails;
/// double: 56 change by up to 1e-5 edges, 7 get another triangulation, -2 % iterations.
const LARGEST_STEP: f64 = 0.1;
/// But not for longer than this many iterations.
/// Of 125 cases, half: 23 change by up to 0.05 edges, 3 get another triangulation, -1 % iterations;
/// double: 7 change by up to 0.01 edges, 2 get another triangulation.
const EXTRA: usize = 6;
/// The last step may be longer than the plain one by this factor when accelerated.
/// Of 121 cases, half: 78 change by up to 3e-6 edges, 4 get another triangulation;
/// double: 12 change by up to 3e-5 edges, 1 get another triangulation.
const LONGEST_LAST: f64 = 2.0;
/// Steps that Anderson acceleration looks back on. Every cluster of thin triangles adds slow modes of its own, and each
/// takes a step of the history. Half as many on large regions, where that would cost more memory than the matrix.
/// Of 123 cases, half: 80 change by up to 3 edges, 3 get another triangulation, -2 % iterations; double: 33 change by up to 0.3 edges.
const WINDOW: usize = 16;
const _: () = assert!(WINDOW <= MAX_WINDOW);
/// A round that leaves more than this of the step norm after [`IterateOptions::patience`] steps is left; a round with a fresh matrix that leaves
/// more than this of the one before is the last.
/// Of 122 cases, half: 12 change by up to 0.4 edges, 1 get another triangulation, -4 % iterations, 1 fails, 1 more succeeds;
/// double: 13 change by up to 3 edges, 2 get another triangulation, +20 % iterations, 1 fails, 1 more succeeds.
const STALL: f64 = 0.7;
/// A round is left when the step norm exceeds this many times the best: every change of matrix makes it jump.
/// Of 125 cases, half: 3 change by up to 3e-8 edges, -1 % iterations, 1 more succeeds; double: 2 change, 1 fails.
const DIVERGED: f64 = 10.0;

/// Which step is taken.
#[derive(Debug, Clone, Copy)]
enum StepKind {
    /// The quasi-Newton step itself.
    Plain,
    /// The accelerated one.
    Accelerated,
}

/// The surface with the smallest step norm of a round, and the step there. Norms of different rounds do not compare: each round has a
/// matrix of its own.
#[derive(Debug, Clone)]
struct Best {
    x: Vec<Vector3<f64>>,
    modes: Vec<f64>,
    step: Vec<f64>,
    d: f64,
}

/// What is to be done before the next step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Due {
    /// Nothing: the system stands evaluated at the surface.
    Nothing,
    /// Both equations are evaluated.
    Evaluation,
    /// And a round begins, with `P` as it is,
    Round,
    /// or made at the surface.
    Matrix,
}

/// An iteration, perhaps held up.
#[derive(Debug, Clone)]
pub(crate) struct Iteration {
    options: IterateOptions,
    formulation: Formulation,
    tolerance: f64,
    /// The step norm after which it pauses, once; 0: none.
    pause: f64,
    /// The surface.
    x: Vec<Vector3<f64>>,
    /// The coefficients of curvature continuity, where that is asked for.
    modes: Vec<f64>,
    due: Due,
    best: Best,
    anderson: Anderson,
    step: Vec<f64>,
    accelerated: Vec<f64>,
    /// How much of `accelerated` was taken.
    taken: f64,
    /// The area of the surface that the matrix was made at.
    matrix_area: f64,
    /// Rounds begun.
    rounds: usize,
    round: Round,
}

impl Iteration {
    /// An iteration from `x`.
    pub(crate) fn new(
        system: &System,
        formulation: Formulation,
        x: Vec<Vector3<f64>>,
        options: IterateOptions,
        control: &Control<'_>,
    ) -> Self {
        let modes = vec![0.0; system.modes()];
        let n = 3 * system.free() + modes.len();
        let window = if system.free() > LARGE { WINDOW / 2 } else { WINDOW };
        Self {
            tolerance: options.tolerance_floor.max(control.tolerance),
            best: Best {
                x: x.clone(),
                modes: modes.clone(),
                step: vec![0.0; n],
                d: f64::INFINITY,
            },
            x,
            modes,
            pause: 0.0,
            due: if options.reuse_factor {
                Due::Round
            } else {
                Due::Matrix
            },
            anderson: Anderson::new(n, window),
            step: vec![0.0; n],
            accelerated: vec![0.0; n],
            taken: 1.0,
            matrix_area: f64::NAN,
            rounds: 1,
            round: Round::new(&options, f64::INFINITY),
            options,
            formulation,
        }
    }

    /// Iterates to the end. `None`: it is held up between two steps, and the next call goes on.
    pub(crate) fn run(&mut self, system: &mut System, control: &mut Control<'_>) -> Option<IterationStatus> {
        loop {
            if control.is_held() {
                return None;
            }
            // (4), (7.3) at the surface.
            if let Some(status) = self.evaluate(system, control) {
                return Some(status);
            }
            // P t = R1 (12) and G d = inner residual (7.3).
            let norm = system.step(&mut self.step, &self.formulation);
            let d = norm.total() * self.growth(system);
            control.iteration(d, self.options.phase);
            match self.judge(d, &norm, system, control) {
                None if self.went_too_far(d) => self.go_back(system),
                None => {
                    self.accelerate(system);
                    if d <= self.pause {
                        self.pause = 0.0;
                        return Some(IterationStatus::Paused);
                    }
                }
                Some(IterationStatus::Converged) => {
                    let left = self.take_last_step() / system.diagonal;
                    let is_even = left <= LARGEST_STEP * self.tolerance || self.round.within > EXTRA;
                    if is_even || self.options.follows {
                        system.set_modes(&self.modes);
                        return Some(IterationStatus::Converged);
                    }
                }
                Some(IterationStatus::Stalled) => {
                    let ended = self.next_round(system);
                    if ended.is_some() {
                        return ended;
                    }
                }
                status => {
                    self.take_best(system);
                    return status;
                }
            }
        }
    }

    /// How it iterates.
    pub(crate) fn options(&self) -> IterateOptions {
        self.options
    }

    /// Which equations it solves.
    pub(crate) fn formulation(&self) -> &Formulation {
        &self.formulation
    }

    /// The surface at hand.
    pub(crate) fn x(&self) -> &[Vector3<f64>] {
        &self.x
    }

    /// The surface of smallest step norm since the round has begun, and that; none before the first step.
    pub(crate) fn best(&self) -> Option<(&[Vector3<f64>], f64)> {
        self.best.d.is_finite().then_some((&self.best.x, self.best.d))
    }

    /// Evaluates both equations at the surface at hand, where the system does not stand there.
    pub(crate) fn evaluate_at_hand(&mut self, system: &mut System) {
        if self.due == Due::Evaluation {
            system.set_modes(&self.modes);
            system.evaluate(&self.x, &self.formulation);
            self.due = Due::Nothing;
        }
    }

    /// Goes on from `x` to this tolerance, where the boundary data have changed, with the matrix that is there and what acceleration has
    /// learned.
    pub(crate) fn follow(&mut self, x: &[Vector3<f64>], formulation: Formulation) {
        self.formulation = formulation;
        self.x.copy_from_slice(x);
        self.due = Due::Round;
        self.best.d = f64::INFINITY;
        self.anderson.resume();
        self.rounds = 1;
        self.round = Round::new(&self.options, f64::INFINITY);
        self.round.was_accelerated = false;
    }

    /// Forgets what acceleration has learned.
    pub(crate) fn forget(&mut self) {
        self.anderson.clear();
    }

    /// Pauses after the first step of this norm.
    pub(crate) fn pause_at(&mut self, d: f64) {
        self.pause = d;
    }

    /// The step norm to reach.
    pub(crate) fn set_tolerance(&mut self, tolerance: f64) {
        self.tolerance = tolerance;
    }

    /// The matrix is another one than that the last steps were taken with.
    pub(crate) fn take_matrix(&mut self) {
        self.matrix_area = f64::NAN;
    }

    /// Evaluates both equations at the surface, and makes `P` there if that is due. Returns how the iteration ended if that is as far as
    /// it goes.
    fn evaluate(&mut self, system: &mut System, control: &mut Control<'_>) -> Option<IterationStatus> {
        let due = std::mem::replace(&mut self.due, Due::Nothing);
        if due == Due::Nothing {
            return None;
        }
        if due != Due::Evaluation {
            // They were factored before, so that they can be again.
            let _ = system.factor_inner(&self.formulation.weights);
        }
        let is_matrix_due = due == Due::Matrix;
        system.set_modes(&self.modes);
        if !is_matrix_due {
            system.evaluate(&self.x, &self.formulation);
        }
        let mut made = Ok(());
        if is_matrix_due {
            made = system.rebuild(&self.x, &self.formulation);
            self.take_matrix();
        }
        // A factorization that is interrupted fails as well.
        if due != Due::Evaluation && !control.checkpoint(self.options.phase) {
            self.best.d = f64::NAN;
            return Some(IterationStatus::Stopped);
        }
        made.is_err().then_some(IterationStatus::Stalled)
    }

    /// The surface where it ended, judged.
    pub(crate) fn candidate(&self, status: IterationStatus, system: &mut System) -> Candidate {
        Candidate::new(system, &self.formulation, self.x.clone(), status, self.best.d)
    }

    /// Takes note of the step, and says whether the round ends with it.
    fn judge(
        &mut self,
        d: f64,
        norm: &StepNorm,
        system: &System,
        control: &Control<'_>,
    ) -> Option<IterationStatus> {
        if !d.is_finite() {
            return Some(IterationStatus::Stalled);
        }
        if self.round.history.is_empty() {
            self.round.first = d;
        }
        if d < self.best.d {
            self.best.d = d;
            self.best.x.clone_from(&self.x);
            self.best.modes.clone_from(&self.modes);
            self.best.step.clone_from(&self.step);
        }
        self.round.within += usize::from(d <= self.tolerance);
        if self.is_converged(d, norm) {
            let is_folded = self.options.follows && !system.poor(&self.x, 0.0).is_empty();
            return Some(if is_folded {
                IterationStatus::Stalled
            } else {
                IterationStatus::Converged
            });
        }
        if control.exhausted() {
            return Some(IterationStatus::Stopped);
        }
        if self.round.stop_on_folds && d < TRIANGLES_SETTLED {
            self.round.stop_on_folds = false;
            if !system.poor(&self.x, NEEDLE).is_empty() {
                return Some(IterationStatus::Folded);
            }
        }
        self.round.history.push(d);
        self.is_stalling().then_some(IterationStatus::Stalled)
    }

    /// By how much the surface has grown since the matrix was made.
    fn growth(&mut self, system: &System) -> f64 {
        if !self.options.follows {
            return 1.0;
        }
        let area = system.area();
        if self.matrix_area.is_nan() {
            self.matrix_area = area;
        }
        (area / self.matrix_area).max(1.0)
    }

    /// By which factor the surface has changed its area since the matrix was made, grown or shrunk.
    pub(crate) fn change_since_matrix(&self, system: &System) -> f64 {
        let change = system.area() / self.matrix_area;
        change.max(1.0 / change)
    }

    fn is_converged(&self, d: f64, norm: &StepNorm) -> bool {
        let is_even = norm.largest <= LARGEST_STEP * self.tolerance || self.round.within > EXTRA;
        // Not on the first sight: a start may be close for reasons of its own.
        d <= self.tolerance && (self.options.follows || is_even && !self.round.history.is_empty())
    }

    fn is_stalling(&self) -> bool {
        let (patience, history) = (self.options.patience, &self.round.history);
        let k = history.len() - 1;
        let d = history[k];
        d > DIVERGED * self.best.d || k >= patience && d > STALL * history[k - patience]
    }

    /// After a round that stalls: another one from the best surface, if that promises something.
    fn next_round(&mut self, system: &mut System) -> Option<IterationStatus> {
        self.take_best(system);
        let best = self.best.d;
        if best <= self.tolerance && !self.options.follows {
            // The mean step is small enough; a few slow vertices do not gain any more.
            return Some(IterationStatus::Converged);
        }
        let is_hopeless = if self.options.follows {
            !best.is_finite()
        } else {
            best > STALL * self.round.first
        };
        if is_hopeless || self.rounds == self.options.rounds {
            return Some(IterationStatus::Stalled);
        }
        self.rounds += 1;
        self.due = Due::Matrix;
        self.best.d = f64::INFINITY;
        self.round = Round::new(&self.options, self.round.first);
        self.anderson.clear();
        None
    }

    /// Whether the last, accelerated step has extrapolated too far.
    fn went_too_far(&self, d: f64) -> bool {
        let growth = if self.best.d < TRIANGLES_SETTLED {
            SAFE_GROWTH_NEAR
        } else {
            SAFE_GROWTH
        };
        d > growth * self.best.d && self.round.was_accelerated
    }

    /// Back to the best surface, and from there without history.
    fn go_back(&mut self, system: &mut System) {
        self.round.was_accelerated = false;
        self.take_best(system);
        self.step.clone_from(&self.best.step);
        self.anderson.clear();
        self.plain_step(system);
    }

    fn accelerate(&mut self, system: &System) {
        self.round.was_accelerated = true;
        {
            let _clock = clock("Anderson");
            self.anderson
                .accelerate(&self.step, self.taken, &mut self.accelerated);
        }
        let change = system.edge_change(&self.x, &self.accelerated[..3 * system.free()]);
        if change <= LARGEST_EXCESS * LARGEST_CHANGE {
            self.taken = self.take_limited(StepKind::Accelerated, change);
        } else {
            self.anderson.clear();
            self.plain_step(system);
        }
    }

    /// The step after which nothing is evaluated: the accelerated one, which leaves less of the error, unless the history is one of
    /// rounding. Returns the largest way of a vertex, which tells how much is left: a mean hides it, and so do steps that hardly shrink.
    fn take_last_step(&mut self) -> f64 {
        let _clock = clock("Anderson");
        self.anderson
            .accelerate(&self.step, self.taken, &mut self.accelerated);
        let square = |step: &[f64]| step.iter().map(|s| s * s).sum::<f64>();
        let is_alike = square(&self.accelerated) <= LONGEST_LAST * LONGEST_LAST * square(&self.step);
        let (last, step) = if is_alike {
            (StepKind::Accelerated, &self.accelerated)
        } else {
            (StepKind::Plain, &self.step)
        };
        let ways = step[..step.len() - self.modes.len()].as_chunks::<3>().0.iter();
        let longest = ways.map(|way| square(way)).fold(0.0, f64::max).sqrt();
        self.take(last, 1.0);
        self.taken = 1.0;
        if !is_alike {
            self.anderson.clear();
        }
        longest
    }

    fn plain_step(&mut self, system: &System) {
        let change = system.edge_change(&self.x, &self.step[..3 * system.free()]);
        self.take_limited(StepKind::Plain, change);
    }

    /// As much of a step as changes no edge too far. Returns how much that is.
    fn take_limited(&mut self, step: StepKind, change: f64) -> f64 {
        let part = limited_part(change, LARGEST_CHANGE);
        self.take(step, part);
        part
    }

    /// A part of a step, of the surface and of the modes.
    fn take(&mut self, step: StepKind, part: f64) {
        let step = match step {
            StepKind::Plain => &self.step,
            StepKind::Accelerated => &self.accelerated,
        };
        let (of_x, of_modes) = step.split_at(step.len() - self.modes.len());
        advance(&mut self.x, of_x, part);
        self.due = Due::Evaluation;
        self.modes
            .iter_mut()
            .zip(of_modes)
            .for_each(|(m, s)| *m += part * s);
    }

    /// The best surface of the round.
    fn take_best(&mut self, system: &mut System) {
        self.x.clone_from(&self.best.x);
        self.modes.clone_from(&self.best.modes);
        system.set_modes(&self.modes);
    }
}
