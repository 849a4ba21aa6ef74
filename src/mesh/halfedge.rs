//! The half-edge structure of the region and of the ring of triangles around it: flat index arrays,
//! validated once.
//!
//! Half-edge `3t + k` runs from corner `k` of triangle `t` to corner `k + 1`.

use super::NONE;
use crate::error::Error;

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
    /// Rows of `ring_edge`; one offset per free and boundary vertex, and the end.
    pub spoke_start: Vec<u32>,
    /// The outgoing half-edges of each free and boundary vertex, counter-clockwise, one per triangle. An open fan
    /// begins at its boundary; a closed one at a boundary vertex that has an outside begins with a run of region
    /// triangles; among the choices left it begins at the smallest local vertex.
    pub ring_edge: Vec<u32>,
}

impl HalfEdges {
    /// Matches the half-edges of `triangles` (local numbers) and checks that they form an orientable
    /// 2-manifold around the free and boundary vertices. `vertex_ids` serves the error messages.
    pub(super) fn new(
        triangles: Vec<[u32; 3]>,
        triangle_ids: Vec<u32>,
        region_triangles: usize,
        free: usize,
        boundary: usize,
        vertex_ids: &[u32],
    ) -> Result<Self, Error> {
        let mut half_edges = Self {
            triangles,
            triangle_ids,
            region_triangles,
            ..Self::default()
        };
        half_edges.sort_spokes(vertex_ids.len());
        let starts = half_edges.spoke_start[..=free].windows(2);
        if let Some(v) = starts.into_iter().position(|w| w[0] == w[1]) {
            return Err(Error::FreeVertexWithoutTriangle {
                vertex: vertex_ids[v] as usize,
            });
        }
        half_edges.link(free, free + boundary, vertex_ids)?;
        half_edges.spoke_start.truncate(free + boundary + 1);
        half_edges
            .ring_edge
            .truncate(half_edges.spoke_start[free + boundary] as usize);
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

    /// The outgoing half-edges of a free or boundary vertex; see [`HalfEdges::ring_edge`].
    #[inline]
    pub(crate) fn ring_edges(&self, vertex: usize) -> &[u32] {
        &self.ring_edge[self.spoke_start[vertex] as usize..self.spoke_start[vertex + 1] as usize]
    }

    /// Sorts the half-edges by the vertex that they leave.
    fn sort_spokes(&mut self, vertices: usize) {
        let mut cursor = vec![0u32; vertices + 1];
        self.triangles
            .iter()
            .flatten()
            .for_each(|&v| cursor[v as usize] += 1);
        let mut sum = 0;
        for c in &mut cursor {
            sum += std::mem::replace(c, sum);
        }
        self.spoke_start = cursor.clone();
        self.ring_edge = vec![0; 3 * self.triangles.len()];
        for (h, &v) in self.triangles.iter().flatten().enumerate() {
            let at = &mut cursor[v as usize];
            self.ring_edge[*at as usize] = h as u32;
            *at += 1;
        }
    }

    /// Finds every half-edge's partner, brings the ring_edges of free and boundary vertices into order, and checks
    /// that each of these has one fan.
    fn link(&mut self, free: usize, region: usize, vertex_ids: &[u32]) -> Result<(), Error> {
        let mut opposite = vec![NONE; 3 * self.triangles.len()];
        let mut ring_edge = std::mem::take(&mut self.ring_edge);
        let mut fan = Fan::default();
        let (mut sound, mut open, mut bow_tie) = (true, NONE, NONE);
        for (v, &id) in vertex_ids.iter().enumerate() {
            let row = &mut ring_edge[self.spoke_start[v] as usize..self.spoke_start[v + 1] as usize];
            sound &= fan.link(self, row, &mut opposite);
            if v < free && fan.is_open() {
                open = open.min(id);
            } else if v < region && !fan.order(self, row) {
                bow_tie = bow_tie.min(id);
            }
        }
        (self.ring_edge, self.opposite) = (ring_edge, opposite);
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
        let (end, mut bucket) = buckets(vertex_ids.len(), self.triangles.iter().enumerate());
        let mut flaws = Flaws::default();
        let mut begin = 0;
        for (v, &end) in end.iter().enumerate() {
            let bucket = &mut bucket[begin..end as usize];
            begin = end as usize;
            bucket.sort_unstable();
            for edge in bucket.chunk_by(|x, y| x >> 32 == y >> 32).filter(|e| e.len() > 1) {
                flaws.note(self, v, edge, vertex_ids);
            }
        }
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
        for v in 0..self.spoke_start.len() - 1 {
            let ring_edges = self.ring_edges(v);
            if ring_edges.is_empty() || ring_edges.iter().any(|&h| self.origin(h) as usize != v) {
                return Err(format!("ring_edges of {v}"));
            }
            if ring_edges
                .windows(2)
                .any(|s| self.opposite[previous(s[0]) as usize] != s[1])
            {
                return Err(format!("order of the ring_edges of {v}"));
            }
            let last = self.opposite[previous(ring_edges[ring_edges.len() - 1]) as usize];
            if last != ring_edges[0] && (last != NONE || self.opposite[ring_edges[0] as usize] != NONE) {
                return Err(format!("fan of {v}"));
            }
        }
        Ok(())
    }
}

/// The triangles around one vertex, on the way from a heap to a fan. One for all vertices: no allocation.
#[derive(Default)]
struct Fan {
    /// (target, apex, half-edge) of each ring_edge, by target.
    ring_edge: Vec<[u32; 3]>,
    /// Per ring_edge the next one counter-clockwise, or [`NONE`].
    following: Vec<u32>,
    /// Per ring_edge the one before, or [`NONE`].
    preceding: Vec<u32>,
}

impl Fan {
    /// Enters the ring_edges of `row` and finds their partners. False where an edge has two triangles on one side
    /// or two triangles lie back to back.
    fn link(&mut self, half_edges: &HalfEdges, row: &[u32], opposite: &mut [u32]) -> bool {
        self.ring_edge.clear();
        self.ring_edge.extend(row.iter().map(|&h| {
            let [_, target, apex] = half_edges.corners(h);
            [target, apex, h]
        }));
        self.ring_edge.sort_unstable_by_key(|s| s[0]);
        let mut sound = self.ring_edge.windows(2).all(|s| s[0][0] != s[1][0]);
        self.following.clear();
        self.following.resize(row.len(), NONE);
        self.preceding.clear();
        self.preceding.resize(row.len(), NONE);
        for (i, &[target, apex, h]) in self.ring_edge.iter().enumerate() {
            let Some(j) = self.to(apex) else { continue };
            sound &= self.ring_edge[j][1] != target && self.preceding[j] == NONE;
            self.following[i] = j as u32;
            self.preceding[j] = i as u32;
            opposite[self.ring_edge[j][2] as usize] = previous(h);
        }
        sound
    }

