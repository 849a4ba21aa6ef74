//! Stops long work from another thread.
//!
//! The threads of a run know its flag, so that whatever takes long can look at it, however deep it lies: [`is_stopped`]. What sees it set
//! returns as soon as it can, with whatever it has; who has asked for the work looks as well, and drops that.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

thread_local! {
    /// The flag of the run that this thread works for.
    static OWN: RefCell<Interrupt> = RefCell::default();
}

/// A flag that long work looks at. Its clones are the same flag.
#[derive(Debug, Clone, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// From now on the work is to end as soon as it can.
    pub fn set(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether it is.
    pub fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
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

#[cfg(test)]
mod tests {
    use super::{Interrupt, is_stopped};

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
}
