//! Boundary loops of a whole mesh, found on half-edges.
//!
//! Half-edge `3 t + k` runs from corner `k` of triangle `t` to the next. An edge with one triangle is boundary. Flaws
//! elsewhere (edges with three triangles, triangles that name a vertex twice, vertices of several fans) do not matter:
//! a walk along the boundary only crosses edges with exactly two triangles that run through it in opposite directions.

use nalgebra::Vector3;

use super::links::{BOUNDARY, Links};
use super::turning::{Seen, turn};
use crate::holes::singular_vertices::{BoundaryPlaces, HalfEdgeLoop};
use crate::mesh::Joined;
use crate::mesh::coincident::Coincident;
use crate::mesh::disjoint_sets::DisjointSets;
use crate::mesh::halfedge::next;
use crate::support::error::Error;
use crate::support::table::table;

/// What kind of gap a loop is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LoopKind {
    /// A gap in the surface.
    Hole,
    /// The loop encloses the mesh rather than a gap, like the outer boundary of an open sheet: a smooth surface over it would
    /// have to turn back by more than 150 degrees, by the median of the loop and four curves inside. Filled only if it is named.
    OuterBoundary,
    /// The walk along the boundary met an edge that has three triangles or more. Never filled.
    NonManifold {
        /// One end of that edge, the smaller index.
        a: u32,
        /// The other end.
        b: u32,
    },
    /// The walk along the boundary met an edge that its two triangles run through in the same direction: one of them faces the wrong way.
    /// Never filled; [`triangles_to_turn`](crate::triangles_to_turn) helps.
    Inconsistent {
        /// One end of that edge, the smaller index.
        a: u32,
        /// The other end.
        b: u32,
    },
}

table!(LoopKind {
    0 "hole" LoopKind::Hole => "a gap in the surface", "";
    1 "outer_boundary" LoopKind::OuterBoundary => "the outer boundary of an open surface: filled only if it is named", "";
    2 "non_manifold" LoopKind::NonManifold { .. } => "it meets an edge with more than two triangles, which is told: never filled", "";
    3 "inconsistent" LoopKind::Inconsistent { .. } => "it meets an edge, which is told, whose two triangles face opposite ways: never filled", "";
});

/// A closed run of boundary edges that visits no vertex twice.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundaryLoop {
    /// The vertices in the direction in which triangles that fill the loop run through it. Of a loop that is
    /// `NonManifold` or `Inconsistent`, the part between the bad edges.
    pub vertices: Vec<u32>,
    /// Sum of the edge lengths.
    pub length: f64,
    /// The length of the vector area: the area of the flat surface over a plane loop, a lower bound otherwise.
    pub area: f64,
    /// The mean angle in degrees by which a smooth surface over the loop has to turn back towards it: 0 for a hole in a
    /// plane, 90 for the end of a tube, 180 for the outer boundary of a plane sheet. By Gauss and Bonnet the surface has the
    /// total curvature `2 pi (1 - cos turn)`.
    pub turn: f64,
    /// Vertices that belong to another loop, too (bow-ties).
    pub touching: Vec<u32>,
    /// Of an outer boundary: a vertex in which its component touches one that is no smaller. As components hang together by edges, it
    /// hangs there by single vertices only.
    pub hangs_at: Option<u32>,
    /// What kind of gap it is.
    pub kind: LoopKind,
    /// The component of the mesh that the loop is on: triangles that hang together by edges. They count in the order of their
    /// first triangles.
    pub component: usize,
    /// How many triangles that component has. A mesh whose components are single triangles is a soup: its vertices have to be joined, see
    /// [`Coincident`].
    pub component_triangles: usize,
    /// The mesh's half-edge at each edge from a vertex to the next; it runs the other way.
    pub(super) half_edges: Vec<u32>,
}

