//! A factored matrix in the precision that its condition asks for.

use std::sync::Arc;

use fairmesh_linear::cholesky::{Cholesky, NotPositiveDefinite, SolveWork, UpdateStacks};
use fairmesh_linear::symbolic::Symbolic;

/// Single precision halves the memory traffic of a solve; it suffices wherever the solution is refined or only a
/// direction.
pub(crate) enum Factor {
    /// 32-bit factor.
    Single(Cholesky<f32>, SolveWork<f32>),
    /// 64-bit factor.
    Double(Cholesky<f64>, SolveWork<f64>),
}

/// The memory that factorizations need, kept for the next one.
#[derive(Debug, Default)]
pub(crate) struct Stacks {
    /// Of 32-bit ones.
    pub(crate) single: UpdateStacks<f32>,
    /// Of 64-bit ones.
    pub(crate) double: UpdateStacks<f64>,
}

/// A matrix that should be positive definite is not: the surface behind it has collapsed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Collapsed;

impl Factor {
    /// Room for a factor.
    pub(crate) fn new(symbolic: &Arc<Symbolic>, double: bool) -> Self {
        if double {
            Self::Double(Cholesky::new(symbolic.clone()), SolveWork::default())
        } else {
            Self::Single(Cholesky::new(symbolic.clone()), SolveWork::default())
        }
    }

    /// Factors the matrix with these values.
    pub(crate) fn factor(&mut self, values: &[f64], stacks: &mut Stacks) -> Result<(), NotPositiveDefinite> {
        match self {
            Self::Single(c, _) => c.factor_in(values, &mut stacks.single),
            Self::Double(c, _) => c.factor_in(values, &mut stacks.double),
        }
    }

    /// Solves in place.
    pub(crate) fn solve<const K: usize>(&mut self, x: &mut [[f64; K]]) {
        match self {
            Self::Single(c, work) => c.solve(x, work),
            Self::Double(c, work) => c.solve(x, work),
        }
    }

    /// Whether this is the 64-bit one.
    pub(crate) fn is_double(&self) -> bool {
        matches!(self, Self::Double(..))
    }
}
