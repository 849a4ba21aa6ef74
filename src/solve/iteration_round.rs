//! What an iteration keeps in mind of a round, which goes on with one matrix.

use super::iterate_options::IterateOptions;

/// What a round keeps in mind.
#[derive(Debug, Clone)]
pub(super) struct Round {
    /// Step norms of the round.
    pub history: Vec<f64>,
    /// The first step norm of the round.
    pub first: f64,
    pub stop_on_folds: bool,
    /// An accelerated step was the last: from there one may go back.
    pub was_accelerated: bool,
    /// Iterations within the tolerance.
    pub within: usize,
}

impl Round {
    /// After one with this first step norm.
    pub(super) fn new(options: &IterateOptions, first: f64) -> Self {
        Self {
            history: Vec::new(),
            first,
            stop_on_folds: options.stop_on_folds,
            was_accelerated: true,
            within: 0,
        }
    }
}
