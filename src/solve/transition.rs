//! How an attempt goes on after an iteration.

use nalgebra::Vector3;

use crate::solve::candidate::Candidate;
use crate::solve::control::Control;
use crate::solve::formulation::Formulation;
use crate::solve::iterate_options::IterateOptions;
use crate::solve::quasi_newton::Iteration;
use crate::solve::result::SolveStatus;
use crate::solve::system::System;

/// How an attempt goes on.
#[derive(Debug)]
pub(crate) enum Transition {
    /// With this iteration.
    Iteration(Box<Iteration>),
    /// It is over, with this surface.
    Done(Candidate),
    /// It is over, with this surface of member `w` of the family.
    Member(Candidate, f64),
    /// It is over, without a surface: so far it came.
    Short(SolveStatus),
}

impl Transition {
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
