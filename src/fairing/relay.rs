//! Threads: a pool for each call, and the progress callback on the caller's thread.

use std::ops::ControlFlow;
use std::sync::mpsc;

use super::{Progress, Watcher};
use crate::error::Error;
use crate::solve::control::Callback;

/// Runs `work` on the pool and `callback` on this thread, which waits for it in between.
pub(super) fn relay<T: Send>(
    pool: &rayon::ThreadPool,
    callback: &mut Watcher<'_>,
    work: impl for<'t> FnOnce(&'t mut Callback<'t>) -> T + Send,
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
    std::thread::scope(|scope| {
        let worker = std::thread::Builder::new()
            .spawn_scoped(scope, move || pool.install(move || work(&mut tell)))
            .map_err(|e| Error::Threads {
                threads: 1,
                why: e.to_string(),
            })?;
        for message in messages {
            if answer.send(callback(&message)).is_err() {
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
