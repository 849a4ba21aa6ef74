//! HalfEdges.

/// HalfEdges.
#[derive(Debug)]
pub struct HalfEdges;
