//! What tests let go wrong (feature `hooks`): not in the header, and not in libraries that are installed.

use std::sync::atomic::{AtomicI64, AtomicIsize, AtomicUsize, Ordering};

/// Allocations until one is refused; negative: none.
static UNTIL: AtomicI64 = AtomicI64::new(-1);
/// How many are refused then.
static REFUSALS: AtomicI64 = AtomicI64::new(0);
/// Allocations counted since the last [`fairmesh_test_refuse`].
static COUNT: AtomicUsize = AtomicUsize::new(0);
/// Guarded calls until one panics; negative: none.
static PANIC: AtomicI64 = AtomicI64::new(-1);

/// Blocks in use.
static BLOCKS: AtomicIsize = AtomicIsize::new(0);

/// Told by the allocator.
pub(crate) fn count_block(by: isize) {
    BLOCKS.fetch_add(by, Ordering::SeqCst);
}

/// Blocks in use: what grows here leaks.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn fairmesh_test_blocks() -> i64 {
    BLOCKS.load(Ordering::SeqCst) as i64
}

/// Asked by the allocator.
pub(crate) fn refuse_allocation() -> bool {
    COUNT.fetch_add(1, Ordering::SeqCst);
    if UNTIL.load(Ordering::SeqCst) < 0 {
        return false;
    }
    let k = UNTIL.fetch_sub(1, Ordering::SeqCst);
    if k > 0 {
        return false;
    }
    // Stays at the end of the count.
    UNTIL.store(0, Ordering::SeqCst);
    if REFUSALS.fetch_sub(1, Ordering::SeqCst) > 0 {
        return true;
    }
    UNTIL.store(-1, Ordering::SeqCst);
    false
}

/// Asked by every guarded call.
pub(crate) fn panic_if_asked() {
    if PANIC.load(Ordering::SeqCst) >= 0 && PANIC.fetch_sub(1, Ordering::SeqCst) == 0 {
        panic!("a test asked for this");
    }
}

/// Refuses `refusals` allocations after `after` more that are granted; a negative `after` ends it. Returns the number
/// of allocations since the last call of this.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn fairmesh_test_refuse(after: i64, refusals: i64) -> u64 {
    REFUSALS.store(refusals, Ordering::SeqCst);
    UNTIL.store(after, Ordering::SeqCst);
    COUNT.swap(0, Ordering::SeqCst) as u64
}

/// Lets a guarded call panic after `after` that do not.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn fairmesh_test_panic(after: i64) {
    PANIC.store(after, Ordering::SeqCst);
}
