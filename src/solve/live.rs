//! Frames: the surface follows boundary data that change a little at a time, by the steps of [`quasi_newton`](super::quasi_newton) with
//! matrices that stay as they are while they serve, and from where the surfaces before lead to. It can be held up after every evaluation.

use nalgebra::Vector3;

use super::bilaplacian::conormal_flux;
use super::limited_step::{LARGEST_CHANGE, advance_limited};
use super::problem::diagonal;
use super::system::System;
use crate::stopwatch::Stopwatch;
use fairmesh_linear::anderson::Anderson;

/// Steps that Anderson acceleration looks back on, those of the frames before among them;
const WINDOW: usize = 16;
/// on large regions that would cost more memory than the matrix.
const WINDOW_OF_LARGE: usize = 8;
/// The largest region with the longer history.
const LONG_UP_TO: usize = 50_000;
/// Growth of the step norm over the best after which an accelerated step is taken back.
const SAFE_GROWTH: f64 = 3.0;
/// An accelerated step that would change an edge by more than so many times [`LARGEST_CHANGE`] extrapolates too far.
const LARGEST_EXCESS: f64 = 2.0;
/// The matrix is made anew when the step norm grows to so many times the best,
const DIVERGED: f64 = 10.0;
/// or when it has not become smaller by [`STALL`] in so many steps.
const PATIENCE: usize = 8;
const STALL: f64 = 0.7;
/// But not more often than this before the boundary data change again.
const MATRICES: usize = 3;
/// A surface whose area has changed by more than this factor gets a matrix of its own before it is finished.
const LARGEST_GROWTH: f64 = 1.1;
/// The last step may be longer than the plain one by this factor when accelerated.
const LONGEST_LAST: f64 = 2.0;

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

/// Whether there is more to be done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stand {
    Underway,
    /// Neither steps nor another matrix help.
    Stuck,
}

/// A surface that was evaluated, with the quasi-Newton step there.
#[derive(Debug, Clone)]
struct Evaluated {
    x: Vec<Vector3<f64>>,
    step: Vec<f64>,
    /// Its step norm, in diagonals.
    d: f64,
}

/// A surface that follows its boundary data.
#[derive(Debug, Clone)]
pub(crate) struct Live {
    /// The surface to be evaluated next.
    x: Vec<Vector3<f64>>,
    /// Since the boundary data have changed, or the matrix: the one of smallest step norm.
    best: Evaluated,
    /// The surface to be shown.
    shown: Vec<Vector3<f64>>,
    /// The last surface that had settled: where it goes on from where neither steps nor matrices have helped.
    settled: Vec<Vector3<f64>>,
    /// The step norm that led to what is shown.
    step_norm: f64,
    is_folded: bool,
    anderson: Anderson,
    step: Vec<f64>,
    accelerated: Vec<f64>,
    taken: f64,
    was_accelerated: bool,
    /// The area of the surface that the matrix was made at.
    matrix_area: f64,
    wants_matrix: bool,
    matrices: usize,
    history: Vec<f64>,
    stand: Stand,
}

impl Live {
    /// From a surface that solved a problem close to the one at hand.
    pub(crate) fn new(system: &System, x: Vec<Vector3<f64>>) -> Self {
        let n = 3 * system.free();
        let window = if system.free() > LONG_UP_TO {
            WINDOW_OF_LARGE
        } else {
            WINDOW
        };
        Self {
            best: Evaluated {
                x: x.clone(),
                step: vec![0.0; n],
                d: f64::INFINITY,
            },
            shown: x.clone(),
            settled: x.clone(),
            x,
            step_norm: f64::INFINITY,
            is_folded: false,
            anderson: Anderson::new(n, window),
            step: vec![0.0; n],
            accelerated: vec![0.0; n],
            taken: 1.0,
            was_accelerated: false,
            matrix_area: f64::NAN,
            wants_matrix: false,
            matrices: 0,
            history: Vec::new(),
            stand: Stand::Underway,
        }
    }

