//! The inner residual (paper 7.3) of a batch of vertices, and by itself where only tangential steps are taken.

use std::ops::Range;

use fairmesh_linear::parallel;
use nalgebra::Vector3;

use super::equations::{Equations, FreeCurvature, State};
use super::normals::{cross_product_normal, max_normal};
use super::ring_edges::{RingEdge, measure};
use super::simd::{Simd, Vec3, dot, lane, minus, plus, scaled, vectorized};
use super::valence_batches::{Chunk, LANES, gather, split_lengths};
use crate::support::profile::clock;

impl Equations<'_> {
    /// The edges of a batch's rings, measured. Returns the centres.
    #[inline(always)]
    pub(super) fn gather_ring(
        &self,
        x: &[Vector3<f64>],
        batch: usize,
        ring: &mut [RingEdge<LANES>],
    ) -> Vec3<LANES> {
        let batches = self.batches;
        let q = gather(x, &batches.vertex[batch]);
        for (edge, j) in ring.iter_mut().zip(&batches.neighbour[batches.slots(batch)]) {
            edge.edge = gather(x, j);
        }
        for edge in ring.iter_mut() {
            edge.edge = minus(&edge.edge, &q);
        }
        measure(ring);
        q
    }

    /// The inner residual of one batch.
    #[inline(always)]
    pub(super) fn inner_residual(
        &self,
        slots: Range<usize>,
        ring: &[RingEdge<LANES>],
        n: &Vec3<LANES>,
    ) -> Vec3<LANES> {
        let mut sum = [Simd::zero(); 3];
        for (s, RingEdge { edge: e, .. }) in ring.iter().enumerate() {
            match &self.weights.slots {
                None => sum = plus(&sum, e),
                Some(w) => sum = plus(&sum, &scaled(e, Simd(w[slots.start + s]))),
            }
        }
        minus(&sum, &scaled(n, dot(&sum, n)))
    }

    /// Normals and inner residual alone, into `state.normal` and `state.inner`; the rest of `state` stays.
    pub(crate) fn evaluate_inner(&self, x: &[Vector3<f64>], state: &mut State) {
        let _clock = clock("evaluations");
        let chunks = &self.batches.chunks;
        let lengths = || chunks.iter().map(|c| c.vertices.len());
        let normal = split_lengths(&mut state.normal, lengths());
        let inner = split_lengths(&mut state.inner, lengths());
        let pieces = normal.into_iter().zip(inner).zip(chunks);
        parallel::for_each(pieces, |_, ((normal, inner), chunk)| {
            vectorized(
                #[inline(always)]
                || self.inner_chunk(x, chunk, normal, inner),
            );
        });
    }

    /// One chunk of [`Self::evaluate_inner`], without the choice of instructions.
    #[inline(always)]
    fn inner_chunk(
        &self,
        x: &[Vector3<f64>],
        chunk: &Chunk,
        normal: &mut [Vector3<f64>],
        inner: &mut [Vector3<f64>],
    ) {
        let mut ring = vec![RingEdge::zero(); self.batches.largest_valence];
        for batch in chunk.batches.clone() {
            let slots = self.batches.slots(batch);
            let ring = &mut ring[..slots.len()];
            self.gather_ring(x, batch, ring);
            let n = match self.curvature {
                FreeCurvature::Paper => cross_product_normal(ring),
                FreeCurvature::GradientCorrected => max_normal(ring),
            };
            let residual = self.inner_residual(slots, ring, &n);
            // Backwards, as in the whole evaluation: only the first of a repeated vertex's lanes has its weights.
            for (l, &i) in self.batches.vertex[batch].iter().enumerate().rev() {
                let i = i as usize - chunk.vertices.start;
                normal[i] = lane(&n, l);
                inner[i] = lane(&residual, l);
            }
        }
    }
}
