//! Coarse to fine: where there are two surfaces the right one, where there is none the nearest member of the family, and neither hangs
//! on the interior of the input.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::boundary::tilted;
use crate::fairing::*;
use fairmesh::{AttemptEnd, InnerFairness, Options, Outcome, Report, Selection, Solution, fair};
use fairmesh_shapes::*;

/// The cylinder of radius 1, free over this length.
fn cylinder_of(length: f64, n: usize, sampling: Sampling) -> Shape {
    let profile = HarmonicProfile::new(FRAC_PI_2, -0.5, 0.0, length).unwrap();
    revolution_band(&profile, n, sampling, OUTSIDE).unwrap()
}

fn largest_distance(shape: &Shape, solution: &Solution) -> f64 {
    let surface = shape.surface.as_ref().unwrap();
    let free = shape.free_vertices().into_iter();
    free.map(|v| surface.distance(solution.positions[v as usize]))
        .fold(0.0, f64::max)
}

/// Beside the cylinder there is an unduloid with a neck, from 4.3 radii on, which the linear start leads to.
#[test]
fn between_the_ends_of_a_tube_the_cylinder_is_found_and_no_hourglass() {
    for (length, n, sampling) in [
        (4.5, 500, Sampling::Regular),
        (5.0, 600, irregular(2)),
        (5.0, 3000, irregular(3)),
        (5.5, 3000, Sampling::Regular),
    ] {
        let shape = cylinder_of(length, n, sampling);
        let solution = solve(&shape, &flat(&shape), options(1e-8));
        let (report, error) = (&solution.report, largest_distance(&shape, &solution));
        println!("{length} radii, {n}: {:?} {error:.1e}", report.outcome);
        assert!(report.outcome.is_success() && error < 0.01, "{length} radii, {n}");
        // That of the whole band, but for half a row of vertices at each end.
        let energy = report.quality.bending_energy / (0.25 * 2.0 * PI * length);
        assert!((0.9..1.03).contains(&energy), "{energy}");
    }
}

/// Of the attempts on the coarse mesh, those at harmonic surfaces.
fn coarse_energies(report: &Report, free: usize) -> Vec<f64> {
    let attempts = report.components[0].attempts.iter();
    let coarse = attempts
        .filter(|a| a.free_vertices < free && a.end == AttemptEnd::Sound && a.name != "minimal energy");
    coarse.map(|a| a.bending_energy).collect()
}

#[test]
fn attempts_tell_what_was_tried_on_which_mesh() {
    let shape = cylinder_of(4.5, 3000, irregular(3));
    let report = solve(&shape, &flat(&shape), options(1e-8)).report;
    let attempts = &report.components[0].attempts;
    let last = attempts.last().unwrap();
    assert_eq!(
        (last.free_vertices, last.end),
        (shape.free_count(), AttemptEnd::Sound)
    );
    assert_eq!(last.name, "from the coarse mesh");
    assert_eq!(last.iterations, report.iterations);
    assert!((last.bending_energy / report.quality.bending_energy - 1.0).abs() < 1e-6);
    let energies = coarse_energies(&report, shape.free_count());
    let least = energies.iter().copied().fold(f64::INFINITY, f64::min);
    assert!((least / last.bending_energy - 1.0).abs() < 0.1, "{energies:?}");
}

#[test]
fn where_no_harmonic_surface_is_found_the_nearest_member_is_the_answer() {
    for (shape, degrees) in [
        (cylinder_blend(), -40.0),
        (cylinder_blend_of(920, irregular(1)), -50.0),
        (cylinder_blend_of(3000, irregular(1)), -40.0),
    ] {
        let given = tilted(&shape, degrees);
        let solve_from = |start: &[[f64; 3]]| solve_given(&shape, start, &given, options(1e-8));
        let solution = solve_from(&shape.positions);
        let report = &solution.report;
        let Outcome::NearestMember { weight } = report.outcome else {
            panic!("{:?}", report.outcome);
        };
        println!(
            "{} free: w = {weight}, {} iterations",
            shape.free_count(),
            report.iterations
        );
        assert!(weight > 0.0 && weight <= 1.0 && !report.linear_surface);
        assert!(report.step <= 1e-8 && report.quality.is_sound());
        // Normals are met as triangles can.
        assert!(report.quality.normal_deviation_rms < 13.0, "{:?}", report.quality);
        assert_eq!(solve_from(&shape.random(7)).positions, solution.positions);
    }
}

#[test]
fn a_large_region_does_not_hang_on_the_interior_of_the_input() {
    let shape = sphere_cap(110.0, 3000, irregular(4), OUTSIDE);
    let solutions = starts(&shape, 9).map(|(_, start)| solve(&shape, &start, options(1e-8)));
    assert!(solutions[0].report.outcome.is_success());
    assert!(solutions[0].report.components[0].attempts[0].free_vertices < shape.free_count());
    for solution in &solutions[1..] {
        assert_eq!(solution.positions, solutions[0].positions);
    }
}

/// A tube over a short boundary, closed at its end: its vertices come to lie in a flat disk, ever smaller towards the middle.
fn ear(around: u32, rows: u32) -> (Vec<[f64; 3]>, Vec<[u32; 3]>, Vec<bool>) {
    let chart_row = |row: u32, r: f64, z: f64| {
        (0..around).map(move |j| {
            let angle = 2.0 * PI * (f64::from(j) + 0.5 * f64::from(row % 2)) / f64::from(around);
            [r * angle.cos(), r * angle.sin(), z]
        })
    };
    let edge = 2.0 * PI / f64::from(around);
    let outside = 4;
    let mut positions = Vec::new();
    for row in 0..=outside + rows {
        let (r, z) = if row < outside {
            (1.0 + f64::from(outside - row) * edge, 0.0)
        } else {
            (1.0, f64::from(row - outside) * edge * 0.87)
        };
        positions.extend(chart_row(row, r, z));
    }
    let mut triangles = Vec::new();
    for row in 0..outside + rows {
        for j in 0..around {
            let next = (j + 1) % around;
            let at = |row: u32, j: u32| row * around + j;
            let (a, b, c, d) = (at(row, j), at(row, next), at(row + 1, j), at(row + 1, next));
            if row % 2 == 0 {
                triangles.extend([[a, b, c], [b, d, c]]);
            } else {
                triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
    }
    let pole = positions.len() as u32;
    positions.push([0.0, 0.0, f64::from(rows) * edge * 0.87 + 0.1]);
    let last = (outside + rows) * around;
    triangles.extend((0..around).map(|j| [last + j, last + (j + 1) % around, pole]));
    let first_free = (outside + 1) * around;
    (
        positions,
        triangles,
        (0..=pole).map(|v| v >= first_free).collect(),
    )
}

#[test]
fn an_ear_with_many_vertices_behind_a_short_boundary_becomes_a_disk() {
    for (around, rows) in [(24, 12), (32, 30)] {
        let (positions, triangles, free) = ear(around, rows);
        for inner_fairness in [InnerFairness::Uniform, InnerFairness::Conformal] {
            let options = Options {
                inner_fairness,
                ..options(1e-8)
            };
            let solution = fair(&positions, &triangles, Selection::Mask(&free), &options).unwrap();
            let highest = solution.positions.iter().fold(0.0f64, |h, p| h.max(p[2].abs()));
            println!(
                "{around} around, {rows} rows: {:?}, {highest:.1e}",
                solution.report.outcome
            );
            assert!(
                solution.report.outcome.is_success() && highest < 1e-6,
                "{around} {rows}"
            );
        }
    }
}
