//! Triangles that intersect: counts known by formulas, and surfaces that run into something.

use std::f64::consts::TAU;

use crate::fairing::{attempt, flat, irregular, options};
use fairmesh::{
    Error, FillOptions, FillOutcome, Intersections, Loops, Options, Outcome, Selection, SelfIntersections,
    boundary_loops, fair, fill_holes, self_intersections,
};
use fairmesh_shapes::{OUTSIDE, Shape, Similarity, sphere_cap, sphere_with_hole};

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// A sheet of `rows` by `columns` squares, each divided into two triangles.
fn sheet(rows: u32, columns: u32, at: impl Fn(f64, f64) -> [f64; 3]) -> Mesh {
    let vertices = (0..=rows).flat_map(|i| (0..=columns).map(move |j| (f64::from(i), f64::from(j))));
    let number = |i: u32, j: u32| i * (columns + 1) + j;
    let cells = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
    let triangles = cells.flat_map(|(i, j)| {
        let [a, b, c, d] = [
            number(i, j),
            number(i + 1, j),
            number(i + 1, j + 1),
            number(i, j + 1),
        ];
        [[a, b, c], [a, c, d]]
    });
    (vertices.map(|(u, v)| at(u, v)).collect(), triangles.collect())
}

fn join((mut x, mut t): Mesh, (more, triangles): Mesh) -> Mesh {
    let first = x.len() as u32;
    x.extend(more);
    t.extend(triangles.iter().map(|t| t.map(|v| v + first)));
    (x, t)
}

/// A lying sheet of n squares along y, and one that stands in it and reaches beyond it: both are cut along a line into pieces,
/// lying triangles into 2 n, standing ones into 2 n + 1 that meet them. Two divisions of a line without common points into a
/// and b pieces have a + b - 1 pairs that overlap.
fn crossing_sheets(n: u32) -> Mesh {
    let lying = sheet(3, n, |u, v| [u, v, 0.0]);
    let standing = sheet(2, n + 2, |u, v| [1.375, v - 0.59375, u - 0.765_625]);
    join(lying, standing)
}

#[test]
fn crossing_sheets_have_as_many_pairs_as_the_line_has_pieces() {
    for n in [1, 2, 8, 40] {
        let (x, t) = crossing_sheets(n);
        let pairs = self_intersections(&x, &t, None).unwrap();
        assert_eq!(pairs.len() as u32, 4 * n, "{n}");
        let lying = 6 * n;
        assert_all!(pairs.iter(), |[a, b]| *a < lying && *b >= lying);
        assert!(pairs.is_sorted(), "{pairs:?}");
        let some: Vec<u32> = (0..lying).step_by(2).collect();
        let of_some = self_intersections(&x, &t, Some(&some)).unwrap();
        let expected: Vec<_> = pairs.iter().filter(|[a, _]| a % 2 == 0).copied().collect();
        assert_eq!(of_some, expected);
    }
}

/// Units, places that are exact, order and direction of triangles do not matter.
#[test]
fn pairs_do_not_depend_on_units_places_and_order() {
    let (x, t) = crossing_sheets(9);
    let pairs = self_intersections(&x, &t, None).unwrap();
    for (scale, offset) in [
        (1e-6, 0.0),
        (1e6, 0.0),
        (1e150, 0.0),
        (1e-150, 0.0),
        (1.0, 4_194_304.0),
    ] {
        let moved: Vec<[f64; 3]> = x.iter().map(|p| p.map(|c| c * scale + offset)).collect();
        assert_eq!(
            self_intersections(&moved, &t, None).unwrap(),
            pairs,
            "{scale} {offset}"
        );
    }
    let count = t.len() as u32;
    let place = |k: u32| (k * 5 + 3) % count;
    let mut shuffled = t.clone();
    for k in 0..count {
        let [a, b, c] = t[k as usize];
        shuffled[place(k) as usize] = if k % 2 == 0 { [b, c, a] } else { [c, b, a] };
    }
    assert!(!count.is_multiple_of(5), "no permutation");
    let mut expected: Vec<[u32; 2]> = pairs.iter().map(|pair| pair.map(place)).collect();
    expected.iter_mut().for_each(|pair| pair.sort_unstable());
    expected.sort_unstable();
    assert_eq!(self_intersections(&x, &shuffled, None).unwrap(), expected);
}

