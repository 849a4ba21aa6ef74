//! What is to be solved, in the region's own centred and scaled frame.

use std::sync::Arc;

use nalgebra::Vector3;

use super::boundary_curvature::AskedContinuity;
use super::result::{SolveResult, SolveStatus};
use crate::discrete::equations::{Equations, FreeCurvature, State};
use crate::discrete::inner_fairness::FairnessWeights;
use crate::discrete::target::RightHandSide;
use crate::discrete::valence_batches::ValenceBatches;
use crate::mesh::{Region, Rings};
use crate::quality::{NEEDLE, Surface};

/// The region and what is made of its connectivity once.
#[derive(Debug, Clone)]
pub(crate) struct Domain {
    /// The region.
    pub region: Region,
    /// Its rings.
    pub rings: Rings,
    /// The same, transposed.
    pub batches: ValenceBatches,
    /// The given positions (free, boundary, outside).
    pub input: Vec<Vector3<f64>>,
    /// On a coarse mesh the lengths of the edges of the region's triangles, from each corner to the next, in the metric that spreads the
    /// vertices of the fine mesh; else all edges are alike in it.
    pub lengths: Option<Vec<[f64; 3]>>,
}

impl Domain {
    /// Makes the rings of a region with these positions.
    pub(crate) fn new(region: Region, input: Vec<Vector3<f64>>) -> Self {
        let rings = Rings::new(&region);
        Self {
            batches: ValenceBatches::new(&rings),
            region,
            rings,
            input,
            lengths: None,
        }
    }

    /// The same with these positions of the fixed vertices (boundary, outside).
    pub(crate) fn with_fixed(&self, fixed: &[Vector3<f64>]) -> Self {
        let mut moved = self.clone();
        moved.input[self.region.free..].copy_from_slice(fixed);
        moved
    }

    /// The same with the lengths of a coarse mesh.
    pub(crate) fn with_lengths(self, lengths: Vec<[f64; 3]>) -> Self {
        Self {
            lengths: Some(lengths),
            ..self
        }
    }

    /// The given surface of the region (free, boundary).
    pub(crate) fn surface(&self) -> &[Vector3<f64>] {
        &self.input[..self.region.region_vertices()]
    }
}

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
        let surface = Surface {
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
