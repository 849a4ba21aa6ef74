//! The long tier, run by `./test.sh long`: a million vertices, and many meshes.

use std::ops::RangeInclusive;

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

/// Of each kind a hundred triangulations. How many are not solved is pinned, but for a few that hang on rounding: fewer and
/// more are both news.
#[test]
#[ignore = "long tier"]
fn a_hundred_meshes_of_every_kind() {
    type Kind = (&'static str, fn(u64) -> Shape, f64, RangeInclusive<usize>);
    let cap = |seed| sphere_cap(60.0, 1_000, irregular(seed), OUTSIDE);
    let zone = |seed| sphere_zone(-40.0, 50.0, 1_000, irregular(seed), OUTSIDE);
    let cylinder = |seed| cylinder_band(1_000, irregular(seed), OUTSIDE);
    let catenoid = |seed| catenoid_band(1_000, irregular(seed), OUTSIDE);
    let unduloid = |seed| unduloid_band(0.5, 1.0, 1_000, irregular(seed), OUTSIDE);
    let hole = |seed| sphere_with_hole(30.0, 1_000, irregular(seed), OUTSIDE);
    let kinds: [Kind; 6] = [
        ("cap", cap, 7e-10, 0..=0),
        ("zone", zone, 1e-9, 0..=0),
        ("cylinder", cylinder, 5e-5, 0..=0),
        ("catenoid", catenoid, 2e-4, 0..=0),
        ("unduloid", unduloid, 6e-4, 0..=0),
        ("hole of 30 degrees", hole, 4e-9, 0..=4),
    ];
    let mut bars = Bars::default();
    for (name, make, bar, failures) in kinds {
        let (mut failed, mut worst) = (0, 0.0f64);
        for seed in 1..=100 {
            let shape = make(seed);
            let solution = solve(&shape, &flat(&shape), options(1e-8));
            if solution.report.outcome == Outcome::Converged {
                worst = worst.max(errors(&shape, &solution).max);
            } else {
                failed += 1;
            }
        }
        println!("{name}: {failed} not converged, errors up to {worst:.1e}");
        bars.at_most(name, worst, bar);
        let what = format!("{failed} of 100 not converged, were {failures:?}");
        bars.check(name, failures.contains(&failed), what);
    }
    bars.finish();
}
