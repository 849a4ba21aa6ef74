//! What a session was asked, in its own memory.

use crate::discrete::curvature::TILT_RIDGE;
use crate::discrete::equations::FreeCurvature;
use crate::error::Error;
use crate::fairing::normals::given_vertices;
use crate::fairing::{BoundaryNormals, Discretization, Options, Selection};
use crate::mesh::Region;

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
    /// Their normals and target are those of the beginning.
    pub(super) options: Options,
}

impl Input {
    pub(super) fn new(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        selection: Selection<'_>,
        options: &Options,
    ) -> Self {
        Self {
            positions: positions.to_vec(),
            triangles: triangles.to_vec(),
            selection: match selection {
                Selection::Mask(mask) => Selected::Mask(mask.to_vec()),
                Selection::Vertices(list) => Selected::Vertices(list.to_vec()),
                Selection::Faces(list) => Selected::Faces(list.to_vec()),
            },
            options: options.clone(),
        }
    }

    /// The region, cut where these normals ask for it.
    pub(super) fn region(&self, normals: &BoundaryNormals) -> Result<Region, Error> {
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
        match self.options.discretization {
            Discretization::SecondOrder => FreeCurvature::GradientCorrected {
                tilt_ridge: TILT_RIDGE,
            },
            Discretization::Paper => FreeCurvature::Paper,
        }
    }
}