#[test]
fn bad_meshes_are_refused() {
    let x = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, f64::NAN, 0.0]];
    assert_eq!(
        self_intersections(&x, &[[0, 1, 2]], None),
        Err(Error::NotFinite { vertex: 2 })
    );
    let out_of_range = self_intersections(&x, &[[0, 1, 3]], None);
    assert_matches!(out_of_range, Err(Error::IndexOutOfRange { index: 3, .. }));
    let named = self_intersections(&x[..2], &[], Some(&[0]));
    assert_eq!(named, Err(Error::SelectionOutOfRange { index: 0, count: 0 }));
}

/// A closed needle along the z axis, near it.
fn needle(low: f64, high: f64) -> Mesh {
    let x = vec![
        [0.11, 0.07, low],
        [0.13, 0.08, low],
        [0.12, 0.1, low],
        [0.12, 0.085, high],
    ];
    (x, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
}

/// A cap of 60 degrees, flat to begin with, below a needle that stands on nothing.
fn cap_with(needle: Mesh) -> Shape {
    let mut cap = sphere_cap(60.0, 800, irregular(1), OUTSIDE);
    cap.positions = flat(&cap);
    let (positions, triangles) = join((cap.positions.clone(), cap.triangles.clone()), needle);
    cap.free.resize(positions.len(), false);
    (cap.positions, cap.triangles) = (positions, triangles);
    cap
}

#[test]
fn a_surface_that_runs_into_what_stands_there_is_no_success() {
    let cap = cap_with(needle(0.9, 1.5));
    let first = cap.triangles.len() as u32 - 4;
    let solution = attempt(&cap, options(1e-8)).unwrap();
    let found = solution.report.self_intersections.as_ref().unwrap();
    assert_eq!(
        solution.report.outcome,
        Outcome::SelfIntersecting {
            pairs: found.pairs.len()
        }
    );
    assert!(
        !solution.report.outcome.is_success(),
        "{:?}",
        solution.report.outcome
    );
    assert_at_least!(found.pairs.len(), 3);
    assert_eq!(found.in_input, 0);
    let is_free = |t: u32| cap.triangles[t as usize].iter().any(|&v| cap.free[v as usize]);
    assert_all!(found.pairs.iter(), |&[a, b]| is_free(a) && b >= first);
    assert_eq!(
        self_intersections(&solution.positions, &cap.triangles, None).unwrap(),
        found.pairs
    );

    let unasked = Options {
        intersections: Intersections::Skip,
        ..options(1e-8)
    };
    let unchecked = attempt(&cap, unasked).unwrap();
    assert_eq!(unchecked.report.outcome, Outcome::Converged);
    assert_eq!(unchecked.report.self_intersections, None);
    assert_eq!(unchecked.positions, solution.positions);

    let held_up = attempt(
        &cap,
        Options {
            max_iterations: 1,
            ..options(1e-8)
        },
    )
    .unwrap();
    assert_eq!(held_up.report.self_intersections, None);

    let beside = attempt(&cap_with(needle(1.1, 1.5)), options(1e-8)).unwrap();
    assert_eq!(beside.report.outcome, Outcome::Converged);
    assert_eq!(
        beside.report.self_intersections,
        Some(SelfIntersections::default())
    );
}

/// A tube of radius 1 whose ends flare like cones, and which of its vertices are free: between the flares no harmonic surface
/// is found, but one of a neighbouring equation.
fn flared_tube() -> (Mesh, Vec<bool>) {
    let (sin, cos) = 40f64.to_radians().sin_cos();
    let (mut tube, rows) = (sheet(12, 12, |i, j| [i, j, 0.0]), 12);
    for p in &mut tube.0 {
        let inside = p[0].clamp(3.0, 9.0);
        let beyond = p[0] - inside;
        let r = 1.0 + 0.5 * beyond.abs() * sin;
        let (y, x) = (TAU * (p[1] % 12.0) / 12.0).sin_cos();
        *p = [r * x, r * y, 0.5 * (inside - 6.0 + beyond * cos)];
    }
    // Its first and last columns coincide.
    let is_free = |v: u32| (4..=8).contains(&(v / (rows + 1)));
    let free = (0..tube.0.len() as u32).map(is_free).collect();
    (tube, free)
}

#[test]
fn a_nearest_member_that_runs_into_what_stands_there_says_so() {
    let (tube, mut free) = flared_tube();
    let solve =
        |mesh: &Mesh, free: &[bool]| fair(&mesh.0, &mesh.1, Selection::Mask(free), &options(1e-8)).unwrap();
    let alone = solve(&tube, &free).report;
    assert!(
        matches!(alone.outcome, Outcome::NearestMember { weight } if weight > 0.0 && weight <= 1.0),
        "{:?}",
        alone.outcome
    );
    assert_eq!(alone.self_intersections, Some(SelfIntersections::default()));
    // A spike across its wall.
    let (mut x, t) = needle(0.2, 3.0);
    x.iter_mut().for_each(|p| p.rotate_right(1));
    let both = join(tube, (x, t));
    free.resize(both.0.len(), false);
    let crossing = solve(&both, &free).report;
    let pairs = crossing.self_intersections.unwrap().pairs.len();
    assert!(pairs >= 3, "{pairs}");
    assert_eq!(crossing.outcome, Outcome::SelfIntersecting { pairs });
}

/// What the input had is counted, but two fixed triangles are not.
#[test]
fn intersections_of_the_input_are_told_apart() {
    let cap = cap_with(join(needle(0.2, 1.5), needle(0.3, 1.4)));
    let solution = attempt(&cap, options(1e-8)).unwrap();
    let found = solution.report.self_intersections.unwrap();
    let all = self_intersections(&solution.positions, &cap.triangles, None).unwrap();
    assert_above!(found.in_input, 0);
    assert!(!found.pairs.is_empty());
    assert_above!(all.len(), found.pairs.len());
    let before = self_intersections(&cap.positions, &cap.triangles, None).unwrap();
    assert_above!(before.len(), found.in_input);
}

#[test]
fn caps_do_not_intersect_wherever_they_are() {
    let cap = sphere_cap(60.0, 800, irregular(2), OUTSIDE);
    for (scale, place) in [
        (1.0, [0.0; 3]),
        (1e-6, [0.0; 3]),
        (1e6, [0.0; 3]),
        (1.0, [1e6, -1e6, 1e6]),
    ] {
        let moved = cap.transformed(&Similarity::new([1.0, 2.0, 3.0], 0.7, scale, place));
        let solution = attempt(&moved, options(1e-8)).unwrap();
        assert_eq!(
            solution.report.self_intersections,
            Some(SelfIntersections::default())
        );
        assert_eq!(
            self_intersections(&solution.positions, &moved.triangles, None),
            Ok(Vec::new())
        );
    }
}

/// The unit sphere without a cap of 60 degrees, and a needle.
fn open_sphere(needle: Mesh) -> Mesh {
    let shape = sphere_with_hole(1.0, 600, irregular(3), 0);
    let hole = |t: &&[u32; 3]| t.iter().all(|&v| shape.positions[v as usize][2] < 0.5);
    let triangles = shape.triangles.iter().filter(hole).copied().collect();
    join((shape.positions.clone(), triangles), needle)
}

fn fill_largest(mesh: &Mesh, intersections: Intersections) -> fairmesh::Filled {
    let loops = boundary_loops(&mesh.0, &mesh.1).unwrap();
    let largest = (0..loops.len()).max_by_key(|&l| loops[l].vertices.len()).unwrap();
    let fill = FillOptions {
        loops: Loops::Chosen(vec![largest]),
        fairing: Options {
            intersections,
            ..options(1e-8)
        },
        ..FillOptions::default()
    };
    fill_holes(&mesh.0, &mesh.1, &fill).unwrap()
}

#[test]
fn a_patch_that_would_intersect_is_made_by_other_means() {
    let through_the_dome = open_sphere(needle(0.8, 1.5));
    let filled = fill_largest(&through_the_dome, Intersections::Check);
    let report = &filled.loops[0];
    // It passes below the needle's point, and has not the normals of the sphere.
    assert_eq!(report.outcome, FillOutcome::Faired);
    assert_below!(report.normals_reached, 1.0);
    assert!(!report.fairing.as_ref().unwrap().outcome.is_success());
    assert_empty!(report.self_intersections);
    assert_eq!(
        self_intersections(&filled.positions, &filled.triangles, None),
        Ok(Vec::new())
    );

    let unchecked = fill_largest(&through_the_dome, Intersections::Skip);
    assert_eq!(unchecked.loops[0].outcome, FillOutcome::Faired);
    assert_empty!(unchecked.loops[0].self_intersections);
    assert!(
        !self_intersections(&unchecked.positions, &unchecked.triangles, None)
            .unwrap()
            .is_empty()
    );

    let nothing_there = fill_largest(&open_sphere(needle(1.1, 1.5)), Intersections::Check);
    assert_eq!(nothing_there.loops[0].outcome, FillOutcome::Faired);
}

#[test]
fn a_patch_that_cannot_but_intersect_says_so() {
    let through_everything = open_sphere(needle(0.1, 1.5));
    let filled = fill_largest(&through_everything, Intersections::Check);
    let report = &filled.loops[0];
    assert_eq!(report.outcome, FillOutcome::SelfIntersecting);
    assert_at_least!(report.self_intersections.len(), 3);
    let all = self_intersections(&filled.positions, &filled.triangles, None).unwrap();
    assert_eq!(report.self_intersections, all);
}

/// A tube of five rows of vertices about the z axis, open at both ends, from `near` on towards greater heights or lower ones.
fn tube(n: u32, radius: f64, near: f64, upwards: bool) -> Mesh {
    let step = if upwards { 0.25 } else { -0.25 };
    let (x, mut t) = sheet(4, n, |row, k| {
        let a = std::f64::consts::TAU * k / f64::from(n);
        [radius * a.cos(), radius * a.sin(), near + step * row]
    });
    // The last column is the first one again.
    let of_column = |v: u32| v / (n + 1) * (n + 1) + v % (n + 1) % n;
    t.iter_mut().flatten().for_each(|v| *v = of_column(*v));
    if upwards {
        t.iter_mut().for_each(|t| t.swap(1, 2));
    }
    (x, t)
}

/// The domes over two tubes that face each other run through each other: both are found, and the first one said so alone.
#[test]
fn two_patches_that_intersect_both_say_so() {
    let (x, t) = join(tube(24, 1.0, -0.25, false), tube(20, 0.9, 0.25, true));
    let filled = fill_holes(&x, &t, &FillOptions::default()).unwrap();
    let all = self_intersections(&filled.positions, &filled.triangles, None).unwrap();
    assert!(!all.is_empty());
    let (crossed, others): (Vec<_>, Vec<_>) = filled
        .loops
        .iter()
        .partition(|report| report.outcome == FillOutcome::SelfIntersecting);
    assert_eq!((crossed.len(), others.len()), (2, 2));
    for report in crossed {
        assert_eq!(report.self_intersections, all);
        let own = |pair: &[u32; 2]| pair.iter().any(|&t| report.triangles.contains(&t));
        assert_all!(all.iter(), own);
    }
    for report in others {
        assert_eq!(report.outcome, FillOutcome::Faired);
        assert_empty!(report.self_intersections);
    }
}
