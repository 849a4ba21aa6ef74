//! How an iteration goes, and how it ends.

/// How an iteration ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum IterationStatus {
    /// The step norm is below the tolerance.
    Converged,
    /// No round gains any more.
    Stalled,
    /// At the step norm of [`Iteration::pause_at`](super::quasi_newton::Iteration::pause_at): the next call goes on as if nothing had been.
    Paused,
    /// Near the solution, but on poor triangles: see [`IterateOptions::stop_on_folds`].
    Folded,
    /// Limit or cancel, see [`Control`](super::control::Control).
    Stopped,
}

/// How to iterate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct IterateOptions {
    /// The step norm to reach, in diagonals, where the tolerance that is asked for is smaller; 0: that one.
    pub tolerance_floor: f64,
    /// A round is left when it gains little in so many steps.
    pub patience: usize,
    /// At most this many rounds, each with a matrix made at the best surface so far.
    pub rounds: usize,
    /// Stop near the solution when triangles are folded or thin: their repair starts anew.
    pub stop_on_folds: bool,
    /// Begin with the factor of `P` that is there.
    pub reuse_factor: bool,
    /// Frames ([`super::live`]): the surface solved a problem close to this one. What is within the tolerance at first sight has settled,
    /// unless triangles are folded, and what has grown since the matrix was made takes steps that are too short by as much.
    pub follows: bool,
    /// What to call it in progress reports.
    pub phase: &'static str,
}

impl IterateOptions {
    /// The same to the tolerance that is asked for.
    pub(crate) fn to_the_end(self) -> Self {
        Self {
            tolerance_floor: 0.0,
            ..self
        }
    }
}
