//! The outer residual `R1 = S H` (paper (6), (7)) from weights and curvatures that are there.

use rayon::prelude::*;

use super::equations::{Equations, State};
use super::groups::{Chunk, Groups, LANES, gather_scalar, split_lengths};
use super::lanes::{Lanes, vectorized};

impl Equations<'_> {
    /// `R1 = S H` from the weights and curvatures of `state`.
    pub fn outer_residual(&self, state: &mut State) {
        let groups = self.groups;
        let (h, weight) = (&state.h, &state.weight);
        let pieces = split_lengths(&mut state.outer, groups.chunks.iter().map(|c| c.vertices.len()));
        pieces
            .into_par_iter()
            .zip(groups.chunks.par_iter())
            .for_each(|(outer, chunk)| {
                vectorized(
                    #[inline(always)]
                    || residual_chunk(groups, h, weight, chunk, outer),
                );
            });
    }

    /// The harmonic defect `max_i |R1_i| / sum_j |w_ij|` (a mean curvature: times a length it has no unit), and
    /// `|S H| / (|S| |H|)`, how much of the residual is more than cancellation.
    pub fn defect(&self, state: &State) -> (f64, f64) {
        let (mut worst, mut num, mut den) = (0.0f64, 0.0, 0.0);
        for i in 0..self.free() {
            let (mut absolute, mut size) = (0.0, 0.0);
            let (first, lane) = (self.groups.place[i].0 as usize, self.groups.place[i].1 as usize);
            let start = self.rings.start[i] as usize;
            for s in start..self.rings.start[i + 1] as usize {
                let w = state.weight[first + s - start][lane].abs();
                absolute += w;
                size += w * state.h[self.rings.neighbour[s] as usize].abs();
            }
            size += absolute * state.h[i].abs();
            worst = worst.max(state.outer[i].abs() / absolute.max(f64::MIN_POSITIVE));
            num += state.outer[i] * state.outer[i];
            den += size * size;
        }
        (worst, (num / den.max(f64::MIN_POSITIVE)).sqrt())
    }
}

/// One chunk of [`Equations::outer_residual`], without the choice of instructions.
#[inline(always)]
fn residual_chunk(groups: &Groups, h: &[f64], weight: &[[f64; LANES]], chunk: &Chunk, outer: &mut [f64]) {
    for group in chunk.groups.clone() {
        let vertex = &groups.vertex[group];
        let own = gather_scalar(h, vertex);
        let mut sum = Lanes::<LANES>::zero();
        let slots = groups.slots(group);
        for (weight, neighbour) in weight[slots.clone()].iter().zip(&groups.neighbour[slots]) {
            sum += Lanes(*weight) * (own - gather_scalar(h, neighbour));
        }
        for (l, &i) in vertex.iter().enumerate() {
            outer[i as usize - chunk.vertices.start] = sum.0[l];
        }
    }
}
