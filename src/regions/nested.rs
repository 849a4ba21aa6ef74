//! Regions that grow: all up to ever larger distances from something, as a mesh whose beginning is all that each needs.

use super::fair_region::FairRegion;
use super::neighbours::Neighbours;
use super::robust::median;

/// What the normals at a region's boundary are fitted to lies within so many edges of it, and such a part of its radius where edges are longer there.
/// Half or double of either: no figure changes, see bump.rs.
const EDGES: f64 = 12.0;
const PART: f64 = 0.3;
/// The edge is the median of so many triangles around the source: [`EDGES`] and the first radius are in it.
const NEAR: usize = 100;

/// The mesh around some source, the nearest triangles first. Numbers are its own, but where they are said to be the caller's.
pub(super) struct Nested<'m> {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    /// How far the nearest corner of each triangle is, ascending.
    nearest: Vec<f64>,
    /// How far each vertex is.
    distance: Vec<f64>,
    /// The caller's numbers.
    vertices: Vec<u32>,
    names: Vec<u32>,
    /// How many vertices the first triangles have.
    ends: Vec<u32>,
    farthest: f64,
    /// The radius of the source, as if it were a disc.
    source: f64,
    mesh: &'m Neighbours<'m>,
}

impl<'m> Nested<'m> {
    /// Around a source of some radius, from which vertices are so far.
    pub(super) fn new(mesh: &'m Neighbours<'m>, distance: &[f64], source: f64) -> Self {
        let far = |t: u32| {
            let corners = mesh.triangles[t as usize].iter();
            corners
                .map(|&v| distance[v as usize])
                .fold(f64::INFINITY, f64::min)
        };
        let all = (0..mesh.triangles.len() as u32).map(|t| (far(t), t));
        let mut order: Vec<(f64, u32)> = all.filter(|(far, _)| far.is_finite()).collect();
        order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut own = vec![u32::MAX; mesh.positions.len()];
        let mut this = Self {
            positions: Vec::new(),
            triangles: Vec::with_capacity(order.len()),
            nearest: order.iter().map(|(far, _)| *far).collect(),
            distance: Vec::new(),
            vertices: Vec::new(),
            names: order.iter().map(|(_, t)| *t).collect(),
            ends: Vec::with_capacity(order.len()),
            farthest: distance
                .iter()
                .copied()
                .filter(|d| d.is_finite())
                .fold(0.0, f64::max),
            source,
            mesh,
        };
        for t in &this.names {
            let corners = this.mesh.triangles[*t as usize].map(|v| {
                if own[v as usize] == u32::MAX {
                    own[v as usize] = this.vertices.len() as u32;
                    this.vertices.push(v);
                    this.positions.push(mesh.positions[v as usize]);
                    this.distance.push(distance[v as usize]);
                }
                own[v as usize]
            });
            this.triangles.push(corners);
            this.ends.push(this.vertices.len() as u32);
        }
        this
    }

    /// The median length of the edges near the source; none where there are none that have a length.
    pub(super) fn edge(&self) -> Option<f64> {
        let near = &self.names[..self.names.len().min(NEAR)];
        let lengths = near.iter().flat_map(|&t| {
            let [a, b, c] = self.mesh.triangles[t as usize].map(|v| self.mesh.place(v));
            [(a - b).norm(), (b - c).norm(), (c - a).norm()]
        });
        Some(median(&lengths.collect::<Vec<f64>>())).filter(|edge| *edge > 0.0)
    }

    /// How many vertices are reached.
    pub(super) fn reached(&self) -> usize {
        self.vertices.len()
    }

    /// Whether nothing is left outside of a radius.
    pub(super) fn is_all_within(&self, radius: f64) -> bool {
        radius - self.source > self.farthest
    }

    /// The region of the triangles within a radius, and what is around it.
    pub(super) fn within(&self, radius: f64) -> FairRegion<'_> {
        let limit = radius - self.source;
        let margin = EDGES * self.edge().unwrap_or(0.0) + PART * radius;
        let count = self.nearest.partition_point(|far| *far <= limit + margin);
        let vertices = count.checked_sub(1).map_or(0, |last| self.ends[last] as usize);
        let mesh = Neighbours::new(&self.positions[..vertices], &self.triangles[..count]);
        let is_near = |t: &[u32; 3]| t.iter().all(|&v| self.distance[v as usize] <= limit);
        let is_in = mesh.triangles.iter().map(is_near).collect();
        FairRegion::new(mesh, is_in)
    }

    /// The caller's numbers of triangles.
    pub(super) fn named(&self, triangles: &[u32]) -> Vec<u32> {
        triangles.iter().map(|&t| self.names[t as usize]).collect()
    }

    /// The caller's number of a vertex.
    pub(super) fn vertex(&self, v: u32) -> u32 {
        self.vertices[v as usize]
    }
}
