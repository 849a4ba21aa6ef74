//! The order in which harder means are tried, until a sound surface is found or none is left:
//!
//! 1. directly, from the linear surface, with repaired inner fairness where triangles end flipped or thin; then the
//!    same from the linear surface on a membrane's metric; with a right-hand side, continuation in it before that;
//! 2. plain (first-order) curvature first, whose basin is larger, then a jump to the second order;
//! 3. pseudo-time from there;
//! 4. the plain solution to tolerance, reported as what it is;
//! 5. pseudo-time from the start;
//! 6. equal inner fairness where another was asked for, directly;
//! 7. continuation in the boundary normals.

use std::time::Instant;

use nalgebra::Vector3;

use super::candidate::Candidate;
use super::continuation::continuation;
use super::control::Control;
use super::initial::STAGE;
use super::loading::loading;
use super::pseudo_time::pseudo_time;
use super::quasi_newton::{End, Plan, iterate};
use super::system::{Collapsed, System};
use super::weight_repair::{Repair, THRESHOLDS};
use crate::discrete::curvature::NO_TILT;
use crate::discrete::equations::FreeCurvature;
use crate::discrete::inner_fairness::FairnessWeights;
use crate::quality::{NEEDLE, Surface};

/// Divergence guard of the direct iteration: every change of matrix makes the step norm jump.
const GUARD: f64 = 10.0;
/// Divergence guard with plain curvature.
const PLAIN_GUARD: f64 = 5.0;
/// Plain curvature only prepares: it goes no further than this.
const PLAIN_TOLERANCE: f64 = 1e-4;

/// How the solve ended.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Ending {
    /// Tolerance met.
    Converged,
    /// Tolerance met with plain (first-order) curvature only.
    FirstOrder,
    /// Tolerance met by a surface that has a bump, see [`Candidate::doubtful`](super::candidate::Candidate::doubtful).
    Doubtful,
    /// No sound nonlinear surface; the linear one.
    Failed,
    /// Boundary normals reached only to this fraction of the way; the linear surface. Boundary vertices (numbered from
    /// the first boundary vertex), the farthest first.
    Partly(f64, Vec<u32>),
    /// A surface was found for this part of the right-hand side only; the linear surface.
    Loaded(f64),
    /// Limit or cancel: the best surface so far.
    Stopped,
}

/// What was found.
#[derive(Debug, Clone)]
pub(crate) struct Solved {
    /// The surface: free and boundary vertices.
    pub x: Vec<Vector3<f64>>,
    /// How it ended.
    pub ending: Ending,
    /// The last step norm.
    pub step: f64,
    /// Triangles of the region (local numbers) that are flipped or thin.
    pub poor: Vec<u32>,
    /// The vertices are distributed evenly, because no surface was found with the inner fairness that was asked for.
    pub even: bool,
    /// Seconds until the first iteration.
    pub start_seconds: f64,
}

/// Solves both fairness equations.
///
/// # Errors
/// [`Collapsed`] where not even the linear surface exists.
pub(crate) fn solve(system: &mut System<'_>, control: &mut Control<'_>) -> Result<Solved, Collapsed> {
    let clock = Instant::now();
    control.stage(0.05, STAGE);
    system.heed(&control.interrupt);
    let linear = match system.start(control) {
        Err(collapsed) if control.goes_on(STAGE) => return Err(collapsed),
        Ok(linear) if control.goes_on(STAGE) => linear,
        _ => return Ok(unmoved(system, clock)),
    };
    control.stage(0.3, STAGE);
    let mut solved = Solved {
        x: linear.clone(),
        ending: Ending::Failed,
        step: f64::NAN,
        poor: Vec::new(),
        even: false,
        start_seconds: clock.elapsed().as_secs_f64(),
    };
    let (candidate, ending) = attempts(system, &linear, control);
    let is_settled = candidate.as_ref().is_some_and(Candidate::is_settled);
    solved.ending = if control.cancelled && !is_settled {
        Ending::Stopped
    } else {
        ending
    };
    solved.even = candidate.as_ref().is_some_and(|c| c.even);
    // Stopped on the way over poor triangles: the linear surface is the better one.
    match candidate.filter(|c| c.end != End::Stopped || c.poor.is_empty()) {
        Some(candidate) => {
            solved.step = candidate.step;
            solved.poor = candidate.poor;
            solved.x = candidate.x;
        }
        None => {
            system.evaluate(&linear);
            solved.poor = system.poor(&linear, NEEDLE);
        }
    }
    Ok(solved)
}

