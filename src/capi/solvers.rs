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
use fairmesh::{ProgressCallback, Solver};

/// One user at a time. Who panics with the lock poisons it.
pub(crate) struct Shared(Mutex<HeldSolver>);

pub(crate) struct HeldSolver {
    pub solver: Solver,
    pub callback: HostCallback,
    pub vertices: usize,
    /// What each call sets aside.
    pub need: usize,
    /// For the thread that waits between the calls. Last, so that it outlives the solver.
    pub _standing: Reserve,
}

impl HeldSolver {
    /// Works with the solver, with memory set aside, and with what tells the host how far it is.
    pub(crate) fn work<T>(
        &mut self,
        work: impl FnOnce(&mut Solver, &mut ProgressCallback<'_>) -> CallResult<T>,
    ) -> CallResult<T> {
        with_memory(self.need, &self.callback, |watch| {
            work(&mut self.solver, &mut |progress| watch.tell(progress))
        })
    }
}

impl Shared {
    pub(crate) fn new(solver: HeldSolver) -> Self {
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
    body: impl FnOnce(&mut HeldSolver, &mut Call) -> CallResult,
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
