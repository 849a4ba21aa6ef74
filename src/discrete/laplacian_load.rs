//! `phi = Delta_B H` as an unknown of its own: the product `S phi`, and its part in the outer equation.

use super::equations::{Equations, State};
use super::valence_batches::CHUNK;
use crate::mesh::Rings;
use fairmesh_linear::parallel;
use fairmesh_linear::sparse::SymmetricPattern;

impl Equations<'_> {
    /// `(S phi)_i` at the free vertices, with the weights of `state`; `phi` has a number for each vertex of the region.
    pub(crate) fn laplacian(&self, state: &State, phi: &[f64], product: &mut [[f64; 1]]) {
        parallel::for_each(product.chunks_mut(CHUNK), |chunk, product| {
            for (k, sum) in product.iter_mut().enumerate() {
                let i = chunk * CHUNK + k;
                let (first, lane) = self.batches.place(i);
                let ring = self.rings.ring(i).iter().enumerate();
                *sum = [ring
                    .map(|(k, &j)| state.weight[first + k][lane] * (phi[i] - phi[j as usize]))
                    .sum()];
            }
        });
    }

    /// `(2 A / 3) phi`, the summand of `R1` (see [`super::target`]), at the free vertices.
    pub(crate) fn add_load(state: &mut State, phi: &[f64]) {
        let vertices = state.outer.iter_mut().zip(&state.area).zip(phi);
        vertices.for_each(|((outer, area), phi)| *outer += 2.0 / 3.0 * area * phi);
    }

    /// The values of `S` between free vertices, on the pattern of their one-rings.
    pub(crate) fn free_laplacian(&self, state: &State, pattern: &SymmetricPattern) -> Vec<f64> {
        let rings: &Rings = self.rings;
        let free = self.free();
        let mut values = vec![0.0; pattern.column.len()];
        for i in 0..free {
            let (first, lane) = self.batches.place(i);
            let mut total = 0.0;
            for (k, &j) in rings.ring(i).iter().enumerate() {
                let weight = state.weight[first + k][lane];
                total += weight;
                if (j as usize) < i
                    && let Ok(c) = pattern.row(i).binary_search(&j)
                {
                    values[pattern.start[i] + c] = -weight;
                }
            }
            values[pattern.start[i + 1] - 1] = total;
        }
        values
    }
}
