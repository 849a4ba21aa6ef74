//! A crease inside the region: its curve, and the normals of the surface on both sides of it.

use nalgebra::Vector3;

use super::curve::{Curve, CurvePoint, between_points};
use crate::fairing::sharp_edge::CreaseEnd;

/// A crease from one of the ends to another, or to a corner.
#[derive(Debug, Clone)]
pub(crate) struct Branch {
    /// The boundary vertex that it comes from.
    pub(crate) from: u32,
    /// The boundary vertex that it runs to; none: the corner.
    pub(crate) to: Option<u32>,
    pub(super) curve: Curve,
    /// Unit normals left and right of it, at the points of the curve.
    normals: [Vec<Vector3<f64>>; 2],
}

/// Where a crease arrives, on the way into the region.
pub(super) fn inward(end: &CreaseEnd, positions: &[[f64; 3]]) -> CurvePoint {
    CurvePoint {
        at: positions[end.vertex as usize].into(),
        tangent: end.direction.into(),
    }
}

impl Branch {
    /// A fixed vertex this near to a crease (in edges) is on it.
    pub(crate) const ON: f64 = 0.1;

    /// From end to end; `None` where no curve leads there.
    pub(super) fn between(ends: [&CreaseEnd; 2], positions: &[[f64; 3]]) -> Option<Self> {
        let [start, mut last] = ends.map(|end| inward(end, positions));
        last.tangent = -last.tangent;
        let curve = Curve::between(start, last)?;
        // What is left at one end is right at the other.
        let [left, right] = ends.map(|end| end.normals.map(Vector3::from));
        let normals = [curve.carried(left[0], right[1]), curve.carried(left[1], right[0])];
        Some(Self {
            from: ends[0].vertex,
            to: Some(ends[1].vertex),
            curve,
            normals,
        })
    }

    /// From an end along a circle to a corner, whose normals there are not known yet.
    pub(super) fn towards(end: &CreaseEnd, corner: Vector3<f64>, positions: &[[f64; 3]]) -> Option<Self> {
        let curve = Curve::arc(inward(end, positions), corner)?;
        Some(Self {
            from: end.vertex,
            to: None,
            normals: end.normals.map(|n| curve.transported(n.into())),
            curve,
        })
    }

    /// With these normals at its last point.
    pub(super) fn ending_in(mut self, normals: [Vector3<f64>; 2]) -> Self {
        for (own, to) in self.normals.iter_mut().zip(normals) {
            *own = self.curve.carried(own[0], to);
        }
        self
    }

    pub(crate) fn length(&self) -> f64 {
        self.curve.length
    }

    /// The point at this part of the length.
    pub(crate) fn at(&self, part: f64) -> Vector3<f64> {
        self.curve.at(part).at
    }

    /// Which part of the length is before a vertex that is on the crease, where edges are about so long; none off it.
    pub(crate) fn part_of(&self, x: &Vector3<f64>, edge: f64) -> Option<f64> {
        let (part, off) = self.curve.nearest(x);
        (off < Self::ON * edge).then_some(part)
    }

    /// The normals left and right at this part of the length.
    pub(crate) fn normals(&self, part: f64) -> [Vector3<f64>; 2] {
        [0, 1].map(|side| between_points(&self.normals[side], part))
    }

    /// The points of the curve, and the directions across it in the surface that is midway between both sides.
    pub(super) fn across(&self) -> Vec<(Vector3<f64>, Vector3<f64>)> {
        let [left, right] = &self.normals;
        let points = self.curve.points().into_iter().zip(left.iter().zip(right));
        let across = points.map(|(point, (left, right))| {
            let across = point.tangent.cross(&(left + right));
            (point.at, across.try_normalize(1e-9).unwrap_or_default())
        });
        across.collect()
    }
}
