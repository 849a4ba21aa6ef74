//! Continuation in the right-hand side, from the harmonic surface to the asked one. Where it stalls short of the end, no
//! surface with this right-hand side was found on this branch.

use nalgebra::Vector3;

use super::candidate::Candidate;
use super::control::Control;
use super::globalize::iterated;
use super::quasi_newton::{End, Plan};
use super::system::System;
use crate::discrete::target::RightHandSide;

/// The first part of the right-hand side after none.
const FIRST_STEP: f64 = 0.25;
/// A step shorter than this fraction of the way is not tried.
const SHORTEST: f64 = 1.0 / 64.0;
/// Step norm on the way.
const ON_THE_WAY: f64 = 1e-4;

/// Where the continuation ended.
#[derive(Debug)]
pub(crate) struct Loaded {
    /// The surface with the whole right-hand side, where it was reached.
    pub candidate: Option<Candidate>,
    /// The part of the right-hand side for which a sound surface was found.
    pub reached: f64,
}

/// Follows the right-hand side; the system's is the asked one before and after.
pub(crate) fn loading(system: &mut System<'_>, linear: &[Vector3<f64>], control: &mut Control<'_>) -> Loaded {
    let asked = system.right_hand_side;
    let mut loaded = Loaded {
        candidate: None,
        reached: 0.0,
    };
    let mut plan = Plan {
        tolerance: ON_THE_WAY.max(control.tolerance),
        guard: 10.0,
        watch: false,
        response: true,
        keep: false,
        stage: "loading",
    };
    system.right_hand_side = RightHandSide::default();
    let harmonic = iterated(system, linear.to_vec(), plan, control);
    let mut x = harmonic.x;
    let mut step = if harmonic.end == End::Converged {
        FIRST_STEP
    } else {
        0.0
    };
    while step >= SHORTEST && !control.exhausted() {
        let part = (loaded.reached + step).min(1.0);
        let last = part >= 1.0;
        if last {
            plan.tolerance = control.tolerance;
        }
        system.right_hand_side = if last { asked } else { asked.share(part) };
        let candidate = iterated(system, x.clone(), plan, control);
        let good = candidate.end == End::Converged && !candidate.doubtful;
        if last && (good || candidate.end == End::Stopped) {
            loaded.reached = 1.0;
            loaded.candidate = Some(candidate);
            break;
        }
        if good {
            loaded.reached = part;
            x = candidate.x;
            step *= 2.0;
        } else {
            step *= 0.5;
        }
        plan.tolerance = ON_THE_WAY.max(control.tolerance);
    }
    system.right_hand_side = asked;
    loaded
}
