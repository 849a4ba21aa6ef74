//! Continuation in the boundary normals, from the membrane's own to the prescribed ones. Where it stalls short of the end,
//! no surface with these normals was found on this branch.

use nalgebra::Vector3;

use super::candidate::Candidate;
use super::control::Control;
use super::globalize::iterated;
use super::quasi_newton::{End, Plan};
use super::system::System;
use crate::discrete::boundary_normals::{angle, average};

/// The first step turns no normal further than this, 25 degrees.
const FIRST_STEP: f64 = 25.0 * std::f64::consts::PI / 180.0;
/// A step shorter than this fraction of the way is not tried.
const SHORTEST: f64 = 1.0 / 64.0;
/// Step norm on the way.
const ON_THE_WAY: f64 = 1e-4;

/// Where the continuation ended.
#[derive(Debug)]
pub(crate) struct Continued {
    /// The surface with the prescribed normals, where it was reached.
    pub candidate: Option<Candidate>,
    /// The fraction of the way for which a sound surface was found.
    pub reached: f64,
    /// Boundary vertices by how far their normal was from the prescribed one, the farthest first.
    pub farthest: Vec<u32>,
}

/// Follows the normals; the system's normals are the prescribed ones before and after.
pub(crate) fn continuation(
    system: &mut System<'_>,
    linear: &[Vector3<f64>],
    control: &mut Control<'_>,
) -> Continued {
    let prescribed = system.boundary_normals.clone();
    let membrane = system.membrane();
    let free = system.free();
    let own: Vec<Vector3<f64>> = (0..prescribed.len())
        .map(|b| average(&membrane, free + b, system.rings.boundary_triangles(b)).unwrap_or(prescribed[b]))
        .collect();
    let angles: Vec<f64> = own.iter().zip(&prescribed).map(|(a, b)| angle(a, b)).collect();
    let widest = angles.iter().copied().fold(0.0, f64::max);
    let mut farthest: Vec<u32> = (0..angles.len() as u32).collect();
    farthest.sort_by(|&a, &b| angles[b as usize].total_cmp(&angles[a as usize]));
    farthest.truncate(angles.len().min(32));
    let mut continued = Continued {
        candidate: None,
        reached: 0.0,
        farthest,
    };

    system.boundary_normals = own.clone();
    let start = system.linear_surface(control).unwrap_or_else(|_| linear.to_vec());
    let mut x = start;
    system.tangential_steps(&mut x, control);
    let mut step = (FIRST_STEP / widest.max(FIRST_STEP)).min(1.0);
    let mut first = true;
    while step >= SHORTEST && !control.exhausted() {
        let target = if first {
            0.0
        } else {
            (continued.reached + step).min(1.0)
        };
        let last = target >= 1.0;
        system.boundary_normals = (0..own.len())
            .map(|b| slerp(&own[b], &prescribed[b], target))
            .collect();
        let tolerance = if last {
            control.tolerance
        } else {
            ON_THE_WAY.max(control.tolerance)
        };
        let plan = Plan {
            tolerance,
            guard: 3.0,
            watch: false,
            response: true,
            keep: false,
            stage: "turning the normals",
        };
        let candidate = iterated(system, x.clone(), plan, control);
        let good = candidate.end == End::Converged && candidate.poor.is_empty();
        if last && (good || candidate.end == End::Stopped) {
            continued.reached = 1.0;
            continued.candidate = Some(candidate);
            break;
        }
        if good {
            continued.reached = target;
            x = candidate.x;
            step *= if first { 1.0 } else { 2.0 };
            first = false;
        } else if first {
            break;
        } else {
            step *= 0.5;
        }
    }
    system.boundary_normals = prescribed;
    continued
}

/// The unit vector a fraction `s` of the way from `a` to `b` along their great circle.
fn slerp(a: &Vector3<f64>, b: &Vector3<f64>, s: f64) -> Vector3<f64> {
    let phi = angle(a, b);
    if phi < 1e-9 || s >= 1.0 {
        return *b;
    }
    let mixed = a * ((1.0 - s) * phi).sin() + b * (s * phi).sin();
    mixed.try_normalize(1e-12).unwrap_or(*b)
}
