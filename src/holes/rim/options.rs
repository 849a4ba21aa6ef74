//! What may happen to the mesh around a loop before it is filled.

use crate::support::error::Error;

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

impl Rim {
    pub(in crate::holes) fn validate(&self) -> Result<(), Error> {
        let within = self.within.unwrap_or(1.0);
        let allowed = within > 0.0 && within.is_finite();
        Error::check_option("relax_within", within, allowed, "positive and finite")
    }
}