    /// The ring_edge to a neighbour.
    #[inline]
    fn to(&self, neighbour: u32) -> Option<usize> {
        if self.ring_edge.len() > 16 {
            return self.ring_edge.binary_search_by_key(&neighbour, |s| s[0]).ok();
        }
        self.ring_edge.iter().position(|s| s[0] == neighbour)
    }

    fn is_open(&self) -> bool {
        self.following.contains(&NONE)
    }

    /// Writes the ring_edges to `row` in order. False if they are not all of one fan.
    fn order(&self, half_edges: &HalfEdges, row: &mut [u32]) -> bool {
        let first = self.first(half_edges);
        let mut at = first;
        for (count, h) in row.iter_mut().enumerate() {
            if at == NONE || (at == first && count > 0) {
                return false;
            }
            *h = self.ring_edge[at as usize][2];
            at = self.following[at as usize];
        }
        true
    }

    /// Where the fan begins; see [`HalfEdges::ring_edge`].
    fn first(&self, half_edges: &HalfEdges) -> u32 {
        let inside = |i: u32| half_edges.in_region(self.ring_edge[i as usize][2]);
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

/// Half-edges as `larger vertex << 32 | half-edge`, grouped by the smaller vertex; the end of each group.
pub(super) fn buckets<'a>(
    vertices: usize,
    triangles: impl Iterator<Item = (usize, &'a [u32; 3])> + Clone,
) -> (Vec<u32>, Vec<u64>) {
    let mut cursor = vec![0u32; vertices];
    for (_, &[a, b, c]) in triangles.clone() {
        cursor[a.min(b) as usize] += 1;
        cursor[b.min(c) as usize] += 1;
        cursor[c.min(a) as usize] += 1;
    }
    let mut sum = 0;
    for c in &mut cursor {
        sum += std::mem::replace(c, sum);
    }
    let mut entries = vec![0u64; sum as usize];
    for (t, tri) in triangles {
        for k in 0..3 {
            let (a, b) = (tri[k], tri[(k + 1) % 3]);
            let at = &mut cursor[a.min(b) as usize];
            entries[*at as usize] = u64::from(a.max(b)) << 32 | (3 * t + k) as u64;
            *at += 1;
        }
    }
    (cursor, entries)
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
    /// Records what is wrong with an edge whose smaller end is `v`.
    fn note(&mut self, half_edges: &HalfEdges, v: usize, edge: &[u64], vertex_ids: &[u32]) {
        let id = |h: u64| half_edges.triangle_ids[h as u32 as usize / 3];
        let mut by_third: Vec<_> = edge.iter().map(|&h| (half_edges.apex(h as u32), id(h))).collect();
        by_third.sort_unstable();
        for pair in by_third.windows(2).filter(|p| p[0].0 == p[1].0) {
            keep(&mut self.duplicate, (pair[1].1, pair[0].1));
        }
        let (p, q) = (vertex_ids[v], vertex_ids[(edge[0] >> 32) as usize]);
        let (a, b) = (p.min(q), p.max(q));
        let last = edge.iter().map(|&h| id(h)).max().unwrap_or(NONE);
        if edge.len() > 2 {
            keep(&mut self.edge, (a, b, last));
        } else if half_edges.origin(edge[0] as u32) == half_edges.origin(edge[1] as u32) {
            let first = edge.iter().map(|&h| id(h)).min().unwrap_or(NONE);
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
        HalfEdges::new(triangles, triangle_ids, n as usize, free, boundary, &ids)
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
                    .ring_edges(0)
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
