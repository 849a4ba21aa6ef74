//! Curvature continuity with several loops and components, fixed curves and points inside, other targets, holes, and in steps.

use crate::fairing::*;
use fairmesh::{
    BoundaryCurvature, BoundaryNormals, CurvatureContinuity, Error, FillOptions, FillOutcome, Loops,
    LooseReason, Options, Outcome, Selection, Solution, Solver, Target, fair, fill_holes,
};
use fairmesh_shapes::*;
use nalgebra::Vector3;

const TOLERANCE: f64 = 1e-8;

fn asked(continuity: f64) -> Options {
    Options {
        continuity,
        ..options(TOLERANCE)
    }
}

fn faired(shape: &Shape, options: &Options) -> Solution {
    attempt(shape, options.clone()).expect("a sound problem")
}

fn loops(solution: &Solution) -> Vec<CurvatureContinuity> {
    let components = solution.report.components.iter();
    components.flat_map(|c| c.continuity.clone()).collect()
}

fn ellipsoid(n: usize) -> Shape {
    ellipsoid_cap([1.0, 0.8, 0.6], 50.0, n, irregular(7), 10)
}

/// With two loops, on which the Laplacian of the mean curvature is harmonic.
fn band(n: usize) -> Shape {
    let profile = HarmonicProfile::biharmonic(1.2, -0.8, 0.5, [0.7, -0.4], 1.2).expect("a sound profile");
    revolution_band(&profile, n, irregular(7), 10).expect("sound surroundings")
}

/// How far two surfaces are apart at most, in diagonals.
fn apart(a: &Solution, b: &Solution) -> f64 {
    let pairs = a.positions.iter().zip(&b.positions);
    let distances = pairs.map(|(p, q)| (vector(p) - vector(q)).norm());
    distances.fold(0.0, f64::max) / a.report.diagonal
}

/// A vertex of each loop, by the report of the whole.
fn loop_vertices(solution: &Solution) -> Vec<u32> {
    loops(solution).iter().map(|l| l.vertex as u32).collect()
}

fn with_loops(continuity: f64, loop_continuity: Vec<(u32, f64)>) -> Options {
    Options {
        loop_continuity,
        ..asked(continuity)
    }
}

#[test]
fn each_loop_has_its_own_number() {
    let shape = band(2_000);
    let whole = faired(&shape, &asked(1.0));
    let at = loop_vertices(&whole);
    assert_eq!(at.len(), 2);
    // A number for each loop is that for all.
    let each = faired(&shape, &with_loops(0.0, vec![(at[0], 1.0), (at[1], 1.0)]));
    assert_same_items!(each.positions, whole.positions);
    assert_eq!(loops(&each), loops(&whole));
    // Of several numbers for a loop the last one holds.
    let repeated = vec![(at[0], 0.3), (at[1], 0.2), (at[0], 1.0)];
    let repeated = faired(&shape, &with_loops(0.7, repeated));
    assert_same_items!(
        repeated.positions,
        faired(&shape, &with_loops(1.0, vec![(at[1], 0.2)])).positions
    );
    // One alone.
    for k in 0..2 {
        let one = faired(&shape, &with_loops(0.0, vec![(at[k], 1.0)]));
        assert_success(&one.report.outcome);
        let told = loops(&one);
        println!("{told:?}");
        assert_eq!(told.len(), 1);
        assert_eq!(told[0].vertex, at[k] as usize);
        assert_above!(told[0].reached, 0.5);
        assert_below!(told[0].jump, 0.5 * told[0].jump_before);
        let off = with_loops(1.0, vec![(at[1 - k], 0.0)]);
        assert_same_items!(faired(&shape, &off).positions, one.positions);
    }
    // Nothing anywhere.
    let none = faired(&shape, &with_loops(1.0, vec![(at[0], 0.0), (at[1], 0.0)]));
    assert_same_items!(none.positions, faired(&shape, &asked(0.0)).positions);
    assert_empty!(loops(&none));
}

#[test]
fn loops_that_are_not_there_are_named() {
    let shape = ellipsoid(400);
    let refused = |list: Vec<(u32, f64)>| attempt(&shape, with_loops(1.0, list)).unwrap_err();
    let boundary = shape.boundary_normals();
    let on = boundary[3].0;
    let free = shape.free_vertices()[5];
    let far = (0..shape.free.len() as u32)
        .find(|v| !shape.free[*v as usize] && boundary.iter().all(|(b, _)| b != v))
        .unwrap();
    for vertex in [free, far, 1_000_000] {
        let named = Error::NotOnLoop {
            vertex: vertex as usize,
        };
        assert_eq!(refused(vec![(on, 1.0), (vertex, 0.5)]), named);
    }
    for blend in [-0.1, 1.1, f64::NAN] {
        assert_matches!(
            refused(vec![(on, blend)]),
            Error::BadOption {
                name: "loop_continuity",
                ..
            }
        );
    }
}

