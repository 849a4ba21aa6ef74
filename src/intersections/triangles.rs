//! Whether two triangles intersect: exactly, by signs of determinants (`robust`; Shewchuk 1997).
//!
//! A triangle is the three positions of its corners; corners with equal positions are one vertex. All triangles here have an
//! area.

use robust::{Coord, Coord3D, orient2d, orient3d};

/// The positions of a triangle's corners.
pub(crate) type Corners = [[f64; 3]; 3];

/// The coordinates that are left when one is dropped.
pub(super) type Axes = [usize; 2];

pub(super) const PROJECTIONS: [Axes; 3] = [[1, 2], [2, 0], [0, 1]];

/// A projection in which the triangle has an area; none if it has none at all.
pub(super) fn projection(t: &Corners) -> Option<Axes> {
    PROJECTIONS
        .into_iter()
        .find(|&axes| turn(axes, &t[0], &t[1], &t[2]) != 0.0)
}

/// Which sides a triangle shows in the projections: bit 2 k for counter-clockwise, 2 k + 1 for clockwise in the k-th. Without an
/// area it shows none.
pub(crate) fn facing(t: &Corners) -> u8 {
    (0..3).fold(0, |bits, k| {
        let turn = turn(PROJECTIONS[k], &t[0], &t[1], &t[2]);
        bits | u8::from(turn > 0.0) << (2 * k) | u8::from(turn < 0.0) << (2 * k + 1)
    })
}

/// Positive if three points run counter-clockwise in a projection, zero if they lie in one line.
pub(super) fn turn(axes: Axes, a: &[f64; 3], b: &[f64; 3], c: &[f64; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(|p| Coord {
        x: p[axes[0]],
        y: p[axes[1]],
    });
    orient2d(a, b, c)
}

/// Six times the volume of a tetrahedron, with a right sign: zero if the points lie in one plane.
fn volume(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3], d: &[f64; 3]) -> f64 {
    let [a, b, c, d] = [a, b, c, d].map(|p| Coord3D {
        x: p[0],
        y: p[1],
        z: p[2],
    });
    orient3d(a, b, c, d)
}

fn side(t: &Corners, p: &[f64; 3]) -> f64 {
    volume(&t[0], &t[1], &t[2], p)
}

/// Whether numbers are all positive, or all negative.
fn agree(values: &[f64]) -> bool {
    values.iter().all(|&v| v > 0.0) || values.iter().all(|&v| v < 0.0)
}

/// Whether no two numbers have opposite signs.
fn do_not_disagree(values: &[f64]) -> bool {
    values.iter().all(|&v| v >= 0.0) || values.iter().all(|&v| v <= 0.0)
}

/// Whether two triangles have more in common than a vertex of both or an edge of both.
pub(crate) fn intersect(a: &Corners, b: &Corners) -> bool {
    let mut common = [(0, 0); 3];
    let mut count = 0;
    for (i, p) in a.iter().enumerate() {
        for (j, q) in b.iter().enumerate() {
            if p == q {
                // Triangles with an area have different corners: three pairs at most.
                common[count] = (i, j);
                count += 1;
            }
        }
    }
    match count {
        0 => no_corner_in_common(a, b),
        1 => corner_in_common(&from(a, common[0].0), &from(b, common[0].1)),
        2 => edge_in_common(a, b, common[0], common[1]),
        _ => true,
    }
}

/// The same triangle, beginning at another corner.
fn from(t: &Corners, first: usize) -> Corners {
    [0, 1, 2].map(|k| t[(first + k) % 3])
}

fn no_corner_in_common(a: &Corners, b: &Corners) -> bool {
    if are_apart(a, b) {
        return false;
    }
    let is_beside = |t: &Corners, other: &Corners| agree(&other.map(|p| side(t, &p)));
    if is_beside(a, b) || is_beside(b, a) {
        return false;
    }
    let pierces = |t: &Corners, other: &Corners| (0..3).any(|k| meets(&t[k], &t[(k + 1) % 3], other));
    pierces(a, b) || pierces(b, a)
}

/// Both begin at the common corner. What they have in common beyond it reaches, seen from there, the opposite edge of one.
fn corner_in_common(a: &Corners, b: &Corners) -> bool {
    if are_told_apart(a, b) {
        return false;
    }
    let is_beside = |t: &Corners, other: &Corners| agree(&[side(t, &other[1]), side(t, &other[2])]);
    if is_beside(a, b) || is_beside(b, a) {
        return false;
    }
    meets(&a[1], &a[2], b) || meets(&b[1], &b[2], a)
}

