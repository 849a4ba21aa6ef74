//! A closed one-ring as edge vectors from its centre, with what every formula on it takes: measured once.

use super::lanes::{Lanes, Vec3, cross, dot};

/// Squared lengths count as at least this much, so that the product of two reciprocals stays finite.
const SMALLEST_SQUARE: f64 = 1e-150;

/// `1 / |e|^2`; finite at `e = 0`.
#[inline(always)]
pub fn inverse_square<const L: usize>(square: Lanes<L>) -> Lanes<L> {
    square.max(Lanes::splat(SMALLEST_SQUARE)).recip()
}

/// Spoke `k` of a ring: the edge to its `k`-th neighbour, counter-clockwise.
#[derive(Debug, Clone, Copy)]
pub struct Spoke<const L: usize> {
    /// `e_k = q_jk - q_i`.
    pub edge: Vec3<L>,
    /// `|e_k|^2`.
    pub square: Lanes<L>,
    /// `1 / |e_k|^2`.
    pub inverse_square: Lanes<L>,
    /// `e_k x e_k+1`: twice the vector area of triangle `(i, j_k, j_k+1)`.
    pub cross: Vec3<L>,
}

impl<const L: usize> Spoke<L> {
    /// A spoke without length.
    #[inline(always)]
    pub fn zero() -> Self {
        let zero = Lanes::zero();
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
pub fn measure<const L: usize>(ring: &mut [Spoke<L>]) {
    let Some(first) = ring.first() else { return };
    let mut next = first.edge;
    for spoke in ring.iter_mut().rev() {
        spoke.square = dot(&spoke.edge, &spoke.edge);
        spoke.inverse_square = inverse_square(spoke.square);
        spoke.cross = cross(&spoke.edge, &next);
        next = spoke.edge;
    }
}

/// The ring with these edges.
pub fn ring_of<const L: usize>(edges: impl IntoIterator<Item = Vec3<L>>) -> Vec<Spoke<L>> {
    let mut ring: Vec<_> = edges
        .into_iter()
        .map(|edge| Spoke {
            edge,
            ..Spoke::zero()
        })
        .collect();
    measure(&mut ring);
    ring
}
