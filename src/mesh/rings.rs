//! Ordered one-rings as compressed rows, and the sparsity patterns that follow from them.

use super::halfedge::NONE;
use super::halfedge::{next, previous};
use super::region::RegionMesh;
use super::rows::Rows;
use crate::support::profile::clock;
use fairmesh_linear::sparse::SymmetricPattern;

/// The neighbourhoods of the region's vertices, in local vertex numbers. There is a row for each free vertex, or, in
/// what is called boundary or outside, for each boundary vertex, numbered from the first of them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rings {
    /// The closed ring of each free vertex, counter-clockwise from the smallest local number.
    pub neighbour: Rows<u32>,
    /// Per value of `neighbour` the flap: the third vertex of the region triangle across the edge from this neighbour to
    /// the next, or [`NONE`]. Never the vertex itself: that would be a duplicate triangle.
    pub flap: Vec<u32>,
    /// Per value of `neighbour` where the vertex stands in the ring of that neighbour, as a position among all values.
    /// [`NONE`] at fixed neighbours.
    pub twin: Vec<u32>,

    /// The neighbours of each boundary vertex within the region, each once, counter-clockwise fan by fan.
    pub boundary_neighbour: Rows<u32>,
    /// The region triangles at each boundary vertex `b` by their other corners: `(b, c[0], c[1])` is counter-clockwise.
    pub boundary_triangle: Rows<[u32; 2]>,
    /// Per value of `boundary_triangle` the flap across the edge between those corners, or [`NONE`].
    pub boundary_flap: Vec<u32>,
    /// Per boundary vertex: its triangles form one closed ring inside the region, nothing is outside.
    pub closed: Vec<bool>,

    /// The half-edges of region triangles with no region triangle across, ascending: the region lies on
    /// their left. Something is outside where [`HalfEdges::opposite`](super::HalfEdges::opposite) is there.
    pub boundary_half_edges: Vec<u32>,

    /// The outside triangles at each boundary vertex, as in `boundary_triangle`.
    pub outside_triangle: Rows<[u32; 2]>,
}

impl Rings {
    /// Walks around every vertex of the region.
    pub(crate) fn new(region: &RegionMesh) -> Self {
        let mut rings = Self::default();
        rings.walk_free(region);
        rings.walk_boundary(region);
        let half_edges = &region.half_edges;
        rings.boundary_half_edges = (0..3 * half_edges.region_triangles as u32)
            .filter(|&h| {
                let o = half_edges.opposite[h as usize];
                o == NONE || !half_edges.in_region(o)
            })
            .collect();
        rings
    }

    /// The outside triangles at boundary vertex `free + b`.
    #[inline]
    pub(crate) fn outside_triangles(&self, b: usize) -> &[[u32; 2]] {
        self.outside_triangle.row(b)
    }

    /// The region triangles at boundary vertex `free + b`.
    #[inline]
    pub(crate) fn boundary_triangles(&self, b: usize) -> &[[u32; 2]] {
        self.boundary_triangle.row(b)
    }

    /// How many free vertices there are.
    #[inline]
    pub(crate) fn free(&self) -> usize {
        self.neighbour.len()
    }

    /// How many boundary vertices there are.
    #[inline]
    pub(crate) fn boundary(&self) -> usize {
        self.boundary_neighbour.len()
    }

    /// The ring of a free vertex, counter-clockwise.
    #[inline]
    pub(crate) fn ring(&self, i: usize) -> &[u32] {
        self.neighbour.row(i)
    }

    /// The region neighbours of boundary vertex `free + b`.
    #[inline]
    pub(crate) fn boundary_ring(&self, b: usize) -> &[u32] {
        self.boundary_neighbour.row(b)
    }

    /// The region neighbours of any region vertex.
    #[inline]
    pub(crate) fn neighbours(&self, v: usize) -> &[u32] {
        if v < self.free() {
            self.ring(v)
        } else {
            self.boundary_ring(v - self.free())
        }
    }

    fn walk_free(&mut self, region: &RegionMesh) {
        let half_edges = &region.half_edges;
        self.neighbour = half_edges
            .outgoing
            .map_first(region.free, |&h| half_edges.target(h));
        let outgoing = &half_edges.outgoing.values()[..self.neighbour.values().len()];
        self.flap = outgoing.iter().map(|&h| half_edges.flap(next(h))).collect();
        // Half-edges that leave a fixed vertex have no position.
        let mut position = vec![NONE; 3 * half_edges.region_triangles];
        (0..).zip(outgoing).for_each(|(p, &h)| position[h as usize] = p);
        self.twin = outgoing
            .iter()
            .map(|&h| position[half_edges.opposite[h as usize] as usize])
            .collect();
    }

    fn walk_boundary(&mut self, region: &RegionMesh) {
        let half_edges = &region.half_edges;
        for b in region.free..region.region_vertices() {
            self.closed.push(true);
            for &h in half_edges.outgoing.row(b) {
                self.add_boundary_triangle(region, h);
            }
            self.boundary_neighbour.end_row();
            self.boundary_triangle.end_row();
            self.outside_triangle.end_row();
        }
    }

