//! Fixed vertices inside the region: interpolated points and curves, with normals or without.

use crate::fairing::*;
use crate::tier::tier;
use fairmesh::{BoundaryNormals, Discretization, InnerFairness, InteriorNormals, Options, Solution, Target};
use fairmesh_shapes::*;

/// Fixes a curve of edges: the lowest vertices above the height `z`. No triangle is left without a free vertex.
fn fix_curve(shape: &mut Shape, z: f64) -> Vec<u32> {
    let above = |v: u32, shape: &Shape| shape.positions[v as usize][2] > z - 1e-9;
    let mut on = vec![false; shape.free.len()];
    for t in &shape.triangles {
        let lower = t.iter().any(|&v| !above(v, shape));
        for &v in t
            .iter()
            .filter(|v| lower && above(**v, shape) && shape.free[**v as usize])
        {
            on[v as usize] = true;
        }
    }
    for t in &shape.triangles {
        if t.iter().all(|&v| on[v as usize]) {
            let height = |v: &&u32| shape.positions[**v as usize][2];
            let highest = t.iter().max_by(|a, b| height(a).total_cmp(&height(b)));
            highest.iter().for_each(|v| on[**v as usize] = false);
        }
    }
    fix(shape, |v, _| on[v])
}

/// The normals of the outer boundary only.
fn outer_normals(shape: &Shape, inside: &[u32]) -> Vec<(u32, [f64; 3])> {
    let mut normals = shape.boundary_normals();
    normals.retain(|(v, _)| !inside.contains(v));
    normals
}

/// Solves from a flattened interior with constraint points where they are.
fn solve_smooth(shape: &Shape, inside: &[u32], tolerance: f64) -> Solution {
    solve_given(
        shape,
        &flat(shape),
        &outer_normals(shape, inside),
        options(tolerance),
    )
}

fn summary(name: &str, solution: &Solution) {
    let report = &solution.report;
    println!(
        "{name}: {} iterations, {:?}, defect {:.1e}, angle {:.1}",
        report.iterations, report.outcome, report.defect, report.quality.worst_angle
    );
}

#[test]
fn a_sphere_through_points_stays_a_sphere() {
    for &n in tier(&[1_000][..], &[1_000, 13_000]) {
        for seed in [1, 2, 3, 4, 5, 7] {
            let mut shape = sphere_cap(60.0, n, irregular(seed), OUTSIDE);
            let every = 97;
            let inside = fix(&mut shape, |v, p| v % every == 0 && p.z > 0.6);
            assert_above!(inside.len(), 4);
            let solution = solve_smooth(&shape, &inside, TIGHT);
            summary("points on a sphere", &solution);
            let error = errors(&shape, &solution).max;
            println!("  {n} {seed}: {} points, error {error:.1e}", inside.len());
            assert_success(&solution.report.outcome);
            assert_below!(error, 1e-9);
            for (v, normal) in &solution.boundary_normals {
                let off = (vector(normal) - vector(&shape.positions[*v as usize])).norm();
                assert!(off < 1e-6, "normal of {v} off by {off}");
            }
        }
    }
}

/// Fixed vertices with a triangle among themselves look like a piece of the outside, which would give them its normal.
#[test]
fn a_sphere_through_triangles_stays_a_sphere() {
    for seed in 1..=10 {
        let mut shape = sphere_cap(60.0, 4_000, irregular(seed), OUTSIDE);
        let corners = shape.triangles.clone();
        let chosen = corners
            .iter()
            .step_by(211)
            .filter(|t| t.iter().all(|&v| shape.positions[v as usize][2] > 0.6));
        let wanted: Vec<u32> = chosen.flatten().copied().collect();
        let inside = fix(&mut shape, |v, _| wanted.contains(&(v as u32)));
        assert_above!(inside.len(), 20);
        let solution = solve_smooth(&shape, &inside, TIGHT);
        let error = errors(&shape, &solution).max;
        println!(
            "  {seed}: {} vertices of triangles, error {error:.1e}",
            inside.len()
        );
        assert_success(&solution.report.outcome);
        assert_below!(error, 1e-9);
    }
}

#[test]
fn a_sphere_through_a_circle_stays_a_sphere() {
    for n in [1_000, 13_000] {
        let mut shape = sphere_cap(60.0, n, irregular(7), OUTSIDE);
        let z = 30f64.to_radians().cos();
        let inside = fix_curve(&mut shape, z);
        let solution = solve_smooth(&shape, &inside, TIGHT);
        summary("circle on a sphere", &solution);
        let error = errors(&shape, &solution).max;
        println!("  {n}: {} vertices, error {error:.1e}", inside.len());
        assert_success(&solution.report.outcome);
        assert_below!(error, 1e-9);
    }
}

