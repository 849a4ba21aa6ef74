use num_rational::Ratio;
use proptest::prelude::*;

use super::height_field::is_height_field;
use super::neighbours::neighbours;
use super::triangles::{Corners, PROJECTIONS, facing, intersect, projection};
use super::{of_all, of_some};

type Number = Ratio<i128>;
type Point = [Number; 3];

fn exact(p: &[f64; 3]) -> Point {
    p.map(|x| Number::from_integer(x as i128))
}

fn minus(a: &Point, b: &Point) -> Point {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: &Point, b: &Point) -> Number {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &Point, b: &Point) -> Point {
    [0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

/// What a closed half-space, all x with (x - origin) . normal >= 0, leaves of a convex polygon.
fn clip(polygon: &[Point], origin: &Point, normal: &Point) -> Vec<Point> {
    let zero = Number::from_integer(0);
    let height = |p: &Point| dot(&minus(p, origin), normal);
    let mut kept = Vec::new();
    for (i, p) in polygon.iter().enumerate() {
        let q = &polygon[(i + 1) % polygon.len()];
        let (hp, hq) = (height(p), height(q));
        if hp >= zero {
            kept.push(*p);
        }
        if (hp > zero && hq < zero) || (hp < zero && hq > zero) {
            let t = hp / (hp - hq);
            kept.push([0, 1, 2].map(|k| p[k] + t * (q[k] - p[k])));
        }
    }
    kept
}

/// The corners of what two triangles have in common: one clipped by the plane and the edges of the other, in fractions.
fn common_points(a: &Corners, b: &Corners) -> Vec<Point> {
    let b = b.map(|p| exact(&p));
    let normal = cross(&minus(&b[1], &b[0]), &minus(&b[2], &b[0]));
    let back = normal.map(|x| -x);
    let mut polygon: Vec<Point> = a.iter().map(exact).collect();
    polygon = clip(&clip(&polygon, &b[0], &normal), &b[0], &back);
    for k in 0..3 {
        let inwards = cross(&normal, &minus(&b[(k + 1) % 3], &b[k]));
        polygon = clip(&polygon, &b[k], &inwards);
    }
    polygon
}

/// The definition: more in common than a vertex or an edge of both.
fn intersect_by_definition(a: &Corners, b: &Corners) -> bool {
    let both: Vec<Point> = a.iter().filter(|p| b.contains(p)).map(exact).collect();
    let points = common_points(a, b);
    let is_between = |p: &Point, ends: &[Point]| {
        let (u, v) = (minus(p, &ends[0]), minus(p, &ends[1]));
        let zero = Number::from_integer(0);
        cross(&u, &v) == [zero; 3] && dot(&u, &v) <= zero
    };
    match both.len() {
        0 => !points.is_empty(),
        1 => points.iter().any(|p| *p != both[0]),
        2 => points.iter().any(|p| !is_between(p, &both)),
        _ => true,
    }
}

/// Six points of a small lattice, some of them repeated: touching, coplanar and common corners are frequent.
fn lattice(size: i32) -> impl Strategy<Value = (Corners, Corners)> {
    let point = move || prop::array::uniform3(-size..=size).prop_map(|p| p.map(f64::from));
    (
        prop::array::uniform3(point()),
        prop::array::uniform3(point()),
        0..4_usize,
        0..3_usize,
        prop::bool::ANY,
    )
        .prop_map(|(a, mut b, common, turn, is_flat)| {
            for k in 0..common.min(2) {
                b[(k + turn) % 3] = a[k];
            }
            let flat = |t: Corners| if is_flat { t.map(|p| [p[0], p[1], 1.0]) } else { t };
            (flat(a), flat(b))
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 10_000, max_global_rejects: 10_000, ..ProptestConfig::default() })]

    #[test]
    fn pairs_agree_with_clipping_in_fractions((a, b) in prop_oneof![lattice(2), lattice(5)]) {
        prop_assume!(projection(&a).is_some() && projection(&b).is_some());
        let expected = intersect_by_definition(&a, &b);
        prop_assert_eq!(intersect(&a, &b), expected);
        prop_assert_eq!(intersect(&b, &a), expected);
        prop_assert_eq!(intersect(&[a[2], a[0], a[1]], &[b[1], b[0], b[2]]), expected);
        // Elsewhere and in other units, without rounding.
        let moved = |t: Corners| t.map(|p| p.map(|x| (x + 1_048_576.0) * 2.0_f64.powi(-20)));
        prop_assert_eq!(intersect(&moved(a), &moved(b)), expected);
    }
}

#[test]
fn the_lattice_has_every_case() {
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let mut seen = [[0; 2]; 3];
    for _ in 0..4_000 {
        let (a, b) = lattice(2).new_tree(&mut runner).unwrap().current();
        if projection(&a).is_some() && projection(&b).is_some() {
            let common = a.iter().filter(|p| b.contains(p)).count();
            if common < 3 {
                seen[common][usize::from(intersect(&a, &b))] += 1;
            }
        }
    }
    assert!(seen.iter().flatten().all(|&n| n > 50), "{seen:?}");
}

/// Random triangles in a box: all pairs, one by one.
fn soup(count: usize, scale: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mut state = 7_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 40) as f64 / f64::from(1 << 24)
    };
    let mut positions = Vec::new();
    for _ in 0..count {
        let centre = [random(), random(), random()];
        for _ in 0..3 {
            positions.push(centre.map(|x| (x + 0.2 * random()) * scale));
        }
    }
    let triangles = (0..count as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    (positions, triangles)
}

