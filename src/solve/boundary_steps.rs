//! A few steps with the preconditioned boundary operator.
//!
//! Where the preconditioner is good they are Richardson's, always as many: then a solve is linear in its right-hand side, which
//! acceleration counts on. Where it is not, they go to the least energy.

use nalgebra::{SMatrix, SVector};

/// At most so many.
pub(crate) const STEPS: usize = 8;
/// Richardson's steps,
const RICHARDSON: usize = 2;
/// if they leave no more than this part of what the boundary asks for, as square roots of energies.
const GAIN: f64 = 0.3;
/// To the least energy no more are taken when the energy of what the boundary still asks for falls below this part of the solution's, as
/// square roots.
const REST: f64 = 0.3;
/// Vectors at most.
const MOST: usize = STEPS + 1;

/// The solution among the sums of `x_0 = A r` and `v_j = A S_fb d_j`, of one column: `x_0 - v_1 - v_2`, or
/// the one of least energy `x . P x / 2 - x . r`. All products are taken on the boundary, where `W d_j = w_j` with
/// `W = S_bf A S_fb`.
pub(crate) struct Steps {
    /// `S_bf x_0`.
    rho: Vec<f64>,
    d: Vec<Vec<f64>>,
    w: Vec<Vec<f64>>,
    /// The products with `P` and with `r`.
    gram: SMatrix<f64, MOST, MOST>,
    right: SVector<f64, MOST>,
    /// Of `x_0` and the `v_j`.
    pub(crate) coefficients: Vec<f64>,
    /// What the boundary still asks for.
    pub(crate) rest: Vec<f64>,
    /// Whether to go to the least energy.
    is_least: bool,
}

impl Steps {
    /// Nothing but `x_0`, of this energy `x_0 . r` and this `rho`.
    pub(crate) fn new(energy: f64, rho: Vec<f64>) -> Self {
        let mut right = SVector::zeros();
        right[0] = energy;
        Self {
            rest: rho.clone(),
            rho,
            d: Vec::new(),
            w: Vec::new(),
            gram: SMatrix::identity(),
            right,
            coefficients: vec![1.0],
            is_least: false,
        }
    }

    /// Takes one more vector: `d`, and `w = W d`.
    pub(crate) fn add(&mut self, d: Vec<f64>, w: Vec<f64>, boundary_d: &[f64]) {
        let k = self.d.len() + 1;
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let weighted: Vec<f64> = w.iter().zip(boundary_d).map(|(w, d)| w * d).collect();
        let own_weighted: Vec<f64> = self.rho.iter().zip(boundary_d).map(|(r, d)| r * d).collect();
        self.gram[(0, 0)] = self.right[0] + product(&self.rho, &own_weighted);
        self.right[k] = product(&d, &self.rho);
        self.gram[(0, k)] = self.right[k] + product(&weighted, &self.rho);
        self.d.push(d);
        self.w.push(w);
        for j in 0..k {
            self.gram[(j + 1, k)] = product(&self.w[j], &self.d[k - 1]) + product(&self.w[j], &weighted);
        }
        for j in 0..k {
            self.gram[(k, j)] = self.gram[(j, k)];
        }
        if self.is_least {
            self.minimize();
        } else {
            self.coefficients.push(-1.0);
        }
        self.find_rest(boundary_d);
    }

    fn find_rest(&mut self, boundary_d: &[f64]) {
        self.rest = self.rho.iter().map(|r| r * self.coefficients[0]).collect();
        for (j, c) in self.coefficients[1..].iter().enumerate() {
            for (b, rest) in self.rest.iter_mut().enumerate() {
                *rest += c * (self.d[j][b] / boundary_d[b] + self.w[j][b]);
            }
        }
    }

    /// The coefficients of the least energy; that of the last vector is zero where it depends on the others.
    fn minimize(&mut self) {
        let count = self.d.len() + 1;
        self.coefficients.resize(count, 0.0);
        let scale: SVector<f64, MOST> = SVector::from_fn(|j, _| {
            let d = self.gram[(j, j)];
            if j < count && d > 0.0 { 1.0 / d.sqrt() } else { 1.0 }
        });
        let used = |j: usize| j < count;
        let scaled = SMatrix::<f64, MOST, MOST>::from_fn(|i, j| {
            let own = f64::from(u8::from(i == j));
            if used(i) && used(j) {
                self.gram[(i, j)] * scale[i] * scale[j] + 1e-12 * own
            } else {
                own
            }
        });
        let right =
            SVector::<f64, MOST>::from_fn(|j, _| if used(j) { self.right[j] * scale[j] } else { 0.0 });
        if let Some(factor) = scaled.cholesky() {
            let solution = factor.solve(&right);
            self.coefficients = (0..count).map(|j| solution[j] * scale[j]).collect();
        }
    }

    /// Whether these were enough, or nothing is a number.
    pub(crate) fn is_done(&mut self, boundary_d: &[f64]) -> bool {
        let energy = |r: &[f64]| r.iter().zip(boundary_d).map(|(r, d)| r * r * d).sum::<f64>();
        if !self.is_least {
            if self.d.len() < RICHARDSON {
                return false;
            }
            let (rest, first) = (energy(&self.rest), energy(&self.rho));
            if rest <= GAIN * GAIN * first || (rest + first).is_nan() {
                return true;
            }
            self.is_least = true;
            self.minimize();
            self.find_rest(boundary_d);
        }
        let rest = energy(&self.rest);
        let all = self.coefficients.iter().zip(self.right.iter());
        let all: f64 = all.map(|(c, r)| c * r).sum();
        rest <= REST * REST * all || (rest + all).is_nan()
    }
}
