//! What an attempt consists of: a sequence of runs, each judged before the next is chosen.

use nalgebra::Vector3;

use super::candidate::Candidate;
use super::control::Control;
use super::family::Family;
use super::normal_continuation::NormalContinuation;
use super::pseudo_time::{FlowStatus, PseudoTime};
use super::quasi_newton::{IterateOptions, Iteration, IterationStatus};
use super::result::SolveStatus;
use super::system::System;
use super::target_continuation::TargetContinuation;
use super::weight_repair::{Anew, WeightRepair};

/// Something that iterates.
#[derive(Debug)]
pub(crate) enum Run {
    /// Quasi-Newton steps.
    Iteration(Box<Iteration>),
    /// Pseudo-time, and quasi-Newton steps from where it leads.
    Flow(PseudoTime, IterateOptions),
}

impl Run {
    /// Quasi-Newton steps from `x`.
    pub(crate) fn iterate(
        system: &System,
        x: Vec<Vector3<f64>>,
        options: IterateOptions,
        control: &Control<'_>,
    ) -> Self {
        Self::Iteration(Box::new(Iteration::new(system, x, options, control)))
    }

    /// The surface at which the system stands evaluated, once it is begun.
    pub(crate) fn x(&self) -> &[Vector3<f64>] {
        match self {
            Self::Iteration(iteration) => &iteration.x,
            Self::Flow(flow, _) => &flow.x,
        }
    }

    /// The same, taken out.
    pub(crate) fn into_x(self) -> Vec<Vector3<f64>> {
        match self {
            Self::Iteration(iteration) => iteration.x,
            Self::Flow(flow, _) => flow.x,
        }
    }

    /// What comes before the first iteration. Returns what it has led to if that is as far as it goes.
    pub(crate) fn begin(&mut self, system: &mut System, control: &mut Control<'_>) -> Option<Candidate> {
        match self {
            Self::Iteration(iteration) => {
                let status = iteration.begin(system, control)?;
                Some(iteration.candidate(status, system))
            }
            Self::Flow(flow, _) => {
                system.evaluate(&flow.x);
                None
            }
        }
    }

    /// One iteration. Returns what the run has led to, if that was the last.
    pub(crate) fn advance(&mut self, system: &mut System, control: &mut Control<'_>) -> Option<Candidate> {
        match self {
            Self::Iteration(iteration) => {
                let status = iteration.advance(system, control)?;
                Some(iteration.candidate(status, system))
            }
            Self::Flow(flow, options) => {
                let status = match flow.advance(system, control)? {
                    FlowStatus::Reached => {
                        let x = std::mem::take(&mut flow.x);
                        *self = Self::iterate(system, x, *options, control);
                        return self.begin(system, control);
                    }
                    FlowStatus::Stalled => IterationStatus::Stalled,
                    FlowStatus::Stopped => IterationStatus::Stopped,
                };
                Some(Candidate::new(system, flow.x.clone(), status, f64::NAN))
            }
        }
    }
}

/// How an attempt goes on.
#[derive(Debug)]
pub(crate) enum Next {
    /// With this.
    Run(Run),
    /// It is over, with this surface.
    Done(Candidate),
    /// It is over, with this surface of member `w` of the family.
    Member(Candidate, f64),
    /// It is over, without a surface: so far it came.
    Short(SolveStatus),
}

/// How an attempt gets from its start to a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Procedure {
    /// One iteration.
    Iteration,
    /// An iteration, and again with repaired weights where triangles end folded or thin.
    WeightRepair,
    /// The same, beginning at the surface given each time.
    RepairHere,
    /// The same, with all weights repaired before.
    RepairEverywhere,
    /// Pseudo-time, then one iteration.
    PseudoTime,
    /// Iterations along parts of the right-hand side.
    TargetContinuation,
    /// Iterations along boundary normals from the membrane's own to the prescribed ones.
    NormalContinuation,
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
    /// See [`Procedure::TargetContinuation`].
    TargetContinuation(Box<TargetContinuation>),
    /// See [`Procedure::NormalContinuation`].
    NormalContinuation(Box<NormalContinuation>),
    /// See [`Procedure::Approach`] and [`Procedure::Retreat`].
    Family(Box<Family>),
}

impl Procedure {
    /// Begins at `x`; `member` is the coarse mesh's, for [`Self::Retreat`].
    pub(crate) fn begin(
        self,
        x: Vec<Vector3<f64>>,
        options: IterateOptions,
        member: f64,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> (Underway, Next) {
        match self {
            Self::Iteration => {
                let run = Run::iterate(system, x, options, control);
                (Underway::Single, Next::Run(run))
            }
            Self::PseudoTime => {
                let run = Run::Flow(PseudoTime::new(system, x), options);
                (Underway::Single, Next::Run(run))
            }
            Self::WeightRepair | Self::MinimalEnergy | Self::RepairHere | Self::RepairEverywhere => {
                let anew = match self {
                    Self::RepairHere => Anew::FromSurface,
                    Self::RepairEverywhere => Anew::Everywhere,
                    _ => Anew::FromLinear,
                };
                if self == Self::MinimalEnergy {
                    system.use_member(1.0);
                }
                let (repair, next) = WeightRepair::begin(x, options, anew, system, control);
                (Underway::WeightRepair(Box::new(repair)), next)
            }
            Self::TargetContinuation => {
                let (continuation, next) = TargetContinuation::begin(x, options, system, control);
                (Underway::TargetContinuation(Box::new(continuation)), next)
            }
            Self::NormalContinuation => {
                let (continuation, next) = NormalContinuation::begin(x, options, system, control);
                (Underway::NormalContinuation(Box::new(continuation)), next)
            }
            Self::Approach => {
                let (family, next) = Family::approach(x, options, system, control);
                (Underway::Family(Box::new(family)), next)
            }
            Self::Retreat => {
                let (family, next) = Family::retreat(x, options, member, system, control);
                (Underway::Family(Box::new(family)), next)
            }
        }
    }
}

impl Underway {
    /// After a run that led to `last`.
    pub(crate) fn next(&mut self, last: Candidate, system: &mut System, control: &mut Control<'_>) -> Next {
        match self {
            Self::Single => Next::Done(last),
            Self::WeightRepair(repair) => repair.next(last, system, control),
            Self::TargetContinuation(continuation) => continuation.next(last, system, control),
            Self::NormalContinuation(continuation) => continuation.next(last, system, control),
            Self::Family(family) => family.next(last, system, control),
        }
    }
}
