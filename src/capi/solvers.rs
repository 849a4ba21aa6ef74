//! What a handle of a solver stands for.

use std::sync::{Arc, Mutex, TryLockError};

use super::callback::HostCallback;
use super::guard::{guarded, point};
use super::handles;
use super::memory::Reserve;
use super::outputs::with_memory;
use super::status::{CallResult, Failure, fairmesh_error, fairmesh_status as Status};
use super::structs::refuse;
use super::types::fairmesh_solver;
use super::views::{Argument, Call};
use fairmesh::{ProgressCallback, Solver};

/// One user at a time. Who panics with the lock poisons it.
pub(crate) struct Shared {
    solver: Mutex<HeldSolver>,
    /// The process that its threads are in: a forked one has none of them.
    process: u32,
}

pub(crate) struct HeldSolver {
    pub solver: Solver,
    pub callback: HostCallback,
    pub vertices: usize,
    /// What each call sets aside.
    pub need: u64,
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
        Self {
            solver: Mutex::new(solver),
            process: process(),
        }
    }

    /// The solver of a handle, in the process that it was made in.
    fn of(handle: *const fairmesh_solver) -> CallResult<Arc<Self>> {
        let shared = handles::get::<_, Self>(handle, Argument(1))?;
        match shared.process == process() {
            true => Ok(shared),
            false => {
                Err(refuse!(Argument(1).itself() => BadHandle, "a solver of the process that was forked"))
            }
        }
    }

    /// Whether somebody uses it.
    pub(crate) fn is_busy(&self) -> bool {
        matches!(self.solver.try_lock(), Err(TryLockError::WouldBlock))
    }
}

/// The number of this process, where there are several.
fn process() -> u32 {
    if cfg!(target_family = "wasm") {
        0
    } else {
        std::process::id()
    }
}

/// Frees a solver that nobody uses. In a forked process it is left alone: it would wait for threads that are not there.
pub(crate) fn free(handle: *const fairmesh_solver) -> CallResult {
    if Shared::of(handle)?.is_busy() {
        return Err(busy());
    }
    handles::remove(handle);
    Ok(())
}

/// Runs a function whose first argument is a solver, if nobody else uses it.
pub(crate) fn with_solver(
    solver: *const fairmesh_solver,
    error: *mut fairmesh_error,
    body: impl FnOnce(&mut HeldSolver, &mut Call) -> CallResult,
) -> Status {
    guarded(error, |call| {
        let shared = Shared::of(solver)?;
        let mut solver = shared.solver.try_lock().map_err(|why| match why {
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
