//! How much of a test each tier runs.

/// The first in the quick tier, whose build has debug assertions (`cargo test`); the second in the full one (`cargo test
/// --release`).
pub(crate) fn tier<T>(quick: T, full: T) -> T {
    if cfg!(debug_assertions) { quick } else { full }
}
