//! The iteration: quasi-Newton steps with a frozen matrix, Anderson-accelerated.

use nalgebra::Vector3;

use super::control::Control;
use super::system::{Collapsed, LARGEST_CHANGE, System, advance};
use fairmesh_linear::anderson::Anderson;

/// Below this step norm the triangles show what they will be.
const NEAR: f64 = 1e-4;
/// Growth of the step norm over the best that an accelerated step may cause.
const SAFE_GROWTH: f64 = 3.0;
/// No vertex takes a normal step of more than this times the tolerance at the end: a mean hides single slow vertices.
const LARGEST_STEP: f64 = 0.1;
/// But not for longer than this many iterations.
const EXTRA: usize = 3;
/// Steps that Anderson acceleration looks back on. Every cluster of thin triangles adds slow modes of its own, and each
/// takes a step of the history; on large regions that would cost more memory than the matrix.
const WINDOWS: [usize; 2] = [20, 8];
/// The largest region with the longer history.
const LONG_UP_TO: usize = 50_000;
/// A round that gains less than this in [`PATIENCE`] steps is left.
const STALL: f64 = 0.7;
/// See [`STALL`].
const PATIENCE: usize = 5;
/// At most this many rounds, each with a matrix made at the best surface so far.
const ROUNDS: usize = 5;

/// How an iteration ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum End {
    /// The step norm is below the tolerance.
    Converged,
    /// No round gains any more.
    Stalled,
    /// Near the solution, but on poor triangles: see [`Plan::watch`].
    Poor,
    /// Limit or cancel, see [`Control`].
    Stopped,
}

/// What one call may do.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plan {
    /// The step norm to reach, in diagonals.
    pub tolerance: f64,
    /// A round is left when the step norm exceeds this many times the best.
    pub guard: f64,
    /// Stop near the solution when triangles are flipped or thin: their repair starts anew.
    pub watch: bool,
    /// Take `D` from how the curvature of the surface at hand answers; else from the ring alone, which is coarser and
    /// safer.
    pub response: bool,
    /// Begin with the matrix that is there.
    pub keep: bool,
    /// What to call it in progress reports.
    pub stage: &'static str,
}

/// The surface with the smallest step norm of a round. Norms of different rounds do not compare: each round has a
/// matrix of its own.
#[derive(Debug, Clone)]
struct Best {
    x: Vec<Vector3<f64>>,
    d: f64,
    first: f64,
}

/// A round with a fresh matrix that gains less than this will not gain in another.
const ROUND_GAIN: f64 = 0.7;

/// Iterates from `x`; leaves the best surface there, and returns its step norm.
pub(crate) fn iterate(
    system: &mut System<'_>,
    x: &mut Vec<Vector3<f64>>,
    plan: Plan,
    control: &mut Control<'_>,
) -> (End, f64) {
    let mut best = Best {
        x: x.clone(),
        d: f64::INFINITY,
        first: f64::INFINITY,
    };
    let window = WINDOWS[usize::from(system.free() > LONG_UP_TO)];
    let mut anderson = Anderson::new(3 * system.free(), window);
    for round in 0..ROUNDS {
        best.d = f64::INFINITY;
        let keep = plan.keep && round == 0;
        match run(
            system,
            x,
            &Plan { keep, ..plan },
            &mut anderson,
            &mut best,
            control,
        ) {
            Ok(End::Converged) => return (End::Converged, best.d),
            // The mean step is small enough; a few slow vertices do not gain any more.
            Ok(End::Stalled) if best.d <= plan.tolerance => {
                x.clone_from(&best.x);
                return (End::Converged, best.d);
            }
            Ok(End::Stalled) => {}
            Ok(end @ (End::Stopped | End::Poor)) => {
                x.clone_from(&best.x);
                return (end, best.d);
            }
            // Stopped within a factorization.
            Err(Collapsed) if !control.goes_on(plan.stage) => {
                x.clone_from(&best.x);
                return (End::Stopped, f64::NAN);
            }
            Err(Collapsed) => break,
        }
        x.clone_from(&best.x);
        if best.d > ROUND_GAIN * best.first {
            break;
        }
    }
    x.clone_from(&best.x);
    (End::Stalled, best.d)
}

/// One round: until converged, stopped, diverging or stalling.
fn run(
    system: &mut System<'_>,
    x: &mut Vec<Vector3<f64>>,
    plan: &Plan,
    anderson: &mut Anderson,
    best: &mut Best,
    control: &mut Control<'_>,
) -> Result<End, Collapsed> {
    let n = 3 * system.free();
    let (mut step, mut accelerated, mut flat) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let mut history: Vec<f64> = Vec::new();
    let mut watch = plan.watch;
    let mut safeguard = true;
    let mut waited = 0;
    anderson.clear();
    if plan.keep || !plan.response {
        system.evaluate(x);
    }
    if !plan.keep {
        system.rebuild(x, plan.response, |_| 0.0)?;
    }
    if !control.goes_on(plan.stage) {
        best.d = f64::NAN;
        return Ok(End::Stopped);
    }
    loop {
        let norm = system.step(&mut step, true);
        let d = norm.total();
        control.iteration(d, plan.stage);
        control.show(system, x, d);
        if !d.is_finite() {
            return Ok(End::Stalled);
        }
        if history.is_empty() {
            best.first = d;
        }
        if d < best.d {
            best.d = d;
            best.x.clone_from(x);
        }
        // Not on the first sight: a start may be close for reasons of its own.
        waited += usize::from(d <= plan.tolerance);
        let even = norm.largest <= LARGEST_STEP * plan.tolerance || waited > EXTRA;
        if d <= plan.tolerance && even && !history.is_empty() {
            advance(x, &step, 1.0);
            return Ok(End::Converged);
        }
        if control.exhausted() {
            return Ok(End::Stopped);
        }
        if watch && d < NEAR {
            watch = false;
            if !system.poor(x, crate::quality::NEEDLE).is_empty() {
                return Ok(End::Poor);
            }
        }
        history.push(d);
        let k = history.len() - 1;
        if d > plan.guard * best.d || k >= PATIENCE && d > STALL * history[k - PATIENCE] {
            return Ok(End::Stalled);
        }
        for (flat, x) in flat.chunks_exact_mut(3).zip(x.iter()) {
            flat.copy_from_slice(x.as_slice());
        }
        if d > (if best.d < NEAR { 6.0 } else { SAFE_GROWTH }) * best.d && safeguard {
            // Extrapolated too far: back to the best surface, and from there without history.
            safeguard = false;
            x.clone_from(&best.x);
            anderson.clear();
            system.evaluate(x);
            system.step(&mut step, true);
            let change = system.edge_change(x, &step);
            advance(
                x,
                &step,
                (LARGEST_CHANGE / change.max(f64::MIN_POSITIVE)).min(1.0),
            );
            system.evaluate(x);
            continue;
        }
        safeguard = true;
        anderson.accelerate(&flat, &step, &mut accelerated);
        let change = system.edge_change(x, &accelerated);
        if change <= 2.0 * LARGEST_CHANGE {
            advance(
                x,
                &accelerated,
                (LARGEST_CHANGE / change.max(f64::MIN_POSITIVE)).min(1.0),
            );
        } else {
            anderson.clear();
            let change = system.edge_change(x, &step);
            advance(
                x,
                &step,
                (LARGEST_CHANGE / change.max(f64::MIN_POSITIVE)).min(1.0),
            );
        }
        system.evaluate(x);
    }
}
