//! Which ends of creases belong together: pairs, corners, and those that fit nothing.
//!
//! All ways to group them are looked at, and the one is taken whose curves agree best with the curvatures at their ends, where an end alone costs
//! as much as a straight end of a curve that turns by about 140 degrees. Who fits whom is asked of convexity and angles, too.

use std::collections::BTreeMap;

use super::branch::{Arrival, Branch};
use super::corners::{corner, half_corner, is_meeting, two_corners};
use super::group::{Group, UNLIKE};
use crate::fairing::sharp_edge::CreaseEnd;

/// What an end alone costs, in squares of radians.
/// Half: of 60 parts 1 changes; double: none changes.
const ALONE: f64 = 6.0;
/// More ends are not grouped, as time goes with their cube: 28 take a second.
const MOST: usize = 32;

/// The ends, each in one group.
pub(super) fn grouped(ends: &[CreaseEnd], positions: &[[f64; 3]]) -> Vec<Group> {
    let mut candidates: Vec<Group> = (0..ends.len()).map(alone).collect();
    if ends.len() > MOST {
        return candidates;
    }
    let arrivals: Vec<Arrival> = ends.iter().map(|end| Arrival::of(end, positions)).collect();
    let mut halves = Vec::new();
    let mut meeting = Vec::new();
    for j in 0..ends.len() {
        for i in 0..j {
            candidates.extend(pair(&arrivals, [i, j]));
            halves.extend(half_corner(&arrivals, [i, j]));
            meeting.push(vec![i, j]);
        }
    }
    while !meeting.is_empty() {
        meeting = one_more(&arrivals, &meeting);
        candidates.extend(meeting.iter().filter_map(|of| corner(&arrivals, of)));
    }
    for (k, half) in halves.iter().enumerate() {
        candidates.extend(halves[..k].iter().filter_map(|other| two_corners(other, half)));
    }
    // Others are never better than their ends alone.
    candidates.retain(|group| group.ends.len() == 1 || group.cost < ALONE * group.ends.len() as f64);
    let best = cheapest(&candidates, 0, ends.len(), &mut BTreeMap::new());
    best.1.into_iter().map(|g| candidates[g].clone()).collect()
}

/// The sets that have one end more, with a number above theirs, and run to a point, too.
fn one_more(arrivals: &[Arrival], sets: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let more = sets.iter().flat_map(|set| {
        let next = set[set.len() - 1] + 1..arrivals.len();
        next.map(|e| [&set[..], &[e]].concat())
    });
    more.filter(|set| is_meeting(arrivals, set)).collect()
}

/// The least cost of groups for the ends that are not in this set, and these groups.
fn cheapest(
    candidates: &[Group],
    taken: u64,
    count: usize,
    known: &mut BTreeMap<u64, (f64, Vec<usize>)>,
) -> (f64, Vec<usize>) {
    let first = taken.trailing_ones() as usize;
    if first >= count {
        return (0.0, Vec::new());
    }
    if let Some(best) = known.get(&taken) {
        return best.clone();
    }
    let mut best = (f64::INFINITY, Vec::new());
    for (g, group) in candidates.iter().enumerate() {
        let set = group.ends.iter().fold(0, |set, e| set | 1 << e);
        if set >> first & 1 == 0 || set & taken != 0 {
            continue;
        }
        let (cost, mut groups) = cheapest(candidates, taken | set, count, known);
        if cost + group.cost < best.0 {
            groups.push(g);
            best = (cost + group.cost, groups);
        }
    }
    known.insert(taken, best.clone());
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