/// Points of the exact surface inside, which the surface passes: it comes nearer with them than without, and with continuous curvature nearer
/// than with tangent planes alone.
#[test]
fn points_inside_are_passed_smoothly() {
    let without = errors(&ellipsoid(2_000), &faired(&ellipsoid(2_000), &asked(0.0))).rms;
    let mut shape = ellipsoid(2_000);
    let inside = fix(&mut shape, |v, p| v % 97 == 0 && p.z > 0.45);
    assert_above!(inside.len(), 3);
    let [tangent, curved] = [0.0, 1.0].map(|c| faired(&shape, &asked(c)));
    assert_success(&tangent.report.outcome);
    assert_success(&curved.report.outcome);
    let [before, after] = [&tangent, &curved].map(|s| errors(&shape, s).rms);
    println!(
        "{} points: {without:e} without, {before:e} -> {after:e}",
        inside.len()
    );
    let plain = errors(&ellipsoid(2_000), &faired(&ellipsoid(2_000), &asked(1.0))).rms;
    println!("{plain:e} without points");
    let told = loops(&curved);
    println!("{told:?}");
    assert_eq!(told.len(), 1);
    assert_below!(told[0].jump, 0.4 * told[0].jump_before);
    assert_below!(after, 0.5 * before);
    assert_below!(before, without);
}

/// The vertices of a closed curve of edges between what lies above a plane and what does not.
fn fix_curve(shape: &mut Shape, z: f64) -> Vec<u32> {
    let above: Vec<bool> = shape.positions.iter().map(|p| p[2] > z).collect();
    let mut on = vec![false; shape.free.len()];
    for t in &shape.triangles {
        if t.iter().any(|&v| !above[v as usize]) {
            t.iter()
                .filter(|v| above[**v as usize])
                .for_each(|&v| on[v as usize] = true);
        }
    }
    // No triangle is left without a free vertex.
    for t in &shape.triangles {
        if t.iter().all(|&v| on[v as usize]) {
            let height = |v: &&u32| shape.positions[**v as usize][2];
            let highest = t.iter().max_by(|a, b| height(a).total_cmp(&height(b)));
            highest.iter().for_each(|v| on[**v as usize] = false);
        }
    }
    fix(shape, |v, _| on[v])
}

/// A curve that has no normals is passed smoothly; the outer loop continues the curvature of what is around it.
#[test]
fn curves_inside_are_passed_smoothly() {
    let mut shape = ellipsoid(2_000);
    let inside = fix_curve(&mut shape, 0.52);
    assert_above!(inside.len(), 20);
    let [tangent, curved] = [0.0, 1.0].map(|c| faired(&shape, &asked(c)));
    assert_success(&tangent.report.outcome);
    assert_success(&curved.report.outcome);
    let [before, after] = [&tangent, &curved].map(|s| errors(&shape, s).rms);
    println!("{} on the curve: {before:e} -> {after:e}", inside.len());
    let told = loops(&curved);
    println!("{told:?}");
    assert_eq!(told.len(), 1);
    // The curve tells the surface nearly all: what is left is the discretization's error.
    assert_below!(told[0].jump, 0.4 * told[0].jump_before);
    assert_below!(after, 1.1 * before);
}

/// Fixes the vertices so many edges from the middle of a patch of a torus: a hexagon of edges.
fn fix_hexagon(shape: &mut Shape, steps: usize) -> Vec<u32> {
    let centre = Vector3::new(1.4, 0.0, 0.0);
    let off = |v: &usize| (vector(&shape.positions[*v]) - centre).norm();
    let middle = (0..shape.free.len())
        .min_by(|a, b| off(a).total_cmp(&off(b)))
        .unwrap();
    let mut edges = vec![usize::MAX; shape.free.len()];
    edges[middle] = 0;
    for step in 1..=steps {
        let reached: Vec<u32> = (shape.triangles.iter())
            .filter(|t| t.iter().any(|&v| edges[v as usize] == step - 1))
            .flatten()
            .copied()
            .collect();
        for v in reached {
            edges[v as usize] = edges[v as usize].min(step);
        }
    }
    fix(shape, |v, _| edges[v] == steps)
}