#[test]
fn a_cylinder_through_a_circle_stays_a_cylinder() {
    let mut shape = cylinder_band(13_000, irregular(7), OUTSIDE);
    let inside = fix_curve(&mut shape, 0.2);
    let solution = solve_smooth(&shape, &inside, TIGHT);
    summary("circle on a cylinder", &solution);
    let error = errors(&shape, &solution).max;
    println!("  {} vertices, error {error:.1e}", inside.len());
    assert_success(&solution.report.outcome);
    assert_below!(error, 4e-5);
}

/// The normals of the outer boundary, and on the curve those of the cylinder turned towards its axis by `degrees`.
fn turned_normals(shape: &Shape, inside: &[u32], degrees: f64) -> Vec<(u32, [f64; 3])> {
    let mut given = outer_normals(shape, inside);
    let (sin, cos) = degrees.to_radians().sin_cos();
    for &v in inside {
        let p = shape.positions[v as usize];
        given.push((v, [cos * p[0], cos * p[1], sin]));
    }
    given.sort_by_key(|g| g.0);
    given
}

/// What is given on a curve is met there, as at the boundary: `n = (cos, sin)` makes the radius fall by `tan` per height.
#[test]
fn given_normals_on_a_curve_inside_are_met() {
    // At the first size at most 4.5 degrees.
    let mut before = 8.2;
    for n in [1_000, 4_000, 16_000] {
        let mut shape = cylinder_band(n, Sampling::Regular, OUTSIDE);
        let inside = fix_curve(&mut shape, 0.0);
        let given = turned_normals(&shape, &inside, 20.0);
        let turned = solve_given(&shape, &flat(&shape), &given, options(TIGHT));
        summary("turned", &turned);
        assert_success(&turned.report.outcome);
        let deviation = turned.report.quality.normal_deviation;
        println!("  {n}: off the given normals by {deviation:.2} degrees");
        assert_below!(deviation, 0.55 * before);
        before = deviation;
        assert_eq!(turned.boundary_normals.len(), given.len());
    }
}

#[test]
fn a_curve_with_given_normals_parts_two_problems() {
    // On irregular triangulations this curve has gaps.
    for (n, degrees) in [(4_000, 20.0), (3_500, 0.0), (4_200, -30.0)] {
        let mut shape = cylinder_band(n, Sampling::Regular, OUTSIDE);
        let inside = fix_curve(&mut shape, 0.0);
        let given = turned_normals(&shape, &inside, degrees);
        let whole = solve_given(&shape, &flat(&shape), &given, options(TIGHT));
        assert_success(&whole.report.outcome);
        // Which side a free vertex is on: by walking over edges between free vertices.
        let mut upper: Vec<bool> = (shape.positions.iter().zip(&shape.free))
            .map(|(p, free)| *free && p[2] > 0.9)
            .collect();
        loop {
            let grown: Vec<u32> = (shape.triangles.iter())
                .filter(|t| t.iter().any(|&v| upper[v as usize]))
                .flatten()
                .copied()
                .filter(|&v| shape.free[v as usize] && !upper[v as usize])
                .collect();
            if grown.is_empty() {
                break;
            }
            grown.iter().for_each(|&v| upper[v as usize] = true);
        }
        let count = upper.iter().filter(|u| **u).count();
        assert_above!(count, n / 3);
        assert_below!(count, 2 * n / 3);
        let mut half = shape.clone();
        half.free.clone_from(&upper);
        let alone = solve_given(&half, &flat(&half), &given, options(TIGHT));
        let ids = (0..upper.len()).filter(|&v| upper[v]);
        let off = ids.map(|v| (vector(&whole.positions[v]) - vector(&alone.positions[v])).norm());
        let off = Errors::of(off).max;
        println!("  {degrees} degrees: whole and half are {off:.1e} apart");
        assert_success(&alone.report.outcome);
        assert_below!(off, 1e-9);
    }
}

