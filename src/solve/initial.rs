//! The start surface, made from connectivity and boundary data alone, so that the result does not depend on the input's
//! interior: a membrane, a linear clamped bilaplacian on its metric with the G1 data as conormal flux, and a few
//! tangential steps.

use nalgebra::Vector3;

use super::bilaplacian::conormal_flux;
use super::control::{Control, LINEAR};
use super::domain::Domain;
use super::factor::Collapsed;
use super::formulation::Formulation;
use super::limited_step::{LARGEST_CHANGE, advance_limited};
use super::problem::diagonal;
use super::system::System;

/// Linear systems are solved to this, in the norm of their own energy. They only make a start, but what is decided there
/// about thin triangles ought not to depend on the order of elimination.
/// Of 128 cases, half: 5 change by up to 8e-6 edges; double: 7 change by up to 0.1 edges.
const REFINED: f64 = 1e-7;
/// More iterations than this say that 32 bits do not suffice.
/// Of 128 cases, half: 1 changes by up to 8e-6 edges; double: 1 changes by up to 5e-6 edges.
const MOST_ITERATIONS: usize = 16;
/// So does a step longer than this. A step of conjugate gradients is at most `1 / l` long, `l` the least eigenvalue of the
/// preconditioned matrix, 1 for an exact factor: in some low mode the normal step would be too short by this factor or more.
/// Half or double, of 127 cases: none changes.
const LONGEST_STEP: f64 = 4.5;
/// Tangential steps before the first normal step.
/// Of 128 cases, half: 82 change by up to 3 edges, 4 get another triangulation, +1 % iterations;
/// double: 35 change by up to 3 edges, 4 get another triangulation, -2 % iterations, 1 fails.
const TANGENTIAL_STEPS: usize = 4;
/// What it is called in progress reports.
pub(crate) const PHASE: &str = "start surface";

impl System {
    /// The start: linear surface and tangential steps.
    pub(crate) fn start(
        &mut self,
        formulation: &Formulation,
        control: &mut Control<'_>,
    ) -> Result<Vec<Vector3<f64>>, Collapsed> {
        let mut x = self.linear_surface(formulation, control)?;
        self.diagonal = diagonal(&x);
        control.phase(LINEAR, PHASE);
        self.tangential_steps(&mut x, formulation, control);
        Ok(x)
    }

    /// The linear surface: `S_I D (S x - F) = 0` with the fixed positions and the conormal flux `F` of the boundary normals,
    /// on the metric of connectivity alone. (On the metric of a membrane a tube would pinch: its membrane is a thread,
    /// and a thread is conformally endless.)
    /// Where the run is stopped meanwhile, it is a surface on the way there.
    pub(crate) fn linear_surface(
        &mut self,
        formulation: &Formulation,
        control: &mut Control<'_>,
    ) -> Result<Vec<Vector3<f64>>, Collapsed> {
        self.factor_connectivity(formulation)?;
        self.linear_solve(control)
    }

    /// Makes `P` of the metric of connectivity alone.
    pub(super) fn factor_connectivity(&mut self, formulation: &Formulation) -> Result<(), Collapsed> {
        let mut metric = std::mem::take(&mut self.metric);
        let Domain {
            region,
            rings,
            batches,
            lengths,
            ..
        } = &*self.domain;
        match lengths {
            Some(lengths) => metric.of_lengths(region, rings, lengths),
            None => metric.combinatorial(rings, batches, &formulation.weights),
        }
        self.metric = metric;
        self.refactor()
    }

