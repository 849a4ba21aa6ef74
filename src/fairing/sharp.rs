//! Sharp edges that reach the boundary of a region.

mod ends;
mod outside;
mod sides;

use crate::mesh::coincident::Coincident;
use crate::mesh::numbering::Numbering;
use crate::mesh::selection::Selection;
use crate::mesh::{Joined, RegionMesh};
use crate::support::error::Error;
pub use ends::CreaseEnd;

/// Where creases of the surroundings, of at least so many degrees, arrive at the boundary of a region: two normals hold there, and no
/// smooth surface has both. The region itself is not looked at. Vertices have the smallest number of their copies.
///
/// ```
/// use fairmesh::{Coincident, Selection, crease_ends};
///
/// // A roof of 9 by 9 vertices, bent by 90 degrees along its middle row; the nine in the middle are free.
/// let at = |v: u32| [f64::from(v % 9), f64::from(v / 9), -f64::from((v / 9).abs_diff(4))];
/// let positions: Vec<[f64; 3]> = (0..81).map(at).collect();
/// let cell = |c: u32| { let v = c / 8 * 9 + c % 8; [[v, v + 1, v + 10], [v, v + 10, v + 9]] };
/// let triangles: Vec<[u32; 3]> = (0..64).flat_map(cell).collect();
/// let free = [30, 31, 32, 39, 40, 41, 48, 49, 50];
///
/// let ends = crease_ends(&positions, &triangles, Selection::Vertices(&free), Coincident::default(), 20.0)?;
/// let found: Vec<(u32, f64)> = ends.iter().map(|end| (end.vertex, end.angle.round())).collect();
/// assert_eq!(found, [(38, 90.0), (42, 90.0)]);
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// Those of [`fair`](crate::fair) about the mesh and the selection.
pub fn crease_ends(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    coincident: Coincident,
    least: f64,
) -> Result<Vec<CreaseEnd>, Error> {
    let joined = Joined::new(positions, triangles, coincident)?;
    let selected = joined.copies.selection(selection);
    let numbering = (Numbering::AsGiven, false);
    let regions = RegionMesh::of_components(
        positions,
        &joined.triangles,
        selected.selection(),
        &|_| false,
        numbering,
    )?;
    let mut is_free = vec![false; positions.len()];
    for v in regions
        .iter()
        .flat_map(|region| &region.vertex_ids[..region.free])
    {
        is_free[*v as usize] = true;
    }
    Ok(ends::crease_ends(positions, &joined.triangles, &is_free, least))
}
