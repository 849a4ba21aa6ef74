//! The C interface: exported functions, `repr(C)` types, and what keeps the two worlds apart. `include/fairmesh.h` is made
//! of this; docs/c-api.md describes the conventions.
//!
//! Every function runs in [`guard`], checks all of its arguments before any work ([`structs`], [`views`], [`input`]), works with
//! memory in reserve and writes its outputs last ([`outputs`], [`memory`], [`memory_bounds`]). Handles are in [`handles`]. This is the
//! only place of the crate with `unsafe` code.
#![allow(unsafe_code, reason = "pointers from C; see the SAFETY lines")]
#![allow(non_camel_case_types, reason = "the names of the header")]
#![allow(
    missing_docs,
    reason = "what is not in the header is not public outside of the crate"
)]
#![allow(clippy::result_large_err, reason = "an error may not need memory")]
#![warn(clippy::undocumented_unsafe_blocks)]

mod about;
mod bridge;
mod callback;
mod carry_over;
mod choices;
mod edits;
mod erase;
mod estimate;
mod fair;
mod fill;
mod fill_options;
mod guard;
mod handles;
mod hole_records;
#[cfg(feature = "hooks")]
mod hooks;
mod input;
mod live;
mod log;
mod loop_choice;
mod memory;
mod memory_bounds;
mod memory_use;
#[rustfmt::skip]
mod numbers;
#[rustfmt::skip]
#[allow(clippy::approx_constant, clippy::needless_update, reason = "generated")]
mod option_structs;
mod options;
mod outputs;
mod patch_sizes;
mod reading;
mod records;
mod refill;
mod region;
mod report;
#[cfg(feature = "hooks")]
mod reserve_hooks;
mod results;
mod round;
mod settings;
mod solvers;
mod status;
mod statuses;
mod steps;
mod structs;
#[rustfmt::skip]
mod texts;
mod types;
mod versioned;
mod views;
#[cfg(target_family = "wasm")]
mod wasm;

pub use about::*;
pub use bridge::fairmesh_bridge;
pub use callback::{fairmesh_progress, fairmesh_progress_fn};
pub use carry_over::fairmesh_carry_over;
pub use edits::{fairmesh_budget, fairmesh_bulge_range, fairmesh_edit, fairmesh_edit_kind, fairmesh_frame};
pub use erase::*;
pub use estimate::fairmesh_memory_needed;
pub use fair::*;
pub use fill::*;
pub use live::*;
pub use log::{fairmesh_log_fn, fairmesh_set_log};
pub use loop_choice::{fairmesh_join, fairmesh_loop_filter, fairmesh_place};
pub use option_structs::{
    FAIRMESH_CONTINUITY_AUTO, FAIRMESH_RELAX_AUTO, FAIRMESH_SHARP_AUTO, fairmesh_bridge_options,
    fairmesh_fill_options, fairmesh_options, fairmesh_remesh_options, fairmesh_round_options,
};
pub use reading::*;
pub use refill::fairmesh_refill;
pub use region::fairmesh_select_region;
pub use region::{fairmesh_combine, fairmesh_region_kind, fairmesh_region_step, fairmesh_seed_kind};
pub use round::fairmesh_round;
pub use settings::fairmesh_setting;
pub use status::{FAIRMESH_NO_ELEMENT, fairmesh_error};
pub use steps::*;
pub use texts::*;
pub use types::*;
