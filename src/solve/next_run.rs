//! How an attempt goes on after an iteration.

use nalgebra::Vector3;

use super::candidate::Candidate;
use super::control::Control;
use super::formulation::Formulation;
use super::iterate_options::IterateOptions;
use super::quasi_newton::Iteration;
use super::result::SolveStatus;
use super::system::System;

/// How an attempt goes on.
#[derive(Debug)]
pub(crate) enum Next {
    /// With this iteration.
    Iteration(Box<Iteration>),
    /// It is over, with this surface.
    Done(Candidate),
    /// It is over, with this surface of member `w` of the family.
    Member(Candidate, f64),
    /// It is over, without a surface: so far it came.
    Short(SolveStatus),
}

impl Next {
    /// With an iteration from `x`.
    pub(crate) fn iterate(
        system: &System,
        formulation: Formulation,
        x: Vec<Vector3<f64>>,
        options: IterateOptions,
        control: &Control<'_>,
    ) -> Self {
        Self::Iteration(Box::new(Iteration::new(system, formulation, x, options, control)))
    }
}
