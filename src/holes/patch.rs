//! A triangulated disc (or any orientable surface with boundary) that can be changed: splits, flips, collapses.
//!
//! Half-edge `3 t + k` runs from corner `k` of triangle `t` to corner `k + 1`. Vertices below `fixed` stay, and so do the
//! edges without a triangle on the other side.

use nalgebra::Vector3;

use crate::mesh::NONE;
use crate::mesh::half_edge_edits;
use crate::mesh::halfedge::{next, previous};
use crate::mesh::rows::Rows;

/// A triangle of less area, against the square of an edge, has none: rounding makes 1e-16. Of 280 vertices outside of their triangles, in its
/// plane, as many are refined at a thousandth; half or double the same. Where edges beside them
/// were split without end, areas were below 1e-14.
pub(super) const NO_AREA: f64 = 1e-9;

/// The length wanted grows at most by this much per unit of length away from a short boundary edge.
/// Of 44 cases, half: 39 change, 37 get another triangulation, -6 % iterations;
/// double: 28 change, 26 get another triangulation, -1 % iterations.
pub(super) const GRADE: f64 = 0.5;

/// The surface and, per vertex, where it is and what belongs to it.
#[derive(Debug, Clone, Default)]
pub(super) struct Patch {
    /// Positions.
    pub(super) x: Vec<Vector3<f64>>,
    /// Where the vertex lies on the surface that the patch was made from.
    pub(super) source: Vec<Vector3<f64>>,
    /// A triangle of that surface near there.
    pub(super) hint: Vec<u32>,
    /// The mesh's number of a vertex that was there, [`NONE`] of a new one; only where it matters.
    pub(super) old: Vec<u32>,
    /// The edge length of the surroundings, interpolated.
    pub(super) size: Vec<f64>,
    /// An upper bound of the edge length beside short edges of the boundary.
    pub(super) limit: Vec<f64>,
    /// Per vertex what its own surface asks for: limits are at most this.
    pub(super) own: Vec<f64>,
    /// Per boundary vertex the least length of edges there, one that is rather long, and the largest.
    pub(super) range: Vec<[f64; 3]>,
    /// Distance to the boundary along edges.
    pub(super) depth: Vec<f64>,
    /// Corners; [`NONE`] where a triangle was removed.
    pub(super) triangles: Vec<[u32; 3]>,
    /// The half-edge across, or [`NONE`].
    opposite: Vec<u32>,
    /// A half-edge that starts at the vertex, [`NONE`] at removed vertices.
    out: Vec<u32>,
    /// Inner vertices without a triangle, those removed among them.
    gone: usize,
    /// Vertices below this number are the boundary.
    pub(super) fixed: usize,
}

impl Patch {
    /// The patch of these triangles; all vertices below `fixed` are the boundary. Sizes are left at zero.
    pub(super) fn new(x: Vec<Vector3<f64>>, triangles: Vec<[u32; 3]>, fixed: usize) -> Self {
        let mut patch = Self {
            source: x.clone(),
            hint: vec![0; x.len()],
            old: vec![NONE; x.len()],
            size: vec![0.0; x.len()],
            limit: vec![f64::INFINITY; x.len()],
            own: vec![f64::INFINITY; x.len()],
            range: vec![[0.0, f64::INFINITY, f64::INFINITY]; fixed],
            depth: vec![0.0; x.len()],
            opposite: vec![NONE; 3 * triangles.len()],
            out: vec![NONE; x.len()],
            gone: 0,
            x,
            triangles,
            fixed,
        };
        patch.pair();
        for h in 0..patch.opposite.len() as u32 {
            let v = patch.origin(h) as usize;
            patch.out[v] = h;
            patch.hint[v] = h / 3;
        }
        let inner = patch.out.iter().skip(fixed);
        patch.gone = inner.filter(|&&h| h == NONE).count();
        patch
    }

    /// Pairs half-edges: per vertex the edges to larger numbers, in both directions, sorted.
    fn pair(&mut self) {
        let by_smaller = (0..self.opposite.len() as u32).map(|h| {
            let (a, b) = (self.origin(h), self.target(h));
            (a.min(b), [a.max(b), h])
        });
        let mut edges = Rows::collect(self.x.len(), by_smaller);
        for v in 0..edges.len() {
            let around = edges.row_mut(v);
            around.sort_unstable();
            for pair in around.windows(2).filter(|pair| pair[0][0] == pair[1][0]) {
                self.link(pair[0][1], pair[1][1]);
            }
        }
    }

