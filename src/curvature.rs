//! Mean curvature of a whole mesh, as users call it.

use crate::discrete::mesh_curvature;
use crate::error::Error;
use crate::fairing::Workers;

/// Mean curvature `(k1 + k2) / 2` at every vertex, in one over the unit of the positions: the gradient-corrected
/// Moreton-Sequin fit (paper 6.1) that the solver uses at free vertices.
///
/// `positions` is #V by 3, `triangles` #T by 3, counter-clockwise seen from the side that normals point to; `H` is
/// negative on a sphere with outward normals. A vertex on the boundary of the mesh sees its side alone, and begins
/// with the mean normal of its triangles instead of a closed ring's; that is first order at best, and a corner with a
/// single triangle has hardly anything to see. A vertex without triangles gets NaN. The mesh need not
/// be a manifold: a vertex where it is none is taken as one on the boundary.
///
/// ```
/// let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
/// let h = fairmesh::mean_curvature(&positions, &[[0, 1, 2], [1, 3, 2]])?;
/// assert!(h.iter().all(|h| h.abs() < 1e-12)); // a plane
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// [`Error::TooLarge`], [`Error::IndexOutOfRange`] for a triangle that names a vertex that does not exist,
/// [`Error::NotFinite`] for a vertex of a triangle whose position is not finite.
pub fn mean_curvature(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Vec<f64>, Error> {
    // Not on the global pool, whose threads would outlive a library that is unloaded.
    Workers::new(0)?.install(|| mesh_curvature::mean_curvature(positions, triangles))
}
