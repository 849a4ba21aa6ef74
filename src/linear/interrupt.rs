//! Stops long work from another thread.
//!
//! The threads of a run know its flag, so that whatever takes long can look at it, however deep it lies. There are two ways to look:
//! [`is_stopped`] is for who has something to return or to put in order, and returns as soon as it can, with whatever it has; who has
//! asked for that work looks as well, and drops it. [`checkpoint`] is for all others: within [`unless_stopped`] it leaves them at once by
//! unwinding, as the queries of rust-analyzer are left, without a result that nobody wants in every signature on the way.

use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

thread_local! {
    /// The flag of the run that this thread works for.
    static OWN: RefCell<Interrupt> = RefCell::default();
}

/// A flag that long work looks at. Its clones are the same flag.
#[derive(Debug, Clone, Default)]
pub struct Interrupt(Arc<Flags>);

#[derive(Debug, Default)]
struct Flags {
    is_set: AtomicBool,
    /// Within [`unless_stopped`].
    unwinds: AtomicBool,
}

/// What unwinds. No panic: it has no message, and calls no hook.
struct Stopped;

impl Interrupt {
    /// From now on the work is to end as soon as it can.
    pub fn set(&self) {
        self.0.is_set.store(true, Ordering::Relaxed);
    }

    /// Whether it is.
    pub fn is_set(&self) -> bool {
        self.0.is_set.load(Ordering::Relaxed)
    }

    /// From now on this thread works for the run with this flag. Returns the flag before.
    pub fn heed(&self) -> Self {
        OWN.replace(self.clone())
    }
}

/// Whether the run that this thread works for is to stop. To be asked every few milliseconds.
pub fn is_stopped() -> bool {
    OWN.with_borrow(Interrupt::is_set)
}

/// What `work` makes; none if the run is stopped before the end, or was before: then `work` is not begun. `work` may be left at every [`checkpoint`], on each of its threads:
/// what it has changed outside of itself is not to be used then. Where panics abort (WebAssembly) it ends as [`is_stopped`] lets it.
///
/// # Panics
/// If `work` does.
pub fn unless_stopped<T>(work: impl FnOnce() -> T) -> Option<T> {
    let run = OWN.with_borrow(Clone::clone);
    if run.is_set() {
        return None;
    }
    let outer = run.0.unwinds.swap(true, Ordering::Relaxed);
    let made = catch_unwind(AssertUnwindSafe(work));
    run.0.unwinds.store(outer, Ordering::Relaxed);
    match made {
        Ok(made) => (!run.is_set()).then_some(made),
        Err(left) if left.is::<Stopped>() => None,
        Err(panic) => resume_unwind(panic),
    }
}

/// Leaves the work of [`unless_stopped`] if the run is to stop. To be passed every few milliseconds.
pub fn checkpoint() {
    let leaves = |run: &Interrupt| run.is_set() && run.0.unwinds.load(Ordering::Relaxed);
    if cfg!(panic = "unwind") && OWN.with_borrow(leaves) {
        resume_unwind(Box::new(Stopped));
    }
}

#[cfg(test)]
mod tests {
    use super::{Interrupt, checkpoint, is_stopped, unless_stopped};

    #[test]
    fn a_thread_heeds_the_flag_of_its_run_alone() {
        let (one, other) = (Interrupt::default(), Interrupt::default());
        let before = one.heed();
        other.set();
        assert!(!is_stopped());
        one.clone().set();
        assert!(is_stopped() && std::thread::spawn(|| !is_stopped()).join().unwrap());
        before.heed();
        assert!(!is_stopped());
    }

    #[test]
    fn work_is_left_at_a_checkpoint_and_a_panic_is_not_taken_for_that() {
        let run = Interrupt::default();
        let before = run.heed();
        assert_eq!(unless_stopped(|| 7), Some(7));
        assert!(std::panic::catch_unwind(|| unless_stopped(|| panic!("a test"))).is_err());
        let left = unless_stopped(|| {
            checkpoint();
            // What ends within has no say about what is around it.
            assert_eq!(unless_stopped(|| 7), Some(7));
            run.set();
            checkpoint();
            unreachable!("the checkpoint is passed")
        });
        assert_eq!(left, None::<()>);
        assert_eq!(unless_stopped(|| unreachable!("it is begun")), None::<()>);
        // Whoever wants what was made until then is left alone.
        checkpoint();
        before.heed();
    }
}
