//! Threads: a pool for each call, and the progress callback on the caller's thread.

use std::ops::ControlFlow;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread::JoinHandle;
use std::time::Duration;

use fairmesh_linear::interrupt::Interrupt;
use fairmesh_linear::parallel;

use crate::fairing::report::{Progress, ProgressCallback};
use crate::solve::control::Callback;
use crate::support::error::Error;

/// So often the callback is called where the work has nothing to tell: it may want to stop, and what it answers shall be known within 50 ms.
/// Half or double: only the number of calls changes.
const TICK: Duration = Duration::from_millis(20);

/// Runs `work` on the pool and `callback` on this thread, which waits for it in between. `work` is handed what sends to the
/// callback. When the callback stops a run that `breaks_off`, everything in it is told to. What is told never falls, and is 1 at the
/// end of a run that `is_whole`.
pub(super) fn relay<T: Send>(
    workers: &Workers,
    callback: &mut ProgressCallback<'_>,
    breaks_off: bool,
    work: impl for<'t> FnOnce(&'t mut Callback<'t>) -> T + Send,
    is_whole: impl FnOnce(&T) -> bool,
) -> Result<T, Error> {
    let (to_caller, messages) = mpsc::channel::<Progress>();
    let (answer, answers) = mpsc::channel::<ControlFlow<()>>();
    let mut tell = move |fraction, iterations, step, phase| {
        let sent = to_caller.send(Progress {
            fraction,
            iterations,
            step,
            phase,
        });
        // Nobody listens any more: the callback has panicked, so stop.
        sent.ok()
            .and_then(|()| answers.recv().ok())
            .unwrap_or(ControlFlow::Break(()))
    };
    let mut is_stopped = false;
    std::thread::scope(|scope| {
        let worker = std::thread::Builder::new()
            .spawn_scoped(scope, move || workers.install(move || work(&mut tell)))
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
            phase: "setup",
        };
        loop {
            let message = messages.recv_timeout(TICK);
            if let Ok(message) = &message {
                last = Progress {
                    fraction: last.fraction.max(message.fraction),
                    ..*message
                };
            }
            let told = match message {
                Err(RecvTimeoutError::Disconnected) => break,
                // Who has asked to stop is not asked again.
                _ if is_stopped => ControlFlow::Break(()),
                _ => callback(&last),
            };
            if told.is_break() {
                is_stopped = true;
                if breaks_off {
                    workers.interrupt.set();
                }
            }
            if message.is_ok() && answer.send(told).is_err() {
                break;
            }
        }
        match worker.join() {
            Ok(result) => {
                if !is_stopped && is_whole(&result) {
                    // There is nothing left to be stopped.
                    let _ = callback(&Progress {
                        fraction: 1.0,
                        ..last
                    });
                }
                Ok(result)
            }
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}

/// A pool whose threads have ended when it is dropped, to the last destructor: a program may unload the library then.
pub(crate) struct Workers {
    // Dropped first: that ends the threads.
    pool: rayon::ThreadPool,
    _threads: Threads,
    /// The flag that its threads heed.
    interrupt: Interrupt,
}

/// Waits for the threads.
struct Threads(Vec<JoinHandle<()>>);

impl Drop for Threads {
    fn drop(&mut self) {
        for thread in self.0.drain(..) {
            let _ = thread.join();
        }
    }
}

impl Workers {
    /// So many threads; 0: as many as the machine has.
    pub(crate) fn new(threads: usize) -> Result<Self, Error> {
        let mut handles = Threads(Vec::new());
        let interrupt = Interrupt::default();
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .spawn_handler(|thread| {
                let theirs = interrupt.clone();
                let run = move || {
                    theirs.heed();
                    thread.run();
                };
                handles.0.push(std::thread::Builder::new().spawn(run)?);
                Ok(())
            })
            .build();
        match pool {
            Ok(pool) => Ok(Self {
                pool,
                _threads: handles,
                interrupt,
            }),
            Err(e) => Err(Error::Threads {
                threads,
                why: e.to_string(),
            }),
        }
    }

    /// Runs `work` on the pool.
    pub(crate) fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        parallel::install(&self.pool, work)
    }
}
