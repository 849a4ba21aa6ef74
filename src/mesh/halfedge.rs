//! The half-edge structure of the region and of the ring of triangles around it: flat index arrays,
//! validated once.
//!
//! Half-edge `3t + k` runs from corner `k` of triangle `t` to corner `k + 1`.

use super::rows::Rows;
use crate::support::error::Error;

/// No element: the partner of a boundary half-edge, the flap that is not there.
pub(crate) const NONE: u32 = u32::MAX;

/// The half-edge after `h` in its triangle.
#[inline]
pub(crate) fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

/// The half-edge before `h` in its triangle.
#[inline]
pub(crate) fn previous(h: u32) -> u32 {
    if h.is_multiple_of(3) { h + 2 } else { h - 1 }
}

/// Triangles and their neighbourhood: the region's triangles first, then the outside ring (the triangles
/// that touch a boundary vertex without belonging to the region). An orientable 2-manifold, perhaps with boundary.
#[derive(Debug, Clone, Default)]
pub(crate) struct HalfEdges {
    /// Local vertex numbers of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// The caller's number of each triangle.
    pub triangle_ids: Vec<u32>,
    /// How many triangles belong to the region.
    pub region_triangles: usize,
    /// Per half-edge its partner, or [`NONE`].
    pub opposite: Vec<u32>,
    /// The outgoing half-edges of each free and boundary vertex, counter-clockwise, one per triangle. An open fan
    /// begins at its boundary; a closed one at a boundary vertex that has an outside begins with a run of region
    /// triangles; among the choices left it begins at the smallest local vertex.
    pub outgoing: Rows<u32>,
}

impl HalfEdges {
    /// Matches the half-edges of `triangles` (local numbers) and checks that they form an orientable
    /// 2-manifold around the free and boundary vertices. `vertex_ids` serves the error messages.
    pub(super) fn new(
        triangles: Vec<[u32; 3]>,
        triangle_ids: Vec<u32>,
        region_triangles: usize,
        (free, boundary): (usize, usize),
        vertex_ids: &[u32],
    ) -> Result<Self, Error> {
        let corners = (0..).zip(triangles.iter().flatten());
        let outgoing = Rows::collect(vertex_ids.len(), corners.map(|(h, &v)| (v, h)));
        let without = (0..free).filter(|&v| outgoing.row(v).is_empty());
        if let Some(vertex) = without.map(|v| vertex_ids[v] as usize).min() {
            return Err(Error::FreeVertexWithoutTriangle { vertex });
        }
        let mut half_edges = Self {
            triangles,
            triangle_ids,
            region_triangles,
            outgoing,
            ..Self::default()
        };
        half_edges.link(free, free + boundary, vertex_ids)?;
        half_edges.outgoing.truncate(free + boundary);
        Ok(half_edges)
    }

    /// The vertex that `h` starts from.
    #[inline]
    pub(crate) fn origin(&self, h: u32) -> u32 {
        self.triangles[h as usize / 3][h as usize % 3]
    }

    /// The vertex that `h` runs to.
    #[inline]
    pub(crate) fn target(&self, h: u32) -> u32 {
        self.origin(next(h))
    }

    /// The vertex of `h`'s triangle that is not on `h`.
    #[inline]
    pub(crate) fn apex(&self, h: u32) -> u32 {
        self.origin(previous(h))
    }

    /// Whether `h` lies in a triangle of the region.
    #[inline]
    pub(crate) fn in_region(&self, h: u32) -> bool {
        (h as usize) < 3 * self.region_triangles
    }

    /// The third vertex of the region triangle across `h`, or [`NONE`].
    #[inline]
    pub(crate) fn flap(&self, h: u32) -> u32 {
        let o = self.opposite[h as usize];
        if o != NONE && self.in_region(o) {
            self.apex(o)
        } else {
            NONE
        }
    }

