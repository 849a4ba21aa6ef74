//! OpenMesh's smoother and fairmesh on surfaces that are known: what README and docs/openmesh.md say holds in any one run.
#![allow(clippy::print_stdout, reason = "the measured figures, for --nocapture")]

#[path = "../comparison/mod.rs"]
#[allow(dead_code, reason = "the report uses the rest")]
mod comparison;

use comparison::*;
use fairmesh::{Options, Selection, fair};
use fairmesh_shapes::{OUTSIDE, Sampling, sphere_cap};
use openmesh_sys::openmesh::{Mesh, Smoothing};

/// How many times closer than the smoother's best: on the sphere, and elsewhere.
const CLOSER: [f64; 2] = [1_000.0, 20.0];

/// On every surface and triangulation, seeing the same arrays: closer by far. The times are printed.
#[test]
fn ours_is_closer() {
    let mut missed = Vec::new();
    for surface in SURFACES {
        for triangulation in triangulations() {
            let case = case(surface, triangulation, 1_000);
            let (smoother, limit) = (case.smoother(), case.limit());
            let (theirs, ours) = (best(&smoother), case.ours());
            let what = format!("{surface}, {}", triangulation.0);
            println!(
                "{what}: rms {:.1e} after {} iterations and {:.3} s, in the limit {:.1e}, ours {:.1e} after {:.3} s",
                theirs.rms, theirs.iterations, theirs.seconds, limit.rms, ours.rms, ours.seconds
            );
            let bar = CLOSER[usize::from(surface != "sphere")];
            // Where the smoother would end is closer than where it is; on a lattice that is conformal, as the regular
            // catenoid's, the linear equations are nearly right.
            let runs = smoother.iter().map(|run| (run, bar)).chain([(&limit, 1.0)]);
            for (run, bar) in runs {
                for (measure, ratio) in [("largest", run.max / ours.max), ("rms", run.rms / ours.rms)] {
                    if ratio.is_nan() || ratio < bar {
                        missed.push(format!("{what}: {measure} distance: {ratio:.1} times closer"));
                    }
                }
            }
            if !ours.converged {
                missed.push(format!("{what}: not converged"));
            }
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

/// The smoother's operator is the square of I - D⁻¹A with equal weights: run until it stands still, it is where a direct
/// solve of that system is.
#[test]
fn the_smoother_ends_where_the_uniform_bilaplacian_vanishes() {
    for seed in 1..4 {
        let shape = sphere_cap(60.0, 60, Sampling::Irregular { seed }, OUTSIDE);
        let direct = stationary(&shape.positions, &shape.triangles, &shape.free);
        let mut mesh = Mesh::<f64>::new(&shape.flat(), &shape.triangles).unwrap();
        mesh.select(&shape.free);
        let distance = |a: &[[f64; 3]], b: &[[f64; 3]]| {
            let apart =
                |(p, q): (&[f64; 3], &[f64; 3])| (0..3).map(|k| (p[k] - q[k]).abs()).fold(0.0, f64::max);
            a.iter().zip(b).map(apart).fold(0.0, f64::max)
        };
        let start = distance(&mesh.positions(), &direct);
        // Till a thousand iterations do nothing but round.
        let mut rounds = 0;
        loop {
            let before = mesh.positions();
            mesh.smooth(Smoothing::c1(1_000)).unwrap();
            rounds += 1;
            if distance(&before, &mesh.positions()) < 1e-14 {
                break;
            }
            assert!(rounds < 1_000, "no end after a million iterations");
        }
        let end = distance(&mesh.positions(), &direct);
        println!("seed {seed}: {start:.1e} at the start, {end:.1e} after {rounds}000 iterations");
        assert!(start > 0.05 && end < 1e-12, "seed {seed}: {end:.1e}");
        // And the sphere is not there.
        let off = direct
            .iter()
            .map(|p| (p.iter().map(|x| x * x).sum::<f64>().sqrt() - 1.0).abs());
        assert!(off.fold(0.0, f64::max) > 0.01);
    }
}

/// A mesh of floats faired gives, to the rounding of floats, what the same mesh of doubles gives.
#[test]
fn floats_are_rounded_doubles() {
    let case = case("sphere", triangulations()[1], 1_000);
    let triangles = &case.shape.triangles;
    let floats = Mesh::<f32>::new(&case.start, triangles).unwrap();
    let solved = |start: &[[f64; 3]]| {
        let options = Options {
            threads: 1,
            ..Options::default()
        };
        fair(start, triangles, Selection::Mask(&case.shape.free), &options)
            .unwrap()
            .positions
    };
    let (single, double) = (solved(&floats.positions()), solved(&case.start));
    let worst = single
        .iter()
        .zip(&double)
        .map(|(a, b)| (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max));
    let worst = worst.fold(0.0, f64::max);
    println!("floats: {worst:.1e}");
    // A fitted normal turns by rounding over the edge length, and moves the middle by that times the radius.
    assert!(worst < 10.0 * f64::from(f32::EPSILON), "{worst:.1e}");
}
