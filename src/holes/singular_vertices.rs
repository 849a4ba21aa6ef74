//! Gaps that meet in a point of which each side has a vertex of its own: so meshes are written whose vertices have to be manifold.

use crate::holes::links::{BOUNDARY, Links};
use crate::mesh::coincident::Coincident;
use crate::mesh::halfedge::next;
use crate::mesh::places::places;

/// The half-edges of a loop, and the bad edge that it met.
pub(super) type HalfEdgeLoop = (Vec<u32>, Option<u32>);

/// Which vertices of the boundary lie at the same place.
#[derive(Default)]
pub(super) struct BoundaryPlaces {
    /// Ascending.
    vertices: Vec<u32>,
    /// Per vertex which of these is the first at its place; none where each has a place of its own.
    first: Option<Vec<u32>>,
    /// The first vertices at places where loops were parted, ascending.
    pinches: Vec<u32>,
}

impl BoundaryPlaces {
    /// Whether any vertices have a place in common.
    pub(super) fn has_any(&self) -> bool {
        self.first.is_some()
    }

    /// Whether loops were parted where a vertex is.
    pub(super) fn is_pinch(&self, v: u32) -> bool {
        self.pinches.binary_search(&self.of(v)).is_ok()
    }

    /// The first vertex at the place of one.
    pub(super) fn of(&self, v: u32) -> u32 {
        let first = self.first.as_ref().zip(self.vertices.binary_search(&v).ok());
        first.map_or(v, |(first, at)| self.vertices[first[at] as usize])
    }
}

impl Links<'_> {
    /// Which of the runs' vertices lie at the same place.
    pub(super) fn places(
        &self,
        found: &[HalfEdgeLoop],
        positions: &[[f64; 3]],
        coincident: Coincident,
    ) -> BoundaryPlaces {
        let Some(within) = coincident.within() else {
            return BoundaryPlaces::default();
        };
        let on_runs = found.iter().flat_map(|(run, _)| run);
        let mut vertices: Vec<u32> = on_runs.map(|&h| self.origin(next(h))).collect();
        vertices.sort_unstable();
        vertices.dedup();
        BoundaryPlaces {
            first: places(positions, &vertices, within),
            vertices,
            pinches: Vec::new(),
        }
    }

    /// The simple loops of one that passes a place twice, by copies of a vertex that are not joined: gaps that meet there in a point.
    /// `last` is scratch.
    pub(super) fn parted(
        &self,
        run: Vec<u32>,
        places: &mut BoundaryPlaces,
        last: &mut [u32],
    ) -> Vec<Vec<u32>> {
        let (mut found, mut rest) = (Vec::new(), Vec::<u32>::new());
        let mut pinches = Vec::new();
        let place = |&g: &u32| places.of(self.origin(next(g))) as usize;
        for h in run {
            let before = last[place(&h)] as usize;
            // Two edges alone are no gap.
            if before < rest.len() && rest.len() - before > 2 {
                let inner = rest.split_off(before);
                inner.iter().for_each(|g| last[place(g)] = BOUNDARY);
                found.push(inner);
                pinches.push(place(&h) as u32);
            }
            last[place(&h)] = rest.len() as u32;
            rest.push(h);
        }
        rest.iter().for_each(|g| last[place(g)] = BOUNDARY);
        found.push(rest);
        if !pinches.is_empty() {
            places.pinches.extend(pinches);
            places.pinches.sort_unstable();
        }
        found
    }
}
