//! Holes are told from outer boundaries, with noise too.

use fairmesh::{
    Cap, FillOptions, FillOutcome, FlatReason, LoopKind, LoopReport, Loops, OnFailure, Outcome, SharpFate,
    boundary_loops, fill_holes,
};
use fairmesh_shapes::{Sampling, sphere_with_hole};

use crate::holes::largest;

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// A number in -1..1 for each index, of no pattern.
fn noise(seed: u64, index: usize) -> f64 {
    let mut z = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (index as u64).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 31)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z = (z ^ (z >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    ((z ^ (z >> 32)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// A grid of 30 by 30 vertices over a square of side 2, as the graph of a function.
fn sheet(height: fn(f64, f64) -> f64) -> Mesh {
    let x = (0..900).map(|v| {
        let [p, q] = [v % 30, v / 30].map(|i| f64::from(i) / 14.5 - 1.0);
        [p, q, height(p, q)]
    });
    let corners = (0..29).flat_map(|j| (0..29).map(move |i| 30 * j + i));
    let triangles = corners.flat_map(|a| [[a, a + 1, a + 31], [a, a + 31, a + 30]]);
    (x.collect(), triangles.collect())
}

/// Two half planes that meet at a sharp edge, with a hole across it of this half width.
fn roof(half: f64) -> Mesh {
    let (x, t) = sheet(|_, q| -3.0 * q.abs());
    let is_inside = |&v: &u32| x[v as usize][..2].iter().all(|c| c.abs() < half);
    let kept = t.iter().filter(|t| !t.iter().all(is_inside)).copied().collect();
    (x, kept)
}

/// The unit sphere with a hole of so many degrees, half across.
fn sphere(degrees: f64) -> Mesh {
    let shape = sphere_with_hole(degrees, 1000, Sampling::Regular, 0);
    (shape.positions, shape.triangles)
}

/// The mesh with its vertices moved by noise of `amplitude` mean edges, root of the mean square: all, or those of the largest loop.
fn with_noise((x, t): &Mesh, amplitude: f64, only_rim: bool, seed: u64) -> Mesh {
    let length = |t: &[u32; 3]| {
        let [p, q] = [x[t[0] as usize], x[t[1] as usize]];
        (0..3).map(|c| (p[c] - q[c]).powi(2)).sum::<f64>().sqrt()
    };
    let edge = t.iter().map(length).sum::<f64>() / t.len() as f64;
    let loops = boundary_loops(x, t).unwrap();
    let mut rim = vec![!only_rim; x.len()];
    for &v in &loops[largest(x, t)].vertices {
        rim[v as usize] = true;
    }
    let mut moved = x.clone();
    for v in (0..x.len()).filter(|&v| rim[v]) {
        for (c, coordinate) in moved[v].iter_mut().enumerate() {
            *coordinate += 3f64.sqrt() * amplitude * edge * noise(seed, 3 * v + c);
        }
    }
    (moved, t.clone())
}

fn check(name: &str, mesh: &Mesh, kind: LoopKind, amplitude: f64, only_rim: bool) {
    for seed in 1..=3 {
        let (x, t) = with_noise(mesh, amplitude, only_rim, seed);
        let found = boundary_loops(&x, &t).unwrap()[largest(&x, &t)].kind;
        assert_eq!(
            found, kind,
            "{name}, noise {amplitude}, only at the rim: {only_rim}"
        );
    }
}

/// Noise at the rim turned holes of 60 degrees into outer boundaries, and a hilly sheet into a hole without any.
#[test]
fn noisy_holes_are_holes_and_noisy_sheets_have_outer_boundaries() {
    for amplitude in [0.0, 0.1, 0.25, 0.4] {
        for (name, mesh) in [("60 degrees", sphere(60.0)), ("110 degrees", sphere(110.0))] {
            check(name, &mesh, LoopKind::Hole, amplitude, true);
            check(name, &mesh, LoopKind::Hole, amplitude, false);
        }
        for (name, mesh) in [
            ("plane", sheet(|_, _| 0.0)),
            ("bowl", sheet(|p, q| 0.15 * (p * p + q * q))),
            ("saddle", sheet(|p, q| 0.5 * (p * p - q * q))),
            ("hills", sheet(|p, q| 0.2 * (5.0 * p).sin() * (4.0 * q).cos())),
        ] {
            check(name, &mesh, LoopKind::OuterBoundary, amplitude, true);
            check(name, &mesh, LoopKind::OuterBoundary, amplitude.min(0.1), false);
        }
    }
}

/// A filling that only passes over outer boundaries is no success; beside a hole they are none of its business.
#[test]
fn a_sheet_without_holes_is_not_filled_successfully() {
    let (x, mut t) = sheet(|p, q| 0.1 * p * q);
    let alone = fill_holes(&x, &t, &FillOptions::default()).unwrap();
    assert!(alone.loops.iter().all(LoopReport::is_success) && !alone.is_success());
    t.remove(800);
    let filled = fill_holes(&x, &t, &FillOptions::default()).unwrap();
    assert_eq!(filled.loops.len(), 2);
    assert!(filled.loops.iter().all(LoopReport::is_success) && filled.is_success());
    let [x, t] = [&filled.positions.len(), &filled.triangles.len()];
    assert_eq!([*x, *t], [900, 29 * 29 * 2]);
}

/// A hole across an edge that may not go on gets a creased patch, or none that is fair.
#[test]
fn a_patch_across_a_sharp_edge_is_no_success() {
    let (x, t) = roof(0.9);
    let mut options = FillOptions::default();
    options.fairing.sharp = 0.0;
    let filled = fill_holes(&x, &t, &options).unwrap();
    let hole = filled
        .loops
        .iter()
        .find(|l| !matches!(l.outcome, FillOutcome::LeftOpen(_)));
    assert!(!hole.unwrap().is_success() && !filled.is_success(), "{hole:?}");
}

/// Two edges around a strip of one triangle, one as certain as the other: both go on, in whatever way the rounding falls.
#[test]
fn a_narrow_strip_between_two_edges_goes_on() {
    for half in [0.4, 0.9] {
        let (x, t) = roof(half);
        let filled = fill_holes(&x, &t, &FillOptions::default()).unwrap();
        let report = filled.loops.iter().find_map(|l| l.fairing.as_ref()).unwrap();
        assert_eq!(report.outcome, Outcome::Converged);
        assert_eq!(report.sharp_edges.len(), 2);
        assert_all!(report.sharp_edges.iter(), |edge| edge.fate == SharpFate::GoesOn);
        for [_, q, height] in &filled.positions[900..] {
            assert_near!(*height, -3.0 * q.abs().max(0.5 / 14.5), 1e-9);
        }
    }
}

/// A square with a slit of three vertices on a line, and the loop around it.
fn slit() -> (Mesh, Vec<usize>) {
    let x = [[-2, -1], [2, -1], [2, 1], [-2, 1], [-1, 0], [0, 0], [1, 0]]
        .map(|[x, y]| [f64::from(x), f64::from(y), 0.0]);
    let t = [
        [0, 4, 3],
        [3, 4, 5],
        [3, 5, 2],
        [5, 6, 2],
        [1, 2, 6],
        [0, 1, 6],
        [0, 6, 4],
    ];
    let loops = boundary_loops(&x, &t).unwrap();
    let slits = (0..loops.len()).filter(|&l| loops[l].vertices.len() == 3);
    ((x.to_vec(), t.to_vec()), slits.collect())
}

/// A slit has no other patch than a triangle without area.
#[test]
fn a_patch_without_area_is_no_success() {
    let ((x, t), loops) = slit();
    let options = FillOptions {
        loops: Loops::Chosen(loops),
        ..FillOptions::default()
    };
    let filled = fill_holes(&x, &t, &options).unwrap();
    let [slit] = &filled.loops[..] else {
        panic!("{} loops", filled.loops.len());
    };
    assert_eq!((slit.triangles.len(), slit.has_no_area()), (1, true), "{slit:?}");
    assert!(!slit.is_success() && !filled.is_success());
}

/// Whatever a patch is no success for, a crease across a sharp edge, no area, too few iterations, noise or a folded rim: such loops stay open if they
/// shall.
#[test]
fn what_is_no_success_stays_open_if_asked() {
    let all = Loops::UpTo(usize::MAX);
    let ball = sphere(40.0);
    let cases = [
        (roof(0.4), all.clone(), 64, 0),
        (slit().0, Loops::Chosen(slit().1), 64, 0),
        (ball.clone(), all.clone(), 1, 0),
        (with_noise(&ball, 0.5, false, 1), all.clone(), 64, 0),
        // These rims are folded; beside the first the patch converges.
        (with_noise(&ball, 0.3, false, 0), all.clone(), 64, 1),
        (with_noise(&ball, 0.8, false, 2), all, 64, 1),
    ];
    for (k, ((x, t), loops, max_iterations, relax)) in cases.into_iter().enumerate() {
        let with = |on_failure: OnFailure| {
            let mut options = FillOptions {
                loops: loops.clone(),
                on_failure,
                ..FillOptions::default()
            };
            (options.fairing.max_iterations, options.rim.relax) = (max_iterations, relax);
            options.fairing.sharp = 0.0;
            fill_holes(&x, &t, &options).unwrap()
        };
        let [linear, flat, open] = [OnFailure::Best, OnFailure::Flat, OnFailure::Open].map(with);
        let mut failed = 0;
        for ((linear, flat), open) in linear.loops.iter().zip(&flat.loops).zip(&open.loops) {
            let is_open = |of: &LoopReport| matches!(of.outcome, FillOutcome::LeftOpen(_));
            let is_faired =
                |of: &LoopReport| matches!(of.outcome, FillOutcome::Faired | FillOutcome::LeastBending);
            failed += usize::from(!linear.is_success());
            assert_eq!(
                is_open(open),
                is_open(linear) || !linear.is_success(),
                "{k}: {open:?}"
            );
            if !linear.is_success() && linear.rim.is_none() {
                assert!(!is_faired(flat), "{k}: {flat:?}");
            }
        }
        assert_eq!((open.positions, open.triangles), (x, t), "{k}");
        assert_eq!(failed, 1, "{k}");
    }
}

#[test]
fn a_hole_of_140_degrees_is_a_hole() {
    for amplitude in [0.0, 0.1] {
        check("140 degrees", &sphere(140.0), LoopKind::Hole, amplitude, true);
        check("140 degrees", &sphere(140.0), LoopKind::Hole, amplitude, false);
    }
}

/// A tube of so many sides about the z axis, cut off at z = 0 and closed with a fan at its other end, moved, turned and scaled.
fn cut_off(sides: u32, scale: f64) -> Mesh {
    let rows = 12;
    let ring = |row: u32| {
        (0..sides).map(move |k| {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(sides);
            [angle.cos(), angle.sin(), f64::from(row) / 6.0]
        })
    };
    let end = [[0.0, 0.0, f64::from(rows) / 6.0]];
    let x = (0..=rows).flat_map(ring).chain(end);
    let turned =
        |[x, y, z]: [f64; 3]| [0.8 * x - 0.6 * z + 3.0, y - 7.0, 0.6 * x + 0.8 * z].map(|c| scale * c);
    let at = |row: u32, k: u32| row * sides + k % sides;
    let sides_of = |row: u32| {
        (0..sides).flat_map(move |k| {
            let [a, b, c, d] = [at(row, k), at(row, k + 1), at(row + 1, k), at(row + 1, k + 1)];
            [[a, b, d], [a, d, c]]
        })
    };
    let fan = (0..sides).map(|k| [at(rows, k), at(rows, k + 1), at(rows + 1, 0)]);
    (
        x.map(turned).collect(),
        (0..rows).flat_map(sides_of).chain(fan).collect(),
    )
}

#[test]
fn a_part_that_was_cut_off_gets_a_flat_cap_where_that_is_asked() {
    for (sides, scale) in [(6, 1.0), (24, 1e-6), (40, 1e6)] {
        let (x, t) = cut_off(sides, scale);
        let options = FillOptions {
            loops: Loops::Chosen(vec![0]),
            cap: Cap::Flat,
            ..FillOptions::default()
        };
        let filled = fill_holes(&x, &t, &options).unwrap();
        let report = &filled.loops[0];
        let flat = FillOutcome::Flat {
            reason: FlatReason::Planar,
        };
        assert_eq!((&report.outcome, report.is_success()), (&flat, true));
        let back = |p: &[f64; 3]| 0.8 * p[2] / scale - 0.6 * (p[0] / scale - 3.0);
        let off = report
            .vertices
            .clone()
            .map(|v| back(&filled.positions[v as usize]).abs());
        assert!(
            off.fold(0.0, f64::max) < 1e-14,
            "{sides} sides are not closed by their plane"
        );
        assert!(
            report.worst_angle > 25.0
                && boundary_loops(&filled.positions, &filled.triangles)
                    .unwrap()
                    .is_empty()
        );
    }
}

#[test]
fn a_loop_in_no_plane_gets_the_same_patch_whatever_the_cap() {
    let (x, t) = with_noise(&sphere(40.0), 0.1, true, 1);
    let [fair, flat] = [Cap::Fair, Cap::Flat].map(|cap| {
        let options = FillOptions {
            cap,
            ..FillOptions::default()
        };
        fill_holes(&x, &t, &options).unwrap()
    });
    assert_eq!(fair.loops[0].outcome, FillOutcome::Faired);
    assert_eq!(fair.positions, flat.positions);
}
