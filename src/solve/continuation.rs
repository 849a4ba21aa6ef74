//! From the tangent-continuous surface to the curvature-continuous one: the same iteration with further unknowns.

use nalgebra::Vector3;

use super::attempt::DIRECT;
use super::boundary_curvature::{LoopCondition, loop_conditions};
use super::candidate::Candidate;
use super::control::Control;
use super::quasi_newton::{IterateOptions, Iteration, IterationStatus};
use super::result::{LoopContinuity, SolveResult, SolveStatus, Trial};
use super::system::System;

/// What to call it in progress reports.
const PHASE: &str = "curvature continuity";
/// Where the whole way does not lead to a surface as sound as the tangent-continuous one, this part of it is tried,
const SHORTER: f64 = 0.5;
/// so many times.
const TRIES: usize = 3;
/// Where less of the way can be trusted on all loops, none of it is gone.
const LEAST_REACHED: f64 = 1e-3;
/// No boundary normal is missed by more than this factor, against the tangent-continuous surface,
const DEVIATION: f64 = 1.1;
/// or by so many degrees more: triangles deviate from the surface's own normals, the more it is curved.
const DEVIATION_DEGREES: f64 = 0.5;

/// A way to the curvature-continuous surface.
#[derive(Debug)]
pub(crate) struct Continuation {
    /// The tangent-continuous surface,
    tangent: SolveResult,
    /// judged.
    judged: Candidate,
    deviation: f64,
    /// Iterations until then.
    before: usize,
    iteration: Box<Iteration>,
    /// The part of the way that is tried, and how many parts were.
    part: f64,
    tries: usize,
}

