//! The same bits for any number of threads and in every run.

use crate::fairing::*;
use crate::tier::tier;
use fairmesh::{InnerFairness, Options, Report, Seconds, Solution};
use fairmesh_shapes::*;

fn bits(figures: impl IntoIterator<Item = f64>) -> Vec<u64> {
    figures.into_iter().map(f64::to_bits).collect()
}

/// The report without what a clock has measured. Of its figures the ones that may be no number as bits.
fn figures(report: &Report) -> (Report, u64) {
    (
        Report {
            seconds: Seconds::default(),
            step: 0.0,
            ..report.clone()
        },
        report.step.to_bits(),
    )
}

fn assert_same(what: &str, a: &Solution, b: &Solution) {
    let positions = |s: &Solution| bits(s.positions.iter().copied().flatten());
    assert!(positions(a) == positions(b), "{what}: positions differ");
    let curvature = |s: &Solution| bits(s.mean_curvature.iter().map(|h| h.1));
    assert!(curvature(a) == curvature(b), "{what}: mean curvatures differ");
    let normals = |s: &Solution| bits(s.boundary_normals.iter().flat_map(|n| n.1));
    assert!(normals(a) == normals(b), "{what}: boundary normals differ");
    assert_eq!(figures(&a.report), figures(&b.report), "{what}");
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    use InnerFairness::{Conformal, Uniform};
    let n = tier(6_000, 13_000);
    for (name, shape, inner) in [
        ("cap", sphere_cap(60.0, n, irregular(1), OUTSIDE), Uniform),
        ("cylinder", cylinder_band(n, irregular(1), OUTSIDE), Uniform),
        ("blend", cylinder_blend(), Conformal),
        // Conformal weights of a noisy surface: harder means are tried one after the other.
        (
            "rough cylinder",
            cylinder_band(1_000, irregular(1), OUTSIDE),
            Conformal,
        ),
    ] {
        let start = if name == "rough cylinder" {
            shape.noise(1, 0.3)
        } else {
            shape.flat()
        };
        let run = |threads| {
            solve(
                &shape,
                &start,
                Options {
                    inner_fairness: inner,
                    threads,
                    ..options(1e-8)
                },
            )
        };
        let one = run(1);
        println!(
            "{name}: {} iterations, {}",
            one.report.iterations,
            one.report.outcome.name()
        );
        assert_same(&format!("{name}, 1 thread again"), &one, &run(1));
        for threads in [2, 3] {
            assert_same(&format!("{name}, {threads} threads"), &one, &run(threads));
        }
        assert_same(&format!("{name}, 3 threads again"), &one, &run(3));
    }
}
