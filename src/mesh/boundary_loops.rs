//! The simple loops of the region's boundary, in their order.

use super::halfedge::HalfEdges;
use super::halfedge::NONE;
use super::region::RegionMesh;
use super::rings::Rings;

/// The closed runs of boundary edges that visit no vertex twice, each as boundary vertices (numbered from the first of them)
/// with the region on the left, beginning at the smallest one. A run that comes back to one of its vertices is several of them.
pub(crate) fn boundary_loops(region: &RegionMesh, rings: &Rings) -> Vec<Vec<u32>> {
    let half_edges: &HalfEdges = &region.half_edges;
    let local = |v: u32| v - region.free as u32;
    let ends = |&h: &u32| (local(half_edges.origin(h)), local(half_edges.target(h)));
    let mut edges: Vec<(u32, u32)> = rings.boundary_half_edges.iter().map(ends).collect();
    edges.sort_unstable();
    // Per vertex its first edge that is not walked yet.
    let mut next: Vec<usize> = (0..region.boundary as u32)
        .map(|b| edges.partition_point(|edge| edge.0 < b))
        .collect();
    let mut walk = |from: u32| {
        let at = next[from as usize];
        let edge = edges.get(at).filter(|edge| edge.0 == from)?;
        next[from as usize] += 1;
        Some(edge.1)
    };
    let mut place = vec![NONE; region.boundary];
    let mut loops = Vec::new();
    for first in 0..region.boundary as u32 {
        let mut along: Vec<u32> = Vec::new();
        let mut at = Some(first);
        while let Some(b) = at {
            if place[b as usize] == NONE {
                place[b as usize] = along.len() as u32;
                along.push(b);
            } else {
                // Closed: what lies between is a loop of its own.
                let closed = along.split_off(place[b as usize] as usize + 1);
                closed.iter().for_each(|&c| place[c as usize] = NONE);
                loops.push(from_smallest(std::iter::once(b).chain(closed).collect()));
            }
            at = walk(b);
        }
        along.iter().for_each(|&b| place[b as usize] = NONE);
    }
    loops.retain(|along| along.len() > 2);
    // No two have an edge in common.
    loops.sort_unstable_by_key(|along| (along[0], along[1]));
    loops
}

/// The same loop from its smallest vertex on.
fn from_smallest(mut along: Vec<u32>) -> Vec<u32> {
    let smallest = (0..along.len()).min_by_key(|&k| along[k]).unwrap_or(0);
    along.rotate_left(smallest);
    along
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Selection;
    use fairmesh_shapes::{Sampling, catenoid_band};

    #[test]
    fn a_band_has_two_loops_of_neighbours() {
        let shape = catenoid_band(300, Sampling::Irregular { seed: 7 }, 2);
        let region =
            RegionMesh::new(&shape.positions, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
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
                assert_contains!(rings.boundary_ring(b as usize), &next);
            }
        }
    }

    /// A fixed triangle that touches the rest of the boundary in one vertex: two loops, not none.
    #[test]
    fn a_loop_that_meets_itself_is_two() {
        let shape = catenoid_band(600, Sampling::Irregular { seed: 7 }, 2);
        let of = |free: &[bool]| {
            let region = RegionMesh::new(&shape.positions, &shape.triangles, Selection::Mask(free)).ok()?;
            let rings = Rings::new(&region);
            Some((boundary_loops(&region, &rings), region))
        };
        let whole = of(&shape.free).unwrap().0;
        let fixed = |t: &&[u32; 3]| t.iter().filter(|&&v| !shape.free[v as usize]).count() == 1;
        let mut touched = 0;
        for t in shape.triangles.iter().filter(fixed) {
            // The two free vertices of a triangle at the boundary, held: the loop takes a way around them, or meets itself.
            let mut free = shape.free.clone();
            t.iter().for_each(|&v| free[v as usize] = false);
            let Some((loops, region)) = of(&free) else {
                continue;
            };
            let visits = loops.iter().map(Vec::len).sum::<usize>();
            let mut seen: Vec<u32> = loops.concat();
            seen.sort_unstable();
            let count = seen.len();
            seen.dedup();
            touched += count - seen.len();
            assert!(
                loops.len() >= whole.len() && visits + 3 > whole.concat().len(),
                "{t:?}"
            );
            assert_all!(seen.iter(), |&b| (b as usize) < region.boundary);
        }
        assert_above!(touched, 0);
    }
}
