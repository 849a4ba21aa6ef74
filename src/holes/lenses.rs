//! Where no vertex may come: near to boundary edges that are much longer than the edges wanted at their ends.
//!
//! Boundary edges cannot be split. A vertex that sees one under a wide angle makes a flat triangle with it or fans of long edges to its
//! ends, which are split in their turn, nearer to the edge each time: without end, if nothing forbids it. (In Delaunay
//! refinement with edges that may be split they are, as soon as a vertex comes into this lens: L. P. Chew, "Guaranteed-quality mesh
//! generation for curved surfaces", SCG 1993.)

use nalgebra::Vector3;

use super::patch::Patch;
use crate::mesh::NONE;

/// Edges longer than this many lengths wanted at an end are looked at from everywhere; vertices beside it see others.
/// Of 44 cases, half: 4 change, 4 get another triangulation, -3 % iterations; double: 3 change, 2 get another triangulation.
const LONG: f64 = 8.0;
/// At most so many of them, the longest.
/// Half or double, of 44 cases: none changes.
const MOST: usize = 256;

/// Long boundary edges and their lenses.
pub(super) struct Lenses(Vec<[Vector3<f64>; 2]>);

impl Lenses {
    pub(super) fn new(patch: &Patch) -> Self {
        let mut edges = Vec::new();
        for h in (0..patch.half_edges()).filter(|&h| patch.across(h) == NONE) {
            let ends = [patch.origin(h), patch.target(h)].map(|v| v as usize);
            let wanted = ends.map(|v| patch.limit[v].min(patch.size[v]));
            let length = patch.length(h);
            if length > LONG * wanted[0].min(wanted[1]) {
                edges.push((length, ends.map(|v| patch.x[v])));
            }
        }
        edges.sort_by(|a, b| b.0.total_cmp(&a.0));
        edges.truncate(MOST);
        Self(edges.into_iter().map(|edge| edge.1).collect())
    }

    /// Whether a point lies in one of the lenses.
    pub(super) fn hold(&self, p: &Vector3<f64>) -> bool {
        self.0.iter().any(|[a, b]| is_wide(p, a, b))
    }

    /// Whether a step leads into one of them.
    pub(super) fn are_entered(&self, from: &Vector3<f64>, to: &Vector3<f64>) -> bool {
        self.0
            .iter()
            .any(|[a, b]| is_wide(to, a, b) && !is_wide(from, a, b))
    }
}

/// Whether a point sees the edge between two others under more than 120 degrees.
pub(super) fn is_wide(p: &Vector3<f64>, a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
    let (a, b) = (a - p, b - p);
    a.dot(&b) < -0.5 * a.norm() * b.norm()
}
