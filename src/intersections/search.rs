//! All pairs of triangles that intersect: a tree of boxes gives candidates, exact signs decide.

use rayon::prelude::*;
use rstar::{AABB, Envelope, RTree, RTreeObject};

use super::triangles::{Corners, intersect, projection};

/// Triangles that a thread takes at once.
const CHUNK: usize = 512;
/// Triangles that are neighbours in the tree.
const GROUP: usize = 8;

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
    let groups = groups(&members);
    let tree = RTree::bulk_load(groups.clone());
    let found: Vec<Vec<[u32; 2]>> = groups
        .par_chunks(CHUNK / GROUP)
        .map(|chunk| pairs_with(chunk, &tree, &members, most))
        .collect();
    let mut pairs = found.concat();
    pairs.par_sort_unstable();
    pairs.truncate(most);
    pairs
}

/// Neighbouring triangles, which the tree knows by their box alone: it is eight times as small, and what is left to compare
/// is compared in a row.
#[derive(Clone)]
struct Group {
    members: Vec<(Bounds, u32)>,
    bounds: Bounds,
    has_asked: bool,
}

impl RTreeObject for Group {
    type Envelope = Bounds;

    fn envelope(&self) -> Bounds {
        self.bounds
    }
}

/// All triangles in groups of at most [`GROUP`], halved again and again across the longest side of the box around their
/// centres.
fn groups(members: &[Member]) -> Vec<Group> {
    let centred = |(m, member): (u32, &Member)| {
        let bounds = member.bounds();
        (bounds.center(), (bounds, m))
    };
    let mut all: Vec<Centred> = (0..).zip(members).map(centred).collect();
    let mut runs = vec![&mut all[..]];
    let mut groups = Vec::with_capacity(members.len().div_ceil(GROUP / 2));
    while let Some(run) = runs.pop() {
        if run.len() > GROUP {
            let axis = longest_side(run);
            let middle = run.len() / 2;
            run.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]));
            let (low, high) = run.split_at_mut(middle);
            runs.extend([low, high]);
        } else if !run.is_empty() {
            groups.push(group(run, members));
        }
    }
    groups
}

/// The middle of a triangle's box, the box, and the triangle's place in the list.
type Centred = ([f64; 3], (Bounds, u32));

fn longest_side(run: &[Centred]) -> usize {
    let mut bounds = Bounds::new_empty();
    run.iter()
        .for_each(|(centre, _)| bounds.merge(&Bounds::from_point(*centre)));
    let side = |axis: usize| bounds.upper()[axis] - bounds.lower()[axis];
    (1..3).fold(
        0,
        |longest, axis| {
            if side(axis) > side(longest) { axis } else { longest }
        },
    )
}

fn group(run: &[Centred], members: &[Member]) -> Group {
    let mut bounds = Bounds::new_empty();
    run.iter().for_each(|(_, (own, _))| bounds.merge(own));
    Group {
        members: run.iter().map(|(_, member)| *member).collect(),
        bounds,
        has_asked: run.iter().any(|(_, (_, m))| members[*m as usize].is_asked),
    }
}

/// The pairs of the triangles of some groups that are asked for with those that are not, or that have greater numbers.
fn pairs_with(chunk: &[Group], tree: &RTree<Group>, members: &[Member], most: usize) -> Vec<[u32; 2]> {
    let mut pairs = Vec::new();
    for group in chunk.iter().filter(|group| group.has_asked) {
        for others in tree.locate_in_envelope_intersecting(&group.bounds) {
            for (bounds, m) in &group.members {
                let member = &members[*m as usize];
                if member.is_asked && bounds.intersects(&others.bounds) {
                    add_pairs(member, bounds, others, members, &mut pairs);
                }
            }
        }
        if pairs.len() >= most {
            break;
        }
    }
    pairs
}

/// The pairs of one triangle that is asked for with those of a group.
fn add_pairs(
    member: &Member,
    bounds: &Bounds,
    others: &Group,
    members: &[Member],
    pairs: &mut Vec<[u32; 2]>,
) {
    for (_, m) in others
        .members
        .iter()
        .filter(|(other, _)| other.intersects(bounds))
    {
        let other = &members[*m as usize];
        let is_elsewhere = other.is_asked && other.number <= member.number;
        if !is_elsewhere && intersect(&member.corners, &other.corners) {
            pairs.push([member.number.min(other.number), member.number.max(other.number)]);
        }
    }
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
