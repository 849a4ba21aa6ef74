//! Holes: boundary loops, their triangulation, refinement and fairing in one call, each by itself or several together.

mod bridges;
mod creases;
mod crossing;
mod erase;
mod fill;
mod groups;
mod joint;
mod lenses;
mod loop_set;
mod loops;
mod mend;
mod objection;
mod options;
mod outcome;
mod parents;
mod patch;
mod piece;
mod refine;
mod relax;
mod remesh;
mod rim;
mod rounding;
mod shape;
mod surroundings;
mod thinned;
mod triangulate;
mod units;

pub use erase::{Erased, erase};
pub use fill::{Filled, fill_holes, fill_holes_with_progress, suggest_joins};
pub use groups::{JoinReason, JoinSuggestion};
pub use loops::{BoundaryLoop, LoopKind, boundary_loops, boundary_loops_joined, triangle_components};
pub use options::{FillOptions, Join, LoopFilter, Loops, OnFailure, Place};
pub use outcome::{FillOutcome, FlatReason, LoopReport, OpenReason};
pub use parents::Parents;
pub use remesh::{RemeshOptions, Remeshed, remesh_region};
pub use rim::{Rim, RimReport, Roughness, rim_roughness};
