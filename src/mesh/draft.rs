//! Finds what takes part in the fairing of a region, and numbers it.

use super::checks::{check_corners, check_finite, check_valence, finite, repeated};
use super::components::Components;
use super::cut::cut;
use super::halfedge::NONE;
use super::halfedge::{HalfEdges, each_edge};
use super::input::{check_indices, check_size};
use super::islands::islands;
use super::numbering::{Numbering, breadth_first};
use super::outside_neighbours::{RINGS_OF_CURVATURE, RINGS_WIDE};
use super::region::RegionMesh;
use super::rounding;
use super::selection::Selection;
use crate::support::error::Error;

/// What a vertex is to the region.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Role {
    /// Elsewhere, or not known yet.
    Other,
    Free,
    Boundary,
    /// Of an outside-ring triangle, but not boundary.
    Ring,
}

/// A region that is found, but not checked yet.
pub(super) struct Draft {
    pub(super) role: Vec<Role>,
    triangle_ids: Vec<u32>,
    /// How many of them are of the region; the others are of the outside ring.
    region_triangles: usize,
    pub(super) vertex_ids: Vec<u32>,
    free: usize,
    boundary: usize,
    /// In local numbers.
    triangles: Vec<[u32; 3]>,
    pub(super) components: Components,
}

impl RegionMesh {
    /// Finds the region and checks that it and the outside ring are sound.
    ///
    /// `positions` is #V by 3, `triangles` #T by 3, counter-clockwise. Triangles elsewhere need only name
    /// vertices that exist; vertices elsewhere may be anything. Triangles without area are legal.
    ///
    /// # Errors
    /// In this order, each for the smallest offending index: [`Error::TooLarge`], [`Error::MaskLength`],
    /// [`Error::SelectionOutOfRange`], [`Error::IndexOutOfRange`] (of any triangle of the mesh),
    /// [`Error::EmptyRegion`], [`Error::RepeatedIndex`], [`Error::NotFinite`], [`Error::CoordinateTooLarge`],
    /// [`Error::ValenceTooLarge`],
    /// [`Error::FreeVertexWithoutTriangle`], [`Error::DuplicateTriangle`], [`Error::NonManifoldEdge`],
    /// [`Error::InconsistentOrientation`], [`Error::FreeVertexOnBoundary`], [`Error::NonManifoldVertex`],
    /// [`Error::NothingFixed`].
    pub(crate) fn new(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        selection: Selection<'_>,
    ) -> Result<Self, Error> {
        Self::with_normals(positions, triangles, selection, |_| false)
    }

    /// The same, cut along curves of fixed vertices inside the region whose normals are `prescribed` (by the caller's
    /// number); those are boundary then, and have a local number for each side.
    ///
    /// # Errors
    /// As [`RegionMesh::new`].
    pub(crate) fn with_normals(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        selection: Selection<'_>,
        prescribed: impl Fn(u32) -> bool,
    ) -> Result<Self, Error> {
        let numbering = (Numbering::AsGiven, false);
        Self::numbered(positions, triangles, selection, &prescribed, numbering)
    }

    /// The same with another numbering of the free vertices, and with [`RegionMesh::beyond`] as where coordinates are rounded, if that is asked
    /// for.
    ///
    /// # Errors
    /// As [`RegionMesh::new`].
    pub(super) fn numbered(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        selection: Selection<'_>,
        prescribed: &dyn Fn(u32) -> bool,
        (numbering, is_wide): (Numbering, bool),
    ) -> Result<Self, Error> {
        let draft = Draft::new(positions, triangles, selection, prescribed)?;
        draft.check(positions, triangles, prescribed, (numbering, is_wide))
    }
}

