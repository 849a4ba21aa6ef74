//! How far the surface continues the curvature of its surroundings: what is asked, and what came of it.

use crate::error::Error;
use crate::mesh::Region;
use crate::solve::{AskedContinuity, LoopContinuity};

/// Where the mean curvature along the boundary loops comes from that the surface is to continue, see
/// [`Options::continuity`](crate::Options::continuity).
#[derive(Debug, Clone, PartialEq, Default)]
pub enum BoundaryCurvature {
    /// Fitted to the surface outside the region, to three to eight rings, whichever is most certain along the loop.
    #[default]
    Estimated,
    /// Given for some or all boundary vertices (`(vertex, mean curvature)`), in one over the unit of the positions, negative on a sphere with
    /// outward normals; fitted for the others. Entries for vertices that are not on the boundary are ignored.
    Given(Vec<(u32, f64)>),
}

impl BoundaryCurvature {
    /// Checks that the numbers are finite.
    pub(super) fn validate(&self) -> Result<(), Error> {
        let Self::Given(list) = self else { return Ok(()) };
        for (_, h) in list {
            Error::check_option("boundary_curvature", *h, h.is_finite(), "finite numbers")?;
        }
        Ok(())
    }
}

/// What is asked of a region whose unit of length is `scale` of the input's; nothing, where tangent planes alone are to be continued.
pub(super) fn asked_continuity(
    region: &Region,
    blend: f64,
    curvature: &BoundaryCurvature,
    scale: f64,
) -> Option<AskedContinuity> {
    if blend == 0.0 {
        return None;
    }
    let given = match curvature {
        BoundaryCurvature::Estimated => Vec::new(),
        BoundaryCurvature::Given(list) => {
            let mut sorted = list.clone();
            // Of repeated ones the last holds.
            sorted.sort_by_key(|entry| entry.0);
            let boundary = region.vertex_ids[region.free..region.region_vertices()].iter();
            boundary
                .map(|v| {
                    let after = sorted.partition_point(|entry| entry.0 <= *v);
                    let last = after.checked_sub(1).map(|k| sorted[k])?;
                    (last.0 == *v).then_some(last.1 * scale)
                })
                .collect()
        }
    };
    Some(AskedContinuity { blend, given })
}

/// What came of the continuity of curvature along one boundary loop, in the unit of the positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvatureContinuity {
    /// The boundary vertex of the loop with the smallest number.
    pub vertex: usize,
    /// How many vertices the loop has.
    pub vertices: usize,
    /// How much of the way from the tangent-continuous surface's mean curvature to that of the surroundings was taken, in the mean along the
    /// loop: from 0 (the surroundings are too rough or uncertain, their curvature is the surface's already, or no sound surface has it) to
    /// [`Options::continuity`](crate::Options::continuity).
    pub reached: f64,
    /// The jump of the mean curvature at the loop of the tangent-continuous surface, root mean square.
    pub jump_before: f64,
    /// The largest such jump.
    pub largest_jump_before: f64,
    /// The jump of the mean curvature at the loop, root mean square.
    pub jump: f64,
    /// The largest jump.
    pub largest_jump: f64,
    /// The root mean square of the mean curvature of the surroundings along the loop.
    pub curvature: f64,
    /// How uncertain that is, root mean square: the standard error of its fit, how much it differs from the curvatures of the vertices there,
    /// and how much it varies from vertex to vertex. Where this is no
    /// smaller than [`jump_before`](Self::jump_before), there is nothing to be continued; where it is small and [`reached`](Self::reached) is
    /// small as well, no sound surface has that curvature.
    pub uncertainty: f64,
}

impl CurvatureContinuity {
    /// In the host's numbers and unit.
    pub(super) fn new(of_loop: &LoopContinuity, region: &Region, scale: f64) -> Self {
        Self {
            vertex: region.vertex_ids[region.free + of_loop.vertex as usize] as usize,
            vertices: of_loop.vertices,
            reached: of_loop.reached,
            jump_before: of_loop.jump_before[0] / scale,
            largest_jump_before: of_loop.jump_before[1] / scale,
            jump: of_loop.jump[0] / scale,
            largest_jump: of_loop.jump[1] / scale,
            curvature: of_loop.curvature / scale,
            uncertainty: of_loop.uncertainty / scale,
        }
    }
}
