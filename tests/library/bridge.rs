//! Bridges: strips between two runs of boundary edges.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use crate::fairing::{irregular, vector};
use fairmesh::{
    BridgeOptions, Bridged, Error, FillOutcome, LoopKind, OpenReason, Options, Outcome, boundary_loops,
    bridge, self_intersections,
};
use fairmesh_shapes::{Shape, in_parts, sphere_with_hole};

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

fn options(width: Option<f64>, fill: bool) -> BridgeOptions {
    let mut options = BridgeOptions {
        width,
        fill,
        ..BridgeOptions::default()
    };
    options.filling.fairing = Options {
        threads: 1,
        ..Options::default()
    };
    options
}

/// The strip is faired and converged; nothing intersects; every edge has two triangles that agree, or one; G1 at both ends.
fn check(name: &str, (x, t): &Mesh, bridged: &Bridged) {
    let report = &bridged.strip;
    let ended = report.fairing.as_ref().map(|fairing| &fairing.outcome);
    assert_eq!(
        (&report.outcome, ended),
        (&FillOutcome::Faired, Some(&Outcome::Converged)),
        "{name}"
    );
    assert!(report.self_intersections.is_empty(), "{name}");
    assert_eq!(bridged.positions[..x.len()], x[..], "{name}");
    assert_eq!(bridged.triangles[..t.len()], t[..], "{name}");
    assert_eq!(bridged.parents.len(), bridged.positions.len() - x.len(), "{name}");
    for parents in &bridged.parents {
        assert!(parents.vertices.iter().all(|&v| (v as usize) < x.len()), "{name}");
        let sum: f64 = parents.weights.iter().sum();
        assert!(
            (sum - 1.0).abs() < 1e-12 && parents.weights.iter().all(|&w| w >= 0.0),
            "{name}"
        );
    }
    let mut edges = BTreeMap::new();
    for (i, t) in bridged.triangles.iter().enumerate() {
        for k in 0..3 {
            let edge = (t[k], t[(k + 1) % 3]);
            assert!(edges.insert(edge, i).is_none(), "{name}: edge {edge:?} twice");
        }
    }
    // Neither chain is boundary any more.
    for chain in &bridged.chains {
        for pair in chain.windows(2) {
            let both = [(pair[0], pair[1]), (pair[1], pair[0])];
            assert!(
                both.iter().all(|edge| edges.contains_key(edge)),
                "{name}: {pair:?} is open"
            );
        }
    }
    assert!(
        self_intersections(&bridged.positions, &bridged.triangles, None)
            .unwrap()
            .is_empty(),
        "{name}"
    );
}

/// A sheet of `n` by `m` squares, each divided into two triangles, whose vertex (i, j) lies at `at(i / n, j / m)`.
fn sheet(n: u32, m: u32, at: impl Fn(f64, f64) -> [f64; 3]) -> Mesh {
    let number = |i: u32, j: u32| i * (m + 1) + j;
    let places = (0..=n).flat_map(|i| (0..=m).map(move |j| (i, j)));
    let x = places.map(|(i, j)| at(f64::from(i) / f64::from(n), f64::from(j) / f64::from(m)));
    let squares = (0..n).flat_map(|i| (0..m).map(move |j| (i, j)));
    let t = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [
            number(i, j),
            number(i + 1, j),
            number(i + 1, j + 1),
            number(i, j + 1),
        ];
        [[a, b, c], [a, c, d]]
    });
    (x.collect(), t.collect())
}

/// Two meshes as one, and the number of the second one's first vertex.
fn both((mut x, mut t): Mesh, second: Mesh) -> (Mesh, u32) {
    let first = x.len() as u32;
    x.extend(second.0);
    t.extend(second.1.into_iter().map(|t| t.map(|v| first + v)));
    ((x, t), first)
}

fn run((x, t): &Mesh, chains: [&[u32]; 2], options: &BridgeOptions) -> Bridged {
    bridge(x, t, chains, options).expect("a sound call")
}

fn sphere_hole(n: usize, seed: u64, half_angle: f64) -> Mesh {
    let low = -half_angle.to_radians().cos();
    let shape: Shape = in_parts(&sphere_with_hole(1.0, n, irregular(seed), 0), |p| {
        (p[2] > low).then_some(0)
    });
    (shape.positions, shape.triangles)
}

/// A vertex of the longest boundary loop in the middle of one of its halves, and that of the other one.
fn across((x, t): &Mesh) -> [u32; 2] {
    let loops = boundary_loops(x, t).unwrap();
    let longest = loops.iter().max_by(|a, b| a.length.total_cmp(&b.length)).unwrap();
    [longest.vertices[0], longest.vertices[longest.vertices.len() / 2]]
}