#[test]
fn the_tree_finds_what_all_pairs_have() {
    let (x, triangles) = soup(1_500, 1.0);
    let corners: Vec<Corners> = triangles.iter().map(|t| t.map(|v| x[v as usize])).collect();
    let mut expected = Vec::new();
    for (i, a) in corners.iter().enumerate() {
        for (j, b) in corners.iter().enumerate().skip(i + 1) {
            if intersect(a, b) {
                expected.push([i as u32, j as u32]);
            }
        }
    }
    assert_above!(expected.len(), 1_000);
    assert_eq!(of_all(&x, &triangles, &mut |_| ()), expected);
    let asked: Vec<u32> = (0..1_500).step_by(7).rev().collect();
    let has_asked = |pair: &&[u32; 2]| pair.iter().any(|t| t % 7 == 0);
    let part: Vec<[u32; 2]> = expected.iter().filter(has_asked).copied().collect();
    assert_eq!(of_some(&x, &triangles, &asked, usize::MAX), part);
    let few = of_some(&x, &triangles, &asked, 10);
    assert_eq!(few.len(), 10);
    assert_all!(few.iter(), |pair| part.contains(pair));
}

#[test]
fn units_do_not_matter() {
    let (x, triangles) = soup(300, 1.0);
    let expected = of_all(&x, &triangles, &mut |_| ());
    for exponent in [-1_000, -500, -20, 20, 500, 1_000] {
        let scaled = soup(300, 2.0_f64.powi(exponent)).0;
        assert_eq!(of_all(&scaled, &triangles, &mut |_| ()), expected, "2^{exponent}");
    }
}

#[test]
fn what_is_not_finite_or_has_no_area_takes_no_part() {
    let x = [
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [0.0, 4.0, 0.0],
        [1.0, 1.0, -1.0],
        [1.0, 1.0, 1.0],
        [1.0, 1.0, 3.0],
        [f64::NAN, 0.0, 0.0],
        [2.0, 1.0, 1.0],
    ];
    let triangles = [[0, 1, 2], [3, 4, 5], [3, 4, 6], [3, 4, 7]];
    assert_eq!(of_all(&x, &triangles, &mut |_| ()), [[0, 3]]);
}

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// A sheet of `rows` by `columns` squares, each divided into two triangles.
fn sheet(rows: u32, columns: u32, at: impl Fn(f64, f64) -> [f64; 3]) -> Mesh {
    let number = |i: u32, j: u32| i * (columns + 1) + j;
    let vertices = (0..=rows).flat_map(|i| (0..=columns).map(move |j| (f64::from(i), f64::from(j))));
    let cells = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
    let triangles = cells.flat_map(|(i, j)| {
        let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| number(i, j));
        [[a, b, c], [a, c, d]]
    });
    (vertices.map(|(u, v)| at(u, v)).collect(), triangles.collect())
}

fn corners((x, triangles): &Mesh) -> Vec<Corners> {
    triangles.iter().map(|t| t.map(|v| x[v as usize])).collect()
}

fn all_pairs(mesh: &Mesh) -> Vec<[u32; 2]> {
    let corners = corners(mesh);
    let mut pairs = Vec::new();
    for (i, a) in corners.iter().enumerate().filter(|(_, t)| facing(t) != 0) {
        for (j, b) in corners.iter().enumerate().skip(i + 1) {
            if facing(b) != 0 && intersect(a, b) {
                pairs.push([i as u32, j as u32]);
            }
        }
    }
    pairs
}

