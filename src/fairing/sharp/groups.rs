//! Which ends of creases belong together: pairs, corners of three, and those that fit nothing.
//!
//! All ways to group them are looked at, and the one is taken whose curves bend least, where an end alone costs as much as a curve that turns
//! by about 200 degrees. Who fits whom is asked of convexity and angles, too.

use nalgebra::{Matrix3, Vector3};

use super::branch::{Branch, inward};
use super::curve::{Curve, CurvePoint};
use crate::discrete::boundary_normals::angle;
use crate::fairing::sharp_edge::CreaseEnd;

/// What an end alone costs, in squares of radians.
/// Half: of 60 parts 1 changes; double: none changes.
const ALONE: f64 = 6.0;
/// The angles at both ends of a crease differ by no more than this, degrees.
const UNLIKE: f64 = 45.0;
/// No crease turns by more, as the root of its mean square in radians.
const WINDING: f64 = 3.5;
/// The planes of two creases at a corner are off those that arrive by no more, degrees.
const ASKEW: f64 = 30.0;
/// So often the corner is looked for, each time with the tangents at the points nearest to it.
/// Half or double, of 60 parts: none changes.
const APPROACHES: usize = 8;
/// More ends are not grouped: there are thousands of ways.
const MOST: usize = 8;

/// Ends that belong together, and the creases between them: one, or three to a corner; none of an end alone.
#[derive(Debug, Clone)]
pub(super) struct Group {
    pub(super) ends: Vec<usize>,
    pub(super) branches: Vec<Branch>,
    cost: f64,
}

/// The ends, each in one group.
pub(super) fn grouped(ends: &[CreaseEnd], positions: &[[f64; 3]]) -> Vec<Group> {
    let mut candidates: Vec<Group> = (0..ends.len()).map(alone).collect();
    if ends.len() > MOST {
        return candidates;
    }
    for i in 0..ends.len() {
        for j in i + 1..ends.len() {
            candidates.extend(pair(ends, [i, j], positions));
            candidates.extend((j + 1..ends.len()).filter_map(|k| corner(ends, [i, j, k], positions)));
        }
    }
    let best = cheapest(&candidates, &mut vec![false; ends.len()]);
    best.1.into_iter().map(|g| candidates[g].clone()).collect()
}

/// The least cost of groups for the ends that are left, and these groups.
fn cheapest(candidates: &[Group], taken: &mut Vec<bool>) -> (f64, Vec<usize>) {
    let Some(first) = taken.iter().position(|taken| !taken) else {
        return (0.0, Vec::new());
    };
    let mut best = (f64::INFINITY, Vec::new());
    for (g, group) in candidates.iter().enumerate() {
        let fits = group.ends[0] == first && group.ends.iter().all(|&e| !taken[e]);
        if !fits {
            continue;
        }
        group.ends.iter().for_each(|&e| taken[e] = true);
        let (cost, mut groups) = cheapest(candidates, taken);
        group.ends.iter().for_each(|&e| taken[e] = false);
        if cost + group.cost < best.0 {
            groups.push(g);
            best = (cost + group.cost, groups);
        }
    }
    best
}

fn alone(end: usize) -> Group {
    Group {
        ends: vec![end],
        branches: Vec::new(),
        cost: ALONE,
    }
}

fn pair(ends: &[CreaseEnd], [i, j]: [usize; 2], positions: &[[f64; 3]]) -> Option<Group> {
    let unlike = (ends[i].angle - ends[j].angle).abs();
    if unlike > UNLIKE {
        return None;
    }
    let branch = Branch::between([&ends[i], &ends[j]], positions)?;
    let bending = branch.curve.bending();
    (bending < WINDING * WINDING).then(|| Group {
        ends: vec![i, j],
        branches: vec![branch],
        cost: bending + unlike.to_radians().powi(2),
    })
}

/// Three creases that run to a point. Between two of them lies one side of the corner, which has one plane there.
fn corner(ends: &[CreaseEnd], of: [usize; 3], positions: &[[f64; 3]]) -> Option<Group> {
    let of_ends = of.map(|e| &ends[e]);
    let at = meeting_point(of_ends, positions)?;
    let mut branches = Vec::new();
    for end in of_ends {
        branches.push(Branch::towards(end, at, positions)?);
    }
    let mut normals = [[None; 2]; 3];
    let mut cost = branches.iter().map(|branch| branch.curve.bending()).sum();
    for i in 0..3 {
        let left = branches[i].normals(1.0)[0];
        let off = |j: &usize| angle(&left, &branches[*j].normals(1.0)[1]);
        let others = (0..3).filter(|&j| j != i);
        let j = others.min_by(|a, b| off(a).total_cmp(&off(b)))?;
        let right = branches[j].normals(1.0)[1];
        let [t, u] = [i, j].map(|b| branches[b].curve.at(1.0).tangent);
        let plane = t
            .cross(&u)
            .try_normalize(0.1)
            .unwrap_or((left + right).normalize());
        let plane = plane * plane.dot(&(left + right)).signum();
        let askew = angle(&plane, &left).max(angle(&plane, &right));
        if askew > ASKEW.to_radians() || normals[j][1].is_some() {
            return None;
        }
        cost += askew * askew;
        (normals[i][0], normals[j][1]) = (Some(plane), Some(plane));
    }
    let ending = branches.into_iter().zip(normals);
    let branches = ending.map(|(branch, normals)| Some(branch.ending_in([normals[0]?, normals[1]?])));
    Some(Group {
        ends: of.to_vec(),
        branches: branches.collect::<Option<_>>()?,
        cost,
    })
}

/// The point nearest to three creases that go on with their curvatures, if it lies before all of them.
fn meeting_point(ends: [&CreaseEnd; 3], positions: &[[f64; 3]]) -> Option<Vector3<f64>> {
    let mut lines = ends.map(|end| inward(end, positions));
    for _ in 0..APPROACHES {
        let point = nearest_point(&lines)?;
        for (line, end) in lines.iter_mut().zip(ends) {
            let start = inward(end, positions);
            let way = (point - start.at).norm();
            let curve = Curve::with_curvature(start, end.curvature.into(), 1.5 * way);
            *line = curve.at(curve.nearest(&point).0);
        }
    }
    let point = nearest_point(&lines)?;
    let is_before = |end: &CreaseEnd| {
        let start = inward(end, positions);
        let to = point - start.at;
        let bend = Vector3::from(end.curvature).norm() * to.norm();
        angle(&start.tangent, &to) < ASKEW.to_radians() + 0.5 * bend
    };
    ends.iter().all(|end| is_before(end)).then_some(point)
}

/// The point nearest to three lines.
fn nearest_point(lines: &[CurvePoint; 3]) -> Option<Vector3<f64>> {
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for line in lines {
        let across = Matrix3::identity() - line.tangent * line.tangent.transpose();
        matrix += across;
        right += across * line.at;
    }
    Some(matrix.cholesky()?.solve(&right))
}
