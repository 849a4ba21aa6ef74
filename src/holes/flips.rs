//! Flips towards Delaunay, where they make neither folds nor edges that are there already.

use fairmesh_linear::interrupt::is_stopped;

use super::patch::NO_AREA;
use super::refine::Refiner;
use crate::mesh::NONE;
use crate::mesh::halfedge::next;

/// Flips per vertex and pass, at most: away from Delaunay on a plane their number is not bounded by theory.
/// Of 44 cases, half: 10 change, 7 get another triangulation, 1 fails; double: 1 changes, 1 get another triangulation.
const MOST_FLIPS: usize = 40;
/// An edge is flipped if its new triangles meet at less than 45 degrees, or bend no more than the old ones.
/// Of 42 cases, half: 7 change, 5 get another triangulation, +1 % iterations, 1 fails;
/// double: 39 change, 35 get another triangulation, -1 % iterations, 1 fails.
const BEND: f64 = std::f64::consts::FRAC_1_SQRT_2;

impl Refiner<'_> {
    /// Splits an edge, and flips around the new vertex; the half-edges that are new.
    pub(super) fn split_and_flip(&mut self, h: u32) -> Vec<u32> {
        let m = self.patch.split(h);
        self.patch.outgoing(m, &mut self.outgoing);
        let mut new = self.outgoing.clone();
        let around = new.iter().map(|&g| next(g)).collect();
        self.flip(around, MOST_FLIPS, |g| new.push(g));
        self.patch.outgoing(m, &mut self.outgoing);
        new.extend(&self.outgoing);
        new
    }

    /// Whether an edge violates Delaunay (the angles opposite to it sum up to more than 180 degrees) and its flip makes
    /// neither a fold nor an edge that is there already.
    fn should_flip(&mut self, h: u32) -> bool {
        let o = self.patch.across(h);
        if o == NONE || self.patch.triangles[h as usize / 3][0] == NONE {
            return false;
        }
        let [a, b] = [self.patch.origin(h), self.patch.target(h)];
        let [c, d] = [self.patch.apex(h), self.patch.apex(o)];
        let [p, q, r, s] = [a, b, c, d].map(|v| self.patch.x[v as usize]);
        let (dot0, dot1) = ((p - r).dot(&(q - r)), (p - s).dot(&(q - s)));
        let (old0, old1) = ((q - p).cross(&(r - p)), (p - q).cross(&(s - q)));
        let (right0, right1) = (dot0 >= 0.0, dot1 >= 0.0);
        // cot + cot < 0, without division: both cross products are lengths.
        let (l0, l1) = (old0.norm(), old1.norm());
        // Of a triangle without area neither the angles nor the normal tell anything.
        let none = NO_AREA * (p - q).norm_squared();
        let (has0, has1) = (l0 > none, l1 > none);
        if right0 && right1 && has0 && has1 {
            return false;
        }
        let excess = dot0 * l1 + dot1 * l0;
        if excess >= -1e-10 * (dot0.abs() * l1 + dot1.abs() * l0) && has0 && has1 {
            return false;
        }
        let (new0, new1) = ((p - r).cross(&(s - r)), (q - s).cross(&(r - s)));
        let (m0, m1) = (new0.norm(), new1.norm());
        let long = (r - s).norm_squared();
        if m0 <= NO_AREA * long || m1 <= NO_AREA * long {
            return false;
        }
        let bend = new0.dot(&new1) / (m0 * m1);
        if has0 && has1 {
            let before = old0.dot(&old1) / (l0 * l1);
            let side = old0 / l0 + old1 / l1;
            if bend < BEND && bend < before || new0.dot(&side) <= 0.0 || new1.dot(&side) <= 0.0 {
                return false;
            }
        } else if bend < 0.0 {
            return false;
        }
        // A boundary vertex keeps a triangle, an inner one three.
        for v in [a, b] {
            self.patch.outgoing(v, &mut self.outgoing);
            if self.outgoing.len() < 2 || !self.patch.is_boundary(v) && self.outgoing.len() < 4 {
                return false;
            }
        }
        let boundary_edge = self.patch.is_boundary(c) && self.patch.is_boundary(d);
        let is_taken = boundary_edge && self.taken.binary_search(&(c.min(d), c.max(d))).is_ok();
        !is_taken && !self.patch.are_neighbours(c, d, &mut self.outgoing)
    }

    /// Flips towards Delaunay until nothing changes, or often enough.
    pub(super) fn flip_all(&mut self) {
        let stack = (0..self.patch.half_edges())
            .filter(|&h| self.is_inner(h) && self.patch.origin(h) < self.patch.target(h))
            .collect();
        self.flip_from(stack);
    }

    /// The same, from these half-edges on.
    pub(super) fn flip_from(&mut self, stack: Vec<u32>) {
        self.flip(stack, MOST_FLIPS * self.patch.x.len(), |_| {});
    }

    /// The same, at most so many; `flipped` is told about every new edge.
    fn flip(&mut self, mut stack: Vec<u32>, most: usize, mut flipped: impl FnMut(u32)) {
        let mut left = most;
        while let Some(h) = stack.pop() {
            if left > 0 && self.should_flip(h) && !is_stopped() {
                left -= 1;
                let o = self.patch.across(h);
                self.patch.flip(h);
                let (t0, t1) = (h / 3, o / 3);
                stack.extend([3 * t0, 3 * t0 + 1, 3 * t1, 3 * t1 + 1]);
                flipped(3 * t0 + 2);
            }
        }
    }
}
