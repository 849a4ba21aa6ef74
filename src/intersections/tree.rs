//! A binary tree of boxes: triangles in the order of a space-filling curve (Morton 1966), halved where the highest bit of their
//! places on it changes, so that a node is what of the surface lies in a cell of space.

use std::ops::Range;

use fairmesh_linear::interrupt::checkpoint;
use fairmesh_linear::parallel;
use rayon::prelude::*;
use rstar::Envelope;

use super::groups::{Box32, SIZE, TriangleGroup};
use super::member::{Member, bounds_of};

/// Bits of a place on the curve for each axis.
const BITS: u32 = 21;

/// What of the surface lies in a cell.
pub(super) struct Node {
    /// Its triangles.
    pub(super) run: Range<usize>,
    pub(super) bounds: Box32,
    /// Whether one of its triangles is asked for.
    pub(super) is_asked: bool,
    /// The sides of coordinate planes that all of its triangles show: see [`Member::facing`].
    pub(super) facing: u8,
    pub(super) content: Content,
}

#[derive(Clone, Copy)]
pub(super) enum Content {
    /// Its place in the list of groups.
    Leaf(usize),
    /// Two nodes: the one that follows in the list, and this one.
    Inner(usize),
}

/// The first node has all triangles.
pub(super) struct Tree {
    pub(super) nodes: Vec<Node>,
    pub(super) groups: Vec<TriangleGroup>,
}

impl Tree {
    /// Puts the members in order, and tells when that is done.
    pub(super) fn new(members: &mut Vec<Member>, ordered: impl FnOnce()) -> Self {
        let mut places = places(members);
        places.par_sort_unstable();
        *members = places.iter().map(|&(_, m)| members[m as usize].clone()).collect();
        ordered();
        let mut tree = Self {
            nodes: Vec::with_capacity(members.len()),
            groups: Vec::with_capacity(members.len() / 2),
        };
        tree.divide(members, &places);
        tree.enclose();
        tree
    }

    /// Makes the nodes, each before what is in it.
    fn divide(&mut self, members: &[Member], places: &[(u64, u32)]) {
        let centre = centre(members);
        // Runs that are left, each with the node that it is the second half of.
        let mut left = vec![(0..members.len(), None)];
        while let Some((run, parent)) = left.pop() {
            checkpoint();
            let own = self.nodes.len();
            if let Some(parent) = parent {
                let parent: &mut Node = &mut self.nodes[parent];
                parent.content = Content::Inner(own);
            }
            if run.len() <= SIZE {
                let group = TriangleGroup::new(members, run.clone(), &centre);
                self.nodes.push(Node {
                    bounds: group.bounds(),
                    is_asked: group.has_asked(),
                    facing: members[run.clone()].iter().fold(u8::MAX, |all, m| all & m.facing),
                    content: Content::Leaf(self.groups.len()),
                    run,
                });
                self.groups.push(group);
            } else {
                let middle = run.start + first_half(&places[run.clone()]);
                left.push((middle..run.end, Some(own)));
                left.push((run.start..middle, None));
                self.nodes.push(Node {
                    run,
                    bounds: Box32::EMPTY,
                    is_asked: false,
                    facing: u8::MAX,
                    content: Content::Inner(own),
                });
            }
        }
    }

    /// Gives each node what its halves have.
    fn enclose(&mut self) {
        for n in (0..self.nodes.len()).rev() {
            if let Content::Inner(second) = self.nodes[n].content {
                let [a, b] = [&self.nodes[n + 1], &self.nodes[second]];
                let bounds = a.bounds.with(&b.bounds);
                let (is_asked, facing) = (a.is_asked || b.is_asked, a.facing & b.facing);
                let node = &mut self.nodes[n];
                (node.bounds, node.is_asked, node.facing) = (bounds, is_asked, facing);
            }
        }
    }
}

/// The middle one of all first corners, in each coordinate: where most triangles are, and single precision is finest there, however far away a few of
/// them are.
fn centre(members: &[Member]) -> [f64; 3] {
    [0, 1, 2].map(|axis| {
        let mut all: Vec<f64> = members.iter().map(|member| member.corners[0][axis]).collect();
        let middle = all.len() / 2;
        match all.is_empty() {
            true => 0.0,
            false => *all.select_nth_unstable_by(middle, f64::total_cmp).1,
        }
    })
}

/// How many of a sorted run are in its first half: those before the highest bit changes.
fn first_half(places: &[(u64, u32)]) -> usize {
    let changed = places[0].0 ^ places[places.len() - 1].0;
    match changed.checked_ilog2() {
        Some(bit) => places.partition_point(|(place, _)| place >> bit & 1 == 0),
        None => places.len() / 2,
    }
}

/// Where the centres lie on the curve, each with the number of its member.
fn places(members: &[Member]) -> Vec<(u64, u32)> {
    let bounds = bounds_of(members);
    let (low, high) = (bounds.lower(), bounds.upper());
    let side = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
    let cells = f64::from(1 << BITS) / side.max(f64::MIN_POSITIVE);
    let place = |(m, member): (usize, &Member)| {
        let centre = member.bounds().center();
        let bits = (0..3).fold(0, |bits, axis| {
            // The cast keeps to the range.
            let cell = ((centre[axis] - low[axis]) * cells) as u64;
            bits | spread(cell.min((1 << BITS) - 1)) << axis
        });
        (bits, m as u32)
    };
    parallel::map_each(members.len(), parallel::RUN, |m| place((m, &members[m])))
}

/// The bits of a number, each followed by two that are zero.
fn spread(cell: u64) -> u64 {
    const STEPS: [(u32, u64); 5] = [
        (32, 0x001f_0000_0000_ffff),
        (16, 0x001f_0000_ff00_00ff),
        (8, 0x100f_00f0_0f00_f00f),
        (4, 0x10c3_0c30_c30c_30c3),
        (2, 0x1249_2492_4924_9249),
    ];
    STEPS
        .iter()
        .fold(cell, |bits, (shift, mask)| (bits | bits << shift) & mask)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::intersections::member;

    /// Triangles side by side, and one that is a thousand million times as far away.
    #[test]
    fn boxes_tell_triangles_apart_however_far_one_is() {
        let row = |k: u32| 1.0 + f64::from(k) * 2e-9;
        let corners = |x: f64| [[x, 1.0, 0.0], [x + 1e-9, 1.0, 0.0], [x, 1.0 + 1e-9, 0.0]];
        let positions: Vec<[f64; 3]> = (0..256).map(row).chain([-1.0]).flat_map(corners).collect();
        let triangles: Vec<[u32; 3]> = (0..257).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        let all = (0..257).map(|k| member(&positions, &triangles, k, true).unwrap());
        let tree = Tree::new(&mut all.collect(), || ());
        let leaves: Vec<&Node> = tree
            .nodes
            .iter()
            .filter(|node| matches!(node.content, Content::Leaf(_)))
            .collect();
        assert!(leaves.len() > 32);
        for (k, leaf) in leaves.iter().enumerate() {
            let met = leaves
                .iter()
                .filter(|other| other.bounds.meets(&leaf.bounds))
                .count();
            assert_eq!(met, 1, "{k}");
        }
    }

    #[test]
    fn every_bit_finds_its_place() {
        for bit in 0..BITS {
            assert_eq!(spread(1 << bit), 1 << (3 * bit), "{bit}");
        }
        assert_eq!(spread((1 << BITS) - 1), 0x1249_2492_4924_9249);
    }
}
