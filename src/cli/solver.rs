//! The choice of the solver, and what the paper's own scheme can be told.

use clap::{Args, ValueEnum};
use fairmesh::{Estimate, PaperOptions, Solver};

use crate::failure::Failure;

/// How the equations are solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// Quasi-Newton steps on both equations together
    Fast,
    /// The scheme of Schneider and Kobbelt 2001, with their
    /// discretization; slow
    #[value(verbatim_doc_comment)]
    Paper,
}

/// Flags of both.
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
    solver: Kind,
    /// Levels of the hierarchy, 1: none, 0: as many as fit
    /// [default: 0]
    #[arg(long, value_name = "N", help_heading = "Solver paper", verbatim_doc_comment)]
    levels: Option<usize>,
    /// Part of each normal step that is taken, between 0 and 1
    /// [default: 0.9]
    #[arg(long, value_name = "S", help_heading = "Solver paper", verbatim_doc_comment)]
    damping: Option<f64>,
    /// Conjugate gradient iterations before every other update
    /// [default: 10]
    #[arg(long, value_name = "N", help_heading = "Solver paper", verbatim_doc_comment)]
    cg: Option<usize>,
    /// Stop at this harmonic defect [default: 1e-6]
    #[arg(long, value_name = "X", help_heading = "Solver paper")]
    defect: Option<f64>,
}

impl SolverArgs {
    /// The solver for the library; `max_iterations` is the flag of that name.
    ///
    /// # Errors
    /// Flags of the paper's scheme without it.
    pub fn solver(&self, max_iterations: Option<usize>) -> Result<Solver, Failure> {
        if self.solver == Kind::Fast {
            let given = [
                ("--levels", self.levels.is_some()),
                ("--damping", self.damping.is_some()),
                ("--cg", self.cg.is_some()),
                ("--defect", self.defect.is_some()),
            ];
            return match given.iter().find(|(_, is_given)| *is_given) {
                Some((flag, _)) => Err(Failure::new(format!("{flag} is for --solver paper only"))),
                None => Ok(Solver::Fast),
            };
        }
        let defaults = PaperOptions::default();
        Ok(Solver::Paper(PaperOptions {
            estimate: self
                .cg
                .map_or(defaults.estimate, |iterations| Estimate::Alternating {
                    iterations,
                }),
            damping: self.damping.unwrap_or(defaults.damping),
            levels: self.levels.unwrap_or(defaults.levels),
            defect: self.defect.unwrap_or(defaults.defect),
            max_updates: max_iterations.unwrap_or(defaults.max_updates),
            ..defaults
        }))
    }
}
