//! From the tangent-continuous surface to the curvature-continuous one: the same iteration with further unknowns.

use nalgebra::Vector3;

use crate::solve::attempt::DIRECT;
use crate::solve::candidate::Candidate;
use crate::solve::control::Control;
use crate::solve::formulation::Formulation;
use crate::solve::g2::blend_search::BlendSearch;
use crate::solve::g2::boundary_curvature::{Blend, LoopCondition, loop_conditions};
use crate::solve::iterate_options::{IterateOptions, IterationStatus};
use crate::solve::quasi_newton::Iteration;
use crate::solve::result::{LoopContinuity, SolveResult, SolveStatus, Trial};
use crate::solve::system::System;

/// What to call it in progress reports.
pub(crate) const PHASE: &str = "curvature continuity";
/// So many parts of the way are tried at most.
/// Of 2 cases, half: 1 changes by up to 0.2 edges, -11 % iterations; double: none changes.
const TRIES: usize = 6;
/// Less than this part of the way, or of the curvature, is nothing.
/// Half or double, of 14 cases: none changes.
const NEGLIGIBLE: f64 = 1e-3;
/// No boundary normal is missed by more than the tangent-continuous surface misses it, times this.
/// Of 9 cases, half: 1 changes by up to 0.3 edges, +8 % iterations; double: 1 changes by up to 2 edges, -15 % iterations.
const DEVIATION: f64 = 1.1;
/// Degrees that a boundary normal may be missed by besides: triangles deviate from the surface's own normals, the more it is curved.
/// Of 9 cases, half: 2 change by up to 0.05 edges, +3 % iterations; double: 1 changes by up to 0.06 edges.
const DEVIATION_DEGREES: f64 = 0.5;

/// A way to the curvature-continuous surface.
#[derive(Debug)]
pub(crate) struct Continuation {
    /// The tangent-continuous surface,
    tangent: SolveResult,
    /// judged.
    judged: Candidate,
    /// How far a surface may deviate from the boundary normals, in degrees.
    allowed: f64,
    /// Iterations until then, and until the last trial.
    before: usize,
    formulation: Formulation,
    iteration: Box<Iteration>,
    /// The part of the way that is tried, for each loop, and how many were.
    ways: BlendSearch,
    tries: usize,
    /// As far as it went so far.
    best: Option<SolveResult>,
}

/// The conditions along the loops of the tangent-continuous surface `x`, which was evaluated last, where curvature is to be continued.
pub(in crate::solve) fn conditions(x: &[Vector3<f64>], system: &System) -> Option<Vec<LoopCondition>> {
    let asked = system.asked_continuity()?;
    let surface = (x, &*system.state.h);
    Some(loop_conditions(
        &system.domain,
        &system.boundary_normals,
        surface,
        &asked,
    ))
}

/// Whether there is nothing to continue.
pub(in crate::solve) fn is_nothing(loops: &[LoopCondition]) -> bool {
    loops.iter().all(|l| l.trusted.part < NEGLIGIBLE)
}

/// What is told of loops along which the tangent-continuous surface `x`, which was evaluated last, stays as it is.
pub(in crate::solve) fn as_they_are(
    loops: &[LoopCondition],
    x: &[Vector3<f64>],
    system: &System,
) -> Vec<LoopContinuity> {
    let surface = (x, &*system.state.h);
    let inside = |l: &LoopCondition| l.curvature_inside(system.free(), surface, &system.boundary_normals);
    let told = |l: &LoopCondition| {
        let inside = inside(l);
        LoopContinuity {
            jump_before: l.jump(&inside),
            ..came_of(l, 0.0, &inside)
        }
    };
    loops.iter().map(told).collect()
}

/// How a continuation ends.
#[derive(Debug)]
pub(in crate::solve) enum Ended {
    /// With the surface that went furthest, or was stopped.
    Continued(SolveResult),
    /// No surface was as sound as the tangent-continuous one, which this is.
    Nowhere(SolveResult),
}

