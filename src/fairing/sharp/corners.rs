//! Corners in which creases meet inside a region: three or more of them, or two and one that leads from there to another such corner.

use nalgebra::{Matrix3, Vector3};

use super::branch::{Arrival, Branch, Knot, between_planes};
use super::curve::{Curve, CurvePoint};
use super::group::{Group, UNLIKE};
use crate::discrete::boundary_normals::angle;
use crate::fairing::options::Options;

/// The planes of two creases at a corner are off those that arrive by no more, degrees.
/// Half: of 66 regions across edges of parts one more false success; double: none changes.
const ASKEW: f64 = 30.0;
/// So often the corner is looked for, each time with the tangents at the points nearest to it.
/// Half or double, of 60 parts: none changes.
const APPROACHES: usize = 8;

/// A corner this near to one of its ends, of the sum of its distances from all, is there. Half: of 165 regions across edges of parts one fewer is good;
/// double: none changes.
const AT: f64 = 0.04;

/// Creases that run to a point. Between two that are neighbours lies one side of the corner, which has one plane there.
pub(super) fn corner(arrivals: &[Arrival], of: &[usize]) -> Option<Group> {
    let own: Vec<&Arrival> = of.iter().map(|&e| &arrivals[e]).collect();
    let (branches, mut cost) = meeting(&own)?;
    let mut normals = vec![[None; 2]; of.len()];
    for i in 0..of.len() {
        let others = (0..of.len()).filter(|&j| j != i);
        let sides = others.map(|j| (j, Side::of([&branches[i], &branches[j]])));
        let (j, side) = sides.min_by(|a, b| a.1.apart.total_cmp(&b.1.apart))?;
        if side.askew > ASKEW.to_radians() || normals[j][1].is_some() {
            return None;
        }
        cost += side.askew * side.askew;
        (normals[i][0], normals[j][1]) = (Some(side.plane), Some(side.plane));
    }
    let ending = branches.into_iter().zip(normals);
    let branches = ending.map(|(branch, normals)| Some(branch.ending_in([normals[0]?, normals[1]?])));
    Some(Group {
        ends: of.to_vec(),
        branches: branches.collect::<Option<_>>()?,
        cost,
    })
}

/// Two creases that run to a point, from which a third goes on.
pub(super) struct HalfCorner {
    ends: [usize; 2],
    /// In this order they have the side left of the first one and right of the second one in common.
    branches: [Branch; 2],
    plane: Vector3<f64>,
    at: Vector3<f64>,
    cost: f64,
}

/// The corner of two creases, where their other sides meet at an angle.
pub(super) fn half_corner(arrivals: &[Arrival], ends: [usize; 2]) -> Option<HalfCorner> {
    let (branches, cost) = meeting(&ends.map(|e| &arrivals[e]))?;
    let [first, second] = <[Branch; 2]>::try_from(branches).ok()?;
    let [forward, backward] = [Side::of([&first, &second]), Side::of([&second, &first])];
    let (ends, branches, side) = if forward.apart <= backward.apart {
        (ends, [first, second], forward)
    } else {
        ([ends[1], ends[0]], [second, first], backward)
    };
    let half = HalfCorner {
        ends,
        at: branches[0].curve.at(1.0).at,
        branches,
        plane: side.plane,
        cost: cost + side.askew * side.askew,
    };
    let [left, right] = half.beside();
    let is_creased = angle(&left, &right) >= Options::SHARP_AUTO.to_radians();
    (side.askew <= ASKEW.to_radians() && is_creased).then_some(half)
}

impl HalfCorner {
    /// Normals left and right of the third crease, from the corner on.
    fn beside(&self) -> [Vector3<f64>; 2] {
        let [first, second] = &self.branches;
        [second.normals(1.0)[0], first.normals(1.0)[1]]
    }

    /// The third crease, which leads about where `to` is.
    fn third(&self, corner: usize, to: &Vector3<f64>) -> Option<Arrival> {
        let way = (to - self.at).try_normalize(0.0)?;
        let [left, right] = self.beside();
        let (tangent, bend) = between_planes(&[left, right], &way)?;
        (angle(&tangent, &way) <= UNLIKE.to_radians()).then(|| Arrival {
            knot: Knot::Corner(corner),
            point: CurvePoint { at: self.at, tangent },
            curvature: Vector3::zeros(),
            curvature_error: f64::INFINITY,
            normals: [left, right],
            angle: bend,
            edge: 0.0,
        })
    }

    /// Its creases to this corner, where the third one starts, with the planes left and right of it.
    fn with_third(&self, corner: usize, third: &mut Arrival) -> [Branch; 2] {
        let plane = |branch: &Branch, beside: Vector3<f64>| {
            let plane = branch.curve.at(1.0).tangent.cross(&third.point.tangent);
            let plane = plane.try_normalize(0.1).unwrap_or(beside);
            plane * plane.dot(&beside).signum()
        };
        let [first, second] = self.branches.clone();
        let planes = [plane(&second, third.normals[0]), plane(&first, third.normals[1])];
        third.normals = planes;
        let ending = [
            first.ending_in([self.plane, planes[1]]),
            second.ending_in([planes[0], self.plane]),
        ];
        ending.map(|branch| branch.ending_at(corner))
    }
}