    /// Solves on the metric that `P` is factored on, by conjugate gradients with that factor.
    fn linear_solve(&mut self, control: &mut Control<'_>) -> Result<Vec<Vector3<f64>>, Collapsed> {
        let domain = self.domain.clone();
        let Domain {
            region, rings, input, ..
        } = &*domain;
        let free = region.free;
        let flux = conormal_flux(region, rings, input, self.boundary_normals());
        let mut x = vec![[0.0; 3]; region.region_vertices()];
        for (x, p) in x[free..].iter_mut().zip(&input[free..]) {
            *x = (*p).into();
        }
        let mut scratch = x.clone();
        let mut right = vec![[0.0; 3]; free];
        self.metric
            .apply(rings, &x, Some(&flux), &mut scratch, &mut right);
        for r in right.as_flattened_mut() {
            *r = -*r;
        }
        if !self.conjugate_gradients(&right, &mut x, control) {
            self.refactor_double()?;
            if !self.conjugate_gradients(&right, &mut x, control) {
                return Err(Collapsed);
            }
        }
        let fixed = domain.surface()[free..].iter();
        Ok(x[..free]
            .iter()
            .map(|p| Vector3::from(*p))
            .chain(fixed.copied())
            .collect())
    }

    /// Solves `P x = right` at the free vertices, column by column side by side, with the factor as preconditioner: it
    /// is inexact in its lowest modes only. Returns whether all columns have met [`REFINED`], or the run was stopped.
    fn conjugate_gradients(
        &mut self,
        right: &[[f64; 3]],
        x: &mut [[f64; 3]],
        control: &mut Control<'_>,
    ) -> bool {
        let free = right.len();
        let mut scratch = vec![[0.0; 3]; x.len()];
        let mut direction = vec![[0.0; 3]; x.len()];
        let mut image = vec![[0.0; 3]; free];
        let mut residual = right.to_vec();
        let mut preconditioned = right.to_vec();
        self.solve_p(&mut preconditioned);
        x[..free].fill([0.0; 3]);
        direction[..free].copy_from_slice(&preconditioned);
        let mut rho = products(&residual, &preconditioned);
        let first = rho;
        for _ in 0..MOST_ITERATIONS {
            if !control.checkpoint(PHASE) {
                return true;
            }
            self.metric
                .apply(&self.domain.rings, &direction, None, &mut scratch, &mut image);
            let curvature = products(&direction[..free], &image);
            let alpha = ratios(rho, curvature);
            if !self.is_double() && alpha.iter().any(|&a| a > LONGEST_STEP) {
                return false;
            }
            add_scaled(&mut x[..free], alpha, &direction[..free]);
            add_scaled(&mut residual, alpha.map(|a| -a), &image);
            preconditioned.copy_from_slice(&residual);
            self.solve_p(&mut preconditioned);
            let next = products(&residual, &preconditioned);
            if !next.iter().all(|r| r.is_finite()) {
                return false;
            }
            if (0..3).all(|c| next[c].abs() <= REFINED * REFINED * first[c].abs()) {
                return true;
            }
            let beta = ratios(next, rho);
            for (d, p) in direction.iter_mut().zip(&preconditioned) {
                for c in 0..3 {
                    d[c] = p[c] + beta[c] * d[c];
                }
            }
            rho = next;
        }
        false
    }

    /// Tangential steps alone, each as long as the edges allow.
    pub(crate) fn tangential_steps(
        &mut self,
        x: &mut [Vector3<f64>],
        formulation: &Formulation,
        control: &mut Control<'_>,
    ) {
        // They were factored before, so that they can be again.
        let _ = self.factor_inner(&formulation.weights);
        let mut step = vec![0.0; 3 * self.free()];
        for _ in 0..TANGENTIAL_STEPS {
            if !control.checkpoint(PHASE) {
                return;
            }
            self.evaluate_inner(x, formulation);
            self.inner_step(&mut step);
            let change = self.edge_change(x, &step);
            advance_limited(x, &step, change, LARGEST_CHANGE);
            if change < 0.01 {
                break;
            }
        }
    }
}

fn products(a: &[[f64; 3]], b: &[[f64; 3]]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (a, b) in a.iter().zip(b) {
        for c in 0..3 {
            sum[c] += a[c] * b[c];
        }
    }
    sum
}

/// Column by column; a column that is solved exactly has nothing to add.
fn ratios(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| if b[c] > 0.0 { a[c] / b[c] } else { 0.0 })
}

fn add_scaled(x: &mut [[f64; 3]], scale: [f64; 3], y: &[[f64; 3]]) {
    for (x, y) in x.iter_mut().zip(y) {
        for c in 0..3 {
            x[c] += scale[c] * y[c];
        }
    }
}
