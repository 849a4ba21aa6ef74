//! Structs that begin with their size.

use super::edits::{fairmesh_budget, fairmesh_bulge_range, fairmesh_frame};
use super::option_structs::{
    fairmesh_bridge_options, fairmesh_fill_options, fairmesh_options, fairmesh_remesh_options,
    fairmesh_round_options,
};
use super::status::fairmesh_error;
use super::structs::Versioned;
use super::types::*;

macro_rules! versioned {
    ($($name:ident $first:expr),* $(,)?) => { $(
        // SAFETY: see the definition: integers, floats, pointers, and functions that may be NULL.
        unsafe impl Versioned for $name { const FIRST: usize = $first; }
        const _: () = assert!(size_of::<$name>() >= $first);
    )* };
}

const WORD: usize = size_of::<usize>();

versioned! {
    fairmesh_mesh 24 + 6 * WORD,
    fairmesh_selection 8 + 3 * WORD,
    fairmesh_options 112 + 18 * WORD,
    fairmesh_report 288,
    fairmesh_component 160,
    fairmesh_attempt 80,
    fairmesh_continuity 80,
    fairmesh_sharp_edge 32,
    fairmesh_crease_end 104,
    fairmesh_fill_options 64 + 9 * WORD,
    fairmesh_remesh_options 24,
    fairmesh_bridge_options 16,
    fairmesh_round_options 32 + 3 * WORD,
    fairmesh_crease 88,
    fairmesh_bridge_report 24,
    fairmesh_loop 56,
    fairmesh_fill_report 104,
    fairmesh_join_suggestion 48,
    fairmesh_info 56,
    fairmesh_bump 40,
    fairmesh_budget 32,
    fairmesh_frame 24,
    fairmesh_bulge_range 24,
}

const _: () = assert!(size_of::<fairmesh_error>() == 256);
