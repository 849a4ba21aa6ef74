//! The first of the two second-order problems (paper 7.1 (I)): the mean curvature as a harmonic function between its
//! values on the boundary, `S H = right` with the matrix of (6), (7) frozen. `right` is zero, or an inhomogeneous
//! right-hand side (7.5). Solved by a few iterations only.

use nalgebra::Vector3;

use crate::discrete::equations::State;
use crate::discrete::target::RightHandSide;
use crate::discrete::valence_batches::ValenceBatches;
use crate::mesh::Rings;

/// A diagonal entry of `S` below this part of the sum of its absolute weights says nothing: the estimate stays as it is.
/// Half or double, of 3 cases: none changes.
pub(crate) const SMALLEST_DIAGONAL: f64 = 1e-6;

/// `S` on one level, and room for the iterations.
#[derive(Debug)]
pub(crate) struct Dirichlet<'a> {
    rings: &'a Rings,
    batches: &'a ValenceBatches,
    /// `w_ij`, ring after ring.
    weight: Vec<f64>,
    /// `S_ii`; zero where it is too small to divide by.
    diagonal: Vec<f64>,
    right_hand_side: RightHandSide,
    /// What `S H` has to be, per free vertex, at the surface evaluated last: zero for `Delta_B H = 0` (7.5).
    right: Vec<f64>,
    residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
}

impl<'a> Dirichlet<'a> {
    /// Room for the region of these rings.
    pub(crate) fn new(rings: &'a Rings, batches: &'a ValenceBatches, right_hand_side: RightHandSide) -> Self {
        let free = rings.free();
        Self {
            rings,
            batches,
            right_hand_side,
            weight: vec![0.0; rings.neighbour.values().len()],
            diagonal: vec![0.0; free],
            right: vec![0.0; free],
            residual: vec![0.0; free],
            direction: vec![0.0; free],
            image: vec![0.0; free],
        }
    }

    /// Takes the weights of the surface that `state` was evaluated at.
    pub(crate) fn refresh(&mut self, state: &State) {
        for i in 0..self.diagonal.len() {
            let (first, lane) = self.batches.place(i);
            let row = &mut self.weight[self.rings.neighbour.range(i)];
            let slots = &state.weight[first..first + row.len()];
            let (mut sum, mut absolute) = (0.0, 0.0);
            for (w, slot) in row.iter_mut().zip(slots) {
                *w = slot[lane];
                sum += *w;
                absolute += w.abs();
            }
            self.diagonal[i] = if sum > SMALLEST_DIAGONAL * absolute {
                sum
            } else {
                0.0
            };
            self.right[i] = -self.right_hand_side.load(state.h[i], state.k[i], state.area[i]);
        }
    }

    fn row(&self, i: usize) -> impl Iterator<Item = (f64, usize)> {
        let weights = self.weight[self.rings.neighbour.range(i)].iter();
        let row = weights.zip(self.rings.ring(i));
        row.map(|(&w, &j)| (w, j as usize))
    }

    /// By how much a Gauss-Seidel iteration at vertex `i` follows the curvature of neighbour `k` of its ring.
    pub(crate) fn share(&self, i: usize, k: usize) -> f64 {
        if self.diagonal[i] > 0.0 {
            self.weight[self.rings.neighbour.range(i)][k] / self.diagonal[i]
        } else {
            0.0
        }
    }

    /// One Gauss-Seidel iteration on `h` (free, boundary), vertex after vertex.
    pub(crate) fn gauss_seidel(&self, h: &mut [f64]) {
        for i in 0..self.diagonal.len() {
            if self.diagonal[i] > 0.0 {
                let sum: f64 = self.row(i).map(|(w, j)| w * h[j]).sum();
                h[i] = (sum + self.right[i]) / self.diagonal[i];
            }
        }
    }

    /// `n` conjugate gradient iterations on `h` (free, boundary) with the diagonal as preconditioner.
    pub(crate) fn conjugate_gradients(&mut self, h: &mut [f64], n: usize) {
        let free = self.diagonal.len();
        let mut residual = std::mem::take(&mut self.residual);
        let mut direction = std::mem::take(&mut self.direction);
        let mut image = std::mem::take(&mut self.image);
        for i in 0..free {
            let outer: f64 = self.row(i).map(|(w, j)| w * (h[i] - h[j])).sum();
            residual[i] = self.right[i] - outer;
            direction[i] = self.preconditioned(i, residual[i]);
        }
        let mut rho: f64 = (0..free).map(|i| residual[i] * direction[i]).sum();
        for _ in 0..n {
            let mut curvature = 0.0;
            for i in 0..free {
                let own = direction[i];
                let other = |j: usize| if j < free { direction[j] } else { 0.0 };
                image[i] = self.row(i).map(|(w, j)| w * (own - other(j))).sum();
                curvature += own * image[i];
            }
            let alpha = rho / curvature;
            // Solved, or rounding has taken over.
            if !(rho > 0.0 && curvature > 0.0 && alpha.is_finite()) {
                break;
            }
            let mut next = 0.0;
            for i in 0..free {
                h[i] += alpha * direction[i];
                residual[i] -= alpha * image[i];
                next += residual[i] * self.preconditioned(i, residual[i]);
            }
            let beta = next / rho;
            for i in 0..free {
                direction[i] = self.preconditioned(i, residual[i]) + beta * direction[i];
            }
            rho = next;
        }
        (self.residual, self.direction, self.image) = (residual, direction, image);
    }

