//! Which ends of creases belong together: pairs, corners, and those that fit nothing.
//!
//! All ways to group them are looked at, and the one is taken whose curves agree best with the curvatures at their ends, where an end alone costs
//! as much as a straight end of a curve that turns by about 140 degrees. Who fits whom is asked of convexity and angles, too.

use super::branch::{Arrival, Branch};
use super::corners::{corner, half_corner, two_corners};
use super::group::{Group, UNLIKE};
use crate::fairing::sharp_edge::CreaseEnd;

/// What an end alone costs, in squares of radians.
/// Half: of 60 parts 1 changes; double: none changes.
const ALONE: f64 = 6.0;
/// More ends are not grouped: there are thousands of ways.
const MOST: usize = 8;

/// The ends, each in one group.
pub(super) fn grouped(ends: &[CreaseEnd], positions: &[[f64; 3]]) -> Vec<Group> {
    let mut candidates: Vec<Group> = (0..ends.len()).map(alone).collect();
    if ends.len() > MOST {
        return candidates;
    }
    let arrivals: Vec<Arrival> = ends.iter().map(|end| Arrival::of(end, positions)).collect();
    let mut halves = Vec::new();
    for set in 1..1u32 << ends.len() {
        let of: Vec<usize> = (0..ends.len()).filter(|e| set >> e & 1 == 1).collect();
        match of[..] {
            [_] => {}
            [i, j] => {
                candidates.extend(pair(&arrivals, [i, j]));
                halves.extend(half_corner(&arrivals, [i, j]));
            }
            _ => candidates.extend(corner(&arrivals, &of)),
        }
    }
    for (k, half) in halves.iter().enumerate() {
        candidates.extend(halves[..k].iter().filter_map(|other| two_corners(other, half)));
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
        let fits = group.ends.contains(&first) && group.ends.iter().all(|&e| !taken[e]);
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

fn pair(arrivals: &[Arrival], [i, j]: [usize; 2]) -> Option<Group> {
    let unlike = (arrivals[i].angle - arrivals[j].angle).abs();
    if unlike > UNLIKE {
        return None;
    }
    let branch = Branch::between([&arrivals[i], &arrivals[j]])?;
    let variation = branch.variation(&[&arrivals[i], &arrivals[j]])?;
    Some(Group {
        ends: vec![i, j],
        branches: vec![branch],
        cost: variation + unlike.to_radians().powi(2),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ends on these points, of a ridge of 90 degrees, whose normals are up and outward from the axis z.
    fn ends(of: &[([f64; 3], [f64; 3])], curvature: f64, curvature_error: f64) -> Vec<CreaseEnd> {
        let end = |(vertex, (at, direction)): (u32, &([f64; 3], [f64; 3]))| {
            let [x, y, _] = *at;
            let outward = [x, y, 0.0].map(|c| c / libm::hypot(x, y));
            let is_left = x * direction[1] - y * direction[0] > 0.0;
            let up = [0.0, 0.0, 1.0];
            CreaseEnd {
                vertex,
                direction: *direction,
                curvature: outward.map(|c| -c * curvature),
                curvature_error,
                normals: if is_left { [up, outward] } else { [outward, up] },
                angle: 90.0,
                error: 0.0,
                chains: Vec::new(),
            }
        };
        (0..).zip(of).map(end).collect()
    }

    fn counts(ends: &[CreaseEnd], at: &[[f64; 3]]) -> Vec<usize> {
        let groups = grouped(ends, at);
        groups.iter().map(|group| group.ends.len()).collect()
    }

    /// The rest of a circle of so many radians goes on by its curvature; straight edges do not turn on their way, unless nothing is certain about them.
    #[test]
    fn creases_go_on_as_their_curvature_tells() {
        for turn in [1.0f64, 2.0, 3.5, 5.0] {
            let at = |phi: f64, way: f64| {
                let (sin, cos) = libm::sincos(phi);
                ([cos, sin, 0.0], [-sin * way, cos * way, 0.0])
            };
            let both = [at(0.0, 1.0), at(turn, -1.0)];
            let places = both.map(|(x, _)| x);
            assert_eq!(counts(&ends(&both, 1.0, 0.01), &places), [2], "{turn}");
            let straight = counts(&ends(&both, 0.0, 0.01), &places);
            assert_eq!(straight.len(), if turn < 1.6 { 1 } else { 2 }, "{turn}");
            assert_eq!(
                counts(&ends(&both, 0.0, f64::INFINITY), &places).len(),
                if turn < 3.0 { 1 } else { 2 },
                "{turn}"
            );
        }
    }
}
