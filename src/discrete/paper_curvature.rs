//! Curvature at free vertices in the paper's discretization (paper 6).

use fairmesh_linear::parallel;
use nalgebra::Vector3;

use super::curvature::{moreton_sequin, moreton_sequin_with_response};
use super::equations::{Equations, State};
use super::low_valence::spiral_sample;
use super::simd::{Vec3, one};

/// Valences up to this take extra samples (paper 6.2).
/// Of 4 cases, half: 4 change by up to 0.03 edges, +1 % iterations; double: 4 change by up to 0.02 edges, +16 % iterations.
const LOW_VALENCE: usize = 4;

/// The samples at a vertex that is at `q` (paper 6.1): the vertices of its `ring`, and the points of 6.2 between some
/// `pairs` of them.
pub(crate) fn samples(
    q: &Vector3<f64>,
    ring: &[u32],
    pairs: impl Iterator<Item = [u32; 2]>,
    x: &[Vector3<f64>],
    normal: &[Vector3<f64>],
) -> impl Iterator<Item = Vec3<1>> {
    let at = move |j: u32| one(&(x[j as usize] - q));
    let between = pairs.map(move |[a, b]| {
        let (n_a, n_b) = (one(&normal[a as usize]), one(&normal[b as usize]));
        spiral_sample(&at(a), &at(b), &n_a, &n_b)
    });
    ring.iter().map(move |&j| at(j)).chain(between)
}

/// The pairs of consecutive neighbours in a closed ring of low valence; none in others (paper 6.2).
pub(crate) fn low_valence_pairs(ring: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    let m = ring.len();
    let count = if m <= LOW_VALENCE { m } else { 0 };
    (0..count).map(move |k| [ring[k], ring[(k + 1) % m]])
}

impl Equations<'_> {
    /// Plain Moreton-Sequin at free vertices, with the samples of 6.2 where the valence is low. It needs the normals
    /// of the neighbours, hence a pass of its own.
    pub(super) fn paper_curvature<const RESPONSE: bool>(&self, x: &[Vector3<f64>], state: &mut State) {
        let rings = self.rings;
        let normal = &state.corrected;
        let free = self.free();
        let pieces = state.h[..free]
            .chunks_mut(256)
            .zip(state.k.chunks_mut(256).zip(state.response.chunks_mut(256)));
        parallel::for_each(pieces, |piece, (h, (k, response))| {
            for (i, (h, (k, response))) in (256 * piece..).zip(h.iter_mut().zip(k.iter_mut().zip(response))) {
                let ring = rings.ring(i);
                let n = one(&normal[i]);
                let samples = samples(&x[i], ring, low_valence_pairs(ring), x, normal);
                if RESPONSE {
                    let (mean, gauss, answer) = moreton_sequin_with_response(&n, samples);
                    (*h, *k, *response) = (mean.0[0], gauss.0[0], answer.0[0]);
                } else {
                    let (mean, gauss) = moreton_sequin(&n, samples);
                    (*h, *k) = (mean.0[0], gauss.0[0]);
                }
            }
        });
    }
}
