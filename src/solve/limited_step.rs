//! Steps that change no edge by more than a part of its length: beyond, triangles fold.

use nalgebra::Vector3;
use rayon::prelude::*;

use super::system::System;
use crate::discrete::valence_batches::CHUNK;

/// Largest edge-relative change of one step of the iteration.
pub(crate) const LARGEST_CHANGE: f64 = 0.5;

/// `x += scale step` at the free vertices.
pub(crate) fn advance(x: &mut [Vector3<f64>], step: &[f64], scale: f64) {
    for (x, s) in x.iter_mut().zip(step.chunks_exact(3)) {
        *x += Vector3::new(s[0], s[1], s[2]) * scale;
    }
}

/// Takes the step, or as much of it as changes no edge by more than `largest` where the whole would by `change`.
pub(crate) fn advance_limited(x: &mut [Vector3<f64>], step: &[f64], change: f64, largest: f64) {
    advance(x, step, (largest / change.max(f64::MIN_POSITIVE)).min(1.0));
}

impl System {
    /// The largest change of an edge by `step` relative to its length at `x`.
    pub(crate) fn edge_change(&self, x: &[Vector3<f64>], step: &[f64]) -> f64 {
        let (free, rings) = (self.free(), &self.domain.rings);
        let of = |i: usize| Vector3::new(step[3 * i], step[3 * i + 1], step[3 * i + 2]);
        let squared = (0..free.div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| {
                let mut largest = 0.0f64;
                for i in chunk * CHUNK..((chunk + 1) * CHUNK).min(free) {
                    let own = of(i);
                    for &j in rings.ring(i) {
                        let other = if (j as usize) < free {
                            of(j as usize)
                        } else {
                            Vector3::zeros()
                        };
                        let edge = (x[i] - x[j as usize]).norm_squared().max(f64::MIN_POSITIVE);
                        largest = largest.max((own - other).norm_squared() / edge);
                    }
                }
                largest
            })
            .reduce(|| 0.0, f64::max);
        squared.sqrt()
    }
}
