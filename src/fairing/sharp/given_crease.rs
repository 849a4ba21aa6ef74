//! Creases that the caller lays through a region.

use super::parting::{CreasePoint, Followed};
use crate::fairing::sharp_edge::{CreaseEnd, SharpEdge, SharpFate};

/// A crease between two ends, along edges that are there: whether others would fit better is not asked.
#[derive(Debug, Clone)]
pub(crate) struct GivenCrease {
    pub(crate) ends: [CreaseEnd; 2],
    /// From end to end.
    pub(crate) vertices: Vec<u32>,
    /// Where they are to lie, and the normals beside them.
    pub(crate) points: Vec<CreasePoint>,
}

impl GivenCrease {
    pub(super) fn followed(&self) -> Followed {
        Followed {
            vertices: self.vertices.clone(),
            points: self.points.clone(),
        }
    }

    pub(super) fn told(&self) -> SharpEdge {
        SharpEdge {
            ends: self.ends.to_vec(),
            fate: SharpFate::of(1, true),
            vertices: self.vertices.clone(),
        }
    }
}
