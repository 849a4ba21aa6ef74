//! Vertex normals from a closed one-ring.
//!
//! The ring is given by its edge vectors `e_k = q_jk - q_i` in counter-clockwise order.

use super::lanes::{Lanes, Vec3, cross, dot, normalized, plus, scaled};

/// Nelson Max's weights, `n ~ sum (e_k x e_k+1) / (|e_k|^2 |e_k+1|^2)`: exact on a sphere for any ring.
/// N. Max, "Weights for computing vertex normals from facet normals", J. Graphics Tools 4 (1999).
#[inline(always)]
pub fn max_normal<const L: usize>(ring: &[Vec3<L>]) -> Vec3<L> {
    sum_over_triangles(ring, |a, b| {
        (dot(a, a) * dot(b, b)).max(Lanes::splat(f64::MIN_POSITIVE)).recip()
    })
}

/// The paper's normal (section 6): the normalized sum of the triangles' cross products.
#[inline(always)]
pub fn cross_product_normal<const L: usize>(ring: &[Vec3<L>]) -> Vec3<L> {
    sum_over_triangles(ring, |_, _| Lanes::splat(1.0))
}

#[inline(always)]
fn sum_over_triangles<const L: usize>(
    ring: &[Vec3<L>],
    weight: impl Fn(&Vec3<L>, &Vec3<L>) -> Lanes<L>,
) -> Vec3<L> {
    let mut sum = [Lanes::zero(); 3];
    let mut a = &ring[ring.len() - 1];
    for b in ring {
        sum = plus(&sum, &scaled(&cross(a, b), weight(a, b)));
        a = b;
    }
    normalized(&sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrete::lanes::{lane, minus, one};
    use nalgebra::Vector3;

    fn ring_on_sphere(angles: &[(f64, f64)]) -> (Vector3<f64>, Vec<Vec3<1>>) {
        let q = Vector3::new(0.48, 0.6, 0.64);
        let (x, y) = (Vector3::new(0.8, 0.0, -0.6), Vector3::new(-0.36, 0.8, -0.48));
        let ring = angles.iter().map(|&(phi, r): &(f64, f64)| {
            let p = (q + (x * phi.cos() + y * phi.sin()) * r).normalize();
            minus(&one(&p), &one(&q))
        });
        (q, ring.collect())
    }

    #[test]
    fn max_normal_is_exact_on_a_sphere_for_any_ring() {
        let (q, ring) = ring_on_sphere(&[(0.0, 0.3), (0.4, 0.1), (2.0, 0.5), (3.9, 0.2), (5.0, 0.05)]);
        assert!((lane(&max_normal(&ring), 0) - q).norm() < 1e-14);
        assert!((lane(&cross_product_normal(&ring), 0) - q).norm() > 1e-3);
    }

    #[test]
    fn both_are_exact_in_a_plane_and_turn_with_the_orientation() {
        let ring: Vec<Vec3<1>> = [[1.0, 0.0, 0.0], [0.1, 2.0, 0.0], [-1.0, -0.3, 0.0]]
            .map(|e: [f64; 3]| e.map(Lanes::splat))
            .to_vec();
        let reversed: Vec<_> = ring.iter().rev().copied().collect();
        for f in [max_normal::<1>, cross_product_normal::<1>] {
            assert!((lane(&f(&ring), 0) - Vector3::z()).norm() < 1e-15);
            assert!((lane(&f(&reversed), 0) + Vector3::z()).norm() < 1e-15);
        }
    }
}
