//! A crease inside the region: its curve, and the normals of the surface on both sides of it.

use nalgebra::Vector3;

use super::curve::{Curve, CurvePoint, between_points};
use crate::discrete::boundary_normals::angle;
use crate::fairing::sharp_edge::CreaseEnd;

/// A crease's curvature is off those at its ends by no more turn over its length, radians: it is none where something unseen is between them.
/// Half: one of 33 holes is no success; double: of 165 regions across edges of parts one more is a false success.
const VARIATION: f64 = 1.6;

/// Where a crease inside the region begins or ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Knot {
    /// At a boundary vertex.
    End(u32),
    /// At one of the corners that its group has.
    Corner(usize),
}

/// A crease that is to go on from a knot.
#[derive(Debug, Clone)]
pub(super) struct Arrival {
    pub(super) knot: Knot,
    /// With the tangent on its way into the region.
    pub(super) point: CurvePoint,
    pub(super) curvature: Vector3<f64>,
    /// How far it may be off.
    pub(super) curvature_error: f64,
    /// Unit normals left and right.
    pub(super) normals: [Vector3<f64>; 2],
    /// Between them, degrees; above 0 on a ridge.
    pub(super) angle: f64,
    /// The length of its last edge; 0 where it has none.
    pub(super) edge: f64,
}

impl Arrival {
    pub(super) fn of(end: &CreaseEnd, positions: &[[f64; 3]]) -> Self {
        Self {
            knot: Knot::End(end.vertex),
            point: CurvePoint {
                at: positions[end.vertex as usize].into(),
                tangent: end.direction.into(),
            },
            curvature: end.curvature.into(),
            curvature_error: end.curvature_error,
            normals: end.normals.map(Into::into),
            angle: end.angle,
            edge: last_edge(end, positions),
        }
    }
}

/// The mean length of the edges with which its chains start.
fn last_edge(end: &CreaseEnd, positions: &[[f64; 3]]) -> f64 {
    let at = |v: u32| Vector3::from(positions[v as usize]);
    let lengths = end
        .chains
        .iter()
        .map(|chain| (at(chain[1]) - at(chain[0])).norm());
    lengths.sum::<f64>() / end.chains.len().max(1) as f64
}

/// The unit tangent of the crease between planes with unit normals left and right of it, which leads about there, and its angle, degrees.
pub(super) fn between_planes(
    [left, right]: &[Vector3<f64>; 2],
    way: &Vector3<f64>,
) -> Option<(Vector3<f64>, f64)> {
    let along = left.cross(right).try_normalize(0.1)?;
    let ridge = along.dot(way).signum();
    Some((along * ridge, angle(left, right).to_degrees() * ridge))
}

/// A crease from one knot to another.
#[derive(Debug, Clone)]
pub(crate) struct Branch {
    pub(crate) from: Knot,
    pub(crate) to: Knot,
    pub(super) curve: Curve,
    /// Unit normals left and right of it, at the points of the curve.
    normals: [Vec<Vector3<f64>>; 2],
    /// The lengths of the last edges of what arrives at its ends.
    pub(super) edges: [f64; 2],
}

impl Branch {
    /// A fixed vertex this near to a crease (in edges) is on it.
    /// At 0.1, of 224 regions across edges of parts eleven change and one more is good, but another one follows a vertex that is beside its edge: a
    /// boundary that was smooth gets a kink of 72 degrees, and nothing tells of it. Half:
    /// six change, none of those that are good.
    pub(crate) const ON: f64 = 0.04;

    /// From knot to knot; `None` where no curve leads there.
    pub(super) fn between([start, end]: [&Arrival; 2]) -> Option<Self> {
        let last = CurvePoint {
            tangent: -end.point.tangent,
            ..end.point
        };
        let curve = Curve::between(start.point, last)?;
        // What is left at one end is right at the other.
        let [left, right] = [start.normals, end.normals];
        let normals = [curve.carried(left[0], right[1]), curve.carried(left[1], right[0])];
        Some(Self {
            from: start.knot,
            to: end.knot,
            curve,
            normals,
            edges: [start.edge, end.edge],
        })
    }

    /// From a knot along a circle to a corner, whose normals there are not known yet.
    pub(super) fn towards(start: &Arrival, corner: usize, at: Vector3<f64>) -> Option<Self> {
        let curve = Curve::arc(start.point, at)?;
        Some(Self {
            from: start.knot,
            to: Knot::Corner(corner),
            normals: start.normals.map(|n| curve.transported(n)),
            curve,
            edges: [start.edge; 2],
        })
    }

    /// To another corner of the group.
    pub(super) fn ending_at(mut self, corner: usize) -> Self {
        self.to = Knot::Corner(corner);
        self
    }

    /// With these normals at its last point.
    pub(super) fn ending_in(mut self, normals: [Vector3<f64>; 2]) -> Self {
        for (own, to) in self.normals.iter_mut().zip(normals) {
            *own = self.curve.carried(own[0], to);
        }
        self
    }

    /// How far the curvature of the curve is off those at its ends, as turns over its length, squared and summed; `None` where one is certainly off by
    /// too much.
    pub(super) fn variation(&self, arrivals: &[&Arrival]) -> Option<f64> {
        if self.curve.length == 0.0 {
            return Some(0.0);
        }
        let own = self.curve.curvatures();
        let mut sum = 0.0;
        for (own, arrival) in own.iter().zip(arrivals) {
            let off = (own - arrival.curvature).norm();
            if (off - arrival.curvature_error) * self.curve.length > VARIATION {
                return None;
            }
            sum += (off * self.curve.length).powi(2);
        }
        Some(sum)
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
