//! The simple loops of the region's boundary, in their order.

use super::halfedge::HalfEdges;
use super::region::Region;
use super::rings::Rings;
use crate::mesh::NONE;

/// The closed runs of boundary edges that visit no vertex twice, each as boundary vertices (numbered from the first of them)
/// with the region on the left, beginning at the smallest one. What hangs together with a vertex that is visited twice is left out.
pub(crate) fn boundary_loops(region: &Region, rings: &Rings) -> Vec<Vec<u32>> {
    let half_edges: &HalfEdges = &region.half_edges;
    let local = |v: u32| v - region.free as u32;
    let mut next = vec![NONE; region.boundary];
    let mut is_simple = vec![true; region.boundary];
    for &h in &rings.boundary_half_edges {
        let (a, b) = (local(half_edges.origin(h)), local(half_edges.target(h)));
        is_simple[a as usize] &= next[a as usize] == NONE;
        next[a as usize] = b;
    }
    let mut is_seen = vec![false; region.boundary];
    let mut loops = Vec::new();
    for first in 0..region.boundary as u32 {
        let mut along = Vec::new();
        let mut b = first;
        while b != NONE && !std::mem::replace(&mut is_seen[b as usize], true) {
            along.push(b);
            b = next[b as usize];
        }
        if along.len() > 2 && b == first && along.iter().all(|&b| is_simple[b as usize]) {
            loops.push(along);
        }
    }
    loops
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Selection;
    use fairmesh_shapes::{Sampling, catenoid_band};

    #[test]
    fn a_band_has_two_loops_of_neighbours() {
        let shape = catenoid_band(300, Sampling::Irregular { seed: 7 }, 2);
        let region = Region::new(&shape.positions, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
        let rings = Rings::new(&region);
        let loops = boundary_loops(&region, &rings);
        assert_eq!(loops.len(), 2);
        assert_eq!(
            loops.iter().map(Vec::len).sum::<usize>(),
            rings.boundary_half_edges.len()
        );
        for along in &loops {
            for (k, &b) in along.iter().enumerate() {
                let next = region.free as u32 + along[(k + 1) % along.len()];
                assert!(rings.boundary_ring(b as usize).contains(&next));
            }
        }
    }
}
