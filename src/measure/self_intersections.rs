//! Intersecting triangles of a mesh, as users call it.

use crate::fairing::{ProgressCallback, Workers, on_workers_unless_stopped};
use crate::intersections;
use crate::mesh::input;
use crate::support::error::Error;

/// The pairs of triangles that intersect, the smaller number first, ascending. `positions` is #V by 3, `triangles` #T by 3;
/// with `among`, only pairs with at least one of these triangles, so that a changed part is checked against itself and the
/// rest of the mesh.
///
/// Two triangles intersect if they have more in common than one vertex of both or one edge of both; also if they only touch.
/// Vertices at the same position are one vertex. Every decision is exact for the positions given, by the signs of
/// determinants. Triangles without area take no part: their points are those of their neighbours' edges. The mesh need not be
/// a manifold.
///
/// ```
/// // Two triangles that cross, and one beside them.
/// let positions = [
///     [0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.5, 0.5, -1.0], [0.5, 0.5, 1.0], [3.0, 3.0, 0.0],
/// ];
/// let triangles = [[0, 1, 2], [3, 4, 5], [1, 5, 2]];
/// let pairs = fairmesh::self_intersections(&positions, &triangles, None)?;
/// assert_eq!(pairs, [[0, 1], [1, 2]]);
/// assert_eq!(fairmesh::self_intersections(&positions, &triangles, Some(&[0]))?, [[0, 1]]);
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// [`Error::TooLarge`], [`Error::IndexOutOfRange`] for a triangle that names a vertex that does not exist,
/// [`Error::NotFinite`] for a vertex of a triangle whose position is not finite, [`Error::SelectionOutOfRange`] for a
/// triangle in `among` that does not exist.
pub fn self_intersections(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    among: Option<&[u32]>,
) -> Result<Vec<[u32; 2]>, Error> {
    // Not on the global pool, whose threads would outlive a library that is unloaded.
    Workers::new(0)?.install(|| found(positions, triangles, among, &mut |_| ()))
}

/// [`self_intersections`], which calls `progress` on the calling thread, as [`fair_with_progress`](crate::fair_with_progress) does.
/// `Break` stops the run: then there is no result.
///
/// # Errors
/// Those of [`self_intersections`].
pub fn self_intersections_with_progress(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    among: Option<&[u32]>,
    progress: &mut ProgressCallback<'_>,
) -> Result<Option<Vec<[u32; 2]>>, Error> {
    on_workers_unless_stopped(0, progress, "intersections", |tell| {
        found(positions, triangles, among, tell)
    })
}

fn found(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    among: Option<&[u32]>,
    tell: &mut dyn FnMut(f64),
) -> Result<Vec<[u32; 2]>, Error> {
    input::check(positions.len(), triangles)?;
    input::check_finite(positions, triangles)?;
    let count = triangles.len();
    if let Some(&t) = among.unwrap_or(&[]).iter().find(|&&t| t as usize >= count) {
        let index = t as usize;
        return Err(Error::SelectionOutOfRange { index, count });
    }
    Ok(match among {
        Some(asked) => intersections::told_of_some(positions, triangles, asked, usize::MAX, tell),
        None => intersections::of_all(positions, triangles, tell),
    })
}
