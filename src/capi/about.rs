//! Versions, names and defaults.

use core::ffi::c_char;

use super::guard::guarded;
use super::options::default_options;
use super::report;
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::{FillOptions, RemeshOptions};

use fairmesh_status as Status;

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

/// The name of a `fairmesh_status`, in English; of any number. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_status_name(status: i32) -> *const c_char {
    Status::name(status).as_ptr()
}

/// The name of a `fairmesh_outcome`, such as "converged"; of any number. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_outcome_name(outcome: u32) -> *const c_char {
    report::outcome_name(outcome).as_ptr()
}

/// Fills options with the defaults. `struct_size` is `sizeof(fairmesh_options)`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_options_init(
    options: *mut fairmesh_options,
    struct_size: usize,
) -> fairmesh_status {
    guarded(core::ptr::null_mut(), || {
        init_struct(options, struct_size, &default_options())
    })
}

/// Fills options of hole filling with the defaults. `struct_size` is `sizeof(fairmesh_fill_options)`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_fill_options_init(
    options: *mut fairmesh_fill_options,
    struct_size: usize,
) -> fairmesh_status {
    guarded(core::ptr::null_mut(), || {
        init_struct(options, struct_size, &default_fill_options())
    })
}

/// Fills options of remeshing with the defaults. `struct_size` is `sizeof(fairmesh_remesh_options)`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_remesh_options_init(
    options: *mut fairmesh_remesh_options,
    struct_size: usize,
) -> fairmesh_status {
    guarded(core::ptr::null_mut(), || {
        init_struct(options, struct_size, &default_remesh_options())
    })
}

pub fn default_fill_options() -> fairmesh_fill_options {
    let options = FillOptions::default();
    fairmesh_fill_options {
        struct_size: size_of::<fairmesh_fill_options>() as u32,
        fair: u32::from(options.fair),
        max_edges: u64::MAX,
        loops: fairmesh_indices {
            data: core::ptr::null(),
            count: 0,
            stride: 0,
        },
        density: options.density,
        max_new_vertices: options.max_new_vertices as u64,
    }
}

pub fn default_remesh_options() -> fairmesh_remesh_options {
    let options = RemeshOptions::default();
    fairmesh_remesh_options {
        struct_size: size_of::<fairmesh_remesh_options>() as u32,
        reserved: 0,
        density: options.density,
        max_vertices: options.max_vertices as u64,
    }
}
