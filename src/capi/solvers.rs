//! What a handle of a solver stands for.

use std::sync::{Mutex, TryLockError};

use super::callback::HostCallback;
use super::guard::{guarded, point};
use super::handles;
use super::memory::Reserve;
use super::outputs::with_memory;
use super::status::{CallResult, Failure, fairmesh_error, fairmesh_status as Status};
use super::types::fairmesh_solver;
use super::views::{Argument, Call};
use fairmesh::{ProgressCallback, Session};

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

impl Solver {
    /// Works with the session, with memory set aside, and with what tells the host how far it is.
    pub(crate) fn work<T>(
        &mut self,
        work: impl FnOnce(&mut Session, &mut ProgressCallback<'_>) -> CallResult<T>,
    ) -> CallResult<T> {
        with_memory(self.need, &self.callback, |watch| {
            work(&mut self.session, &mut |progress| watch.tell(progress))
        })
    }
}

impl Shared {
    pub(crate) fn new(solver: Solver) -> Self {
        Self(Mutex::new(solver))
    }

    /// Whether somebody uses it.
    pub(crate) fn is_busy(&self) -> bool {
        matches!(self.0.try_lock(), Err(TryLockError::WouldBlock))
    }
}

/// Runs a function whose first argument is a solver, if nobody else uses it.
pub(crate) fn with_solver(
    solver: *const fairmesh_solver,
    error: *mut fairmesh_error,
    body: impl FnOnce(&mut Solver, &mut Call) -> CallResult,
) -> Status {
    guarded(error, |call| {
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        let mut solver = shared.0.try_lock().map_err(|why| match why {
            TryLockError::WouldBlock => busy(),
            TryLockError::Poisoned(_) => Failure::new(
                Status::Internal,
                format_args!("a bug has broken this solver; free it"),
            ),
        })?;
        point();
        body(&mut solver, call)
    })
}

pub(crate) fn busy() -> Failure {
    Failure::new(Status::Busy, format_args!("the solver is in use"))
}
