//! From the solver's surface back to the host's numbers and units, with all that is reported of it.

use std::time::Instant;

use nalgebra::Vector3;

use super::options::{Intersections, Options};
use super::prepared::Prepared;
use super::report::{LooseReason, Outcome, Report, Seconds, SelfIntersections, Solution};
use crate::discrete::equations::State;
use crate::intersections;
use crate::paper::LevelReport;
use crate::quality::crease::{Kink, creases, kinks};
use crate::quality::{Quality, Surface};
use crate::solve::problem::diagonal;
use crate::solve::{SolveResult, SolveStatus};

/// What was found, and what it is measured against.
pub(super) struct Found<'a> {
    /// The host's positions.
    pub(super) positions: &'a [[f64; 3]],
    pub(super) triangles: &'a [[u32; 3]],
    pub(super) prepared: &'a Prepared,
    pub(super) options: &'a Options,
    pub(super) result: &'a SolveResult,
    /// Evaluated at the result.
    pub(super) state: &'a State,
    pub(super) levels: Vec<LevelReport>,
    /// But for the figures themselves.
    pub(super) seconds: Seconds,
}

impl Found<'_> {
    /// Measures the surface, and takes it back.
    pub(super) fn conclude(self) -> Solution {
        let clock = Instant::now();
        let surface = self.surface();
        let positions = self.positions();
        let written = self.written(&positions);
        let domain = &self.prepared.domain;
        let (rings, input) = (&domain.rings, &domain.input);
        let mut quality = self.quality(&Surface {
            x: &written,
            ..surface
        });
        let kinks = kinks(&surface, rings, input);
        let creases = creases(&kinks);
        self.tell_kink(&mut quality, if creases.is_empty() { &kinks } else { &creases });
        let suspicious_normals = surface.suspicious_normals(rings, input);
        let scale = self.prepared.normalization.scale;
        let positions = self.positions();
        let self_intersections = self.self_intersections(&positions);
        Solution {
            positions,
            boundary_normals: self.boundary_normals(),
            mean_curvature: self.at_free_vertices(&self.state.h, scale),
            gaussian_curvature: self.at_free_vertices(&self.state.k, scale * scale),
            report: self.report(quality, suspicious_normals, &creases, self_intersections, clock),
        }
    }

    fn surface(&self) -> Surface<'_> {
        let region = &self.prepared.domain.region;
        Surface {
            region,
            x: &self.result.x,
            normals: &self.state.corrected,
            boundary_normals: &self.state.corrected[region.free..],
            h: &self.state.h,
        }
    }

    /// The figures, in the host's unit.
    fn quality(&self, surface: &Surface<'_>) -> Quality {
        let mut quality = surface.quality();
        for h in quality.h_inside.iter_mut().chain(&mut quality.h_boundary) {
            *h /= self.prepared.normalization.scale;
        }
        quality
    }

    /// All positions, those that have moved in the precision that they will be written in. What has not moved keeps its bits,
    /// without the rounding of the normalization.
    fn positions(&self) -> Vec<[f64; 3]> {
        let (domain, normalization) = (&self.prepared.domain, &self.prepared.normalization);
        let region = &domain.region;
        let mut positions = self.positions.to_vec();
        let moved = self.result.x[..region.free].iter().zip(&domain.input);
        for ((p, before), &v) in moved.zip(&region.vertex_ids) {
            if p != before {
                positions[v as usize] = self.options.output_precision.round(normalization.leave(p));
            }
        }
        positions
    }

    /// The region as it will be written, in its own frame.
    fn written(&self, positions: &[[f64; 3]]) -> Vec<Vector3<f64>> {
        let region = &self.prepared.domain.region;
        let ids = region.vertex_ids[..region.region_vertices()].iter();
        let round = |&v: &u32| Vector3::from(self.options.output_precision.round(positions[v as usize]));
        let mut x: Vec<Vector3<f64>> = ids.map(round).collect();
        self.prepared.normalization.enter(&mut x);
        x
    }

    /// One for each boundary vertex: those of the sides of a curve are alike.
    fn boundary_normals(&self) -> Vec<(u32, [f64; 3])> {
        let region = &self.prepared.domain.region;
        let boundary = region.vertex_ids[region.free..region.region_vertices()].iter();
        let normals = &self.state.corrected[region.free..];
        let mut list: Vec<_> = boundary.zip(normals).map(|(&v, n)| (v, (*n).into())).collect();
        list.dedup_by_key(|(v, _)| *v);
        list
    }

    fn at_free_vertices(&self, values: &[f64], unit: f64) -> Vec<(u32, f64)> {
        let region = &self.prepared.domain.region;
        let ids = region.vertex_ids[..region.free].iter();
        ids.zip(values).map(|(&v, x)| (v, x / unit)).collect()
    }

    /// The widest of these, and what it was in the input.
    fn tell_kink(&self, quality: &mut Quality, kinks: &[Kink]) {
        let Some(widest) = kinks.iter().max_by(|a, b| a.kink.total_cmp(&b.kink)) else {
            return;
        };
        let region = &self.prepared.domain.region;
        quality.boundary_kink = widest.kink;
        quality.boundary_kink_vertex = region.vertex_ids[region.free + widest.b] as usize;
        quality.boundary_kink_before = widest.before;
    }

    /// Of these positions, unless the run goes on later or is not to be looked at.
    fn self_intersections(&self, positions: &[[f64; 3]]) -> Option<SelfIntersections> {
        let is_held_up = matches!(
            self.result.status,
            SolveStatus::IterationLimit | SolveStatus::Cancelled
        );
        if is_held_up || self.options.intersections == Intersections::Skip {
            return None;
        }
        let new = self.triangles_that_move();
        let of = |x| intersections::of_some(x, self.triangles, &new, SelfIntersections::MOST);
        let pairs = of(positions);
        let in_input = if pairs.is_empty() {
            0
        } else {
            of(self.positions).len()
        };
        Some(SelfIntersections { pairs, in_input })
    }

    /// Those with a free vertex.
    fn triangles_that_move(&self) -> Vec<u32> {
        let region = &self.prepared.domain.region;
        let half_edges = &region.half_edges;
        let corners = half_edges.triangles[..half_edges.region_triangles].iter();
        let has_free = |t: &[u32; 3]| t.iter().any(|&v| (v as usize) < region.free);
        corners
            .zip(&half_edges.triangle_ids)
            .filter(|(t, _)| has_free(t))
            .map(|(_, &id)| id)
            .collect()
    }

    fn report(
        &self,
        quality: Quality,
        suspicious_normals: Vec<u32>,
        creases: &[Kink],
        self_intersections: Option<SelfIntersections>,
        clock: Instant,
    ) -> Report {
        let (prepared, result) = (self.prepared, self.result);
        let free = prepared.domain.region.free;
        let mut seconds = self.seconds;
        seconds.quality = clock.elapsed().as_secs_f64();
        seconds.total = seconds.setup + seconds.start + seconds.iterate + seconds.quality;
        Report {
            target: self.options.target,
            outcome: self.outcome(
                &quality,
                &suspicious_normals,
                creases,
                self_intersections.as_ref(),
            ),
            iterations: result.iterations,
            defect: result.defect,
            step: result.step,
            seconds,
            quality,
            levels: self.levels.clone(),
            free_vertices: free,
            diagonal: diagonal(&result.x) * prepared.normalization.scale,
            linear_surface: result.status.is_linear(),
            suspicious_normals,
            fallback_weights: if result.uniform_weights {
                free
            } else {
                prepared.weights.clamped
            },
            self_intersections,
        }
    }

    fn outcome(
        &self,
        quality: &Quality,
        suspicious_normals: &[u32],
        creases: &[Kink],
        self_intersections: Option<&SelfIntersections>,
    ) -> Outcome {
        let region = &self.prepared.domain.region;
        let ids = |list: &[u32], of: &[u32]| list.iter().map(|&i| of[i as usize]).collect::<Vec<u32>>();
        let poor = &self.result.poor;
        let pairs = self_intersections.map_or(0, |found| found.pairs.len());
        let reason = match &self.result.status {
            SolveStatus::Failed => return Outcome::NotConverged,
            SolveStatus::IterationLimit => return Outcome::IterationLimit,
            SolveStatus::Cancelled => return Outcome::Cancelled,
            SolveStatus::TargetNotReached(reached) => {
                return Outcome::TargetNotReachable { reached: *reached };
            }
            SolveStatus::NormalsNotReached { reached, farthest } => {
                return Outcome::NormalsNotReachable {
                    reached: *reached,
                    vertices: ids(farthest, &region.vertex_ids[region.free..]),
                };
            }
            _ if !poor.is_empty() => {
                return Outcome::ConvergedPoorTriangles {
                    triangles: ids(poor, &region.half_edges.triangle_ids),
                };
            }
            _ if !quality.is_sound() => {
                return Outcome::PoorWhenRounded {
                    triangles: quality.poor(),
                };
            }
            _ if !creases.is_empty() => {
                let boundary = &region.vertex_ids[region.free..];
                let mut vertices: Vec<u32> = creases.iter().map(|k| boundary[k.b]).collect();
                vertices.dedup();
                return Outcome::BoundaryCrease { vertices };
            }
            _ if pairs > 0 => return Outcome::SelfIntersecting { pairs },
            SolveStatus::Bump => LooseReason::Bump,
            _ if !suspicious_normals.is_empty() => LooseReason::SuspiciousNormals,
            SolveStatus::ConvergedToRounding => LooseReason::Rounding,
            SolveStatus::AboveTolerance => LooseReason::Tolerance,
            SolveStatus::FirstOrder => LooseReason::FirstOrderCurvature,
            SolveStatus::Converged => return Outcome::Converged,
        };
        Outcome::ConvergedLoosely { reason }
    }
}