    /// Goes on from another surface that solved the problem so far.
    pub(crate) fn take(&mut self, x: &[Vector3<f64>]) {
        self.stand = Stand::Underway;
        self.matrix_area = f64::NAN;
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
    pub(crate) fn aim(&mut self, system: &mut System, boundary: &[Vector3<f64>], normals: &[Vector3<f64>]) {
        if self.stand == Stand::Stuck {
            self.shown.clone_from(&self.settled);
            self.anderson.clear();
        }
        self.x.clone_from(&self.shown);
        let free = system.free();
        if self.x[free..] != *boundary {
            system.carry(&mut self.x, boundary, normals);
            self.shown[free..].copy_from_slice(boundary);
            system.diagonal = diagonal(&self.x);
        }
        self.best.d = f64::INFINITY;
        self.step_norm = f64::INFINITY;
        self.is_folded = false;
        self.anderson.resume();
        self.was_accelerated = false;
        self.matrices = 0;
        self.history.clear();
        self.stand = Stand::Underway;
    }

    /// Evaluates and steps until the surface is within the tolerance, or the allowance is spent.
    pub(crate) fn frame(&mut self, system: &mut System, tolerance: f64, allowance: &mut Allowance) {
        while !self.is_settled(tolerance) && self.stand == Stand::Underway && allowance.left() > 0 {
            allowance.spent += 1;
            system.end_continuity();
            self.advance(system, tolerance);
        }
    }

    fn advance(&mut self, system: &mut System, tolerance: f64) {
        if self.wants_matrix {
            self.wants_matrix = false;
            self.matrix_area = f64::NAN;
            if system.rebuild(&self.x, true).is_err() {
                self.stand = Stand::Stuck;
                return;
            }
        } else {
            system.evaluate(&self.x);
        }
        let d = system.step(&mut self.step).total() * self.growth(system);
        if d < self.best.d {
            self.best.d = d;
            self.best.x.clone_from(&self.x);
            self.best.step.clone_from(&self.step);
            self.shown.clone_from(&self.x);
            self.step_norm = d;
        }
        if d <= tolerance {
            self.settle(system);
        } else if self.is_stalling(d) {
            self.begin_anew();
        } else if self.was_accelerated && d > SAFE_GROWTH * self.best.d {
            self.go_back(system);
        } else {
            self.accelerate(system);
        }
    }

    /// By how much the surface has grown since the matrix was made: steps are too short by as much, and would seem to have settled.
    fn growth(&mut self, system: &System) -> f64 {
        let area: f64 = system.state.area.iter().sum();
        if self.matrix_area.is_nan() {
            self.matrix_area = area;
        }
        (area / self.matrix_area).max(1.0)
    }

    /// Makes the matrix at the surface shown if that has grown or shrunk since: what goes on from there judges itself by the steps.
    pub(crate) fn refresh(&mut self, system: &mut System) {
        let area: f64 = system.state.area.iter().sum();
        let change = area / self.matrix_area;
        if change.max(1.0 / change) > LARGEST_GROWTH {
            // Where it fails, so do the steps, and the solve begins anew.
            let _ = system.rebuild(&self.shown, true);
            self.matrix_area = f64::NAN;
        }
    }

    /// The surface after the step at hand, which nothing is evaluated at any more.
    fn settle(&mut self, system: &System) {
        self.is_folded = !system.poor(&self.x, 0.0).is_empty();
        if self.is_folded {
            return self.begin_anew();
        }
        self.anderson
            .accelerate(&self.step, self.taken, &mut self.accelerated);
        let square = |step: &[f64]| step.iter().map(|s| s * s).sum::<f64>();
        let is_alike = square(&self.accelerated) <= LONGEST_LAST * LONGEST_LAST * square(&self.step);
        let step = if is_alike { &self.accelerated } else { &self.step };
        let change = system.edge_change(&self.x, step);
        self.taken = advance_limited(&mut self.x, step, change, LARGEST_CHANGE);
        self.was_accelerated = is_alike;
        if !is_alike {
            self.anderson.clear();
        }
        self.shown.clone_from(&self.x);
        self.settled.clone_from(&self.x);
    }

    fn is_stalling(&mut self, d: f64) -> bool {
        self.history.push(d);
        let last = self.history.len() - 1;
        let is_slow = last >= PATIENCE && d > STALL * self.history[last - PATIENCE];
        !d.is_finite() || d > DIVERGED * self.best.d || is_slow
    }

    /// From the best surface on, with a matrix made there.
    fn begin_anew(&mut self) {
        self.matrices += 1;
        if self.matrices > MATRICES || !self.best.d.is_finite() {
            self.stand = Stand::Stuck;
            return;
        }
        self.x.clone_from(&self.best.x);
        self.wants_matrix = true;
        self.best.d = f64::INFINITY;
        self.anderson.clear();
        self.was_accelerated = false;
        self.history.clear();
    }

    /// Back to the best surface, and from there without history.
    fn go_back(&mut self, system: &System) {
        self.x.clone_from(&self.best.x);
        self.step.clone_from(&self.best.step);
        self.anderson.clear();
        self.plain_step(system);
    }

    fn accelerate(&mut self, system: &System) {
        self.anderson
            .accelerate(&self.step, self.taken, &mut self.accelerated);
        let change = system.edge_change(&self.x, &self.accelerated);
        if change <= LARGEST_EXCESS * LARGEST_CHANGE {
            self.taken = advance_limited(&mut self.x, &self.accelerated, change, LARGEST_CHANGE);
            self.was_accelerated = true;
        } else {
            self.anderson.clear();
            self.plain_step(system);
        }
    }

    fn plain_step(&mut self, system: &System) {
        let change = system.edge_change(&self.x, &self.step);
        advance_limited(&mut self.x, &self.step, change, LARGEST_CHANGE);
        self.was_accelerated = false;
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
