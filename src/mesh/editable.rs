//! A half-edge mesh whose connectivity changes: half-edge collapses and, in reverse order, the vertex splits that undo
//! them (H. Hoppe, "Progressive meshes", SIGGRAPH 1996).

use super::halfedge::NONE;
use super::halfedge::{next, previous};
use super::region::RegionMesh;

/// The triangles of a region and of its outside ring. Half-edge `3t + k` runs from corner `k` of triangle `t` to corner
/// `k + 1`, as in [`super::HalfEdges`]. A collapse takes two triangles away, whose entries stay as they were: that is all a
/// split needs to know.
#[derive(Debug, Clone)]
pub(crate) struct EditableMesh {
    triangles: Vec<[u32; 3]>,
    alive: Vec<bool>,
    opposite: Vec<u32>,
    /// Per free and boundary vertex a half-edge that leaves it: the first of an open fan.
    first: Vec<u32>,
    /// How many triangles of the region each of them has.
    count: Vec<u32>,
    /// Whether they are a closed ring: no change of the connectivity changes that.
    closed: Vec<bool>,
    free: usize,
    region_triangles: usize,
}

/// Fewest triangles around a vertex with a closed ring after a collapse.
/// Of 11 cases, half: none changes; double: 11 change by up to 2 edges, -27 % iterations, 1 fails.
const FEWEST_CLOSED: usize = 3;
/// Fewest triangles of the region at a vertex on its boundary after a collapse: one fan of them fits a curvature (paper 6.1).
/// Of 11 cases, half: none changes; double: 10 change by up to 2 edges, -4 % iterations.
const FEWEST_OPEN: usize = 2;
/// Most triangles around the vertex that stays.
/// Of 11 cases, half: 11 change by up to 0.07 edges, +16 % iterations; double: 0 change.
const MOST: usize = 14;

impl EditableMesh {
    /// The region with all its triangles: those of the region in the order of their vertices, to be near them in memory.
    pub(crate) fn new(region: &RegionMesh) -> Self {
        let half_edges = &region.half_edges;
        let (order, number) = in_order_of_vertices(region);
        let renumbered = |h: u32| match h {
            NONE => NONE,
            h => 3 * number[h as usize / 3] + h % 3,
        };
        let (opposite, _) = half_edges.opposite.as_chunks::<3>();
        let fans = (0..region.region_vertices()).map(|v| half_edges.outgoing.row(v));
        let is_inside = |h: &&u32| half_edges.in_region(**h);
        let count = fans
            .clone()
            .map(|fan| fan.iter().filter(is_inside).count() as u32);
        let is_closed =
            |fan: &[u32]| half_edges.opposite[fan[0] as usize] != NONE && fan.iter().all(|h| is_inside(&h));
        Self {
            triangles: order.iter().map(|&t| half_edges.triangles[t as usize]).collect(),
            alive: vec![true; order.len()],
            opposite: order
                .iter()
                .flat_map(|&t| opposite[t as usize].map(renumbered))
                .collect(),
            first: fans.clone().map(|fan| renumbered(fan[0])).collect(),
            count: count.collect(),
            closed: fans.map(is_closed).collect(),
            free: region.free,
            region_triangles: half_edges.region_triangles,
        }
    }

    /// The vertex that `h` starts from.
    #[inline]
    pub(crate) fn origin(&self, h: u32) -> u32 {
        self.triangles.as_flattened()[h as usize]
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

    /// Whether a vertex is free.
    #[inline]
    pub(crate) fn is_free(&self, v: u32) -> bool {
        (v as usize) < self.free
    }

    /// The triangles of the region, those that are not there any more as they were.
    pub(crate) fn region_triangles(&self) -> &[[u32; 3]] {
        &self.triangles[..self.region_triangles]
    }

    /// Whether a triangle is there.
    #[inline]
    pub(crate) fn is_there(&self, triangle: u32) -> bool {
        self.alive[triangle as usize]
    }

    /// The triangles that are there, by number.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = (usize, [u32; 3])> {
        let pairs = self.triangles.iter().zip(&self.alive).enumerate();
        pairs
            .filter(|(_, (_, alive))| **alive)
            .map(|(t, (corners, _))| (t, *corners))
    }

