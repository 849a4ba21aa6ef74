//! Numbers of the C interface as values of the library.

use super::status::{CallResult, fairmesh_status as Status};
use super::views::FieldPath;

/// A choice by its number.
pub(crate) fn chosen<T>(value: Option<T>, number: u32, of: &str, place: FieldPath) -> CallResult<T> {
    value.ok_or_else(|| place.refuse(Status::BadEnum, format_args!("{number} is no {of}")))
}

/// A number that may exceed what this machine counts.
pub(crate) fn count(n: u64) -> usize {
    usize::try_from(n).unwrap_or(usize::MAX)
}
