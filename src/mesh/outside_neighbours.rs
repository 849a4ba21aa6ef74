//! The surface around the region: who is whose neighbour in the outside ring and a little beyond it. Nothing is asked of
//! these triangles but that they name vertices that have a place.

use super::region::RegionMesh;
use super::rows::Rows;

/// The triangles outside the region and a little beyond.
pub(crate) fn outside_triangles(region: &RegionMesh) -> impl Iterator<Item = [u32; 3]> + Clone {
    let half_edges = &region.half_edges;
    let outside = &half_edges.triangles[half_edges.region_triangles..];
    outside.iter().chain(&region.beyond).copied()
}

/// Neighbours of the vertices outside, boundary vertices included, along edges of triangles that are not of the region.
#[derive(Debug, Clone)]
pub(crate) struct OutsideNeighbours {
    neighbour: Rows<u32>,
}

/// Fits reach this many rings where single precision matters.
/// Of 27 cases, half: 3 change by up to 0.005 edges; double: 3 change by up to 0.6 edges, +9 % iterations.
pub(crate) const RINGS_WIDE: usize = 8;

/// And so many where curvature is to be continued: as many from each of the virtual loops, the furthest of which lies as far outside. Half or
/// double: as of `LAYERS_OF_CURVATURE` of holes.
pub(crate) const RINGS_OF_CURVATURE: usize = 2 * RINGS_WIDE;

/// Which vertices were found already; scratch.
#[derive(Debug, Clone, Default)]
pub(crate) struct Marks(Vec<bool>);

impl OutsideNeighbours {
    /// Those of a region, by local vertex number.
    pub(crate) fn new(region: &RegionMesh) -> Self {
        Self::of_triangles(region.vertex_ids.len(), outside_triangles(region))
    }

    /// Those along the edges of some triangles of so many vertices.
    pub(crate) fn of_triangles(vertices: usize, triangles: impl Iterator<Item = [u32; 3]> + Clone) -> Self {
        let pairs = triangles.flat_map(|[a, b, c]| [(a, b), (a, c), (b, c), (b, a), (c, a), (c, b)]);
        Self {
            neighbour: Rows::collect(vertices, pairs),
        }
    }

    /// The neighbours of a vertex.
    pub(crate) fn of(&self, v: u32) -> &[u32] {
        self.neighbour.row(v as usize)
    }

    /// The vertices within `N` edges of `v`, without `v`: `ends[k]` of them, the first of the list, within `k + 1`.
    pub(crate) fn rings<const N: usize>(&self, v: u32, found: &mut Vec<u32>) -> [usize; N] {
        found.clear();
        found.push(v);
        let mut begin = 0;
        let mut ends = [0; N];
        for end in &mut ends {
            let last = found.len();
            for k in begin..last {
                for &j in self.neighbour.row(found[k] as usize) {
                    // A few dozen: looking through them is faster than a table.
                    if !found.contains(&j) {
                        found.push(j);
                    }
                }
            }
            found[last..].sort_unstable();
            begin = last;
            *end = found.len() - 1;
        }
        found.remove(0);
        ends
    }

    /// The vertices within so many edges of `v`, without `v`: hundreds.
    pub(crate) fn disc(&self, v: u32, rings: usize, found: &mut Vec<u32>, marks: &mut Marks) {
        let marks = &mut marks.0;
        marks.resize(self.neighbour.len(), false);
        found.clear();
        found.push(v);
        marks[v as usize] = true;
        let mut begin = 0;
        for _ in 0..rings {
            let last = found.len();
            for k in begin..last {
                for &j in self.neighbour.row(found[k] as usize) {
                    if !std::mem::replace(&mut marks[j as usize], true) {
                        found.push(j);
                    }
                }
            }
            begin = last;
        }
        found.iter().for_each(|&j| marks[j as usize] = false);
        found.remove(0);
        found.sort_unstable();
    }
}
