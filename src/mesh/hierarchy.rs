//! The hierarchy of the paper's section 7.4: a progressive mesh made by half-edge collapses that keep the shortest edge
//! long and triangles round, and the way back, vertex by vertex.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use nalgebra::Vector3;

use super::editable::EditableMesh;
use super::region::RegionMesh;
use super::selection::Selection;
use crate::support::error::Error;

/// A collapse must leave no triangle with less than this roundness.
/// Half or double, of 1 case: none changes.
const LEAST_ROUNDNESS: f64 = 0.15;
/// A collapse leaves no triangle whose normal is further than this from that of the vertex: cosine of the angle.
/// Half or double, of 1 case: none changes.
const LEAST_COSINE: f64 = 0.2;

/// A mesh and the collapses that have led to it.
#[derive(Debug, Clone)]
pub(crate) struct ProgressiveMesh {
    mesh: EditableMesh,
    /// Half-edges `(u, v)` with `u` moved into `v`, in the order of the collapses.
    collapses: Vec<u32>,
    boundary: usize,
    free: usize,
}

/// A vertex that a split has brought back.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Split {
    /// The vertex.
    pub vertex: u32,
    /// The vertex that it had been moved into.
    pub parent: u32,
}

/// Collapses half-edges until `target` vertices (free and boundary) are left or no collapse is allowed. Shorter edges go
/// first, weighed by the roundness of the triangles they leave: `|q_u - q_v|` over the least roundness. No boundary vertex is
/// collapsed, and none loses its last free neighbour. Positions are those of `x` throughout; `region` numbers vertices.
pub(crate) fn decimate(region: &RegionMesh, x: &[Vector3<f64>], target: usize) -> ProgressiveMesh {
    let mut progressive = ProgressiveMesh {
        mesh: EditableMesh::new(region),
        collapses: Vec::new(),
        boundary: region.boundary,
        free: region.free,
    };
    let mut queue = Queue {
        heap: BinaryHeap::new(),
        stamp: vec![0; region.free],
    };
    for u in 0..region.free as u32 {
        queue.push(&progressive.mesh, x, u);
    }
    let mut around = Vec::new();
    while progressive.vertices() > target {
        let Some(Reverse((_, u, stamp, h))) = queue.heap.pop() else {
            break;
        };
        if queue.stamp[u as usize] != stamp {
            continue;
        }
        // What lies two edges away may have changed since.
        if !progressive.mesh.can_collapse(h) {
            queue.push(&progressive.mesh, x, u);
            continue;
        }
        around.clear();
        around.extend(progressive.mesh.outgoing(u).map(|g| progressive.mesh.target(g)));
        queue.stamp[u as usize] += 1;
        progressive.mesh.collapse(h);
        progressive.collapses.push(h);
        for &w in around.iter().filter(|&&w| region.is_free(w)) {
            queue.push(&progressive.mesh, x, w);
        }
    }
    progressive
}

impl ProgressiveMesh {
    /// Vertices that are there, free and boundary.
    pub(crate) fn vertices(&self) -> usize {
        self.free - self.collapses.len() + self.boundary
    }

    /// The mesh as it is now.
    pub(crate) fn mesh(&self) -> &EditableMesh {
        &self.mesh
    }

    /// Brings back the vertex collapsed last; `None` when all are there.
    pub(crate) fn refine(&mut self) -> Option<Split> {
        let h = self.collapses.pop()?;
        self.mesh.split(h);
        Some(Split {
            vertex: self.mesh.origin(h),
            parent: self.mesh.target(h),
        })
    }

    /// The region as it is now; its `vertex_ids` are the numbers of the region it was made from.
    ///
    /// # Errors
    /// None on a mesh that [`decimate`] has made.
    pub(crate) fn region(&self, x: &[Vector3<f64>]) -> Result<RegionMesh, Error> {
        let positions: Vec<[f64; 3]> = x.iter().map(|p| (*p).into()).collect();
        let triangles: Vec<[u32; 3]> = self.mesh.triangles().map(|(_, corners)| corners).collect();
        let mut is_there = vec![false; self.free];
        for &v in triangles.iter().flatten().filter(|&&v| self.mesh.is_free(v)) {
            is_there[v as usize] = true;
        }
        let free: Vec<u32> = (0..self.free as u32).filter(|&v| is_there[v as usize]).collect();
        RegionMesh::new(&positions, &triangles, Selection::Vertices(&free))
    }
}

