//! What is faired.

use std::borrow::Cow;

use fairmesh::{BoundaryCurvature, BoundaryNormals};

use crate::formats::Geometry;
use crate::region::RegionReport;
use crate::selected::Selected;

/// A mesh of triangles, what may move in it, and the normals and the curvature at the boundary of that.
pub struct FairInput<'a> {
    pub geometry: Cow<'a, Geometry>,
    pub selected: Selected,
    pub boundary_normals: BoundaryNormals,
    pub boundary_curvature: BoundaryCurvature,
    pub loop_continuity: Vec<(u32, f64)>,
    pub marked_edges: Vec<[u32; 2]>,
    /// How the region was found, if by steps.
    pub region: RegionReport,
}
