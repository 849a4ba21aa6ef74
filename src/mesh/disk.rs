//! The triangles around a vertex, laid flat by the lengths of their edges.

use std::f64::consts::PI;

use super::EditableMesh;
use super::halfedge::next;
use super::rows::Rows;

/// A collapse leaves no triangle with less than this roundness: edges grow slowly away from the boundary, none of whose
/// vertices are removed.
/// Of 10 cases, half: 10 change by up to 2 edges, +18 % iterations; double: 10 change by up to 2 edges, -15 % iterations.
const LEAST_ROUNDNESS: f64 = 0.4;
/// Tangent of half the least angle of triangles that are laid flat: .02 radians.
/// Of 10 cases, half: 1 changes by up to 3e-8 edges, +8 % iterations; double: 1 changes by up to 2e-8 edges, +3 % iterations.
const NARROWEST: f64 = 0.01;
/// Tangent of half the widest angle of triangles that are laid flat, 171 degrees: beyond 180 a mean value coordinate would not be positive.
/// Of 10 cases, half: 1 changes by up to 5e-8 edges, -1 % iterations; double: 1 changes by up to 2 edges, +4 % iterations.
const WIDEST: f64 = 12.7;

/// Whether an angle, given by the tangent of its half, is neither narrow nor nearly straight.
pub(super) fn is_fit(half_tangent: f64) -> bool {
    (NARROWEST..WIDEST).contains(&half_tangent)
}

/// The tangent of half the angle of a triangle opposite to its edge `c`; not finite where no triangle has such edges.
pub(super) fn half_tangent(a: f64, b: f64, c: f64) -> f64 {
    let (above, below) = ((c - a + b) * (c + a - b), (a + b - c) * (a + b + c));
    (above.max(0.0) / below).sqrt()
}

/// A vertex with its ring, laid flat around it. Entry `k` is of the `k`-th triangle, counter-clockwise, or of its first neighbour.
#[derive(Debug, Default)]
pub(super) struct Disk {
    /// The half-edges that leave the vertex,
    pub(super) edges: Vec<u32>,
    /// where they end,
    pub(super) ring: Vec<u32>,
    /// their lengths,
    edge_lengths: Vec<f64>,
    /// and those of the edges across the triangles.
    across: Vec<f64>,
    /// Tangents of half the angles at the vertex, that make a full turn.
    half_tangents: Vec<f64>,
    /// The ring.
    points: Vec<[f64; 2]>,
    /// Collapses along edges that are short enough: their least roundness, squared, and number.
    pub(super) choices: Vec<(f64, usize)>,
}

impl Disk {
    /// Takes the triangles around free vertex `u`. Returns whether an edge there is no longer than `limit`.
    pub(super) fn gather(&mut self, mesh: &EditableMesh, lengths: &[f64], u: u32, limit: f64) -> bool {
        self.edges.clear();
        self.edge_lengths.clear();
        for h in mesh.outgoing(u) {
            self.edges.push(h);
            self.edge_lengths.push(lengths[h as usize]);
        }
        if self.edge_lengths.iter().all(|&l| l > limit) {
            return false;
        }
        self.ring.clear();
        self.across.clear();
        for &h in &self.edges {
            self.ring.push(mesh.target(h));
            self.across.push(lengths[next(h) as usize]);
        }
        true
    }

    /// Lays them flat: every angle grows by as much, so that they make a full turn. False where their lengths are those of no
    /// triangles, or an angle is too narrow or too wide.
    pub(super) fn lay_flat(&mut self) -> bool {
        let m = self.edges.len();
        let missing = PI - self.half_turn();
        let more = libm::tan(missing / m as f64);
        self.points.clear();
        let mut direction = [1.0, 0.0];
        for (t, r) in self.half_tangents.iter_mut().zip(&self.edge_lengths) {
            *t = (*t + more) / (1.0 - *t * more);
            if !is_fit(*t) {
                return false;
            }
            self.points.push(direction.map(|x| r * x));
            let part = 1.0 / (1.0 + *t * *t);
            direction = turned(direction, [(1.0 - *t * *t) * part, 2.0 * *t * part]);
        }
        true
    }

