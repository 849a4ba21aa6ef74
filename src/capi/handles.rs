//! Handles are numbers that look like pointers: nothing is ever read at their address, so that a wrong one is found out.

use std::any::Any;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::status::{CallResult, Failure};
use super::views::{Argument, refuse};

type Table = BTreeMap<usize, Arc<dyn Any + Send + Sync>>;

static TABLE: Mutex<Table> = Mutex::new(BTreeMap::new());
/// Never used twice. Not in the first page, and odd: no address of an object.
static NEXT: AtomicUsize = AtomicUsize::new(0x10001);

fn table() -> std::sync::MutexGuard<'static, Table> {
    TABLE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Makes a handle.
pub(crate) fn add<H, T: Any + Send + Sync>(thing: Arc<T>) -> *mut H {
    let number = NEXT.fetch_add(2, Ordering::SeqCst);
    table().insert(number, thing);
    core::ptr::without_provenance_mut(number)
}

/// What the handle stands for.
pub(crate) fn get<H, T: Any + Send + Sync>(handle: *const H, argument: Argument) -> CallResult<Arc<T>> {
    if handle.is_null() {
        return Err(refuse!(argument.itself() => NullPointer, "NULL"));
    }
    let found = table().get(&(handle as usize)).cloned();
    found
        .and_then(|thing| thing.downcast().ok())
        .ok_or_else(|| wrong(argument))
}

/// Takes it out of the table; with the last user it ends.
pub(crate) fn remove<H>(handle: *const H) {
    let mut table = table();
    let gone = table.remove(&(handle as usize));
    if table.is_empty() {
        // Its last node.
        *table = BTreeMap::new();
    }
    drop(table);
    drop(gone);
}

fn wrong(argument: Argument) -> Failure {
    refuse!(argument.itself() => BadHandle, "not a living handle of this kind")
}
