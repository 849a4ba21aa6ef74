//! What a program needs of its process that safe Rust does not offer.
//!
//! Rust's collections abort when memory runs out. The C library must survive that (its reserve in `memory.rs`); a program
//! need not, but it shall say what happened, and end with a code of its own: [`OrExit`].

#![allow(
    unsafe_code,
    reason = "an allocator, and calls of the system; see the SAFETY lines"
)]
#![warn(clippy::undocumented_unsafe_blocks)]

use std::alloc::{GlobalAlloc, Layout, System};

/// The system's allocator, which ends the program with `code` behind the line `message` on stderr when memory runs out.
///
/// ```
/// #[global_allocator]
/// static ALLOCATOR: fairmesh_process::OrExit = fairmesh_process::OrExit { message: "memory ran out\n", code: 4 };
///
/// assert_eq!(vec![1; 1000].len(), 1000);
/// ```
#[derive(Debug)]
pub struct OrExit {
    /// What is said, with its line end.
    pub message: &'static str,
    /// The exit code.
    pub code: i32,
}

impl OrExit {
    /// The block, if there is one.
    #[inline]
    fn checked(&self, block: *mut u8) -> *mut u8 {
        if block.is_null() {
            self.exit();
        }
        block
    }

    /// Ends the process without another allocation; destructors and exit handlers, which may allocate, do not run.
    #[cfg(unix)]
    #[cold]
    fn exit(&self) -> ! {
        use std::sync::atomic::{AtomicBool, Ordering};
        static ENDING: AtomicBool = AtomicBool::new(false);
        // One thread speaks; others wait for its end.
        while ENDING.swap(true, Ordering::SeqCst) {
            std::thread::yield_now();
        }
        // SAFETY: the bytes are there; what cannot be written cannot be told.
        unsafe {
            libc::write(
                libc::STDERR_FILENO,
                self.message.as_ptr().cast(),
                self.message.len(),
            );
            libc::_exit(self.code)
        }
    }

    #[cfg(not(unix))]
    #[cold]
    fn exit(&self) -> ! {
        std::process::exit(self.code)
    }
}

// SAFETY: every block is the system's.
unsafe impl GlobalAlloc for OrExit {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's layout.
        self.checked(unsafe { System.alloc(layout) })
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's layout.
        self.checked(unsafe { System.alloc_zeroed(layout) })
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: the caller's block, which is the system's, with its layout.
        self.checked(unsafe { System.realloc(block, layout, size) })
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        // SAFETY: the caller's block, which is the system's, with its layout.
        unsafe { System.dealloc(block, layout) }
    }
}

/// The signal for a file that grows beyond `ulimit -f`. Where it is handled, writing fails instead, as on a full disk.
#[cfg(unix)]
pub const FILE_TOO_LARGE: i32 = libc::SIGXFSZ;

/// Whether the process was started with this signal ignored, as `nohup` does; then a program leaves it so.
///
/// ```
/// # #[cfg(unix)]
/// assert!(!fairmesh_process::is_ignored(9), "SIGKILL cannot be ignored");
/// ```
#[cfg(unix)]
#[must_use]
pub fn is_ignored(signal: i32) -> bool {
    let mut action = std::mem::MaybeUninit::<libc::sigaction>::uninit();
    // SAFETY: the first pointer may be null: nothing is changed. The second has room for what is asked, and is read only
    // where it was written.
    unsafe {
        libc::sigaction(signal, std::ptr::null(), action.as_mut_ptr()) == 0
            && action.assume_init().sa_sigaction == libc::SIG_IGN
    }
}
