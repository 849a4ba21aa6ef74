//! The region of a triangle mesh: half-edges, rings, and what is free, fixed and boundary.

mod cut;
pub mod editable;
pub mod halfedge;
pub mod hierarchy;
pub mod islands;
pub mod region;
pub mod rings;
mod rounding;
pub mod surroundings;

pub use editable::EditableMesh;
pub use halfedge::HalfEdges;
pub use hierarchy::{ProgressiveMesh, Split, decimate, level_sizes};
pub use region::{Region, Selection};
pub use rings::Rings;
pub use surroundings::Surroundings;

/// No element: the partner of a boundary half-edge, the flap that is not there.
pub const NONE: u32 = u32::MAX;
