//! What the enumerations of the C interface mean. Made of the library's tables by src/declarations: do not edit.

use super::statuses::{NONE, STATUSES};
use fairmesh::{AttemptEnd, Entry, Error, FillOutcome, FlatReason, GapKind, LoopKind, LooseReason, OpenReason, Outcome, SharpFate};

/// The enumerations that `fairmesh_describe` knows. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_answer {
    /// A `fairmesh_status`.
    Status = 0,
    /// A `fairmesh_outcome`.
    Outcome = 1,
    /// A `fairmesh_loose_reason`.
    LooseReason = 2,
    /// A `fairmesh_attempt_end`.
    AttemptEnd = 3,
    /// A `fairmesh_fill_outcome`.
    FillOutcome = 4,
    /// A `fairmesh_fill_reason`.
    FillReason = 5,
    /// A `fairmesh_loop_kind`.
    LoopKind = 6,
    /// A `fairmesh_gap_kind`.
    GapKind = 7,
    /// A `fairmesh_sharp_fate`.
    SharpFate = 8,
}

/// By the numbers of a `fairmesh_answer`.
pub(crate) const ANSWERS: &[&[&[Entry]]] = &[
    &[STATUSES, Error::TABLE],
    &[Outcome::TABLE],
    &[&[NONE], LooseReason::TABLE],
    &[AttemptEnd::TABLE],
    &[FillOutcome::TABLE],
    &[&[NONE], OpenReason::TABLE, FlatReason::TABLE],
    &[LoopKind::TABLE],
    &[GapKind::TABLE],
    &[SharpFate::TABLE],
];
