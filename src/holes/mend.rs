//! What is left after refinement: single triangles with a small angle, nearly all of them at the boundary, whose edges have to
//! stay. Around each an edge is split or a vertex removed, if that makes the smallest angle there larger.

use fairmesh_linear::interrupt::is_stopped;
use nalgebra::Vector3;

use super::refine::Refiner;
use crate::mesh::NONE;
use crate::quality::smallest_angle;

/// Triangles with a smaller angle (degrees) are worked on: what fairing moves afterwards must not bring them below 15.
/// Of 44 cases, half: 18 change by up to 0.07 edges, 16 get another triangulation, +2 % iterations;
/// double: 41 change, 38 get another triangulation, +2 % iterations, 1 fails.
const GOAL: f64 = 22.0;
/// Passes over all of them, at most.
/// Of 44 cases, half: 4 change by up to 5e-12 edges, 2 get another triangulation, -5 % iterations; double: 1 changes by up to 2e-4 edges.
const PASSES: usize = 6;
/// Edges at the boundary keep away from the ends of their range by this factor: fairing moves vertices a little.
/// Of 44 cases, half: 31 change, 29 get another triangulation; double: 39 change, 31 get another triangulation, +3 % iterations, 2 fail.
const ROOM: f64 = 1.15;
/// No edge gets longer than this many wanted lengths.
/// Of 20 cases, half: 6 change, 4 get another triangulation; double: 8 change, 7 get another triangulation, -10 % iterations.
const LONG: f64 = 1.8;
/// A pass looks at neighbours so many times the vertices, at most: three triangles of six neighbours each, all of them bad, are fewer.
/// Half or double, of 44 cases: none changes.
const MOST_NEAR: usize = 64;
/// Steps of the vertices around, per pass.
/// Of 44 cases, half: 10 change by up to 8e-4 edges, 5 get another triangulation;
/// double: 9 change by up to 2e-4 edges, 3 get another triangulation, -5 % iterations.
const STEPS: usize = 3;

