//! Neighbouring triangles in groups, the leaves of the tree: what is left to compare is compared at once.

use std::ops::Range;

use super::member::Member;
use super::triangles::intersect;

/// Triangles in a group, at most.
pub(super) const SIZE: usize = 8;

/// Neighbouring triangles.
pub(super) struct TriangleGroup {
    run: Range<usize>,
    boxes: Boxes,
    /// A bit for each triangle that is asked for.
    asked: u8,
}

/// An upright box in single precision, rounded outwards: its lower and its upper sides.
#[derive(Clone, Copy)]
pub(super) struct Box32([[f32; 3]; 2]);

impl Box32 {
    /// Meets nothing.
    pub(super) const EMPTY: Self = Self([[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]]);

    /// The box around two.
    pub(super) fn with(&self, other: &Self) -> Self {
        let ([a, b], [c, d]) = (self.0, other.0);
        Self([
            [0, 1, 2].map(|k| a[k].min(c[k])),
            [0, 1, 2].map(|k| b[k].max(d[k])),
        ])
    }

    /// Whether they have a point in common.
    #[inline(always)]
    pub(super) fn meets(&self, other: &Self) -> bool {
        (0..3).all(|k| self.0[0][k] <= other.0[1][k] && other.0[0][k] <= self.0[1][k])
    }
}

/// Boxes around the triangles of a group, relative to a centre and rounded outwards: per axis all their lower, then all their upper sides. Differences from
/// a centre are rounded, too, but what meets still does: rounding keeps the order of numbers.
struct Boxes([[[f32; SIZE]; 2]; 3]);

impl Boxes {
    fn new(members: &[Member], centre: &[f64; 3]) -> Self {
        // Nothing is in a box that is not there.
        let mut boxes = [[[f32::INFINITY; SIZE], [f32::NEG_INFINITY; SIZE]]; 3];
        for (m, member) in members.iter().enumerate() {
            for (axis, [low, high]) in boxes.iter_mut().enumerate() {
                let [a, b, c] = member.corners.map(|corner| corner[axis] - centre[axis]);
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

impl TriangleGroup {
    /// A run of the members, with boxes relative to this centre.
    pub(super) fn new(members: &[Member], run: Range<usize>, centre: &[f64; 3]) -> Self {
        let own = &members[run.clone()];
        let bits = (0..).zip(own).map(|(m, member)| u8::from(member.is_asked) << m);
        Self {
            asked: bits.fold(0, |bits, bit| bits | bit),
            boxes: Boxes::new(own, centre),
            run,
        }
    }

    pub(super) fn has_asked(&self) -> bool {
        self.asked != 0
    }

    /// The box around them.
    pub(super) fn bounds(&self) -> Box32 {
        let sides = self.boxes.0;
        Box32([
            sides.map(|[low, _]| low.into_iter().fold(f32::INFINITY, f32::min)),
            sides.map(|[_, high]| high.into_iter().fold(f32::NEG_INFINITY, f32::max)),
        ])
    }

    /// The pairs of its triangles with those of another group.
    #[inline(always)]
    pub(super) fn add_pairs(&self, other: &Self, members: &[Member], pairs: &mut Vec<[u32; 2]>) {
        for m in 0..self.run.len() {
            self.add_pairs_of(m, other, u8::MAX, members, pairs);
        }
    }

    /// The pairs within.
    #[inline(always)]
    pub(super) fn add_own_pairs(&self, members: &[Member], pairs: &mut Vec<[u32; 2]>) {
        for m in 1..self.run.len() {
            self.add_pairs_of(m, self, u8::MAX >> (SIZE - m), members, pairs);
        }
    }

    /// The pairs of one triangle with those of a group whose bits are set; of each pair one is asked for.
    #[inline(always)]
    fn add_pairs_of(&self, m: usize, other: &Self, among: u8, members: &[Member], pairs: &mut Vec<[u32; 2]>) {
        let member = &members[self.run.start + m];
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
            let found = &members[other.run.start + left.trailing_zeros() as usize];
            left &= left - 1;
            if intersect(&member.corners, &found.corners) {
                pairs.push([member.number.min(found.number), member.number.max(found.number)]);
            }
        }
    }
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
