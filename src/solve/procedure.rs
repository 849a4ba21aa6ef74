//! What an attempt consists of: a sequence of runs, each judged before the next is chosen.

use nalgebra::Vector3;

use super::candidate::Candidate;
use super::control::Control;
use super::family::Family;
use super::formulation::Formulation;
use super::iterate_options::IterateOptions;
use super::regain::Regain;
use super::system::System;
use super::target_continuation::TargetContinuation;
use super::weight_repair::{Anew, WeightRepair};
use crate::solve::transition::Transition;

/// How an attempt gets from its start to a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Procedure {
    /// One iteration.
    Iteration,
    /// An iteration, and again with repaired weights where triangles end folded or thin.
    WeightRepair,
    /// The same, beginning at the surface given each time.
    RepairHere,
    /// The same, and from a sound surface once more with the inner fairness that is asked for.
    Regain,
    /// Iterations along parts of the right-hand side.
    TargetContinuation,
    /// The same as [`Self::WeightRepair`], with minimal energy as the target.
    MinimalEnergy,
    /// Members of the family between the harmonic equation and minimal energy, towards harmonic.
    Approach,
    /// The member of the family that the coarse mesh has, or one further from harmonic.
    Retreat,
}

/// A procedure under way.
#[derive(Debug)]
pub(crate) enum Underway {
    /// A single run.
    Single,
    /// See [`Procedure::WeightRepair`].
    WeightRepair(Box<WeightRepair>),
    /// See [`Procedure::Regain`].
    Regain(Box<Regain>),
    /// See [`Procedure::TargetContinuation`].
    TargetContinuation(Box<TargetContinuation>),
    /// See [`Procedure::Approach`] and [`Procedure::Retreat`].
    Family(Box<Family>),
}

impl Procedure {
    /// Begins at `x`; `member` is the coarse mesh's, for [`Self::Retreat`].
    pub(crate) fn begin(
        self,
        formulation: Formulation,
        x: Vec<Vector3<f64>>,
        options: IterateOptions,
        member: f64,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> (Underway, Transition) {
        match self {
            Self::Iteration => (
                Underway::Single,
                Transition::iterate(system, formulation, x, options, control),
            ),
            Self::WeightRepair | Self::MinimalEnergy | Self::RepairHere => {
                let anew = match self {
                    Self::RepairHere => Anew::FromSurface,
                    _ => Anew::FromLinear,
                };
                let formulation = match self {
                    Self::MinimalEnergy => formulation.member(1.0),
                    _ => formulation,
                };
                let (repair, next) = WeightRepair::begin(formulation, x, options, anew, system, control);
                (Underway::WeightRepair(Box::new(repair)), next)
            }
            Self::Regain => {
                let (regain, next) = Regain::begin(formulation, x, options, system, control);
                (Underway::Regain(Box::new(regain)), next)
            }
            Self::TargetContinuation => {
                let (continuation, next) =
                    TargetContinuation::begin(formulation, x, options, system, control);
                (Underway::TargetContinuation(Box::new(continuation)), next)
            }
            Self::Approach => {
                let (family, next) = Family::approach(formulation, x, options, system, control);
                (Underway::Family(Box::new(family)), next)
            }
            Self::Retreat => {
                let (family, next) = Family::retreat(formulation, x, options, member, system, control);
                (Underway::Family(Box::new(family)), next)
            }
        }
    }
}

impl Underway {
    /// After a run that led to `last`.
    pub(crate) fn next(
        &mut self,
        last: Candidate,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Transition {
        match self {
            Self::Single => Transition::Done(last),
            Self::WeightRepair(repair) => repair.next(last, system, control),
            Self::Regain(regain) => regain.next(last, system, control),
            Self::TargetContinuation(continuation) => continuation.next(last, system, control),
            Self::Family(family) => family.next(last, system, control),
        }
    }
}
