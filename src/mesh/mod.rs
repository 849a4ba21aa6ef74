//! The region of a triangle mesh: half-edges, rings, and which vertices are free, fixed and boundary.

pub(crate) mod boundary_loops;
mod checks;
pub(crate) mod circles;
pub(crate) mod coarsening;
pub(crate) mod coincident;
mod components;
mod cut;
pub(crate) mod disjoint_sets;
mod disk;
mod draft;
pub(crate) mod edge_set;
pub(crate) mod editable;
mod excerpt;
pub(crate) mod graded;
pub(crate) mod half_edge_edits;
pub(crate) mod halfedge;
pub(crate) mod hierarchy;
pub(crate) mod input;
mod islands;
pub(crate) mod membrane;
pub(crate) mod numbering;
pub(crate) mod outside_neighbours;
pub(crate) mod parted;
pub(crate) mod places;
pub(crate) mod region;
pub(crate) mod rings;
mod rounding;
pub(crate) mod rows;
pub(crate) mod selection;
mod stitches;

pub(crate) use coincident::Joined;
pub(crate) use editable::EditableMesh;
pub(crate) use halfedge::NONE;
pub(crate) use hierarchy::{ProgressiveMesh, decimate, level_sizes};
pub(crate) use outside_neighbours::OutsideNeighbours;
pub(crate) use region::RegionMesh;
pub(crate) use rings::Rings;
pub(crate) use selection::Selection;

#[cfg(test)]
mod tests;