    /// Origin, target and apex of `h`.
    #[inline]
    pub(crate) fn corners(&self, h: u32) -> [u32; 3] {
        let [a, b, c] = self.triangles[h as usize / 3];
        match h % 3 {
            0 => [a, b, c],
            1 => [b, c, a],
            _ => [c, a, b],
        }
    }

    /// Finds every half-edge's partner, brings those that leave free and boundary vertices into order, and checks
    /// that each of these vertices has one fan.
    fn link(&mut self, free: usize, region: usize, vertex_ids: &[u32]) -> Result<(), Error> {
        let mut opposite = vec![NONE; 3 * self.triangles.len()];
        let mut outgoing = std::mem::take(&mut self.outgoing);
        let mut fan = Fan::default();
        let (mut sound, mut open, mut bow_tie) = (true, NONE, NONE);
        for (v, &id) in vertex_ids.iter().enumerate() {
            let row = outgoing.row_mut(v);
            sound &= fan.link(self, row, &mut opposite);
            if v < free && fan.is_open() {
                open = open.min(id);
            } else if v < region && !fan.order(self, row) {
                bow_tie = bow_tie.min(id);
            }
        }
        (self.outgoing, self.opposite) = (outgoing, opposite);
        if !sound {
            self.find_flaws(vertex_ids).into_result()?;
        }
        if open != NONE {
            return Err(Error::FreeVertexOnBoundary {
                vertex: open as usize,
            });
        }
        if bow_tie != NONE {
            return Err(Error::NonManifoldVertex {
                vertex: bow_tie as usize,
            });
        }
        Ok(())
    }

    /// Goes through all edges for those that are not of two triangles side by side.
    #[cold]
    fn find_flaws(&self, vertex_ids: &[u32]) -> Flaws {
        let mut flaws = Flaws::default();
        each_edge(
            vertex_ids.len(),
            (0..).zip(&self.triangles),
            |v, other, half_edges| {
                if half_edges.len() > 1 {
                    flaws.note(self, [v, other], half_edges, vertex_ids);
                }
            },
        );
        flaws
    }

    #[cfg(test)]
    /// Checks the invariants; for tests.
    ///
    /// # Errors
    /// What is violated.
    pub(crate) fn validate(&self) -> Result<(), String> {
        if self.opposite.len() != 3 * self.triangles.len() || self.triangle_ids.len() != self.triangles.len()
        {
            return Err("lengths differ".into());
        }
        for h in 0..self.opposite.len() as u32 {
            let o = self.opposite[h as usize];
            if o == NONE {
                continue;
            }
            if self.opposite[o as usize] != h {
                return Err(format!("opposite of opposite of {h}"));
            }
            if self.origin(h) != self.target(o) || self.target(h) != self.origin(o) {
                return Err(format!("ends of {h} and {o}"));
            }
        }
        for v in 0..self.outgoing.len() {
            let outgoing = self.outgoing.row(v);
            if outgoing.is_empty() || outgoing.iter().any(|&h| self.origin(h) as usize != v) {
                return Err(format!("half-edges that leave {v}"));
            }
            let after = |h: u32| self.opposite[previous(h) as usize];
            if outgoing.windows(2).any(|pair| after(pair[0]) != pair[1]) {
                return Err(format!("order of the half-edges that leave {v}"));
            }
            let last = after(outgoing[outgoing.len() - 1]);
            if last != outgoing[0] && (last != NONE || self.opposite[outgoing[0] as usize] != NONE) {
                return Err(format!("fan of {v}"));
            }
        }
        Ok(())
    }
}

/// The triangles around one vertex, on the way from a heap to a fan. One for all vertices: no allocation.
#[derive(Default)]
struct Fan {
    /// (target, apex, half-edge) of each half-edge that leaves the vertex, by target.
    outgoing: Vec<[u32; 3]>,
    /// Per outgoing half-edge the next one counter-clockwise, or [`NONE`].
    following: Vec<u32>,
    /// Per outgoing half-edge the one before, or [`NONE`].
    preceding: Vec<u32>,
}

