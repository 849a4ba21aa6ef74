//! Memory that runs out must be a status, not an abort.
//!
//! Rust's collections abort the process when an allocation fails, and an allocator may not unwind. So a call sets a reserve
//! aside before it works: one block, never touched while there is memory, that is sized for all of its work
//! ([`super::memory_bounds`]). When an allocation fails, the reserve serves it and all that follow, the failure is counted, the work stops
//! at the next iteration, and the call answers OUT_OF_MEMORY. The allocator is that of the C libraries only: a Rust
//! program that uses the crate keeps its own.
//!
//! Why so much for it: the hosts hold a user's unsaved work, which an abort would take along, and large meshes are where memory runs out.
//! Simpler ways do not keep the promise: `try_reserve` does not reach what `std`, nalgebra, rayon and rstar allocate inside; the hook for
//! failed allocations may not return, on stable Rust; memory that is only tried before the work and given back is gone when somebody else
//! takes it; and memory that is handed out but never reused would have to be as large as all allocations of a call together. So the reserve is a heap: a list of free stretches, first fit, as slow as it likes, since it serves one call that
//! fails. While there is memory it costs one allocation that is never touched for each call.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::{Cell, UnsafeCell};
use std::ptr::null_mut;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Every block of a reserve is a multiple of this, and aligned so.
const UNIT: usize = 64;

/// The allocator of the C libraries.
pub(crate) struct Reserving;

#[global_allocator]
static ALLOCATOR: Reserving = Reserving;

/// Allocations that the system refused.
static FAILURES: AtomicUsize = AtomicUsize::new(0);
/// Blocks that live in reserves. Almost always zero: then no address needs to be looked up.
static LIVE: AtomicUsize = AtomicUsize::new(0);
static RESERVES: Mutex<List> = Mutex::new(List(null_mut(), null_mut()));

thread_local! {
    /// This thread has not set its reserve aside yet, and may not use those of others.
    static WITHOUT: Cell<bool> = const { Cell::new(false) };
}

/// The reserves, newest first; and the nursery, once it is needed.
struct List(*mut Segment, *mut Segment);

/// Small blocks come from here: some of them are kept by a thread until it ends, and would hold a reserve.
#[repr(align(64))]
struct Nursery(UnsafeCell<[u8; NURSERY]>);

const NURSERY: usize = 128 << 10;
/// What is small.
const SMALL: usize = 4 << 10;

// SAFETY: only touched under the lock.
unsafe impl Sync for Nursery {}

static NURSERY_ROOM: Nursery = Nursery(UnsafeCell::new([0; NURSERY]));

// SAFETY: the pointers lead to segments that only the holder of the lock touches.
unsafe impl Send for List {}

/// The head of a reserve, at its beginning.
struct Segment {
    next: *mut Segment,
    /// With this head.
    size: usize,
    /// A call still counts on it.
    held: bool,
    /// Blocks that are in use.
    live: usize,
    free: *mut Hole,
}

/// A free stretch, described at its beginning; ascending.
struct Hole {
    next: *mut Hole,
    size: usize,
}

/// Room for the head, in whole units.
const HEAD: usize = UNIT;
const _: () = assert!(size_of::<Segment>() <= HEAD && size_of::<Hole>() <= UNIT);

fn rounded(size: usize) -> Option<usize> {
    size.max(1).checked_next_multiple_of(UNIT)
}

/// A reserve, set aside until this is dropped; then it goes back to the system with the last of its blocks.
pub(crate) struct Reserve(*mut Segment);

// SAFETY: the pointer is only used under the lock.
unsafe impl Send for Reserve {}

impl Reserve {
    /// Sets so many bytes aside; None if they are not there.
    pub(crate) fn new(bytes: usize) -> Option<Self> {
        let size = rounded(bytes)?.checked_add(HEAD)?;
        let layout = Layout::from_size_align(size, UNIT).ok()?;
        if refused() {
            return None;
        }
        // SAFETY: the layout is not empty.
        let start = unsafe { System.alloc(layout) };
        if start.is_null() {
            return None;
        }
        let mut list = lock();
        // SAFETY: `start` has `size` bytes, aligned to units, and is ours alone until it is in the list.
        let segment = unsafe { Segment::make(start, size, list.0) };
        list.0 = segment;
        #[cfg(feature = "hooks")]
        ASIDE.fetch_max(bytes, Ordering::SeqCst);
        Some(Self(segment))
    }
}

impl Drop for Reserve {
    fn drop(&mut self) {
        let mut list = lock();
        // SAFETY: the segment lives while it is held, and the lock is ours.
        unsafe {
            (*self.0).held = false;
            list.release(self.0);
        }
    }
}

/// Blocks that live in reserves; for tests.
#[cfg(feature = "hooks")]
pub(crate) fn live_blocks() -> usize {
    let list = lock();
    // SAFETY: under the lock.
    let kept = unsafe { list.1.as_ref() }.map_or(0, |nursery| nursery.live);
    LIVE.load(Ordering::SeqCst) - kept
}

