//! Rings.

/// Rings.
#[derive(Debug)]
pub struct Rings;