/// The surface given, for a run that is stopped before there is a better one.
fn unmoved(system: &mut System<'_>, clock: Instant) -> Solved {
    let x = system.input[..system.region.region_vertices()].to_vec();
    system.evaluate(&x);
    Solved {
        poor: system.poor(&x, NEEDLE),
        x,
        ending: Ending::Stopped,
        step: f64::NAN,
        even: false,
        start_seconds: clock.elapsed().as_secs_f64(),
    }
}

/// Goes on from a surface that solved a problem close to this one, with the matrices that are there. None where that
/// leads to no sound surface.
pub(crate) fn resume(
    system: &mut System<'_>,
    x: &[Vector3<f64>],
    control: &mut Control<'_>,
) -> Option<Solved> {
    let plan = Plan {
        tolerance: control.tolerance,
        guard: GUARD,
        watch: false,
        response: true,
        keep: true,
        stage: "fairing",
    };
    let (candidate, ending) = settled(iterated(system, x.to_vec(), plan, control), Ending::Converged);
    let candidate = candidate.filter(Candidate::is_settled)?;
    Some(Solved {
        x: candidate.x,
        ending,
        step: candidate.step,
        poor: candidate.poor,
        start_seconds: 0.0,
        even: false,
    })
}

fn attempts(
    system: &mut System<'_>,
    linear: &[Vector3<f64>],
    control: &mut Control<'_>,
) -> (Option<Candidate>, Ending) {
    let asked = system.curvature;
    let weights = system.weights.clone();
    let direct = Plan {
        tolerance: control.tolerance,
        guard: GUARD,
        watch: false,
        response: true,
        keep: false,
        stage: "fairing",
    };
    let mut fallback = Vec::new();

    let first = with_repair(system, linear.to_vec(), direct, control);
    if first.is_settled() {
        return settled(first, Ending::Converged);
    }
    keep(&mut fallback, first, Ending::Converged);

    restore(system, &weights);
    let mut loaded = None;
    if !system.right_hand_side.is_zero() {
        let found = loading(system, linear, control);
        match found.candidate {
            Some(candidate) if candidate.is_settled() => return settled(candidate, Ending::Converged),
            Some(candidate) => keep(&mut fallback, candidate, Ending::Converged),
            None => loaded = Some(found.reached),
        }
    }
    let membrane = system.membrane();
    if let Ok(mut start) = system.linear_surface_on(&membrane, control) {
        system.tangential_steps(&mut start, control);
        let second = with_repair(
            system,
            start,
            Plan {
                response: false,
                ..direct
            },
            control,
        );
        if second.is_settled() {
            return settled(second, Ending::Converged);
        }
        keep(&mut fallback, second, Ending::Converged);
    }

    if let FreeCurvature::GradientCorrected { .. } = asked {
        restore(system, &weights);
        system.curvature = FreeCurvature::GradientCorrected { tilt_ridge: NO_TILT };
        let coarse = Plan {
            tolerance: PLAIN_TOLERANCE.max(control.tolerance),
            guard: PLAIN_GUARD,
            watch: false,
            response: true,
            keep: false,
            stage: "plain curvature",
        };
        let plain = with_repair(system, linear.to_vec(), coarse, control);
        if plain.end == End::Stopped {
            return settled(plain, Ending::Stopped);
        }
        if plain.end == End::Converged {
            let (candidate, ending) = from_plain(system, plain, asked, control);
            if candidate.is_settled() {
                return settled(candidate, ending);
            }
            keep(&mut fallback, candidate, ending);
        }
        system.curvature = asked;
    }

    restore(system, &weights);
    let slow = slowly(system, linear.to_vec(), control);
    if slow.is_settled() {
        return settled(slow, Ending::Converged);
    }
    keep(&mut fallback, slow, Ending::Converged);

    if weights.slots.is_some() && !control.exhausted() {
        if let Some(even) = evenly(system, direct, control).filter(Candidate::is_settled) {
            return settled(even, Ending::Converged);
        }
        restore(system, &weights);
    }

    let continued = continuation(system, linear, control);
    match continued.candidate {
        Some(candidate) if candidate.is_settled() => return settled(candidate, Ending::Converged),
        Some(candidate) => keep(&mut fallback, candidate, Ending::Converged),
        None => {}
    }
    fallback.sort_by_key(|(candidate, _)| candidate.rank());
    match fallback.into_iter().next() {
        Some((candidate, Ending::Converged)) if candidate.doubtful => (Some(candidate), Ending::Doubtful),
        Some((candidate, ending)) => (Some(candidate), ending),
        None if loaded.is_some_and(|part| part > 0.0) => (None, Ending::Loaded(loaded.unwrap_or(0.0))),
        None if continued.reached > 0.0 => (None, Ending::Partly(continued.reached, continued.farthest)),
        None => (None, Ending::Failed),
    }
}

