//! What is told of the sharp edges that reach the boundary.

use crate::quality::crease::KINK;
use crate::support::table::choices;

/// A crease of the surroundings that arrives at the boundary of a region.
#[derive(Debug, Clone, PartialEq)]
pub struct CreaseEnd {
    /// The boundary vertex at which it arrives.
    pub vertex: u32,
    /// Unit tangent, into the region.
    pub direction: [f64; 3],
    /// Curvature of the crease there, by its tangent's turn per length, in the unit of the positions; 0 where its vertices outside do not tell.
    pub curvature: [f64; 3],
    /// How far the curvature may be off; infinite where the vertices outside are too few to tell.
    pub(crate) curvature_error: f64,
    /// Unit normals of the surface left and right of it.
    pub normals: [[f64; 3]; 2],
    /// The angle between them, degrees: above 0 on a ridge, below on a groove.
    pub angle: f64,
    /// The standard error of the angle, degrees.
    pub error: f64,
    /// The vertices outside along the crease, from `vertex` on; along two where it starts in their corner.
    pub chains: Vec<Vec<u32>>,
}

choices! {
    /// What became of ends of creases that belong together.
    #[non_exhaustive]
    SharpFate {
        0 "goes_on" GoesOn => "the crease goes on through the region, from end to end", "";
        1 "corner" Corner => "creases go on to a corner in the region, or to two that a crease joins", "";
        2 "alone" Alone => "no other end fits it: the region is smooth there",
            "select so much that the crease ends outside, or leaves the region again";
        3 "no_path" NoPath => "no path of edges, or no sound patch, can follow the crease: the surface is smooth there",
            "triangulate the region anew, or move its boundary";
    }
}

/// Ends of creases that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct SharpEdge {
    /// One, two, or as many as meet in a corner; four with two corners.
    pub ends: Vec<CreaseEnd>,
    /// What became of them.
    pub fate: SharpFate,
    /// The vertices along the creases, from end to end, or from each end to its corner one after the other, and from
    /// corner to corner; empty where it does not go on. Those
    /// that were free have been placed on the creases.
    pub vertices: Vec<u32>,
}

impl SharpEdge {
    /// Is not followed after all.
    pub(crate) fn stop(&mut self) {
        if !self.vertices.is_empty() {
            self.fate = SharpFate::NoPath;
            self.vertices.clear();
        }
    }

    /// Whether it does not go on, though an end of it is as wide as a crease along the boundary that is no success.
    pub(crate) fn stops_wide(&self) -> bool {
        self.vertices.is_empty() && self.ends.iter().any(|end| end.angle.abs() > KINK)
    }
}

impl SharpFate {
    /// Of ends with so many branches between them: none, one, or three to a corner.
    pub(crate) fn of(branches: usize, is_followed: bool) -> Self {
        match (branches, is_followed) {
            (0, _) => Self::Alone,
            (_, false) => Self::NoPath,
            (1, true) => Self::GoesOn,
            (_, true) => Self::Corner,
        }
    }
}
