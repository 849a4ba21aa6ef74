//! What a command changed in a mesh: the triangles that are gone and those that are new.

use std::cell::OnceCell;

use fairmesh::{DistanceTo, Error, SurfaceDistance};

use super::surface::{MeshSide, V3};
use crate::bounds::Bounds;
use crate::picture::Refined;

/// A mesh before and after.
pub struct Comparison<'a> {
    pub before: MeshSide<'a>,
    pub after: MeshSide<'a>,
    /// Per triangle of the mesh before, whether it is there no more.
    pub gone: Vec<bool>,
    /// Per triangle of the mesh after, whether it was not there.
    pub new: Vec<bool>,
    /// How far it has moved; None where nothing is gone: what fills a hole has moved from nowhere.
    pub moved: Option<SurfaceMotion>,
    /// The mean curvature before and after, once it is asked for.
    curvature: [OnceCell<Vec<f64>>; 2],
}

/// How far surfaces have moved, across themselves: both ways, as an ear that is taken away was farther from what there is now than that is
/// from the ear.
pub struct SurfaceMotion {
    /// What is new from the mesh before.
    there: SurfaceDistance,
    /// What is gone from the mesh after.
    pub(super) back: SurfaceDistance,
    /// The meshes before and after, with the vertices that these are of: enough to paint them by.
    pub(super) painted: [Refined; 2],
}

impl SurfaceMotion {
    /// The way that has the largest distance.
    pub fn farthest(&self) -> &SurfaceDistance {
        match self.back.largest > self.there.largest {
            true => &self.back,
            false => &self.there,
        }
    }

    /// Root mean square over both.
    pub fn rms(&self) -> f64 {
        (0.5 * (self.there.rms.powi(2) + self.back.rms.powi(2))).sqrt()
    }

    /// Mean over both.
    pub fn mean(&self) -> f64 {
        0.5 * (self.there.mean + self.back.mean)
    }
}

impl<'a> Comparison<'a> {
    /// Triangles are told by the places of their corners, whatever their numbers are.
    ///
    /// # Errors
    /// Of the measurement: positions that are not finite, threads that ran out.
    pub fn new(before: MeshSide<'a>, after: MeshSide<'a>) -> Result<Self, Error> {
        // Most of a mesh stands where it stood, under the same number.
        let stays: Vec<bool> = (before.triangles.iter().zip(after.triangles).enumerate())
            .map(|(t, _)| key(before.corners(t)) == key(after.corners(t)))
            .collect();
        let others = |of: &MeshSide<'_>| -> Vec<(Key, usize)> {
            let changed = (0..of.triangles.len()).filter(|&t| stays.get(t) != Some(&true));
            let mut keys: Vec<_> = changed.map(|t| (key(of.corners(t)), t)).collect();
            keys.sort_unstable();
            keys
        };
        let [was, is] = [&before, &after].map(others);
        let without = |of: &MeshSide<'_>, own: &[(Key, usize)], others: &[(Key, usize)]| {
            let mut is_without = vec![false; of.triangles.len()];
            for (key, t) in own {
                is_without[*t] = others.binary_search_by_key(key, |other| other.0).is_err();
            }
            is_without
        };
        let (gone, new) = (without(&before, &was, &is), without(&after, &is, &was));
        let moved = match gone.contains(&true) && new.contains(&true) {
            true => {
                let reach = reach(&[before.bounds(|t| gone[t]), after.bounds(|t| new[t])]);
                let (there, painted_after) = moved(&after, &new, &before, &reach)?;
                let (back, painted_before) = moved(&before, &gone, &after, &reach)?;
                Some(SurfaceMotion {
                    there,
                    back,
                    painted: [painted_before, painted_after],
                })
            }
            false => None,
        };
        Ok(Self {
            before,
            after,
            gone,
            new,
            moved,
            curvature: Default::default(),
        })
    }

    /// The mean curvature of every vertex before (0) or after (1); NaN where none can be taken.
    pub(super) fn curvature(&self, side: usize) -> &[f64] {
        let surface = [&self.before, &self.after][side];
        self.curvature[side].get_or_init(|| {
            fairmesh::mean_curvature(surface.positions, surface.triangles)
                .unwrap_or_else(|_| vec![f64::NAN; surface.positions.len()])
        })
    }

    /// Whether there is anything to be seen.
    pub fn is_changed(&self) -> bool {
        self.gone.contains(&true) || self.new.contains(&true)
    }

    /// Whether vertices have moved, and that is all.
    pub(super) fn has_same_triangles(&self) -> bool {
        self.before.triangles == self.after.triangles
    }

    /// The changed surface after, or before if there is none; and which triangles of it are changed.
    pub(super) fn changed(&self) -> (&MeshSide<'a>, &[bool]) {
        match self.new.contains(&true) {
            true => (&self.after, &self.new),
            false => (&self.before, &self.gone),
        }
    }
}

