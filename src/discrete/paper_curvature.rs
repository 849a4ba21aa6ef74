//! Curvature at free vertices as the paper has it (6.1, 6.2).

use nalgebra::Vector3;
use rayon::prelude::*;

use super::curvature::moreton_sequin;
use super::equations::{Equations, State};
use super::lanes::{minus, one};
use super::low_valence::spiral_sample;

/// Valences up to this take extra samples (paper 6.2).
const LOW_VALENCE: usize = 4;

impl Equations<'_> {
    /// Plain Moreton-Sequin at free vertices, with the samples of 6.2 where the valence is low. It needs the normals
    /// of the neighbours, hence a pass of its own.
    pub(super) fn paper_curvature(&self, x: &[Vector3<f64>], state: &mut State) {
        let rings = self.rings;
        let free = self.free();
        let normal = &state.corrected;
        let of = |i: u32| normal[i as usize];
        state.h[..free]
            .par_iter_mut()
            .zip(state.k.par_iter_mut())
            .with_min_len(256)
            .enumerate()
            .for_each(|(i, (h, k))| {
                let ring = &rings.neighbour[rings.start[i] as usize..rings.start[i + 1] as usize];
                let q = one(&x[i]);
                let at = |j: u32| minus(&one(&x[j as usize]), &q);
                let extra = if ring.len() <= LOW_VALENCE { ring.len() } else { 0 };
                let between = (0..extra).map(|s| {
                    let (a, b) = (ring[s], ring[(s + 1) % ring.len()]);
                    spiral_sample(&at(a), &at(b), &one(&of(a)), &one(&of(b)))
                });
                let n = one(&normal[i]);
                let (mean, gauss) = moreton_sequin(&n, ring.iter().map(|&j| at(j)).chain(between));
                (*h, *k) = (mean.0[0], gauss.0[0]);
            });
    }
}
