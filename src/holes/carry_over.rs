//! Where points lie on triangles of a mesh: so that what is new takes colours and the like from what was there.

use fairmesh_linear::interrupt::is_stopped;
use nalgebra::Vector3;

use super::parents::{Parents, nearest_on};
use crate::fairing::{ProgressCallback, on_workers_unless_stopped};
use crate::holes::grove::Grove;
use crate::holes::tree_triangle::Placed;
use crate::mesh::input;
use crate::support::error::Error;

/// The fraction of the progress at which the triangles are in trees: its share of the time, measured for as many points as triangles.
/// Half or double: only the progress changes.
const GROWN: f64 = 0.4;
/// After so many points it is told how far it is: a few milliseconds.
/// Half or double: only the progress changes.
const TELLING: usize = 2_000;

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
    carried(positions, triangles, among, points, &mut |_| ())
}

/// [`carry_over`], which calls `progress` on the calling thread, as [`fair_with_progress`](crate::fair_with_progress) does. `Break`
/// stops the run: then there is no result.
///
/// # Errors
/// Those of [`carry_over`].
pub fn carry_over_with_progress(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    among: &[u32],
    points: &[[f64; 3]],
    progress: &mut ProgressCallback<'_>,
) -> Result<Option<Vec<Option<Carried>>>, Error> {
    on_workers_unless_stopped(1, progress, "carrying over", |tell| {
        carried(positions, triangles, among, points, tell)
    })
}

fn carried(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    among: &[u32],
    points: &[[f64; 3]],
    tell: &mut dyn FnMut(f64),
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
    let mut part = |fraction: f64| tell(GROWN * fraction);
    let grove = Grove::new(among.iter().filter_map(placed).collect(), &mut part);
    let carried = |p: &[f64; 3]| {
        let found = grove.nearest(p)?;
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
    let mut found = Vec::with_capacity(points.len());
    for (k, p) in points.iter().enumerate() {
        if k.is_multiple_of(TELLING) {
            tell(GROWN + (1.0 - GROWN) * k as f64 / points.len() as f64);
        }
        if is_stopped() {
            break;
        }
        found.push(if is_finite(p) { carried(p) } else { None });
    }
    Ok(found)
}