/// Bytes in use at most since the last call, and the size of the largest reserve; for tests.
#[cfg(feature = "hooks")]
pub(crate) fn peak() -> (usize, usize) {
    (PEAK.swap(0, Ordering::SeqCst), ASIDE.swap(0, Ordering::SeqCst))
}

#[cfg(feature = "hooks")]
static USED: AtomicUsize = AtomicUsize::new(0);
#[cfg(feature = "hooks")]
static PEAK: AtomicUsize = AtomicUsize::new(0);
#[cfg(feature = "hooks")]
static ASIDE: AtomicUsize = AtomicUsize::new(0);

/// How many allocations have failed so far. A call that sees another number at its end has run out of memory.
pub(crate) fn failures() -> usize {
    FAILURES.load(Ordering::SeqCst)
}

/// Runs what can answer for a failed allocation itself, such as `try_reserve`, and must not use other calls' reserves.
pub(crate) fn without_reserve<T>(work: impl FnOnce() -> T) -> T {
    WITHOUT.with(|w| w.set(true));
    let done = work();
    WITHOUT.with(|w| w.set(false));
    done
}

fn lock() -> std::sync::MutexGuard<'static, List> {
    RESERVES.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

/// Whether a test lets this allocation fail.
fn refused() -> bool {
    #[cfg(feature = "hooks")]
    return super::hooks::refuse_allocation();
    #[cfg(not(feature = "hooks"))]
    false
}

impl Segment {
    /// Writes the heads into a stretch of memory.
    unsafe fn make(start: *mut u8, size: usize, next: *mut Segment) -> *mut Segment {
        let segment = start.cast::<Segment>();
        // SAFETY: the caller's stretch has `size` bytes, aligned to units.
        unsafe {
            let free = start.add(HEAD).cast::<Hole>();
            free.write(Hole {
                next: null_mut(),
                size: size - HEAD,
            });
            segment.write(Segment {
                next,
                size,
                held: true,
                live: 0,
                free,
            });
        }
        segment
    }
}

impl List {
    /// A block of any reserve; a small one of the nursery.
    unsafe fn take(&mut self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller holds the lock; the room of the nursery is used for this alone.
        unsafe {
            if layout.size() <= SMALL {
                if self.1.is_null() {
                    self.1 = Segment::make(NURSERY_ROOM.0.get().cast(), NURSERY, null_mut());
                }
                let block = Self::take_from(self.1, layout);
                if !block.is_null() {
                    return block;
                }
            }
            Self::take_from(self.0, layout)
        }
    }

    /// The segment that an address belongs to.
    unsafe fn of(&self, address: usize) -> *mut Segment {
        let nursery = NURSERY_ROOM.0.get() as usize;
        if (nursery..nursery + NURSERY).contains(&address) {
            return self.1;
        }
        let mut segment = self.0;
        // SAFETY: the caller holds the lock, and every segment in the list lives.
        unsafe {
            while !segment.is_null() {
                let start = segment as usize;
                if (start..start + (*segment).size).contains(&address) {
                    break;
                }
                segment = (*segment).next;
            }
        }
        segment
    }

    /// Gives a segment back to the system if nobody needs it any more.
    unsafe fn release(&mut self, segment: *mut Segment) {
        // SAFETY: the caller holds the lock, and the segment is in the list.
        unsafe {
            if (*segment).held || (*segment).live > 0 {
                return;
            }
            let mut at = &raw mut self.0;
            while *at != segment {
                at = &raw mut (**at).next;
            }
            *at = (*segment).next;
            let layout = Layout::from_size_align_unchecked((*segment).size, UNIT);
            System.dealloc(segment.cast(), layout);
        }
    }

    /// First fit in this segment or one behind it.
    unsafe fn take_from(mut segment: *mut Segment, layout: Layout) -> *mut u8 {
        let Some(size) = rounded(layout.size()) else {
            return null_mut();
        };
        // SAFETY: the caller holds the lock; holes lie within their segments, aligned to units.
        unsafe {
            while !segment.is_null() {
                let mut at = &raw mut (*segment).free;
                while !(*at).is_null() {
                    let hole = *at;
                    let start = (hole as usize).next_multiple_of(layout.align().max(UNIT));
                    let skip = start - hole as usize;
                    if skip + size <= (*hole).size {
                        let rest = (*hole).size - skip - size;
                        let mut next = (*hole).next;
                        if rest > 0 {
                            let behind = hole.cast::<u8>().add(skip + size).cast::<Hole>();
                            behind.write(Hole { next, size: rest });
                            next = behind;
                        }
                        if skip > 0 {
                            (*hole).size = skip;
                            (*hole).next = next;
                        } else {
                            *at = next;
                        }
                        (*segment).live += 1;
                        return hole.cast::<u8>().add(skip);
                    }
                    at = &raw mut (*hole).next;
                }
                segment = (*segment).next;
            }
        }
        null_mut()
    }

