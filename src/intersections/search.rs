//! All pairs of triangles that intersect: a tree of boxes gives candidates, exact signs decide.

use super::height_field::is_height_field;
use super::member::{Bounds, Member, bounds_of, member};
use super::neighbours::neighbours;
use super::tree::{Content, Tree};
use super::triangles::{PROJECTIONS, facing};
use fairmesh_linear::dispatch::vectorized;
use fairmesh_linear::parallel;

/// Pairs of nodes that a thread takes at once.
/// Half or double, of 129 cases: none changes.
const CHUNK: usize = 64;
/// The search is done in so many parts, between which it can be stopped.
/// Half or double: none changes.
const PARTS: usize = 64;
/// The fractions of the progress at which the triangles are gathered, put in order, the tree is made, neighbours are found, and the search begins: shares of the
/// time, measured on a sheet of 980,000 triangles.
/// Half or double: only the progress changes.
const MEMBERS: f64 = 0.2;
const ORDERED: f64 = 0.5;
const TREE: f64 = 0.75;
const NEIGHBOURS: f64 = 0.95;
const SEARCHED: f64 = 0.96;

/// The triangles of a mesh, none of them asked for, that `is_near` takes.
pub(crate) fn members_near(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    is_near: impl Fn(&Bounds) -> bool + Sync,
) -> Vec<Member> {
    let near = |t| member(positions, triangles, t, false).filter(|m| is_near(&m.bounds()));
    members_of(triangles.len(), &near)
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
    told_of_some(positions, triangles, asked, most, &mut |_| ())
}

/// The same; see [`told_pairs`].
pub(crate) fn told_of_some(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    asked: &[u32],
    most: usize,
    tell: &mut dyn FnMut(f64),
) -> Vec<[u32; 2]> {
    let mut is_asked = vec![false; triangles.len()];
    asked.iter().for_each(|&t| is_asked[t as usize] = true);
    let region: Vec<Member> = asked
        .iter()
        .filter_map(|&t| member(positions, triangles, t, true))
        .collect();
    let bounds = bounds_of(&region);
    let sides: Vec<u8> =
        parallel::map_each(positions.len(), parallel::RUN, |v| sides(&positions[v], &bounds));
    let all_beside = |t: &[u32; 3]| {
        t.iter()
            .fold(u8::MAX, |all, &v| all & sides.get(v as usize).unwrap_or(&0))
            != 0
    };
    let near = |t: u32| {
        let of = &triangles[t as usize];
        (!all_beside(of)).then(|| member(positions, triangles, t, is_asked[t as usize]))?
    };
    told_pairs(members_of(triangles.len(), &near), most, tell)
}

