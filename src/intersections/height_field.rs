//! Whether triangles are a height field over a coordinate plane: then no two of them intersect, and nothing need be compared.
//!
//! Let all triangles show the same side to the plane, exactly, and call edges open that no other of them has the other way round.
//! Projected, a point off all edges is covered as often as the open edges wind around it. If these
//! (1) have nothing in common but ends of both,
//! (2) leave and reach each vertex by turns, seen around it, and
//! (3) hang together,
//! then by (1) and (2) the winding number takes two neighbouring values on the two sides of each of them, by (3) the same two
//! everywhere, and one is that of the points far away, zero: no point is covered twice. Nor does a vertex lie within an edge of
//! another triangle or on another vertex: around a vertex without open edges everything is covered, and within an edge that is not open as
//! well; by (1) nothing is on an open edge. So projected triangles have vertices and edges of both in common at most, and the
//! triangles themselves no more than that.

use std::cmp::Ordering;
use std::ops::Range;

use super::triangles::{Axes, Corners, segments_meet, turn};

/// Comparisons of open edges that are made for each of them: a bound on the work for boundaries that are no sensible ones.
/// Half or double, of 129 cases: none changes.
const COMPARISONS: usize = 256;

type Point = [f64; 3];

/// From one corner to another.
#[derive(Clone, Copy)]
struct Edge<'t>([&'t Point; 2]);

/// Whether a run of triangles, which all show the same side in a projection, is a height field; if it is not told for sure, it is
/// none. `across` has the triangles at their edges.
pub(super) fn is_height_field<'t>(
    axes: Axes,
    corners: impl Fn(usize) -> &'t Corners,
    across: &[[u32; 3]],
    run: Range<usize>,
) -> bool {
    let mut open = Vec::new();
    for t in run.clone() {
        for (k, &other) in across[t].iter().enumerate() {
            if !run.contains(&(other as usize)) {
                let t = corners(t);
                open.push(Edge([&t[k], &t[(k + 1) % 3]]));
            }
        }
    }
    are_simple(axes, &mut open) && are_one_by_turns(axes, &open)
}

/// Condition (1), along the longer side of the box around them.
fn are_simple(axes: Axes, open: &mut [Edge<'_>]) -> bool {
    let extent = |axis: usize| {
        let of = |f: fn(f64, f64) -> f64, first| open.iter().map(|e| e.0[0][axis]).fold(first, f);
        of(f64::max, f64::NEG_INFINITY) - of(f64::min, f64::INFINITY)
    };
    let [along, beside] = match extent(axes[0]) < extent(axes[1]) {
        true => [axes[1], axes[0]],
        false => axes,
    };
    let low = |e: &Edge<'_>, axis: usize| e.0[0][axis].min(e.0[1][axis]);
    let high = |e: &Edge<'_>, axis: usize| e.0[0][axis].max(e.0[1][axis]);
    open.sort_by(|a, b| low(a, along).total_cmp(&low(b, along)));
    let mut comparisons = COMPARISONS * open.len();
    for (i, e) in open.iter().enumerate() {
        let (end, sides) = (high(e, along), [low(e, beside), high(e, beside)]);
        for f in open[i + 1..].iter().take_while(|f| low(f, along) <= end) {
            if comparisons == 0 {
                return false;
            }
            comparisons -= 1;
            let overlap = low(f, beside) <= sides[1] && sides[0] <= high(f, beside);
            if overlap && touch(axes, e, f) {
                return false;
            }
        }
    }
    true
}

/// Whether two edges have more in common than an end of both.
fn touch(axes: Axes, e: &Edge<'_>, f: &Edge<'_>) -> bool {
    for i in 0..2 {
        for j in 0..2 {
            if e.0[i] == f.0[j] {
                // In one line, they overlap if they leave the common end in the same direction.
                let (p, q, r) = (e.0[i], e.0[1 - i], f.0[1 - j]);
                let leaves = |to: &Point, k: usize| to[k].partial_cmp(&p[k]);
                return turn(axes, p, q, r) == 0.0 && axes.iter().all(|&k| leaves(q, k) == leaves(r, k));
            }
        }
    }
    segments_meet(axes, e.0, f.0)
}

/// Conditions (2), for up to two edges that leave a vertex, and (3).
fn are_one_by_turns(axes: Axes, open: &[Edge<'_>]) -> bool {
    let sorted = |end: usize| {
        let mut edges = open.to_vec();
        for axis in [axes[1], axes[0]] {
            edges.sort_by(|a, b| a.0[end][axis].total_cmp(&b.0[end][axis]));
        }
        edges
    };
    let (leaving, reaching) = (sorted(0), sorted(1));
    // Each vertex is left as often as it is reached, so both lists have the same vertices at the same places.
    let mut first = 0;
    for at_vertex in leaving.chunk_by(|e, f| e.0[0] == f.0[0]) {
        let is_by_turns = match at_vertex {
            [_] => true,
            [e, f] => {
                let ends = [e.0[1], f.0[1]];
                let [g, h] = [&reaching[first], &reaching[first + 1]].map(|edge| edge.0[0]);
                is_between(axes, e.0[0], ends, g) != is_between(axes, e.0[0], ends, h)
            }
            _ => false,
        };
        if !is_by_turns {
            return false;
        }
        first += at_vertex.len();
    }
    hang_together(axes, &leaving)
}

/// Whether r lies between q and the other end, counter-clockwise around p; no two of the three in the same direction.
fn is_between(axes: Axes, p: &Point, [q, end]: [&Point; 2], r: &Point) -> bool {
    let is_in = |from: &Point, to: &Point| turn(axes, p, from, r) > 0.0 && turn(axes, p, r, to) > 0.0;
    if turn(axes, p, q, end) > 0.0 {
        is_in(q, end)
    } else {
        !is_in(end, q)
    }
}

/// Whether all can be reached from the first, along edges; sorted by where they begin.
fn hang_together(axes: Axes, leaving: &[Edge<'_>]) -> bool {
    let mut is_reached = vec![false; leaving.len()];
    let (mut next, mut reached) = (vec![0], 0);
    while let Some(e) = next.pop() {
        if std::mem::replace(&mut is_reached[e], true) {
            continue;
        }
        reached += 1;
        let end = leaving[e].0[1];
        let first = leaving.partition_point(|f| order(axes, f.0[0], end) == Ordering::Less);
        let more = leaving[first..].iter().take_while(|f| f.0[0] == end).count();
        next.extend(first..first + more);
    }
    reached == leaving.len()
}

/// Any order of projected positions.
fn order(axes: Axes, p: &Point, q: &Point) -> Ordering {
    p[axes[0]]
        .total_cmp(&q[axes[0]])
        .then(p[axes[1]].total_cmp(&q[axes[1]]))
}