impl Draft {
    /// # Errors
    /// Those of [`RegionMesh::new`] as far as [`Error::EmptyRegion`].
    pub(super) fn new(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        selection: Selection<'_>,
        prescribed: &dyn Fn(u32) -> bool,
    ) -> Result<Self, Error> {
        check_size(positions.len(), triangles.len())?;
        let mut role = resolve(positions.len(), triangles, selection)?;
        let (triangle_ids, region_triangles) = collect(triangles, &mut role, prescribed);
        let (vertex_ids, local, free, boundary) = number(&role);
        let ids = triangle_ids.iter();
        let numbered = ids.map(|&t| triangles[t as usize].map(|v| local[v as usize]));
        let triangles: Vec<[u32; 3]> = numbered.collect();
        let given = |v: u32| prescribed(vertex_ids[v as usize]);
        Ok(Self {
            components: Components::new(&triangles, region_triangles, (free, boundary), given),
            role,
            triangle_ids,
            region_triangles,
            vertex_ids,
            free,
            boundary,
            triangles,
        })
    }

    /// # Errors
    /// The others of [`RegionMesh::new`].
    pub(super) fn check(
        mut self,
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        prescribed: &dyn Fn(u32) -> bool,
        (numbering, is_wide): (Numbering, bool),
    ) -> Result<RegionMesh, Error> {
        let region_triangles = self.region_triangles;
        check_corners(triangles, &self.triangle_ids)?;
        check_finite(positions, &self.vertex_ids)?;
        check_valence(&self.triangles[..region_triangles], &self.vertex_ids)?;
        let nothing_fixed = self.components.without_fixed(&self.triangles[..region_triangles]);
        let nothing_fixed = nothing_fixed.map(|v| self.vertex_ids[v] as usize);
        if numbering == Numbering::BreadthFirst {
            self.renumber();
        }
        let (free, mut boundary, mut vertex_ids) = (self.free, self.boundary, self.vertex_ids);
        let link = |numbered, triangle_ids, boundary, vertex_ids: &[u32]| {
            HalfEdges::new(
                numbered,
                triangle_ids,
                region_triangles,
                (free, boundary),
                vertex_ids,
            )
        };
        let mut half_edges = link(self.triangles, self.triangle_ids, boundary, &vertex_ids)?;
        if let Some(vertex) = nothing_fixed {
            return Err(Error::NothingFixed { vertex });
        }
        let of_curve = |v: usize| prescribed(vertex_ids[v]);
        if let Some(cut) = cut(&half_edges, (free, boundary), &vertex_ids, of_curve) {
            (vertex_ids, boundary) = (cut.vertex_ids, cut.boundary);
            half_edges = link(cut.triangles, half_edges.triangle_ids, boundary, &vertex_ids)?;
        }
        let outside = half_edges.triangle_ids[region_triangles..].iter();
        let is_rounded =
            rounding::single_precision_matters(positions, outside.map(|&t| triangles[t as usize]));
        let rings = match (is_wide, is_rounded) {
            (true, _) => RINGS_OF_CURVATURE - 1,
            (false, true) => RINGS_WIDE - 1,
            (false, false) => RINGS_BEYOND,
        };
        let beyond = add_beyond(positions, triangles, &self.role, rings, &mut vertex_ids);
        Ok(RegionMesh {
            vertex_ids,
            free,
            boundary,
            half_edges,
            beyond,
            is_rounded,
            component: self.components.number,
            components: self.components.count,
            moves_elsewhere: Vec::new(),
        })
    }

    /// Numbers the free vertices breadth first.
    fn renumber(&mut self) {
        let order = breadth_first(self.free, &self.triangles[..self.region_triangles]);
        let mut number: Vec<u32> = (0..self.vertex_ids.len() as u32).collect();
        for (new, &old) in (0..).zip(&order) {
            number[old as usize] = new;
        }
        let in_order = |of: &[u32]| order.iter().map(|&v| of[v as usize]).collect::<Vec<u32>>();
        let ids = in_order(&self.vertex_ids);
        self.vertex_ids[..self.free].copy_from_slice(&ids);
        self.components.number = in_order(&self.components.number);
        for v in self.triangles.iter_mut().flatten() {
            *v = number[*v as usize];
        }
    }
}