/// Two corners and the crease between them.
pub(super) fn two_corners(a: &HalfCorner, b: &HalfCorner) -> Option<Group> {
    if a.ends.iter().any(|end| b.ends.contains(end)) {
        return None;
    }
    let [mut first, mut second] = [a.third(0, &b.at)?, b.third(1, &a.at)?];
    let unlike = (first.angle - second.angle).abs();
    if unlike > UNLIKE {
        return None;
    }
    let of_ends = [a.with_third(0, &mut first), b.with_third(1, &mut second)];
    let between = Branch::between([&first, &second])?;
    let bend = 0.5 * (first.angle + second.angle).to_radians();
    Some(Group {
        ends: [a.ends, b.ends].concat(),
        cost: a.cost + b.cost + between.curve.bending() + bend * bend + unlike.to_radians().powi(2),
        branches: of_ends.into_iter().flatten().chain([between]).collect(),
    })
}

/// What lies left of one crease and right of another at their corner.
struct Side {
    plane: Vector3<f64>,
    /// How far the normals that arrive are from each other, and at most from the plane, radians.
    apart: f64,
    askew: f64,
}

impl Side {
    fn of([first, second]: [&Branch; 2]) -> Self {
        let [left, right] = [first.normals(1.0)[0], second.normals(1.0)[1]];
        let [t, u] = [first, second].map(|branch| branch.curve.at(1.0).tangent);
        let mean = (left + right).try_normalize(1e-9).unwrap_or(left);
        let plane = t.cross(&u).try_normalize(0.1).unwrap_or(mean);
        let plane = plane * plane.dot(&mean).signum();
        Self {
            plane,
            apart: angle(&left, &right),
            askew: angle(&plane, &left).max(angle(&plane, &right)),
        }
    }
}

/// Whether creases run to a point.
pub(super) fn is_meeting(arrivals: &[Arrival], of: &[usize]) -> bool {
    let own: Vec<&Arrival> = of.iter().map(|&e| &arrivals[e]).collect();
    meeting(&own).is_some()
}

/// Creases to the point where they meet, and how much their curvatures vary.
fn meeting(arrivals: &[&Arrival]) -> Option<(Vec<Branch>, f64)> {
    let at = meeting_point(arrivals)?;
    let branches = arrivals.iter().map(|arrival| Branch::towards(arrival, 0, at));
    let branches = branches.collect::<Option<Vec<Branch>>>()?;
    let costs = branches.iter().zip(arrivals);
    let costs = costs.map(|(branch, arrival)| branch.variation(&[arrival]));
    let cost = costs.sum::<Option<f64>>()?;
    Some((branches, cost))
}

/// The point nearest to creases that go on with their curvatures, if it lies before all of them.
fn meeting_point(arrivals: &[&Arrival]) -> Option<Vector3<f64>> {
    let mut lines: Vec<CurvePoint> = arrivals.iter().map(|arrival| arrival.point).collect();
    for _ in 0..APPROACHES {
        let point = nearest_point(&lines)?;
        for (line, arrival) in lines.iter_mut().zip(arrivals) {
            let way = (point - arrival.point.at).norm();
            let curve = Curve::with_curvature(arrival.point, arrival.curvature, 1.5 * way);
            *line = curve.at(curve.nearest(&point).0);
        }
    }
    let point = at_an_end(nearest_point(&lines)?, arrivals);
    let is_before = |arrival: &&Arrival| {
        let to = point - arrival.point.at;
        let bend = arrival.curvature.norm() * to.norm();
        angle(&arrival.point.tangent, &to) < ASKEW.to_radians() + 0.5 * bend
    };
    arrivals.iter().all(is_before).then_some(point)
}

/// The end that this point is at, or itself: a crease may run along the boundary into the corner.
fn at_an_end(point: Vector3<f64>, arrivals: &[&Arrival]) -> Vector3<f64> {
    let off = |arrival: &&Arrival| (arrival.point.at - point).norm();
    let sum: f64 = arrivals.iter().map(off).sum();
    let is_at = |arrival: &&&Arrival| off(arrival) < AT * sum;
    arrivals
        .iter()
        .find(is_at)
        .map_or(point, |arrival| arrival.point.at)
}

/// The point nearest to lines.
fn nearest_point(lines: &[CurvePoint]) -> Option<Vector3<f64>> {
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for line in lines {
        let across = Matrix3::identity() - line.tangent * line.tangent.transpose();
        matrix += across;
        right += across * line.at;
    }
    Some(matrix.cholesky()?.solve(&right))
}
