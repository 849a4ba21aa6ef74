//! Refinement of a patch to the edge lengths of its surroundings.
//!
//! Longest edges (against the length wanted there) are split in their middles first, and after every split edges are
//! flipped towards Delaunay, so that vertices never crowd. Then rounds of splits, collapses, flips and tangential steps even
//! the vertices out (M. Botsch, L. Kobbelt, "A remeshing approach to multiresolution modeling", SGP 2004). Boundary vertices and boundary edges stay.

use std::collections::BinaryHeap;

use fairmesh_linear::interrupt::{checkpoint, is_stopped};
use nalgebra::Vector3;

use super::lenses::{Lenses, is_wide};
use super::patch::{GRADE, NO_AREA, Patch};
use super::relax::{Sweeps, settle_sizes, turns_over};
use crate::mesh::NONE;
use crate::mesh::disjoint_sets::DisjointSets;
use crate::mesh::halfedge::{next, previous};
use crate::quality::smallest_angle;

/// Edges longer than this many wanted lengths are split. With [`SHORT`] it makes the mean length the one wanted.
/// Of 44 cases, half: 42 change, 33 get another triangulation, +17 % iterations, 1 fails, 1 more succeeds;
/// double: 41 change, 38 get another triangulation, -6 % iterations, 1 fails.
const LONG: f64 = 1.4;
/// Edges shorter than this many are collapsed.
/// Of 44 cases, half: 41 change, 39 get another triangulation, +10 % iterations;
/// double: 38 change, 36 get another triangulation, -4 % iterations, 1 fails.
const SHORT: f64 = 0.5 * LONG;
/// At first only these are: fewer vertices to take away later.
/// Of 44 cases, half: 42 change, 37 get another triangulation, 1 fails;
/// double: 41 change, 36 get another triangulation, +2 % iterations, 1 fails.
const FIRST: f64 = 1.6;
/// Rounds of splits, collapses, flips and steps.
/// Of 44 cases, half: 40 change, 38 get another triangulation, +4 % iterations, 1 fails;
/// double: 38 change, 36 get another triangulation, -2 % iterations, 1 fails.
const ROUNDS: usize = 4;
/// Sweeps at the end in which the places on the source surface follow.
/// Half or double, of 44 cases: none changes.
const SOURCE_SWEEPS: usize = 3;
/// Rounds and mending leave at most so many times the inner vertices of the first splits, and one per boundary vertex.
/// Half or double, of 44 cases: none changes.
const MORE: usize = 3;
/// An edge across the hole is left where its halves would be in triangles with a smaller angle, in degrees.
/// Of 3 cases, half: 1 changes, 1 get another triangulation, -26 % iterations;
/// double: 2 change, 2 get another triangulation, +48 % iterations.
const THIN: f64 = 10.0;
/// The fraction of the progress at which the first splits are made, and that of each round after them: shares of the time, measured on regions
/// of 10,000 to 100,000 vertices at densities from 1 to 4.
/// Half or double, of 3 cases: only the progress changes.
const SPLIT: f64 = 0.13;
const ROUND: f64 = 0.16;
/// The fraction at which bad angles are mended.
/// Half or double, of 3 cases: only the progress changes.
const MENDED: f64 = 0.92;
/// After so many splits it is told how far they are: a few milliseconds.
/// Half or double: only the progress changes.
const TELLING: usize = 2_000;

/// How fine a patch shall be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fineness {
    /// Wanted edge length over that of the surroundings.
    pub(super) factor: f64,
    /// How much the wanted length grows per unit of distance from the boundary.
    pub(super) growth: f64,
    /// No more inner vertices than this.
    pub(super) most: usize,
}

/// Edges between boundary vertices that may not be made: pairs (smaller, larger), sorted.
pub(super) type Taken<'a> = &'a [(u32, u32)];

/// A patch being refined.
pub(super) struct Refiner<'a> {
    pub(super) patch: &'a mut Patch,
    pub(super) fineness: Fineness,
    pub(super) taken: Taken<'a>,
    pub(super) outgoing: Vec<u32>,
    pub(super) ring: Vec<u32>,
    pub(super) lenses: Lenses,
    sweeps: Sweeps,
    tell: Option<&'a mut dyn FnMut(f64)>,
}

