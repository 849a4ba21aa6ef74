//! Holes: boundary loops, their triangulation, refinement and fairing in one call.

mod creases;
mod crossing;
mod fill;
mod lenses;
mod loops;
mod mend;
mod outcome;
mod parents;
mod patch;
mod piece;
mod refine;
mod relax;
mod remesh;
mod rounding;
mod surroundings;
mod triangulate;
mod units;

pub use fill::{FillOptions, Filled, Loops, fill_holes, fill_holes_with_progress};
pub use loops::{BoundaryLoop, LoopKind, boundary_loops, boundary_loops_joined};
pub use outcome::{FillOutcome, FlatReason, LoopReport, OpenReason};
pub use parents::Parents;
pub use remesh::{RemeshOptions, Remeshed, remesh_region};
