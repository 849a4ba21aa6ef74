//! What the paper's scheme leaves to its user.

use crate::support::error::Error;
use crate::support::table::table;

/// How the harmonic mean curvature of 7.1 is estimated before the vertices are updated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Estimate {
    /// As the paper does: by turns one Gauss-Seidel iteration and this many conjugate gradient iterations.
    Alternating {
        /// `n` of the conjugate gradients; at least 1.
        iterations: usize,
    },
    /// Gauss-Seidel before every update.
    GaussSeidel {
        /// Iterations; at least 1.
        sweeps: usize,
    },
    /// Conjugate gradients with diagonal preconditioner before every update.
    ConjugateGradients {
        /// Iterations; at least 1.
        iterations: usize,
    },
}

table!(Estimate {
    0 "alternating" Estimate::Alternating { .. } => "by turns one Gauss-Seidel iteration and some of conjugate gradients", "";
    1 "gauss_seidel" Estimate::GaussSeidel { .. } => "Gauss-Seidel iterations", "";
    2 "conjugate_gradients" Estimate::ConjugateGradients { .. } => "conjugate gradient iterations", "";
});

impl Default for Estimate {
    fn default() -> Self {
        Self::Alternating { iterations: 10 }
    }
}

/// What the paper leaves to its user. It takes the paper's discretization and no other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaperOptions {
    /// The estimate of `H` (7.1). Default: alternating, 10 conjugate gradient iterations.
    pub estimate: Estimate,
    /// `s` of 7.5: the part of each normal step that is taken; the tangential step is taken whole. Default 0.9.
    /// Greater than 0, at most 1.
    pub damping: f64,
    /// Levels of the hierarchy (7.4), the given mesh included; 1: no hierarchy. Default 0: as many as make each
    /// level about four times as large as the one before.
    pub levels: usize,
    /// Vertices of the base mesh, boundary included. Default 0: two and a half times the boundary. The base has more
    /// where no further collapse is allowed.
    pub base: usize,
    /// Stop when the harmonic defect (see [`Report::defect`](crate::Report::defect)) is at most this. Default 1e-6.
    /// Greater than 0.
    pub defect: f64,
    /// And when `max_i |Delta_B H_i|`, times the region's diagonal to the third power, is at most this; below what the
    /// rounding of the positions makes of it, that counts, and the outcome says so. Default: infinite.
    pub laplacian: f64,
    /// At most this many updates of the mesh on all levels together. Default 20,000. At least 1.
    pub max_updates: usize,
}

impl Default for PaperOptions {
    fn default() -> Self {
        Self {
            estimate: Estimate::default(),
            damping: 0.9,
            levels: 0,
            base: 0,
            defect: 1e-6,
            laplacian: f64::INFINITY,
            max_updates: 20_000,
        }
    }
}

impl PaperOptions {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`Error::BadOption`], which names the option.
    pub fn validate(&self) -> Result<(), Error> {
        let check = Error::check_option;
        let (Estimate::Alternating { iterations: n }
        | Estimate::GaussSeidel { sweeps: n }
        | Estimate::ConjugateGradients { iterations: n }) = self.estimate;
        check("paper_estimate_iterations", 0.0, n > 0, "at least 1")?;
        let (s, defect, laplacian) = (self.damping, self.defect, self.laplacian);
        check(
            "paper_damping",
            s,
            s > 0.0 && s <= 1.0,
            "greater than 0 and at most 1",
        )?;
        check("paper_defect", defect, defect > 0.0, "greater than 0")?;
        check("paper_laplacian", laplacian, laplacian > 0.0, "greater than 0")?;
        check("paper_max_updates", 0.0, self.max_updates > 0, "at least 1")
    }
}