fn off_sphere(mesh: &Mesh, bridged: &Bridged) -> f64 {
    let new = &bridged.positions[mesh.0.len()..];
    new.iter()
        .map(|p| (vector(p).norm() - 1.0).abs())
        .fold(0.0, f64::max)
}

#[test]
fn a_bridge_over_a_hole_of_a_sphere_lies_on_it_and_the_rest_is_filled() {
    // The sides are cubics: over 120 degrees they leave the circle by half a per cent.
    for (n, seed, half_angle, most) in [
        (3_000, 1, 25.0, 1e-3),
        (3_000, 2, 40.0, 1e-3),
        (6_000, 3, 60.0, 6e-3),
    ] {
        let mesh = sphere_hole(n, seed, half_angle);
        let [a, b] = across(&mesh);
        let strip = run(&mesh, [&[a], &[b]], &options(Some(0.25), false));
        check("strip", &mesh, &strip);
        let loops = boundary_loops(&strip.positions, &strip.triangles).unwrap();
        let before = boundary_loops(&mesh.0, &mesh.1).unwrap();
        assert_eq!(loops.len(), before.len() + 1);
        let alone = off_sphere(&mesh, &strip);
        let filled = run(&mesh, [&[a], &[b]], &options(Some(0.25), true));
        assert!(filled.is_success());
        assert_eq!(filled.rest.len(), 2);
        let together = off_sphere(&mesh, &filled);
        println!(
            "hole of {half_angle} degrees: strip {alone:.1e}, filled {together:.1e}, twist {:.1e}",
            strip.twist
        );
        assert!(alone < most, "{alone}");
        assert!(together < 1e-8, "{together}");
        let left = boundary_loops(&filled.positions, &filled.triangles).unwrap();
        assert_eq!(left.len(), before.len() - 1);
        assert_empty!(self_intersections(&filled.positions, &filled.triangles, None).unwrap());
    }
}

#[test]
fn a_bridge_relaxes_no_boundary() {
    let mesh = sphere_hole(3_000, 2, 40.0);
    let [a, b] = across(&mesh);
    let asked = options(Some(0.25), true);
    let mut relaxing = asked.clone();
    relaxing.filling.rim.relax = 3;
    let [one, other] = [asked, relaxing].map(|options| run(&mesh, [&[a], &[b]], &options));
    assert_eq!(other.positions, one.positions);
    assert_all!(other.rest.iter(), |report| report.rim.is_none());
}

#[test]
fn a_single_edge_of_a_jagged_boundary_leads_straight_across() {
    for seed in 1..6 {
        let mesh = sphere_hole(3_000, seed, 35.0);
        let loops = boundary_loops(&mesh.0, &mesh.1).unwrap();
        let hole = loops.iter().max_by(|a, b| a.length.total_cmp(&b.length)).unwrap();
        let n = hole.vertices.len();
        for i in [0, n / 5, n / 3] {
            let edge = |i: usize| [hole.vertices[i % n], hole.vertices[(i + 1) % n]];
            let bridged = run(&mesh, [&edge(i), &edge(i + n / 2)], &options(None, false));
            check("jagged", &mesh, &bridged);
            let error = off_sphere(&mesh, &bridged);
            println!("{seed}, edge {i}: {error:.1e}");
            assert!(error < 1e-2, "{error}");
        }
    }
}

#[test]
fn a_bridge_in_a_plane_stays_in_it() {
    let plate = |x: f64| move |u: f64, v: f64| [x + u, 0.7 * v - 0.3, 0.0];
    let (mesh, second) = both(sheet(10, 7, plate(0.0)), sheet(10, 7, plate(2.3)));
    // Whole ends, one named backwards; and parts of different lengths.
    let end: Vec<u32> = (80..88).collect();
    let start: Vec<u32> = (second..second + 8).rev().collect();
    for (name, chains) in [
        ("ends", [&end[..], &start]),
        ("parts", [&end[1..4], &start[3..6]]),
    ] {
        let bridged = run(&mesh, chains, &options(None, false));
        check(name, &mesh, &bridged);
        let new = &bridged.positions[mesh.0.len()..];
        let height = new.iter().map(|p| p[2].abs()).fold(0.0, f64::max);
        assert!(height < 1e-14, "{name}: {height}");
        assert_below!(bridged.twist.abs(), 1e-9);
        if name == "ends" {
            // It goes on from both plates.
            let aside = new.iter().map(|p| (p[1] - 0.05).abs()).fold(0.0, f64::max);
            assert!(aside < 0.35 + 1e-12, "{aside}");
        }
    }
}

