//! Memory for hosts of the WebAssembly module, which have no `malloc` in it: they write inputs and read outputs there. Not
//! in the header; docs/releasing.md shows them.

use std::alloc::{Layout, alloc, dealloc};
use std::ptr::null_mut;

/// What every scalar and struct of the interface is aligned to.
const ALIGN: usize = 16;

/// So many bytes, aligned to 16; null if they are not there, or none are asked for.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn fairmesh_wasm_allocate(size: usize) -> *mut u8 {
    match Layout::from_size_align(size, ALIGN) {
        // SAFETY: the layout is not empty.
        Ok(layout) if size > 0 => super::memory::without_reserve(|| unsafe { alloc(layout) }),
        _ => null_mut(),
    }
}

/// Gives a block back, with the size that it was asked with. Null is left alone.
///
/// # Safety
/// The block is one of [`fairmesh_wasm_allocate`], with this size, not given back before.
#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn fairmesh_wasm_free(block: *mut u8, size: usize) {
    if let (false, Ok(layout)) = (block.is_null(), Layout::from_size_align(size, ALIGN)) {
        // SAFETY: the caller's block was allocated with this layout.
        unsafe { dealloc(block, layout) }
    }
}
