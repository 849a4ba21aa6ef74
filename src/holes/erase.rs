//! Triangles deleted, so that a new patch can take their place.

use nalgebra::Vector3;

use super::links::Links;
use super::loop_set::normal;
use crate::mesh::Joined;
use crate::mesh::coincident::Coincident;
use crate::mesh::halfedge::next;
use crate::mesh::input;
use crate::quality::smallest_angle;
use crate::support::error::Error;

/// What hangs loose at the edge is dropped in so many passes, at most: each takes what the one before has laid bare.
/// Half or double, of 4 cases: none changes.
const PASSES: usize = 8;
/// A triangle beside what is erased is slender if it has a smaller angle than this, in degrees.
/// Of 2 cases, half: none changes; double: 1 changes, 1 get another triangulation, +5 % iterations.
const SLENDER: f64 = 5.0;
/// A triangle beside what is erased is a fin if it is turned by more than this (cosine of 100 degrees) against one beside it: no edge of a box.
/// Half or double, of 2 cases: none changes.
const FIN: f64 = -0.174;

/// What is left of a mesh without some of its triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Erased {
    /// The numbers of the triangles that are left, ascending.
    pub kept: Vec<u32>,
    /// How many were dropped besides those named: they hung at the mesh by one edge or by a vertex.
    pub dropped: usize,
    /// How many more were dropped because they were slender or fins, see [`erase_and_clean`].
    pub cleaned: usize,
    /// The loops that the deleted triangles leave, by their numbers in [`boundary_loops`](super::boundary_loops) of those that are
    /// kept.
    pub loops: Vec<usize>,
}

/// Deletes triangles, and what would hang loose where they were, and says which loops that leaves: to be filled, or joined to
/// others. The vertices stay, used or not.
///
/// ```
/// use fairmesh::{Coincident, erase};
/// // An octahedron without two triangles side by side.
/// let positions = [
///     [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0],
/// ];
/// let triangles = [
///     [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5],
/// ];
/// let erased = erase(&positions, &triangles, &[0, 1], Coincident::default())?;
/// assert_eq!((erased.kept, erased.dropped), (vec![2, 3, 4, 5, 6, 7], 0));
/// assert_eq!(erased.loops, [0]);
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// [`Error::SelectionOutOfRange`], and those of [`boundary_loops_joined`](super::boundary_loops_joined).
pub fn erase(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    erased: &[u32],
    coincident: Coincident,
) -> Result<Erased, Error> {
    erase_and_clean(positions, triangles, erased, coincident, 0)
}

/// [`erase`], which drops up to so many triangles more beside what is erased, those that spoil the boundary of a patch: with an angle below 5
/// degrees, or turned by more than 100 degrees against a triangle beside them. The worst go first, and then those that this lays bare.
///
/// ```
/// use fairmesh::{Coincident, erase_and_clean};
/// // A sheet of 6 by 6 squares, each divided into two triangles, of which the third column is narrow.
/// let number = |i: u32, j: u32| 7 * i + j;
/// let grid = |n: u32| (0..n).flat_map(move |i| (0..n).map(move |j| (i, j)));
/// let x = [0.0, 1.0, 2.0, 2.02, 3.0, 4.0, 5.0];
/// let positions: Vec<[f64; 3]> = grid(7).map(|(i, j)| [x[i as usize], f64::from(j), 0.0]).collect();
/// let triangles: Vec<[u32; 3]> = grid(6)
///     .flat_map(|(i, j)| {
///         let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
///         [[a, b, c], [a, c, d]]
///     })
///     .collect();
/// // Two squares beside it.
/// let erased = erase_and_clean(&positions, &triangles, &[40, 41, 42, 43], Coincident::default(), 4)?;
/// assert_eq!((erased.cleaned, erased.dropped), (4, 1)); // one hung loose then
/// assert_eq!(erased.kept.len(), 72 - 4 - 4 - 1);
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// Those of [`erase`].
pub fn erase_and_clean(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    erased: &[u32],
    coincident: Coincident,
    most: usize,
) -> Result<Erased, Error> {
    let count = triangles.len();
    if let Some(&t) = erased.iter().find(|&&t| t as usize >= count) {
        let index = t as usize;
        return Err(Error::SelectionOutOfRange { index, count });
    }
    let joined = Joined::new(positions, triangles, coincident)?;
    input::check(positions.len(), &joined.triangles)?;
    let mut cut = ErasedMesh {
        vertices: positions.len(),
        triangles: &joined.triangles,
        is_gone: vec![false; count],
        open: Vec::new(),
    };
    erased.iter().for_each(|&t| cut.is_gone[t as usize] = true);
    let named = cut.gone();
    cut.drop_loose()?;
    let mut cleaned = 0;
    while cleaned < most {
        let mut spoiling = cut.spoiling(positions)?;
        spoiling.truncate(most - cleaned);
        if spoiling.is_empty() {
            break;
        }
        cleaned += spoiling.len();
        spoiling.into_iter().for_each(|t| cut.is_gone[t as usize] = true);
        cut.drop_loose()?;
    }
    let kept = cut.kept();
    Ok(Erased {
        dropped: cut.gone() - named - cleaned,
        cleaned,
        loops: cut.loops(positions, &kept, coincident)?,
        kept,
    })
}