/// Twenty times the relative error of a dot product of differences.
/// Half or double, of 69 cases: none changes.
const MARGIN: f64 = 1e-14;
/// What is larger has not underflowed.
/// Half or double, of 69 cases: none changes.
const SMALLEST: f64 = 1e-200;

fn difference(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| a[axis] - b[axis])
}

/// How far a difference of two positions reaches along a direction: at least, and at most, whatever the rounding.
fn reach(edge: &[f64; 3], direction: &[f64; 3]) -> [f64; 2] {
    let terms = [0, 1, 2].map(|axis| direction[axis] * edge[axis]);
    let (sum, size) = (
        terms[0] + terms[1] + terms[2],
        terms[0].abs() + terms[1].abs() + terms[2].abs(),
    );
    let margin = MARGIN * size + SMALLEST;
    [sum - margin, sum + margin]
}

/// Whether a plane across the line between their middles parts them, beyond any rounding: so it is with most triangles that
/// are near each other, and this is found much sooner than by determinants.
fn are_apart(a: &Corners, b: &Corners) -> bool {
    let sum = |t: &Corners| [0, 1, 2].map(|axis| t[0][axis] + t[1][axis] + t[2][axis]);
    let direction = difference(&sum(b), &sum(a));
    let reach = |p: &[f64; 3]| reach(&difference(p, &a[0]), &direction);
    let end = a.iter().map(|p| reach(p)[1]).fold(f64::NEG_INFINITY, f64::max);
    b.iter().all(|p| reach(p)[0] > end)
}

/// Whether a plane through the common first corner has them on either side, beyond any rounding: so are most triangles around a
/// vertex.
fn are_told_apart(a: &Corners, b: &Corners) -> bool {
    let edges = |t: &Corners| [1, 2].map(|k| difference(&t[k], &t[0]));
    let (a, b) = (edges(a), edges(b));
    let middle = |[e, f]: &[[f64; 3]; 2]| [0, 1, 2].map(|axis| e[axis] + f[axis]);
    let square = |e: &[f64; 3]| e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
    let (to_a, to_b) = (middle(&a), middle(&b));
    // Across the plane that halves the angle between the two.
    let ratio = (square(&to_a) / square(&to_b)).sqrt();
    let normal = [0, 1, 2].map(|axis| to_a[axis] - ratio * to_b[axis]);
    a.iter().all(|edge| reach(edge, &normal)[0] > 0.0) && b.iter().all(|edge| reach(edge, &normal)[1] < 0.0)
}

/// Folded over: in one plane, and on the same side of the common edge.
fn edge_in_common(a: &Corners, b: &Corners, first: (usize, usize), second: (usize, usize)) -> bool {
    let (p, q) = (&a[first.0], &a[second.0]);
    let (third_a, third_b) = (&a[3 - first.0 - second.0], &b[3 - first.1 - second.1]);
    if side(a, third_b) != 0.0 {
        return false;
    }
    projection(a).is_some_and(|axes| agree(&[turn(axes, p, q, third_a), turn(axes, p, q, third_b)]))
}

/// Whether a segment and a triangle have a point in common, ends and edges included.
fn meets(p: &[f64; 3], q: &[f64; 3], t: &Corners) -> bool {
    let sides = [side(t, p), side(t, q)];
    if agree(&sides) {
        return false;
    }
    if sides == [0.0, 0.0] {
        return projection(t).is_some_and(|axes| meets_in_plane(axes, p, q, t));
    }
    // The line crosses the plane in one point of the segment: inside, where it passes all edges on the same side.
    do_not_disagree(&[0, 1, 2].map(|k| volume(p, q, &t[k], &t[(k + 1) % 3])))
}

fn meets_in_plane(axes: Axes, p: &[f64; 3], q: &[f64; 3], t: &Corners) -> bool {
    let edges = [0, 1, 2].map(|k| (&t[k], &t[(k + 1) % 3]));
    do_not_disagree(&edges.map(|(u, v)| turn(axes, u, v, p)))
        || edges.iter().any(|(u, v)| segments_meet(axes, [p, q], [u, v]))
}

pub(super) fn segments_meet(axes: Axes, [p, q]: [&[f64; 3]; 2], [u, v]: [&[f64; 3]; 2]) -> bool {
    let of_line = [turn(axes, p, q, u), turn(axes, p, q, v)];
    let of_other = [turn(axes, u, v, p), turn(axes, u, v, q)];
    if of_line == [0.0, 0.0] {
        // In one line: their extents overlap.
        return axes
            .iter()
            .all(|&k| p[k].min(q[k]) <= u[k].max(v[k]) && u[k].min(v[k]) <= p[k].max(q[k]));
    }
    !agree(&of_line) && !agree(&of_other)
}
