//! What `workers.rs` offers, where there are no threads (WebAssembly): the work runs on the caller's thread, and calls the
//! progress callback from within.

use std::ops::ControlFlow;

use fairmesh_linear::interrupt::Interrupt;

use crate::fairing::report::{Progress, ProgressCallback};
use crate::solve::control::Callback;
use crate::support::error::Error;

/// Runs `work`, which is handed what calls `callback`. When that stops a run that `breaks_off`, everything in it is told to. Between
/// two phases nothing can be told. What is told never falls, and is 1 at the end of a run that `is_whole`.
pub(super) fn relay<T: Send>(
    workers: &Workers,
    callback: &mut ProgressCallback<'_>,
    breaks_off: bool,
    work: impl for<'t> FnOnce(&'t mut Callback<'t>) -> T + Send,
    is_whole: impl FnOnce(&T) -> bool,
) -> Result<T, Error> {
    let interrupt = Interrupt::default();
    let around = interrupt.heed();
    let mut is_stopped = false;
    let mut last = Progress {
        fraction: 0.0,
        iterations: 0,
        step: f64::NAN,
        phase: "setup",
    };
    let mut tell = |fraction: f64, iterations, step, phase| {
        // Who has asked to stop is not asked again.
        if is_stopped {
            return ControlFlow::Break(());
        }
        last = Progress {
            fraction: last.fraction.max(fraction),
            iterations,
            step,
            phase,
        };
        let told = callback(&last);
        if told.is_break() {
            is_stopped = true;
            if breaks_off {
                interrupt.set();
            }
        }
        told
    };
    let result = workers.install(|| work(&mut tell));
    around.heed();
    if !is_stopped && is_whole(&result) {
        // There is nothing left to be stopped.
        let _ = callback(&Progress {
            fraction: 1.0,
            ..last
        });
    }
    Ok(result)
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
