//! What a triangulation must not pass through: the mesh around its loops, and patches made before.

use rstar::{AABB, RTree};

use super::crossing::Neighbours;
use crate::intersections::{Member, facing, intersect};

/// The triangles near some loops, and where the loops' vertices are.
pub(super) struct Obstacles {
    tree: RTree<Member>,
    x: Vec<[f64; 3]>,
}

impl Neighbours<'_> {
    /// What a triangulation of the loops of patch `of` may meet; their vertices by their numbers in the mesh.
    pub(super) fn obstacles(&self, of: usize, vertices: &[u32]) -> Obstacles {
        let x: Vec<[f64; 3]> = vertices.iter().map(|&v| self.positions[v as usize]).collect();
        let mut met = self.meeting(of, &AABB::from_points(&x));
        met.retain(|member| facing(&member.corners) != 0);
        Obstacles {
            tree: RTree::bulk_load(met),
            x,
        }
    }
}

impl Obstacles {
    /// Whether a triangle of these vertices of the loops intersects any.
    pub(super) fn bar(&self, triangle: [u32; 3]) -> bool {
        let corners = triangle.map(|v| self.x[v as usize]);
        if facing(&corners) == 0 {
            return true;
        }
        let mut near = self
            .tree
            .locate_in_envelope_intersecting(&AABB::from_points(&corners));
        near.any(|member| intersect(&corners, &member.corners))
    }
}
