//! Iteration count, progress and cancelling, shared by all parts of a run.

use std::ops::ControlFlow;

/// What is called after an iteration: fraction done, iterations, step norm, phase.
pub(crate) type Callback<'a> = dyn FnMut(f64, usize, f64, &'static str) -> ControlFlow<()> + Send + 'a;

/// The fraction at which the matrices' patterns are analysed. Fractions are shares of the time, measured on regions of 1,000 to
/// 100,000 free vertices that find their surface at the first attempt.
/// Half or double, of 112 cases: only the progress changes.
pub(super) const ANALYSED: f64 = 0.2;
/// The fraction at which the coarse mesh has led to a start.
/// Half or double, of 10 cases: only the progress changes.
pub(super) const SEARCHED: f64 = 0.45;
/// The fraction at which there is a linear surface, without a coarse mesh.
/// Half or double: only the progress changes.
pub(super) const LINEAR: f64 = 0.45;
/// The fraction at which the first iteration begins.
/// Half or double, of 125 cases: only the progress changes.
pub(super) const STARTED: f64 = 0.6;
/// The fraction at which the first attempt has its surface, and the checks begin.
/// Half or double, of 125 cases: only the progress changes.
pub(super) const ITERATED: f64 = 0.9;
/// What no attempt exceeds.
/// Half or double, of 49 cases: only the progress changes.
const LAST: f64 = 0.99;
/// The step norm that an attempt ends with, in tolerances: every vertex has to meet it, not only their mean.
/// Half or double, of 125 cases: only the progress changes.
const AT_THE_END: f64 = 0.05;

/// An attempt's share in the run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProgressSpan {
    /// The fraction at which it began.
    from: f64,
    /// The one at which it ends if it goes well.
    to: f64,
    /// Its first step norm.
    first: f64,
}

/// Where a run is held up: after one iteration at least.
#[derive(Debug, Clone, Copy)]
struct Hold {
    /// Iterations before.
    before: usize,
    /// So many later,
    after: usize,
    /// or once the callback has asked to stop.
    is_asked: bool,
}

/// How far a run is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tally {
    /// Nonlinear iterations so far.
    pub iterations: usize,
    /// The fraction last reported.
    pub fraction: f64,
    /// The step norm last reported.
    pub step: f64,
    /// The attempt that is under way.
    attempt: Option<ProgressSpan>,
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            iterations: 0,
            fraction: 0.0,
            step: f64::NAN,
            attempt: None,
        }
    }
}

/// Limits and progress of one run.
pub(crate) struct Control<'a> {
    /// How far it is.
    pub tally: Tally,
    /// The limit of iterations.
    pub max_iterations: usize,
    /// The step norm to reach, in diagonals.
    pub tolerance: f64,
    /// Set when the callback asked to stop.
    pub cancelled: bool,
    hold: Option<Hold>,
    callback: Option<&'a mut Callback<'a>>,
}

impl<'a> Control<'a> {
    /// A fresh run.
    pub(crate) fn new(tolerance: f64, max_iterations: usize, callback: Option<&'a mut Callback<'a>>) -> Self {
        Self {
            tally: Tally::default(),
            max_iterations,
            tolerance,
            cancelled: false,
            hold: None,
            callback,
        }
    }

    /// The run goes on from here for so many iterations, or until the callback asks to stop, and is held up then.
    pub(crate) fn hold_after(&mut self, iterations: usize) {
        self.hold = Some(Hold {
            before: self.tally.iterations,
            after: iterations,
            is_asked: false,
        });
    }

    /// Whether the run is held up, to go on later.
    pub(crate) fn is_held(&self) -> bool {
        self.hold.is_some_and(|hold| {
            let done = self.tally.iterations - hold.before;
            done > 0 && (hold.is_asked || done >= hold.after)
        })
    }

    /// Whether the callback has asked to hold it up.
    pub(crate) fn is_asked_to_hold(&self) -> bool {
        self.hold.is_some_and(|hold| hold.is_asked)
    }

    /// Reports a phase between iterations, at `fraction` of the whole; returns whether to go on.
    pub(crate) fn phase(&mut self, fraction: f64, phase: &'static str) -> bool {
        self.tell(fraction, self.tally.step, phase);
        !self.cancelled
    }

    /// Shows within a phase that it goes on, so that it can be stopped; returns whether to go on.
    pub(crate) fn checkpoint(&mut self, phase: &'static str) -> bool {
        self.phase(self.tally.fraction, phase)
    }

    /// An attempt begins. The first one is likely to be the last; each further one is given half of what is left.
    pub(crate) fn begin_attempt(&mut self) {
        let from = self.tally.fraction;
        let (from, to) = match self.tally.attempt {
            None => (STARTED.max(from), ITERATED.max(from)),
            Some(_) => (from, (from + LAST) / 2.0),
        };
        self.tally.fraction = from;
        self.tally.attempt = Some(ProgressSpan {
            from,
            to,
            first: f64::NAN,
        });
    }

    /// Counts an iteration with step norm `d` and reports it. The fraction follows the digits that the attempt has gained, of
    /// those that it lacked.
    pub(crate) fn iteration(&mut self, d: f64, phase: &'static str) {
        let goal = AT_THE_END * self.tolerance;
        let attempt = self.tally.attempt.get_or_insert(ProgressSpan {
            from: self.tally.fraction,
            to: ITERATED.max(self.tally.fraction),
            first: f64::NAN,
        });
        // `max` and `min` pass over a NaN.
        attempt.first = attempt.first.max(d).max(goal);
        let digits = |d: f64| libm::log10(d.max(goal) / goal);
        let gained = 1.0 - digits(d.min(attempt.first)) / digits(attempt.first).max(1.0);
        let fraction = attempt.from + gained.clamp(0.0, 1.0) * (attempt.to - attempt.from);
        self.update(fraction, d, phase);
    }

    /// Counts an iteration with step norm `d` of a solver that measures its progress itself.
    pub(crate) fn update(&mut self, fraction: f64, d: f64, phase: &'static str) {
        self.tally.iterations += 1;
        self.tell(fraction, d, phase);
    }

    /// A run within this one, which takes it up to the fraction `to`, with limits of its own: its iterations are not counted
    /// here, but it can be stopped.
    pub(crate) fn within<T>(
        &mut self,
        (phase, to): (&'static str, f64),
        tolerance: f64,
        max_iterations: usize,
        run: impl FnOnce(&mut Control<'_>) -> T,
    ) -> T {
        let from = self.tally.fraction;
        let mut tell = |fraction: f64, _, _, _| {
            if self.phase(from + fraction * (to - from), phase) {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        };
        let mut within = Control::new(tolerance, max_iterations, Some(&mut tell));
        run(&mut within)
    }

    fn tell(&mut self, fraction: f64, d: f64, phase: &'static str) {
        self.tally.fraction = self.tally.fraction.max(fraction);
        self.tally.step = d;
        // Who has asked to stop is not asked again.
        if let (false, Some(callback)) = (self.cancelled, &mut self.callback) {
            let is_break = callback(self.tally.fraction, self.tally.iterations, d, phase).is_break();
            match &mut self.hold {
                Some(hold) => hold.is_asked |= is_break,
                None => self.cancelled |= is_break,
            }
        }
    }

    /// Whether to stop for either reason.
    pub(crate) fn exhausted(&self) -> bool {
        self.cancelled || self.tally.iterations >= self.max_iterations
    }
}
