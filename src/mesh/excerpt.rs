//! The part of a mesh that one component of the region needs: cut out, so that the work on a component does not depend on
//! the size of the mesh. It has the order of the mesh's vertices and triangles, so its region is that of the whole mesh.

use super::draft::{Draft, RINGS_BEYOND, Role};
use super::halfedge::NONE;
use super::numbering::Numbering;
use super::outside_neighbours::{RINGS_OF_CURVATURE, RINGS_WIDE};
use super::region::RegionMesh;
use super::rows::Rows;
use super::selection::Selection;
use crate::support::error::Error;

/// A mesh, and scratch to cut parts out of it.
pub(super) struct Excerpts<'a> {
    positions: &'a [[f64; 3]],
    triangles: &'a [[u32; 3]],
    /// The triangles at each vertex.
    at: Rows<u32>,
    /// Per vertex its number in the excerpt, while one is made: [`NONE`] before and after.
    local: Vec<u32>,
    /// Per triangle whether it is of the excerpt, while one is made.
    is_taken: Vec<bool>,
}

/// The caller's numbers of an excerpt's vertices and triangles, ascending.
struct Excerpt {
    vertices: Vec<u32>,
    triangles: Vec<u32>,
}

impl<'a> Excerpts<'a> {
    /// Those of a mesh whose triangles name vertices that exist.
    pub(super) fn new(positions: &'a [[f64; 3]], triangles: &'a [[u32; 3]]) -> Self {
        let corners = (0..).zip(triangles).flat_map(|(t, tri)| tri.map(|v| (v, t)));
        Self {
            positions,
            triangles,
            at: Rows::collect(positions.len(), corners),
            local: vec![NONE; positions.len()],
            is_taken: vec![false; triangles.len()],
        }
    }

    /// The region of these free vertices (ascending), as [`RegionMesh::numbered`] makes it of the whole mesh.
    ///
    /// # Errors
    /// Those of [`RegionMesh::new`].
    pub(super) fn region(
        &mut self,
        free: &[u32],
        given: &dyn Fn(u32) -> bool,
        (numbering, is_wide): (Numbering, bool),
    ) -> Result<RegionMesh, Error> {
        let numbering = (numbering, is_wide);
        let rings = if is_wide {
            RINGS_OF_CURVATURE - 1
        } else {
            RINGS_BEYOND
        };
        let region = self.region_within(free, rings, given, numbering)?;
        if region.is_rounded && !is_wide {
            return self.region_within(free, RINGS_WIDE - 1, given, numbering);
        }
        Ok(region)
    }

    /// The same of an excerpt that reaches so many rings beyond the outside ring.
    fn region_within(
        &mut self,
        free: &[u32],
        rings: usize,
        given: &dyn Fn(u32) -> bool,
        numbering: (Numbering, bool),
    ) -> Result<RegionMesh, Error> {
        let Excerpt { vertices, triangles } = self.gather(free, 2 + rings);
        for (l, &v) in (0..).zip(&vertices) {
            self.local[v as usize] = l;
        }
        let number = |v: u32| self.local[v as usize];
        let positions: Vec<[f64; 3]> = vertices.iter().map(|&v| self.positions[v as usize]).collect();
        let corners: Vec<[u32; 3]> = triangles
            .iter()
            .map(|&t| self.triangles[t as usize].map(number))
            .collect();
        let selected: Vec<u32> = free.iter().map(|&v| number(v)).collect();
        for &v in &vertices {
            self.local[v as usize] = NONE;
        }
        let selection = Selection::Vertices(&selected);
        let of_excerpt = |v: u32| given(vertices[v as usize]);
        let region = RegionMesh::numbered(&positions, &corners, selection, &of_excerpt, numbering);
        let id = |ids: &[u32], i: usize| ids[i] as usize;
        let mut region = region.map_err(|e| e.renumbered(|v| id(&vertices, v), |t| id(&triangles, t)))?;
        for v in &mut region.vertex_ids {
            *v = vertices[*v as usize];
        }
        for t in &mut region.half_edges.triangle_ids {
            *t = triangles[*t as usize];
        }
        Ok(region)
    }

    /// The triangles within so many rings around these vertices, and their vertices.
    fn gather(&mut self, free: &[u32], rings: usize) -> Excerpt {
        // The vertices found so far, marked by any number.
        let mut vertices = free.to_vec();
        vertices.iter().for_each(|&v| self.local[v as usize] = 0);
        let mut triangles = Vec::new();
        let mut begin = 0;
        for _ in 0..rings {
            let end = vertices.len();
            for k in begin..end {
                for &t in self.at.row(vertices[k] as usize) {
                    if std::mem::replace(&mut self.is_taken[t as usize], true) {
                        continue;
                    }
                    triangles.push(t);
                    for &v in &self.triangles[t as usize] {
                        if std::mem::replace(&mut self.local[v as usize], 0) == NONE {
                            vertices.push(v);
                        }
                    }
                }
            }
            begin = end;
        }
        triangles.iter().for_each(|&t| self.is_taken[t as usize] = false);
        vertices.sort_unstable();
        triangles.sort_unstable();
        Excerpt { vertices, triangles }
    }
}

impl RegionMesh {
    /// The region of each component, as [`numbered`](Self::numbered) finds it where the component's vertices alone are
    /// selected, by their smallest free vertices.
    ///
    /// # Errors
    /// As [`RegionMesh::new`], those that concern the whole mesh first, then those of the first component that has any.
    pub(crate) fn of_components(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        selection: Selection<'_>,
        prescribed: &dyn Fn(u32) -> bool,
        (numbering, is_wide): (Numbering, bool),
    ) -> Result<Vec<Self>, Error> {
        let draft = Draft::new(positions, triangles, selection, prescribed)?;
        if draft.components.count == 1 {
            return Ok(vec![draft.check(
                positions,
                triangles,
                prescribed,
                (numbering, is_wide),
            )?]);
        }
        let mut members = vec![Vec::new(); draft.components.count];
        for (&c, &v) in draft.components.number.iter().zip(&draft.vertex_ids) {
            members[c as usize].push(v);
        }
        let is_free: Vec<bool> = draft.role.iter().map(|role| *role == Role::Free).collect();
        drop(draft);
        let mut excerpts = Excerpts::new(positions, triangles);
        let regions = members.iter().map(|free| {
            let mut region = excerpts.region(free, prescribed, (numbering, is_wide))?;
            let outside = region.vertex_ids.iter().skip(region.free);
            let moves = outside.map(|&v| is_free[v as usize]);
            region.moves_elsewhere = std::iter::repeat_n(false, region.free).chain(moves).collect();
            Ok(region)
        });
        regions.collect()
    }
}
