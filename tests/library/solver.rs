//! Fairing in steps finds what fairing at once finds, and goes on after changes.

use std::ops::ControlFlow;

use crate::fairing::*;
use fairmesh::{
    BoundaryNormals, Error, InnerFairness, Options, Outcome, Selection, Solution, Solver, Target, fair,
};
use fairmesh_shapes::*;

const TOLERANCE: f64 = 1e-8;

fn solver(shape: &Shape, start: &[[f64; 3]], options: &Options) -> Solver {
    Solver::new(start, &shape.triangles, Selection::Mask(&shape.free), options).unwrap()
}

fn at_once(shape: &Shape, start: &[[f64; 3]], options: Options) -> Solution {
    fair(start, &shape.triangles, Selection::Mask(&shape.free), &options).unwrap()
}

fn bits(solution: &Solution) -> Vec<u64> {
    solution.positions.iter().flatten().map(|x| x.to_bits()).collect()
}

fn distance(a: &Solution, b: &Solution) -> f64 {
    let pairs = a.positions.iter().flatten().zip(b.positions.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / a.report.diagonal
}

/// Runs to the end, by steps of so many iterations.
fn to_end(solver: &mut Solver, by: usize) -> usize {
    for runs in 1..1000 {
        if solver.run(by, None).unwrap().report.outcome != Outcome::IterationLimit {
            return runs;
        }
    }
    panic!("no end");
}

#[test]
fn steps_give_the_bits_of_one_call() {
    let cap = sphere_cap(60.0, 1000, irregular(1), OUTSIDE);
    let rough = cylinder_band(500, irregular(1), OUTSIDE);
    // The second needs harder means than the direct iteration.
    for (shape, start, inner) in [
        (&cap, flat(&cap), InnerFairness::Uniform),
        (&rough, rough.noise(1, 0.3), InnerFairness::Conformal),
    ] {
        let asked = || Options {
            inner_fairness: inner,
            ..options(TOLERANCE)
        };
        let whole = at_once(shape, &start, asked());
        for by in [1, 3, 1000] {
            let mut solver = solver(shape, &start, &asked());
            let runs = to_end(&mut solver, by);
            let found = solver.solution();
            assert!(bits(found) == bits(&whole), "steps of {by}");
            assert_eq!(found.report.outcome, whole.report.outcome);
            assert_eq!(found.report.iterations, whole.report.iterations);
            assert_eq!(found.mean_curvature, whole.mean_curvature);
            assert_at_least!(runs, found.report.iterations / by);
            // The end is the end.
            let again = solver.run(5, None).unwrap();
            assert_same_items!(bits(again), bits(&whole));
        }
    }
}

#[test]
fn a_step_is_one_iteration_and_comes_nearer() {
    let shape = sphere_cap(60.0, 1000, irregular(2), OUTSIDE);
    let whole = at_once(&shape, &flat(&shape), options(TOLERANCE));
    let mut solver = solver(&shape, &flat(&shape), &options(TOLERANCE));
    assert_eq!(solver.solution().positions, flat(&shape));
    let mut steps = Vec::new();
    for k in 1..=5 {
        let solution = solver.run(1, None).unwrap();
        assert_eq!(solution.report.iterations, k);
        assert_eq!(solution.report.outcome, Outcome::IterationLimit);
        steps.push(distance(solution, &whole));
    }
    assert!(steps[4] < 0.1 * steps[0], "{steps:?}");
}

/// Normals of a sphere turned about z: the boundary leans outwards by two degrees.
fn leant(shape: &Shape) -> Vec<(u32, [f64; 3])> {
    let (s, c) = 2f64.to_radians().sin_cos();
    let lean = |[x, y, z]: [f64; 3]| {
        let r = x.hypot(y);
        let (r1, z1) = (r * c - z * s, r * s + z * c);
        [x / r * r1, y / r * r1, z1]
    };
    let normals = shape.boundary_normals().into_iter();
    normals.map(|(v, n)| (v, lean(n))).collect()
}

/// It has converged to the surface that is found anew.
fn assert_found(what: &str, warm: &Solution, fresh: &Solution) {
    println!(
        "{what}: {} iterations, {} anew",
        warm.report.iterations, fresh.report.iterations
    );
    assert_eq!(warm.report.outcome, Outcome::Converged, "{what}");
    let away = distance(warm, fresh);
    assert!(away < 30.0 * TOLERANCE, "{what}: {away}");
}

#[test]
fn after_a_change_it_goes_on_from_where_it_is() {
    let shape = sphere_cap(60.0, 2000, irregular(3), OUTSIDE);
    let start = flat(&shape);
    let mut solver = solver(&shape, &start, &options(TOLERANCE));
    solver.run(1000, None).unwrap();
    let cold = solver.solution().report.iterations;
    for target in [Target::Constant(0.05), Target::Constant(0.1), Target::Harmonic] {
        solver.set_target(target).unwrap();
        let warm = solver.run(1000, None).unwrap();
        let asked = Options {
            target,
            ..options(TOLERANCE)
        };
        assert_found(&format!("{target:?}"), warm, &at_once(&shape, &start, asked));
        assert_eq!(warm.report.target, target);
        assert!(warm.report.iterations <= cold, "{target:?}: more than {cold}");
    }
    let leant = leant(&shape);
    let fresh = solve_given(&shape, &start, &leant, options(TOLERANCE));
    solver
        .set_boundary_normals(BoundaryNormals::Given(leant))
        .unwrap();
    assert_found("normals", solver.run(1000, None).unwrap(), &fresh);
}

#[test]
fn a_change_in_the_middle_of_a_run_holds_at_once() {
    let shape = sphere_cap(60.0, 500, irregular(4), OUTSIDE);
    let mut solver = solver(&shape, &flat(&shape), &options(TOLERANCE));
    solver.run(3, None).unwrap();
    solver.set_target(Target::Constant(0.1)).unwrap();
    let target = Target::Constant(0.1);
    to_end(&mut solver, 2);
    let fresh = at_once(
        &shape,
        &flat(&shape),
        Options {
            target,
            ..options(TOLERANCE)
        },
    );
    assert_eq!(solver.solution().report.outcome, Outcome::Converged);
    assert_below!(distance(solver.solution(), &fresh), 30.0 * TOLERANCE);
}

#[test]
fn wrong_changes_leave_things_as_they_are() {
    let shape = sphere_cap(60.0, 300, irregular(5), OUTSIDE);
    let whole = at_once(&shape, &flat(&shape), options(TOLERANCE));
    let mut solver = solver(&shape, &flat(&shape), &options(TOLERANCE));
    solver.run(2, None).unwrap();
    let v = shape.boundary_normals()[3].0;
    let wrong = solver.set_boundary_normals(BoundaryNormals::Given(vec![(v, [0.0, 0.0, 2.0])]));
    assert_eq!(wrong, Err(Error::BadNormal { vertex: v as usize }));
    assert_matches!(
        solver.set_target(Target::Constant(f64::NAN)),
        Err(Error::BadOption { name: "target", .. })
    );
    to_end(&mut solver, 4);
    assert_same_items!(bits(solver.solution()), bits(&whole));
}

#[test]
fn the_callback_stops_a_run_after_one_iteration_and_it_goes_on_later() {
    let shape = sphere_cap(60.0, 500, irregular(6), OUTSIDE);
    let whole = at_once(&shape, &flat(&shape), options(TOLERANCE));
    let mut solver = solver(&shape, &flat(&shape), &options(TOLERANCE));
    let mut called = 0;
    let mut stop = |_: &fairmesh::Progress| {
        called += 1;
        ControlFlow::Break(())
    };
    let solution = solver.run(100, Some(&mut stop)).unwrap();
    assert_eq!(solution.report.outcome, Outcome::Cancelled);
    assert_eq!(solution.report.iterations, 1);
    assert_at_least!(called, 1);
    to_end(&mut solver, 100);
    assert_same_items!(bits(solver.solution()), bits(&whole));
}

#[test]
fn a_solver_moves_to_another_thread_in_the_middle() {
    let shape = sphere_cap(60.0, 300, irregular(7), OUTSIDE);
    let whole = at_once(&shape, &flat(&shape), options(TOLERANCE));
    let mut moved = solver(&shape, &flat(&shape), &options(TOLERANCE));
    let mut left = solver(&shape, &flat(&shape), &options(TOLERANCE));
    moved.run(2, None).unwrap();
    left.run(1, None).unwrap();
    drop(left);
    let moved = std::thread::spawn(move || {
        to_end(&mut moved, 3);
        moved
    });
    assert_same_items!(bits(moved.join().unwrap().solution()), bits(&whole));
}

#[test]
fn every_attempt_of_the_ladder_can_be_held_up() {
    let mut shape = sphere_cap(60.0, 300, irregular(8), OUTSIDE);
    // A fixed vertex that the surface passes smoothly, and a load that no surface bears.
    let inside = shape.free.iter().position(|&free| free).unwrap();
    shape.free[inside] = false;
    let start = flat(&shape);
    let asked = Options {
        target: Target::Constant(1000.0),
        max_iterations: 5000,
        inner_fairness: InnerFairness::Convex,
        ..options(TOLERANCE)
    };
    let whole = at_once(&shape, &start, asked.clone());
    println!(
        "{:?}, {} iterations",
        whole.report.outcome, whole.report.iterations
    );
    assert!(!whole.report.outcome.is_success(), "{:?}", whole.report.outcome);
    let mut solver = solver(&shape, &start, &asked);
    let runs = to_end(&mut solver, 1);
    let found = solver.solution();
    assert_same_items!(bits(found), bits(&whole));
    assert_eq!(found.report.outcome, whole.report.outcome);
    assert_eq!(found.report.iterations, whole.report.iterations);
    assert_eq!(found.report.defect, whole.report.defect);
    assert_at_least!(runs, whole.report.iterations);
}

#[test]
fn a_curve_that_gets_normals_is_the_problem_of_one_call() {
    let mut shape = sphere_cap(60.0, 1000, Sampling::Regular, OUTSIDE);
    // Two neighbours inside are fixed: they pass smoothly first, and get the sphere's normals then.
    let inside = shape
        .triangles
        .iter()
        .find(|t| t.iter().all(|&v| shape.free[v as usize]))
        .copied()
        .unwrap();
    inside[..2].iter().for_each(|&v| shape.free[v as usize] = false);
    let start = flat(&shape);
    let mut solver = solver(&shape, &start, &options(TOLERANCE));
    solver.run(1000, None).unwrap();
    let mut normals = shape.boundary_normals();
    normals.extend(inside[..2].iter().map(|&v| (v, shape.normals[v as usize])));
    normals.sort_by_key(|n| n.0);
    normals.dedup_by_key(|n| n.0);
    solver
        .set_boundary_normals(BoundaryNormals::Given(normals.clone()))
        .unwrap();
    solver.set_target(Target::Constant(0.01)).unwrap();
    solver.set_target(Target::Harmonic).unwrap();
    to_end(&mut solver, 7);
    let fresh = solve_given(&shape, &start, &normals, options(TOLERANCE));
    assert_eq!(solver.solution().report.outcome, fresh.report.outcome);
    assert_below!(distance(solver.solution(), &fresh), 30.0 * TOLERANCE);
}