    /// Takes a block back and joins it with free neighbours.
    unsafe fn give(&mut self, segment: *mut Segment, block: *mut u8, size: usize) {
        // SAFETY: the caller holds the lock, and the block was taken from this segment with this size.
        unsafe {
            let mut before = null_mut::<Hole>();
            let mut after = (*segment).free;
            while !after.is_null() && (after as usize) < block as usize {
                before = after;
                after = (*after).next;
            }
            let mut hole = block.cast::<Hole>();
            hole.write(Hole { next: after, size });
            if before.is_null() {
                (*segment).free = hole;
            } else if before as usize + (*before).size == hole as usize {
                (*before).size += size;
                hole = before;
            } else {
                (*before).next = hole;
            }
            if !after.is_null() && hole as usize + (*hole).size == after as usize {
                (*hole).size += (*after).size;
                (*hole).next = (*after).next;
            }
            (*segment).live -= 1;
            self.release(segment);
        }
    }
}

/// A block from the reserves, counted as a failure of the system.
#[cold]
fn from_reserve(layout: Layout) -> *mut u8 {
    // Its caller answers for it: nobody else has run out of memory.
    if WITHOUT.with(Cell::get) {
        return null_mut();
    }
    FAILURES.fetch_add(1, Ordering::SeqCst);
    // SAFETY: under the lock.
    let block = unsafe { lock().take(layout) };
    if !block.is_null() {
        LIVE.fetch_add(1, Ordering::SeqCst);
        #[cfg(feature = "hooks")]
        {
            let size = rounded(layout.size()).unwrap_or(0);
            PEAK.fetch_max(USED.fetch_add(size, Ordering::SeqCst) + size, Ordering::SeqCst);
        }
    }
    block
}

/// Whether the block came from a reserve; then it is back there.
#[cold]
fn back_to_reserve(block: *mut u8, layout: Layout) -> bool {
    let mut list = lock();
    // SAFETY: under the lock; the block belongs to the segment that its address lies in.
    unsafe {
        let segment = list.of(block as usize);
        if segment.is_null() {
            return false;
        }
        // It was rounded when it was taken.
        list.give(segment, block, rounded(layout.size()).unwrap_or(0));
    }
    LIVE.fetch_sub(1, Ordering::SeqCst);
    #[cfg(feature = "hooks")]
    USED.fetch_sub(rounded(layout.size()).unwrap_or(0), Ordering::SeqCst);
    true
}

/// Counts blocks in use; for tests.
#[inline]
fn counted(_block: *mut u8, _by: isize) {
    #[cfg(feature = "hooks")]
    if !_block.is_null() {
        super::hooks::count_block(_by);
    }
}

fn in_reserve(block: *mut u8) -> bool {
    // SAFETY: under the lock.
    LIVE.load(Ordering::Acquire) > 0 && unsafe { !lock().of(block as usize).is_null() }
}

// SAFETY: blocks come from the system or from a segment of its, which keeps them apart, and go back to where they
// came from. Nothing here unwinds or allocates.
unsafe impl GlobalAlloc for Reserving {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let block = match refused() {
            true => null_mut(),
            // SAFETY: the caller's layout.
            false => unsafe { System.alloc(layout) },
        };
        let block = if block.is_null() {
            from_reserve(layout)
        } else {
            block
        };
        counted(block, 1);
        block
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        let block = match refused() {
            true => null_mut(),
            // SAFETY: the caller's layout.
            false => unsafe { System.alloc_zeroed(layout) },
        };
        if !block.is_null() {
            counted(block, 1);
            return block;
        }
        let block = from_reserve(layout);
        counted(block, 1);
        if !block.is_null() {
            // SAFETY: it has this size.
            unsafe { block.write_bytes(0, layout.size()) };
        }
        block
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        counted(block, -1);
        if LIVE.load(Ordering::Acquire) == 0 || !back_to_reserve(block, layout) {
            // SAFETY: then it came from the system.
            unsafe { System.dealloc(block, layout) }
        }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if !in_reserve(block) && !refused() {
            // SAFETY: it came from the system; the caller's layout and size.
            let moved = unsafe { System.realloc(block, layout, size) };
            if !moved.is_null() {
                return moved;
            }
        }
        // SAFETY: the caller's alignment, and a size that the caller vouches for.
        let new = unsafe { Layout::from_size_align_unchecked(size, layout.align()) };
        let moved = from_reserve(new);
        counted(moved, 1);
        if !moved.is_null() {
            // SAFETY: both have the smaller size, and do not overlap.
            unsafe {
                moved.copy_from_nonoverlapping(block, layout.size().min(size));
                self.dealloc(block, layout);
            }
        }
        moved
    }
}