/// Along a closed curve with normals each side has a loop of its own. What is on the other side moves: its curvature is nothing to go by, only
/// what is given is.
#[test]
fn sides_of_a_closed_curve_have_curvatures_of_their_own() {
    let mut shape = torus_patch(1.0, 0.4, 1.0, 2_000, Sampling::Regular, 10);
    let inside = fix_hexagon(&mut shape, 8);
    assert_eq!(inside.len(), 48);
    let fitted = |continuity: f64| Options {
        boundary_normals: BoundaryNormals::Given(shape.boundary_normals()),
        ..asked(continuity)
    };
    let solution = faired(&shape, &fitted(1.0));
    assert_success(&solution.report.outcome);
    assert_eq!(solution.report.components.len(), 2);
    let told = loops(&solution);
    println!("{told:?}");
    assert_eq!(told.len(), 1, "the loop beside fixed surroundings alone");
    assert!(!inside.contains(&(told[0].vertex as u32)), "{told:?}");

    let surface = shape.surface.as_ref().unwrap();
    let curvature = |v: u32| surface.mean_curvature(shape.positions[v as usize]);
    let exact = inside.iter().map(|&v| (v, curvature(v)));
    let given = Options {
        boundary_curvature: BoundaryCurvature::Given(exact.collect()),
        ..fitted(1.0)
    };
    let continued = faired(&shape, &given);
    assert_success(&continued.report.outcome);
    let told = loops(&continued);
    println!("{told:?}");
    assert_eq!(told.len(), 3, "both sides of the curve, and around");
    let [tangent, before, after] =
        [&faired(&shape, &fitted(0.0)), &solution, &continued].map(|s| errors(&shape, s).rms);
    println!("{tangent:e} -> {before:e} -> {after:e}");
    // Its corners point into the outer side, where five modes do not resolve them: that side stays as it is.
    let sides = told.iter().filter(|l| inside.contains(&(l.vertex as u32)));
    assert_eq!(sides.clone().count(), 2);
    assert_all!(sides.clone(), |l| l.reached == 0.0 || l.jump < l.jump_before);
    assert!(sides.clone().any(|l| l.jump < 0.2 * l.jump_before), "{told:?}");
    assert_below!(after, 0.1 * tangent);
    assert_below!(before, 0.1 * tangent);

    // A number for a loop of the curve holds for both sides.
    let of_curve = Options {
        loop_continuity: vec![(inside[0], 0.0)],
        ..given
    };
    assert_eq!(loops(&faired(&shape, &of_curve)).len(), 1);
}

/// A constant is harmonic: with the same curvature along the boundary the surface does not depend on it.
#[test]
fn a_constant_target_is_taken_up() {
    let shape = torus_patch(1.0, 0.4, 1.0, 1_000, irregular(7), 10);
    let surface = shape.surface.clone().unwrap();
    let exact = shape.boundary_normals().into_iter();
    let exact = exact.map(|(v, _)| (v, surface.mean_curvature(shape.positions[v as usize])));
    let curvature = BoundaryCurvature::Given(exact.collect());
    let of = |target: Target, continuity: f64| {
        let options = Options {
            target,
            boundary_curvature: curvature.clone(),
            boundary_normals: BoundaryNormals::Given(shape.boundary_normals()),
            ..asked(continuity)
        };
        let solution = faired(&shape, &options);
        assert_eq!(solution.report.outcome, Outcome::Converged);
        assert_eq!(solution.report.target, target);
        solution
    };
    let constant = Target::Constant(0.6);
    let [g1, g2] = [0.0, 1.0].map(|c| apart(&of(Target::Harmonic, c), &of(constant, c)));
    println!("{g1:e} {g2:e}");
    assert_below!(g2, 0.1 * g1);
    let told = loops(&of(Target::MinimalEnergy, 1.0));
    println!("{told:?}");
    assert_below!(told[0].jump, 0.4 * told[0].jump_before);
}

/// Two components on one surface, with a row of fixed vertices between: there the other one is no surroundings to go by.
#[test]
fn what_moves_is_no_surroundings() {
    let mut shape = ellipsoid(2_000);
    let between = fix(&mut shape, |_, p| p.x.abs() < 0.08);
    assert_above!(between.len(), 40);
    let [tangent, curved] = [0.0, 1.0].map(|c| faired(&shape, &asked(c)));
    assert_success(&tangent.report.outcome);
    assert_success(&curved.report.outcome);
    assert_eq!(curved.report.components.len(), 2);
    let [before, after] = [&tangent, &curved].map(|s| errors(&shape, s).rms);
    println!("{before:e} -> {after:e} {:?}", loops(&curved));
    assert_below!(after, 1.2 * before);
    assert_all!(loops(&curved).iter(), |l| l.jump <= l.jump_before);
}

