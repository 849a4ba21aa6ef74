//! Iteration count, progress and cancelling, shared by all parts of a run.

use std::ops::ControlFlow;

pub(crate) use fairmesh_linear::interrupt::Interrupt;

/// What is called after an iteration: fraction done, iterations, step norm, phase.
pub(crate) type Callback<'a> = dyn FnMut(f64, usize, f64, &'static str) -> ControlFlow<()> + 'a;

/// How far a run is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tally {
    /// Nonlinear iterations so far.
    pub iterations: usize,
    /// The fraction last reported.
    pub fraction: f64,
    /// The step norm last reported.
    pub step: f64,
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            iterations: 0,
            fraction: 0.0,
            step: f64::NAN,
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
    /// Set when the run is to stop, also between two calls of the callback.
    pub interrupt: Interrupt,
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
            interrupt: Interrupt::default(),
            callback,
        }
    }

    /// Reports a phase of the preparation, `fraction` of the whole; returns whether to go on.
    pub(crate) fn phase(&mut self, fraction: f64, phase: &'static str) -> bool {
        self.tell(fraction, f64::NAN, phase);
        !self.cancelled
    }

    /// Shows within a phase that it goes on, so that it can be stopped; returns whether to go on.
    pub(crate) fn checkpoint(&mut self, phase: &'static str) -> bool {
        self.tell(self.tally.fraction, self.tally.step, phase);
        !self.cancelled
    }

    /// Counts an iteration with step norm `d` and reports it. The fraction follows the digits gained, from 0.3 to 1.
    pub(crate) fn iteration(&mut self, d: f64, phase: &'static str) {
        let digits = (d.max(self.tolerance).log10()) / self.tolerance.log10();
        self.update(0.3 + 0.69 * digits.clamp(0.0, 1.0), d, phase);
    }

    /// Counts an iteration with step norm `d` of a solver that measures its progress itself.
    pub(crate) fn update(&mut self, fraction: f64, d: f64, phase: &'static str) {
        self.tally.iterations += 1;
        self.tell(fraction, d, phase);
    }

    /// A run within this one, with limits of its own: its iterations are not counted here, but it can be stopped.
    pub(crate) fn within<T>(
        &mut self,
        phase: &'static str,
        tolerance: f64,
        max_iterations: usize,
        run: impl FnOnce(&mut Control<'_>) -> T,
    ) -> T {
        let interrupt = self.interrupt.clone();
        let mut tell = |_, _, _, _| {
            if self.checkpoint(phase) {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        };
        let mut within = Control::new(tolerance, max_iterations, Some(&mut tell));
        within.interrupt = interrupt;
        run(&mut within)
    }

    fn tell(&mut self, fraction: f64, d: f64, phase: &'static str) {
        self.tally.fraction = self.tally.fraction.max(fraction);
        self.tally.step = d;
        // Who has asked to stop is not asked again.
        if let (false, Some(callback)) = (self.cancelled, &mut self.callback) {
            self.cancelled |= callback(self.tally.fraction, self.tally.iterations, d, phase).is_break();
        }
    }

    /// Whether to stop for either reason.
    pub(crate) fn exhausted(&self) -> bool {
        self.cancelled || self.tally.iterations >= self.max_iterations
    }
}
