//! What a handle of a solver stands for.

use std::sync::{Mutex, MutexGuard, TryLockError};

use super::callback::HostCallback;
use super::guard::point;
use super::memory::Reserve;
use super::memory_bounds;
use super::status::{CallResult, Failure, fairmesh_status as Status};
use fairmesh::{Progress, ProgressCallback, Session};

/// One user at a time. Who panics with the lock poisons it.
pub(crate) struct Shared(Mutex<Solver>);

pub(crate) struct Solver {
    pub session: Session,
    pub callback: HostCallback,
    pub vertices: usize,
    /// What each call sets aside.
    pub need: usize,
    /// For the thread that waits between the calls. Last, so that it outlives the session.
    pub _standing: Reserve,
}

impl Shared {
    pub(crate) fn new(solver: Solver) -> Self {
        Self(Mutex::new(solver))
    }

    /// The solver, if nobody uses it.
    pub(crate) fn take(&self) -> CallResult<MutexGuard<'_, Solver>> {
        self.0.try_lock().map_err(|why| match why {
            TryLockError::WouldBlock => Failure::new(Status::Busy, format_args!("the solver is in use")),
            TryLockError::Poisoned(_) => Failure::new(
                Status::Internal,
                format_args!("a bug has broken this solver; free it"),
            ),
        })
    }

    /// Works with the session, with memory set aside, and with what tells the host how far it is.
    pub(crate) fn work<T>(
        &self,
        work: impl FnOnce(&mut Session, &mut ProgressCallback<'_>) -> CallResult<T>,
    ) -> CallResult<T> {
        let mut solver = self.take()?;
        let _reserve = memory_bounds::reserve(solver.need)?;
        let callback = solver.callback.fresh();
        point();
        let mut tell = |progress: &Progress| callback.tell(progress);
        let made = work(&mut solver.session, &mut tell)?;
        callback.memory()?;
        Ok(made)
    }

    /// Whether somebody uses it.
    pub(crate) fn is_busy(&self) -> bool {
        matches!(self.0.try_lock(), Err(TryLockError::WouldBlock))
    }
}