impl<'a> Refiner<'a> {
    pub(super) fn new(patch: &'a mut Patch, fineness: Fineness, taken: Taken<'a>) -> Self {
        Self {
            lenses: Lenses::new(patch),
            patch,
            fineness,
            taken,
            outgoing: Vec::new(),
            ring: Vec::new(),
            sweeps: Sweeps::default(),
            tell: None,
        }
    }

    /// Tells how far it is, from 0 to 1.
    pub(super) fn telling(mut self, tell: &'a mut dyn FnMut(f64)) -> Self {
        self.tell = Some(tell);
        self
    }

    fn tell(&mut self, fraction: f64) {
        if let Some(tell) = &mut self.tell {
            tell(fraction);
        }
    }

    /// About how many vertices there will be inside.
    fn expected(&self) -> f64 {
        let share = |t: usize| {
            let wanted = self.patch.triangles[t]
                .map(|v| self.wanted(v))
                .iter()
                .sum::<f64>()
                / 3.0;
            self.patch.cross(t).norm() / (3.0_f64.sqrt() * wanted * wanted)
        };
        let all = 0..self.patch.triangles.len();
        let sum: f64 = all
            .filter(|&t| self.patch.triangles[t][0] != NONE)
            .map(share)
            .sum();
        sum.min(self.fineness.most as f64)
    }

    /// Splits, evens out, and drops what was removed. False if the vertices did not suffice, or the run was stopped; the patch is not
    /// finished then.
    pub(super) fn run(&mut self) -> bool {
        self.flip_all();
        if !self.split_long(FIRST) {
            return false;
        }
        self.even_out()
    }

    /// The same, but finished with the vertices there are.
    pub(super) fn run_to_end(&mut self) -> bool {
        self.flip_all();
        let enough = self.split_long(FIRST);
        self.even_out() && enough
    }

    fn even_out(&mut self) -> bool {
        let mut enough = true;
        // Evening out moves vertices; where it would make ever more, the lengths wanted cannot be had.
        let most = self.fineness.most;
        self.fineness.most = most.min(MORE * self.patch.inner_vertices() + self.patch.fixed);
        for round in 0..ROUNDS {
            if is_stopped() {
                break;
            }
            self.tell(SPLIT + ROUND * round as f64);
            self.collapse_short();
            self.clear_boundary();
            self.flip_all();
            settle_sizes(self.patch, 1);
            self.sweeps.relax(self.patch, &self.lenses);
            self.flip_all();
            let is_bounded = self.fineness.most < most;
            enough &= self.split_long(LONG) || is_bounded;
        }
        if !is_stopped() {
            self.tell(SPLIT + ROUND * ROUNDS as f64);
            self.sweeps.relax(self.patch, &self.lenses);
            self.clear_boundary();
            self.flip_all();
            self.mend();
            self.fineness.most = most;
            self.split_chords();
            self.tell(MENDED);
        }
        self.fineness.most = most;
        self.finish();
        enough
    }

    /// Only [`mend`](Self::mend), on a patch that was refined before.
    pub(super) fn run_again(&mut self) {
        self.mend();
        self.finish();
    }

    fn finish(&mut self) {
        checkpoint();
        for _ in (0..SOURCE_SWEEPS).take_while(|_| !is_stopped()) {
            self.sweeps.settle_sources(self.patch);
        }
        self.patch.compact();
    }

    /// The wanted edge length at a vertex. Where it is far shorter than the boundary's edges, which stay as they are, it gets so by
    /// [`GRADE`]: vertices would gather along them.
    fn wanted(&self, v: u32) -> f64 {
        let (v, f) = (v as usize, &self.fineness);
        let (size, depth) = (self.patch.size[v], self.patch.depth[v]);
        let inside = (f.factor * size + f.growth * depth).max(SHORT * size - GRADE * depth);
        inside.min(self.patch.limit[v])
    }

    /// Length over the wanted one.
    fn ratio(&self, h: u32) -> f64 {
        let (a, b) = (self.patch.origin(h), self.patch.target(h));
        let mut wanted = 0.5 * (self.wanted(a) + self.wanted(b));
        if self.patch.is_boundary(a) && self.patch.is_boundary(b) {
            // An edge across the hole holds the surface in its middle: rather none.
            wanted *= 0.8;
        }
        let ratio = self.patch.length(h) / wanted;
        if ratio.is_finite() { ratio } else { 0.0 }
    }

    pub(super) fn is_inner(&self, h: u32) -> bool {
        self.patch.triangles[h as usize / 3][0] != NONE && self.patch.across(h) != NONE
    }