proptest! {
    #![proptest_config(ProptestConfig { cases: if cfg!(debug_assertions) { 60 } else { 300 }, ..ProptestConfig::default() })]

    /// Winding sheets that are height fields in parts, meet themselves often, touch, and lie in one plane with themselves.
    #[test]
    fn pairs_of_sheets_are_those_of_all_their_triangles(
        numbers in prop::collection::vec(0..64_i32, 12 * 16),
        turns in 0.0..2.5,
        rise in -2..3_i32,
        noise in prop_oneof![Just(0.0), Just(0.01), Just(0.3)],
        leave_out in 0..5_usize,
    ) {
        let (x, mut triangles) = sheet(11, 15, |u, v| {
            let shift = f64::from(numbers[(u * 16.0 + v) as usize]) / 64.0 - 0.5;
            let angle: f64 = turns * v / 15.0 * std::f64::consts::TAU;
            let radius = 4.0 + u + noise * shift;
            let place = [radius * angle.cos(), radius * angle.sin(), f64::from(rise) * v / 4.0 + noise * shift];
            // On a lattice: exact contacts.
            place.map(|x| (x * 8.0).round() / 8.0)
        });
        let mut kept = 0;
        triangles.retain(|_| { kept += 1; leave_out == 0 || numbers[kept % numbers.len()] > 6 * leave_out as i32 });
        let mesh = (x, triangles);
        prop_assert_eq!(of_all(&mesh.0, &mesh.1, &mut |_| ()), all_pairs(&mesh));
    }
}

/// In the projections that they show themselves in: whether all triangles together are a height field.
fn is_a_height_field(mesh: &Mesh) -> bool {
    let corners = corners(mesh);
    let shown = corners.iter().fold(u8::MAX, |all, t| all & facing(t));
    let across = neighbours(corners.iter(), &mut |_| ());
    (0..3).any(|axes| {
        shown >> (2 * axes) & 3 != 0
            && is_height_field(PROJECTIONS[axes], |t| &corners[t], &across, 0..corners.len())
    })
}

/// Triangles around a vertex, evenly through an angle.
fn fan(count: u32, angle: f64, turned: f64) -> Mesh {
    let ends = (0..=count).map(|k| (turned + angle * f64::from(k) / f64::from(count)).sin_cos());
    let x = std::iter::once([0.0; 3])
        .chain(ends.map(|(sin, cos)| [cos, sin, 0.1 * cos]))
        .collect();
    (x, (1..=count).map(|k| [0, k, k + 1]).collect())
}

fn together((mut x, mut triangles): Mesh, (more, those): Mesh) -> Mesh {
    let first = x.len() as u32;
    x.extend(more);
    triangles.extend(those.iter().map(|t| t.map(|v| v + first)));
    (x, triangles)
}

#[test]
fn height_fields_are_told_from_what_covers_itself() {
    let bump = |u: f64, v: f64| [u, v, (u * v).sin()];
    assert!(is_a_height_field(&sheet(9, 7, bump)));
    assert!(is_a_height_field(&sheet(9, 7, |u, v| [bump(u, v)[2], u, v])));
    assert!(is_a_height_field(&sheet(9, 7, |u, v| [v, u, 0.5 * u])));
    // Once and twice around a vertex, and once through a part of another turn.
    assert!(is_a_height_field(&fan(9, 5.0, 0.0)));
    assert!(!is_a_height_field(&fan(19, 4.0 * std::f64::consts::PI, 0.3)));
    assert!(!is_a_height_field(&fan(9, 7.0, 0.0)));
    // A strip that runs over its beginning.
    let spiral = |turn: f64| {
        move |u: f64, v: f64| {
            let (sin, cos) = (turn * v / 20.0).sin_cos();
            [(2.0 + u) * cos, (2.0 + u) * sin, 0.1 * v]
        }
    };
    assert!(is_a_height_field(&sheet(1, 20, spiral(6.0))));
    assert!(!is_a_height_field(&sheet(1, 20, spiral(6.6))));
    // Two fans at a vertex: beside each other, and one upon the other, wholly or in part.
    let two = |turned: f64, angle: f64| together(fan(4, 1.5, 0.0), fan(4, angle, turned));
    assert!(is_a_height_field(&two(2.0, 1.0)));
    assert!(!is_a_height_field(&two(0.1, 1.0)));
    assert!(!is_a_height_field(&two(1.0, 1.0)));
    // One sheet above another.
    let above = |u: f64, v: f64| [0.25 * u + 3.0, 0.25 * v + 3.0, 9.0];
    assert!(!is_a_height_field(&together(
        sheet(9, 9, bump),
        sheet(4, 4, above)
    )));
    // The small one joined to a corner inside the large one's boundary, which winds twice around it.
    let corner = |u: f64, v: f64| [0.25 * u, 0.25 * v, 9.0 * u + 9.0 * v];
    assert!(!is_a_height_field(&together(
        sheet(9, 9, |u, v| [u, v, 0.0]),
        sheet(4, 4, corner)
    )));
    // A vertex that touches an edge.
    let touching: Mesh = (
        vec![
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [0.0, 2.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
            [2.0, -1.0, 0.0],
        ],
        vec![[0, 1, 2], [3, 4, 5]],
    );
    assert!(!is_a_height_field(&touching));
}