/// An ellipsoid with a hole, filled.
#[test]
fn a_hole_is_filled_with_the_curvature_around() {
    let shape = ellipsoid(2_000);
    let triangles: Vec<[u32; 3]> = shape
        .triangles
        .iter()
        .filter(|t| t.iter().all(|&v| !shape.free[v as usize]))
        .copied()
        .collect();
    let x = &shape.positions;
    let holes = fairmesh::boundary_loops(x, &triangles).unwrap();
    let hole = (0..holes.len()).min_by(|a, b| holes[*a].length.total_cmp(&holes[*b].length));
    let surface = shape.surface.as_ref().unwrap();
    let filled = |fairing: Options| {
        let asked = FillOptions {
            loops: Loops::Chosen(vec![hole.unwrap()]),
            fairing,
            ..FillOptions::default()
        };
        fill_holes(x, &triangles, &asked)
    };
    let mut errors = Vec::new();
    for continuity in [0.0, 1.0] {
        let filled = filled(asked(continuity)).unwrap();
        assert_eq!(filled.loops[0].outcome, FillOutcome::Faired);
        let new = filled.positions[x.len()..].iter();
        errors.push(Errors::of(new.map(|p| surface.distance(*p))).rms);
        let report = filled.loops[0].fairing.as_ref().expect("it was faired");
        let told = report.components.iter().flat_map(|c| c.continuity.clone());
        let told: Vec<_> = told.collect();
        println!("{continuity}: {:e} {told:?}", errors.last().unwrap());
        assert_eq!(told.len(), usize::from(continuity > 0.0));
        assert_all!(told.iter(), |l| l.reached > 0.5 && l.jump < 0.4 * l.jump_before);
    }
    assert!(errors[1] < 0.4 * errors[0], "{errors:?}");

    // The number of the loop is what is asked of it.
    let on = holes[hole.unwrap()].vertices[4];
    let by_loop = filled(with_loops(0.0, vec![(on, 1.0)])).unwrap();
    assert_same_items!(by_loop.positions, filled(asked(1.0)).unwrap().positions);
    let far = *triangles[0]
        .iter()
        .find(|v| !holes[hole.unwrap()].vertices.contains(v))
        .unwrap();
    let vertex = far as usize;
    assert_eq!(
        filled(with_loops(0.0, vec![(far, 1.0)])).unwrap_err(),
        Error::NotOnLoop { vertex }
    );
}

fn to_end(solver: &mut Solver) -> Solution {
    for _ in 0..1000 {
        if solver.run(7, None).unwrap().report.outcome != Outcome::IterationLimit {
            return solver.solution().clone();
        }
    }
    panic!("no end");
}

#[test]
fn a_solver_takes_continuity_anew() {
    let shape = ellipsoid(2_000);
    let at = |continuity: f64| faired(&shape, &asked(continuity));
    let selection = Selection::Mask(&shape.free);
    let mut solver = Solver::new(&shape.positions, &shape.triangles, selection, &asked(0.0)).unwrap();
    let tangent = to_end(&mut solver);
    assert_same_items!(tangent.positions, at(0.0).positions);
    let same = |solver: &mut Solver, fresh: &Solution| {
        let found = to_end(solver);
        assert_eq!(found.report.outcome, fresh.report.outcome);
        let off = apart(&found, fresh);
        println!("{off:e}, {} iterations", found.report.iterations);
        assert_below!(off, 30.0 * TOLERANCE);
        for (a, b) in loops(&found).iter().zip(loops(fresh)) {
            assert_near!(a.jump, b.jump, 1e-4 * b.jump_before);
            assert_near!(a.reached, b.reached, 1e-4);
        }
        assert_eq!(loops(&found).len(), loops(fresh).len());
    };
    for continuity in [1.0, 0.5, 0.0, 1.0] {
        solver.set_continuity(continuity, &[]).unwrap();
        same(&mut solver, &at(continuity));
    }
    // In the middle of the way.
    solver.set_continuity(0.3, &[]).unwrap();
    solver.run(2, None).unwrap();
    let vertex = shape.boundary_normals()[7].0;
    solver.set_continuity(0.0, &[(vertex, 0.5)]).unwrap();
    same(&mut solver, &at(0.5));
    // Another curvature.
    let given: Vec<(u32, f64)> = shape.boundary_normals().iter().map(|(v, _)| (*v, -0.9)).collect();
    let given = BoundaryCurvature::Given(given);
    solver.set_boundary_curvature(given.clone()).unwrap();
    let fresh = Options {
        boundary_curvature: given,
        ..asked(0.5)
    };
    same(&mut solver, &faired(&shape, &fresh));
    // Wrong ones change nothing.
    assert_matches!(
        solver.set_continuity(1.5, &[]),
        Err(Error::BadOption {
            name: "continuity",
            ..
        })
    );
    let inside = shape.free_vertices()[0];
    let named = Error::NotOnLoop {
        vertex: inside as usize,
    };
    assert_eq!(solver.set_continuity(1.0, &[(inside, 1.0)]), Err(named));
    let wrong = BoundaryCurvature::Given(vec![(vertex, f64::NAN)]);
    assert!(solver.set_boundary_curvature(wrong).is_err());
    same(&mut solver, &faired(&shape, &fresh));
}

