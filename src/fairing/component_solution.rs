//! What came of one component, in the host's numbers and units.

use super::report::{ComponentReport, Seconds};
use crate::paper::LevelReport;

/// One component, faired.
pub(super) struct ComponentSolution {
    /// The free vertices that have moved, and where they are.
    pub(super) moved: Vec<(u32, [f64; 3])>,
    /// The triangles that have a free vertex.
    pub(super) triangles: Vec<u32>,
    pub(super) boundary_normals: Vec<(u32, [f64; 3])>,
    pub(super) mean_curvature: Vec<(u32, f64)>,
    pub(super) gaussian_curvature: Vec<(u32, f64)>,
    pub(super) report: ComponentReport,
    /// Boundary vertices, those of each side of a curve counted.
    pub(super) boundary: usize,
    pub(super) levels: Vec<LevelReport>,
    pub(super) suspicious_normals: Vec<u32>,
    pub(super) fallback_weights: usize,
    pub(super) seconds: Seconds,
}
