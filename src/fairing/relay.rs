//! Threads: a pool for each call, and the progress callback on the caller's thread.

use std::ops::ControlFlow;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::Duration;

use super::{Progress, ProgressCallback};
use crate::error::Error;
use crate::solve::control::{Callback, Interrupt};

/// So often the callback is called where the work has nothing to tell: it may want to stop.
const TICK: Duration = Duration::from_millis(50);

/// Runs `work` on the pool and `callback` on this thread, which waits for it in between. `work` is handed what sends to the
/// callback, and what is set when the callback stops the run.
pub(super) fn relay<T: Send>(
    pool: &rayon::ThreadPool,
    callback: &mut ProgressCallback<'_>,
    work: impl for<'t> FnOnce(&'t mut Callback<'t>, &Interrupt) -> T + Send,
) -> Result<T, Error> {
    let (to_caller, messages) = mpsc::channel::<Progress>();
    let (answer, answers) = mpsc::channel::<ControlFlow<()>>();
    let mut tell = move |fraction, iterations, step, stage| {
        let sent = to_caller.send(Progress {
            fraction,
            iterations,
            step,
            stage,
        });
        // Nobody listens any more: the callback has panicked, so stop.
        sent.ok()
            .and_then(|()| answers.recv().ok())
            .unwrap_or(ControlFlow::Break(()))
    };
    let interrupt = Interrupt::default();
    let theirs = interrupt.clone();
    std::thread::scope(|scope| {
        let worker = std::thread::Builder::new()
            .spawn_scoped(scope, move || pool.install(move || work(&mut tell, &theirs)))
            .map_err(|e| Error::Threads {
                threads: 1,
                why: e.to_string(),
            })?;
        // Dropped when the callback panics, so that the worker does not wait for ever.
        let (messages, answer) = (messages, answer);
        let mut last = Progress {
            fraction: 0.0,
            iterations: 0,
            step: f64::NAN,
            stage: "setup",
        };
        loop {
            let message = messages.recv_timeout(TICK);
            if let Ok(message) = &message {
                last = *message;
            }
            let told = match message {
                Err(RecvTimeoutError::Disconnected) => break,
                // Who has asked to stop is not asked again.
                _ if interrupt.is_set() => ControlFlow::Break(()),
                _ => callback(&last),
            };
            if told.is_break() {
                interrupt.set();
            }
            if message.is_ok() && answer.send(told).is_err() {
                break;
            }
        }
        match worker.join() {
            Ok(result) => Ok(result),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}

/// Runs `work` with a pool of its own, whose threads have ended afterwards, to the last destructor: a program may unload
/// the library then.
pub(crate) fn with_threads<T>(
    threads: usize,
    work: impl FnOnce(&rayon::ThreadPool) -> T,
) -> Result<T, Error> {
    let mut handles = Vec::new();
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .spawn_handler(|thread| {
            handles.push(std::thread::Builder::new().spawn(|| thread.run())?);
            Ok(())
        })
        .build();
    let done = pool.map(|pool| work(&pool)).map_err(|e| Error::Threads {
        threads,
        why: e.to_string(),
    });
    for handle in handles {
        let _ = handle.join();
    }
    done
}