/// Marks the free vertices. Also checks every index of the mesh, and that free vertices have triangles.
fn resolve(vertices: usize, triangles: &[[u32; 3]], selection: Selection<'_>) -> Result<Vec<Role>, Error> {
    let mut role = vec![Role::Other; vertices];
    match selection {
        Selection::Mask(mask) => {
            if mask.len() != vertices {
                return Err(Error::MaskLength {
                    length: mask.len(),
                    count: vertices,
                });
            }
            check_indices(vertices, triangles)?;
            role.iter_mut()
                .zip(mask)
                .filter(|(_, free)| **free)
                .for_each(|(r, _)| *r = Role::Free);
        }
        Selection::Vertices(list) => {
            check_selection(list, vertices)?;
            check_indices(vertices, triangles)?;
            list.iter().for_each(|&v| role[v as usize] = Role::Free);
        }
        Selection::Faces(list) => {
            check_selection(list, triangles.len())?;
            check_indices(vertices, triangles)?;
            free_of_faces(triangles, list, &mut role);
        }
    }
    if !role.contains(&Role::Free) {
        return Err(Error::EmptyRegion);
    }
    Ok(role)
}

fn check_selection(list: &[u32], count: usize) -> Result<(), Error> {
    match list.iter().filter(|&&i| i as usize >= count).min() {
        Some(&index) => Err(Error::SelectionOutOfRange {
            index: index as usize,
            count,
        }),
        None => Ok(()),
    }
}

/// Marks the vertices all of whose triangles are in `list` and that are not on the mesh's boundary.
fn free_of_faces(triangles: &[[u32; 3]], list: &[u32], role: &mut [Role]) {
    let mut selected = vec![false; triangles.len()];
    list.iter().for_each(|&t| selected[t as usize] = true);
    list.iter().for_each(|&t| {
        triangles[t as usize]
            .iter()
            .for_each(|&v| role[v as usize] = Role::Free)
    });
    for (tri, _) in triangles.iter().zip(&selected).filter(|(_, s)| !**s) {
        tri.iter().for_each(|&v| role[v as usize] = Role::Other);
    }
    // An edge at a vertex that is still free has all its triangles in the list, so a single one there means
    // the mesh's boundary. Edges (i, i) of broken triangles are left for the checks that follow.
    let touched = |tri: &[u32; 3]| tri.iter().any(|&v| role[v as usize] == Role::Free);
    let kept = (0..).zip(triangles).zip(&selected);
    let kept = kept
        .filter(|((_, tri), s)| **s && touched(tri))
        .map(|(kept, _)| kept);
    let mut on_boundary = Vec::new();
    each_edge(role.len(), kept, |a, b, half_edges| {
        if half_edges.len() == 1 && a != b {
            on_boundary.extend([a, b]);
        }
    });
    on_boundary
        .into_iter()
        .for_each(|v| role[v as usize] = Role::Other);
}

