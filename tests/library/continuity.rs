//! Curvature continuity: what it keeps, known answers, invariances, and refusals.

use crate::fairing::*;
use fairmesh::{
    BoundaryCurvature, BoundaryNormals, CurvatureContinuity, Error, Options, Selection, Solution, Solver,
    SolverKind, Target, fair,
};
use fairmesh_shapes::*;

fn asked(continuity: f64) -> Options {
    Options {
        continuity,
        ..Options::default()
    }
}

fn faired(shape: &Shape, options: &Options) -> Solution {
    let selection = Selection::Mask(&shape.free);
    fair(&shape.flat(), &shape.triangles, selection, options).expect("a sound problem")
}

fn loops(solution: &Solution) -> &[CurvatureContinuity] {
    &solution.report.components[0].continuity
}

/// The root mean square of the distances of the free vertices from the exact surface.
fn error(shape: &Shape, solution: &Solution) -> f64 {
    let surface = shape.surface.as_ref().expect("an exact surface");
    let free = shape.free_vertices();
    let squares = free
        .iter()
        .map(|&v| surface.distance(solution.positions[v as usize]).powi(2));
    (squares.sum::<f64>() / free.len() as f64).sqrt()
}

fn torus(n: usize) -> Shape {
    torus_patch(1.0, 0.4, 1.0, n, irregular(7), 10)
}

/// On which the Laplacian of the mean curvature is harmonic.
fn band(n: usize) -> Shape {
    let profile = HarmonicProfile::biharmonic(1.2, -0.8, 0.5, [0.7, -0.4], 1.2).expect("a sound profile");
    revolution_band(&profile, n, irregular(7), 10).expect("sound surroundings")
}

#[test]
fn spheres_are_exact() {
    let shape = sphere_cap(60.0, 1_000, irregular(7), 10);
    let solution = faired(&shape, &asked(1.0));
    assert_success(&solution.report.outcome);
    assert_below!(error(&shape, &solution), 1e-9);
    assert_eq!(loops(&solution).len(), 1);
    assert_below!(loops(&solution)[0].jump, 1e-6);
}

/// The bits of tangent continuity, and nothing told of curvature.
#[test]
fn zero_is_tangent_continuity() {
    let shape = torus(400);
    let given = BoundaryCurvature::Given(vec![(0, 1.0)]);
    let options = Options {
        boundary_curvature: given,
        ..asked(0.0)
    };
    let solution = faired(&shape, &options);
    assert_same_items!(solution.positions, faired(&shape, &asked(0.0)).positions);
    assert_empty!(loops(&solution));
}

#[test]
fn surfaces_of_biharmonic_curvature_are_found_where_tangent_planes_alone_do_not_suffice() {
    let errors = |n: usize, continuity: f64| error(&band(n), &faired(&band(n), &asked(continuity)));
    let [tangent, coarse, fine] = [errors(2_000, 0.0), errors(2_000, 1.0), errors(8_000, 1.0)];
    assert!(
        coarse < 0.2 * tangent && fine < coarse,
        "{tangent:e} {coarse:e} {fine:e}"
    );
}

/// Where the tangent-continuous surface is right, nothing is made worse; where it is not, the error falls.
#[test]
fn cylinders_and_catenoids_stay_as_good_as_they_are() {
    for (shape, name) in [
        (cylinder_band(2_000, irregular(7), 10), "cylinder"),
        (catenoid_band(2_000, irregular(7), 10), "catenoid"),
    ] {
        let [tangent, continued] = [0.0, 1.0].map(|c| error(&shape, &faired(&shape, &asked(c))));
        assert!(continued < 3.0 * tangent, "{name} {continued:e} {tangent:e}");
    }
}

