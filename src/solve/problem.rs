//! What is to be solved, in the region's own centred and scaled frame.

use std::sync::Arc;

use nalgebra::Vector3;

use super::domain::Domain;
use super::result::{SolveResult, SolveStatus};
use crate::discrete::equations::{Equations, FreeCurvature, State};
use crate::discrete::inner_fairness::FairnessWeights;
use crate::discrete::target::RightHandSide;
use crate::discrete::valence_batches::ValenceBatches;
use crate::quality::{NEEDLE, SurfaceState};
use crate::solve::g2::boundary_curvature::AskedContinuity;

/// Inner fairness of a mesh.
pub(crate) type Weigh = fn(&ValenceBatches, &[Vector3<f64>]) -> FairnessWeights;

/// What is to be faired.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Problem<'a> {
    /// The region and its given surface.
    pub domain: &'a Arc<Domain>,
    /// Prescribed normals.
    pub boundary_normals: &'a [Vector3<f64>],
    /// Boundary vertices that the surface passes smoothly, as in [`Equations`].
    pub smooth_interior: &'a [bool],
    /// Inner fairness on the given mesh.
    pub weights: &'a Arc<FairnessWeights>,
    /// How it comes from a mesh, where it is not uniform: for the levels of the paper's scheme.
    pub weigh: Option<Weigh>,
    /// Curvature at free vertices.
    pub curvature: FreeCurvature,
    /// What `Delta_B H` has to be.
    pub right_hand_side: RightHandSide,
    /// Continuity of the curvature, where it is asked for.
    pub continuity: Option<&'a Arc<AskedContinuity>>,
}

impl<'a> Problem<'a> {
    /// Both equations.
    pub(crate) fn equations(&self) -> Equations<'a> {
        Equations {
            rings: &self.domain.rings,
            batches: &self.domain.batches,
            boundary_normals: self.boundary_normals,
            smooth_interior: self.smooth_interior,
            weights: self.weights,
            curvature: self.curvature,
            right_hand_side: self.right_hand_side,
        }
    }

    /// The given surface as the result of a run that was stopped before there was another, and its evaluation.
    pub(crate) fn unmoved(&self) -> (SolveResult, State) {
        let Domain {
            region,
            batches,
            input,
            ..
        } = &**self.domain;
        let x = input[..region.region_vertices()].to_vec();
        let mut state = State::new(batches, region.boundary);
        let equations = self.equations();
        equations.evaluate(&x, &mut state);
        let (defect, _) = equations.defect(&state);
        let surface = SurfaceState {
            region,
            x: &x,
            normals: &state.corrected,
            boundary_normals: &state.corrected[region.free..],
            h: &state.h,
        };
        let result = SolveResult {
            poor: surface.poor(NEEDLE),
            defect: defect * diagonal(&x),
            x,
            status: SolveStatus::Cancelled,
            step: f64::NAN,
            iterations: 0,
            along_normals: false,
            spread_otherwise: false,
            trials: Vec::new(),
            continuity: Vec::new(),
            start_seconds: 0.0,
        };
        (result, state)
    }
}

/// The diagonal of the bounding box.
pub(crate) fn diagonal(x: &[Vector3<f64>]) -> f64 {
    let (low, high) = bounding_box(x);
    (high - low).norm()
}

/// Lowest and highest corner.
pub(crate) fn bounding_box(x: &[Vector3<f64>]) -> (Vector3<f64>, Vector3<f64>) {
    let start = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    x.iter().fold(start, |(low, high), p| (low.inf(p), high.sup(p)))
}
