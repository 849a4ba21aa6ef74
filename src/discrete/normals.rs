//! Vertex normals: from a closed one-ring, given by its edges in counter-clockwise order, or from triangles.

use nalgebra::Vector3;

use super::ring_edges::RingEdge;
use super::simd::{Simd, Vec3, normalized, plus, scaled};

/// Nelson Max's weights, `n ~ sum (e_k x e_k+1) / (|e_k|^2 |e_k+1|^2)`: exact on a sphere for any ring.
/// N. Max, "Weights for computing vertex normals from facet normals", J. Graphics Tools 4 (1999).
#[inline(always)]
pub(crate) fn max_normal<const L: usize>(ring: &[RingEdge<L>]) -> Vec3<L> {
    let mut sum = [Simd::zero(); 3];
    let mut next = ring[0].inverse_square;
    for edge in ring.iter().rev() {
        sum = plus(&sum, &scaled(&edge.cross, edge.inverse_square * next));
        next = edge.inverse_square;
    }
    normalized(&sum)
}

/// The paper's normal (section 6): the normalized sum of the triangles' cross products.
#[inline(always)]
pub(crate) fn cross_product_normal<const L: usize>(ring: &[RingEdge<L>]) -> Vec3<L> {
    let mut sum = [Simd::zero(); 3];
    for edge in ring {
        sum = plus(&sum, &edge.cross);
    }
    normalized(&sum)
}

/// The normals of vertices of some triangles, by the areas of these; zero where a vertex has none.
pub(crate) fn normals_by_areas(
    positions: &[Vector3<f64>],
    triangles: impl Iterator<Item = [u32; 3]>,
) -> Vec<Vector3<f64>> {
    let mut normals = vec![Vector3::zeros(); positions.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|v| positions[v as usize]);
        let normal = (b - a).cross(&(c - a));
        triangle.iter().for_each(|&v| normals[v as usize] += normal);
    }
    let unit = |n: Vector3<f64>| n.try_normalize(0.0).unwrap_or_default();
    normals.into_iter().map(unit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrete::ring_edges::ring_of;
    use crate::discrete::simd::{lane, minus, one};
    use nalgebra::Vector3;

    fn ring_on_sphere(angles: &[(f64, f64)]) -> (Vector3<f64>, Vec<RingEdge<1>>) {
        let q = Vector3::new(0.48, 0.6, 0.64);
        let (x, y) = (Vector3::new(0.8, 0.0, -0.6), Vector3::new(-0.36, 0.8, -0.48));
        let ring = angles.iter().map(|&(phi, r): &(f64, f64)| {
            let p = (q + (x * phi.cos() + y * phi.sin()) * r).normalize();
            minus(&one(&p), &one(&q))
        });
        (q, ring_of(ring))
    }

    #[test]
    fn max_normal_is_exact_on_a_sphere_for_any_ring() {
        let (q, ring) = ring_on_sphere(&[(0.0, 0.3), (0.4, 0.1), (2.0, 0.5), (3.9, 0.2), (5.0, 0.05)]);
        assert_below!((lane(&max_normal(&ring), 0) - q).norm(), 1e-14);
        assert_above!((lane(&cross_product_normal(&ring), 0) - q).norm(), 1e-3);
    }

    #[test]
    fn both_are_exact_in_a_plane_and_turn_with_the_orientation() {
        let edges =
            [[1.0, 0.0, 0.0], [0.1, 2.0, 0.0], [-1.0, -0.3, 0.0]].map(|e: [f64; 3]| e.map(Simd::splat));
        let (ring, reversed) = (ring_of(edges), ring_of(edges.into_iter().rev()));
        for f in [max_normal::<1>, cross_product_normal::<1>] {
            assert_below!((lane(&f(&ring), 0) - Vector3::z()).norm(), 1e-15);
            assert_below!((lane(&f(&reversed), 0) + Vector3::z()).norm(), 1e-15);
        }
    }
}