    /// The outgoing half-edges of a free or boundary vertex that is there, counter-clockwise, one per triangle.
    pub(crate) fn outgoing(&self, v: u32) -> impl Iterator<Item = u32> {
        let first = self.first[v as usize];
        let following = move |&h: &u32| {
            let o = self.opposite[previous(h) as usize];
            (o != NONE && o != first).then_some(o)
        };
        std::iter::successors(Some(first), following)
    }

    /// Those of them that lie in triangles of the region.
    pub(crate) fn outgoing_in_region(&self, v: u32) -> impl Iterator<Item = u32> {
        self.outgoing(v).filter(|&h| self.in_region(h))
    }

    fn are_neighbours(&self, u: u32, w: u32) -> bool {
        self.outgoing(u).any(|h| self.target(h) == w || self.apex(h) == w)
    }

    /// Whether the origin of `h` may be moved into its target: it is free, the mesh stays a 2-manifold, every triangle of
    /// the region keeps a free vertex, and no vertex gets too few or too many triangles.
    pub(crate) fn can_collapse(&self, h: u32) -> bool {
        let u = self.origin(h);
        self.can_collapse_from(h, |w| self.outgoing(u).any(|h| self.target(h) == w))
    }

    /// The same where it is known which vertices are around the origin of `h`.
    pub(crate) fn can_collapse_from(&self, h: u32, is_around: impl Fn(u32) -> bool) -> bool {
        let (u, v) = (self.origin(h), self.target(h));
        self.is_free(u)
            && self.keeps_valences(h)
            && self.stays_manifold(h, is_around)
            && (self.is_free(v) || self.keeps_free_corners(u, v))
    }

    /// Whether the mesh stays a 2-manifold when the free origin of `h` moves into its target.
    fn stays_manifold(&self, h: u32, is_around: impl Fn(u32) -> bool) -> bool {
        let (u, v) = (self.origin(h), self.target(h));
        let (l, r) = (self.apex(h), self.apex(self.opposite[h as usize]));
        // The vertices beside both ends are those of the two triangles (the link condition; u is never on the boundary).
        let beside_both = |w: u32| w != u && w != l && w != r && is_around(w);
        let is_last = |g: u32| self.opposite[previous(g) as usize] == NONE;
        let mut outgoing = self.outgoing(v);
        let is_against = |g: u32| beside_both(self.target(g)) || is_last(g) && beside_both(self.apex(g));
        if l == r || outgoing.any(is_against) {
            return false;
        }
        // A tetrahedron would become two triangles back to back.
        let is_back_to_back = |g: u32| {
            let o = self.opposite[g as usize];
            self.origin(g) == l && self.target(g) == r && o != NONE && self.apex(o) == v
        };
        self.count[u as usize] != 3 || !self.outgoing(u).map(next).any(is_back_to_back)
    }

    /// Whether no vertex around `h` gets too few or too many triangles of the region.
    fn keeps_valences(&self, h: u32) -> bool {
        let (l, r) = (self.apex(h), self.apex(self.opposite[h as usize]));
        let (u, v) = (self.origin(h), self.target(h));
        let count = |w: u32| self.count[w as usize] as usize;
        let enough = |w: u32, after: usize| (self.fewest(w)..=MOST).contains(&after);
        enough(v, count(v) + count(u) - 4) && enough(l, count(l) - 1) && enough(r, count(r) - 1)
    }

    /// The fewest triangles of the region that a vertex may have.
    fn fewest(&self, v: u32) -> usize {
        if self.closed[v as usize] {
            FEWEST_CLOSED
        } else {
            FEWEST_OPEN
        }
    }

    /// Whether every triangle of `u` that is left keeps a free vertex when `u` moves into the fixed vertex `v`.
    fn keeps_free_corners(&self, u: u32, v: u32) -> bool {
        self.outgoing(u).all(|g| {
            let (a, b) = (self.target(g), self.apex(g));
            a == v || b == v || self.is_free(a) || self.is_free(b)
        })
    }

