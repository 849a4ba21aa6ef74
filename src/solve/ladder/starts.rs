//! Where attempts begin, and with what.

use nalgebra::Vector3;

use super::Ladder;
use crate::solve::attempt::{Attempt, Start, Weights};
use crate::solve::control::{Control, STARTED};
use crate::solve::initial::PHASE;
use crate::solve::problem::diagonal;
use crate::solve::search::Search;
use crate::solve::soft_mode::second_surface;
use crate::solve::system::{Collapsed, System};
use crate::stopwatch::Stopwatch;

impl Ladder {
    /// The coarse mesh's surface, if it is harmonic or not, as asked; where that was found along the normals, the system goes on so.
    fn of_coarse_mesh(
        &self,
        harmonic: bool,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Option<Vec<Vector3<f64>>> {
        let Some(Search::Found {
            x,
            member,
            along_normals,
        }) = &self.coarse
        else {
            return None;
        };
        if (*member == 0.0) != harmonic {
            return None;
        }
        let mut x = x.clone();
        system.diagonal = diagonal(&x);
        if *along_normals {
            system.step_along_normals();
        } else {
            system.tangential_steps(&mut x, control);
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
        system.use_asked_weights();
        let linear = system.start(control);
        if !control.checkpoint(PHASE) {
            return Ok(false);
        }
        self.linear = Some(linear?);
        control.phase(STARTED, PHASE);
        self.start_seconds += clock.seconds();
        Ok(true)
    }

    /// Weights, curvature and start of an attempt; `None` where there is no such start.
    pub(super) fn set_up(
        &mut self,
        attempt: &Attempt,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Option<Vec<Vector3<f64>>> {
        match attempt.weights {
            Weights::Asked => system.use_asked_weights(),
            Weights::AsLeft => {}
            Weights::None => system.step_along_normals(),
        }
        let start = match attempt.start {
            Start::AtHand => {
                if self.along_normals {
                    system.step_along_normals();
                }
                self.at_hand.take()
            }
            Start::Linear => self.linear.clone(),
            Start::Coarse => self.of_coarse_mesh(true, system, control),
            Start::CoarseMember => self.of_coarse_mesh(false, system, control),
            Start::MinimalEnergy => self.minimal_energy.clone(),
            Start::Stalled => self.stalled.take().map(|(x, _)| x),
            Start::BesideSound => second_surface(&self.sound.as_ref()?.x, system, control),
            Start::MembraneMetric => {
                let membrane = system.membrane();
                let mut x = system.linear_surface_on(&membrane, control).ok()?;
                system.tangential_steps(&mut x, control);
                Some(x)
            }
        };
        self.along_normals = system.along_normals;
        start
    }
}