/// How far the triangles at the point lean, in degrees: half as much on edges half as long.
#[test]
fn an_isolated_point_off_the_surface_makes_a_smooth_bump() {
    let heights = [0.02, 0.1, -0.1, 0.3];
    let mut bars = Bars::default();
    let cases = [
        (1_000, [2.6, 4.5, 1.0, 9.5]),
        (4_000, [2.6, 4.5, 1.0, 9.5]),
        (13_000, [1.4, 2.5, 0.7, 5.5]),
    ];
    for &(n, leans) in tier(&cases[..2], &cases) {
        for (height, lean) in heights.into_iter().zip(leans) {
            let mut shape = sphere_cap(60.0, n, irregular(7), OUTSIDE);
            let top = shape
                .free_vertices()
                .into_iter()
                .max_by(|a, b| shape.positions[*a as usize][2].total_cmp(&shape.positions[*b as usize][2]))
                .unwrap();
            shape.free[top as usize] = false;
            shape.positions[top as usize][2] += height;
            let solution = solve_smooth(&shape, &[top], 1e-8);
            let what = format!("point at {height} of {n}");
            summary(&what, &solution);
            bars.converged(&what, &solution);
            let q = vector(&shape.positions[top as usize]);
            let mut worst = 0.0f64;
            for t in shape.triangles.iter().filter(|t| t.contains(&top)) {
                let p = t.map(|v| vector(&solution.positions[v as usize]));
                let normal = (p[1] - p[0]).cross(&(p[2] - p[0]));
                worst = worst.max(normal.angle(&q).to_degrees());
            }
            println!("  triangles at the point lean by {worst:.2} degrees");
            bars.at_most(&what, worst, lean);
            // The extremes of a harmonic H are at the boundary, of which the point is a part.
            let quality = &solution.report.quality;
            bars.at_least(&what, quality.h_inside[0], quality.h_boundary[0]);
            bars.at_most(&what, quality.h_inside[1], quality.h_boundary[1]);
        }
    }
    bars.finish();
}

/// From the pinched input the normals are wrong, and not tangent along the curve.
#[test]
fn the_rule_of_the_input_is_there_on_request() {
    let mut shape = cylinder_band(2_000, irregular(3), OUTSIDE);
    let inside = fix_curve(&mut shape, 0.0);
    let outer = outer_normals(&shape, &inside);
    use {Discretization::*, InteriorNormals::*, Target::*};
    let mut bars = Bars::default();
    for (discretization, interior, target, least, most) in [
        (SecondOrder, Smooth, Harmonic, 0.0, 6e-6),
        (SecondOrder, Smooth, MinimalEnergy, 0.0, 6e-4),
        (SecondOrder, Input, Harmonic, 1.7e-2, 1.9e-2),
        (SecondOrder, Input, MinimalEnergy, 1.8e-2, 2.0e-2),
        (Discretization::Paper, Smooth, Harmonic, 0.0, 6.5e-4),
        (Discretization::Paper, Smooth, MinimalEnergy, 0.0, 8.5e-4),
        (Discretization::Paper, Input, Harmonic, 1.4e-2, 1.6e-2),
        (Discretization::Paper, Input, MinimalEnergy, 1.6e-2, 1.8e-2),
    ] {
        let options = Options {
            interior_normals: interior,
            discretization,
            target,
            boundary_normals: BoundaryNormals::Given(outer.clone()),
            ..options(1e-8)
        };
        let solution = solve_as_asked(&shape, &flat(&shape), options);
        let what = format!("{discretization:?} {interior:?} {target:?}");
        summary(&what, &solution);
        let error = errors(&shape, &solution).max;
        println!("  {error:.2e}");
        bars.converged(&what, &solution);
        bars.at_least(&what, error, least);
        bars.at_most(&what, error, most);
    }
    bars.finish();
}

#[test]
fn convex_weights_keep_spheres() {
    for &n in tier(&[1_000][..], &[1_000, 13_000]) {
        let shape = sphere_cap(60.0, n, irregular(1), OUTSIDE);
        let options = Options {
            inner_fairness: InnerFairness::Convex,
            ..options(TIGHT)
        };
        // Weights of the undistorted triangles.
        let start: Vec<[f64; 3]> = shape
            .positions
            .iter()
            .zip(&shape.free)
            .map(|(p, &free)| if free { [p[0], p[1], 0.5 * p[2]] } else { *p })
            .collect();
        let solution = solve(&shape, &start, options);
        let error = errors(&shape, &solution).max;
        summary("convex", &solution);
        println!(
            "  {n}: {error:.1e}, {} fallbacks",
            solution.report.fallback_weights
        );
        assert_success(&solution.report.outcome);
        assert_below!(error, 1e-9);
        assert_eq!(solution.report.fallback_weights, 0);
    }
}
