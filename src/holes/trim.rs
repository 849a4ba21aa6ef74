//! What spoils the boundary of a hole, taken away before it is filled.

use nalgebra::Vector3;

use super::erase::ErasedMesh;
use super::links::Links;
use crate::mesh::Joined;
use crate::mesh::coincident::Coincident;
use crate::mesh::halfedge::next;
use crate::support::error::Error;

/// Each pass takes what the one before has laid bare; after so many it is the mesh and not its boundary that is taken away.
/// Half or double, of 1 case: none changes.
const PASSES: usize = 8;

/// How much may be taken away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrimLimits {
    /// At most so many triangles.
    pub triangles: usize,
    /// Not more area than this, all of them together. Default: no bound.
    pub area: Option<f64>,
}

/// What is left.
#[derive(Debug, Clone, PartialEq)]
pub struct Trimmed {
    /// The numbers of the triangles that are left, ascending.
    pub kept: Vec<u32>,
    /// The area of those that are not.
    pub area: f64,
}

/// Takes away triangles at some boundary loops that would spoil a patch: slender ones, with an angle below 5 degrees, spikes and fins, turned by
/// more than 100 degrees against one beside them, and single triangles that hang at the others by one edge. The worst go first, then
/// those that this lays bare, in no more than eight passes. The vertices stay, used or not; loops count anew afterwards.
///
/// ```
/// use fairmesh::{Coincident, TrimLimits, trim_boundary};
/// // Two squares, and a triangle that hangs at them by one edge.
/// let positions = [
///     [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.5, 2.0, 0.0],
/// ];
/// let triangles = [[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2], [3, 2, 6]];
/// let limits = TrimLimits { triangles: 1, area: None };
/// let trimmed = trim_boundary(&positions, &triangles, &[0], &limits, Coincident::default())?;
/// assert_eq!(trimmed.kept.len(), 4);
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// [`Error::SelectionOutOfRange`] for a loop that does not exist, [`Error::BadOption`] for an area that is not a number or negative, and those of
/// [`boundary_loops_joined`](super::boundary_loops_joined).
pub fn trim_boundary(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    loops: &[usize],
    limits: &TrimLimits,
    coincident: Coincident,
) -> Result<Trimmed, Error> {
    let most = limits.area.unwrap_or(f64::INFINITY);
    Error::check_option("trim_area", most, most >= 0.0, "not negative")?;
    let joined = Joined::new(positions, triangles, coincident)?;
    let links = Links::new(positions.len(), &joined.triangles)?;
    let found = links.loops(positions, coincident);
    let count = found.len();
    if let Some(&index) = loops.iter().find(|&&l| l >= count) {
        return Err(Error::SelectionOutOfRange { index, count });
    }
    // A triangle that is gone at a loop would have its edges the other way round.
    let across = |&h: &u32| (links.origin(next(h)), links.origin(h));
    let open = loops.iter().flat_map(|&l| found[l].half_edges.iter().map(across));
    let mut cut = ErasedMesh {
        vertices: positions.len(),
        triangles: &joined.triangles,
        is_gone: vec![false; triangles.len()],
        open: open.collect(),
    };
    let (mut gone, mut area) = (0, 0.0);
    for _ in 0..PASSES {
        let mut is_done = true;
        for t in cut.spoiling_or_hanging(positions, true)? {
            let [a, b, c] = triangles[t as usize].map(|v| Vector3::from(positions[v as usize]));
            let own = 0.5 * (b - a).cross(&(c - a)).norm();
            if gone < limits.triangles && area + own <= most {
                cut.is_gone[t as usize] = true;
                (gone, area, is_done) = (gone + 1, area + own, false);
            }
        }
        if is_done {
            break;
        }
    }
    Ok(Trimmed {
        kept: cut.kept(),
        area,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sheet of 8 by 8 squares without the four in the middle, and a triangle in the hole that hangs at its boundary by one edge.
    fn sheet_with_a_tooth() -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let at = |i: u32, j: u32| 9 * i + j;
        let mut x: Vec<[f64; 3]> = (0..81)
            .map(|v| [f64::from(v / 9), f64::from(v % 9), 0.0])
            .collect();
        let squares = (0..64).map(|s| (s / 8, s % 8));
        let is_there = |&(i, j): &(u32, u32)| !(3..5).contains(&i) || !(3..5).contains(&j);
        let mut t: Vec<[u32; 3]> = squares
            .filter(is_there)
            .flat_map(|(i, j)| {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                [[a, b, c], [a, c, d]]
            })
            .collect();
        x.push([3.7, 3.6, 0.4]);
        t.push([at(3, 4), at(3, 3), 81]);
        (x, t)
    }

    #[test]
    fn a_tooth_goes_within_the_limits_and_nothing_else() {
        let (x, t) = sheet_with_a_tooth();
        let loops = crate::holes::boundary_loops(&x, &t).unwrap();
        let hole = (0..loops.len())
            .find(|&l| loops[l].vertices.contains(&81))
            .unwrap();
        let trim = |triangles, area| {
            let limits = TrimLimits { triangles, area };
            trim_boundary(&x, &t, &[hole], &limits, Coincident::default()).unwrap()
        };
        let all = trim(100, None);
        assert_eq!(all.kept, (0..t.len() as u32 - 1).collect::<Vec<_>>());
        assert_above!(all.area, 0.3);
        assert_below!(all.area, 0.5);
        assert_eq!(trim(0, None).kept.len(), t.len());
        assert_eq!(trim(100, Some(0.1)).kept.len(), t.len());
        // At the other loop two corners of the sheet hang by one edge, and what these lay bare.
        let limits = TrimLimits {
            triangles: 2,
            area: None,
        };
        let other = trim_boundary(&x, &t, &[1 - hole], &limits, Coincident::default()).unwrap();
        assert_eq!(other.kept.len(), t.len() - 2);
        assert!(trim_boundary(&x, &t, &[2], &limits, Coincident::default()).is_err());
        let wrong = TrimLimits {
            triangles: 1,
            area: Some(-1.0),
        };
        assert_matches!(
            trim_boundary(&x, &t, &[hole], &wrong, Coincident::default()),
            Err(Error::BadOption {
                name: "trim_area",
                ..
            })
        );
    }
}