impl Fan {
    /// Enters the half-edges of `row` and finds their partners. False where an edge has two triangles on one side
    /// or two triangles lie back to back.
    fn link(&mut self, half_edges: &HalfEdges, row: &[u32], opposite: &mut [u32]) -> bool {
        self.outgoing.clear();
        self.outgoing.extend(row.iter().map(|&h| {
            let [_, target, apex] = half_edges.corners(h);
            [target, apex, h]
        }));
        self.outgoing.sort_unstable_by_key(|s| s[0]);
        let mut sound = self.outgoing.windows(2).all(|s| s[0][0] != s[1][0]);
        self.following.clear();
        self.following.resize(row.len(), NONE);
        self.preceding.clear();
        self.preceding.resize(row.len(), NONE);
        for (i, &[target, apex, h]) in self.outgoing.iter().enumerate() {
            let Some(j) = self.to(apex) else { continue };
            sound &= self.outgoing[j][1] != target && self.preceding[j] == NONE;
            self.following[i] = j as u32;
            self.preceding[j] = i as u32;
            opposite[self.outgoing[j][2] as usize] = previous(h);
        }
        sound
    }

    /// The number of the half-edge to a neighbour.
    #[inline]
    fn to(&self, neighbour: u32) -> Option<usize> {
        if self.outgoing.len() > 16 {
            return self.outgoing.binary_search_by_key(&neighbour, |s| s[0]).ok();
        }
        self.outgoing.iter().position(|s| s[0] == neighbour)
    }

    fn is_open(&self) -> bool {
        self.following.contains(&NONE)
    }

    /// Writes the half-edges to `row` in order. False if they are not all of one fan.
    fn order(&self, half_edges: &HalfEdges, row: &mut [u32]) -> bool {
        let first = self.first(half_edges);
        let mut at = first;
        for (count, h) in row.iter_mut().enumerate() {
            if at == NONE || (at == first && count > 0) {
                return false;
            }
            *h = self.outgoing[at as usize][2];
            at = self.following[at as usize];
        }
        true
    }

    /// Where the fan begins, by the rule of [`HalfEdges::outgoing`].
    fn first(&self, half_edges: &HalfEdges) -> u32 {
        let inside = |i: u32| half_edges.in_region(self.outgoing[i as usize][2]);
        let enters = |&(i, &p): &(usize, &u32)| inside(i as u32) && !inside(p);
        if let Some(i) = self.preceding.iter().position(|&p| p == NONE) {
            return i as u32;
        }
        self.preceding
            .iter()
            .enumerate()
            .find(enters)
            .map_or(0, |(i, _)| i as u32)
    }
}

/// Hands every edge of some numbered triangles to `visit`: its smaller and its larger end, and the half-edges along it
/// as `(larger end, half-edge)`, ascending.
pub(super) fn each_edge<'a>(
    vertices: usize,
    triangles: impl Iterator<Item = (u32, &'a [u32; 3])> + Clone,
    mut visit: impl FnMut(u32, u32, &[(u32, u32)]),
) {
    let sides = triangles.flat_map(|(t, &[a, b, c])| [(a, b, 3 * t), (b, c, 3 * t + 1), (c, a, 3 * t + 2)]);
    let mut edges = Rows::collect(vertices, sides.map(|(a, b, h)| (a.min(b), (a.max(b), h))));
    for v in 0..vertices {
        let row = edges.row_mut(v);
        row.sort_unstable();
        for half_edges in row.chunk_by(|x, y| x.0 == y.0) {
            visit(v as u32, half_edges[0].0, half_edges);
        }
    }
}

/// The smallest flaw of each kind, in the caller's numbers.
#[derive(Default)]
struct Flaws {
    /// (later triangle, earlier triangle)
    duplicate: Option<(u32, u32)>,
    /// (a, b, last triangle)
    edge: Option<(u32, u32, u32)>,
    /// (later triangle, earlier triangle, a, b)
    orientation: Option<(u32, u32, u32, u32)>,
}