/// Points that are painted are no farther apart, in diagonals of what has changed: ten pixels, between which colours are interpolated. With half it
/// takes three times as long (a dent); with double no figure on the pages of three regions changes, and twenty pixels are interpolated.
const SPACING: f64 = 1.0 / 50.0;

/// The corners of a triangle from the least one on, in its order, bit by bit.
type Key = [[u64; 3]; 3];

fn key(corners: [V3; 3]) -> Key {
    // Adding zero makes one of 0 and -0.
    let [a, b, c] = corners.map(|p| p.map(|x| (x + 0.0).to_bits()));
    [[a, b, c], [b, c, a], [c, a, b]]
        .into_iter()
        .min()
        .unwrap_or([a, b, c])
}

/// Where the nearest points are of all that has changed: one of what was there instead is no farther away than the diagonal of both.
fn reach(changed: &[Bounds; 2]) -> Bounds {
    let both = changed[0].with(&changed[1]);
    both.grown(both.diagonal())
}

/// How far some triangles are from another mesh, and the surface with these refined, whose vertices it is of; 0 elsewhere.
fn moved(
    of: &MeshSide<'_>,
    marked: &[bool],
    from: &MeshSide<'_>,
    reach: &Bounds,
) -> Result<(SurfaceDistance, Refined), Error> {
    let longest = SPACING * of.bounds(|t| marked[t]).diagonal();
    let refined = Refined::new(of.positions, of.triangles, |t| marked[t], longest);
    let of = MeshSide {
        positions: &refined.positions,
        triangles: &refined.triangles,
    };
    let marked: Vec<bool> = refined.part_of.iter().map(|&t| marked[t as usize]).collect();
    let is_used = of.vertices_of(&marked);
    let mut number = vec![0u32; is_used.len()];
    let mut positions = Vec::new();
    for v in (0..is_used.len()).filter(|&v| is_used[v]) {
        number[v] = positions.len() as u32;
        positions.push(of.positions[v]);
    }
    let triangles: Vec<[u32; 3]> = (of.triangles.iter().zip(&marked))
        .filter(|(_, marked)| **marked)
        .map(|(t, _)| t.map(|v| number[v as usize]))
        .collect();
    // What is not finite elsewhere in the file is nowhere near.
    let is_near = |t: &&[u32; 3]| {
        let corners = t.map(|v| from.positions[v as usize]);
        corners.iter().flatten().all(|x| x.is_finite()) && reach.meets(corners)
    };
    let near: Vec<[u32; 3]> = from.triangles.iter().filter(is_near).copied().collect();
    let mut found = DistanceTo::new(from.positions, &near)?.of(&positions, &triangles)?;
    let all = (0..is_used.len()).map(|v| match is_used[v] {
        true => found.vertices[number[v] as usize],
        false => 0.0,
    });
    found.vertices = all.collect();
    Ok((found, refined))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [V3; 5] = [
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [2.0, 2.0, 0.0],
        [0.0, 2.0, 0.0],
        [1.0, 1.0, 0.0],
    ];
    const FAN: [[u32; 3]; 4] = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];

    fn surface<'a>(positions: &'a [V3], triangles: &'a [[u32; 3]]) -> MeshSide<'a> {
        MeshSide { positions, triangles }
    }

    #[test]
    fn a_vertex_that_moves_changes_the_triangles_around_it() {
        let mut after = SQUARE;
        after[4][2] = 0.25;
        let same = Comparison::new(surface(&SQUARE, &FAN), surface(&SQUARE, &FAN)).unwrap();
        assert!(!same.is_changed());
        assert!(same.moved.is_none());
        let found = Comparison::new(surface(&SQUARE, &FAN), surface(&after, &FAN)).unwrap();
        assert_all!(found.gone.iter(), |&gone| gone);
        assert_all!(found.new.iter(), |&new| new);
        let moved = found.moved.as_ref().unwrap();
        let there = &moved.there;
        assert_eq!((there.largest, there.largest_at), (0.25, after[4]));
        assert_eq!(there.vertices[..5], [0.0, 0.0, 0.0, 0.0, 0.25]);
    }

    #[test]
    fn triangles_are_known_under_other_numbers() {
        // The same corners in another order; a triangle that is filled in.
        let order = [4, 3, 2, 1, 0];
        let positions = order.map(|v: usize| SQUARE[v]);
        let open: Vec<[u32; 3]> = FAN[..3].iter().map(|&[a, b, c]| [4 - b, 4 - c, 4 - a]).collect();
        let filled = Comparison::new(surface(&positions, &open), surface(&SQUARE, &FAN)).unwrap();
        assert_eq!(filled.gone, [false; 3]);
        assert_eq!(filled.new, [false, false, false, true]);
        assert!(filled.moved.is_none());
        assert!(filled.is_changed());
    }
}
