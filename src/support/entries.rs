//! Lists of what is given for numbers: vertices, most of the time.

/// By their numbers; those of one number stay in their order. Sorting by a closure of its own, each list would have its own code.
pub(crate) fn sort_by_number<T>(entries: &mut [(u32, T)]) {
    entries.sort_by_key(|entry| entry.0);
}
