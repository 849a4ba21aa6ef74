//! Versions, names and defaults.

use core::ffi::CStr;

use std::ffi::c_char;

use super::guard::guarded;
use super::option_structs::{
    fairmesh_bridge_options, fairmesh_fill_options, fairmesh_options, fairmesh_remesh_options,
};
use super::types::*;
use super::views::*;
use fairmesh::{Entry, table_entry};

/// Major version of the interface: it changes when something does that programs rely on.
pub const FAIRMESH_VERSION_MAJOR: u32 = 0;
/// Minor version: it grows when something is added; while the major version is 0, also when something changes.
pub const FAIRMESH_VERSION_MINOR: u32 = 1;
/// Patch version.
pub const FAIRMESH_VERSION_PATCH: u32 = 0;

/// The version of the library that runs: 65536 major + 256 minor + patch. Compare it with `FAIRMESH_VERSION_MAJOR` and so on,
/// which are those of the header.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_version() -> u32 {
    FAIRMESH_VERSION_MAJOR << 16 | FAIRMESH_VERSION_MINOR << 8 | FAIRMESH_VERSION_PATCH
}

/// The same as text, such as "0.1.0". Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_version_string() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    VERSION.as_ptr().cast()
}

/// Fills options with the defaults. `struct_size` is `sizeof(fairmesh_options)`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_options_init(
    options: *mut fairmesh_options,
    struct_size: usize,
) -> fairmesh_status {
    guarded(core::ptr::null_mut(), |_| {
        init_struct(options, struct_size, &fairmesh_options::standard())
    })
}

/// Fills options of hole filling with the defaults. `struct_size` is `sizeof(fairmesh_fill_options)`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_fill_options_init(
    options: *mut fairmesh_fill_options,
    struct_size: usize,
) -> fairmesh_status {
    guarded(core::ptr::null_mut(), |_| {
        init_struct(options, struct_size, &fairmesh_fill_options::standard())
    })
}

/// Fills options of bridges with the defaults. `struct_size` is `sizeof(fairmesh_bridge_options)`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_bridge_options_init(
    options: *mut fairmesh_bridge_options,
    struct_size: usize,
) -> fairmesh_status {
    guarded(core::ptr::null_mut(), |_| {
        init_struct(options, struct_size, &fairmesh_bridge_options::standard())
    })
}

/// Fills options of remeshing with the defaults. `struct_size` is `sizeof(fairmesh_remesh_options)`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_remesh_options_init(
    options: *mut fairmesh_remesh_options,
    struct_size: usize,
) -> fairmesh_status {
    guarded(core::ptr::null_mut(), |_| {
        init_struct(options, struct_size, &fairmesh_remesh_options::standard())
    })
}

/// What the tables say of a number.
pub(crate) fn told(tables: &[&[Entry]], number: u32, what: fn(&Entry) -> &'static CStr) -> *const c_char {
    const UNKNOWN: Entry = table_entry!(0, "unknown", "", "");
    let mut entries = tables.iter().copied().flatten();
    what(entries.find(|entry| entry.number() == number).unwrap_or(&UNKNOWN)).as_ptr()
}