    fn preconditioned(&self, i: usize, r: f64) -> f64 {
        if self.diagonal[i] > 0.0 {
            r / self.diagonal[i]
        } else {
            0.0
        }
    }

    /// How far the surface of `state` is from the equation.
    pub(crate) fn measure(&self, x: &[Vector3<f64>], state: &State, diagonal: f64) -> Residual {
        let reach = x.iter().fold(0.0f64, |m, p| m.max(p.amax()));
        let mut worst = Residual::default();
        for i in 0..self.diagonal.len() {
            let outer = state.outer[i].abs();
            let (mut absolute, mut shortest) = (0.0, f64::INFINITY);
            for (w, j) in self.row(i) {
                absolute += w.abs();
                shortest = shortest.min((x[j] - x[i]).norm_squared());
            }
            let scale = 1.5 / state.area[i].max(f64::MIN_POSITIVE);
            // A curvature is a second difference of positions that are known to half a unit in the last place.
            let noise = f64::EPSILON * reach / shortest.max(f64::MIN_POSITIVE) * absolute;
            let defect = outer / absolute.max(f64::MIN_POSITIVE) * diagonal;
            worst.defect = larger(worst.defect, defect);
            worst.laplacian = larger(worst.laplacian, outer * scale * diagonal.powi(3));
            worst.rounding = worst.rounding.max(noise * scale * diagonal.powi(3));
        }
        worst
    }
}

/// The maximum; what is not a number stays.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else {
        a.max(b)
    }
}

/// How far a surface is from the outer fairness equation; none of it has a unit.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Residual {
    /// `max_i |sum_j w_ij (H_i - H_j)| / sum_j |w_ij|`, times the diagonal.
    pub defect: f64,
    /// `max_i |Delta_B H_i|`, times the diagonal to the third power.
    pub laplacian: f64,
    /// Of that, what the rounding of the positions alone may make.
    pub rounding: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrete::equations::{Equations, FreeCurvature};
    use crate::discrete::inner_fairness::FairnessWeights;
    use crate::mesh::{RegionMesh, Selection};
    use fairmesh_shapes::{Sampling, sphere_cap};

    #[test]
    fn linear_functions_on_a_plane_are_harmonic_for_both_estimates() {
        let shape = sphere_cap(60.0, 300, Sampling::Irregular { seed: 3 }, 0);
        let flat: Vec<[f64; 3]> = shape.positions.iter().map(|p| [p[0], p[1], 0.0]).collect();
        let region = RegionMesh::new(&flat, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
        let (x, rings) = (region.positions(&flat), Rings::new(&region));
        let batches = ValenceBatches::new(&rings);
        let boundary_normals = vec![Vector3::z(); region.boundary];
        let equations = Equations {
            rings: &rings,
            batches: &batches,
            boundary_normals: &boundary_normals,
            smooth_interior: &[],
            weights: &FairnessWeights::uniform(),
            curvature: FreeCurvature::Paper,
            right_hand_side: RightHandSide::default(),
        };
        let mut state = State::new(&batches, region.boundary);
        equations.evaluate(&x, &mut state);
        let mut dirichlet = Dirichlet::new(&rings, &batches, RightHandSide::default());
        dirichlet.refresh(&state);
        let exact: Vec<f64> = x[..region.region_vertices()]
            .iter()
            .map(|p| 1.0 + 2.0 * p.x - p.y)
            .collect();
        let off = |h: &[f64]| {
            h.iter()
                .zip(&exact)
                .fold(0.0f64, |m, (a, b)| m.max((a - b).abs()))
        };
        let mut start = exact.clone();
        start[..region.free].fill(0.0);

        let mut h = start.clone();
        dirichlet.conjugate_gradients(&mut h, 200);
        assert!(off(&h) < 1e-10, "conjugate gradients: {}", off(&h));
        dirichlet.gauss_seidel(&mut h);
        assert!(off(&h) < 1e-10, "and they stay: {}", off(&h));

        let mut h = start;
        (0..2_000).for_each(|_| dirichlet.gauss_seidel(&mut h));
        assert!(off(&h) < 1e-10, "Gauss-Seidel: {}", off(&h));
    }
}