/// The region's triangles, then those of the outside ring; how many belong to the region. Marks boundary and
/// ring vertices.
fn collect(triangles: &[[u32; 3]], role: &mut [Role], prescribed: &dyn Fn(u32) -> bool) -> (Vec<u32>, usize) {
    let has = |role: &[Role], tri: &[u32; 3], r| tri.iter().any(|&v| role[v as usize] == r);
    let mut ids = Vec::new();
    for (t, tri) in triangles.iter().enumerate() {
        if has(role, tri, Role::Free) {
            ids.push(t as u32);
        }
    }
    let region = ids.len();
    for v in ids.iter().flat_map(|&t| triangles[t as usize]) {
        if role[v as usize] == Role::Other {
            role[v as usize] = Role::Boundary;
        }
    }
    for (t, tri) in triangles.iter().enumerate() {
        if has(role, tri, Role::Boundary) && !has(role, tri, Role::Free) {
            ids.push(t as u32);
        }
    }
    for v in ids[region..].iter().flat_map(|&t| triangles[t as usize]) {
        if role[v as usize] == Role::Other {
            role[v as usize] = Role::Ring;
        }
    }
    let at = |ids: &[u32]| ids.iter().map(|&t| triangles[t as usize]).collect::<Vec<_>>();
    let of_island = islands(&at(&ids[..region]), &at(&ids[region..]), |v| {
        role[v as usize] == Role::Boundary && !prescribed(v)
    });
    let pairs = ids.split_off(region).into_iter().zip(of_island);
    let (island, outside): (Vec<_>, Vec<_>) = pairs.partition(|(_, of_island)| *of_island);
    ids.extend(island.into_iter().map(|(t, _)| t));
    ids.sort_unstable();
    let region = ids.len();
    ids.extend(outside.into_iter().map(|(t, _)| t));
    (ids, region)
}

/// Local numbers: the caller's number of each, their inverse, how many are free and boundary.
fn number(role: &[Role]) -> (Vec<u32>, Vec<u32>, usize, usize) {
    let mut ids = Vec::new();
    let mut ends = [0; 3];
    for (r, end) in [Role::Free, Role::Boundary, Role::Ring]
        .into_iter()
        .zip(&mut ends)
    {
        ids.extend((0..role.len()).filter(|&v| role[v] == r).map(|v| v as u32));
        *end = ids.len();
    }
    let mut local = vec![NONE; role.len()];
    ids.iter()
        .enumerate()
        .for_each(|(l, &v)| local[v as usize] = l as u32);
    (ids, local, ends[0], ends[1] - ends[0])
}

/// How far [`RegionMesh::beyond`] reaches.
/// Of 106 cases, half: 76 change by up to 0.6 edges, 1 get another triangulation, +2 % iterations, 2 fail; double: none changes.
pub(super) const RINGS_BEYOND: usize = 2;

/// Gathers [`RegionMesh::beyond`] and numbers its vertices that have no number yet.
fn add_beyond(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    role: &[Role],
    rings: usize,
    vertex_ids: &mut Vec<u32>,
) -> Vec<[u32; 3]> {
    let mut beyond = reach_beyond(positions, triangles, role, rings);
    let mut local = vec![NONE; role.len()];
    for (l, &v) in (0..).zip(&*vertex_ids) {
        local[v as usize] = l;
    }
    let mut new: Vec<u32> = beyond.iter().flatten().copied().collect();
    new.retain(|&v| local[v as usize] == NONE);
    new.sort_unstable();
    new.dedup();
    for v in new {
        local[v as usize] = vertex_ids.len() as u32;
        vertex_ids.push(v);
    }
    for v in beyond.iter_mut().flatten() {
        *v = local[*v as usize];
    }
    beyond
}

/// The triangles of so many rings beyond the outside ring, in the caller's numbers.
fn reach_beyond(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    role: &[Role],
    rings: usize,
) -> Vec<[u32; 3]> {
    let mut reached: Vec<bool> = role.iter().map(|r| *r == Role::Ring).collect();
    let mut before = vec![false; role.len()];
    let mut beyond = Vec::new();
    for _ in 0..rings {
        let first = beyond.len();
        for tri in triangles {
            let any = |marked: &[bool]| tri.iter().any(|&v| marked[v as usize]);
            let inner = tri
                .iter()
                .any(|&v| matches!(role[v as usize], Role::Free | Role::Boundary));
            if any(&reached) && !any(&before) && !inner && repeated(*tri).is_none() {
                let placed = tri.iter().all(|&v| finite(&positions[v as usize]));
                beyond.extend(placed.then_some(*tri));
            }
        }
        before.copy_from_slice(&reached);
        beyond[first..]
            .iter()
            .flatten()
            .for_each(|&v| reached[v as usize] = true);
    }
    beyond
}
