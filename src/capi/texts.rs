//! What the enumerations of the C interface mean. Made of the library's tables by src/declarations: do not edit.

use core::ffi::c_char;

use super::about::told;
use super::statuses::{NONE, STATUSES};
use fairmesh::{AttemptEnd, Entry, Error, FillOutcome, FlatReason, LooseReason, OpenReason, Outcome};

/// The name of a `fairmesh_status`, such as "null_pointer"; "unknown" for other numbers. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_status_name(status: i32) -> *const c_char {
    told(&[STATUSES, Error::TABLE], status.cast_unsigned(), Entry::c_name)
}

/// What a `fairmesh_status` means: English, begins in lower case, ends without a full stop. Empty for other numbers. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_status_text(status: i32) -> *const c_char {
    told(&[STATUSES, Error::TABLE], status.cast_unsigned(), Entry::c_text)
}

/// What can be done about a `fairmesh_status`, written like its text; empty if there is nothing to do. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_status_remedy(status: i32) -> *const c_char {
    told(&[STATUSES, Error::TABLE], status.cast_unsigned(), Entry::c_remedy)
}

/// The name of a `fairmesh_outcome`, such as "converged_poor_triangles"; "unknown" for other numbers. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_outcome_name(outcome: u32) -> *const c_char {
    told(&[Outcome::TABLE], outcome, Entry::c_name)
}

/// What a `fairmesh_outcome` means: English, begins in lower case, ends without a full stop. Empty for other numbers. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_outcome_text(outcome: u32) -> *const c_char {
    told(&[Outcome::TABLE], outcome, Entry::c_text)
}

/// What can be done about a `fairmesh_outcome`, written like its text; empty if there is nothing to do. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_outcome_remedy(outcome: u32) -> *const c_char {
    told(&[Outcome::TABLE], outcome, Entry::c_remedy)
}

/// The name of a `fairmesh_loose_reason`, such as "suspicious_normals"; "unknown" for other numbers. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_loose_reason_name(loose_reason: u32) -> *const c_char {
    told(&[&[NONE], LooseReason::TABLE], loose_reason, Entry::c_name)
}

/// What a `fairmesh_loose_reason` means: English, begins in lower case, ends without a full stop. Empty for other numbers. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_loose_reason_text(loose_reason: u32) -> *const c_char {
    told(&[&[NONE], LooseReason::TABLE], loose_reason, Entry::c_text)
}

/// What can be done about a `fairmesh_loose_reason`, written like its text; empty if there is nothing to do. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_loose_reason_remedy(loose_reason: u32) -> *const c_char {
    told(&[&[NONE], LooseReason::TABLE], loose_reason, Entry::c_remedy)
}

/// The name of a `fairmesh_attempt_end`, such as "unsound"; "unknown" for other numbers. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_attempt_end_name(attempt_end: u32) -> *const c_char {
    told(&[AttemptEnd::TABLE], attempt_end, Entry::c_name)
}

/// What a `fairmesh_attempt_end` means: English, begins in lower case, ends without a full stop. Empty for other numbers. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_attempt_end_text(attempt_end: u32) -> *const c_char {
    told(&[AttemptEnd::TABLE], attempt_end, Entry::c_text)
}

/// What can be done about a `fairmesh_attempt_end`, written like its text; empty if there is nothing to do. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_attempt_end_remedy(attempt_end: u32) -> *const c_char {
    told(&[AttemptEnd::TABLE], attempt_end, Entry::c_remedy)
}

/// The name of a `fairmesh_fill_outcome`, such as "linear"; "unknown" for other numbers. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_fill_outcome_name(fill_outcome: u32) -> *const c_char {
    told(&[FillOutcome::TABLE], fill_outcome, Entry::c_name)
}

/// What a `fairmesh_fill_outcome` means: English, begins in lower case, ends without a full stop. Empty for other numbers. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_fill_outcome_text(fill_outcome: u32) -> *const c_char {
    told(&[FillOutcome::TABLE], fill_outcome, Entry::c_text)
}

/// What can be done about a `fairmesh_fill_outcome`, written like its text; empty if there is nothing to do. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_fill_outcome_remedy(fill_outcome: u32) -> *const c_char {
    told(&[FillOutcome::TABLE], fill_outcome, Entry::c_remedy)
}

/// The name of a `fairmesh_fill_reason`, such as "non_manifold"; "unknown" for other numbers. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_fill_reason_name(fill_reason: u32) -> *const c_char {
    told(&[&[NONE], OpenReason::TABLE, FlatReason::TABLE], fill_reason, Entry::c_name)
}

/// What a `fairmesh_fill_reason` means: English, begins in lower case, ends without a full stop. Empty for other numbers. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_fill_reason_text(fill_reason: u32) -> *const c_char {
    told(&[&[NONE], OpenReason::TABLE, FlatReason::TABLE], fill_reason, Entry::c_text)
}

/// What can be done about a `fairmesh_fill_reason`, written like its text; empty if there is nothing to do. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_fill_reason_remedy(fill_reason: u32) -> *const c_char {
    told(&[&[NONE], OpenReason::TABLE, FlatReason::TABLE], fill_reason, Entry::c_remedy)
}
