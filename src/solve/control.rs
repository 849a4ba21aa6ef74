//! Iteration count, progress and cancelling, shared by every stage.

use std::ops::ControlFlow;

use nalgebra::Vector3;

use super::system::System;
pub(crate) use fairmesh_linear::interrupt::Interrupt;

/// What a stage tells the caller after an iteration.
pub(crate) type Callback<'a> = dyn FnMut(f64, usize, f64, &'static str) -> ControlFlow<()> + 'a;

/// What looks at the surface of every iteration, evaluated last, with the number of iterations and the step norm; may
/// hold the run up, and stop it.
pub(crate) type Watch<'a> = dyn FnMut(&System<'_>, &[Vector3<f64>], usize, f64) -> ControlFlow<()> + 'a;

/// Limits and progress of one run.
pub(crate) struct Control<'a> {
    /// Nonlinear iterations so far.
    pub iterations: usize,
    /// The limit.
    pub max_iterations: usize,
    /// The step norm to reach, in diagonals.
    pub tolerance: f64,
    /// Set when the callback asked to stop.
    pub cancelled: bool,
    /// Set when the run is to stop, also between two calls of the callback.
    pub interrupt: Interrupt,
    /// Sees every iteration's surface; none unless set.
    pub watch: Option<&'a mut Watch<'a>>,
    /// The fraction last reported.
    fraction: f64,
    /// The step norm last reported.
    step: f64,
    callback: Option<&'a mut Callback<'a>>,
}

impl<'a> Control<'a> {
    /// A fresh run.
    pub(crate) fn new(tolerance: f64, max_iterations: usize, callback: Option<&'a mut Callback<'a>>) -> Self {
        Self {
            iterations: 0,
            max_iterations,
            tolerance,
            cancelled: false,
            interrupt: Interrupt::default(),
            watch: None,
            fraction: 0.0,
            step: f64::NAN,
            callback,
        }
    }

    /// Reports a stage of the preparation, `fraction` of the whole.
    pub(crate) fn stage(&mut self, fraction: f64, stage: &'static str) {
        self.tell(fraction, f64::NAN, stage);
    }

    /// Shows within a stage that it goes on, so that it can be stopped; returns whether it may.
    pub(crate) fn goes_on(&mut self, stage: &'static str) -> bool {
        self.tell(self.fraction, self.step, stage);
        !self.cancelled
    }

    /// Counts an iteration with step norm `d` and reports it. The fraction follows the digits gained, from 0.3 to 1.
    pub(crate) fn iteration(&mut self, d: f64, stage: &'static str) {
        self.iterations += 1;
        let digits = (d.max(self.tolerance).log10()) / self.tolerance.log10();
        self.tell(0.3 + 0.69 * digits.clamp(0.0, 1.0), d, stage);
    }

    /// Shows the surface of the iteration counted last.
    pub(crate) fn show(&mut self, system: &System<'_>, x: &[Vector3<f64>], d: f64) {
        if let (false, Some(watch)) = (self.cancelled, &mut self.watch) {
            self.cancelled |= watch(system, x, self.iterations, d).is_break();
        }
    }

    /// Counts an iteration with step norm `d` of a solver that measures its progress itself.
    pub(crate) fn update(&mut self, fraction: f64, d: f64, stage: &'static str) {
        self.iterations += 1;
        self.tell(fraction, d, stage);
    }

    fn tell(&mut self, fraction: f64, d: f64, stage: &'static str) {
        self.fraction = self.fraction.max(fraction);
        self.step = d;
        // Who has asked to stop is not asked again.
        if let (false, Some(callback)) = (self.cancelled, &mut self.callback) {
            self.cancelled |= callback(self.fraction, self.iterations, d, stage).is_break();
        }
    }

    /// Whether to stop for either reason.
    pub(crate) fn exhausted(&self) -> bool {
        self.cancelled || self.iterations >= self.max_iterations
    }
}
