//! From the solver's surface back to the host's numbers and units, with all that is reported of it.

use nalgebra::Vector3;

use super::component_solution::ComponentSolution;
use super::continuity::CurvatureContinuity;
use super::options::OutputPrecision;
use super::outcome::{LooseReason, Outcome};
use super::prepared::Prepared;
use super::report::{Attempt, ComponentReport, Seconds};
use crate::discrete::equations::State;
use crate::paper::LevelReport;
use crate::quality::crease::{Kink, creases, kinks};
use crate::quality::folds::Folds;
use crate::quality::{Quality, SurfaceState};
use crate::solve::candidate::bending_energy;
use crate::solve::problem::diagonal;
use crate::solve::{SolveResult, SolveStatus};
use crate::support::profile;
use crate::support::stopwatch::Stopwatch;

/// What was found, and what it is measured against.
pub(super) struct Found<'a> {
    pub(super) prepared: &'a Prepared,
    pub(super) output_precision: OutputPrecision,
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
        let clock = Stopwatch::start();
        let _clock = profile::clock("figures");
        let (surface, written) = (self.surface(), self.written());
        let domain = &self.prepared.domain;
        let (rings, input) = (&domain.rings, &domain.input);
        let surface = SurfaceState {
            x: &written,
            ..surface
        };
        let mut quality = self.quality(&surface);
        let kinks = kinks(&surface, rings, input, &self.prepared.has_given_normal);
        let creases = creases(&kinks);
        self.tell_kink(&mut quality, if creases.is_empty() { &kinks } else { &creases });
        let suspicious_normals = surface.suspicious_normals(rings, input);
        let scale = self.prepared.normalization.scale;
        let report = self.report(quality, &suspicious_normals, &creases);
        let (moved, boundary_normals) = (self.moved(), self.boundary_normals());
        let mut seconds = self.seconds;
        seconds.quality = clock.seconds();
        ComponentSolution {
            moved,
            triangles: self.triangles_that_move(),
            boundary_normals,
            mean_curvature: self.at_free_vertices(&self.state.h, scale),
            gaussian_curvature: self.at_free_vertices(&self.state.k, scale * scale),
            report,
            boundary: domain.region.boundary,
            suspicious_normals,
            fallback_weights: if self.result.spread_otherwise {
                domain.region.free
            } else {
                self.prepared.weights.clamped
            },
            levels: self.levels,
            seconds,
        }
    }

    fn surface(&self) -> SurfaceState<'_> {
        let region = &self.prepared.domain.region;
        SurfaceState {
            region,
            x: &self.result.x,
            normals: &self.state.corrected,
            boundary_normals: &self.state.corrected[region.free..],
            h: &self.state.h,
        }
    }

    /// The figures, in the host's unit.
    fn quality(&self, surface: &SurfaceState<'_>) -> Quality {
        let mut quality = surface.quality();
        for h in quality.h_inside.iter_mut().chain(&mut quality.h_boundary) {
            *h /= self.prepared.normalization.scale;
        }
        quality.bending_energy = bending_energy(self.state);
        let domain = &self.prepared.domain;
        let folds = Folds {
            surface,
            k: &self.state.k,
            rings: &domain.rings,
            input: &domain.input,
        };
        if let Some((h, bend)) = folds.sharpest() {
            let half_edges = &domain.region.half_edges;
            let ends = [half_edges.origin(h), half_edges.target(h)];
            quality.sharpest_edge = bend;
            quality.sharpest_edge_vertices = ends.map(|v| domain.region.vertex_ids[v as usize] as usize);
        }
        quality
    }

    /// The free vertices that have moved, in the precision that they will be written in: the others keep their bits, without
    /// the rounding of the normalization.
    fn moved(&self) -> Vec<(u32, [f64; 3])> {
        let domain = &self.prepared.domain;
        let region = &domain.region;
        let placed = self.result.x[..region.free].iter().zip(&domain.input);
        let moved = placed
            .zip(&region.vertex_ids)
            .filter(|((p, before), _)| p != before);
        moved.map(|((p, _), &v)| (v, self.placed(p))).collect()
    }

    /// A position as it will be written.
    fn placed(&self, p: &Vector3<f64>) -> [f64; 3] {
        self.output_precision.round(self.prepared.normalization.leave(p))
    }

    /// The region as it will be written, in its own frame.
    fn written(&self) -> Vec<Vector3<f64>> {
        let region = self.result.x[..self.prepared.domain.region.region_vertices()].iter();
        let mut x: Vec<Vector3<f64>> = region.map(|p| Vector3::from(self.placed(p))).collect();
        self.prepared.normalization.enter(&mut x);
        x
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

    fn report(&self, quality: Quality, suspicious_normals: &[u32], creases: &[Kink]) -> ComponentReport {
        let (prepared, result) = (self.prepared, self.result);
        let region = &prepared.domain.region;
        ComponentReport {
            vertex: region.first_free(),
            free_vertices: region.free,
            outcome: self.outcome(&quality, suspicious_normals, creases),
            iterations: result.iterations,
            defect: result.defect,
            step: result.step,
            diagonal: diagonal(&result.x) * prepared.normalization.scale,
            least_bending: result.status.is_least_bending(),
            attempts: result.trials.iter().map(Attempt::new).collect(),
            quality,
            continuity: self.continuity(),
        }
    }

    fn continuity(&self) -> Vec<CurvatureContinuity> {
        let (region, scale) = (&self.prepared.domain.region, self.prepared.normalization.scale);
        let loops = self.result.continuity.iter();
        loops
            .map(|of_loop| CurvatureContinuity::new(of_loop, region, scale))
            .collect()
    }

    fn outcome(&self, quality: &Quality, suspicious_normals: &[u32], creases: &[Kink]) -> Outcome {
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
            SolveStatus::NearestMember(weight) => return Outcome::NearestMember { weight: *weight },
            SolveStatus::Bump => LooseReason::Bump,
            _ if !suspicious_normals.is_empty() => LooseReason::SuspiciousNormals,
            SolveStatus::ConvergedToRounding => LooseReason::Rounding,
            SolveStatus::AboveTolerance => LooseReason::Tolerance,
            SolveStatus::Converged if self.result.continuity.iter().any(|l| l.is_short) => {
                LooseReason::Curvature
            }
            SolveStatus::Converged => return Outcome::Converged,
        };
        Outcome::ConvergedLoosely { reason }
    }
}
