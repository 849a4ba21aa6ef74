//! Region.

/// Region.
#[derive(Debug)]
pub struct Region;
