//! What may happen to the mesh around a loop before it is filled.

use crate::support::error::Error;
use crate::support::options::options;

options! {
    /// What may happen to the mesh around a loop before it is filled. By default nothing: original vertices keep their bits.
    ///
    /// The boundary of a scan or of voxels is the worst part of it, and a patch goes on from there. With `relax` the vertices around the
    /// loop are drawn to the surface that the mesh has there on average: a sphere and a polynomial of degree two over it, fitted
    /// around each of them, as wide as the noise asks for and the shape allows. The patch is faired with the normals of these fits.
    #[derive(Debug, Clone, Copy, PartialEq)]
    Rim {
        /// For boundaries that are noise: this many rings of vertices around a loop, its own counted, may move onto the surface that the mesh
        /// has there on average, before it is filled. 0 (default): none. 4294967295 (auto): as many as are advised around loops that are
        /// rough, none around others, nor where triangles would be folded or intersect.
        relax "relax_rim": usize = 0, count "rings";
        /// No vertex of these rings moves further than this. Default: the mean length of the edges around the loop.
        within "relax_within": Option<f64> = None, real "length" in f64::MIN_POSITIVE..f64::INFINITY, "positive and finite";
    }
}

impl Rim {
    /// What [`relax`](Self::relax) is for the rings that are [advised](super::Roughness::advice), and none where none are.
    ///
    /// No mesh has as many rings, and a number that every language has.
    pub const AUTO: usize = u32::MAX as usize;

    pub(in crate::holes) fn validate(&self) -> Result<(), Error> {
        self.check_ranges()
    }
}