    /// Enters the triangle left of `h`, which leaves the boundary vertex of the row under construction.
    fn add_boundary_triangle(&mut self, region: &RegionMesh, h: u32) {
        let half_edges = &region.half_edges;
        let inside = half_edges.in_region(h);
        let other = |g: u32| {
            let o = half_edges.opposite[g as usize];
            o == NONE || half_edges.in_region(o) != inside
        };
        let (begins, ends) = (other(h), other(previous(h)));
        if let Some(closed) = self.closed.last_mut() {
            *closed &= inside && !begins && !ends;
        }
        let [_, target, apex] = half_edges.corners(h);
        if inside {
            self.boundary_neighbour.push(target);
            if ends {
                self.boundary_neighbour.push(apex);
            }
            self.boundary_triangle.push([target, apex]);
            self.boundary_flap.push(half_edges.flap(next(h)));
        } else {
            self.outside_triangle.push([target, apex]);
        }
    }

    /// The one-ring graph of the free vertices: the pattern of the scalar graph Laplacian.
    pub(crate) fn graph(&self) -> SymmetricPattern {
        let _clock = clock("patterns");
        self.pattern(self.neighbour.values().len() / 2, |i, columns| {
            columns.extend(self.ring(i as usize).iter().filter(|&&j| j < i));
        })
    }

    /// The pattern of `S_I D S_I^T`, where S_I holds the free rows and all region columns of the Laplacian:
    /// free vertices are connected if they are the same, neighbours, or have a common neighbour, free or boundary.
    pub(crate) fn two_ring_pattern(&self) -> SymmetricPattern {
        let _clock = clock("patterns");
        let mut seen = vec![NONE; self.free()];
        self.pattern(self.neighbour.values().len() * 3 / 2, |i, columns| {
            let mut visit = |j: u32| {
                if j < i && seen[j as usize] != i {
                    seen[j as usize] = i;
                    columns.push(j);
                }
            };
            for &k in self.ring(i as usize) {
                visit(k);
                self.neighbours(k as usize).iter().for_each(|&j| visit(j));
            }
        })
    }

    /// A pattern over the free vertices of about `size` entries below the diagonal. `below` appends those of one row.
    fn pattern(&self, size: usize, mut below: impl FnMut(u32, &mut Vec<u32>)) -> SymmetricPattern {
        let free = self.free();
        let mut pattern = SymmetricPattern {
            start: Vec::with_capacity(free + 1),
            column: Vec::with_capacity(size + free),
        };
        pattern.start.push(0);
        for i in 0..free as u32 {
            let row = pattern.column.len();
            below(i, &mut pattern.column);
            pattern.column[row..].sort_unstable();
            pattern.column.push(i);
            pattern.start.push(pattern.column.len());
        }
        pattern
    }

    #[cfg(test)]
    /// Checks the invariants; for tests.
    ///
    /// # Errors
    /// What is violated.
    pub(crate) fn validate(&self, region: &RegionMesh) -> Result<(), String> {
        self.validate_free(region)?;
        self.validate_boundary(region)?;
        self.validate_euler(region)
    }

    #[cfg(test)]
    fn validate_free(&self, region: &RegionMesh) -> Result<(), String> {
        if self.free() != region.free || self.boundary() != region.boundary {
            return Err("row counts".into());
        }
        for i in 0..self.free() {
            let ring = self.ring(i);
            if ring.len() < 3 || ring.iter().min() != ring.first() {
                return Err(format!("ring of {i}"));
            }
            for p in self.neighbour.range(i) {
                let (j, twin) = (self.neighbour.values()[p], self.twin[p]);
                if region.is_free(j) != (twin != NONE) {
                    return Err(format!("twin of {p} is missing or superfluous"));
                }
                if twin != NONE
                    && (self.twin[twin as usize] as usize != p
                        || self.neighbour.values()[twin as usize] != i as u32
                        || !self.neighbour.range(j as usize).contains(&(twin as usize)))
                {
                    return Err(format!("twin of {p}"));
                }
            }
        }
        Ok(())
    }

    #[cfg(test)]
    fn validate_boundary(&self, region: &RegionMesh) -> Result<(), String> {
        let distinct = |row: &[u32]| {
            let mut sorted = row.to_vec();
            sorted.sort_unstable();
            sorted.windows(2).all(|w| w[0] < w[1])
        };
        for b in 0..self.boundary() {
            let ring = self.boundary_ring(b);
            let triangles = self.boundary_triangle.row(b);
            let outside = self.outside_triangle.row(b);
            if !distinct(ring) {
                return Err(format!("boundary vertex {b} has a neighbour twice"));
            }
            if triangles.is_empty() || self.closed[b] != (ring.len() == triangles.len()) {
                return Err(format!("fans of boundary vertex {b}"));
            }
            if self.closed[b] && !outside.is_empty() {
                return Err(format!("boundary vertex {b} is closed but has an outside"));
            }
            // A free neighbour has triangles on both sides of the edge to it.
            if ring.len() < 3 || triangles.len() < 2 {
                return Err(format!("boundary vertex {b} has fewer than two triangles"));
            }
            if ring.iter().all(|&j| !region.is_free(j)) {
                return Err(format!("boundary vertex {b} has no free neighbour"));
            }
        }
        Ok(())
    }

    #[cfg(test)]
    /// V - E + F with the boundary vertices split into their fans must match the count of half-edges: every
    /// half-edge of the region leaves exactly one vertex, and every boundary half-edge begins one fan.
    fn validate_euler(&self, region: &RegionMesh) -> Result<(), String> {
        let half_edges = 3 * region.half_edges.region_triangles;
        let boundary_triangles = self.boundary_triangle.values().len();
        if self.neighbour.values().len() + boundary_triangles != half_edges {
            return Err("rings and half-edges differ".into());
        }
        let fans = self.boundary_neighbour.values().len() - boundary_triangles;
        if fans != self.boundary_half_edges.len() {
            return Err("open fans and boundary half-edges differ".into());
        }
        Ok(())
    }
}