/// A mesh of which some triangles are gone.
pub(super) struct ErasedMesh<'m> {
    pub(super) vertices: usize,
    pub(super) triangles: &'m [[u32; 3]],
    pub(super) is_gone: Vec<bool>,
    /// Directed edges that count as if a triangle were gone there.
    pub(super) open: Vec<(u32, u32)>,
}

impl ErasedMesh<'_> {
    fn gone(&self) -> usize {
        self.is_gone.iter().filter(|&&gone| gone).count()
    }

    pub(super) fn kept(&self) -> Vec<u32> {
        let all = 0..self.triangles.len() as u32;
        all.filter(|&t| !self.is_gone[t as usize]).collect()
    }

    /// The directed edges of what is gone, sorted.
    fn edges(&self) -> Vec<(u32, u32)> {
        let gone = self
            .triangles
            .iter()
            .zip(&self.is_gone)
            .filter(|(_, gone)| **gone);
        let edges = gone.flat_map(|(t, _)| [0, 1, 2].map(|k| (t[k], t[(k + 1) % 3])));
        let mut edges: Vec<(u32, u32)> = edges.chain(self.open.iter().copied()).collect();
        edges.sort_unstable();
        edges
    }

    fn drop_loose(&mut self) -> Result<(), Error> {
        for _ in 0..PASSES {
            let loose = self.loose()?;
            if loose.is_empty() {
                break;
            }
            loose.into_iter().for_each(|t| self.is_gone[t as usize] = true);
        }
        Ok(())
    }

    /// The slender triangles and the fins with an edge beside something that is gone, the worst first.
    fn spoiling(&self, positions: &[[f64; 3]]) -> Result<Vec<u32>, Error> {
        self.spoiling_or_hanging(positions, false)
    }

    /// The same, and if asked triangles that hang at the others by one edge.
    pub(super) fn spoiling_or_hanging(
        &self,
        positions: &[[f64; 3]],
        hanging: bool,
    ) -> Result<Vec<u32>, Error> {
        let kept = self.kept();
        let triangles: Vec<[u32; 3]> = kept.iter().map(|&t| self.triangles[t as usize]).collect();
        let links = Links::new(self.vertices, &triangles)?;
        let gone = self.edges();
        let corners = |t: u32| triangles[t as usize].map(|v| Vector3::from(positions[v as usize]));
        let faces_gone = |h: u32| {
            let edge = (links.origin(next(h)), links.origin(h));
            links.across(h).is_none() && gone.binary_search(&edge).is_ok()
        };
        let mut found = Vec::new();
        for t in 0..triangles.len() as u32 {
            let sides = [3 * t, 3 * t + 1, 3 * t + 2];
            if !sides.iter().any(|&h| faces_gone(h)) {
                continue;
            }
            let own = normal(&corners(t));
            let beside = sides.iter().filter_map(|&h| links.across(h));
            let cosines = beside.map(|o| own.dot(&normal(&corners(o / 3))));
            let angle = smallest_angle(&corners(t));
            let hangs = hanging && sides.iter().filter(|&&h| links.across(h).is_none()).count() > 1;
            if hangs || angle < SLENDER || cosines.fold(1.0, f64::min) < FIN {
                found.push((angle, kept[t as usize]));
            }
        }
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        Ok(found.into_iter().map(|entry| entry.1).collect())
    }

    /// The triangles that hang at the others by one edge, and smaller fans at vertices that have several, where something is
    /// gone.
    fn loose(&self) -> Result<Vec<u32>, Error> {
        let kept = self.kept();
        let triangles: Vec<[u32; 3]> = kept.iter().map(|&t| self.triangles[t as usize]).collect();
        let links = Links::new(self.vertices, &triangles)?;
        let gone = self.edges();
        let mut is_beside = vec![false; self.vertices];
        gone.iter().for_each(|edge| is_beside[edge.0 as usize] = true);
        let is_open = |h: u32| links.across(h).is_none();
        let faces_gone = |h: u32| {
            let edge = (links.origin(next(h)), links.origin(h));
            gone.binary_search(&edge).is_ok()
        };
        let mut loose = Vec::new();
        for t in 0..triangles.len() as u32 {
            let sides = [3 * t, 3 * t + 1, 3 * t + 2];
            let open = sides.iter().filter(|&&h| is_open(h)).count();
            if open > 1 && sides.iter().any(|&h| is_open(h) && faces_gone(h)) {
                loose.push(kept[t as usize]);
            }
        }
        for v in (0..self.vertices as u32).filter(|&v| is_beside[v as usize]) {
            let mut fans: Vec<Vec<u32>> = Vec::new();
            for &h in links.at(v).iter().filter(|&&h| links.is_boundary(h)) {
                let mut fan = Vec::new();
                let _ = links.follow(h, |g| fan.push(g / 3));
                fans.push(fan);
            }
            let largest = (0..fans.len()).rev().max_by_key(|&i| fans[i].len());
            for i in (0..fans.len()).filter(|&i| Some(i) != largest) {
                loose.extend(fans[i].iter().map(|&t| kept[t as usize]));
            }
        }
        loose.sort_unstable();
        loose.dedup();
        Ok(loose)
    }

    /// The loops of what is kept with an edge beside something that is gone.
    fn loops(
        &self,
        positions: &[[f64; 3]],
        kept: &[u32],
        coincident: Coincident,
    ) -> Result<Vec<usize>, Error> {
        let triangles: Vec<[u32; 3]> = kept.iter().map(|&t| self.triangles[t as usize]).collect();
        let links = Links::new(self.vertices, &triangles)?;
        let gone = self.edges();
        let faces_gone = |&h: &u32| {
            let edge = (links.origin(next(h)), links.origin(h));
            gone.binary_search(&edge).is_ok()
        };
        let loops = links.loops(positions, coincident);
        let beside = |l: &usize| loops[*l].half_edges.iter().any(faces_gone);
        Ok((0..loops.len()).filter(beside).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sheet of `n` by `n` squares, each divided into two triangles.
    fn sheet(n: u32) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let grid = |n: u32| (0..n).flat_map(move |i| (0..n).map(move |j| (i, j)));
        let number = |i: u32, j: u32| (n + 1) * i + j;
        let positions = grid(n + 1).map(|(i, j)| [f64::from(i), f64::from(j), 0.0]);
        let squares = grid(n).flat_map(|(i, j)| {
            let [a, b, c, d] = [
                number(i, j),
                number(i + 1, j),
                number(i + 1, j + 1),
                number(i, j + 1),
            ];
            [[a, b, c], [a, c, d]]
        });
        (positions.collect(), squares.collect())
    }

    #[test]
    fn an_erased_triangle_names_vertices_that_exist() {
        let (x, mut t) = sheet(3);
        t[7][1] = 1 << 18;
        let expected = Error::IndexOutOfRange {
            triangle: 7,
            index: 1 << 18,
            vertex_count: 16,
        };
        assert_eq!(erase(&x, &t, &[7], Coincident::default()), Err(expected));
    }

    #[test]
    fn what_hangs_loose_goes_with_what_is_erased() {
        let (x, t) = sheet(8);
        // All around the triangle 36 but itself: it would be left by itself in the hole.
        let [a, b, c] = t[36];
        let beside = |t: &[u32; 3]| t.iter().filter(|v| [a, b, c].contains(v)).count() > 1;
        let around: Vec<u32> = (0..t.len() as u32)
            .filter(|&i| i != 36 && beside(&t[i as usize]))
            .collect();
        assert_eq!(around.len(), 3);
        let erased = erase(&x, &t, &around, Coincident::default()).unwrap();
        assert!(!erased.kept.contains(&36), "{:?}", erased.kept);
        assert_eq!(erased.loops.len(), 1);
        let kept: Vec<[u32; 3]> = erased.kept.iter().map(|&i| t[i as usize]).collect();
        let loops = crate::holes::boundary_loops(&x, &kept).unwrap();
        assert_eq!(loops.len(), 2);
        assert_all!(loops.iter(), |of| of.touching.is_empty());
        assert!(erase(&x, &t, &[128], Coincident::default()).is_err());
    }

    #[test]
    fn slender_triangles_and_fins_go_up_to_the_count() {
        let (mut x, t) = sheet(8);
        let square = |i: u32, j: u32| 2 * (8 * i + j);
        let gone: Vec<u32> = [3, 4]
            .iter()
            .flat_map(|&i| [3, 4].map(|j| square(i, j)))
            .flat_map(|first| [first, first + 1])
            .collect();
        let clean =
            |x: &[[f64; 3]], most| erase_and_clean(x, &t, &gone, Coincident::default(), most).unwrap();
        let sound = clean(&x, 100);
        assert_eq!((sound.cleaned, sound.dropped), (0, 0));
        assert_eq!(sound, erase(&x, &t, &gone, Coincident::default()).unwrap());
        // The corner (3, 4) at the edge of what is gone, nearly on the next one: two triangles have hardly any width.
        x[3 * 9 + 4] = [2.02, 4.0, 0.0];
        let cleaned = clean(&x, 100);
        assert!(cleaned.cleaned > 0, "{cleaned:?}");
        assert_eq!(clean(&x, 1).cleaned, 1);
        // Folded over the next one.
        x[3 * 9 + 4] = [1.0, 4.0, 0.1];
        assert_above!(clean(&x, 100).cleaned, 0);
    }
}
