//! Which triangles lie at a vertex, and which beside a triangle.

use nalgebra::Vector3;

use crate::mesh::rows::Rows;

/// A mesh, coincident vertices joined, with the triangles at each vertex.
pub(super) struct Neighbours<'m> {
    pub(super) positions: &'m [[f64; 3]],
    pub(super) triangles: &'m [[u32; 3]],
    at: Rows<u32>,
}

impl<'m> Neighbours<'m> {
    /// The triangles name vertices that exist.
    pub(super) fn new(positions: &'m [[f64; 3]], triangles: &'m [[u32; 3]]) -> Self {
        let corners = (0..)
            .zip(triangles)
            .flat_map(|(t, corners)| corners.map(|v| (v, t)));
        Self {
            positions,
            triangles,
            at: Rows::collect(positions.len(), corners),
        }
    }

    /// The triangles at a vertex, ascending.
    pub(super) fn at(&self, v: u32) -> &[u32] {
        self.at.row(v as usize)
    }

    /// Where a vertex is.
    pub(super) fn place(&self, v: u32) -> Vector3<f64> {
        Vector3::from(self.positions[v as usize])
    }

    /// The corners of the triangles at a vertex but itself; most of them twice.
    pub(super) fn around(&self, v: u32) -> impl Iterator<Item = u32> + '_ {
        let corners = self.at(v).iter().flat_map(|&t| self.triangles[t as usize]);
        corners.filter(move |&w| w != v)
    }

    /// The triangle across the edge from `a` to `b` of triangle `t`, if it is the only one there besides `t`.
    fn across(&self, t: u32, a: u32, b: u32) -> Option<u32> {
        let others = self.at(a).iter().copied().filter(|&s| s != t);
        let mut others = others.filter(|&s| self.triangles[s as usize].contains(&b));
        let first = others.next()?;
        others.next().is_none().then_some(first)
    }

    /// The triangles beside a triangle, across edges that have two.
    pub(super) fn beside(&self, t: u32) -> impl Iterator<Item = u32> + '_ {
        let [a, b, c] = self.triangles[t as usize];
        [(a, b), (b, c), (c, a)]
            .into_iter()
            .filter_map(move |(a, b)| self.across(t, a, b))
    }

    /// Whether the surface ends at a vertex: an edge there has one triangle alone.
    pub(super) fn is_at_end(&self, v: u32) -> bool {
        let mut beside: Vec<u32> = self.around(v).collect();
        beside.sort_unstable();
        beside.chunk_by(|a, b| a == b).any(|same| same.len() == 1)
    }

    /// The normal of a triangle, of length one; of no length where it has no area.
    pub(super) fn normal(&self, t: u32) -> Vector3<f64> {
        let [a, b, c] = self.triangles[t as usize].map(|v| self.place(v));
        let normal = (b - a).cross(&(c - a));
        normal.try_normalize(0.0).unwrap_or_default()
    }
}