    #[inline]
    pub(super) fn origin(&self, h: u32) -> u32 {
        self.triangles[h as usize / 3][h as usize % 3]
    }

    #[inline]
    pub(super) fn target(&self, h: u32) -> u32 {
        self.origin(next(h))
    }

    /// The corner of `h`'s triangle that is not on `h`.
    #[inline]
    pub(super) fn apex(&self, h: u32) -> u32 {
        self.origin(previous(h))
    }

    #[inline]
    pub(super) fn across(&self, h: u32) -> u32 {
        self.opposite[h as usize]
    }

    #[inline]
    pub(super) fn is_alive(&self, v: u32) -> bool {
        self.out[v as usize] != NONE
    }

    /// How many vertices inside have triangles.
    pub(super) fn inner_vertices(&self) -> usize {
        self.x.len() - self.fixed - self.gone
    }

    #[inline]
    pub(super) fn is_boundary(&self, v: u32) -> bool {
        (v as usize) < self.fixed
    }

    fn link(&mut self, g: u32, h: u32) {
        half_edge_edits::link(&mut self.opposite, g, h);
    }

    /// Closes a disc along pairs of its boundary edges, which their first vertices name. Each vertex becomes the one that `of`
    /// tells, at `x`. The disc is one that was just made; there may be two edges between two vertices afterwards.
    pub(super) fn glue(&mut self, sides: &[[u32; 2]], of: &[u32], x: &[Vector3<f64>]) {
        let mut edge = vec![NONE; self.x.len()];
        for h in (0..self.half_edges()).filter(|&h| self.across(h) == NONE) {
            edge[self.origin(h) as usize] = h;
        }
        for side in sides {
            let [g, h] = side.map(|v| edge[v as usize]);
            self.link(g, h);
        }
        let mut triangles = std::mem::take(&mut self.triangles);
        triangles.iter_mut().flatten().for_each(|v| *v = of[*v as usize]);
        let opposite = std::mem::take(&mut self.opposite);
        *self = Self::new(x.to_vec(), triangles, x.len());
        self.opposite = opposite;
    }

    /// How many half-edges there are, removed ones included.
    pub(super) fn half_edges(&self) -> u32 {
        self.opposite.len() as u32
    }

    /// Length of an edge.
    #[inline]
    pub(super) fn length(&self, h: u32) -> f64 {
        (self.x[self.target(h) as usize] - self.x[self.origin(h) as usize]).norm()
    }

    /// The half-edges that start at a vertex, counter-clockwise; at a boundary vertex from the boundary on.
    pub(super) fn outgoing(&self, v: u32, outgoing: &mut Vec<u32>) {
        outgoing.clear();
        let mut first = self.out[v as usize];
        if first == NONE {
            return;
        }
        let start = first;
        // Clockwise to the boundary, if there is one.
        while self.across(first) != NONE {
            first = next(self.across(first));
            if first == start {
                break;
            }
        }
        let mut h = first;
        loop {
            outgoing.push(h);
            h = self.across(previous(h));
            if h == NONE || h == first {
                return;
            }
        }
    }

    /// The neighbours of a vertex, counter-clockwise.
    pub(super) fn ring(&self, v: u32, outgoing: &mut Vec<u32>, ring: &mut Vec<u32>) {
        self.outgoing(v, outgoing);
        ring.clear();
        ring.extend(outgoing.iter().map(|&h| self.target(h)));
        if let Some(&last) = outgoing.last()
            && self.across(previous(last)) == NONE
        {
            ring.push(self.apex(last));
        }
    }

    /// Cross product of a triangle's sides.
    #[inline]
    pub(super) fn cross(&self, t: usize) -> Vector3<f64> {
        let [a, b, c] = self.triangles[t].map(|v| self.x[v as usize]);
        (b - a).cross(&(c - a))
    }

    fn set(&mut self, t: u32, corners: [u32; 3]) {
        self.triangles[t as usize] = corners;
        for (k, &v) in (0..).zip(&corners) {
            self.out[v as usize] = 3 * t + k;
        }
    }

