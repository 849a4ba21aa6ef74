//! The C interface: exported functions, `repr(C)` types, and what keeps the two worlds apart. `include/fairmesh.h` is made
//! of this; docs/c-api.md describes the conventions.
//!
//! Every function checks all of its arguments before any work ([`views`], [`input`]), runs in [`guard`], holds its memory in
//! reserve ([`memory`], [`need`]), and writes its outputs last. Handles are in [`handles`]. This is the only place of
//! the crate with `unsafe` code.
#![allow(unsafe_code, reason = "pointers from C; see the SAFETY lines")]
#![allow(non_camel_case_types, reason = "the names of the header")]
#![allow(
    missing_docs,
    reason = "what is not in the header is not public outside of the crate"
)]
#![warn(clippy::undocumented_unsafe_blocks)]

pub mod exports;
pub mod guard;
mod handles;
#[cfg(feature = "capi-hooks")]
pub mod hooks;
mod input;
pub mod memory;
mod need;
mod report;
mod results;
mod solvers;
pub mod status;
pub mod types;
mod views;
