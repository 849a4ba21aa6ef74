//! A closed one-ring as edge vectors from its centre, with what every formula on it takes: measured once.

use super::simd::{Simd, Vec3, cross, dot};

/// Squared lengths count as at least this much, so that the product of two reciprocals stays finite.
/// Half or double, of 131 cases: none changes.
const SMALLEST_SQUARE: f64 = 1e-150;

/// `1 / |e|^2`; finite at `e = 0`.
#[inline(always)]
pub(crate) fn inverse_square<const L: usize>(square: Simd<L>) -> Simd<L> {
    square.max(Simd::splat(SMALLEST_SQUARE)).recip()
}

/// Edge `k` of a ring: from the centre to its `k`-th neighbour, counter-clockwise.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RingEdge<const L: usize> {
    /// `e_k = q_jk - q_i`.
    pub edge: Vec3<L>,
    /// `|e_k|^2`.
    pub square: Simd<L>,
    /// `1 / |e_k|^2`.
    pub inverse_square: Simd<L>,
    /// `e_k x e_k+1`: twice the vector area of triangle `(i, j_k, j_k+1)`.
    pub cross: Vec3<L>,
}

impl<const L: usize> RingEdge<L> {
    /// An edge without length.
    #[inline(always)]
    pub(crate) fn zero() -> Self {
        let zero = Simd::zero();
        Self {
            edge: [zero; 3],
            square: zero,
            inverse_square: zero,
            cross: [zero; 3],
        }
    }
}

/// Fills in everything that follows from the edges.
#[inline(always)]
pub(crate) fn measure<const L: usize>(ring: &mut [RingEdge<L>]) {
    let Some(first) = ring.first() else { return };
    let mut next = first.edge;
    for edge in ring.iter_mut().rev() {
        edge.square = dot(&edge.edge, &edge.edge);
        edge.inverse_square = inverse_square(edge.square);
        edge.cross = cross(&edge.edge, &next);
        next = edge.edge;
    }
}

#[cfg(test)]
/// The ring with these edges.
pub(crate) fn ring_of<const L: usize>(edges: impl IntoIterator<Item = Vec3<L>>) -> Vec<RingEdge<L>> {
    let mut ring: Vec<_> = edges
        .into_iter()
        .map(|edge| RingEdge {
            edge,
            ..RingEdge::zero()
        })
        .collect();
    measure(&mut ring);
    ring
}