/// Surfaces that met the tolerance, but on poor triangles, are kept for the case that nothing better comes.
fn keep(fallback: &mut Vec<(Candidate, Ending)>, candidate: Candidate, ending: Ending) {
    if candidate.end == End::Converged {
        fallback.push((candidate, ending));
    }
}

fn settled(candidate: Candidate, ending: Ending) -> (Option<Candidate>, Ending) {
    let ending = if candidate.end == End::Stopped {
        Ending::Stopped
    } else {
        ending
    };
    (Some(candidate), ending)
}

/// With uniform inner fairness in place of the one that was asked for.
fn evenly(system: &mut System<'_>, plan: Plan, control: &mut Control<'_>) -> Option<Candidate> {
    let set = system.set_weights(FairnessWeights::uniform());
    let start = set.and_then(|()| system.start(control)).ok()?;
    let mut candidate = with_repair(system, start, plan, control);
    candidate.even = true;
    Some(candidate)
}

/// Goes back to the weights that were asked for. They were factored before, so that they can be again.
fn restore(system: &mut System<'_>, weights: &FairnessWeights) {
    let _ = system.set_weights(weights.clone());
}

/// From a plain solution: the jump to the asked curvature, else pseudo-time, else the plain solution itself.
fn from_plain(
    system: &mut System<'_>,
    plain: Candidate,
    asked: FreeCurvature,
    control: &mut Control<'_>,
) -> (Candidate, Ending) {
    system.curvature = asked;
    let jump = Plan {
        tolerance: control.tolerance,
        guard: GUARD,
        watch: false,
        response: true,
        keep: false,
        stage: "second order",
    };
    let jumped = iterated(system, plain.x.clone(), jump, control);
    if jumped.is_settled() {
        return (jumped, Ending::Converged);
    }
    let slow = slowly(system, plain.x.clone(), control);
    if slow.is_settled() {
        return (slow, Ending::Converged);
    }
    system.curvature = FreeCurvature::GradientCorrected { tilt_ridge: NO_TILT };
    let finish = Plan {
        guard: PLAIN_GUARD,
        stage: "plain curvature",
        ..jump
    };
    let finished = iterated(system, plain.x, finish, control);
    let better = [jumped, slow].into_iter().min_by_key(Candidate::rank);
    match better {
        Some(c) if c.rank() <= finished.rank() => (c, Ending::Converged),
        _ => (finished, Ending::FirstOrder),
    }
}

/// Pseudo-time, then the iteration.
fn slowly(system: &mut System<'_>, mut x: Vec<Vector3<f64>>, control: &mut Control<'_>) -> Candidate {
    match pseudo_time(system, &mut x, control) {
        Ok(true) => {
            let plan = Plan {
                tolerance: control.tolerance,
                guard: GUARD,
                watch: false,
                response: true,
                keep: false,
                stage: "fairing",
            };
            iterated(system, x, plan, control)
        }
        // Or stopped within a factorization.
        Ok(false) | Err(Collapsed) if control.exhausted() || !control.goes_on(STAGE) => {
            judged(system, x, End::Stopped, f64::NAN)
        }
        Ok(false) | Err(Collapsed) => judged(system, x, End::Stalled, f64::NAN),
    }
}

