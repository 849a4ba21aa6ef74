//! One run from 0 to 1 over all components: each has a share in it that is as large as its free vertices are many.

use std::ops::ControlFlow;

use fairmesh_linear::interrupt::is_stopped;

use crate::solve::control::Callback;

/// Components with a smaller share are told of together: for each of thousands, the callback would take longer than the work.
/// Half or double, of 128 cases: none changes.
const SMALLEST: f64 = 1e-3;

/// The fraction at which all components are read and checked: a share of the time, measured on regions of 1,000 to 100,000 free
/// vertices.
/// Half or double, of 115 cases: only the progress changes.
pub(super) const PREPARED: f64 = 0.08;

/// What is told of all components.
pub(super) struct ComponentWeights<'a> {
    callback: Option<&'a mut Callback<'a>>,
    /// The fraction at which the first component began.
    begun: f64,
    free_vertices: usize,
    /// What is done of the components that are not at work.
    done: f64,
    /// The fraction last told.
    told: f64,
    /// The callback has asked to stop.
    is_stopped: bool,
}

impl<'a> ComponentWeights<'a> {
    /// Of components with so many free vertices, of which such a fraction is done, in a run that has come as far as `begun`.
    pub(super) fn new(
        callback: Option<&'a mut Callback<'a>>,
        begun: f64,
        components: impl Iterator<Item = (usize, f64)> + Clone,
    ) -> Self {
        let free_vertices: usize = components.clone().map(|(free, _)| free).sum();
        let done = components.map(|(free, fraction)| fraction * share(free, free_vertices));
        Self {
            callback,
            begun,
            free_vertices,
            done: done.sum(),
            told: 0.0,
            is_stopped: false,
        }
    }

    /// A component of so many free vertices is now where `fraction` says.
    pub(super) fn tell(
        &mut self,
        free: usize,
        (fraction, iterations, step, phase): (f64, usize, f64, &'static str),
    ) -> ControlFlow<()> {
        let share = share(free, self.free_vertices);
        let done = (self.done + share * fraction).min(1.0);
        let fraction = self.begun + (1.0 - self.begun) * done;
        let is_due = share >= SMALLEST || fraction >= self.told + SMALLEST;
        self.is_stopped |= is_stopped();
        if let (true, false, Some(callback)) = (is_due, self.is_stopped, &mut self.callback) {
            self.told = self.told.max(fraction);
            self.is_stopped |= callback(self.told, iterations, step, phase).is_break();
        }
        match self.is_stopped {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }

    /// A component of so many free vertices is at work from this fraction on.
    pub(super) fn begin(&mut self, free: usize, fraction: f64) {
        self.done -= fraction * share(free, self.free_vertices);
    }

    /// It has come as far as this fraction.
    pub(super) fn end(&mut self, free: usize, fraction: f64) {
        self.done += fraction * share(free, self.free_vertices);
    }

    /// Whether the callback has asked to stop.
    pub(super) fn is_stopped(&self) -> bool {
        self.is_stopped
    }
}

fn share(free: usize, of: usize) -> f64 {
    free as f64 / of as f64
}
