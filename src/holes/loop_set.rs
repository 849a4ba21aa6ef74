//! Loops by themselves: where their vertices are, and which way the mesh faces there.

use std::ops::Range;

use nalgebra::Vector3;

use super::links::Links;
use super::loops::BoundaryLoop;
use crate::mesh::halfedge::{next, previous};

/// Four unit normals that nearly cancel, to a sum shorter than this, say nothing.
/// Half or double, of 13 cases: none changes.
const OPPOSITE: f64 = 0.5;

/// Some loops, the vertices of one after those of the other.
#[derive(Debug, Clone)]
pub(super) struct LoopSet {
    /// Positions.
    pub(super) x: Vec<Vector3<f64>>,
    /// The unit normal of the mesh's triangle at each edge from a vertex to the next of its loop, zero if it has none.
    pub(super) normals: Vec<Vector3<f64>>,
    /// Where the vertices of each loop begin, and where the last one's end.
    pub(super) starts: Vec<usize>,
    /// Pairs (smaller, larger) of vertices that have an edge already, sorted.
    pub(super) taken: Vec<(u32, u32)>,
    /// Pairs of vertices that shall have an edge; no vertex is in two of them.
    pub(super) guides: Vec<[u32; 2]>,
}

/// See [`LoopSet::plane`].
pub(super) struct LoopPlane {
    pub(super) centre: Vector3<f64>,
    pub(super) normal: Vector3<f64>,
}

impl LoopSet {
    /// These loops, where they lie in the mesh.
    pub(super) fn new(links: &Links<'_>, positions: &[[f64; 3]], loops: &[&BoundaryLoop]) -> Self {
        let at = |v: u32| Vector3::from(positions[v as usize]);
        let half_edges = loops.iter().flat_map(|boundary| &boundary.half_edges);
        let vertices = loops.iter().flat_map(|boundary| &boundary.vertices);
        let mut starts = vec![0];
        for boundary in loops {
            starts.push(starts[starts.len() - 1] + boundary.vertices.len());
        }
        Self {
            x: vertices.map(|&v| at(v)).collect(),
            normals: half_edges
                .map(|&h| normal(&links.triangles[h as usize / 3].map(at)))
                .collect(),
            starts,
            taken: taken(links, loops),
            guides: Vec::new(),
        }
    }

    /// Whether two vertices are those of a guide.
    pub(super) fn is_guide(&self, a: u32, b: u32) -> bool {
        self.guides.iter().any(|g| *g == [a, b] || *g == [b, a])
    }

    /// The same loops without guides.
    pub(super) fn without_guides(&self) -> Self {
        Self {
            guides: Vec::new(),
            ..self.clone()
        }
    }

    /// The plane that a loop is near to: its centre, and the direction of its vector area.
    pub(super) fn plane(&self, of: usize) -> LoopPlane {
        let centre = self.x[self.range(of)].iter().sum::<Vector3<f64>>() / self.range(of).len() as f64;
        let area = |v: usize| (self.x[v] - centre).cross(&(self.x[self.after(v)] - centre));
        let area: Vector3<f64> = self.range(of).map(area).sum();
        LoopPlane {
            centre,
            normal: area.try_normalize(0.0).unwrap_or_default(),
        }
    }

    pub(super) fn count(&self) -> usize {
        self.starts.len() - 1
    }

    pub(super) fn range(&self, of: usize) -> Range<usize> {
        self.starts[of]..self.starts[of + 1]
    }

    /// The loop that a vertex is on.
    pub(super) fn loop_of(&self, v: usize) -> usize {
        self.starts.partition_point(|&start| start <= v) - 1
    }

    /// The vertex after this one on its loop.
    pub(super) fn after(&self, v: usize) -> usize {
        let range = self.range(self.loop_of(v));
        if v + 1 == range.end { range.start } else { v + 1 }
    }

    /// The normal along a straight way from one vertex to another of a surface that goes on from the mesh at both, zero where nobody can tell.
    pub(super) fn normal_between(&self, v: usize, w: usize) -> Vector3<f64> {
        let way = (self.x[w] - self.x[v]).try_normalize(0.0);
        let way = way.unwrap_or_else(Vector3::zeros);
        let sum: Vector3<f64> = [v, self.before(v), w, self.before(w)]
            .map(|e| self.normals[e])
            .iter()
            .sum();
        let across = sum - way * way.dot(&sum);
        across.try_normalize(OPPOSITE).unwrap_or_else(Vector3::zeros)
    }

    /// The vertex before this one on its loop.
    pub(super) fn before(&self, v: usize) -> usize {
        let range = self.range(self.loop_of(v));
        if v == range.start { range.end - 1 } else { v - 1 }
    }

    /// The same loops, as if the mesh at one of them faced the other way.
    pub(super) fn with_reversed(mut self, of: usize) -> Self {
        let range = self.range(of);
        self.x[range.clone()].reverse();
        let normals = &mut self.normals[range];
        // The edge from the last to the first vertex stays the last one.
        let inner = normals.len() - 1;
        normals[..inner].reverse();
        normals.iter_mut().for_each(|normal| *normal = -*normal);
        self
    }

    /// Per vertex the unit direction in which a smooth surface goes on from the mesh; zero where nobody can tell.
    pub(super) fn onward(&self) -> Vec<Vector3<f64>> {
        let mut sums = vec![Vector3::zeros(); self.x.len()];
        for v in 0..self.x.len() {
            let next = self.after(v);
            let across = self.normals[v].cross(&(self.x[next] - self.x[v]));
            sums[v] += across;
            sums[next] += across;
        }
        let unit = |sum: &Vector3<f64>| sum.try_normalize(0.0).unwrap_or_else(Vector3::zeros);
        sums.iter().map(unit).collect()
    }
}

/// The unit normal of a triangle, zero if it has no area to speak of.
pub(super) fn normal([a, b, c]: &[Vector3<f64>; 3]) -> Vector3<f64> {
    let (e, f) = (b - a, c - a);
    let cross = e.cross(&f);
    let longest = e.norm_squared().max(f.norm_squared());
    if cross.norm() > 1e-12 * longest {
        cross.normalize()
    } else {
        Vector3::zeros()
    }
}

/// Pairs of the loops' vertices between which the mesh has an edge, sound or not.
pub(super) fn taken(links: &Links<'_>, loops: &[&BoundaryLoop]) -> Vec<(u32, u32)> {
    let vertices = loops.iter().flat_map(|boundary| &boundary.vertices).copied();
    let ordered: Vec<(u32, u32)> = vertices.zip(0..).collect();
    let mut order = ordered.clone();
    order.sort_unstable();
    let place = |v: u32| order.binary_search_by_key(&v, |o| o.0).ok().map(|i| order[i].1);
    let mut pairs = Vec::new();
    for (v, i) in ordered {
        for &h in links.at(v) {
            for other in [next(h), previous(h)] {
                if let Some(j) = place(links.origin(other)).filter(|&j| j != i) {
                    pairs.push((i.min(j), i.max(j)));
                }
            }
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}
