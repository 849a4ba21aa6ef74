//! The half-edge structure of the region and of the ring of triangles around it: flat index arrays,
//! validated once.
//!
//! Half-edge `3t + k` runs from corner `k` of triangle `t` to corner `k + 1`.

use super::NONE;
use crate::error::Error;

/// The half-edge after `h` in its triangle.
#[inline]
pub fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

/// The half-edge before `h` in its triangle.
#[inline]
pub fn previous(h: u32) -> u32 {
    if h.is_multiple_of(3) { h + 2 } else { h - 1 }
}

/// Triangles and their neighbourhood: the region's triangles first, then the outside ring (the triangles
/// that touch a border vertex without belonging to the region). An orientable 2-manifold, perhaps with border.
#[derive(Debug, Clone, Default)]
pub struct HalfEdges {
    /// Local vertex numbers of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// The caller's number of each triangle.
    pub triangle_ids: Vec<u32>,
    /// How many triangles belong to the region.
    pub region_triangles: usize,
    /// Per half-edge its partner, or [`NONE`].
    pub opposite: Vec<u32>,
    /// Per free and border vertex one outgoing half-edge, the first of its fan counter-clockwise. Of a closed
    /// fan: at a border vertex that has an outside, the beginning of a run of region triangles; among the
    /// choices left, the one to the smallest local vertex.
    pub outgoing: Vec<u32>,
    /// Per half-edge of the outside ring (the first is `3 * region_triangles`): the third vertex of the
    /// triangle across, in the ring or beyond; [`NONE`] where there is none, where several share the edge,
    /// where it belongs to the region, or where that vertex is not finite.
    pub flap_outside: Vec<u32>,
}

impl HalfEdges {
    /// Matches the half-edges of `triangles` (local numbers) and checks that they form an orientable
    /// 2-manifold around the free and border vertices. `vertex_ids` serves the error messages.
    /// `flap_outside` is left empty.
    pub(super) fn new(
        triangles: Vec<[u32; 3]>,
        triangle_ids: Vec<u32>,
        region_triangles: usize,
        free: usize,
        border: usize,
        vertex_ids: &[u32],
    ) -> Result<Self, Error> {
        let mut half_edges = Self {
            triangles,
            triangle_ids,
            region_triangles,
            ..Self::default()
        };
        half_edges.pair(vertex_ids)?;
        half_edges.fans(free, free + border, vertex_ids)?;
        Ok(half_edges)
    }

    /// The vertex that `h` starts from.
    #[inline]
    pub fn origin(&self, h: u32) -> u32 {
        self.triangles[h as usize / 3][h as usize % 3]
    }

    /// The vertex that `h` runs to.
    #[inline]
    pub fn target(&self, h: u32) -> u32 {
        self.origin(next(h))
    }

    /// The vertex of `h`'s triangle that is not on `h`.
    #[inline]
    pub fn apex(&self, h: u32) -> u32 {
        self.origin(previous(h))
    }

    /// Whether `h` lies in a triangle of the region.
    #[inline]
    pub fn in_region(&self, h: u32) -> bool {
        (h as usize) < 3 * self.region_triangles
    }

    /// The third vertex of the region triangle across `h`, or [`NONE`].
    #[inline]
    pub fn flap(&self, h: u32) -> u32 {
        let o = self.opposite[h as usize];
        if o != NONE && self.in_region(o) {
            self.apex(o)
        } else {
            NONE
        }
    }

