//! What the paper's scheme leaves to its user.

use crate::support::error::Error;
use crate::support::options::options;
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

options! {
    /// What the paper leaves to its user. It takes the paper's discretization and no other.
    #[derive(Debug, Clone, Copy, PartialEq)]
    PaperOptions {
        /// How the scheme estimates `H` (paper 7.1). For the solver `paper` only, as all that follow. Default: alternating, with 10
        /// conjugate gradient iterations.
        estimate "paper_estimate": Estimate = Estimate::default(), choice "fairmesh_estimate";
        /// The part of each normal step that is taken (`s` of paper 7.5); the tangential step is taken whole. Default 0.9. Greater than 0,
        /// at most 1.
        damping "paper_damping": f64 = 0.9, real "1" in f64::MIN_POSITIVE..=1.0, "greater than 0 and at most 1";
        /// Levels of the hierarchy (paper 7.4), the given mesh included; 1: no hierarchy. Default 0: as many as make each level about four
        /// times as large as the one before.
        levels "paper_levels": usize = 0, count "levels";
        /// Vertices of the base mesh, boundary included. Default 0: two and a half times the boundary. The base has more where no further
        /// collapse is allowed.
        base "paper_base": usize = 0, count "vertices";
        /// Stop when the harmonic defect (`defect` of the report) is at most this. Default 1e-6. Greater than 0.
        defect "paper_defect": f64 = 1e-6, real "1" in f64::MIN_POSITIVE.., "greater than 0";
        /// And when `max |Delta_B H|` times the cube of the region's diagonal is at most this; below what the rounding of the positions
        /// makes of it, that counts, and the outcome says so. Default: infinite. Greater than 0.
        laplacian "paper_laplacian": f64 = f64::INFINITY, real "1" in f64::MIN_POSITIVE.., "greater than 0";
        /// At most this many updates of the mesh on all levels together. Default 20000. At least 1.
        max_updates "paper_max_updates": usize = 20_000, count "updates" in 1.0.., "at least 1";
    }
}

impl PaperOptions {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`Error::BadOption`], which names the option.
    pub fn validate(&self) -> Result<(), Error> {
        let (Estimate::Alternating { iterations: n }
        | Estimate::GaussSeidel { sweeps: n }
        | Estimate::ConjugateGradients { iterations: n }) = self.estimate;
        Error::check_option("paper_estimate_iterations", 0.0, n > 0, "at least 1")?;
        self.check_ranges()
    }
}