impl Refiner<'_> {
    /// Mends edges at the boundary whose lengths are not in their range, then triangles with small angles.
    pub(super) fn mend(&mut self) {
        self.mend_lengths();
        // A vertex of many neighbours is gathered for each of its triangles: quadratic, unless it ends here.
        let most = MOST_NEAR * self.patch.x.len();
        for _ in 0..PASSES {
            let bad = self.narrow();
            if bad.is_empty() {
                return;
            }
            let mut near = Vec::new();
            for &t in &bad {
                self.gather(t, &mut near);
                if near.len() > most || is_stopped() {
                    return;
                }
            }
            self.settle(&mut near);
            for t in bad {
                self.mend_one(t, &mut near);
                if near.len() > most || is_stopped() {
                    break;
                }
            }
            self.settle(&mut near);
        }
    }

    fn mend_lengths(&mut self) {
        let (mut near, mut outgoing) = (Vec::new(), Vec::new());
        for v in 0..self.patch.fixed as u32 {
            let [least, most, _] = self.patch.range[v as usize];
            self.patch.outgoing(v, &mut outgoing);
            for &h in &outgoing {
                if !self.is_inner(h) || self.patch.origin(h) != v {
                    continue;
                }
                let (w, length) = (self.patch.target(h), self.patch.length(h));
                let middle = (self.patch.x[v as usize] + self.patch.x[w as usize]) * 0.5;
                if ROOM * length > most && !self.is_full() && !self.lenses.hold(&middle) {
                    near.extend([w, self.patch.split(h)]);
                } else if length < ROOM * least
                    && !self.patch.is_boundary(w)
                    && self.makes_nothing_taken(w, v)
                {
                    near.extend(&self.ring);
                    self.collapse(self.patch.across(h));
                }
            }
        }
        self.settle(&mut near);
    }

    pub(super) fn is_full(&self) -> bool {
        self.patch.inner_vertices() >= self.fineness.most
    }

    fn narrow(&self) -> Vec<u32> {
        let limit = libm::cos(GOAL.to_radians());
        let is_narrow = |t: &[u32; 3]| {
            let x = t.map(|v| self.patch.x[v as usize]);
            let edge = [x[1] - x[0], x[2] - x[1], x[0] - x[2]];
            let length = edge.map(|e| e.norm());
            (0..3).any(|k| {
                let j = (k + 2) % 3;
                -edge[k].dot(&edge[j]) > limit * length[k] * length[j]
            })
        };
        let triangles = self.patch.triangles.iter().zip(0u32..);
        triangles
            .filter(|(t, _)| t[0] != NONE && is_narrow(t))
            .map(|(_, t)| t)
            .collect()
    }

    /// The corners of a triangle and their neighbours.
    fn gather(&mut self, t: u32, near: &mut Vec<u32>) {
        for v in self.patch.triangles[t as usize] {
            if v != NONE {
                self.patch.ring(v, &mut self.outgoing, &mut self.ring);
                near.push(v);
                near.extend(&self.ring);
            }
        }
    }

    /// Steps of these vertices, and flips between them; sorts the list.
    fn settle(&mut self, near: &mut Vec<u32>) {
        near.sort_unstable();
        near.dedup();
        near.retain(|&v| self.patch.is_alive(v));
        for _ in 0..STEPS {
            for &v in &*near {
                self.relax_one(v);
            }
        }
        let mut stack = Vec::new();
        for &v in &*near {
            self.patch.outgoing(v, &mut self.outgoing);
            stack.extend(&self.outgoing);
        }
        self.flip_from(stack);
    }

    fn mend_one(&mut self, t: u32, near: &mut Vec<u32>) {
        if self.patch.triangles[t as usize][0] == NONE {
            return;
        }
        let side = |k: u32| self.patch.length(3 * t + k);
        let mut sides = [0, 1, 2];
        sides.sort_unstable_by(|&a, &b| side(a).total_cmp(&side(b)).then(a.cmp(&b)));
        let [short, middle, long] = sides.map(|k| 3 * t + k);
        let angle = smallest_angle(&self.patch.triangles[t as usize].map(|v| self.patch.x[v as usize]));
        if angle >= GOAL {
            return;
        }
        self.gather(t, near);
        if self.try_collapse(short) {
            return;
        }
        for h in [long, middle] {
            if self.try_split(h) {
                near.push(self.patch.x.len() as u32 - 1);
                return;
            }
        }
        let _ = self.try_collapse(middle) || self.try_collapse(long);
    }

    /// Removes one end of a short edge if the smallest angle around it grows, and no edge at the boundary gets too long.
    fn try_collapse(&mut self, h: u32) -> bool {
        let o = self.patch.across(h);
        if o == NONE {
            return false;
        }
        for g in [h, o] {
            let (a, b) = (self.patch.origin(g), self.patch.target(g));
            if self.patch.is_boundary(a) || !self.stays_short(a, b, LONG) || self.leaves_range(b) {
                continue;
            }
            let ring = self.ring.iter().map(|&v| (v, self.patch.x[v as usize]));
            let ring: Vec<(u32, Vector3<f64>)> = ring.collect();
            let around = |p: Vector3<f64>, without: Option<u32>| {
                let pairs = (0..ring.len()).map(|k| (ring[k], ring[(k + 1) % ring.len()]));
                pairs
                    .filter(|(q, r)| Some(q.0) != without && Some(r.0) != without)
                    .map(|(q, r)| smallest_angle(&[p, q.1, r.1]))
                    .fold(f64::INFINITY, f64::min)
            };
            let before = around(self.patch.x[a as usize], None);
            let after = around(self.patch.x[b as usize], Some(b));
            if after > before && self.collapse(g) {
                return true;
            }
        }
        false
    }

    /// Whether an edge from `b` to one of the ring would be too long at the boundary.
    fn leaves_range(&self, b: u32) -> bool {
        let target = self.patch.x[b as usize];
        let is_beyond = |v: u32, length: f64| {
            let range = self.patch.range.get(v as usize);
            range.is_some_and(|range| length > range[2])
        };
        self.ring.iter().any(|&v| {
            let length = (self.patch.x[v as usize] - target).norm();
            is_beyond(v, length) || is_beyond(b, length)
        })
    }

    /// Splits a long edge if the smallest angle beside it grows when the new vertex goes to the centre of its neighbours.
    fn try_split(&mut self, h: u32) -> bool {
        let o = self.patch.across(h);
        if o == NONE || self.is_full() {
            return false;
        }
        let corners = [
            self.patch.origin(h),
            self.patch.apex(o),
            self.patch.target(h),
            self.patch.apex(h),
        ];
        let x = corners.map(|v| self.patch.x[v as usize]);
        let centre = x.iter().sum::<Vector3<f64>>() / 4.0;
        if self.lenses.hold(&centre) {
            return false;
        }
        let before = smallest_angle(&[x[0], x[2], x[3]]).min(smallest_angle(&[x[0], x[1], x[2]]));
        let after = (0..4)
            .map(|k| smallest_angle(&[centre, x[k], x[(k + 1) % 4]]))
            .fold(f64::INFINITY, f64::min);
        if after <= before {
            return false;
        }
        let m = self.patch.split(h);
        self.relax_one(m);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::holes::patch::Patch;
    use crate::holes::refine::Fineness;

    /// A disc of 12 boundary vertices around a wheel of `inner` ones.
    fn wheel(radius: f64) -> Patch {
        let at = |r: f64, k: u32| {
            let a = f64::from(k) * std::f64::consts::TAU / 12.0;
            Vector3::new(r * a.cos(), r * a.sin(), 0.0)
        };
        let mut x: Vec<_> = (0..12).map(|k| at(1.0, k)).collect();
        x.extend((0..12).map(|k| at(radius, k)));
        x.push(Vector3::zeros());
        let mut triangles = Vec::new();
        for k in 0..12 {
            let next = (k + 1) % 12;
            triangles.extend([[k, next, 12 + next], [k, 12 + next, 12 + k]]);
            triangles.push([24, 12 + k, 12 + next]);
        }
        Patch::new(x, triangles, 12)
    }

    fn worst(patch: &Patch) -> f64 {
        let angle = |t: &[u32; 3]| smallest_angle(&t.map(|v| patch.x[v as usize]));
        let alive = patch.triangles.iter().filter(|t| t[0] != NONE);
        alive.map(angle).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn narrow_triangles_are_mended_and_the_patch_stays_a_disc() {
        for radius in [0.9, 0.98] {
            let mut patch = wheel(radius);
            patch.size.fill(0.5);
            assert_below!(worst(&patch), 12.0);
            let fineness = Fineness {
                factor: 1.0,
                growth: 0.0,
                most: 1_000,
            };
            Refiner::new(&mut patch, fineness, &[]).run_again();
            patch.validate().unwrap();
            assert!(worst(&patch) > 20.0, "{radius}: {}", worst(&patch));
            let area: f64 = (0..patch.triangles.len()).map(|t| 0.5 * patch.cross(t).z).sum();
            assert!((area - 3.0).abs() < 1e-12, "{area}");
        }
    }

    #[test]
    fn no_vertex_comes_above_the_limit() {
        let mut patch = wheel(0.98);
        patch.size.fill(0.5);
        let fineness = Fineness {
            factor: 1.0,
            growth: 0.0,
            most: 13,
        };
        Refiner::new(&mut patch, fineness, &[]).run_again();
        patch.validate().unwrap();
        assert_at_most!(patch.x.len(), 12 + 13);
    }
}