    /// Splits an edge inside the patch in its middle; the new vertex.
    pub(super) fn split(&mut self, h: u32) -> u32 {
        let o = self.across(h);
        let (a, b) = (self.origin(h), self.target(h));
        let (c, d) = (self.apex(h), self.apex(o));
        let [bc, ca, ad, db] = [next(h), previous(h), next(o), previous(o)].map(|g| self.across(g));
        let m = self.middle(a, b);
        let (t0, t1, t2) = (h / 3, o / 3, self.triangles.len() as u32);
        let t3 = t2 + 1;
        self.triangles.extend([[NONE; 3]; 2]);
        self.opposite.extend([NONE; 6]);
        self.set(t0, [a, m, c]);
        self.set(t2, [m, b, c]);
        self.set(t1, [b, m, d]);
        self.set(t3, [m, a, d]);
        self.link(3 * t0, 3 * t3);
        self.link(3 * t0 + 1, 3 * t2 + 2);
        self.link(3 * t0 + 2, ca);
        self.link(3 * t2, 3 * t1);
        self.link(3 * t2 + 1, bc);
        self.link(3 * t1 + 1, 3 * t3 + 2);
        self.link(3 * t1 + 2, db);
        self.link(3 * t3 + 1, ad);
        m
    }

    fn middle(&mut self, a: u32, b: u32) -> u32 {
        let (i, j) = (a as usize, b as usize);
        let half = 0.5 * (self.x[j] - self.x[i]).norm();
        self.x.push((self.x[i] + self.x[j]) * 0.5);
        self.source.push((self.source[i] + self.source[j]) * 0.5);
        self.hint.push(self.hint[if i < self.fixed { j } else { i }]);
        self.size.push(0.5 * (self.size[i] + self.size[j]));
        self.depth.push(self.depth[i].min(self.depth[j]) + half);
        let limit = self.limit[i].min(self.limit[j]) + GRADE * half;
        self.limit.push(limit);
        self.own.push(0.5 * (self.own[i] + self.own[j]));
        self.old.push(NONE);
        self.out.push(NONE);
        self.x.len() as u32 - 1
    }

    /// Turns an edge inside the patch to the other two corners of its triangles.
    pub(super) fn flip(&mut self, h: u32) {
        let o = self.across(h);
        half_edge_edits::flip(&mut self.triangles, &mut self.opposite, h);
        for t in [h / 3, o / 3] {
            self.set(t, self.triangles[t as usize]);
        }
    }

    /// Whether two vertices have an edge in the patch; `outgoing` is scratch.
    pub(super) fn are_neighbours(&self, a: u32, b: u32, outgoing: &mut Vec<u32>) -> bool {
        self.outgoing(a, outgoing);
        outgoing.iter().any(|&h| self.target(h) == b || self.apex(h) == b)
    }

    /// Moves the inner vertex that `h` starts at onto its other end, if the patch stays a manifold with valences of at
    /// least 3 and no triangle turns over. `outgoing` and `ring` are scratch.
    pub(super) fn collapse(&mut self, h: u32, outgoing: &mut Vec<u32>, ring: &mut Vec<u32>) -> bool {
        let (a, b, o) = (self.origin(h), self.target(h), self.across(h));
        if self.is_boundary(a) || o == NONE || !self.stays_manifold(h, outgoing, ring) {
            return false;
        }
        let target = self.x[b as usize];
        if !outgoing.iter().all(|&g| self.stays_sound(g, b, &target)) {
            return false;
        }
        let across = half_edge_edits::collapse(&mut self.triangles, &mut self.opposite, h, outgoing);
        self.out[a as usize] = NONE;
        self.gone += 1;
        // Every triangle kept around b and the two apexes can tell a half-edge.
        for g in across.into_iter().filter(|&g| g != NONE) {
            let (from, to) = (self.origin(g), self.target(g));
            self.out[from as usize] = g;
            self.out[to as usize] = next(g);
        }
        true
    }

    /// Whether the patch stays a manifold with valences of at least 3 if the origin of `h` moves to its target. Leaves the
    /// half-edges of the origin in `outgoing`.
    fn stays_manifold(&self, h: u32, outgoing: &mut Vec<u32>, ring: &mut Vec<u32>) -> bool {
        let (a, b, o) = (self.origin(h), self.target(h), self.across(h));
        self.ring(b, outgoing, ring);
        self.outgoing(a, outgoing);
        let common = outgoing
            .iter()
            .filter(|&&g| ring.contains(&self.target(g)))
            .count();
        if common != 2 || outgoing.len() < 4 {
            return false;
        }
        [self.apex(h), self.apex(o)].into_iter().all(|v| {
            self.outgoing(v, ring);
            ring.len() >= if self.is_boundary(v) { 2 } else { 4 }
        })
    }

