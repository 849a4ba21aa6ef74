//! Ordered one-rings as compressed rows, and the sparsity patterns that follow from them.

use super::NONE;
use super::halfedge::{next, previous};
use super::region::Region;
use fairmesh_linear::sparse::SymmetricPattern;

/// The neighbourhoods of the region's vertices, in local vertex numbers. Row `i` of a quantity `x` is
/// `x[x_start[i]..x_start[i + 1]]`; boundary rows are numbered from the first boundary vertex.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rings {
    /// Rows of `neighbour`, `flap` and `twin`; free + 1 offsets.
    pub start: Vec<u32>,
    /// The closed ring of each free vertex, counter-clockwise from the smallest local number.
    pub neighbour: Vec<u32>,
    /// The third vertex of the region triangle across ring edge `(j_k, j_k+1)`, or [`NONE`]. Never the vertex
    /// itself: that would be a duplicate triangle.
    pub flap: Vec<u32>,
    /// Where this vertex stands in the ring of a free neighbour: a position in `neighbour`. [`NONE`] at
    /// fixed neighbours.
    pub twin: Vec<u32>,

    /// Rows of `boundary_neighbour`; boundary + 1 offsets.
    pub boundary_start: Vec<u32>,
    /// The neighbours of each boundary vertex within the region, each once, counter-clockwise fan by fan.
    pub boundary_neighbour: Vec<u32>,
    /// Rows of `boundary_edge`; boundary + 1 offsets.
    pub boundary_edge_start: Vec<u32>,
    /// Ring edges of the region triangles at each boundary vertex `b`: `(b, e[0], e[1])` is counter-clockwise.
    pub boundary_edge: Vec<[u32; 2]>,
    /// The third vertex of the region triangle across that ring edge, or [`NONE`].
    pub boundary_flap: Vec<u32>,
    /// Per boundary vertex: its triangles form one closed ring inside the region, nothing is outside.
    pub closed: Vec<bool>,

    /// The half-edges of region triangles with no region triangle across, ascending: the region lies on
    /// their left. Something is outside where [`HalfEdges::opposite`](super::HalfEdges::opposite) is there.
    pub boundary_half_edges: Vec<u32>,

    /// Rows of `outside_edge`; boundary + 1 offsets.
    pub outside_edge_start: Vec<u32>,
    /// Ring edges of the outside triangles at each boundary vertex, oriented as in `boundary_edge`.
    pub outside_edge: Vec<[u32; 2]>,
}

