//! All pairs of triangles that intersect: a tree of boxes gives candidates, exact signs decide.

use rayon::prelude::*;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, Envelope, RTree, RTreeObject};

use super::groups::{Group, groups};
use super::triangles::{Corners, projection};
use fairmesh_linear::dispatch::vectorized;

/// Groups that a thread takes at once.
const CHUNK: usize = 64;

/// Groups by the boxes around them.
type Tree = RTree<GeomWithData<Rectangle<[f64; 3]>, usize>>;

/// An upright box in space.
pub(crate) type Bounds = AABB<[f64; 3]>;

/// A triangle with its number, and whether its intersections are asked for.
#[derive(Clone)]
pub(crate) struct Member {
    /// Finite.
    pub(crate) corners: Corners,
    pub(crate) number: u32,
    pub(crate) is_asked: bool,
}

impl Member {
    pub(crate) fn bounds(&self) -> Bounds {
        AABB::from_points(&self.corners)
    }
}

impl RTreeObject for Member {
    type Envelope = Bounds;

    fn envelope(&self) -> Bounds {
        self.bounds()
    }
}

/// A triangle of a mesh, if its vertices exist and are finite.
pub(crate) fn member(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    number: u32,
    is_asked: bool,
) -> Option<Member> {
    let mut corners = [[0.0; 3]; 3];
    for (corner, &v) in corners.iter_mut().zip(&triangles[number as usize]) {
        *corner = *positions.get(v as usize)?;
    }
    let is_finite = corners.iter().flatten().all(|x| x.is_finite());
    is_finite.then_some(Member {
        corners,
        number,
        is_asked,
    })
}

/// The box around some triangles.
pub(crate) fn bounds_of(members: &[Member]) -> Bounds {
    let mut all = Bounds::new_empty();
    members.iter().for_each(|member| all.merge(&member.bounds()));
    all
}

/// The triangles of a mesh, none of them asked for, that `is_near` takes.
pub(crate) fn members_near(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    is_near: impl Fn(&Bounds) -> bool + Sync,
) -> Vec<Member> {
    (0..triangles.len() as u32)
        .into_par_iter()
        .with_min_len(4096)
        .filter_map(|t| member(positions, triangles, t, false).filter(|m| is_near(&m.bounds())))
        .collect()
}

/// Pairs of intersecting triangles of a mesh, the smaller number first, ascending; at least one of each pair is among those
/// asked for. The search ends at `most` pairs.
///
/// Triangles intersect if they have more in common than a vertex or an edge of both, where vertices at the same position
/// are one; also if they only touch. Triangles without area, or with a position that is not finite, take no part.
pub(crate) fn of_some(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    asked: &[u32],
    most: usize,
) -> Vec<[u32; 2]> {
    let mut is_asked = vec![false; triangles.len()];
    asked.iter().for_each(|&t| is_asked[t as usize] = true);
    let region: Vec<Member> = asked
        .iter()
        .filter_map(|&t| member(positions, triangles, t, true))
        .collect();
    let bounds = bounds_of(&region);
    let sides: Vec<u8> = positions.par_iter().map(|p| sides(p, &bounds)).collect();
    let all_beside = |t: &[u32; 3]| {
        t.iter()
            .fold(u8::MAX, |all, &v| all & sides.get(v as usize).unwrap_or(&0))
            != 0
    };
    let members = (0..triangles.len() as u32)
        .into_par_iter()
        .with_min_len(4096)
        .filter(|&t| !all_beside(&triangles[t as usize]))
        .filter_map(|t| member(positions, triangles, t, is_asked[t as usize]))
        .collect();
    pairs(members, most)
}

/// A bit for each side of a box beyond which a position lies; none if it is not a number. What has a bit in common is beside
/// the box.
fn sides(p: &[f64; 3], bounds: &Bounds) -> u8 {
    let (low, high) = (bounds.lower(), bounds.upper());
    (0..3).fold(0, |sides, axis| {
        let below = u8::from(p[axis] < low[axis]);
        let above = u8::from(p[axis] > high[axis]);
        sides | below << (2 * axis) | above << (2 * axis + 1)
    })
}

/// The same of all triangles, and all pairs.
pub(crate) fn of_all(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let mut members = members_near(positions, triangles, |_| true);
    members.iter_mut().for_each(|member| member.is_asked = true);
    pairs(members, usize::MAX)
}

/// The same of any triangles with different numbers.
pub(crate) fn pairs(mut members: Vec<Member>, most: usize) -> Vec<[u32; 2]> {
    let unit = unit(&members);
    for x in members.iter_mut().flat_map(|m| m.corners.iter_mut().flatten()) {
        *x *= unit;
    }
    members.retain(|member| projection(&member.corners).is_some());
    let groups = groups(members);
    let in_tree = (0..)
        .zip(&groups)
        .map(|(g, group)| GeomWithData::new(group.rectangle(), g));
    let tree = RTree::bulk_load(in_tree.collect());
    let found: Vec<Vec<[u32; 2]>> = (0..groups.len())
        .into_par_iter()
        .step_by(CHUNK)
        .map(|first| {
            vectorized(
                #[inline(always)]
                || pairs_with(first, &tree, &groups, most),
            )
        })
        .collect();
    let mut pairs = found.concat();
    pairs.par_sort_unstable();
    pairs.truncate(most);
    pairs
}

/// The pairs of a run of groups with themselves and with those that follow them; those without a triangle that is asked for
/// are met by the others.
#[inline(always)]
fn pairs_with(first: usize, tree: &Tree, groups: &[Group], most: usize) -> Vec<[u32; 2]> {
    let mut pairs = Vec::new();
    for (g, group) in groups.iter().enumerate().skip(first).take(CHUNK) {
        if !group.has_asked() {
            continue;
        }
        for found in tree.locate_in_envelope_intersecting(&group.bounds) {
            let other = &groups[found.data];
            if found.data > g || !other.has_asked() {
                group.add_pairs(other, &mut pairs);
            } else if found.data == g {
                group.add_own_pairs(&mut pairs);
            }
        }
        if pairs.len() >= most {
            break;
        }
    }
    pairs
}

/// A power of two that brings the coordinates to about one: products of three neither overflow nor vanish.
fn unit(members: &[Member]) -> f64 {
    let coordinates = members.iter().flat_map(|m| m.corners.iter().flatten());
    let largest = coordinates.fold(0.0_f64, |largest, x| largest.max(x.abs()));
    if largest > 0.0 {
        (-largest.log2().round()).clamp(-1000.0, 1000.0).exp2()
    } else {
        1.0
    }
}
