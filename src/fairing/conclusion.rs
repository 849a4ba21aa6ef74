//! From the solver's surface back to the host's numbers and units, with all that is reported of it.

use std::time::Instant;

use super::component_solution::ComponentSolution;
use super::prepared::Prepared;
use super::report::{ComponentReport, LooseReason, Outcome, Seconds};
use crate::discrete::equations::State;
use crate::paper::LevelReport;
use crate::quality::{Quality, Surface};
use crate::solve::problem::diagonal;
use crate::solve::{SolveResult, SolveStatus};

/// What was found, and what it is measured against.
pub(super) struct Found<'a> {
    pub(super) prepared: &'a Prepared,
    pub(super) result: &'a SolveResult,
    /// Evaluated at the result.
    pub(super) state: &'a State,
    pub(super) levels: Vec<LevelReport>,
    /// But for the figures themselves.
    pub(super) seconds: Seconds,
}

impl Found<'_> {
    /// Measures the surface, and takes it back.
    pub(super) fn conclude(self) -> ComponentSolution {
        let clock = Instant::now();
        let surface = self.surface();
        let quality = self.quality(&surface);
        let domain = &self.prepared.domain;
        let suspicious_normals = surface.suspicious_normals(&domain.rings, &domain.input);
        let scale = self.prepared.normalization.scale;
        let report = self.report(quality, &suspicious_normals);
        let (moved, boundary_normals) = (self.moved(), self.boundary_normals());
        let mut seconds = self.seconds;
        seconds.quality = clock.elapsed().as_secs_f64();
        ComponentSolution {
            moved,
            boundary_normals,
            mean_curvature: self.at_free_vertices(&self.state.h, scale),
            gaussian_curvature: self.at_free_vertices(&self.state.k, scale * scale),
            report,
            boundary: domain.region.boundary,
            suspicious_normals,
            fallback_weights: if self.result.uniform_weights {
                domain.region.free
            } else {
                self.prepared.weights.clamped
            },
            levels: self.levels,
            seconds,
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

    /// The free vertices that have moved: the others keep their bits, without the rounding of the normalization.
    fn moved(&self) -> Vec<(u32, [f64; 3])> {
        let (domain, normalization) = (&self.prepared.domain, &self.prepared.normalization);
        let region = &domain.region;
        let placed = self.result.x[..region.free].iter().zip(&domain.input);
        let moved = placed
            .zip(&region.vertex_ids)
            .filter(|((p, before), _)| p != before);
        moved.map(|((p, _), &v)| (v, normalization.leave(p))).collect()
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

    fn report(&self, quality: Quality, suspicious_normals: &[u32]) -> ComponentReport {
        let (prepared, result) = (self.prepared, self.result);
        let region = &prepared.domain.region;
        ComponentReport {
            vertex: region.vertex_ids[0] as usize,
            free_vertices: region.free,
            outcome: self.outcome(suspicious_normals),
            iterations: result.iterations,
            defect: result.defect,
            step: result.step,
            diagonal: diagonal(&result.x) * prepared.normalization.scale,
            linear_surface: result.status.is_linear(),
            quality,
        }
    }

    fn outcome(&self, suspicious_normals: &[u32]) -> Outcome {
        let region = &self.prepared.domain.region;
        let ids = |list: &[u32], of: &[u32]| list.iter().map(|&i| of[i as usize]).collect::<Vec<u32>>();
        let poor = &self.result.poor;
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
            SolveStatus::Bump => LooseReason::Bump,
            _ if !suspicious_normals.is_empty() => LooseReason::SuspiciousNormals,
            SolveStatus::ConvergedToRounding => LooseReason::Rounding,
            SolveStatus::FirstOrder => LooseReason::FirstOrderCurvature,
            SolveStatus::Converged => return Outcome::Converged,
        };
        Outcome::ConvergedLoosely { reason }
    }
}
