//! Neighbouring triangles in groups, which the tree knows by their box alone: it is eight times as small, and what is left to
//! compare is compared at once.

use rstar::Envelope;
use rstar::primitives::Rectangle;

use super::search::{Bounds, Member};
use super::triangles::intersect;

/// Triangles in a group, at most.
const SIZE: usize = 8;

/// Neighbouring triangles.
pub(super) struct Group {
    pub(super) bounds: Bounds,
    members: Vec<Member>,
    boxes: Boxes,
    /// A bit for each triangle that is asked for.
    asked: u8,
}

/// Boxes around the triangles of a group, rounded outwards: per axis all their lower, then all their upper sides.
struct Boxes([[[f32; SIZE]; 2]; 3]);

impl Boxes {
    fn new(members: &[Member]) -> Self {
        // Nothing is in a box that is not there.
        let mut boxes = [[[f32::INFINITY; SIZE], [f32::NEG_INFINITY; SIZE]]; 3];
        for (m, member) in members.iter().enumerate() {
            for (axis, [low, high]) in boxes.iter_mut().enumerate() {
                let [a, b, c] = member.corners.map(|corner| corner[axis]);
                low[m] = not_above(a.min(b).min(c));
                high[m] = -not_above(-a.max(b).max(c));
            }
        }
        Self(boxes)
    }

    /// A bit for each box that has a point in common with box `m` of others.
    #[inline(always)]
    fn met_by(&self, others: &Self, m: usize) -> u8 {
        let mut meets = [true; SIZE];
        for ([low, high], [low_m, high_m]) in self.0.iter().zip(&others.0) {
            for k in 0..SIZE {
                meets[k] &= low[k] <= high_m[m] && low_m[m] <= high[k];
            }
        }
        (0..SIZE).fold(0, |bits, k| bits | u8::from(meets[k]) << k)
    }
}

/// The number in 32 bits, or one below.
fn not_above(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) > x {
        near.next_down()
    } else {
        near
    }
}

impl Group {
    fn new(members: Vec<Member>) -> Self {
        let mut bounds = Bounds::new_empty();
        members.iter().for_each(|member| bounds.merge(&member.bounds()));
        let bits = (0..)
            .zip(&members)
            .map(|(m, member)| u8::from(member.is_asked) << m);
        Self {
            bounds,
            asked: bits.fold(0, |bits, bit| bits | bit),
            boxes: Boxes::new(&members),
            members,
        }
    }

    pub(super) fn has_asked(&self) -> bool {
        self.asked != 0
    }

    /// Its box as the tree keeps it.
    pub(super) fn rectangle(&self) -> Rectangle<[f64; 3]> {
        Rectangle::from_aabb(self.bounds)
    }

    /// The pairs of its triangles with those of another group.
    #[inline(always)]
    pub(super) fn add_pairs(&self, other: &Self, pairs: &mut Vec<[u32; 2]>) {
        for m in 0..self.members.len() {
            self.add_pairs_of(m, other, u8::MAX, pairs);
        }
    }

    /// The pairs within.
    #[inline(always)]
    pub(super) fn add_own_pairs(&self, pairs: &mut Vec<[u32; 2]>) {
        for m in 1..self.members.len() {
            self.add_pairs_of(m, self, u8::MAX >> (SIZE - m), pairs);
        }
    }

    /// The pairs of one triangle with those of a group whose bits are set; of each pair one is asked for.
    #[inline(always)]
    fn add_pairs_of(&self, m: usize, other: &Self, among: u8, pairs: &mut Vec<[u32; 2]>) {
        let member = &self.members[m];
        let among = if member.is_asked {
            among
        } else {
            among & other.asked
        };
        if among == 0 {
            return;
        }
        let mut left = among & other.boxes.met_by(&self.boxes, m);
        while left != 0 {
            let found = &other.members[left.trailing_zeros() as usize];
            left &= left - 1;
            if intersect(&member.corners, &found.corners) {
                pairs.push([member.number.min(found.number), member.number.max(found.number)]);
            }
        }
    }
}

/// The middle of a triangle's box, and the triangle's place in the list.
type Centred = ([f64; 3], u32);

/// All triangles in groups, halved again and again across the longest side of the box around their centres.
pub(super) fn groups(members: Vec<Member>) -> Vec<Group> {
    let centred = |(m, member): (u32, &Member)| (member.bounds().center(), m);
    let mut all: Vec<Centred> = (0..).zip(&members).map(centred).collect();
    let mut runs = vec![&mut all[..]];
    let mut groups = Vec::with_capacity(members.len().div_ceil(SIZE / 2));
    while let Some(run) = runs.pop() {
        if run.len() > SIZE {
            let axis = longest_side(run);
            let middle = run.len() / 2;
            run.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]));
            let (low, high) = run.split_at_mut(middle);
            runs.extend([low, high]);
        } else if !run.is_empty() {
            let own = run.iter().map(|(_, m)| members[*m as usize].clone());
            groups.push(Group::new(own.collect()));
        }
    }
    groups
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_in_single_precision_hold_what_those_in_double_hold() {
        for x in [
            0.0,
            -0.0,
            0.1,
            -0.1,
            1.0 / 3.0,
            1.0 + 1e-16,
            1e-300,
            -1e-300,
            5e-324,
            -5e-324,
        ] {
            let (below, above) = (not_above(x), -not_above(-x));
            assert!(f64::from(below) <= x && x <= f64::from(above), "{x}");
            assert!(
                above - below <= f32::EPSILON * below.abs().max(f32::MIN_POSITIVE),
                "{x}"
            );
        }
    }
}
