//! `phi = Delta_B H` at fixed vertices inside that the surface passes smoothly.
//!
//! Only the place of such a vertex is prescribed: `phi` goes through it as it goes through free vertices, `(S phi) = 0` there, too.
//! Were it held at zero, a surface that solves the equation would not stay one when some of its vertices are fixed. The factor at hand is that
//! of `S` between free vertices; conjugate gradients account for the rest.

use super::factor::Factor;
use crate::discrete::equations::{Equations, State};

/// Steps of conjugate gradients after an evaluation: `phi` is nearly harmonic from the one before.
const STEPS: usize = 12;
/// Until what is left has fallen to this part in squares.
const REDUCTION: f64 = 1e-8;

/// A free neighbour, and where its ring has the weight of the edge.
type Beside = (u32, usize, usize);

/// The vertices that are passed, with their free neighbours.
#[derive(Debug, Default)]
pub(super) struct PassedVertices(Vec<(u32, Vec<Beside>)>);

impl PassedVertices {
    /// Those of a region.
    pub(super) fn new(equations: &Equations<'_>) -> Self {
        let free = equations.free();
        if equations.smooth_interior.is_empty() {
            return Self::default();
        }
        let mut rows = vec![Vec::new(); equations.smooth_interior.len()];
        for i in 0..free {
            let (slot, lane) = equations.batches.place(i);
            for (k, &j) in equations.rings.ring(i).iter().enumerate() {
                if let Some(b) = (j as usize).checked_sub(free)
                    && equations.is_smooth_interior(b)
                {
                    rows[b].push((i as u32, slot + k, lane));
                }
            }
        }
        let passed = rows.into_iter().enumerate().filter(|(_, row)| !row.is_empty());
        Self(passed.map(|(b, row)| ((free + b) as u32, row)).collect())
    }

    /// Whether there are none.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Takes at each of them the mean of its free neighbours, as `S` weighs them.
    fn pass(&self, state: &State, phi: &mut [f64]) {
        for (p, row) in &self.0 {
            let (mut sum, mut total) = (0.0, 0.0);
            for &(j, slot, lane) in row {
                let weight = state.weight[slot][lane];
                sum += weight * phi[j as usize];
                total += weight;
            }
            phi[*p as usize] = if total > 0.0 { sum / total } else { 0.0 };
        }
    }

    /// Makes `phi` harmonic at the free vertices and at those that are passed; at the other vertices of the boundary it stays.
    pub(super) fn make_harmonic(
        &self,
        equations: &Equations<'_>,
        state: &State,
        factor: &mut Factor,
        phi: &mut [f64],
    ) {
        let free = equations.free();
        let product = |phi: &mut [f64], into: &mut [[f64; 1]]| {
            self.pass(state, phi);
            equations.laplacian(state, phi, into);
        };
        let dot = |a: &[[f64; 1]], b: &[[f64; 1]]| -> f64 { a.iter().zip(b).map(|([a], [b])| a * b).sum() };
        let mut left = vec![[0.0]; free];
        product(phi, &mut left);
        left.iter_mut().for_each(|[r]| *r = -*r);
        let mut solved = left.clone();
        factor.solve(&mut solved);
        let mut size = dot(&left, &solved);
        let least = REDUCTION * size;
        let mut direction = vec![0.0; phi.len()];
        let mut image = vec![[0.0]; free];
        let mut turn = 0.0;
        for _ in 0..STEPS {
            if size.is_nan() || size <= least.max(f64::MIN_POSITIVE) {
                break;
            }
            let steps = direction[..free].iter_mut().zip(&solved);
            steps.for_each(|(d, [s])| *d = s + turn * *d);
            product(&mut direction, &mut image);
            let along: f64 = direction.iter().zip(&image).map(|(d, [i])| d * i).sum();
            if along.is_nan() || along <= 0.0 {
                break;
            }
            let length = size / along;
            phi.iter_mut()
                .zip(&direction)
                .for_each(|(phi, d)| *phi += length * d);
            left.iter_mut()
                .zip(&image)
                .for_each(|([r], [i])| *r -= length * i);
            solved.clone_from(&left);
            factor.solve(&mut solved);
            let next = dot(&left, &solved);
            (turn, size) = (next / size, next);
        }
    }
}
