//! The order in which harder means are tried, until a sound surface is found or none is left.

use std::time::Instant;

use nalgebra::Vector3;

use super::control::Control;
use super::quasi_newton::{End, Plan, iterate};
use super::system::{Collapsed, System};

/// How the solve ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Ending {
    /// Tolerance met.
    Converged,
    /// Tolerance met with plain (first-order) curvature only.
    FirstOrder,
    /// No sound nonlinear surface.
    Failed,
    /// Border normals reached only to this fraction.
    Partly(f64),
    /// Limit or cancel.
    Stopped,
}

/// What was found.
#[derive(Debug, Clone)]
pub struct Solved {
    /// The surface: free and border vertices.
    pub x: Vec<Vector3<f64>>,
    /// How it ended.
    pub ending: Ending,
    /// The last step norm.
    pub step: f64,
    /// Seconds until the first iteration.
    pub start_seconds: f64,
}

/// Solves.
pub fn solve(system: &mut System<'_>, control: &mut Control<'_>) -> Result<Solved, Collapsed> {
    let clock = Instant::now();
    let membrane = system.membrane();
    let mut x = system.linear_surface(&membrane)?;
    system.diagonal = diagonal(&x);
    system.tangential_steps(&mut x);
    let start_seconds = clock.elapsed().as_secs_f64();
    let plan = Plan { tolerance: control.tolerance, guard: 3.0, reuse: true, stage: "fairing" };
    let (end, step) = iterate(system, &mut x, plan, control);
    let ending = match end {
        End::Converged => Ending::Converged,
        End::Stopped => Ending::Stopped,
        End::Stalled => Ending::Failed,
    };
    Ok(Solved { x, ending, step, start_seconds })
}

/// The diagonal of the bounding box.
pub fn diagonal(x: &[Vector3<f64>]) -> f64 {
    let (low, high) = bounding_box(x);
    (high - low).norm()
}

/// Lowest and highest corner.
pub fn bounding_box(x: &[Vector3<f64>]) -> (Vector3<f64>, Vector3<f64>) {
    let start = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    x.iter().fold(start, |(low, high), p| (low.inf(p), high.sup(p)))
}