    /// Moves the origin of `h` into its target. [`Self::can_collapse`] must hold.
    pub(crate) fn collapse(&mut self, h: u32) {
        let v = self.target(h);
        let Around { o, a, b, c, d } = self.around(h);
        self.rename(b, c, v);
        self.link(a, b);
        self.link(c, d);
        self.alive[h as usize / 3] = false;
        self.alive[o as usize / 3] = false;
        let (l, r) = (self.apex(h), self.apex(o));
        self.count[v as usize] = self.count[v as usize] + self.count[self.origin(h) as usize] - 4;
        self.count[l as usize] -= 1;
        self.count[r as usize] -= 1;
        self.set_first(v, b);
        self.set_first(l, next(b));
        self.set_first(r, c);
    }

    /// Undoes the last collapse, which was that of `h`; further ones in reverse order.
    pub(crate) fn split(&mut self, h: u32) {
        let Around { o, a, b, c, d } = self.around(h);
        let u = self.origin(h);
        self.rename(b, c, u);
        self.link(a, next(h));
        self.link(b, previous(h));
        self.link(c, next(o));
        self.link(d, previous(o));
        self.alive[h as usize / 3] = true;
        self.alive[o as usize / 3] = true;
        let (v, l, r) = (self.target(h), self.apex(h), self.apex(o));
        self.count[v as usize] = self.count[v as usize] + 4 - self.count[u as usize];
        self.count[l as usize] += 1;
        self.count[r as usize] += 1;
        self.set_first(u, h);
        self.set_first(v, next(h));
        self.set_first(l, previous(h));
        self.set_first(r, previous(o));
    }

    /// The half-edge on the other side of `h`; [`NONE`] on the boundary of the mesh.
    #[inline]
    pub(crate) fn opposite(&self, h: u32) -> u32 {
        self.opposite[h as usize]
    }

    /// Whether `h` is there and its edge may be turned to run between the apices beside it: both triangles are of the region, the mesh
    /// stays a 2-manifold, no new edge joins fixed vertices, and no vertex gets too few or too many triangles.
    pub(crate) fn can_flip(&self, h: u32) -> bool {
        let o = self.opposite[h as usize];
        if o == NONE || !self.alive[h as usize / 3] || !self.in_region(h) || !self.in_region(o) {
            return false;
        }
        let (a, b, c, d) = (self.origin(h), self.target(h), self.apex(h), self.apex(o));
        let count = |v: u32| self.count[v as usize] as usize;
        (self.is_free(c) || self.is_free(d))
            && c != d
            && count(a) > self.fewest(a)
            && count(b) > self.fewest(b)
            && count(c) < MOST
            && count(d) < MOST
            && !self.are_neighbours(c, d)
    }

    /// Turns the edge of `h`, which runs from its first apex's side to the other's afterwards: `h` from its origin to the apex across.
    /// [`Self::can_flip`] must hold, and no collapse before can be undone.
    pub(crate) fn flip(&mut self, h: u32) {
        let o = self.opposite[h as usize];
        let (a, b, c, d) = (self.origin(h), self.target(h), self.apex(h), self.apex(o));
        let (beyond_h, beyond_o) = (self.opposite[next(h) as usize], self.opposite[next(o) as usize]);
        for (g, v) in [(next(h), d), (next(o), c)] {
            self.triangles[g as usize / 3][g as usize % 3] = v;
        }
        self.opposite[h as usize] = beyond_o;
        self.opposite[o as usize] = beyond_h;
        self.link(beyond_o, h);
        self.link(beyond_h, o);
        self.link(next(h), next(o));
        for (v, after) in [(a, -1), (b, -1), (c, 1), (d, 1)] {
            let count = &mut self.count[v as usize];
            *count = count.wrapping_add_signed(after);
        }
        self.set_first(a, h);
        self.set_first(b, o);
    }

    fn around(&self, h: u32) -> Around {
        let o = self.opposite[h as usize];
        let across = |g: u32| self.opposite[g as usize];
        Around {
            o,
            a: across(next(h)),
            b: across(previous(h)),
            c: across(next(o)),
            d: across(previous(o)),
        }
    }

    /// Gives the triangles between `b`, whose origin they share, and `c` on the far side another vertex there.
    fn rename(&mut self, b: u32, c: u32, vertex: u32) {
        let mut g = b;
        loop {
            self.triangles[g as usize / 3][g as usize % 3] = vertex;
            if previous(g) == c {
                break;
            }
            g = self.opposite[previous(g) as usize];
        }
    }