    /// The outgoing half-edges of a free or border vertex, counter-clockwise, one per triangle.
    #[inline]
    pub fn around(&self, vertex: usize) -> Around<'_> {
        Around {
            half_edges: self,
            first: self.outgoing[vertex],
            at: self.outgoing[vertex],
        }
    }

    /// Finds every half-edge's partner. Half-edges are sorted into buckets by the smaller vertex, each
    /// bucket by the larger one.
    fn pair(&mut self, vertex_ids: &[u32]) -> Result<(), Error> {
        let (end, mut bucket) = buckets(vertex_ids.len(), &self.triangles);
        self.opposite = vec![NONE; 3 * self.triangles.len()];
        let mut flaws = Flaws::default();
        let mut begin = 0;
        for (v, &end) in end.iter().enumerate() {
            let bucket = &mut bucket[begin..end as usize];
            begin = end as usize;
            bucket.sort_unstable();
            for edge in bucket.chunk_by(|x, y| x >> 32 == y >> 32) {
                match *edge {
                    [_] => {}
                    [x, y] if self.fits(x as u32, y as u32) => {
                        self.opposite[x as u32 as usize] = y as u32;
                        self.opposite[y as u32 as usize] = x as u32;
                    }
                    _ => flaws.note(self, v, edge, vertex_ids),
                }
            }
        }
        flaws.into_result()
    }

    /// Whether two half-edges on one edge are partners: opposite directions, different triangles.
    #[inline]
    fn fits(&self, x: u32, y: u32) -> bool {
        self.origin(x) != self.origin(y) && self.apex(x) != self.apex(y)
    }

    /// Chooses `outgoing`, and checks that the triangles around every free vertex form one closed fan and
    /// those around every border vertex one fan.
    fn fans(&mut self, free: usize, vertices: usize, vertex_ids: &[u32]) -> Result<(), Error> {
        let mut valence = vec![0u32; vertices];
        let mut rank = vec![u64::MAX; vertices];
        let mut outgoing = vec![NONE; vertices];
        let mut open = NONE;
        for h in 0..self.opposite.len() as u32 {
            let v = self.origin(h);
            if v as usize >= vertices {
                continue;
            }
            let r = self.rank(h);
            valence[v as usize] += 1;
            if r < rank[v as usize] {
                rank[v as usize] = r;
                outgoing[v as usize] = h;
            }
            if (v as usize) < free
                && (self.opposite[h as usize] == NONE || self.opposite[previous(h) as usize] == NONE)
            {
                open = open.min(v);
            }
        }
        if open != NONE {
            return Err(Error::FreeVertexOnBorder {
                vertex: vertex_ids[open as usize] as usize,
            });
        }
        self.outgoing = outgoing;
        (0..vertices)
            .filter(|&v| self.around(v).count() != valence[v] as usize)
            .map(|v| vertex_ids[v])
            .min()
            .map_or(Ok(()), |v| Err(Error::NonManifoldVertex { vertex: v as usize }))
    }

    /// Orders the outgoing half-edges of a vertex: the smallest is where its fan begins.
    #[inline]
    fn rank(&self, h: u32) -> u64 {
        let clockwise = self.opposite[h as usize];
        let class = if clockwise == NONE {
            0
        } else if self.in_region(h) && !self.in_region(clockwise) {
            1
        } else {
            2
        };
        class << 32 | u64::from(self.target(h))
    }

    /// Fills `flap_outside`. `beyond(h)` tells what further triangles, not among these, share the edge of
    /// half-edge `h`: how many, and the third vertex of one of them ([`NONE`]: unusable).
    pub(super) fn set_flaps(&mut self, beyond: impl Fn(u32) -> (u32, u32)) {
        let first = 3 * self.region_triangles as u32;
        self.flap_outside = (first..self.opposite.len() as u32)
            .map(|h| {
                let o = self.opposite[h as usize];
                match (o, beyond(h)) {
                    (NONE, (1, third)) => third,
                    (NONE, _) => NONE,
                    (o, (0, _)) if !self.in_region(o) => self.apex(o),
                    _ => NONE,
                }
            })
            .collect();
    }

    /// The third vertex across half-edge `h` of the outside ring; see [`HalfEdges::flap_outside`].
    #[inline]
    pub fn flap_beyond(&self, h: u32) -> u32 {
        self.flap_outside[h as usize - 3 * self.region_triangles]
    }

    /// Checks the invariants; for tests.
    ///
    /// # Errors
    /// What is violated.
    pub fn validate(&self) -> Result<(), String> {
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
        for (v, &h) in self.outgoing.iter().enumerate() {
            if self.origin(h) as usize != v {
                return Err(format!("outgoing half-edge of {v}"));
            }
        }
        Ok(())
    }
}

/// Half-edges as `larger vertex << 32 | half-edge`, grouped by the smaller vertex; the end of each group.
fn buckets(vertices: usize, triangles: &[[u32; 3]]) -> (Vec<u32>, Vec<u64>) {
    let mut cursor = vec![0u32; vertices];
    for &[a, b, c] in triangles {
        cursor[a.min(b) as usize] += 1;
        cursor[b.min(c) as usize] += 1;
        cursor[c.min(a) as usize] += 1;
    }
    let mut sum = 0;
    for c in &mut cursor {
        sum += std::mem::replace(c, sum);
    }
    let mut entries = vec![0u64; 3 * triangles.len()];
    for (t, tri) in triangles.iter().enumerate() {
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
    #[cold]
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
        } else {
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

/// See [`HalfEdges::around`].
#[derive(Debug, Clone)]
pub struct Around<'a> {
    half_edges: &'a HalfEdges,
    first: u32,
    at: u32,
}

impl Iterator for Around<'_> {
    type Item = u32;

    #[inline]
    fn next(&mut self) -> Option<u32> {
        let h = self.at;
        if h == NONE {
            return None;
        }
        let following = self.half_edges.opposite[previous(h) as usize];
        self.at = if following == self.first { NONE } else { following };
        Some(h)
    }
}