/// Iterates from `x` and judges what comes of it.
pub(crate) fn iterated(
    system: &mut System<'_>,
    mut x: Vec<Vector3<f64>>,
    plan: Plan,
    control: &mut Control<'_>,
) -> Candidate {
    let (end, step) = iterate(system, &mut x, plan, control);
    judged(system, x, end, step)
}

fn judged(system: &mut System<'_>, x: Vec<Vector3<f64>>, end: End, step: f64) -> Candidate {
    system.evaluate(&x);
    let poor = system.poor(&x, NEEDLE);
    let doubtful = system.overshoots() || system.surface(&x).is_strained();
    Candidate {
        x,
        end,
        step,
        poor,
        doubtful,
        even: false,
        needled: false,
    }
}

/// Iterates; where triangles end flipped or thin, repairs the inner fairness around them and starts again.
fn with_repair(
    system: &mut System<'_>,
    mut x: Vec<Vector3<f64>>,
    plan: Plan,
    control: &mut Control<'_>,
) -> Candidate {
    let mut repair = Repair::new(system);
    let asked = system.weights.clone();
    system.evaluate(&x);
    let needles = system.poor(&x, NEEDLE).len();
    let mut watch = true;
    // The start is distributed almost as the result will be: what folds here would be found after the iterations.
    if !system.poor(&x, THRESHOLDS[0]).is_empty()
        && let Some(weights) = repair.next(system, &x)
        && let Ok(start) = system.set_weights(weights).and_then(|()| system.start(control))
        && !control.cancelled
    {
        system.evaluate(&start);
        if needles > 0 && system.poor(&start, NEEDLE).len() >= needles {
            // They were factored before, so that they can be again.
            let _ = system.set_weights(asked);
            watch = false;
        } else {
            x = start;
        }
    }
    let mut best = iterated(system, x, Plan { watch, ..plan }, control);
    if !watch && best.has_only_needles(system, needles) {
        best.needled = true;
        return best;
    }
    let mut last = best.clone();
    while matches!(last.end, End::Converged | End::Poor) && !last.poor.is_empty() {
        let Some(weights) = repair.next(system, &last.x) else {
            break;
        };
        let restarted = system.set_weights(weights).and_then(|()| system.start(control));
        let Ok(start) = restarted else { break };
        if control.cancelled {
            return Candidate {
                end: End::Stopped,
                ..best
            };
        }
        last = iterated(
            system,
            start,
            Plan {
                watch: repair.has_more(),
                ..plan
            },
            control,
        );
        if last.end == End::Stopped {
            return last;
        }
        if last.rank() < best.rank() {
            best.clone_from(&last);
        }
    }
    best
}

impl System<'_> {
    /// Linear surface and tangential steps with the current weights and normals.
    fn start(&mut self, control: &mut Control<'_>) -> Result<Vec<Vector3<f64>>, Collapsed> {
        let mut x = self.linear_surface(control)?;
        self.diagonal = diagonal(&x);
        self.tangential_steps(&mut x, control);
        Ok(x)
    }

    fn surface<'s>(&'s self, x: &'s [Vector3<f64>]) -> Surface<'s> {
        Surface {
            region: self.region,
            x,
            normals: &self.state.corrected,
            boundary_normals: &self.boundary_normals,
            h: &self.state.h,
        }
    }

    /// Region triangles (local numbers) that are flipped or have an angle below `degrees` at `x`, which was evaluated
    /// last.
    pub(crate) fn poor(&self, x: &[Vector3<f64>], degrees: f64) -> Vec<u32> {
        self.surface(x).poor(degrees)
    }
}

/// The diagonal of the bounding box.
pub(crate) fn diagonal(x: &[Vector3<f64>]) -> f64 {
    let (low, high) = bounding_box(x);
    (high - low).norm()
}

/// Lowest and highest corner.
pub(crate) fn bounding_box(x: &[Vector3<f64>]) -> (Vector3<f64>, Vector3<f64>) {
    let start = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    x.iter().fold(start, |(low, high), p| (low.inf(p), high.sup(p)))
}
