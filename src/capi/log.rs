//! What the library would write to stderr, for hosts that have another place for it.

use std::ffi::{c_char, c_void};
use std::panic::PanicHookInfo;
use std::sync::{Mutex, PoisonError};

use super::guard::{guarded, words};
use super::status::{MESSAGE, Text, fairmesh_status};

/// Called with a line of English, which is valid during the call. It may be called on any thread, and by several at once; it may not throw or
/// `longjmp`, and it calls no function of the library.
pub type fairmesh_log_fn = Option<unsafe extern "C" fn(message: *const c_char, user_data: *mut c_void)>;

/// A function of the host, with what it gets.
#[derive(Clone, Copy)]
struct Log {
    function: unsafe extern "C" fn(message: *const c_char, user_data: *mut c_void),
    user_data: *mut c_void,
}

// SAFETY: the pointer is only handed back to the host's function, which by contract any thread may call.
unsafe impl Send for Log {}

static LOG: Mutex<Option<Log>> = Mutex::new(None);

/// Hands what the library would write to stderr to a function, for the whole process: the words of a bug that was caught, for which the call
/// answers INTERNAL. `log` may be NULL: to stderr again.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_set_log(log: fairmesh_log_fn, user_data: *mut c_void) -> fairmesh_status {
    guarded(core::ptr::null_mut(), |_| {
        let log = log.map(|function| Log { function, user_data });
        let is_set = log.is_some();
        *LOG.lock().unwrap_or_else(PoisonError::into_inner) = log;
        match is_set {
            true => std::panic::set_hook(Box::new(tell)),
            false => drop(std::panic::take_hook()),
        }
        Ok(())
    })
}

/// Tells of a panic, in as many characters as an error's message has. The lock is free while the host's function runs.
fn tell(panic: &PanicHookInfo<'_>) {
    let log = *LOG.lock().unwrap_or_else(PoisonError::into_inner);
    let said = words(panic.payload());
    let text = match panic.location() {
        Some(at) => Text::<MESSAGE>::new(format_args!("{}:{}: {said}", at.file(), at.line())),
        None => Text::<MESSAGE>::new(format_args!("{said}")),
    };
    if let Some(Log { function, user_data }) = log {
        // SAFETY: the host's function, with what its documentation says.
        unsafe { function(text.characters().as_ptr(), user_data) };
    }
}