/// The boundary loops of a mesh, in the order of their first half-edge. `positions` is #V by 3, `triangles` #T by 3.
///
/// At a vertex where several gaps meet, each gap is a loop of its own, also where each side of the vertex has a copy of its own. Vertices with equal coordinates are one vertex of the
/// surface, as by default in [`Coincident`]; a loop names of each the copy in the triangle at its edge.
///
/// ```
/// use fairmesh::{LoopKind, boundary_loops};
/// // An octahedron without one of its triangles.
/// let positions = [
///     [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0],
/// ];
/// let triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5]];
/// let loops = boundary_loops(&positions, &triangles)?;
/// assert_eq!(loops.len(), 1);
/// assert_eq!((loops[0].vertices.len(), loops[0].kind), (3, LoopKind::Hole));
/// assert!((loops[0].turn - 90.0).abs() < 1e-9); // half the octahedron's curvature is missing
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// [`Error::IndexOutOfRange`], [`Error::TooLarge`].
pub fn boundary_loops(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Vec<BoundaryLoop>, Error> {
    boundary_loops_joined(positions, triangles, Coincident::default())
}

/// [`boundary_loops`], which takes coincident vertices as it is told.
///
/// ```
/// use fairmesh::{Coincident, boundary_loops_joined};
/// // A square of two triangles, each with vertices of its own.
/// let positions = [
///     [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0],
/// ];
/// let triangles = [[0, 1, 2], [3, 4, 5]];
/// let loops = |coincident| boundary_loops_joined(&positions, &triangles, coincident);
/// assert_eq!(loops(Coincident::default())?.len(), 1);
/// assert_eq!(loops(Coincident::Separate)?.len(), 2);
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// Those of [`boundary_loops`], and [`Error::BadOption`] for the distance.
pub fn boundary_loops_joined(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    coincident: Coincident,
) -> Result<Vec<BoundaryLoop>, Error> {
    let joined = Joined::new(positions, triangles, coincident)?;
    let links = Links::new(positions.len(), &joined.triangles)?;
    let mut loops = links.loops(positions, coincident);
    if !joined.copies.is_empty() {
        loops
            .iter_mut()
            .for_each(|boundary| boundary.name_copies(triangles));
    }
    Ok(loops)
}

/// Per triangle the number of its component: triangles that hang together by edges. Components count in the order of their first
/// triangles.
///
/// ```
/// use fairmesh::{Coincident, triangle_components};
/// let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, 1.0, 0.0]];
/// let triangles = [[0, 1, 2], [4, 5, 6], [2, 1, 3]];
/// assert_eq!(triangle_components(&positions, &triangles, Coincident::default())?, [0, 1, 0]);
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// Those of [`boundary_loops_joined`].
pub fn triangle_components(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    coincident: Coincident,
) -> Result<Vec<u32>, Error> {
    let joined = Joined::new(positions, triangles, coincident)?;
    Ok(Links::new(positions.len(), &joined.triangles)?.components())
}

impl LoopKind {
    /// The bad edge that the loop meets.
    pub(super) fn bad_edge(self) -> Option<[u32; 2]> {
        match self {
            Self::NonManifold { a, b } | Self::Inconsistent { a, b } => Some([a, b]),
            _ => None,
        }
    }
}

impl BoundaryLoop {
    /// Per vertex the copy that the mesh as given has in the triangle at the edge from it to the next.
    pub(super) fn copies(&self, triangles: &[[u32; 3]]) -> Vec<u32> {
        let ends = self.half_edges.iter().map(|&h| next(h));
        ends.map(|h| triangles[h as usize / 3][h as usize % 3]).collect()
    }

    fn name_copies(&mut self, triangles: &[[u32; 3]]) {
        let copies = self.copies(triangles);
        let of = |v: &u32| {
            self.vertices
                .iter()
                .position(|w| w == v)
                .map_or(*v, |i| copies[i])
        };
        self.touching = self.touching.iter().map(of).collect();
        self.hangs_at = self.hangs_at.as_ref().map(of);
        self.vertices = copies;
    }
}

impl Links<'_> {
    pub(super) fn loops(&self, positions: &[[f64; 3]], coincident: Coincident) -> Vec<BoundaryLoop> {
        let boundary: Vec<u32> = (0..self.opposite.len() as u32)
            .filter(|&h| self.opposite[h as usize] == BOUNDARY)
            .collect();
        let mut has_before = vec![false; self.opposite.len()];
        for &h in &boundary {
            if let Ok(g) = self.follow_gap(h) {
                has_before[g as usize] = true;
            }
        }
        let mut done = vec![false; self.opposite.len()];
        let mut place = vec![BOUNDARY; self.outgoing.len()];
        let mut found: Vec<HalfEdgeLoop> = Vec::new();
        // Runs that end at bad edges first, from their beginnings; then the closed ones.
        for open in [true, false] {
            for &h in &boundary {
                let is_inside = open && has_before[h as usize];
                if !is_inside && !done[h as usize] {
                    self.walk(h, &mut done, &mut place, &mut found);
                }
            }
        }
        if found.is_empty() {
            return Vec::new();
        }
        let components = self.components();
        let mut sizes = vec![0; components.iter().max().map_or(0, |&last| last as usize + 1)];
        components.iter().for_each(|&c| sizes[c as usize] += 1);
        let component_of = |run: &[u32]| components[run[0] as usize / 3] as usize;
        let mut seen = Seen::new(self.outgoing.len());
        let mut places = self.places(&found, positions, coincident);
        found = found
            .into_iter()
            .flat_map(|(run, bad)| match bad {
                // A sheet that is rolled until its corners touch has one outer boundary still.
                None if places.has_any()
                    && !self.is_outer(&run, positions, sizes[component_of(&run)], &mut seen) =>
                {
                    let parts = self.parted(run, &mut places, &mut place);
                    parts.into_iter().map(|run| (run, None)).collect()
                }
                bad => vec![(run, bad)],
            })
            .collect();
        found.sort_by_key(|(run, _)| run.iter().min().map_or(0, |&h| h));
        let mut visits = vec![0u8; self.outgoing.len()];
        for &h in found.iter().flat_map(|(run, _)| run) {
            let v = self.origin(next(h)) as usize;
            visits[v] = visits[v].saturating_add(1);
        }
        found
            .into_iter()
            .map(|(run, bad)| {
                let component = component_of(&run);
                let is_outer = self.is_outer(&run, positions, sizes[component], &mut seen);
                let kind = self.kind(bad, is_outer);
                let of = [component, sizes[component]];
                let mut boundary = self.measure(run, positions, (kind, of), (&places, &visits));
                if is_outer {
                    boundary.hangs_at = self.hanging(&boundary, &components, &sizes);
                }
                boundary
            })
            .collect()
    }

    /// Per triangle the number of its component.
    pub(super) fn components(&self) -> Vec<u32> {
        let count = self.triangles.len();
        let mut sets = DisjointSets::new(count);
        for h in 0..self.opposite.len() as u32 {
            if let Some(o) = self.across(h) {
                sets.unite(h / 3, o / 3);
            }
        }
        sets.numbers(count).0
    }

    /// Walks from a boundary half-edge until the run closes or meets a bad edge. Whenever a vertex comes again, what lies
    /// in between is a loop of its own.
    fn walk(&self, first: u32, done: &mut [bool], place: &mut [u32], found: &mut Vec<HalfEdgeLoop>) {
        let mut run: Vec<u32> = Vec::new();
        let mut h = first;
        let bad = loop {
            done[h as usize] = true;
            // The gap runs from h's target to its origin.
            let v = self.origin(next(h)) as usize;
            if place[v] != BOUNDARY {
                let inner = run.split_off(place[v] as usize);
                inner
                    .iter()
                    .for_each(|&g| place[self.origin(next(g)) as usize] = BOUNDARY);
                found.push((inner, None));
            }
            place[v] = run.len() as u32;
            run.push(h);
            match self.follow_gap(h) {
                Ok(g) if g == first => break None,
                Ok(g) => h = g,
                Err(g) => break Some(g),
            }
        };
        run.iter()
            .for_each(|&g| place[self.origin(next(g)) as usize] = BOUNDARY);
        found.push((run, bad));
    }

    fn measure(
        &self,
        run: Vec<u32>,
        positions: &[[f64; 3]],
        (kind, [component, component_triangles]): (LoopKind, [usize; 2]),
        (places, visits): (&BoundaryPlaces, &[u8]),
    ) -> BoundaryLoop {
        let vertices: Vec<u32> = run.iter().map(|&h| self.origin(next(h))).collect();
        let at = |v: u32| Vector3::from(positions[v as usize]);
        let first = at(vertices[0]);
        let (mut length, mut area) = (0.0, Vector3::zeros());
        for (&v, &h) in vertices.iter().zip(&run) {
            let (p, q) = (at(v) - first, at(self.origin(h)) - first);
            length += (q - p).norm();
            area += 0.5 * p.cross(&q);
        }
        let turn = turn(self.turning(&run, positions));
        let mut touching = vertices.clone();
        touching.retain(|&v| visits[v as usize] > 1 || places.is_pinch(v));
        BoundaryLoop {
            vertices,
            length,
            area: area.norm(),
            turn: turn.to_degrees(),
            touching,
            hangs_at: None,
            kind,
            component,
            component_triangles,
            half_edges: run,
        }
    }

    /// The first vertex of a loop that has triangles of another component, too, which is no smaller.
    fn hanging(&self, boundary: &BoundaryLoop, components: &[u32], sizes: &[usize]) -> Option<u32> {
        let of = |h: u32| components[h as usize / 3] as usize;
        let is_larger =
            |&h: &u32| of(h) != boundary.component && sizes[of(h)] >= boundary.component_triangles;
        let mut vertices = boundary.vertices.iter().copied();
        vertices.find(|&v| self.at(v).iter().any(is_larger))
    }

    /// The kind of a loop whose walk met a `bad` edge, or none.
    fn kind(&self, bad: Option<u32>, is_outer: bool) -> LoopKind {
        match bad {
            Some(g) => {
                let (a, b) = (self.origin(g), self.origin(next(g)));
                let [a, b] = [a.min(b), a.max(b)];
                match self.is_inconsistent(a, b) {
                    true => LoopKind::Inconsistent { a, b },
                    false => LoopKind::NonManifold { a, b },
                }
            }
            None if is_outer => LoopKind::OuterBoundary,
            None => LoopKind::Hole,
        }
    }
}