/// Noise of the surroundings is not taken for a jump of the curvature, and the jump that there is is found in spite of it.
#[test]
fn noise_is_not_continued() {
    let ratio = |shape: Shape, size: f64, seed: u64| {
        let positions = noisy(&shape, size, seed);
        let of = |continuity: f64| {
            let selection = Selection::Mask(&shape.free);
            let options = asked(continuity);
            let solution = fair(&positions, &shape.triangles, selection, &options).unwrap();
            error(&shape, &solution)
        };
        of(1.0) / of(0.0)
    };
    for (size, seed) in [(0.003, 3), (0.01, 5), (0.01, 8)] {
        let of_sphere = ratio(sphere_cap(60.0, 2_000, irregular(9), 10), size, seed);
        assert!(of_sphere < 1.5, "sphere {size} {of_sphere}");
        let of_catenoid = ratio(catenoid_band(2_000, irregular(8), 10), size, seed);
        assert!(of_catenoid < 1.5, "catenoid {size} {of_catenoid}");
    }
    let ellipsoid = ellipsoid_cap([1.0, 0.8, 0.6], 50.0, 2_000, irregular(7), 10);
    let of_ellipsoid = ratio(ellipsoid, 0.003, 3);
    assert!(of_ellipsoid < 0.6, "ellipsoid {of_ellipsoid}");
}

/// The surroundings moved at random, by this part of the edge length.
fn noisy(shape: &Shape, size: f64, seed: u64) -> Vec<[f64; 3]> {
    let mut all = shape.clone();
    all.free.fill(true);
    let noise = all.noise(seed, size);
    let mut positions = shape.positions.clone();
    for (v, p) in positions.iter_mut().enumerate().filter(|(v, _)| !shape.free[*v]) {
        *p = noise[v];
    }
    positions
}

/// Unasked, curvature is continued where it is certain, as if it were asked for; elsewhere the surface has the bits of tangent continuity.
#[test]
fn auto_continues_what_is_certain() {
    let auto = Options::CONTINUITY_AUTO;
    let positions = |shape: &Shape, at: &[[f64; 3]], continuity: f64| {
        let selection = Selection::Mask(&shape.free);
        fair(at, &shape.triangles, selection, &asked(continuity))
            .unwrap()
            .positions
    };
    for clean in [
        ellipsoid_cap([1.0, 0.8, 0.6], 50.0, 2_000, irregular(7), 10),
        torus(2_000),
    ] {
        let of = |continuity: f64| positions(&clean, &clean.flat(), continuity);
        assert_same_items!(of(auto), of(1.0));
        assert!(of(auto) != of(0.0));
    }
    for round in [
        sphere_cap(60.0, 2_000, irregular(9), 10),
        cylinder_band(2_000, irregular(7), 10),
    ] {
        for size in [0.0, 0.003, 0.01, 0.03] {
            let at = noisy(&round, size, 5);
            assert_same_items!(positions(&round, &at, auto), positions(&round, &at, 0.0));
        }
    }
}

/// Another equation has a shape of its own.
#[test]
fn auto_is_nothing_for_another_target() {
    let shape = ellipsoid_cap([1.0, 0.8, 0.6], 50.0, 400, irregular(7), 10);
    for target in [Target::MinimalEnergy, Target::Constant(1.0)] {
        let of = |continuity: f64| {
            faired(
                &shape,
                &Options {
                    target,
                    ..asked(continuity)
                },
            )
        };
        let auto = of(Options::CONTINUITY_AUTO);
        assert_same_items!(auto.positions, of(0.0).positions);
        assert_empty!(loops(&auto));
    }
}

/// Given normals are those of a surface beyond the boundary that is not the surroundings, unless curvatures are given, too. A solver
/// that gets normals or loses them goes by those that it has.
#[test]
fn auto_is_nothing_along_loops_with_given_normals() {
    let shape = ellipsoid_cap([1.0, 0.8, 0.6], 50.0, 400, irregular(7), 10);
    let given = BoundaryNormals::Given(shape.boundary_normals());
    let of = |continuity: f64, boundary_normals: &BoundaryNormals| Options {
        boundary_normals: boundary_normals.clone(),
        ..asked(continuity)
    };
    let auto = |normals: &BoundaryNormals| faired(&shape, &of(Options::CONTINUITY_AUTO, normals));
    let [fitted, tangent] = [auto(&BoundaryNormals::Fitted), faired(&shape, &of(0.0, &given))];
    assert_above!(loops(&fitted)[0].reached, 0.5);
    assert_same_items!(auto(&given).positions, tangent.positions);
    assert_empty!(loops(&auto(&given)));
    let surface = shape.surface.as_ref().expect("an exact surface");
    let curvature = |(v, _): &(u32, _)| (*v, surface.mean_curvature(shape.positions[*v as usize]));
    let curvatures = shape.boundary_normals().iter().map(curvature).collect();
    let curved = Options {
        boundary_curvature: BoundaryCurvature::Given(curvatures),
        ..of(Options::CONTINUITY_AUTO, &given)
    };
    assert_above!(loops(&faired(&shape, &curved))[0].reached, 0.5);
    let selection = Selection::Mask(&shape.free);
    let begun = Options::default();
    let mut solver = Solver::new(&shape.flat(), &shape.triangles, selection, &begun).unwrap();
    for (normals, is_continued) in [
        (&BoundaryNormals::Fitted, true),
        (&given, false),
        (&BoundaryNormals::Fitted, true),
    ] {
        solver.set_boundary_normals(normals.clone()).unwrap();
        let solution = solver.run(500, None).unwrap();
        assert_eq!(!loops(solution).is_empty(), is_continued);
    }
    solver.set_target(Target::MinimalEnergy).unwrap();
    assert_empty!(loops(solver.run(500, None).unwrap()));
}

