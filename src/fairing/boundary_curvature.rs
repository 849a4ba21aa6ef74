//! Where the curvature comes from that the surface is to continue.

use crate::support::error::Error;

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
