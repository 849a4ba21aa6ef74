//! Rims that are noise: the vertices of a loop, and of some rings around it, moved before it is filled.

mod band;
mod fit;
mod relax;
mod rims;
mod roughness;
mod untangle;
mod width;

pub(super) use rims::Rims;
pub use roughness::{Roughness, rim_roughness};

use crate::error::Error;

/// What may happen to the mesh around a loop before it is filled. By default nothing: original vertices keep their bits.
///
/// The boundary of a scan or of voxels is the worst part of it, and a patch goes on from there. With `relax` the vertices around the
/// loop are drawn to the surface that the mesh has there on average: a sphere and a polynomial of degree two over it, fitted
/// around each of them, as wide as the noise asks for and the shape allows. The patch is faired with the normals of these fits.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rim {
    /// So many rings of vertices may move, that of the loop counted. 0, the default: none.
    pub relax: usize,
    /// No vertex moves further than this. Default: the mean length of the edges around the loop.
    pub within: Option<f64>,
}

/// What became of the rim of a patch.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RimReport {
    /// How many vertices moved.
    pub moved: usize,
    /// How far, root mean square.
    pub rms: f64,
    /// How far the one that moved furthest did.
    pub largest: f64,
    /// The bound: no vertex moved further, but for rounding.
    pub within: f64,
    /// How many would have moved further.
    pub bounded: usize,
    /// How many triangles at vertices that moved are folded all the same, those of the patch at the loop counted.
    pub folded: usize,
    /// The distance of the mesh around from the surfaces fitted to it, root mean square.
    pub noise: f64,
    /// The median of the square of that along the loops over its mean: about 1 where it is everywhere. Well below 1 it is
    /// [likely](Self::is_even) that a feature of the surface was taken for noise.
    pub evenness: f64,
    /// These look at what is nearer than this. 0: nothing could be fitted, and no vertex moved.
    pub radius: f64,
    /// Pairs of the mesh's triangles, not of the patch, that intersect since vertices moved, the smaller number first, ascending. Not looked
    /// for if the fairing's [`Options::intersections`](crate::Options::intersections) says so.
    pub self_intersections: Vec<[u32; 2]>,
}

impl RimReport {
    /// Whether the noise is everywhere along the loops, or nothing was fitted.
    pub fn is_even(&self) -> bool {
        self.radius == 0.0 || self.evenness > roughness::EVEN
    }

    /// Whether nothing is amiss: no triangle is folded, and none intersects another.
    pub fn is_sound(&self) -> bool {
        self.folded == 0 && self.self_intersections.is_empty()
    }
}

impl Rim {
    pub(super) fn validate(&self) -> Result<(), Error> {
        let within = self.within.unwrap_or(1.0);
        let allowed = within > 0.0 && within.is_finite();
        Error::check_option("relax_within", within, allowed, "positive and finite")
    }
}
