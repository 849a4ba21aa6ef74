//! Frames: the surface follows boundary data that change a little at a time, by the same [`Iteration`], whose matrix stays as it is while it
//! serves. It can be held up after every evaluation.

use nalgebra::Vector3;

use super::attempt::DIRECT;
use super::bilaplacian::conormal_flux;
use super::control::Control;
use super::formulation::Formulation;
use super::iterate_options::{IterateOptions, IterationStatus};
use super::problem::diagonal;
use super::quasi_newton::Iteration;
use super::system::System;
use crate::support::stopwatch::Stopwatch;

/// A surface whose area has changed by more than this factor gets a matrix of its own before it is finished.
/// Of 6 cases, half: 2 change by up to 5e-10 edges; double: 2 change by up to 6e-8 edges, +10 % iterations.
const LARGEST_GROWTH: f64 = 1.1;

/// With the matrix at hand, and up to three more before the boundary data change again.
const FOLLOWING: IterateOptions = IterateOptions {
    patience: 8,
    rounds: 4,
    reuse_factor: true,
    follows: true,
    ..DIRECT
};

/// What a frame may cost, and what it has cost.
#[derive(Debug)]
pub(crate) struct Allowance {
    evaluations: usize,
    seconds: f64,
    clock: Stopwatch,
    /// Evaluations made.
    pub(crate) spent: usize,
}

impl Allowance {
    /// So many evaluations and seconds since `clock`; without limit where they are 0. Of the time alone one evaluation is always left.
    pub(crate) fn new(evaluations: usize, seconds: f64, clock: Stopwatch) -> Self {
        Self {
            evaluations,
            seconds,
            clock,
            spent: 0,
        }
    }

    /// How many evaluations are left.
    pub(crate) fn left(&self) -> usize {
        let is_late = self.seconds > 0.0 && self.spent > 0 && self.clock.seconds() >= self.seconds;
        match self.evaluations {
            _ if is_late => 0,
            0 => usize::MAX,
            most => most - self.spent.min(most),
        }
    }
}

/// A surface that follows its boundary data.
#[derive(Debug, Clone)]
pub(crate) struct Live {
    iteration: Iteration,
    /// The surface to be shown.
    shown: Vec<Vector3<f64>>,
    /// The last surface that had settled: where it goes on from where neither steps nor matrices have helped.
    settled: Vec<Vector3<f64>>,
    /// The step norm that led to what is shown.
    step_norm: f64,
    /// What is shown meets the tolerance, with folded triangles.
    is_folded: bool,
    /// Neither steps nor another matrix help.
    is_stuck: bool,
}

impl Live {
    /// From a surface that solved a problem close to the one at hand.
    pub(crate) fn new(system: &mut System, formulation: Formulation, x: Vec<Vector3<f64>>) -> Self {
        system.end_continuity();
        let control = Control::new(0.0, usize::MAX, None);
        Self {
            iteration: Iteration::new(system, formulation, x.clone(), FOLLOWING, &control),
            shown: x.clone(),
            settled: x,
            step_norm: f64::INFINITY,
            is_folded: false,
            is_stuck: false,
        }
    }

    /// Goes on from another surface that solved the problem so far.
    pub(crate) fn take(&mut self, x: &[Vector3<f64>]) {
        self.is_stuck = false;
        self.iteration.take_matrix();
        self.shown.copy_from_slice(x);
        self.settled.copy_from_slice(x);
    }

    /// The surface to be shown.
    pub(crate) fn shown(&self) -> &[Vector3<f64>] {
        &self.shown
    }

    /// The step norm that led to it, in diagonals.
    pub(crate) fn step_norm(&self) -> f64 {
        self.step_norm
    }

    /// Whether it is within a tolerance, and not folded.
    pub(crate) fn is_settled(&self, tolerance: f64) -> bool {
        self.step_norm <= tolerance && !self.is_folded
    }

    /// Sets out for other boundary data, which the system has already but for the boundary's positions. `normals` are those before.
    pub(crate) fn aim(
        &mut self,
        system: &mut System,
        formulation: Formulation,
        boundary: &[Vector3<f64>],
        normals: &[Vector3<f64>],
    ) {
        if self.is_stuck {
            self.shown.clone_from(&self.settled);
            self.iteration.forget();
        }
        let free = system.free();
        let mut x = self.shown.clone();
        if x[free..] != *boundary {
            system.carry(&mut x, boundary, normals);
            self.shown[free..].copy_from_slice(boundary);
            system.diagonal = diagonal(&x);
        }
        self.iteration.follow(&x, formulation);
        self.step_norm = f64::INFINITY;
        (self.is_folded, self.is_stuck) = (false, false);
    }

    /// Evaluates and steps until the surface is within the tolerance, or the allowance is spent.
    pub(crate) fn frame(&mut self, system: &mut System, tolerance: f64, allowance: &mut Allowance) {
        self.iteration.set_tolerance(tolerance);
        while !self.is_settled(tolerance) && !self.is_stuck && allowance.left() > 0 {
            allowance.spent += 1;
            system.end_continuity();
            let mut control = Control::new(tolerance, usize::MAX, None);
            control.hold_after(1);
            let ended = self.iteration.run(system, &mut control);
            if let Some((x, d)) = self.iteration.best() {
                (self.step_norm, self.is_folded) = (d, d <= tolerance);
                self.shown.copy_from_slice(x);
            }
            match ended {
                None => {}
                Some(IterationStatus::Converged) => {
                    self.is_folded = false;
                    self.shown.copy_from_slice(self.iteration.x());
                    self.settled.clone_from(&self.shown);
                }
                Some(_) => self.is_stuck = true,
            }
        }
    }

    /// Makes the matrix at the surface shown if that has grown or shrunk since: what goes on from there judges itself by the steps.
    pub(crate) fn refresh(&mut self, system: &mut System) {
        if self.iteration.change_since_matrix(system) > LARGEST_GROWTH {
            // Where it fails, so do the steps, and the solve begins anew.
            let _ = system.rebuild(&self.shown, self.iteration.formulation());
            self.iteration.take_matrix();
        }
    }
}

impl System {
    /// Moves the boundary of `x` to other positions and carries the free vertices along, by the linear equation of the start (7.4) for what
    /// has changed, with the matrix that is there. `normals` are the boundary normals before.
    fn carry(&mut self, x: &mut [Vector3<f64>], boundary: &[Vector3<f64>], normals: &[Vector3<f64>]) {
        let domain = self.domain.clone();
        let (region, rings) = (&domain.region, &domain.rings);
        let free = region.free;
        let before = conormal_flux(region, rings, x, normals);
        let mut change = vec![[0.0; 3]; x.len()];
        for ((change, to), x) in change[free..].iter_mut().zip(boundary).zip(&mut x[free..]) {
            *change = (to - *x).into();
            *x = *to;
        }
        let mut flux = conormal_flux(region, rings, x, self.boundary_normals());
        for (after, before) in flux.as_flattened_mut().iter_mut().zip(before.as_flattened()) {
            *after -= before;
        }
        let (mut scratch, mut right) = (change.clone(), vec![[0.0; 3]; free]);
        self.metric
            .apply(rings, &change, Some(&flux), &mut scratch, &mut right);
        self.solve_p(&mut right);
        for (x, r) in x.iter_mut().zip(&right) {
            *x -= Vector3::from(*r);
        }
    }
}
