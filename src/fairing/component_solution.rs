//! What came of one component, in the host's numbers and units.

use super::outcome::Outcome;
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

impl ComponentSolution {
    /// Names fixed vertices by other numbers.
    pub(super) fn renumber(&mut self, number: &impl Fn(u32) -> u32) {
        let all = |list: &mut Vec<u32>| {
            list.iter_mut().for_each(|v| *v = number(*v));
            list.sort_unstable();
            list.dedup();
        };
        self.boundary_normals
            .iter_mut()
            .for_each(|(v, _)| *v = number(*v));
        all(&mut self.suspicious_normals);
        if let Outcome::BoundaryCrease { vertices } = &mut self.report.outcome {
            all(vertices);
        }
        let quality = &mut self.report.quality;
        let single = [
            &mut quality.normal_deviation_vertex,
            &mut quality.boundary_kink_vertex,
        ];
        let pair = quality.sharpest_edge_vertices.iter_mut();
        pair.chain(single).for_each(|v| *v = number(*v as u32) as usize);
    }
}
