//! What `workers.rs` offers, where there are no threads (WebAssembly): the work runs on the caller's thread, and calls the
//! progress callback from within.

use crate::fairing::report::{Progress, ProgressCallback};
use crate::solve::control::{Callback, Interrupt};
use crate::support::error::Error;

/// Runs `work`, which is handed what calls `callback`, and what is set when the callback stops the run. Between two phases
/// nothing can be told.
pub(super) fn relay<T: Send>(
    workers: &Workers,
    callback: &mut ProgressCallback<'_>,
    work: impl for<'t> FnOnce(&'t mut Callback<'t>, &Interrupt) -> T + Send,
) -> Result<T, Error> {
    let interrupt = Interrupt::default();
    let set = interrupt.clone();
    let mut tell = |fraction, iterations, step, phase| {
        let told = callback(&Progress {
            fraction,
            iterations,
            step,
            phase,
        });
        if told.is_break() {
            set.set();
        }
        told
    };
    Ok(workers.install(|| work(&mut tell, &interrupt)))
}

/// The caller's thread.
pub(crate) struct Workers;

impl Workers {
    /// Any number of threads is one.
    #[allow(clippy::unnecessary_wraps, reason = "threads may be refused elsewhere")]
    pub(crate) fn new(_threads: usize) -> Result<Self, Error> {
        Ok(Self)
    }

    /// Runs `work`. What it would share with other threads rayon does in turn.
    pub(crate) fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        work()
    }
}