/// Keeps the smaller one.
fn keep<T: Ord>(least: &mut Option<T>, found: T) {
    if least.as_ref().is_none_or(|l| found < *l) {
        *least = Some(found);
    }
}

impl Flaws {
    /// Records what is wrong with an edge between these two vertices.
    fn note(&mut self, half_edges: &HalfEdges, ends: [u32; 2], edge: &[(u32, u32)], vertex_ids: &[u32]) {
        let id = |h: u32| half_edges.triangle_ids[h as usize / 3];
        let mut by_third: Vec<_> = edge.iter().map(|&(_, h)| (half_edges.apex(h), id(h))).collect();
        by_third.sort_unstable();
        for pair in by_third.windows(2).filter(|p| p[0].0 == p[1].0) {
            keep(&mut self.duplicate, (pair[1].1, pair[0].1));
        }
        let [p, q] = ends.map(|v| vertex_ids[v as usize]);
        let (a, b) = (p.min(q), p.max(q));
        let last = edge.iter().map(|e| id(e.1)).max().unwrap_or(NONE);
        if edge.len() > 2 {
            keep(&mut self.edge, (a, b, last));
        } else if half_edges.origin(edge[0].1) == half_edges.origin(edge[1].1) {
            let first = edge.iter().map(|e| id(e.1)).min().unwrap_or(NONE);
            keep(&mut self.orientation, (last, first, a, b));
        }
    }

    /// The gravest flaw.
    fn into_result(self) -> Result<(), Error> {
        if let Some((triangle, other)) = self.duplicate {
            return Err(Error::DuplicateTriangle {
                triangle: triangle as usize,
                other: other as usize,
            });
        }
        if let Some((a, b, triangle)) = self.edge {
            return Err(Error::NonManifoldEdge {
                a: a as usize,
                b: b as usize,
                triangle: triangle as usize,
            });
        }
        if let Some((triangle, other, a, b)) = self.orientation {
            return Err(Error::InconsistentOrientation {
                a: a as usize,
                b: b as usize,
                triangle: triangle as usize,
                other: other as usize,
            });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fan of `n` triangles around vertex 0, their order scrambled; vertex 0 is free if the fan is closed.
    fn fan(n: u32, closed: bool) -> Result<HalfEdges, Error> {
        let last = if closed { 1 } else { n + 1 };
        let target = |k: u32| if k == n { last } else { k + 1 };
        let mut triangles: Vec<[u32; 3]> = (0..n).map(|k| [k + 1, target(k + 1), 0]).collect();
        triangles.sort_unstable_by_key(|t| t[0] * 7 % n);
        let vertices = if closed { n + 1 } else { n + 2 };
        let ids: Vec<u32> = (100..100 + vertices).collect();
        let triangle_ids = (0..n).collect();
        let (free, boundary) = (usize::from(closed), usize::from(!closed));
        HalfEdges::new(triangles, triangle_ids, n as usize, (free, boundary), &ids)
    }

    #[test]
    fn next_and_previous_stay_in_the_triangle() {
        for h in 0..12 {
            assert_eq!((previous(next(h)), next(previous(h))), (h, h));
            assert_eq!((next(h) / 3, next(next(h))), (h / 3, previous(h)));
        }
    }

    #[test]
    fn fans_of_any_valence_come_into_order() {
        for n in [3, 4, 5, 6, 15, 16, 17, 18, 100, 1000] {
            for closed in [true, false] {
                let half_edges = fan(n, closed).unwrap();
                half_edges.validate().unwrap();
                let ring: Vec<u32> = half_edges
                    .outgoing
                    .row(0)
                    .iter()
                    .map(|&h| half_edges.target(h))
                    .collect();
                assert_eq!(ring, (1..=n).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn corners_are_origin_target_and_apex() {
        let half_edges = fan(5, true).unwrap();
        for h in 0..15 {
            assert_eq!(
                half_edges.corners(h),
                [half_edges.origin(h), half_edges.target(h), half_edges.apex(h)]
            );
            assert_eq!(half_edges.apex(h), half_edges.target(next(h)));
        }
    }
}
