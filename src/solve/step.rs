//! One quasi-Newton step: both parts by the frozen matrices, how large they are, and how they are added.

use fairmesh_linear::parallel;
use nalgebra::Vector3;

use super::direction;
use super::factor::Factor;
use super::formulation::Formulation;
use super::system::System;
use crate::discrete::equations::State;
use crate::discrete::valence_batches::CHUNK;
use crate::support::profile::clock;

/// Tangential steps below this, in diagonals, are projected.
/// Of 128 cases, half: 62 change by up to 3 edges, 7 get another triangulation, -1 % iterations;
/// double: 55 change by up to 3 edges, 4 get another triangulation, -3 % iterations, 1 fails.
const PROJECTED_BELOW: f64 = 1e-3;

/// One quasi-Newton step's size, in diagonals.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepNorm {
    /// Root mean square of the normal step.
    pub normal: f64,
    /// Root mean square of the tangential step.
    pub tangential: f64,
    /// The largest normal step of a single vertex.
    pub largest: f64,
}

impl StepNorm {
    /// Both together: what tolerances are about.
    pub(crate) fn total(&self) -> f64 {
        self.normal + self.tangential
    }
}

impl System {
    /// The quasi-Newton step at the last evaluation, as one vector of three numbers per free vertex: along the normals
    /// (see [`direction`]) `P^-1 R1`, and the tangential field `G^-1(inner residual)`, if there is to be one.
    pub(crate) fn step(&mut self, step: &mut [f64], formulation: &Formulation) -> StepNorm {
        let has_inner = !formulation.along_normals;
        let (state, p, g) = (&self.state, &mut self.p, &mut self.g);
        let (t, d) = (&mut self.normal_step, &mut self.tangential_step);
        parallel::join(
            || {
                t.iter_mut().zip(&state.outer).for_each(|(t, r)| *t = [*r]);
                let _clock = clock("solves with P");
                p.solve(t);
            },
            || {
                if has_inner {
                    solve_inner(g, state, d);
                } else {
                    d.fill([0.0; 3]);
                }
            },
        );
        let (step, modes) = step.split_at_mut(3 * self.free());
        if let Some(continuity) = self.continuity.take() {
            continuity.correct((&self.metric, &self.domain.rings), &mut self.normal_step, modes);
            self.continuity = Some(continuity);
        }
        let norm = self.step_norm();
        self.combine(&norm, step);
        norm
    }

    /// The tangential part alone of that step.
    pub(crate) fn inner_step(&mut self, step: &mut [f64]) {
        self.normal_step.fill([0.0]);
        solve_inner(&mut self.g, &self.state, &mut self.tangential_step);
        let norm = self.step_norm();
        self.combine(&norm, step);
    }

    fn step_norm(&self) -> StepNorm {
        // Chunk after chunk: the same sum for any number of threads.
        let chunks = self
            .normal_step
            .chunks(CHUNK)
            .zip(self.tangential_step.chunks(CHUNK));
        let parts = parallel::map(chunks, |_, (t, d)| squares(t, d));
        let sum = |k: usize| parts.iter().map(|part| part[k]).sum::<f64>();
        let rms = |sum: f64| (sum / self.free() as f64).sqrt() / self.diagonal;
        StepNorm {
            normal: rms(sum(0)),
            tangential: rms(sum(1)),
            largest: parts.iter().fold(0.0f64, |m, part| m.max(part[2])) / self.diagonal,
        }
    }

    /// Adds both parts. Far from the solution the tangential field is taken as it is: projecting it with each vertex's own
    /// normal would turn the crowding of a collapsed feature into normal noise. Near the solution it is projected, or
    /// each equation would disturb the other.
    fn combine(&self, norm: &StepNorm, step: &mut [f64]) {
        let project = norm.tangential < PROJECTED_BELOW;
        let disk = self.state.area.iter().sum::<f64>() / self.free() as f64;
        let rounds = direction::rounds(norm.largest * self.diagonal, disk);
        let _clock = clock("steps of both equations");
        let averaged = (rounds > 0).then(|| {
            direction::averaged(
                &self.domain.rings,
                &self.state.normal,
                &self.boundary_normals,
                rounds,
            )
        });
        let along = averaged.as_ref().unwrap_or(&self.state.normal);
        let steps: &mut [[f64; 3]] = step.as_chunks_mut().0;
        parallel::for_each(steps.chunks_mut(CHUNK), |chunk, steps| {
            for (i, step) in (chunk * CHUNK..).zip(steps) {
                let n = &self.state.normal[i];
                let d = Vector3::from(self.tangential_step[i]);
                let off = if project { d.dot(n) } else { 0.0 };
                for c in 0..3 {
                    step[c] = self.normal_step[i][0] * along[i][c] - off * n[c] + d[c];
                }
            }
        });
    }

    /// The normal part of the last step.
    pub(crate) fn normal_step(&self, step: &mut [f64]) {
        for ((s, t), n) in step
            .chunks_exact_mut(3)
            .zip(&self.normal_step)
            .zip(&self.state.normal)
        {
            s.copy_from_slice((n * t[0]).as_slice());
        }
    }
}

/// The sums of the squares of normal and tangential steps, and the largest normal one.
fn squares(t: &[[f64; 1]], d: &[[f64; 3]]) -> [f64; 3] {
    let normal = t.iter().map(|[t]| t * t).sum();
    let tangential = d.iter().map(|d| d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sum();
    [normal, tangential, t.iter().fold(0.0f64, |m, [t]| m.max(t.abs()))]
}

/// `G d = ` inner residual (7.3).
fn solve_inner(g: &mut Factor, state: &State, d: &mut [[f64; 3]]) {
    d.iter_mut()
        .zip(&state.inner)
        .for_each(|(d, r)| *d = [r.x, r.y, r.z]);
    let _clock = clock("solves with G");
    g.solve(d);
}