/// Those that there are, of so many triangles.
fn members_of(triangles: usize, member: &(dyn Fn(u32) -> Option<Member> + Sync)) -> Vec<Member> {
    parallel::map(parallel::runs(triangles, parallel::RUN), |_, run| {
        run.filter_map(|t| member(t as u32)).collect::<Vec<_>>()
    })
    .concat()
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

/// The same of all triangles, and all pairs; see [`told_pairs`].
pub(crate) fn of_all(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    tell: &mut dyn FnMut(f64),
) -> Vec<[u32; 2]> {
    let mut members = members_near(positions, triangles, |_| true);
    members.iter_mut().for_each(|member| member.is_asked = true);
    told_pairs(members, usize::MAX, tell)
}

/// The same of any triangles with different numbers.
pub(crate) fn pairs(members: Vec<Member>, most: usize) -> Vec<[u32; 2]> {
    told_pairs(members, most, &mut |_| ())
}

/// The same, which tells how far it is, from 0 to 1.
fn told_pairs(mut members: Vec<Member>, most: usize, tell: &mut dyn FnMut(f64)) -> Vec<[u32; 2]> {
    tell(MEMBERS);
    let unit = unit(&members);
    parallel::for_each(members.chunks_mut(parallel::RUN), |_, run| {
        for member in run {
            // Positive zeros only: equal coordinates have equal bits.
            member
                .corners
                .iter_mut()
                .flatten()
                .for_each(|x| *x = *x * unit + 0.0);
            member.facing = facing(&member.corners);
        }
    });
    members.retain(|member| member.facing != 0);
    let tree = Tree::new(&mut members, || tell(ORDERED));
    let corners = members.iter().map(|member| &member.corners);
    let across = neighbours(corners, &mut |part| tell(TREE + (NEIGHBOURS - TREE) * part));
    let search = PairSearch {
        across,
        members,
        tree,
    };
    tell(NEIGHBOURS);
    let tasks = search.tasks();
    let mut pairs = Vec::new();
    let parts = tasks.chunks(CHUNK * tasks.len().div_ceil(CHUNK * PARTS).max(1));
    for (k, part) in parts.enumerate() {
        let found = parallel::map(part.chunks(CHUNK), |_, tasks| {
            vectorized(
                #[inline(always)]
                || search.pairs_of(tasks, most),
            )
        });
        pairs.extend(found.concat());
        tell(SEARCHED + (1.0 - SEARCHED) * (k + 1) as f64 / PARTS as f64);
    }
    pairs.sort_unstable();
    pairs.truncate(most);
    pairs
}

struct PairSearch {
    members: Vec<Member>,
    tree: Tree,
    /// Members at the edges of each.
    across: Vec<[u32; 3]>,
}

impl PairSearch {
    /// Pairs of nodes whose triangles are to be compared with each other; twice the same for those within a leaf.
    fn tasks(&self) -> Vec<[usize; 2]> {
        let mut tasks = Vec::new();
        let mut within = vec![0];
        while !within.is_empty() {
            let open = parallel::map_each(within.len(), 16, |k| self.is_open(within[k]));
            let before = std::mem::take(&mut within);
            for (n, _) in before.into_iter().zip(open).filter(|(_, open)| *open) {
                match self.tree.nodes[n].content {
                    Content::Leaf(_) => tasks.push([n, n]),
                    Content::Inner(second) => {
                        tasks.push([n + 1, second]);
                        within.extend([n + 1, second]);
                    }
                }
            }
        }
        tasks
    }

    /// Whether something within a node may intersect.
    fn is_open(&self, n: usize) -> bool {
        let node = &self.tree.nodes[n];
        if let Content::Leaf(_) = node.content {
            return node.is_asked;
        }
        let is_height_field = |axes: usize| {
            node.facing >> (2 * axes) & 3 != 0
                && is_height_field(
                    PROJECTIONS[axes],
                    |t| &self.members[t].corners,
                    &self.across,
                    node.run.clone(),
                )
        };
        node.is_asked && !(0..3).any(is_height_field)
    }

    #[inline(always)]
    fn pairs_of(&self, tasks: &[[usize; 2]], most: usize) -> Vec<[u32; 2]> {
        let (nodes, groups) = (&self.tree.nodes, &self.tree.groups);
        let mut pairs = Vec::new();
        let mut left = tasks.to_vec();
        while let Some([a, b]) = left.pop() {
            let [one, other] = [&nodes[a], &nodes[b]];
            if pairs.len() >= most {
                break;
            }
            if !(one.is_asked || other.is_asked) || !one.bounds.meets(&other.bounds) {
                continue;
            }
            match (one.content, other.content) {
                (Content::Leaf(g), Content::Leaf(_)) if a == b => {
                    groups[g].add_own_pairs(&self.members, &mut pairs);
                }
                (Content::Leaf(g), Content::Leaf(h)) => {
                    groups[g].add_pairs(&groups[h], &self.members, &mut pairs);
                }
                (Content::Inner(second), Content::Inner(_)) if one.run.len() >= other.run.len() => {
                    left.extend([[a + 1, b], [second, b]]);
                }
                (Content::Inner(second), Content::Leaf(_)) => left.extend([[a + 1, b], [second, b]]),
                (_, Content::Inner(second)) => left.extend([[a, b + 1], [a, second]]),
            }
        }
        pairs
    }
}

/// A power of two that brings the coordinates to about one: products of three neither overflow nor vanish.
fn unit(members: &[Member]) -> f64 {
    let coordinates = members.iter().flat_map(|m| m.corners.iter().flatten());
    let largest = coordinates.fold(0.0_f64, |largest, x| largest.max(x.abs()));
    if largest > 0.0 {
        libm::exp2((-libm::log2(largest).round()).clamp(-1000.0, 1000.0))
    } else {
        1.0
    }
}
