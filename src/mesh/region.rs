//! What is free, fixed and boundary, with its surroundings, in local numbers.

use nalgebra::Vector3;

use super::halfedge::HalfEdges;

/// The part of a mesh that is faired, with its surroundings.
///
/// Region triangles are those with a free vertex, and those of [`islands`](super::islands); boundary vertices are their
/// fixed vertices, those with a closed ring of region triangles included. The outside ring holds the other triangles at boundary vertices.
/// Vertices have local numbers: the free ones, the boundary, the rest of the outside ring, then the
/// vertices of two more rings beyond it, each group in the caller's order, but the free ones as [`Numbering`] says.
#[derive(Debug, Clone)]
pub(crate) struct RegionMesh {
    /// The caller's number of each local vertex.
    pub vertex_ids: Vec<u32>,
    /// How many vertices are free.
    pub free: usize,
    /// How many boundary vertices there are.
    pub boundary: usize,
    /// The triangles of the region and of the outside ring.
    pub half_edges: HalfEdges,
    /// The triangles within two more rings around those, in local numbers, as far as their vertices have a place. They
    /// serve fits to the surroundings and need not be sound. Where [`is_rounded`](Self::is_rounded), within a few more.
    pub beyond: Vec<[u32; 3]>,
    /// Whether the surroundings have single precision coordinates that tilt their triangles: far from the origin.
    pub is_rounded: bool,
    /// Per free vertex the number of its component.
    pub component: Vec<u32>,
    /// How many components there are. More than one only where the region is not to be solved as it is.
    pub components: usize,
    /// Per local vertex whether it is outside and free in another component: where it is given says nothing of the final
    /// surface. Empty: none is.
    pub moves_elsewhere: Vec<bool>,
}

impl RegionMesh {
    /// Whether a local vertex is free.
    #[inline]
    pub(crate) fn is_free(&self, vertex: u32) -> bool {
        (vertex as usize) < self.free
    }

    /// The smallest number that a free vertex has with the caller.
    pub(crate) fn first_free(&self) -> usize {
        let first = self.vertex_ids[..self.free].iter().min();
        first.map_or(0, |&v| v as usize)
    }

    /// How many vertices the region has: free and boundary.
    #[inline]
    pub(crate) fn region_vertices(&self) -> usize {
        self.free + self.boundary
    }

    /// The positions of all local vertices, gathered from the caller's.
    pub(crate) fn positions(&self, positions: &[[f64; 3]]) -> Vec<Vector3<f64>> {
        self.vertex_ids
            .iter()
            .map(|&v| Vector3::from(positions[v as usize]))
            .collect()
    }

    /// The triangles of the region, in local vertex numbers.
    pub(crate) fn triangles(&self) -> &[[u32; 3]] {
        &self.half_edges.triangles[..self.half_edges.region_triangles]
    }

    #[cfg(test)]
    /// Checks the invariants; for tests.
    ///
    /// # Errors
    /// What is violated.
    pub(crate) fn validate(&self) -> Result<(), String> {
        self.half_edges.validate()?;
        let (free, boundary) = self.vertex_ids[..self.region_vertices()].split_at(self.free);
        let mut free = free.to_vec();
        free.sort_unstable();
        if !free.is_sorted_by(|a, b| a < b) || !boundary.is_sorted() {
            return Err("local numbers".into());
        }
        for (t, tri) in self.half_edges.triangles.iter().enumerate() {
            let region = t < self.half_edges.region_triangles;
            if tri.iter().any(|&v| self.is_free(v)) && !region {
                return Err(format!("triangle {t} is on the wrong side"));
            }
            if region && tri.iter().any(|&v| v as usize >= self.region_vertices()) {
                return Err(format!("triangle {t} has a vertex that is not of the region"));
            }
        }
        if self.component.len() != self.free || self.component.iter().any(|&c| c as usize >= self.components)
        {
            return Err("component numbers".into());
        }
        Ok(())
    }
}
