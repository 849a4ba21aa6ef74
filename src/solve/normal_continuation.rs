//! Continuation in the boundary normals, from the membrane's own to the prescribed ones. Where it stalls short of the end,
//! no surface with these normals was found on this branch.

use nalgebra::Vector3;

use super::candidate::Candidate;
use super::control::Control;
use super::procedure::{Next, Run};
use super::quasi_newton::IterateOptions;
use super::result::SolveStatus;
use super::system::System;
use crate::discrete::boundary_normals::{angle, average, slerp};
use crate::order;

/// The first step turns no normal further than this, 25 degrees.
const FIRST_STEP: f64 = 25.0 * std::f64::consts::PI / 180.0;
/// A step shorter than this fraction of the way is not tried.
const SHORTEST: f64 = 1.0 / 64.0;
/// So many boundary vertices are named where the way is not found.
const NAMED: usize = 32;

/// The way to the prescribed normals.
#[derive(Debug)]
pub(crate) struct NormalContinuation {
    /// On the way; with the prescribed normals it is iterated to the asked tolerance.
    options: IterateOptions,
    /// The membrane's normals, where the way begins.
    own: Vec<Vector3<f64>>,
    prescribed: Vec<Vector3<f64>>,
    /// The last surface reached.
    x: Vec<Vector3<f64>>,
    /// The membrane's own normals are still to be met.
    is_first: bool,
    /// The fraction of the way reached.
    reached: f64,
    /// The fraction that is tried.
    tried: f64,
    step: f64,
}

impl NormalContinuation {
    /// Begins with the membrane's normals, at the linear surface with them; `linear` where that has collapsed.
    pub(crate) fn begin(
        linear: Vec<Vector3<f64>>,
        options: IterateOptions,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> (Self, Next) {
        let prescribed = system.boundary_normals().to_vec();
        let own = membrane_normals(system);
        let widest = angles(&own, &prescribed).fold(0.0, f64::max);
        system.use_boundary_normals(own.clone());
        let mut x = system.linear_surface(control).unwrap_or(linear);
        system.tangential_steps(&mut x, control);
        let mut continuation = Self {
            options,
            own,
            prescribed,
            x,
            is_first: true,
            reached: 0.0,
            tried: 0.0,
            step: (FIRST_STEP / widest.max(FIRST_STEP)).min(1.0),
        };
        let next = continuation.run(system, control);
        (continuation, next)
    }

    /// After the iteration with the normals that were tried.
    pub(crate) fn next(&mut self, last: Candidate, system: &mut System, control: &Control<'_>) -> Next {
        let is_good = last.is_converged() && last.poor.is_empty();
        if self.tried >= 1.0 && (is_good || last.is_stopped()) {
            return Next::Done(last);
        }
        if is_good {
            self.reached = self.tried;
            self.x = last.x;
            self.step *= if self.is_first { 1.0 } else { 2.0 };
            self.is_first = false;
        } else if self.is_first {
            return self.short();
        } else {
            self.step *= 0.5;
        }
        self.run(system, control)
    }

    /// One step further, the first one to the membrane's own normals.
    fn run(&mut self, system: &mut System, control: &Control<'_>) -> Next {
        if self.step < SHORTEST || control.exhausted() {
            return self.short();
        }
        self.tried = if self.is_first {
            0.0
        } else {
            (self.reached + self.step).min(1.0)
        };
        let turned = self.own.iter().zip(&self.prescribed);
        system.use_boundary_normals(turned.map(|(a, b)| slerp(a, b, self.tried)).collect());
        let options = if self.tried >= 1.0 {
            self.options.to_the_end()
        } else {
            self.options
        };
        Next::Run(Run::iterate(system, self.x.clone(), options, control))
    }

    /// The end of the way short of the prescribed normals.
    fn short(&self) -> Next {
        if self.reached == 0.0 {
            return Next::Short(SolveStatus::Failed);
        }
        let angles: Vec<f64> = angles(&self.own, &self.prescribed).collect();
        let mut farthest: Vec<u32> = (0..angles.len() as u32).collect();
        order::by_number(&mut farthest, |&i| !order::ascending(angles[i as usize]));
        farthest.truncate(NAMED);
        Next::Short(SolveStatus::NormalsNotReached {
            reached: self.reached,
            farthest,
        })
    }
}

/// The boundary normals that the membrane has of itself, where it has any.
fn membrane_normals(system: &mut System) -> Vec<Vector3<f64>> {
    let membrane = system.membrane();
    let free = system.free();
    let equations = system.equations();
    let of = |(b, prescribed): (usize, &Vector3<f64>)| {
        average(&membrane, free + b, equations.rings.boundary_triangles(b)).unwrap_or(*prescribed)
    };
    system.boundary_normals().iter().enumerate().map(of).collect()
}

fn angles(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> impl Iterator<Item = f64> {
    a.iter().zip(b).map(|(a, b)| angle(a, b))
}