impl Continuation {
    /// Begins at the tangent-continuous result, if curvature is to be continued and can be; else returns that as it is.
    pub(super) fn begin(
        tangent: SolveResult,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Result<Self, Box<SolveResult>> {
        let is_harmonic = matches!(
            tangent.status,
            SolveStatus::Converged | SolveStatus::ConvergedToRounding | SolveStatus::AboveTolerance
        );
        let Some(asked) = system
            .asked_continuity()
            .filter(|_| is_harmonic && !control.exhausted())
        else {
            return Err(Box::new(tangent));
        };
        let loops = loop_conditions(
            &system.domain,
            &system.boundary_normals,
            (&tangent.x, &system.state.h),
            &asked,
        );
        if loops.iter().all(|l| l.trusted.part < LEAST_REACHED) {
            let continuity = loops.iter().map(|l| came_of(l, 0.0, &l.before)).collect();
            return Err(Box::new(SolveResult {
                continuity,
                ..tangent
            }));
        }
        if tangent.along_normals {
            system.step_along_normals();
        }
        let judged = Candidate::new(
            system,
            tangent.x.clone(),
            IterationStatus::Converged,
            tangent.step,
        );
        let deviation = largest_deviation(system, &tangent);
        let iteration = Iteration::new(system, tangent.x.clone(), OPTIONS, control);
        let mut this = Self {
            judged,
            deviation,
            before: control.tally.iterations,
            iteration: Box::new(iteration),
            part: asked.blend,
            tries: 0,
            tangent,
        };
        system.set_continuity(loops);
        match this.try_part(system, control) {
            Some(result) => Err(Box::new(result)),
            None => Ok(this),
        }
    }

    /// One iteration. Returns the result, if that was the last.
    pub(super) fn advance(&mut self, system: &mut System, control: &mut Control<'_>) -> Option<SolveResult> {
        let status = self.iteration.advance(system, control)?;
        self.conclude(status, system, control)
    }

    /// The surface at hand.
    pub(super) fn x(&self) -> &[Vector3<f64>] {
        &self.iteration.x
    }

    /// Tries the part of the way that is due, from the tangent-continuous surface.
    fn try_part(&mut self, system: &mut System, control: &mut Control<'_>) -> Option<SolveResult> {
        self.tries += 1;
        system.aim(self.part);
        *self.iteration = Iteration::new(system, self.tangent.x.clone(), OPTIONS, control);
        let status = self.iteration.begin(system, control)?;
        self.conclude(status, system, control)
    }

    fn conclude(
        &mut self,
        status: IterationStatus,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Option<SolveResult> {
        let candidate = self.iteration.candidate(status, system);
        if candidate.is_stopped() {
            let status = if control.cancelled {
                SolveStatus::Cancelled
            } else {
                SolveStatus::IterationLimit
            };
            return Some(self.result(candidate, status, system, control));
        }
        if self.is_as_sound(&candidate, system) {
            let status = self.tangent.status.clone();
            return Some(self.result(candidate, status, system, control));
        }
        if self.tries < TRIES && !control.exhausted() {
            self.part *= SHORTER;
            return self.try_part(system, control);
        }
        Some(self.give_up(system, control))
    }

    /// Whether a surface is no worse than the tangent-continuous one.
    fn is_as_sound(&self, candidate: &Candidate, system: &System) -> bool {
        let deviations = system.surface(&candidate.x).normal_deviations();
        let deviation = deviations.into_iter().fold(0.0, f64::max);
        (candidate.is_converged() || candidate.is_at_rounding())
            && candidate.poor.len() <= self.judged.poor.len()
            && (!candidate.has_bump() || self.judged.has_bump())
            && candidate.creases <= self.judged.creases
            && candidate.suspicious_normals <= self.judged.suspicious_normals
            && deviation <= (DEVIATION * self.deviation).max(self.deviation + DEVIATION_DEGREES)
    }

    fn result(
        &mut self,
        candidate: Candidate,
        status: SolveStatus,
        system: &System,
        control: &Control<'_>,
    ) -> SolveResult {
        self.told(control, Some(&candidate), system);
        SolveResult {
            status,
            step: candidate.step,
            defect: system.defect(),
            continuity: reached(system, self.part, (&candidate.x, &system.state.h)),
            poor: candidate.poor,
            x: candidate.x,
            ..self.tangent.clone()
        }
    }

    /// The tangent-continuous surface.
    fn give_up(&mut self, system: &mut System, control: &Control<'_>) -> SolveResult {
        system.aim(0.0);
        system.set_modes(&[]);
        system.evaluate(&self.tangent.x);
        self.told(control, None, system);
        SolveResult {
            continuity: reached(system, 0.0, (&self.tangent.x, &system.state.h)),
            ..self.tangent.clone()
        }
    }

    /// Adds the iterations and what was tried.
    fn told(&mut self, control: &Control<'_>, candidate: Option<&Candidate>, system: &System) {
        let iterations = control.tally.iterations - self.before;
        self.tangent.iterations += iterations;
        self.tangent.trials.push(Trial {
            free: system.free(),
            name: PHASE,
            iterations,
            ended: candidate.map(Candidate::end),
            bending_energy: candidate.map_or(f64::NAN, |c| c.bending_energy),
        });
    }
}

const OPTIONS: IterateOptions = IterateOptions {
    phase: PHASE,
    ..DIRECT
};

fn largest_deviation(system: &System, result: &SolveResult) -> f64 {
    let deviations = system.surface(&result.x).normal_deviations();
    deviations.into_iter().fold(0.0, f64::max)
}

/// What came of each loop, whose surface has these mean curvatures.
fn reached(system: &System, part: f64, surface: (&[Vector3<f64>], &[f64])) -> Vec<LoopContinuity> {
    let loops = system.continuity().map_or(&[][..], |c| &c.loops);
    let inside = |l: &LoopCondition| l.curvature_inside(system.free(), surface, &system.boundary_normals);
    loops
        .iter()
        .map(|l| came_of(l, part * l.trusted.part, &inside(l)))
        .collect()
}

/// What came of a loop where the surface has this mean curvature.
fn came_of(l: &LoopCondition, reached: f64, inside: &[f64]) -> LoopContinuity {
    LoopContinuity {
        vertex: l.vertices[0],
        vertices: l.vertices.len(),
        reached,
        jump_before: l.jump(&l.before),
        jump: l.jump(inside),
        curvature: l.modes.product(&l.surroundings, &l.surroundings).sqrt(),
        uncertainty: l.trusted.uncertainty,
    }
}