#[test]
fn a_bridge_between_two_ends_of_a_cylinder_is_a_part_of_it() {
    let tube = |from: f64| {
        let around = 60;
        let (mut x, mut t) = sheet(around, 20, |u, v| {
            let (sin, cos) = (TAU * u).sin_cos();
            [cos, sin, from + 2.0 * v]
        });
        let last = 21 * around;
        t.iter_mut()
            .flatten()
            .filter(|v| **v >= last)
            .for_each(|v| *v -= last);
        x.truncate(last as usize);
        (x, t)
    };
    let (mesh, second) = both(tube(0.0), tube(3.0));
    let upper: Vec<u32> = (5..15).map(|i| 21 * i + 20).collect();
    let lower: Vec<u32> = (5..15).map(|i| second + 21 * i).collect();
    let bridged = run(&mesh, [&upper, &lower], &options(None, false));
    check("cylinder", &mesh, &bridged);
    let new = &bridged.positions[mesh.0.len()..];
    let error = new
        .iter()
        .map(|p| (p[0].hypot(p[1]) - 1.0).abs())
        .fold(0.0, f64::max);
    println!("off the cylinder: {error:.1e}");
    assert!(error < 3e-3, "{error}");
    // The rest of the gap is one loop.
    let filled = run(&mesh, [&upper, &lower], &options(None, true));
    assert!(filled.is_success(), "{:?}", filled.whole.map(|of| of.outcome));
    let new = &filled.positions[mesh.0.len()..];
    let error = new
        .iter()
        .map(|p| (p[0].hypot(p[1]) - 1.0).abs())
        .fold(0.0, f64::max);
    println!("filled: {error:.1e}");
    assert!(error < 5e-3, "{error}");
    assert_eq!(
        boundary_loops(&filled.positions, &filled.triangles)
            .unwrap()
            .len(),
        2
    );
}

#[test]
fn parallel_plates_get_a_round_edge_unless_they_face_the_same_way() {
    let plate = |z: f64, sign: f64| move |u: f64, v: f64| [-u, sign * (v - 0.5), z];
    let round = both(sheet(8, 8, plate(0.5, -1.0)), sheet(8, 8, plate(-0.5, 1.0)));
    let (mesh, second) = round;
    let [upper, lower] = [0, second].map(|first| (first..first + 9).collect::<Vec<u32>>());
    let bridged = run(&mesh, [&upper, &lower], &options(None, false));
    check("round", &mesh, &bridged);
    assert!(bridged.twist.abs() < 1e-6, "{}", bridged.twist);
    // Half a cylinder but for the sides' cubics, which are circles to a few per cent.
    let new = &bridged.positions[mesh.0.len()..];
    let error = new
        .iter()
        .map(|p| (p[0].hypot(p[2]) - 0.5).abs())
        .fold(0.0, f64::max);
    println!("off half a cylinder: {error:.1e}");
    assert!(error < 0.03, "{error}");

    let (mesh, second) = both(sheet(8, 8, plate(0.5, 1.0)), sheet(8, 8, plate(-0.5, 1.0)));
    let [upper, lower] = [0, second].map(|first| (first..first + 9).collect::<Vec<u32>>());
    let refused = run(&mesh, [&upper, &lower], &options(None, true));
    let FillOutcome::LeftOpen(OpenReason::OppositeSides { .. }) = refused.strip.outcome else {
        panic!("{:?}", refused.strip.outcome);
    };
    assert_eq!((refused.positions, refused.triangles), mesh);
    assert_empty!(refused.parents);
    assert_empty!(refused.sides[0]);
}

#[test]
fn twisted_ends_get_a_twisted_strip() {
    for degrees in [30.0f64, 60.0, 90.0] {
        let plate = sheet(8, 8, |u, v| [u, v - 0.5, 0.0]);
        let (sin, cos) = degrees.to_radians().sin_cos();
        let turned = sheet(8, 8, |u, v| [3.0 + u, (v - 0.5) * cos, (v - 0.5) * sin]);
        let (mesh, second) = both(plate, turned);
        let end: Vec<u32> = (72..81).collect();
        let start: Vec<u32> = (second..second + 9).collect();
        let bridged = run(&mesh, [&end, &start], &options(None, false));
        check("twisted", &mesh, &bridged);
        assert!((bridged.twist.abs() - degrees).abs() < 1e-6, "{}", bridged.twist);
        // A half turn about the line through both middles takes the strip onto itself.
        let new = &bridged.positions[mesh.0.len()..];
        let nearest = |p: [f64; 3]| {
            let distance = |q: &[f64; 3]| (vector(q) - vector(&p)).norm();
            new.iter().map(distance).fold(f64::INFINITY, f64::min)
        };
        let largest = new
            .iter()
            .map(|p| nearest([p[0], -p[1], -p[2]]))
            .fold(0.0, f64::max);
        assert!(largest < 0.15, "{largest}");
    }
}

