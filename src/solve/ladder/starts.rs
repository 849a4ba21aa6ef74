//! Where attempts begin, and with what.

use nalgebra::Vector3;

use super::Ladder;
use crate::solve::attempt::{Rung, Start, Weights};
use crate::solve::coarse_result::CoarseResult;
use crate::solve::control::{Control, STARTED};
use crate::solve::descent::FIRST;
use crate::solve::factor::Collapsed;
use crate::solve::formulation::Formulation;
use crate::solve::initial::PHASE;
use crate::solve::problem::diagonal;
use crate::solve::soft_mode::second_surface;
use crate::solve::system::System;
use crate::support::stopwatch::Stopwatch;

impl Ladder {
    /// The coarse mesh's surface, or only if that is another member of the family; along the normals where it was found so.
    fn of_coarse_mesh(
        &self,
        is_other_member: bool,
        formulation: &mut Formulation,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Option<Vec<Vector3<f64>>> {
        let Some(CoarseResult::Found {
            x,
            member,
            along_normals,
        }) = &self.coarse
        else {
            return None;
        };
        if is_other_member && *member == 0.0 {
            return None;
        }
        let mut x = x.clone();
        system.diagonal = diagonal(&x);
        formulation.along_normals = *along_normals;
        if !along_normals {
            system.tangential_steps(&mut x, formulation, control);
        }
        Some(x)
    }

    /// Makes the linear surface, if it is not there yet. Returns whether it is; if not, the run was stopped.
    pub(super) fn make_linear(
        &mut self,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Result<bool, Collapsed> {
        if self.linear.is_some() {
            return Ok(true);
        }
        let clock = Stopwatch::start();
        let asked = system.asked().clone();
        let linear = system.start(&asked, control);
        if !control.checkpoint(PHASE) {
            return Ok(false);
        }
        self.linear = Some(linear?);
        control.phase(STARTED, PHASE);
        self.start_seconds += clock.seconds();
        Ok(true)
    }

    /// Makes the surface of least bending and its inner fairness, if they are not there yet. `None`: there is no linear surface to begin
    /// at.
    fn least_bending(
        &mut self,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Option<&(Vec<Vector3<f64>>, Formulation)> {
        if self.least_bending.is_none() {
            let start = match &self.coarse {
                Some(CoarseResult::Found { x, .. } | CoarseResult::Missed { x: Some(x), .. }) => x.clone(),
                _ => self.linear.clone()?,
            };
            let asked = system.asked().clone();
            let x = system.descend(start, &FIRST, &asked, control).ok()?;
            let formulation = system.spread_as(&x);
            self.least_bending = Some((x, formulation));
        }
        self.least_bending.as_ref()
    }

    /// Start and formulation of an attempt; `None` where there is no such start.
    pub(super) fn set_up(
        &mut self,
        attempt: &Rung,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Option<(Vec<Vector3<f64>>, Formulation)> {
        let mut formulation = match attempt.weights {
            Weights::Asked => system.asked().clone(),
            Weights::LeastBending => {
                let (_, formulation) = self.least_bending(system, control)?;
                formulation.clone()
            }
            Weights::Input => system.spread_as_input()?,
            Weights::AsLeft => self.left(system),
            Weights::None => Formulation {
                along_normals: true,
                ..self.left(system)
            },
        };
        let start = match attempt.start {
            Start::AtHand => self.at_hand.take(),
            Start::Linear => self.linear.clone(),
            Start::OwnLinear => {
                system.factor_inner(&formulation.weights).ok()?;
                system.start(&formulation, control).ok()
            }
            Start::Coarse => self.of_coarse_mesh(false, &mut formulation, system, control),
            Start::CoarseMember => self.of_coarse_mesh(true, &mut formulation, system, control),
            Start::MinimalEnergy => self.minimal_energy.clone(),
            Start::Stalled => self.stalled.take().map(|(x, _)| x),
            Start::BesideSound => {
                let x = second_surface(&self.sound.as_ref()?.x, &formulation, system, control)?;
                if system.domain.is_stretched() {
                    formulation = system.spread_as(&x);
                    system.factor_inner(&formulation.weights).ok()?;
                }
                Some(x)
            }
            Start::LeastBending => self.least_bending(system, control).map(|(x, _)| x.clone()),
        };
        start.map(|x| (x, formulation))
    }
}
