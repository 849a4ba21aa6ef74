//! Pseudo-time: the flow `(4A/3) dq/dt = R1` in implicit steps, `(P + (4A/3) / tau) t = R1` with `P` made anew each step,
//! for starts from which the iteration itself diverges.

use nalgebra::Vector3;

use super::control::Control;
use super::limited_step::advance_limited;
use super::system::{Collapsed, System};

/// First and last step size, in diagonals to the fourth.
const TAU: [f64; 2] = [1e-4, 100.0];
/// The flow has no end where the step size falls below this.
const LEAST_TAU: f64 = TAU[0] * 1e-8;
/// The edge-relative change that the step size is steered to.
const AIM: f64 = 0.21;
/// Over this change a step is shortened, and for the normal part the step size cut.
const LARGEST: f64 = 0.3;
/// The step size falls and grows by no more than these factors at once.
const FACTORS: [f64; 2] = [0.1, 8.0];
/// Steps at most.
const STEPS: usize = 60;
/// What it is called in progress reports.
pub(crate) const PHASE: &str = "pseudo-time";

/// The flow under way. Between two calls the system stands evaluated at [`PseudoTime::x`].
#[derive(Debug)]
pub(crate) struct PseudoTime {
    /// The surface.
    pub(crate) x: Vec<Vector3<f64>>,
    step: Vec<f64>,
    tau: f64,
    steps: usize,
}

/// How the flow ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FlowStatus {
    /// At rest, or so.
    Reached,
    /// It leads nowhere.
    Stalled,
    /// Limit or cancel, see [`Control`].
    Stopped,
}

impl PseudoTime {
    /// The flow from `x`.
    pub(crate) fn new(system: &System, x: Vec<Vector3<f64>>) -> Self {
        Self {
            x,
            step: vec![0.0; 3 * system.free()],
            tau: TAU[0],
            steps: 0,
        }
    }

    /// One step. Returns how the flow ended, if it has.
    pub(crate) fn advance(&mut self, system: &mut System, control: &mut Control<'_>) -> Option<FlowStatus> {
        match self.step(system, control) {
            Ok(false) => None,
            Ok(true) if self.tau > TAU[1] => Some(FlowStatus::Reached),
            // Or stopped within a factorization.
            _ if control.exhausted() || !control.checkpoint(PHASE) => Some(FlowStatus::Stopped),
            _ => Some(FlowStatus::Stalled),
        }
    }

    /// Returns whether it was the last one.
    fn step(&mut self, system: &mut System, control: &mut Control<'_>) -> Result<bool, Collapsed> {
        let tau = 3.0 * self.tau * system.diagonal.powi(4);
        let area = system.state().area.iter();
        let mass: Vec<f64> = area.map(|area| area * 4.0 / tau).collect();
        system.rebuild(&self.x, true, Some(&mass))?;
        let d = system.step(&mut self.step).total();
        control.iteration(d, PHASE);
        if !d.is_finite() {
            return Err(Collapsed);
        }
        if control.exhausted() {
            return Ok(true);
        }
        // Both parts are limited at the surface before, and the tangential one has no say in the step size.
        let mut next = self.x.clone();
        system.normal_step(&mut self.step);
        let change = system.edge_change(&self.x, &self.step);
        advance_limited(&mut next, &self.step, change, LARGEST);
        self.tau *= if change > LARGEST {
            (LARGEST / change).max(FACTORS[0])
        } else {
            (AIM / change).clamp(1.0, FACTORS[1])
        };
        system.tangential_step(&mut self.step);
        let change = system.edge_change(&self.x, &self.step);
        advance_limited(&mut next, &self.step, change, LARGEST);
        self.x = next;
        system.evaluate(&self.x);
        self.steps += 1;
        Ok(self.tau > TAU[1] || self.tau < LEAST_TAU || self.steps == STEPS)
    }
}