    fn split_long(&mut self, long: f64) -> bool {
        let mut queue: BinaryHeap<(u64, u32, u32, u32)> = BinaryHeap::new();
        let push = |this: &Self, queue: &mut BinaryHeap<_>, h: u32| {
            if this.is_inner(h) {
                let ratio = this.ratio(h);
                if ratio > long {
                    queue.push((ratio.to_bits(), h, this.patch.origin(h), this.patch.target(h)));
                }
            }
        };
        for h in 0..self.patch.half_edges() {
            checkpoint();
            if self.is_inner(h) && self.patch.origin(h) < self.patch.target(h) {
                push(self, &mut queue, h);
            }
        }
        let mut inner = self.patch.inner_vertices();
        let missing = if self.tell.is_some() && long == FIRST {
            self.expected() - inner as f64
        } else {
            f64::INFINITY
        };
        let first = inner;
        while let Some((_, h, a, b)) = queue.pop() {
            if !self.is_inner(h) || self.patch.origin(h) != a || self.patch.target(h) != b {
                continue;
            }
            if self.would_encroach(h) || self.is_beside_line(h) {
                continue;
            }
            if inner >= self.fineness.most || is_stopped() {
                return false;
            }
            inner += 1;
            if missing < f64::INFINITY && (inner - first).is_multiple_of(TELLING) {
                self.tell(SPLIT * ((inner - first) as f64 / missing.max(1.0)).min(1.0));
            }
            for g in self.split_and_flip(h) {
                push(self, &mut queue, g);
            }
        }
        true
    }

    /// Whether a triangle beside an edge has no area: its third corner may be where the edge would be split, and so on without end.
    fn is_beside_line(&self, h: u32) -> bool {
        let none = NO_AREA * self.patch.length(h).powi(2);
        let beside = [h, self.patch.across(h)];
        beside
            .into_iter()
            .any(|g| self.patch.cross(g as usize / 3).norm() <= none)
    }

    /// Where edges across the hole keep inner vertices apart, splits them: either side would be faired by itself, and take the other
    /// one for its surroundings, as it is before. Not where triangles would become thin, as in a slot.
    fn split_chords(&mut self) {
        if !self.is_in_parts() {
            return;
        }
        for h in 0..self.patch.half_edges() {
            if self.is_full() || is_stopped() {
                return;
            }
            if self.is_inner(h) && self.is_chord(h) && self.splits_well(h) {
                self.split_and_flip(h);
            }
        }
    }

    /// Whether the inner vertices are in several parts.
    fn is_in_parts(&self) -> bool {
        let mut sets = DisjointSets::new(self.patch.x.len());
        let is_used = |h: &u32| self.patch.triangles[*h as usize / 3][0] != NONE;
        for h in (0..self.patch.half_edges()).filter(is_used) {
            let (a, b) = (self.patch.origin(h), self.patch.target(h));
            if !self.patch.is_boundary(a) && !self.patch.is_boundary(b) {
                sets.unite(a, b);
            }
        }
        let inner = self.patch.fixed as u32..self.patch.x.len() as u32;
        let mut inner = inner.filter(|&v| self.patch.is_alive(v));
        let first = inner.next().map(|v| sets.smallest(v));
        inner.any(|v| Some(sets.smallest(v)) != first)
    }

    /// Whether an edge split in its middle leaves no thin triangle.
    fn splits_well(&self, h: u32) -> bool {
        let o = self.patch.across(h);
        let [a, b, c, d] = [
            self.patch.origin(h),
            self.patch.target(h),
            self.patch.apex(h),
            self.patch.apex(o),
        ]
        .map(|v| self.patch.x[v as usize]);
        let m = (a + b) * 0.5;
        let halves = [[a, m, c], [m, b, c], [b, m, d], [m, a, d]];
        halves.iter().all(|half| smallest_angle(half) >= THIN)
    }

    /// Whether both ends are on the boundary, an inner vertex is beside, and the other triangle leads further.
    fn is_chord(&self, h: u32) -> bool {
        let o = self.patch.across(h);
        let ends = [self.patch.origin(h), self.patch.target(h)];
        let is_beside = |h: u32| !self.patch.is_boundary(self.patch.apex(h));
        let leads_on = |h: u32| is_beside(h) || self.is_inner(next(h)) || self.is_inner(previous(h));
        ends.iter().all(|&v| self.patch.is_boundary(v))
            && (is_beside(h) && leads_on(o) || is_beside(o) && leads_on(h))
    }