    fn link(&mut self, a: u32, b: u32) {
        for (from, to) in [(a, b), (b, a)] {
            if from != NONE {
                self.opposite[from as usize] = to;
            }
        }
    }

    /// Lets the fan of `v` begin at `h`, or where an open fan that `h` belongs to begins.
    fn set_first(&mut self, v: u32, h: u32) {
        let mut g = h;
        while !self.closed[v as usize] && self.opposite[g as usize] != NONE {
            g = next(self.opposite[g as usize]);
            if g == h {
                break;
            }
        }
        self.first[v as usize] = g;
    }

    #[cfg(test)]
    /// Checks the invariants; for tests.
    ///
    /// # Errors
    /// What is violated.
    pub(crate) fn validate(&self) -> Result<(), String> {
        let mut valence = vec![0usize; self.first.len()];
        for (t, corners) in self.triangles() {
            for k in 0..3 {
                let h = (3 * t + k) as u32;
                let (u, o) = (corners[k], self.opposite[h as usize]);
                if let Some(count) = valence.get_mut(u as usize) {
                    *count += 1;
                }
                if u == corners[(k + 1) % 3] {
                    return Err(format!("triangle {t} names {u} twice"));
                }
                if o == NONE {
                    continue;
                }
                if !self.alive[o as usize / 3] || self.opposite[o as usize] != h {
                    return Err(format!("opposite of {h}"));
                }
                if self.origin(h) != self.target(o)
                    || self.target(h) != self.origin(o)
                    || self.apex(h) == self.apex(o)
                {
                    return Err(format!("sides of {h}"));
                }
            }
            let is_fixed = corners.iter().all(|&v| !self.is_free(v));
            if is_fixed == (t < self.region_triangles) {
                return Err(format!("triangle {t} is on the wrong side"));
            }
        }
        for (v, &count) in valence.iter().enumerate().filter(|(_, count)| **count > 0) {
            let fan: Vec<u32> = self.outgoing(v as u32).take(count + 1).collect();
            if fan.len() != count || fan.iter().any(|&h| self.origin(h) as usize != v) {
                return Err(format!("fan of {v}"));
            }
            let inside = fan.iter().filter(|&&h| self.in_region(h)).count();
            let is_closed = self.opposite[fan[0] as usize] != NONE && inside == count;
            if (inside, is_closed) != (self.count[v] as usize, self.closed[v]) {
                return Err(format!("triangles of {v} in the region"));
            }
            let mut targets: Vec<u32> = fan.iter().map(|&h| self.target(h)).collect();
            targets.sort_unstable();
            if targets.windows(2).any(|w| w[0] == w[1]) {
                return Err(format!("two edges from {v} to one vertex"));
            }
            if self.is_free(v as u32) && self.opposite[fan[0] as usize] == NONE {
                return Err(format!("free vertex {v} on the boundary"));
            }
        }
        Ok(())
    }
}

/// The triangles of a region by the vertices that they are at, those of the outside as they are, and the place of each.
fn in_order_of_vertices(region: &RegionMesh) -> (Vec<u32>, Vec<u32>) {
    let half_edges = &region.half_edges;
    let mut order = Vec::with_capacity(half_edges.triangles.len());
    let mut number = vec![NONE; half_edges.triangles.len()];
    let at_vertices = (0..region.region_vertices()).flat_map(|v| half_edges.outgoing.row(v));
    let inside = at_vertices.copied().filter(|&h| half_edges.in_region(h));
    let all = inside
        .map(|h| h / 3)
        .chain(half_edges.region_triangles as u32..number.len() as u32);
    for t in all {
        if number[t as usize] == NONE {
            number[t as usize] = order.len() as u32;
            order.push(t);
        }
    }
    (order, number)
}

/// Half-edges around `h = (u, v)` with the triangles `(u, v, l)` and, of its opposite `o`, `(v, u, r)`: across `(v, l)`,
/// across `(l, u)`, across `(u, r)`, across `(r, v)`.
struct Around {
    o: u32,
    a: u32,
    b: u32,
    c: u32,
    d: u32,
}
