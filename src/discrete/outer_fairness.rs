//! Outer fairness: `R1_i = (S H)_i + (2 A_i / 3) rhs_i`, one number per free vertex (paper (4), (6), (7)).

use super::equations::{Equations, State};
use super::simd::{Simd, vectorized};
use super::valence_batches::{LANES, gather_scalar, split_lengths};
use fairmesh_linear::parallel;

impl Equations<'_> {
    /// `R1` from the weights, areas and curvatures of `state`. An inhomogeneous right-hand side is taken at the
    /// surface at hand.
    pub(crate) fn outer_residual(&self, state: &mut State) {
        if self.right_hand_side.is_zero() {
            return self.residual_with(state, |sum, _, _, _| sum);
        }
        self.residual_with(state, |sum, state, vertex, h| {
            let k = gather_scalar(state.k, vertex);
            let area = gather_scalar(state.area, vertex);
            sum + self.right_hand_side.load_lanes(h, k, area)
        });
    }

    /// `finish` makes `R1` of a batch from its `S H`, its vertices and their `H`.
    #[inline(always)]
    fn residual_with(
        &self,
        state: &mut State,
        finish: impl Fn(Simd<LANES>, &Evaluated<'_>, &[u32; LANES], Simd<LANES>) -> Simd<LANES> + Sync,
    ) {
        let batches = self.batches;
        let (h, weight) = (&state.h, &state.weight);
        let evaluated = Evaluated {
            k: &state.k,
            area: &state.area,
        };
        let pieces = split_lengths(&mut state.outer, batches.chunks.iter().map(|c| c.vertices.len()));
        parallel::for_each(pieces.into_iter().zip(&batches.chunks), |_, (outer, chunk)| {
            vectorized(
                #[inline(always)]
                || {
                    for batch in chunk.batches.clone() {
                        let vertex = &batches.vertex[batch];
                        let own = gather_scalar(h, vertex);
                        let mut sum = Simd::<LANES>::zero();
                        for slot in batches.slots(batch) {
                            let other = gather_scalar(h, &batches.neighbour[slot]);
                            sum += Simd(weight[slot]) * (own - other);
                        }
                        let residual = finish(sum, &evaluated, vertex, own);
                        for (l, &i) in vertex.iter().enumerate() {
                            outer[i as usize - chunk.vertices.start] = residual.0[l];
                        }
                    }
                },
            );
        });
    }

    /// The defect `max_i |R1_i| / sum_j |w_ij|` of the outer equation (a mean curvature: times a length it has no unit),
    /// and `|R1| / (|S| |H| + |load|)`, how much of the residual is more than cancellation.
    pub(crate) fn defect(&self, state: &State) -> (f64, f64) {
        let (mut worst, mut num, mut den) = (0.0f64, 0.0, 0.0);
        for i in 0..self.free() {
            let (mut absolute, mut size) = (0.0, 0.0);
            let (first, lane) = self.batches.place(i);
            for (k, &j) in self.rings.ring(i).iter().enumerate() {
                let w = state.weight[first + k][lane].abs();
                absolute += w;
                size += w * state.h[j as usize].abs();
            }
            size += absolute * state.h[i].abs();
            size += self
                .right_hand_side
                .load(state.h[i], state.k[i], state.area[i])
                .abs();
            worst = worst.max(state.outer[i].abs() / absolute.max(f64::MIN_POSITIVE));
            num += state.outer[i] * state.outer[i];
            den += size * size;
        }
        (worst, (num / den.max(f64::MIN_POSITIVE)).sqrt())
    }
}

/// What a right-hand side depends on.
struct Evaluated<'s> {
    k: &'s [f64],
    area: &'s [f64],
}