/// The more noise there is, the larger is what estimates miss; and it covers what the noise does to them.
#[test]
fn what_estimates_miss_is_measured() {
    let shape = ellipsoid_cap([1.0, 0.8, 0.6], 50.0, 2_000, irregular(7), 10);
    let told = |size: f64| {
        let at = noisy(&shape, size, 3);
        let solution = fair(&at, &shape.triangles, Selection::Mask(&shape.free), &asked(1.0)).unwrap();
        loops(&solution)[0]
    };
    let clean = told(0.0);
    assert_below!(clean.uncertainty, 0.2 * clean.jump_before);
    let mut before = clean.uncertainty;
    for size in [0.003, 0.01, 0.03] {
        let of_loop = told(size);
        assert_above!(of_loop.uncertainty, before);
        assert_below!((of_loop.curvature - clean.curvature).abs(), of_loop.uncertainty);
        before = of_loop.uncertainty;
    }
}

#[test]
fn the_blend_acts_monotonically_on_the_jump() {
    let shape = ellipsoid_cap([1.0, 0.8, 0.6], 50.0, 2_000, irregular(7), 10);
    let jumps: Vec<f64> = [0.2, 0.4, 0.6, 0.8, 1.0]
        .map(|blend| loops(&faired(&shape, &asked(blend)))[0].jump)
        .to_vec();
    println!("{jumps:?}");
    assert!(jumps.is_sorted_by(|a, b| a > b), "{jumps:?}");
    let whole = faired(&shape, &asked(1.0));
    let [of_loop] = loops(&whole) else {
        panic!("one loop")
    };
    assert_above!(of_loop.reached, 0.8);
    assert_below!(of_loop.jump, 0.3 * of_loop.jump_before);
}

/// The exact curvature, given, does what the fitted one does.
#[test]
fn curvature_can_be_given() {
    let shape = torus(1_000);
    let surface = shape.surface.as_ref().unwrap();
    let exact = shape.boundary_normals().into_iter();
    let exact = exact.map(|(v, _)| (v, surface.mean_curvature(shape.positions[v as usize])));
    let options = Options {
        boundary_curvature: BoundaryCurvature::Given(exact.collect()),
        boundary_normals: BoundaryNormals::Given(shape.boundary_normals()),
        ..asked(1.0)
    };
    let tangent = error(&shape, &faired(&shape, &asked(0.0)));
    let given = error(&shape, &faired(&shape, &options));
    println!("{given:e} {tangent:e}");
    assert_below!(given, 0.2 * tangent);
}

#[test]
fn no_number_of_threads_changes_a_bit() {
    let shape = torus(3_000);
    let by = |threads| {
        faired(
            &shape,
            &Options {
                threads,
                ..asked(1.0)
            },
        )
    };
    let (one, two) = (by(1), by(2));
    assert_same_items!(one.positions, two.positions);
    assert_eq!(loops(&one), loops(&two));
}

