//! The choice of the solver, and what the paper's own scheme can be told.

use clap::{Args, ValueEnum};
use fairmesh::{Estimate, PaperOptions, SolverKind};

use crate::failure::Failure;

/// How the equations are solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SolverName {
    /// Quasi-Newton steps on both equations together
    Fast,
    /// The scheme of Schneider and Kobbelt 2001, with their
    /// discretization; slow
    #[value(verbatim_doc_comment)]
    Paper,
}

/// How the paper's scheme estimates the mean curvature before every update.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum EstimateKind {
    /// Conjugate gradients and Gauss-Seidel by turns
    Alternating,
    /// Gauss-Seidel
    GaussSeidel,
    /// Conjugate gradients
    ConjugateGradients,
}

/// The solver and its own flags.
#[derive(Debug, Args)]
pub struct SolverArgs {
    /// How the equations are solved
    #[arg(
        long,
        value_enum,
        value_name = "WHICH",
        default_value = "fast",
        help_heading = "Solver"
    )]
    solver: SolverName,
    /// Stop after this many iterations of the solver fast [default: 500]
    #[arg(long, value_name = "N", help_heading = "Solver")]
    pub max_iterations: Option<usize>,
    #[command(flatten)]
    paper: Option<PaperArgs>,
}

/// Flags of the paper's scheme.
#[derive(Debug, Args)]
#[command(next_help_heading = "Solver paper")]
struct PaperArgs {
    /// How the mean curvature is estimated before every update
    #[arg(long, value_name = "HOW", value_enum, default_value_t = EstimateKind::Alternating)]
    paper_estimate: EstimateKind,
    /// Iterations of the estimate
    #[arg(long, value_name = "N", default_value_t = usual_iterations())]
    paper_estimate_iterations: usize,
    /// Part of each normal step that is taken, between 0 and 1
    #[arg(long, value_name = "S", default_value_t = PaperOptions::default().damping)]
    paper_damping: f64,
    /// Levels of the hierarchy, 1: none, 0: as many as fit
    #[arg(long, value_name = "N", default_value_t = PaperOptions::default().levels)]
    paper_levels: usize,
    /// Vertices of the coarsest level, 0: two and a half times
    /// the boundary
    #[arg(long, value_name = "N", default_value_t = PaperOptions::default().base, verbatim_doc_comment)]
    paper_base: usize,
    /// Stop at this harmonic defect
    #[arg(long, value_name = "X", default_value_t = PaperOptions::default().defect)]
    paper_defect: f64,
    /// And at this largest Laplacian of the mean curvature, times
    /// the cube of the region's diagonal
    #[arg(long, value_name = "X", default_value_t = PaperOptions::default().laplacian, verbatim_doc_comment)]
    paper_laplacian: f64,
    /// Stop after this many updates on all levels together
    #[arg(long, value_name = "N", default_value_t = PaperOptions::default().max_updates)]
    paper_max_updates: usize,
}

/// Iterations of the library's own choice of estimate.
fn usual_iterations() -> usize {
    let (Estimate::Alternating { iterations }
    | Estimate::GaussSeidel { sweeps: iterations }
    | Estimate::ConjugateGradients { iterations }) = Estimate::default();
    iterations
}

impl SolverArgs {
    /// The solver for the library.
    ///
    /// # Errors
    /// Flags of the other solver.
    pub fn solver(&self) -> Result<SolverKind, Failure> {
        match (self.solver, &self.paper) {
            (SolverName::Fast, None) => Ok(SolverKind::Fast),
            (SolverName::Fast, Some(_)) => Err(Failure::new(
                "what begins with --paper- is for --solver paper only",
            )),
            (SolverName::Paper, _) if self.max_iterations.is_some() => Err(Failure::new(
                "--max-iterations is for --solver fast only; the paper's scheme has --paper-max-updates",
            )),
            (SolverName::Paper, paper) => Ok(SolverKind::Paper(
                paper.as_ref().map(PaperArgs::options).unwrap_or_default(),
            )),
        }
    }
}

impl PaperArgs {
    fn options(&self) -> PaperOptions {
        let iterations = self.paper_estimate_iterations;
        PaperOptions {
            estimate: match self.paper_estimate {
                EstimateKind::Alternating => Estimate::Alternating { iterations },
                EstimateKind::GaussSeidel => Estimate::GaussSeidel { sweeps: iterations },
                EstimateKind::ConjugateGradients => Estimate::ConjugateGradients { iterations },
            },
            damping: self.paper_damping,
            levels: self.paper_levels,
            base: self.paper_base,
            defect: self.paper_defect,
            laplacian: self.paper_laplacian,
            max_updates: self.paper_max_updates,
        }
    }
}
