//! Mean curvature of a whole mesh, as users call it.

use crate::discrete::mesh_curvature;
use crate::fairing::Workers;
use crate::mesh::Joined;
use crate::mesh::coincident::Coincident;
use crate::support::error::Error;

/// Mean curvature `(k1 + k2) / 2` at every vertex, in one over the unit of the positions: the gradient-corrected
/// Moreton-Sequin fit (paper 6.1) that the solver uses at free vertices.
///
/// `positions` is #V by 3, `triangles` #T by 3, counter-clockwise seen from the side that normals point to; `H` is
/// negative on a sphere with outward normals. A vertex on the boundary of the mesh sees its side alone, and begins
/// with the mean normal of its triangles instead of a closed ring's; that is first order at best, and a corner with a
/// single triangle has hardly anything to see. A vertex without triangles gets NaN. The mesh need not
/// be a manifold: a vertex where it is none is taken as one on the boundary. Vertices with equal coordinates are one vertex
/// of the surface, as by default in [`Coincident`], and have the same curvature.
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
    mean_curvature_joined(positions, triangles, Coincident::default())
}

/// [`mean_curvature`], which takes coincident vertices as it is told.
///
/// ```
/// use fairmesh::{Coincident, mean_curvature_joined};
/// // Two triangles of a roof, each with vertices of its own.
/// let positions = [
///     [0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [-1.0, 0.5, 0.0], [0.0, 1.0, 1.0], [0.0, 0.0, 1.0], [1.0, 0.5, 0.0],
/// ];
/// let triangles = [[0, 1, 2], [3, 4, 5]];
/// let h = mean_curvature_joined(&positions, &triangles, Coincident::default())?;
/// assert!(h[0] < -0.1 && h[0] == h[4]);
/// let flat = mean_curvature_joined(&positions, &triangles, Coincident::Separate)?;
/// assert!(flat[0].abs() < 1e-9);
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// Those of [`mean_curvature`], and [`Error::BadOption`] for the distance.
pub fn mean_curvature_joined(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    coincident: Coincident,
) -> Result<Vec<f64>, Error> {
    let joined = Joined::new(positions, triangles, coincident)?;
    // Not on the global pool, whose threads would outlive a library that is unloaded.
    let workers = Workers::new(0)?;
    let mut h = workers.install(|| mesh_curvature::mean_curvature(positions, &joined.triangles))?;
    for &(v, copy) in joined.copies.pairs() {
        h[copy as usize] = h[v as usize];
    }
    Ok(h)
}
