//! Creases that the caller lays through a region.

use super::branch::{Arrival, Branch};
use super::parting::Followed;
use super::path::Path;
use crate::fairing::sharp_edge::{CreaseEnd, SharpEdge, SharpFate};

/// A crease between two ends, along edges that are there: whether others would fit better is not asked.
#[derive(Debug, Clone)]
pub(crate) struct GivenCrease {
    pub(crate) ends: [CreaseEnd; 2],
    /// From end to end.
    pub(crate) vertices: Vec<u32>,
    /// Which part of its length is before each of them.
    pub(crate) parts: Vec<f64>,
}

impl GivenCrease {
    /// How it is followed; `None` where no curve leads from end to end.
    pub(super) fn followed(&self, positions: &[[f64; 3]]) -> Option<Followed> {
        let [first, last] = self.ends.each_ref().map(|end| Arrival::of(end, positions));
        Some(Followed {
            branch: Branch::between([&first, &last])?,
            path: Path::given(self.vertices.clone(), self.parts.clone()),
        })
    }

    pub(super) fn told(&self, is_followed: bool) -> SharpEdge {
        let vertices = is_followed.then(|| self.vertices.clone());
        SharpEdge {
            ends: self.ends.to_vec(),
            fate: SharpFate::of(1, is_followed),
            vertices: vertices.unwrap_or_default(),
        }
    }
}
