//! The long tier, run by `./test.sh long`: a million vertices, and many meshes.

use crate::fairing::*;
use fairmesh::{Options, Outcome};
use fairmesh_shapes::*;

#[test]
#[ignore = "long tier"]
fn a_million_vertices() {
    let shape = sphere_cap(60.0, 1_000_000, irregular(1), OUTSIDE);
    let all_threads = Options {
        threads: 0,
        ..options(1e-8)
    };
    let solution = solve(&shape, &flat(&shape), all_threads);
    let error = errors(&shape, &solution).max;
    println!("{} iterations, error {error:.1e}", solution.report.iterations);
    assert_eq!(solution.report.outcome, Outcome::Converged);
    assert!(error < 7e-10, "{error:.1e}");
}

/// Of each kind a hundred triangulations. How many are not solved is pinned: fewer and more are both news.
#[test]
#[ignore = "long tier"]
fn a_hundred_meshes_of_every_kind() {
    type Kind = (&'static str, fn(u64) -> Shape, f64, usize);
    let kinds: [Kind; 6] = [
        ("cap", |s| sphere_cap(60.0, 1_000, irregular(s), OUTSIDE), 1e-6, 0),
        (
            "zone",
            |s| sphere_zone(-40.0, 50.0, 1_000, irregular(s), OUTSIDE),
            1e-6,
            0,
        ),
        (
            "cylinder",
            |s| cylinder_band(1_000, irregular(s), OUTSIDE),
            4e-4,
            0,
        ),
        (
            "catenoid",
            |s| catenoid_band(1_000, irregular(s), OUTSIDE),
            4e-4,
            0,
        ),
        (
            "unduloid",
            |s| unduloid_band(0.5, 1.0, 1_000, irregular(s), OUTSIDE),
            4e-4,
            0,
        ),
        (
            "hole of 30 degrees",
            |s| sphere_with_hole(30.0, 1_000, irregular(s), OUTSIDE),
            1e-6,
            0,
        ),
    ];
    let mut bars = Bars::default();
    for (name, make, bar, failures) in kinds {
        let (mut failed, mut worst) = (Vec::new(), 0.0f64);
        for seed in 1..=100 {
            let shape = make(seed);
            let solution = solve(&shape, &flat(&shape), options(1e-8));
            if solution.report.outcome == Outcome::Converged {
                worst = worst.max(errors(&shape, &solution).max);
            } else {
                failed.push((seed, solution.report.outcome.name()));
            }
        }
        println!("{name}: not converged {failed:?}, errors up to {worst:.1e}");
        bars.at_most(name, worst, bar);
        bars.check(
            name,
            failed.len() == failures,
            format!("{} not converged: {failed:?}", failed.len()),
        );
    }
    bars.finish();
}
