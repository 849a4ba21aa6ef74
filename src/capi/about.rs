//! Versions, names and defaults.

use std::ffi::c_char;

use super::guard::guarded;
use super::option_structs::{
    fairmesh_bridge_options, fairmesh_fill_options, fairmesh_options, fairmesh_remesh_options,
    fairmesh_round_options,
};
use super::texts::ANSWERS;
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

/// Fills options of rounding with the defaults. `struct_size` is `sizeof(fairmesh_round_options)`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_round_options_init(
    options: *mut fairmesh_round_options,
    struct_size: usize,
) -> fairmesh_status {
    guarded(core::ptr::null_mut(), |_| {
        init_struct(options, struct_size, &fairmesh_round_options::standard())
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

/// What a number that the library answers with is called, what it means, or what can be done about it: English; meanings and remedies
/// begin in lower case and end without a full stop. `answer` is a `fairmesh_answer`, the enumeration of `number`, and `text` a
/// `fairmesh_text`. "unknown" and empty for other numbers. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_describe(answer: u32, number: i64, text: u32) -> *const c_char {
    const UNKNOWN: Entry = table_entry!(0, "unknown", "", "");
    let tables = ANSWERS.get(answer as usize).copied().unwrap_or_default();
    let mut entries = tables.iter().copied().flatten();
    let entry = entries.find(|entry| i64::from(entry.number()) == number);
    let entry = entry.unwrap_or(&UNKNOWN);
    match text {
        of if of == fairmesh_text::Name as u32 => entry.c_name(),
        of if of == fairmesh_text::Meaning as u32 => entry.c_text(),
        of if of == fairmesh_text::Remedy as u32 => entry.c_remedy(),
        _ => c"",
    }
    .as_ptr()
}