impl Rings {
    /// Walks around every vertex of the region.
    pub(crate) fn new(region: &Region) -> Self {
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

    /// The ring edges of the outside triangles at a boundary vertex.
    #[inline]
    pub(crate) fn outside_triangles(&self, b: usize) -> &[[u32; 2]] {
        &self.outside_edge[self.outside_edge_start[b] as usize..self.outside_edge_start[b + 1] as usize]
    }

    /// How many free vertices there are.
    #[inline]
    pub(crate) fn free(&self) -> usize {
        self.start.len() - 1
    }

    /// How many boundary vertices there are.
    #[inline]
    pub(crate) fn boundary(&self) -> usize {
        self.boundary_start.len() - 1
    }

    /// The ring of a free vertex, counter-clockwise.
    #[inline]
    pub(crate) fn ring(&self, i: usize) -> &[u32] {
        &self.neighbour[self.start[i] as usize..self.start[i + 1] as usize]
    }

    /// The region neighbours of boundary vertex `free + b`.
    #[inline]
    pub(crate) fn boundary_ring(&self, b: usize) -> &[u32] {
        row(&self.boundary_start, &self.boundary_neighbour, b)
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

    fn walk_free(&mut self, region: &Region) {
        let half_edges = &region.half_edges;
        self.start = half_edges.spoke_start[..=region.free].to_vec();
        let ring_edge = &half_edges.ring_edge[..self.start[region.free] as usize];
        self.neighbour = ring_edge.iter().map(|&h| half_edges.target(h)).collect();
        self.flap = ring_edge.iter().map(|&h| half_edges.flap(next(h))).collect();
        // Half-edges that leave a fixed vertex have no position.
        let mut position = vec![NONE; 3 * half_edges.region_triangles];
        ring_edge
            .iter()
            .enumerate()
            .for_each(|(p, &h)| position[h as usize] = p as u32);
        self.twin = ring_edge
            .iter()
            .map(|&h| position[half_edges.opposite[h as usize] as usize])
            .collect();
    }

    fn walk_boundary(&mut self, region: &Region) {
        let half_edges = &region.half_edges;
        self.boundary_start.push(0);
        self.boundary_edge_start.push(0);
        self.outside_edge_start.push(0);
        for b in region.free..region.region_vertices() {
            self.closed.push(true);
            for &h in half_edges.ring_edges(b) {
                self.add_boundary_triangle(region, h);
            }
            self.boundary_start.push(self.boundary_neighbour.len() as u32);
            self.boundary_edge_start.push(self.boundary_edge.len() as u32);
            self.outside_edge_start.push(self.outside_edge.len() as u32);
        }
    }

    /// Enters the triangle left of `h`, which leaves the boundary vertex of the row under construction.
    fn add_boundary_triangle(&mut self, region: &Region, h: u32) {
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
        let edge = [target, apex];
        if inside {
            self.boundary_neighbour.push(edge[0]);
            if ends {
                self.boundary_neighbour.push(edge[1]);
            }
            self.boundary_edge.push(edge);
            self.boundary_flap.push(half_edges.flap(next(h)));
        } else {
            self.outside_edge.push(edge);
        }
    }

    /// The one-ring graph of the free vertices: the pattern of the scalar graph Laplacian.
    pub(crate) fn graph(&self) -> SymmetricPattern {
        let free = self.free();
        let mut pattern = SymmetricPattern {
            start: Vec::with_capacity(free + 1),
            column: Vec::new(),
        };
        pattern.column.reserve(self.neighbour.len() / 2 + free);
        pattern.start.push(0);
        for i in 0..free {
            let row = pattern.column.len();
            pattern
                .column
                .extend(self.ring(i).iter().filter(|&&j| (j as usize) < i));
            pattern.column[row..].sort_unstable();
            pattern.column.push(i as u32);
            pattern.start.push(pattern.column.len());
        }
        pattern
    }

    /// The pattern of `S_I D S_I^T`, where S_I holds the free rows and all region columns of the Laplacian:
    /// free vertices are connected if they are the same, neighbours, or have a common neighbour, free or boundary.
    pub(crate) fn two_ring_pattern(&self) -> SymmetricPattern {
        let free = self.free();
        let mut pattern = SymmetricPattern {
            start: Vec::with_capacity(free + 1),
            column: Vec::new(),
        };
        pattern.column.reserve(self.neighbour.len() * 3 / 2 + free);
        let mut seen = vec![NONE; free];
        pattern.start.push(0);
        for i in 0..free as u32 {
            let row = pattern.column.len();
            let mut visit = |j: u32| {
                if j < i && seen[j as usize] != i {
                    seen[j as usize] = i;
                    pattern.column.push(j);
                }
            };
            for &k in self.ring(i as usize) {
                visit(k);
                self.neighbours(k as usize).iter().for_each(|&j| visit(j));
            }
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
    pub(crate) fn validate(&self, region: &Region) -> Result<(), String> {
        self.validate_free(region)?;
        self.validate_boundary(region)?;
        self.validate_euler(region)
    }

    #[cfg(test)]
    fn validate_free(&self, region: &Region) -> Result<(), String> {
        if self.free() != region.free || self.boundary() != region.boundary {
            return Err("row counts".into());
        }
        for i in 0..self.free() {
            let ring = self.ring(i);
            if ring.len() < 3 || ring.iter().min() != ring.first() {
                return Err(format!("ring of {i}"));
            }
            for p in self.start[i]..self.start[i + 1] {
                let (j, twin) = (self.neighbour[p as usize], self.twin[p as usize]);
                if region.is_free(j) != (twin != NONE) {
                    return Err(format!("twin of {p} is missing or superfluous"));
                }
                if twin != NONE
                    && (self.twin[twin as usize] != p
                        || self.neighbour[twin as usize] != i as u32
                        || !(self.start[j as usize]..self.start[j as usize + 1]).contains(&twin))
                {
                    return Err(format!("twin of {p}"));
                }
            }
        }
        Ok(())
    }

    #[cfg(test)]
    fn validate_boundary(&self, region: &Region) -> Result<(), String> {
        let distinct = |row: &[u32]| {
            let mut sorted = row.to_vec();
            sorted.sort_unstable();
            sorted.windows(2).all(|w| w[0] < w[1])
        };
        for b in 0..self.boundary() {
            let ring = self.boundary_ring(b);
            let edges = row(&self.boundary_edge_start, &self.boundary_edge, b);
            let outside = row(&self.outside_edge_start, &self.outside_edge, b);
            if !distinct(ring) {
                return Err(format!("boundary vertex {b} has a neighbour twice"));
            }
            if edges.is_empty() || self.closed[b] != (ring.len() == edges.len()) {
                return Err(format!("fans of boundary vertex {b}"));
            }
            if self.closed[b] && !outside.is_empty() {
                return Err(format!("boundary vertex {b} is closed but has an outside"));
            }
            // A free neighbour has triangles on both sides of the edge to it.
            if ring.len() < 3 || edges.len() < 2 {
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
    /// half-edge of the region is a ring_edge of exactly one ring, and every boundary half-edge begins one fan.
    fn validate_euler(&self, region: &Region) -> Result<(), String> {
        let half_edges = 3 * region.half_edges.region_triangles;
        if self.neighbour.len() + self.boundary_edge.len() != half_edges {
            return Err("ring_edges and half-edges differ".into());
        }
        let fans = self.boundary_neighbour.len() - self.boundary_edge.len();
        if fans != self.boundary_half_edges.len() {
            return Err("open fans and boundary half-edges differ".into());
        }
        Ok(())
    }
}

fn row<'a, T>(start: &[u32], values: &'a [T], i: usize) -> &'a [T] {
    &values[start[i] as usize..start[i + 1] as usize]
}
