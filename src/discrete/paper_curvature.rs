//! Curvature at free vertices in the paper's discretization (paper 6).

use nalgebra::Vector3;
use rayon::prelude::*;

use super::curvature::{moreton_sequin, moreton_sequin_with_response};
use super::equations::{Equations, State};
use super::low_valence::spiral_sample;
use super::simd::{minus, one};

/// Valences up to this take extra samples (paper 6.2).
pub(crate) const LOW_VALENCE: usize = 4;

impl Equations<'_> {
    /// Plain Moreton-Sequin at free vertices, with the samples of 6.2 where the valence is low. It needs the normals
    /// of the neighbours, hence a pass of its own.
    pub(super) fn paper_curvature<const RESPONSE: bool>(&self, x: &[Vector3<f64>], state: &mut State) {
        let rings = self.rings;
        let normal = &state.corrected;
        let free = self.free();
        let of = |i: u32| normal[i as usize];
        state.h[..free]
            .par_iter_mut()
            .zip(state.k.par_iter_mut())
            .zip(state.response.par_iter_mut())
            .with_min_len(256)
            .enumerate()
            .for_each(|(i, ((h, k), response))| {
                let ring = rings.ring(i);
                let q = one(&x[i]);
                let at = |j: u32| minus(&one(&x[j as usize]), &q);
                let extra = if ring.len() <= LOW_VALENCE { ring.len() } else { 0 };
                let between = (0..extra).map(|s| {
                    let (a, b) = (ring[s], ring[(s + 1) % ring.len()]);
                    spiral_sample(&at(a), &at(b), &one(&of(a)), &one(&of(b)))
                });
                let n = one(&normal[i]);
                let samples = ring.iter().map(|&j| at(j)).chain(between);
                if RESPONSE {
                    let (mean, gauss, answer) = moreton_sequin_with_response(&n, samples);
                    (*h, *k, *response) = (mean.0[0], gauss.0[0], answer.0[0]);
                } else {
                    let (mean, gauss) = moreton_sequin(&n, samples);
                    (*h, *k) = (mean.0[0], gauss.0[0]);
                }
            });
    }
}