/// Vertices per level, from the base to the given mesh: exponential growth (7.4). `levels` of at least 1.
pub(crate) fn level_sizes(base: usize, vertices: usize, levels: usize) -> Vec<usize> {
    let ratio = (vertices as f64 / base.max(1) as f64).max(1.0);
    let size = |k: usize| {
        let part = k as f64 / (levels.max(2) - 1) as f64;
        (base as f64 * libm::pow(ratio, part)).round() as usize
    };
    let mut sizes: Vec<usize> = (0..levels).map(size).collect();
    if let Some(last) = sizes.last_mut() {
        *last = vertices;
    }
    sizes
}

/// Candidates for a collapse, one per free vertex: (cost, vertex, stamp, half-edge).
struct Queue {
    heap: BinaryHeap<Reverse<(u64, u32, u32, u32)>>,
    stamp: Vec<u32>,
}

impl Queue {
    /// Enters the cheapest collapse of `u`; what was entered before counts no more.
    fn push(&mut self, mesh: &EditableMesh, x: &[Vector3<f64>], u: u32) {
        let stamp = &mut self.stamp[u as usize];
        *stamp += 1;
        let candidates = mesh.outgoing(u).filter_map(|h| Some((cost(mesh, x, h)?, h)));
        let cheapest = candidates.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        if let Some((cost, h)) = cheapest {
            // The bits of numbers that are not negative are ordered as they are.
            self.heap.push(Reverse((cost.to_bits(), u, *stamp, h)));
        }
    }
}

/// What the collapse of `h` costs; `None` where it is not allowed.
fn cost(mesh: &EditableMesh, x: &[Vector3<f64>], h: u32) -> Option<f64> {
    let (u, v) = (mesh.origin(h), mesh.target(h));
    let place = |w: u32| x[w as usize];
    let cross = |a: Vector3<f64>, b: Vector3<f64>, c: Vector3<f64>| (b - a).cross(&(c - a));
    let normals = mesh
        .outgoing(u)
        .map(|g| cross(place(u), place(mesh.target(g)), place(mesh.apex(g))));
    let normal = normals.sum::<Vector3<f64>>().try_normalize(f64::MIN_POSITIVE)?;
    let mut least = 1.0f64;
    for g in mesh
        .outgoing(u)
        .filter(|&g| mesh.target(g) != v && mesh.apex(g) != v)
    {
        let corners = [place(v), place(mesh.target(g)), place(mesh.apex(g))];
        let area = cross(corners[0], corners[1], corners[2]);
        if area.dot(&normal) < LEAST_COSINE * area.norm() {
            return None;
        }
        least = least.min(roundness(&corners));
    }
    if least < LEAST_ROUNDNESS || !mesh.can_collapse(h) {
        return None;
    }
    let cost = (place(u) - place(v)).norm() / least;
    (cost >= 0.0).then_some(cost)
}

/// Radius of the inner circle against the longest edge; 1 for an equilateral triangle, 0 for one without area.
fn roundness(p: &[Vector3<f64>; 3]) -> f64 {
    let edges = [(p[1] - p[0]).norm(), (p[2] - p[1]).norm(), (p[0] - p[2]).norm()];
    let twice_area = (p[1] - p[0]).cross(&(p[2] - p[0])).norm();
    let radius = twice_area / (edges[0] + edges[1] + edges[2]);
    let roundness = 12f64.sqrt() * radius / edges[0].max(edges[1]).max(edges[2]);
    if roundness.is_finite() { roundness } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_grow_exponentially_and_end_with_the_given_mesh() {
        assert_eq!(level_sizes(100, 1600, 3), [100, 400, 1600]);
        assert_eq!(level_sizes(100, 1601, 1), [1601]);
        assert_eq!(level_sizes(500, 500, 2), [500, 500]);
    }

    #[test]
    fn roundness_of_known_triangles() {
        let p = |x: f64, y: f64| Vector3::new(x, y, 0.0);
        assert_near!(
            roundness(&[p(0., 0.), p(1., 0.), p(0.5, 0.75f64.sqrt())]),
            1.0,
            1e-14
        );
        assert_eq!(roundness(&[p(0., 0.), p(1., 0.), p(2., 0.)]), 0.0);
        assert_eq!(roundness(&[p(0., 0.); 3]), 0.0);
    }
}