    /// Half the sum of the angles at the vertex.
    fn half_turn(&mut self) -> f64 {
        let (m, lengths) = (self.edges.len(), &self.edge_lengths);
        self.half_tangents.clear();
        let (mut sum, mut at) = (0.0, [1.0, 0.0]);
        for k in 0..m {
            let after = if k + 1 == m { 0 } else { k + 1 };
            let t = half_tangent(lengths[k], lengths[after], self.across[k]);
            self.half_tangents.push(t);
            at = turned(at, [1.0, t]);
            if at[1] < 0.0 {
                (sum, at) = (sum + PI, at.map(|x| -x));
            }
        }
        sum + libm::atan2(at[1], at[0])
    }

    /// Mean value coordinates of the vertex in its ring, as another row.
    pub(super) fn coordinates(&self, rows: &mut Rows<(u32, f64)>) {
        let m = self.edges.len();
        let weight = |k: usize| {
            let before = if k == 0 { m - 1 } else { k - 1 };
            (self.half_tangents[k] + self.half_tangents[before]) / self.edge_lengths[k]
        };
        let part = 1.0 / (0..m).map(weight).sum::<f64>();
        for (k, &v) in self.ring.iter().enumerate() {
            rows.push((v, weight(k) * part));
        }
        rows.end_row();
    }

    /// Equal ones.
    pub(super) fn equal_coordinates(&self, rows: &mut Rows<(u32, f64)>) {
        let share = 1.0 / self.ring.len() as f64;
        self.ring.iter().for_each(|&v| rows.push((v, share)));
        rows.end_row();
    }

    /// The collapses along edges up to `limit` that leave round triangles, the best first.
    pub(super) fn rank_choices(&mut self, limit: f64) {
        self.choices.clear();
        for (j, &length) in self.edge_lengths.iter().enumerate() {
            if length <= limit
                && let Some(roundness) = self.least_roundness(j)
            {
                self.choices.push((roundness, j));
            }
        }
        self.choices.sort_by(|a, b| b.0.total_cmp(&a.0));
    }

    /// Of the triangles that are left when the vertex moves to the end of edge `j`, by the lengths that they will have; none
    /// where one is less round than is allowed, or not counter-clockwise.
    fn least_roundness(&self, j: usize) -> Option<f64> {
        let m = self.edges.len();
        let at = |k: usize| if k < m { k } else { k - m };
        let a = self.points[j];
        let from_a = |k: usize| [self.points[k][0] - a[0], self.points[k][1] - a[1]];
        let mut b = from_a(at(j + 1));
        // Beside the edge there is one already, which keeps its length.
        let mut ab = square(self.across[j]);
        let mut least = f64::INFINITY;
        for k in j + 1..j + m - 1 {
            let c = from_a(at(k + 1));
            let ac = if k == j + m - 2 {
                square(self.across[at(k + 1)])
            } else {
                c[0] * c[0] + c[1] * c[1]
            };
            let roundness = squared_roundness([ab, square(self.across[at(k)]), ac]);
            let is_turned = b[0] * c[1] - b[1] * c[0] <= 0.0;
            if is_turned || roundness.is_nan() || roundness < LEAST_ROUNDNESS * LEAST_ROUNDNESS {
                return None;
            }
            least = least.min(roundness);
            (b, ab) = (c, ac);
        }
        Some(least)
    }

    /// Whether the collapse along edge `j` makes an edge between two fixed vertices: that could cut the region apart.
    pub(super) fn joins_fixed(&self, mesh: &EditableMesh, j: usize) -> bool {
        let m = self.ring.len();
        let is_fixed = |k: usize| !mesh.is_free(self.ring[k]);
        let is_beside = |k: usize| k == j || k == (j + 1) % m || j == (k + 1) % m;
        is_fixed(j) && (0..m).any(|k| !is_beside(k) && is_fixed(k))
    }

    /// The distance between two points of the ring.
    pub(super) fn distance(&self, j: usize, k: usize) -> f64 {
        let (a, b) = (self.points[j], self.points[k]);
        let [x, y] = [b[0] - a[0], b[1] - a[1]];
        (x * x + y * y).sqrt()
    }
}

fn square(a: f64) -> f64 {
    a * a
}

/// The square of the roundness of a triangle whose squared edges are `e`. Its roundness is `4 sqrt(3)` times its area over
/// their sum: 1 for an equilateral one.
fn squared_roundness(e: [f64; 3]) -> f64 {
    let sum = e[0] + e[1] + e[2];
    3.0 - 6.0 * (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) / (sum * sum)
}

/// `a` turned by the angle of `b`, as complex numbers.
fn turned(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}