#[test]
fn the_order_of_the_ends_and_their_directions_do_not_matter() {
    let mesh = sphere_hole(1_500, 4, 35.0);
    let loops = boundary_loops(&mesh.0, &mesh.1).unwrap();
    let hole = loops.iter().max_by(|a, b| a.length.total_cmp(&b.length)).unwrap();
    let n = hole.vertices.len();
    let first = &hole.vertices[..5];
    let second = &hole.vertices[n / 2..n / 2 + 5];
    let backwards: Vec<u32> = second.iter().rev().copied().collect();
    let one = run(&mesh, [first, second], &options(None, false));
    let other = run(&mesh, [first, &backwards], &options(None, false));
    check("order", &mesh, &one);
    assert_eq!(one.positions, other.positions);
    assert_eq!(one.triangles, other.triangles);
    let swapped = run(&mesh, [second, first], &options(None, false));
    check("swapped", &mesh, &swapped);
    let shift = off_sphere(&mesh, &one) - off_sphere(&mesh, &swapped);
    assert!(shift.abs() < 1e-5, "{shift}");
    assert_eq!(one.strip.loops.len(), 1);
    assert_eq!(loops[one.strip.index].kind, LoopKind::Hole);
    for threads in [2, 3] {
        let mut options = options(None, false);
        options.filling.fairing.threads = threads;
        assert_eq!(run(&mesh, [first, second], &options).positions, one.positions);
    }
}

#[test]
fn a_width_is_met_about_the_middle() {
    let (mesh, second) = both(
        sheet(4, 20, |u, v| [u, 2.0 * v, 0.0]),
        sheet(4, 20, |u, v| [2.0 + u, 2.0 * v, 0.0]),
    );
    // The 11th vertex of 21 at either end.
    let (a, b) = (84 + 10, second + 10);
    for (width, edges) in [(0.01, 1), (0.4, 4), (0.62, 6), (1.0, 10)] {
        let bridged = run(&mesh, [&[a], &[b]], &options(Some(width), false));
        for chain in &bridged.chains {
            let got = chain.len() - 1;
            assert!(got == edges || width < 0.1 && got < 3, "{width}: {got} edges");
        }
        check("width", &mesh, &bridged);
        // The same from a run that is longer, or shorter.
        let longer: Vec<u32> = (84 + 3..=84 + 17).collect();
        let other = run(&mesh, [&longer, &[b]], &options(Some(width), false));
        assert_eq!(other.chains, bridged.chains);
        assert_eq!(other.positions, bridged.positions);
    }
}

#[test]
fn chains_that_are_none_are_refused_by_name() {
    let mesh = sheet(4, 4, |u, v| [u, v, (PI * u).sin()]);
    let refused = |chains: [&[u32]; 2], width: Option<f64>| {
        bridge(&mesh.0, &mesh.1, chains, &options(width, false)).unwrap_err()
    };
    let good: &[u32] = &[0, 1];
    for (chain, vertex, why) in [
        (&[][..], 0, "the chain names no vertex"),
        (&[20], 20, "one vertex is no chain unless a width is given"),
        (&[6, 7], 6, "it is on no boundary loop"),
        (&[20, 22], 22, "it is not the next one along a boundary loop"),
        (&[20, 21, 20], 20, "it is not the next one along a boundary loop"),
        (&[20, 99], 99, "there is no such vertex"),
    ] {
        let expected = Error::BadChain {
            chain: 1,
            vertex,
            why,
        };
        assert_eq!(refused([good, chain], None), expected);
        assert_eq!(
            refused([chain, good], None),
            Error::BadChain {
                chain: 0,
                vertex,
                why
            }
        );
    }
    let common = refused([good, &[1, 2]], None);
    assert!(common.to_string().contains("both chains have it"), "{common}");
    let wide = refused([&[0], &[24]], Some(7.0));
    assert!(wide.to_string().contains("both chains have it"), "{wide}");
    let bad = refused([good, &[23, 24]], Some(-1.0));
    assert!(matches!(bad, Error::BadOption { name: "width", .. }), "{bad}");
}