    /// Whether the middle of an edge would see a boundary edge beside it, or a long one, under a wide angle. Boundary edges
    /// cannot be split, so vertices would gather along one that is longer than what is wanted there.
    pub(super) fn would_encroach(&self, h: u32) -> bool {
        let o = self.patch.across(h);
        let (a, b) = (self.patch.origin(h) as usize, self.patch.target(h) as usize);
        let m = (self.patch.x[a] + self.patch.x[b]) * 0.5;
        let beside = [next(h), previous(h), next(o), previous(o)];
        beside
            .into_iter()
            .any(|g| self.patch.across(g) == NONE && self.is_wide(&m, g))
            || self.lenses.hold(&m)
    }

    /// Whether a point sees an edge under more than 120 degrees.
    fn is_wide(&self, m: &Vector3<f64>, h: u32) -> bool {
        let [a, b] = [self.patch.origin(h), self.patch.target(h)].map(|v| self.patch.x[v as usize]);
        is_wide(m, &a, &b)
    }

    /// Inner vertices that lie too near to a boundary edge go to its nearer end.
    fn clear_boundary(&mut self) {
        for h in 0..self.patch.half_edges() {
            if self.patch.triangles[h as usize / 3][0] == NONE || self.patch.across(h) != NONE {
                continue;
            }
            let v = self.patch.apex(h);
            if self.patch.is_boundary(v) || !self.is_wide(&self.patch.x[v as usize], h) {
                continue;
            }
            let to_start = previous(h);
            let to_end = self.patch.across(next(h));
            let nearer = self.patch.length(to_start) < self.patch.length(next(h));
            let order = if nearer {
                [to_start, to_end]
            } else {
                [to_end, to_start]
            };
            for g in order {
                let end = if g == NONE { v } else { self.patch.target(g) };
                if g != NONE && self.makes_nothing_taken(v, end) && self.collapse(g) {
                    break;
                }
            }
        }
    }

    pub(super) fn collapse(&mut self, h: u32) -> bool {
        self.patch.collapse(h, &mut self.outgoing, &mut self.ring)
    }

    /// Whether vertex `a` may move to `b` without an edge that is taken; leaves `a`'s neighbours in `ring`.
    pub(super) fn makes_nothing_taken(&mut self, a: u32, b: u32) -> bool {
        self.patch.ring(a, &mut self.outgoing, &mut self.ring);
        !self.patch.is_boundary(b)
            || self.ring.iter().all(|&v| {
                let boundary_edge = v != b && self.patch.is_boundary(v);
                !boundary_edge
                    || self.taken.binary_search(&(v.min(b), v.max(b))).is_err()
                    || self.patch.are_neighbours(v, b, &mut self.outgoing)
            })
    }

    fn collapse_short(&mut self) {
        checkpoint();
        for h in 0..self.patch.half_edges() {
            if !self.is_inner(h) {
                continue;
            }
            let (a, b) = (self.patch.origin(h), self.patch.target(h));
            let short = if self.patch.is_boundary(b) {
                0.85 * SHORT
            } else {
                SHORT
            };
            let wanted = 0.5 * (self.wanted(a) + self.wanted(b));
            if self.patch.length(h) < short * wanted && self.stays_short(a, b, LONG) && !is_stopped() {
                self.collapse(h);
            }
        }
    }

    /// Whether no edge would be longer than `long` wanted lengths, or one that is taken, if inner vertex `a` moved to `b`.
    pub(super) fn stays_short(&mut self, a: u32, b: u32, long: f64) -> bool {
        if self.patch.is_boundary(a) || !self.makes_nothing_taken(a, b) {
            return false;
        }
        let target = self.patch.x[b as usize];
        self.ring.iter().all(|&v| {
            let wanted = 0.5 * (self.wanted(v) + self.wanted(b));
            (self.patch.x[v as usize] - target).norm() < long * wanted
        })
    }
}