impl Continuation {
    /// From the tangent-continuous surface, which is judged so and was evaluated last, with something to continue along these loops.
    pub(in crate::solve) fn new(
        (tangent, judged): (SolveResult, Candidate),
        loops: Vec<LoopCondition>,
        formulation: Formulation,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Self {
        let deviations = system.surface(&tangent.x).normal_deviations();
        let deviation = largest(deviations.iter());
        let allowed = (DEVIATION * deviation).max(deviation + DEVIATION_DEGREES);
        let asked = loops.iter().map(|l| {
            let along = l.vertices.iter().map(|&b| &deviations[b as usize]);
            (l.asked.part(), largest(along))
        });
        let ways = BlendSearch::new(asked, allowed);
        system.set_continuity(loops);
        Self {
            judged,
            allowed,
            before: control.tally.iterations,
            iteration: along(&ways, &tangent, &formulation, system, control),
            formulation,
            ways,
            tries: 1,
            best: None,
            tangent,
        }
    }

    /// Part after part of the way. `None`: the run is held up.
    pub(in crate::solve) fn run(&mut self, system: &mut System, control: &mut Control<'_>) -> Option<Ended> {
        loop {
            let status = self.iteration.run(system, control)?;
            if let Some(ended) = self.conclude(status, system, control) {
                return Some(ended);
            }
            self.tries += 1;
            self.iteration = along(&self.ways, &self.tangent, &self.formulation, system, control);
        }
    }

    /// The surface at hand.
    pub(in crate::solve) fn x(&self) -> &[Vector3<f64>] {
        self.iteration.x()
    }

    /// Evaluates both equations there.
    pub(in crate::solve) fn evaluate_at_hand(&mut self, system: &mut System) {
        self.iteration.evaluate_at_hand(system);
    }

    /// After the iteration with the parts that were tried: the result, if there are no others to try.
    fn conclude(
        &mut self,
        status: IterationStatus,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Option<Ended> {
        let candidate = self.iteration.candidate(status, system);
        self.told(control, &candidate, system.free());
        if candidate.is_stopped() && (self.best.is_none() || control.cancelled) {
            let status = if control.cancelled {
                SolveStatus::Cancelled
            } else {
                SolveStatus::IterationLimit
            };
            return Some(Ended::Continued(self.result(candidate, status, system)));
        }
        let grown = self.grown_jumps(&candidate, system);
        let is_left = if self.is_as_sound(&candidate) && !grown.is_empty() {
            self.ways.leave(&grown)
        } else if self.is_as_sound(&candidate) {
            let deviations = system.surface(&candidate.x).normal_deviations();
            let loops = system.continuity().map_or(&[][..], |c| &c.loops);
            let along = |l: &LoopCondition| largest(l.vertices.iter().map(|&b| &deviations[b as usize]));
            let is_met =
                self.ways.note(loops.iter().map(along)) && largest(deviations.iter()) <= self.allowed;
            if is_met {
                let status = self.tangent.status.clone();
                self.best = Some(self.result(candidate, status, system));
            }
            self.ways.narrow() || self.best.is_none() && self.ways.shorten()
        } else {
            self.best.is_none() && self.ways.shorten()
        };
        let goes_on = is_left && self.tries < TRIES && !control.exhausted();
        (!goes_on).then(|| self.best_of_tries(system))
    }

    /// Whether a surface is no worse than the tangent-continuous one, but for boundary normals.
    fn is_as_sound(&self, candidate: &Candidate) -> bool {
        (candidate.is_converged() || candidate.is_at_rounding())
            && candidate.poor.len() <= self.judged.poor.len()
            && (!candidate.has_bump() || self.judged.has_bump())
            && candidate.creases <= self.judged.creases
            && candidate.suspicious_normals <= self.judged.suspicious_normals
    }

    /// The loops along which the jump of the curvature has become larger, as at corners that their modes do not resolve.
    fn grown_jumps(&self, candidate: &Candidate, system: &System) -> Vec<usize> {
        let told = reached(system, &self.ways.parts(), (&candidate.x, &system.state.h));
        let is_grown = |l: &LoopContinuity| {
            l.reached > 0.0 && l.jump[0] > l.jump_before[0].max(NEGLIGIBLE * l.curvature)
        };
        (0..told.len()).filter(|&k| is_grown(&told[k])).collect()
    }

    fn result(&self, candidate: Candidate, status: SolveStatus, system: &System) -> SolveResult {
        SolveResult {
            status,
            step: candidate.step,
            defect: system.defect(&self.formulation),
            continuity: reached(system, &self.ways.parts(), (&candidate.x, &system.state.h)),
            poor: candidate.poor,
            x: candidate.x,
            ..self.tangent.clone()
        }
    }

    /// The surface that went furthest, or else the tangent-continuous one.
    fn best_of_tries(&mut self, system: &mut System) -> Ended {
        let best = self.best.take();
        let x = best.as_ref().map_or(&self.tangent.x, |best| &best.x);
        system.set_modes(&[]);
        system.evaluate(x, &self.formulation);
        match best {
            Some(best) => Ended::Continued(SolveResult {
                iterations: self.tangent.iterations,
                trials: self.tangent.trials.clone(),
                ..best
            }),
            None => Ended::Nowhere(self.tangent.clone()),
        }
    }

    /// Adds the iterations and what was tried.
    fn told(&mut self, control: &Control<'_>, candidate: &Candidate, free: usize) {
        let iterations = control.tally.iterations - self.before;
        self.before = control.tally.iterations;
        self.tangent.iterations += iterations;
        self.tangent.trials.push(Trial {
            free,
            name: PHASE,
            iterations,
            ended: Some(candidate.end()),
            bending_energy: candidate.bending_energy,
        });
    }
}

const OPTIONS: IterateOptions = IterateOptions {
    phase: PHASE,
    ..DIRECT
};

/// The parts of the way that are due, from the tangent-continuous surface.
fn along(
    ways: &BlendSearch,
    tangent: &SolveResult,
    formulation: &Formulation,
    system: &mut System,
    control: &Control<'_>,
) -> Box<Iteration> {
    system.aim(&ways.parts());
    let (formulation, x) = (formulation.clone(), tangent.x.clone());
    Box::new(Iteration::new(system, formulation, x, OPTIONS, control))
}

fn largest<'a>(deviations: impl Iterator<Item = &'a f64>) -> f64 {
    deviations.copied().fold(0.0, f64::max)
}

/// What came of each loop, whose surface has these mean curvatures.
fn reached(system: &System, parts: &[f64], surface: (&[Vector3<f64>], &[f64])) -> Vec<LoopContinuity> {
    let loops = system.continuity().map_or(&[][..], |c| &c.loops);
    let inside = |l: &LoopCondition| l.curvature_inside(system.free(), surface, &system.boundary_normals);
    let with_parts = loops.iter().zip(parts);
    with_parts
        .map(|(l, part)| came_of(l, part * l.trusted.part, &inside(l)))
        .collect()
}

/// What came of a loop where the surface has this mean curvature.
fn came_of(l: &LoopCondition, reached: f64, inside: &[f64]) -> LoopContinuity {
    let jump = l.jump(inside);
    let curvature = l.modes.product(&l.surroundings, &l.surroundings).sqrt();
    let uncertainty = l.trusted.uncertainty;
    LoopContinuity {
        is_short: l.asked != Blend::Auto
            && reached < 0.5 * l.asked.part()
            && jump[0] > uncertainty.max(NEGLIGIBLE * curvature),
        vertex: l.vertices[0],
        vertices: l.vertices.len(),
        asked: l.asked,
        reached,
        jump_before: l.jump(&l.before),
        jump,
        curvature,
        uncertainty,
    }
}
