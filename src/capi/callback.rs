//! The callback, and the watch on the memory.

use std::ffi::{c_char, c_void};
use std::ops::ControlFlow;

use super::memory;
use super::status::{CallResult, Failure, Text, fairmesh_status as Status};
use fairmesh::Progress;

/// How far a run is.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_progress {
    /// `sizeof(fairmesh_progress)` of the library: what is behind it does not exist.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// Between 0 and 1, never falling.
    pub fraction: f64,
    /// Nonlinear iterations so far, of the component of the region that is at work.
    pub iterations: u64,
    /// Its last step norm, in its diagonals; NaN before the first iteration.
    pub step: f64,
    /// What is being done, in a word or two; English. Valid during the callback.
    pub phase: *const c_char,
}

/// Called after every iteration (of components that are less than a thousandth of the region, now and then), on the thread that made the call. 0 goes on, anything else stops. It may not throw or
/// `longjmp`. It may use other handles; its own solver answers BUSY.
pub type fairmesh_progress_fn =
    Option<unsafe extern "C" fn(progress: *const fairmesh_progress, user_data: *mut c_void) -> i32>;

/// The callback, and the watch on the memory.
#[derive(Clone, Copy)]
pub(crate) struct HostCallback {
    progress: fairmesh_progress_fn,
    user_data: *mut c_void,
    failures: usize,
}

// SAFETY: the pointer is only handed back to the caller's function, on the thread that makes the call.
unsafe impl Send for HostCallback {}
// SAFETY: as above.
unsafe impl Sync for HostCallback {}

/// A call that its callback has stopped, and that has no result then.
pub(crate) fn cancelled() -> Failure {
    Failure::new(Status::Cancelled, format_args!("stopped by the callback"))
}

impl HostCallback {
    pub(crate) fn new(progress: fairmesh_progress_fn, user_data: *mut c_void) -> Self {
        Self {
            progress,
            user_data,
            failures: memory::failures(),
        }
    }

    /// For calls that tell nothing.
    pub(crate) fn none() -> Self {
        Self::new(None, core::ptr::null_mut())
    }

    /// The watch begins now.
    pub(crate) fn fresh(&self) -> Self {
        Self::new(self.progress, self.user_data)
    }

    /// Passes a message on; stops when memory has run out.
    pub(crate) fn tell(&self, progress: &Progress) -> ControlFlow<()> {
        if memory::failures() != self.failures {
            return ControlFlow::Break(());
        }
        let Some(function) = self.progress else {
            return ControlFlow::Continue(());
        };
        let phase = Text::<48>::new(format_args!("{}", progress.phase)).characters();
        let told = fairmesh_progress {
            struct_size: size_of::<fairmesh_progress>() as u32,
            reserved: 0,
            fraction: progress.fraction,
            iterations: progress.iterations as u64,
            step: progress.step,
            phase: phase.as_ptr(),
        };
        // SAFETY: the caller's function, with what its documentation says.
        let answer = unsafe { function(&raw const told, self.user_data) };
        if answer == 0 {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    }

    /// An error if memory has run out since this was made.
    pub(crate) fn memory(&self) -> CallResult {
        if memory::failures() == self.failures {
            Ok(())
        } else {
            Err(Failure::out_of_memory())
        }
    }
}