impl Refiner<'_> {
    /// The step of [`Sweeps::relax`] for one vertex alone.
    pub(super) fn relax_one(&mut self, v: u32) {
        if self.patch.is_boundary(v) || !self.patch.is_alive(v) {
            return;
        }
        self.patch.ring(v, &mut self.outgoing, &mut self.ring);
        let (x, count) = (self.patch.x[v as usize], self.ring.len());
        let at = |k: usize| self.patch.x[self.ring[k % count] as usize];
        let cross = |p: &Vector3<f64>, k: usize| (at(k) - p).cross(&(at(k + 1) - p));
        let normal: Vector3<f64> = (0..count).map(|k| cross(&x, k)).sum();
        let Some(normal) = normal.try_normalize(0.0) else {
            return;
        };
        let centre = (0..count).map(at).sum::<Vector3<f64>>() / count as f64;
        let target = centre - normal * normal.dot(&(centre - x));
        let turns_over = (0..count).any(|k| turns_over(&cross(&x, k), &cross(&target, k)));
        if !turns_over && !self.lenses.are_entered(&x, &target) {
            self.patch.x[v as usize] = target;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_gets_triangles_of_the_length_wanted() {
        let x: Vec<_> = (0..40)
            .map(|i| {
                let s = f64::from(i % 10) / 10.0;
                let [a, b] = [[s, 0.0], [1.0, s], [1.0 - s, 1.0], [0.0, 1.0 - s]][i as usize / 10];
                Vector3::new(a, b, 0.0)
            })
            .collect();
        // A fan of needles about a corner; the sides at that corner are fans about the far ends' neighbours.
        let fan = (10..30).map(|i| [0, i, i + 1]);
        let lower = (1..10).map(|i| [i, i + 1, 11]).filter(|t| t[1] <= 10);
        let upper = (30..39).map(|i| [29, i, i + 1]);
        let mut triangles: Vec<[u32; 3]> = fan.filter(|t| t[1] >= 11 && t[2] <= 29).collect();
        triangles.push([0, 1, 11]);
        triangles.extend(lower);
        triangles.push([0, 29, 39]);
        triangles.extend(upper);
        let mut patch = Patch::new(x, triangles, 40);
        patch.validate().unwrap();
        patch.size.fill(0.1);
        let fineness = Fineness {
            factor: 1.0,
            growth: 0.0,
            most: 1_000,
        };
        assert!(Refiner::new(&mut patch, fineness, &[]).run());
        patch.validate().unwrap();
        let inner = patch.x.len() - 40;
        assert!((60..150).contains(&inner), "{inner}");
        let (mut area, mut worst) = (0.0, f64::INFINITY);
        for t in 0..patch.triangles.len() {
            let cross = patch.cross(t);
            assert_above!(cross.z, 0.0);
            area += 0.5 * cross.z;
            worst = smallest_angle(&patch.triangles[t].map(|v| patch.x[v as usize])).min(worst);
        }
        assert!((area - 1.0).abs() < 1e-12 && worst > 25.0, "{area} {worst}");
    }

    /// How many inner vertices a patch in a plane has after it was refined to edges of this length.
    fn refined(x: &[[f64; 2]], triangles: Vec<[u32; 3]>, fixed: usize, length: f64) -> usize {
        let x = x.iter().map(|&[x, y]| Vector3::new(x, y, 0.0)).collect();
        let mut patch = Patch::new(x, triangles, fixed);
        patch.size.fill(length);
        let fineness = Fineness {
            factor: 1.0,
            growth: 0.0,
            most: 10_000,
        };
        Refiner::new(&mut patch, fineness, &[]).run();
        patch.validate().unwrap();
        patch.inner_vertices()
    }

    #[test]
    fn a_vertex_far_outside_of_its_triangle_in_its_plane_is_not_split_for_ever() {
        // Triangles without area arise on the fold: their normals are noise.
        for (i, j) in (0..40).flat_map(|i| (0..7).map(move |j| (i, j))) {
            let out = [1.0 + 0.05 * f64::from(i), 0.1 + 0.02 * f64::from(j)];
            let x = [[0.0, 0.0], [1.0, 0.0], [0.1, 0.4], out];
            assert_below!(refined(&x, vec![[0, 1, 3], [1, 2, 3], [2, 0, 3]], 3, 0.3), 300);
        }
    }

    #[test]
    fn an_edge_between_triangles_without_area_is_not_split_for_ever() {
        // Two inner vertices lie on an edge of the boundary.
        let x = [
            [0.0, 0.0],
            [1.0, 0.0],
            [1.0, 1.0],
            [0.0, 1.0],
            [0.5, 0.0],
            [0.25, 0.0],
        ];
        let triangles = vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [0, 4, 5], [4, 3, 5], [3, 0, 5]];
        assert_below!(refined(&x, triangles, 4, 0.2), 100);
    }
}
