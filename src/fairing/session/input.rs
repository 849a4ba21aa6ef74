//! What a session was asked, in its own memory.

use crate::discrete::curvature::TILT_RIDGE;
use crate::discrete::equations::FreeCurvature;
use crate::error::Error;
use crate::fairing::normals::given_vertices;
use crate::fairing::{BoundaryNormals, Discretization, InnerFairness, InteriorNormals, Options, Selection};
use crate::mesh::Region;

/// Normals that outlive the call.
pub(super) enum Normals {
    Fitted,
    Averaged,
    Given(Vec<(u32, [f64; 3])>),
}

impl Normals {
    pub(super) fn new(normals: BoundaryNormals<'_>) -> Self {
        match normals {
            BoundaryNormals::Fitted => Self::Fitted,
            BoundaryNormals::Averaged => Self::Averaged,
            BoundaryNormals::Given(list) => Self::Given(list.to_vec()),
        }
    }

    pub(super) fn as_asked(&self) -> BoundaryNormals<'_> {
        match self {
            Self::Fitted => BoundaryNormals::Fitted,
            Self::Averaged => BoundaryNormals::Averaged,
            Self::Given(list) => BoundaryNormals::Given(list),
        }
    }
}

/// A selection that outlives the call.
enum Selected {
    Mask(Vec<bool>),
    Vertices(Vec<u32>),
    Faces(Vec<u32>),
}

/// The mesh, the selection and the options that do not change.
pub(super) struct Input {
    pub(super) positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    selection: Selected,
    pub(super) interior: InteriorNormals,
    pub(super) inner: InnerFairness,
    discretization: Discretization,
    pub(super) tolerance: f64,
    pub(super) max_iterations: usize,
    pub(super) threads: usize,
}

impl Input {
    pub(super) fn new(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        selection: Selection<'_>,
        options: &Options<'_>,
    ) -> Self {
        Self {
            positions: positions.to_vec(),
            triangles: triangles.to_vec(),
            selection: match selection {
                Selection::Mask(mask) => Selected::Mask(mask.to_vec()),
                Selection::Vertices(list) => Selected::Vertices(list.to_vec()),
                Selection::Faces(list) => Selected::Faces(list.to_vec()),
            },
            interior: options.interior,
            inner: options.inner,
            discretization: options.discretization,
            tolerance: options.tolerance,
            max_iterations: options.max_iterations,
            threads: options.threads,
        }
    }

    /// The region, cut where these normals ask for it.
    pub(super) fn region(&self, normals: BoundaryNormals<'_>) -> Result<Region, Error> {
        let prescribed = given_vertices(normals);
        let selection = match &self.selection {
            Selected::Mask(mask) => Selection::Mask(mask),
            Selected::Vertices(list) => Selection::Vertices(list),
            Selected::Faces(list) => Selection::Faces(list),
        };
        Region::with_normals(&self.positions, &self.triangles, selection, |v| {
            prescribed.binary_search(&v).is_ok()
        })
    }

    pub(super) fn curvature(&self) -> FreeCurvature {
        match self.discretization {
            Discretization::SecondOrder => FreeCurvature::GradientCorrected {
                tilt_ridge: TILT_RIDGE,
            },
            Discretization::Paper => FreeCurvature::Paper,
        }
    }
}