    /// Whether the triangle of `g` neither turns over nor becomes a needle when the origin of `g` moves to `target`, where
    /// vertex `b` is.
    fn stays_sound(&self, g: u32, b: u32, target: &Vector3<f64>) -> bool {
        let (p, q) = (self.target(g), self.apex(g));
        if p == b || q == b {
            return true;
        }
        let old = self.cross(g as usize / 3);
        let (p, q) = (self.x[p as usize] - target, self.x[q as usize] - target);
        let new = p.cross(&q);
        // More than 60 degrees is as good as over.
        let longest = p.norm_squared().max(q.norm_squared()).max((p - q).norm_squared());
        let turns_over = old.dot(&new) < 0.5 * old.norm() * new.norm();
        let is_needle = new.norm() < 0.2 * longest;
        !turns_over && !is_needle
    }

    /// Drops removed vertices and triangles; the boundary keeps its numbers.
    pub(super) fn compact(&mut self) {
        if self.out.iter().all(|&h| h != NONE) && self.triangles.iter().all(|t| t[0] != NONE) {
            return;
        }
        let keep: Vec<bool> = (0..self.x.len())
            .map(|v| v < self.fixed || self.out[v] != NONE)
            .collect();
        let mut number = vec![NONE; keep.len()];
        for (new, v) in (0..).zip((0..keep.len()).filter(|&v| keep[v])) {
            number[v] = new;
        }
        fn filter<T: Copy>(values: &mut Vec<T>, keep: &[bool]) {
            let mut at = keep.iter();
            values.retain(|_| *at.next().unwrap_or(&false));
        }
        filter(&mut self.x, &keep);
        filter(&mut self.source, &keep);
        filter(&mut self.hint, &keep);
        filter(&mut self.old, &keep);
        filter(&mut self.size, &keep);
        filter(&mut self.limit, &keep);
        filter(&mut self.own, &keep);
        filter(&mut self.depth, &keep);
        self.triangles.retain(|t| t[0] != NONE);
        self.triangles
            .iter_mut()
            .flatten()
            .for_each(|v| *v = number[*v as usize]);
        let fresh = Self::new(
            std::mem::take(&mut self.x),
            std::mem::take(&mut self.triangles),
            self.fixed,
        );
        self.x = fresh.x;
        self.triangles = fresh.triangles;
        self.opposite = fresh.opposite;
        self.out = fresh.out;
        self.gone = fresh.gone;
    }
}

#[cfg(test)]
impl Patch {
    /// Checks the invariants; for tests.
    pub(super) fn validate(&self) -> Result<(), String> {
        let mut edges = Vec::new();
        for h in 0..self.half_edges() {
            if self.triangles[h as usize / 3][0] == NONE {
                continue;
            }
            let o = self.across(h);
            let (a, b) = (self.origin(h), self.target(h));
            edges.push((a, b));
            if o != NONE && (self.across(o) != h || self.origin(o) != b || self.target(o) != a) {
                return Err(format!("half-edge {h} ({a}, {b}) does not match {o}"));
            }
            if o == NONE && !(self.is_boundary(a) && self.is_boundary(b)) {
                return Err(format!("edge ({a}, {b}) is open"));
            }
        }
        edges.sort_unstable();
        if let Some(w) = edges.windows(2).find(|w| w[0] == w[1]) {
            return Err(format!("edge {:?} twice", w[0]));
        }
        let inner = (self.fixed as u32..self.x.len() as u32).filter(|&v| self.is_alive(v));
        if inner.count() != self.inner_vertices() {
            return Err(format!("{} vertices are not inside", self.inner_vertices()));
        }
        for v in 0..self.x.len() {
            let h = self.out[v];
            if h != NONE && (self.triangles[h as usize / 3][0] == NONE || self.origin(h) != v as u32) {
                return Err(format!("vertex {v} has a wrong half-edge"));
            }
        }
        Ok(())
    }
}
