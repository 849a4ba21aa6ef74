//! The Laplace-Beltrami operator (paper section 5): the matrix `S` of (6) and (7).
//!
//! `w_ij = cot alpha_j + cot beta_j`, `(S f)_i = sum_j w_ij (f_i - f_j)`. With `D_i = 3 / (4 A_i)`, `A_i` the area of
//! the 1-disk, `-D_i (S q)_i` is the mean curvature normal of (5).

use nalgebra::Vector3;

use super::ring_edges::RingEdge;
use super::simd::{Simd, dot};

/// Below this sine of a corner's angle (about), a cotangent stops growing: `1 / SMALLEST_SINE` bounds it.
/// Half or double, of 128 cases: none changes.
const SMALLEST_SINE: f64 = 1e-8;

/// The cotangent weights of a closed ring, written to `weight`, and the area of its triangles.
#[inline(always)]
pub(crate) fn ring_weights<const L: usize>(ring: &[RingEdge<L>], weight: &mut [Simd<L>]) -> Simd<L> {
    let mut twice_area = Simd::zero();
    let m = ring.len();
    weight[0] = Simd::zero();
    for k in 0..m {
        let next = if k + 1 < m { k + 1 } else { 0 };
        let (a, b) = (&ring[k], &ring[next]);
        let inner = dot(&a.edge, &b.edge);
        let area = dot(&a.cross, &a.cross).sqrt();
        let floor = (a.square + b.square) * SMALLEST_SINE;
        let inverse = area.max(floor).max(Simd::splat(f64::MIN_POSITIVE)).recip();
        // The angle at b's end faces edge a, and the other way round.
        weight[k] += (b.square - inner) * inverse;
        let facing = (a.square - inner) * inverse;
        weight[next] = if next > 0 { facing } else { weight[0] + facing };
        twice_area += area;
    }
    twice_area * 0.5
}

/// Cotangent of the angle at `apex` in the triangle `(apex, a, b)`.
pub(crate) fn cotangent(apex: &Vector3<f64>, a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    let (e_a, e_b) = (a - apex, b - apex);
    let sine = e_a.cross(&e_b).norm();
    let floor = (e_a.norm_squared() + e_b.norm_squared()) * SMALLEST_SINE;
    e_a.dot(&e_b) / sine.max(floor).max(f64::MIN_POSITIVE)
}

/// Area of a triangle.
pub(crate) fn area(a: &Vector3<f64>, b: &Vector3<f64>, c: &Vector3<f64>) -> f64 {
    (b - a).cross(&(c - a)).norm() * 0.5
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrete::ring_edges::ring_of;
    use crate::discrete::simd::{Vec3, lane, minus, one, plus, scaled};

    fn ring() -> (Vector3<f64>, Vec<Vector3<f64>>) {
        let q = Vector3::new(0.1, -0.2, 0.3);
        let ring = [
            (0.0, 1.0, 0.2),
            (0.8, 0.7, 0.0),
            (2.0, 1.3, -0.1),
            (3.5, 0.9, 0.3),
            (4.9, 1.1, 0.0),
        ]
        .map(|(phi, r, z): (f64, f64, f64)| Vector3::new(r * phi.cos(), r * phi.sin(), z));
        (q, ring.to_vec())
    }

    fn weights(q: &Vector3<f64>, ring: &[Vector3<f64>]) -> (Vec<f64>, f64) {
        let e = ring_of(ring.iter().map(|p| minus(&one(p), &one(q))));
        let mut w = vec![Simd::zero(); e.len()];
        let area = ring_weights(&e, &mut w);
        (w.iter().map(|w| w.0[0]).collect(), area.0[0])
    }

    #[test]
    fn weights_are_the_cotangents_of_the_facing_angles() {
        let (q, p) = ring();
        let (w, total) = weights(&q, &p);
        let m = p.len();
        let mut sum = 0.0;
        for k in 0..m {
            let (before, here, after) = (&p[(k + m - 1) % m], &p[k], &p[(k + 1) % m]);
            let want = cotangent(before, &q, here) + cotangent(after, here, &q);
            assert_near!(w[k], want, 1e-13);
            sum += area(&q, here, after);
        }
        assert_near!(total, sum, 1e-14);
    }

    #[test]
    fn linear_functions_in_a_plane_are_harmonic() {
        let (_, mut p) = ring();
        for x in &mut p {
            x.z = 0.0;
        }
        let q = Vector3::new(0.05, 0.1, 0.0);
        let (w, _) = weights(&q, &p);
        let residual: Vector3<f64> = p.iter().zip(&w).map(|(x, &w)| (x - q) * w).sum();
        assert_below!(residual.norm(), 1e-13);
    }

    #[test]
    fn the_gradient_of_area_is_half_the_laplacian() {
        // Two routes to one operator: d A / d q_i = 1/2 sum w_ij (q_i - q_j) (Pinkall, Polthier 1993).
        let (q, p) = ring();
        let (w, _) = weights(&q, &p);
        let e: Vec<Vec3<1>> = p.iter().map(|x| minus(&one(&q), &one(x))).collect();
        let zero = [Simd::zero(); 3];
        let sum = e
            .iter()
            .zip(&w)
            .fold(zero, |s, (e, &w)| plus(&s, &scaled(e, Simd::splat(0.5 * w))));
        let gradient = lane(&sum, 0);
        for d in 0..3 {
            let mut step = Vector3::zeros();
            step[d] = 1e-6;
            let slope = (weights(&(q + step), &p).1 - weights(&(q - step), &p).1) / 2e-6;
            assert_near!(slope, gradient[d], 1e-9);
        }
    }

    #[test]
    fn a_triangle_without_area_gives_finite_weights() {
        let q = Vector3::zeros();
        let p = [Vector3::x(), Vector3::x() * 2.0, Vector3::x() * -1.0];
        assert_all!(weights(&q, &p).0.iter(), |w| w.is_finite());
    }
}