#[test]
fn what_cannot_be_asked_is_refused() {
    let refused = |options: Options| match options.validate() {
        Err(Error::BadOption { name, .. }) => name,
        other => panic!("{other:?}"),
    };
    for blend in [-0.1, 1.5, f64::NAN] {
        assert_eq!(refused(asked(blend)), "continuity");
    }
    let solver = SolverKind::Paper(fairmesh::PaperOptions::default());
    assert_eq!(refused(Options { solver, ..asked(0.5) }), "continuity");
    let boundary_curvature = BoundaryCurvature::Given(vec![(3, 1.0), (4, f64::INFINITY)]);
    let options = Options {
        boundary_curvature,
        ..asked(1.0)
    };
    assert_eq!(refused(options), "boundary_curvature");
}
/// No coordinate of a free vertex is further off than this.
fn assert_same(shape: &Shape, ours: impl Fn(u32) -> [f64; 3], theirs: impl Fn(u32) -> [f64; 3], bound: f64) {
    for v in shape.free_vertices() {
        let (p, q) = (ours(v), theirs(v));
        assert!((0..3).all(|k| (p[k] - q[k]).abs() < bound), "{p:?} {q:?}");
    }
}

/// Boundary normals and curvatures are fitted: neither fit knows where the axes point.
#[test]
fn motions_and_units_do_not_matter() {
    let shape = torus(1_000);
    for continuity in [0.0, 1.0] {
        let options = Options {
            tolerance: TIGHT,
            ..asked(continuity)
        };
        let before = faired(&shape, &options);
        for scale in [1e-6, 1.0, 1e6] {
            let by = Similarity::new([1.0, 2.0, -1.0], 0.7, scale, [5.0 * scale, -2.0 * scale, scale]);
            let moved = faired(&shape.transformed(&by), &options);
            let (ours, theirs) = (&before.positions, &moved.positions);
            assert_same(
                &shape,
                |v| by.apply(ours[v as usize]),
                |v| theirs[v as usize],
                1e-11 * scale,
            );
            for (a, b) in loops(&before).iter().zip(loops(&moved)) {
                assert_near!(a.jump, scale * b.jump, 1e-6 * a.jump_before);
                assert_near!(a.reached, b.reached, 1e-9);
            }
        }
    }
}

#[test]
fn numbers_of_vertices_do_not_matter() {
    let shape = torus(1_000);
    let options = Options {
        tolerance: TIGHT,
        ..asked(1.0)
    };
    let before = faired(&shape, &options);
    let (other, new) = shape.renumbered(3);
    let after = faired(&other, &options);
    let (ours, theirs) = (&before.positions, &after.positions);
    assert_same(
        &shape,
        |v| ours[v as usize],
        |v| theirs[new[v as usize] as usize],
        1e-8,
    );
}

/// Where a vertex lies that another component moves says nothing of the surface there will be: it has no part in any curvature, be that
/// continued or left.
#[test]
fn what_another_component_moves_tells_no_curvature() {
    let shape = ellipsoid_cap([1.0, 0.8, 0.6], 80.0, 6000, irregular(5), 8);
    let around = |x: f64, radius: f64| -> Vec<bool> {
        let centre = [x, 0.0, 0.6 * (1.0 - x * x).sqrt()];
        let far = |p: &[f64; 3]| (0..3).map(|c| (p[c] - centre[c]).powi(2)).sum::<f64>();
        shape.positions.iter().map(|p| far(p) < radius * radius).collect()
    };
    let here = around(0.35, 0.3);
    // With some ten and some thirteen edges between them: a fitted normal does not see the other one.
    for (x, least) in [(-0.29, 0.0), (-0.37, 0.5)] {
        let there = around(x, 0.08);
        let both: Vec<bool> = here.iter().zip(&there).map(|(a, b)| a | b).collect();
        let result = |push: f64| {
            let mut positions = shape.positions.clone();
            for (p, _) in positions.iter_mut().zip(&there).filter(|(_, moves)| **moves) {
                p[2] -= push;
            }
            let selection = Selection::Mask(&both);
            let solution =
                fair(&positions, &shape.triangles, selection, &asked(1.0)).expect("a sound problem");
            let moved = solution.positions.iter().zip(&here).filter(|(_, moves)| **moves);
            let positions: Vec<[f64; 3]> = moved.map(|(p, _)| *p).collect();
            let of_loops = solution.report.components.iter().flat_map(|c| &c.continuity);
            let longest = *of_loops.max_by_key(|l| l.vertices).expect("a loop");
            (positions, longest)
        };
        let (clean, told) = result(0.0);
        assert_at_least!(told.reached, least);
        assert_eq!(result(0.05), (clean, told));
    }
}
