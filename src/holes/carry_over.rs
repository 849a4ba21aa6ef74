//! Where points lie on triangles of a mesh: so that what is new takes colours and the like from what was there.

use nalgebra::Vector3;
use rstar::RTree;

use super::parents::{Parents, nearest_on};
use crate::holes::tree_triangle::Placed;
use crate::mesh::input;
use crate::support::error::Error;

/// The point of some triangles that is nearest to another point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carried {
    /// The triangle that it is in.
    pub triangle: u32,
    /// Its place there: the triangle's corners in their order, and their weights.
    pub parents: Parents,
}

/// Per point the nearest one of some triangles of a mesh, by their numbers: to carry attributes over from triangles that were
/// [erased](super::erase) to the vertices that took their place. None for a point that is not finite, and where no triangle is.
///
/// ```
/// use fairmesh::carry_over;
/// let positions = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [4.0, 4.0, 0.0]];
/// let triangles = [[0, 1, 2], [1, 3, 2]];
/// let found = carry_over(&positions, &triangles, &[0, 1], &[[1.0, 2.0, 0.5], [5.0, 5.0, 0.0]])?;
/// let [first, second] = [found[0].unwrap(), found[1].unwrap()];
/// assert_eq!((first.triangle, first.parents.vertices), (0, [0, 1, 2]));
/// assert_eq!(first.parents.weights, [0.25, 0.25, 0.5]);
/// assert_eq!((second.triangle, second.parents.weights), (1, [0.0, 1.0, 0.0]));
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// [`Error::SelectionOutOfRange`] for a triangle that does not exist, [`Error::IndexOutOfRange`], [`Error::TooLarge`].
pub fn carry_over(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    among: &[u32],
    points: &[[f64; 3]],
) -> Result<Vec<Option<Carried>>, Error> {
    input::check(positions.len(), triangles)?;
    let count = triangles.len();
    if let Some(&t) = among.iter().find(|&&t| t as usize >= count) {
        let index = t as usize;
        return Err(Error::SelectionOutOfRange { index, count });
    }
    let placed = |&number: &u32| Placed::of(positions, triangles, number);
    let mut among = among.to_vec();
    among.sort_unstable();
    among.dedup();
    let tree = RTree::bulk_load(among.iter().filter_map(placed).collect());
    let carried = |p: &[f64; 3]| {
        let found = tree.nearest_neighbor(p)?;
        let (_, weights) = nearest_on(&found.x, &Vector3::from(*p));
        Some(Carried {
            triangle: found.number,
            parents: Parents {
                vertices: triangles[found.number as usize],
                weights,
            },
        })
    };
    let is_finite = |p: &[f64; 3]| p.iter().all(|c| c.is_finite());
    Ok(points
        .iter()
        .map(|p| if is_finite(p) { carried(p) } else { None })
        .collect())
}