/// Held up after each iteration, and begun with continuity: the bits of one call.
#[test]
fn a_solver_with_continuity_has_the_bits_of_one_call() {
    let shape = ellipsoid(1_000);
    let whole = fair(
        &shape.positions,
        &shape.triangles,
        Selection::Mask(&shape.free),
        &asked(1.0),
    )
    .unwrap();
    let selection = Selection::Mask(&shape.free);
    let mut solver = Solver::new(&shape.positions, &shape.triangles, selection, &asked(1.0)).unwrap();
    let found = to_end(&mut solver);
    assert_same_items!(found.positions, whole.positions);
    assert_eq!(loops(&found), loops(&whole));
}

/// Half a globe, of meridians and parallels.
fn globe(segments: usize, free_rings: usize) -> Shape {
    let mut shape = ellipsoid(100);
    let ring = |k: usize| std::f64::consts::PI * k as f64 / (segments / 2) as f64;
    let rows = free_rings + 10;
    shape.positions = vec![[0.0, 0.0, 0.6]];
    for k in 1..rows {
        for j in 0..segments {
            let (s, c) = (std::f64::consts::TAU * j as f64 / segments as f64).sin_cos();
            let (sk, ck) = ring(k).sin_cos();
            shape.positions.push([sk * c, 0.8 * sk * s, 0.6 * ck]);
        }
    }
    let at = |k: usize, j: usize| (1 + (k - 1) * segments + j % segments) as u32;
    shape.triangles.clear();
    for j in 0..segments {
        shape.triangles.push([0, at(1, j), at(1, j + 1)]);
        for k in 1..rows - 1 {
            let (a, b, c, d) = (at(k, j), at(k, j + 1), at(k + 1, j), at(k + 1, j + 1));
            shape.triangles.extend([[a, c, d], [a, d, b]]);
        }
    }
    shape.free = (0..shape.positions.len())
        .map(|v| v <= free_rings * segments)
        .collect();
    shape
}

/// Who asks for more does not get less: large triangles beside the boundary deviate from its normals the more they are curved, so that not the
/// whole way is gone.
#[test]
fn more_asked_is_no_less_reached() {
    let shape = globe(64, 12);
    let told = [0.2, 0.4, 0.6, 0.8, 1.0].map(|blend| {
        let solution = faired(&shape, &asked(blend));
        let of = loops(&solution)[0];
        let short = Outcome::ConvergedLoosely {
            reason: LooseReason::Curvature,
        };
        let expected = if of.reached < 0.5 * blend {
            short
        } else {
            Outcome::Converged
        };
        assert_eq!(solution.report.outcome, expected, "{of:?}");
        of
    });
    let reached = told.map(|l| l.reached);
    println!("{reached:?} {:?}", told.map(|l| l.jump));
    assert!(
        told.map(|l| l.jump).is_sorted_by(|a, b| *b <= 1.01 * a),
        "{told:?}"
    );
    assert!(reached.is_sorted_by(|a, b| *b >= 0.98 * a), "{reached:?}");
    assert_above!(reached[4], 0.15);
}

/// Points of a surface that solves the equation leave it a solution.
#[test]
fn bands_pass_points_of_their_own() {
    let plain = errors(&band(2_000), &faired(&band(2_000), &asked(1.0))).rms;
    let mut shape = band(2_000);
    let inside = fix(&mut shape, |v, _| v % 211 == 3);
    assert_above!(inside.len(), 5);
    let [tangent, curved] = [0.0, 1.0].map(|c| errors(&shape, &faired(&shape, &asked(c))).rms);
    println!("{plain:e}; {tangent:e} -> {curved:e}");
    assert_below!(curved, 2.6 * plain);
    assert_below!(curved, 0.6 * tangent);
}
