//! How runs end: cancelled, limited, refused, and what is promised about the surface in every case.

use std::collections::HashMap;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use crate::fairing::*;
use crate::tier::tier;
use fairmesh::{
    BoundaryNormals, Error, Options, Outcome, Progress, Selection, Solution, fair, fair_with_progress,
};
use fairmesh_shapes::*;

/// Fixed vertices keep their bits, the others have finite coordinates and stay near the region.
fn assert_usable(shape: &Shape, start: &[[f64; 3]], solution: &Solution) {
    let bits = |p: &[f64; 3]| p.map(f64::to_bits);
    let centre = shape.positions.iter().map(vector).sum::<nalgebra::Vector3<f64>>() / start.len() as f64;
    let reach = shape
        .positions
        .iter()
        .map(|p| (vector(p) - centre).norm())
        .fold(0.0, f64::max);
    for (v, p) in solution.positions.iter().enumerate() {
        if shape.free[v] {
            assert!((vector(p) - centre).norm() < 2.0 * reach, "vertex {v} at {p:?}");
        } else {
            assert_eq!(bits(p), bits(&start[v]), "fixed vertex {v}");
        }
    }
}

fn run_with(
    shape: &Shape,
    start: &[[f64; 3]],
    stop: impl Fn(&Progress) -> bool + Sync,
) -> (Solution, Vec<Progress>) {
    let mut told = Vec::new();
    let mut callback = |p: &Progress| {
        told.push(*p);
        if stop(p) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let options = Options {
        boundary_normals: BoundaryNormals::Given(shape.boundary_normals()),
        ..options(1e-8)
    };
    let selection = Selection::Mask(&shape.free);
    let solution = fair_with_progress(start, &shape.triangles, selection, &options, &mut callback).unwrap();
    (solution, told)
}

#[test]
fn cancelling() {
    let shape = cylinder_band(2_000, irregular(1), OUTSIDE);
    let start = shape.random(1);
    for at in [0, 1, 2, 5] {
        let (solution, told) = run_with(&shape, &start, |p| p.iterations >= at);
        let done = solution.report.iterations;
        println!("cancelled at iteration {at}: {done} done, {} calls", told.len());
        assert_eq!(solution.report.outcome, Outcome::Cancelled);
        assert!(done <= at + 1, "{done} iterations after a break at {at}");
        let after = told.iter().skip_while(|p| p.iterations < at).count();
        assert_eq!(after, 1, "calls from the break on");
        assert_usable(&shape, &start, &solution);
        assert!(
            !solution.report.outcome.is_success(),
            "{:?}",
            solution.report.outcome
        );
    }
}

/// At every call of the callback: the surface is the input or a usable one.
#[test]
fn cancelling_at_any_call() {
    let shape = cylinder_band(500, irregular(1), OUTSIDE);
    let start = shape.random(1);
    let mut last = 0;
    loop {
        let calls = AtomicUsize::new(0);
        let (solution, told) = run_with(&shape, &start, |_| calls.fetch_add(1, Relaxed) == last);
        assert!(told.is_sorted_by(|a, b| a.fraction <= b.fraction), "{told:?}");
        if solution.report.outcome != Outcome::Cancelled {
            // The last step had met the tolerance already.
            assert_success(&solution.report.outcome);
            break;
        }
        assert_eq!(told.len(), last + 1);
        assert_usable(&shape, &start, &solution);
        // Before the start surface is there.
        if told[last].fraction < 0.3 {
            assert_eq!(solution.positions, start, "stopped at call {last}");
        }
        last += 1;
    }
    assert!(last > 15, "{last} calls");
}

/// The fraction follows the work: the start surface takes more of it than the iterations, none of which is worth a third of the run.
#[test]
fn progress_moves_evenly_over_its_phases() {
    for (n, seed) in [(1_000, 1), (13_000, 2)] {
        let shape = cylinder_band(n, irregular(seed), OUTSIDE);
        let (solution, told) = run_with(&shape, &shape.random(seed), |_| false);
        assert_eq!(solution.report.outcome, Outcome::Converged);
        let phases: Vec<&str> = told.iter().map(|p| p.phase).collect();
        for phase in ["start surface", "fairing", "checks"] {
            assert!(phases.contains(&phase), "{phase}");
        }
        let before = told.iter().rfind(|p| p.iterations == 0).unwrap();
        assert!((0.5..0.7).contains(&before.fraction), "{}", before.fraction);
        assert!(told[0].fraction < 0.15, "{}", told[0].fraction);
        assert_above!(told.last().unwrap().fraction, 0.85);
        // What is told between iterations has the step norm of the last one.
        assert_all!(told.iter(), |p| p.step.is_nan() == (p.iterations == 0));
        let jumps = told.windows(2).map(|w| w[1].fraction - w[0].fraction);
        let largest = jumps.fold(0.0, f64::max);
        assert!(largest < 0.3, "a jump of {largest}");
    }
}

#[test]
fn a_callback_that_panics_ends_the_run() {
    let shape = cylinder_band(500, irregular(1), OUTSIDE);
    let start = shape.random(1);
    let run = || run_with(&shape, &start, |p| p.iterations > 1 && panic!("enough"));
    let panic = std::panic::catch_unwind(std::panic::AssertUnwindSafe(run)).map(|_| ());
    assert_eq!(panic.unwrap_err().downcast_ref(), Some(&"enough"));
}

#[test]
fn iteration_limit() {
    let shape = cylinder_band(2_000, irregular(1), OUTSIDE);
    let start = shape.random(1);
    let mut steps = Vec::new();
    for max_iterations in [1, 2, 4, 8] {
        let solution = solve(
            &shape,
            &start,
            Options {
                max_iterations,
                ..options(1e-8)
            },
        );
        let report = &solution.report;
        println!(
            "limit {max_iterations}: {} iterations, step {:.1e}",
            report.iterations, report.step
        );
        assert_eq!(report.outcome, Outcome::IterationLimit);
        assert_eq!(report.iterations, max_iterations);
        assert_usable(&shape, &start, &solution);
        steps.push(report.step);
    }
    assert!(steps[3] < 1e-2 * steps[0], "{steps:?}");
}

/// Enough iterations allowed: the limit changes nothing.
#[test]
fn exactly_enough_iterations() {
    let shape = cylinder_band(1_000, irregular(1), OUTSIDE);
    let free = solve(&shape, &shape.positions, options(1e-8));
    let max_iterations = free.report.iterations;
    let limited = solve(
        &shape,
        &shape.positions,
        Options {
            max_iterations,
            ..options(1e-8)
        },
    );
    assert_eq!(limited.report.outcome, Outcome::Converged);
    assert_same_items!(limited.positions, free.positions);
}

#[test]
fn progress_never_falls() {
    let blend = cylinder_blend();
    let rough = sphere_with_hole(30.0, 1_000, irregular(2), OUTSIDE);
    let cap = sphere_cap(60.0, 5_000, irregular(1), OUTSIDE);
    for (name, shape) in [("blend", &blend), ("hole", &rough), ("cap", &cap)] {
        let (solution, told) = run_with(shape, &shape.flat(), |_| false);
        println!(
            "{name}: {} iterations, {} calls, last fraction {:.2}, {}",
            solution.report.iterations,
            told.len(),
            told.last().unwrap().fraction,
            solution.report.outcome.name()
        );
        assert_all!(told.iter(), |p| (0.0..=1.0).contains(&p.fraction));
        assert_all!(told.windows(2), |w| w[0].fraction <= w[1].fraction);
        assert_all!(told.windows(2), |w| w[0].iterations <= w[1].iterations);
        assert_all!(told.windows(2), |w| w[1].iterations <= w[0].iterations + 1);
        // Those of attempts at a second surface are told as well, those on the coarse mesh are not.
        let own = &solution.report.components[0];
        let attempts = own
            .attempts
            .iter()
            .filter(|a| a.free_vertices == own.free_vertices);
        let all: usize = attempts.map(|a| a.iterations).sum();
        assert_eq!(told.last().unwrap().iterations, all);
        assert_all!(told.iter(), |p| !p.phase.is_empty());
        // Being watched changes nothing.
        let unwatched = solve(shape, &shape.flat(), options(1e-8));
        assert!(unwatched.positions == solution.positions, "{name}");
    }
}

#[test]
fn options_out_of_range() {
    let shape = cylinder_band(100, irregular(1), OUTSIDE);
    let refused = |options: Options| attempt(&shape, options).err();
    let tolerance_range = "at least 1e-15, the precision of double numbers, and less than 1";
    for tolerance in [
        0.0,
        f64::MIN_POSITIVE,
        1e-16,
        -1e-8,
        1.0,
        2.0,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
    ] {
        match refused(options(tolerance)) {
            Some(Error::BadOption {
                name: "tolerance",
                value,
                range,
            }) => {
                assert_eq!(value.to_bits(), tolerance.to_bits());
                assert_eq!(range, tolerance_range);
            }
            other => panic!("{tolerance}: {other:?}"),
        }
    }
    assert_eq!(
        refused(Options {
            max_iterations: 0,
            ..Options::default()
        }),
        Some(Error::BadOption {
            name: "max_iterations",
            value: 0.0,
            range: "at least 1"
        })
    );
    let text = refused(Options {
        max_iterations: 0,
        ..Options::default()
    })
    .unwrap()
    .to_string();
    assert_eq!(text, "option max_iterations is 0: it must be at least 1");
    for tolerance in [1e-15, 1.0 - f64::EPSILON] {
        assert_eq!(
            refused(Options {
                max_iterations: 20,
                ..options(tolerance)
            }),
            None
        );
    }
}

/// A band of which wrong problems are made.
fn sound_band() -> Shape {
    cylinder_band(100, irregular(1), OUTSIDE)
}

/// Why a problem is refused; nothing if it is not.
fn refusal(p: &[[f64; 3]], t: &[[u32; 3]], selection: Selection<'_>) -> Option<Error> {
    fair(p, t, selection, &options(1e-8)).err()
}

#[test]
fn wrong_selections_are_refused() {
    let shape = sound_band();
    let (p, t) = (&shape.positions, &shape.triangles);
    let n = p.len();
    assert_eq!(refusal(p, t, Selection::Mask(&shape.free)), None);

    assert_eq!(refusal(&[], &[], Selection::Mask(&[])), Some(Error::EmptyRegion));
    let nothing = vec![false; n];
    for empty in [
        Selection::Vertices(&[]),
        Selection::Faces(&[]),
        Selection::Faces(&[0]),
        Selection::Mask(&nothing),
    ] {
        assert_eq!(refusal(p, t, empty), Some(Error::EmptyRegion), "{empty:?}");
    }
    let short = refusal(p, t, Selection::Mask(&shape.free[1..]));
    let (length, count) = (n - 1, n);
    assert_eq!(short, Some(Error::MaskLength { length, count }));
    let free = shape.free_vertices()[0];
    for (beyond, count) in [
        (Selection::Vertices(&[free, n as u32]), n),
        (Selection::Faces(&[t.len() as u32]), t.len()),
    ] {
        let refused = refusal(p, t, beyond);
        assert_eq!(
            refused,
            Some(Error::SelectionOutOfRange { index: count, count }),
            "{beyond:?}"
        );
    }
}

#[test]
fn wrong_triangles_are_refused() {
    let shape = sound_band();
    let (p, t) = (&shape.positions, &shape.triangles);
    let mask = Selection::Mask(&shape.free);
    let triangle = t
        .iter()
        .position(|t| t.iter().any(|&v| shape.free[v as usize]))
        .unwrap();
    let [a, b, c] = t[triangle];
    let with = |corners: [u32; 3]| {
        let mut t = t.clone();
        t[triangle] = corners;
        t
    };
    let and = |corners: [u32; 3]| [&t[..], &[corners]].concat();
    let beyond = p.len() as u32;
    let (index, vertex_count) = (beyond, p.len());
    let out_of_range = Error::IndexOutOfRange {
        triangle,
        index,
        vertex_count,
    };
    assert_eq!(refusal(p, &with([a, b, beyond]), mask), Some(out_of_range));
    let vertex = a as usize;
    let repeated = Error::RepeatedIndex { triangle, vertex };
    assert_eq!(refusal(p, &with([a, b, a]), mask), Some(repeated));
    let (last, other) = (t.len(), triangle);
    let twice = Error::DuplicateTriangle {
        triangle: last,
        other,
    };
    assert_eq!(refusal(p, &and([b, c, a]), mask), Some(twice));
    let turned = refusal(p, &with([a, c, b]), mask);
    assert_matches!(turned, Some(Error::InconsistentOrientation { .. }));
    let more = [&p[..], &[[0.0; 3]]].concat();
    let free = shape.free_vertices();
    let third = refusal(&more, &and([a, b, beyond]), Selection::Vertices(&free));
    assert_matches!(third, Some(Error::NonManifoldEdge { .. }));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut p = p.clone();
        p[c as usize][1] = bad;
        let vertex = c as usize;
        assert_eq!(refusal(&p, t, mask), Some(Error::NotFinite { vertex }));
    }
}

#[test]
fn regions_without_a_boundary_are_refused() {
    let shape = sound_band();
    let (p, t) = (&shape.positions, &shape.triangles);
    let n = p.len();
    let everything = refusal(p, t, Selection::Mask(&vec![true; n]));
    assert_matches!(everything, Some(Error::FreeVertexOnBoundary { .. }));
    let tetrahedron = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let closed = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let nothing_fixed = refusal(&tetrahedron, &closed, Selection::Mask(&[true; 4]));
    assert_eq!(nothing_fixed, Some(Error::NothingFixed { vertex: 0 }));
    let more = [&p[..], &[[0.0; 3]]].concat();
    let lone = Selection::Vertices(&[shape.free_vertices()[0], n as u32]);
    let lone = refusal(&more, t, lone);
    assert_eq!(lone, Some(Error::FreeVertexWithoutTriangle { vertex: n }));
}

/// Three ways to say the same. Selected triangles free every vertex that has no others.
#[test]
fn selections_agree() {
    let mut shape = cylinder_band(500, irregular(1), OUTSIDE);
    let touches = |t: &[u32; 3]| t.iter().any(|&v| shape.free[v as usize]);
    let faces: Vec<u32> = (0..shape.triangles.len() as u32)
        .filter(|&t| touches(&shape.triangles[t as usize]))
        .collect();
    let mut enclosed = vec![true; shape.free.len()];
    for t in shape.triangles.iter().filter(|t| !touches(t)) {
        t.iter().for_each(|&v| enclosed[v as usize] = false);
    }
    shape.free = enclosed;
    let mut vertices = shape.free_vertices();
    vertices.reverse();
    vertices.extend_from_slice(&vertices.clone()[..5]);
    let options = Options {
        boundary_normals: BoundaryNormals::Given(shape.boundary_normals()),
        ..options(1e-8)
    };
    let run = |selection| {
        fair(&shape.positions, &shape.triangles, selection, &options)
            .unwrap()
            .positions
    };
    let masked = run(Selection::Mask(&shape.free));
    assert!(masked == run(Selection::Vertices(&vertices)));
    assert!(masked == run(Selection::Faces(&faces)));
}

#[test]
fn fixed_vertices_keep_their_bits() {
    let far = Similarity::new([1.0, 1.0, 0.0], 0.3, 0.1234, [1e5, -3e4, 7.7]);
    let cylinder = cylinder_band(1_000, irregular(1), OUTSIDE).transformed(&far);
    let hole = sphere_with_hole(30.0, 1_000, irregular(2), OUTSIDE);
    for shape in [cylinder, hole, cylinder_blend()] {
        let mut start = shape.flat();
        // Also the bits of negative zero, and of what is not near the region at all.
        start.push([-0.0, f64::NAN, f64::INFINITY]);
        let mut shape = shape;
        shape.positions.push(start[start.len() - 1]);
        shape.free.push(false);
        shape.normals.push([0.0; 3]);
        let solution = solve(&shape, &start, options(1e-8));
        for (v, p) in solution
            .positions
            .iter()
            .enumerate()
            .filter(|(v, _)| !shape.free[*v])
        {
            assert_eq!(p.map(f64::to_bits), start[v].map(f64::to_bits), "vertex {v}");
        }
    }
}

/// The plane is a fixed point of everything, so that even the last bits are right.
#[test]
fn plane() {
    let mut bars = Bars::default();
    for (n, seed) in [(1_000, 1), (1_000, 2), (13_000, 3)] {
        let mut shape = saddle_graph(n, irregular(seed), OUTSIDE);
        shape.positions.iter_mut().for_each(|p| p[2] = 0.0);
        shape.normals.fill([0.0, 0.0, 1.0]);
        let lifted = |shape: &Shape| {
            let mut start = shape.random(seed);
            let free = start.iter_mut().zip(&shape.free).filter(|(_, free)| **free);
            free.for_each(|(p, _)| p[2] = 0.3 * (5.0 * p[0]).sin() * (7.0 * p[1]).cos());
            start
        };
        for tilt in [0.0, 0.7] {
            let by = Similarity::new([1.0, 2.0, 0.0], tilt, 1.0, [0.0; 3]);
            let start: Vec<[f64; 3]> = lifted(&shape).into_iter().map(|p| by.apply(p)).collect();
            let tilted = shape.transformed(&by);
            for (name, solution) in [
                ("given", solve(&tilted, &start, options(1e-8))),
                ("fitted", solve_as_asked(&tilted, &start, options(1e-8))),
            ] {
                let height = |v: u32| by.undo(solution.positions[v as usize])[2];
                let e = Errors::of(shape.free_vertices().into_iter().map(height));
                println!("plane {n} tilted by {tilt}, {name} normals: {:.2e}", e.max);
                let what = format!("plane {n} tilted by {tilt}, {name} normals");
                bars.at_most(&what, e.max / solution.report.diagonal, 1e-8);
                bars.converged(&what, &solution);
            }
        }
    }
    bars.finish();
}

/// A fixed vertex inside, all of whose triangles are free: an interpolated point with its normal.
#[test]
fn interpolated_point() {
    let mut bars = Bars::default();
    for seed in 1..4 {
        let mut shape = sphere_cap(60.0, 1_000, irregular(seed), OUTSIDE);
        let apex = |v: &u32| shape.positions[*v as usize][2];
        let pole = shape
            .free_vertices()
            .into_iter()
            .max_by(|a, b| apex(a).total_cmp(&apex(b)))
            .unwrap();
        shape.free[pole as usize] = false;
        let mut start = shape.random(seed);
        start[pole as usize] = shape.positions[pole as usize];
        let solution = solve(&shape, &start, options(TIGHT));
        assert!(solution.boundary_normals.iter().any(|n| n.0 == pole));
        assert_eq!(solution.positions[pole as usize], shape.positions[pole as usize]);
        let e = errors(&shape, &solution);
        println!(
            "interpolated pole: {:.2e}, {} iterations, {}",
            e.max,
            solution.report.iterations,
            solution.report.outcome.name()
        );
        bars.at_most(format!("seed {seed}"), e.max, 1e-9);
        bars.converged(format!("seed {seed}"), &solution);
    }
    bars.finish();
}

/// Euler characteristic of the triangles with a free vertex.
fn euler_characteristic(shape: &Shape) -> i64 {
    let (mut vertices, mut edges, mut count) = (HashMap::new(), HashMap::new(), 0);
    for t in shape
        .triangles
        .iter()
        .filter(|t| t.iter().any(|&v| shape.free[v as usize]))
    {
        count += 1;
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            vertices.insert(a, ());
            edges.insert((a.min(b), a.max(b)), ());
        }
    }
    vertices.len() as i64 - edges.len() as i64 + count
}

/// Regions need not be discs: an annulus, a pair of pants, a torus with a disc fixed.
#[test]
fn regions_that_are_no_discs() {
    let mut bars = Bars::default();
    let annulus = cylinder_band(1_000, irregular(1), OUTSIDE);
    assert_eq!(euler_characteristic(&annulus), 0);
    let solution = solve(&annulus, &annulus.random(1), options(1e-8));
    bars.converged("annulus", &solution);
    bars.at_most("annulus", errors(&annulus, &solution).max, 4e-4);

    let pants = cylinder_blend();
    assert_eq!(euler_characteristic(&pants), -1);
    bars.converged("pair of pants", &solve(&pants, &pants.random(1), options(1e-8)));

    let handle = torus(48, 24);
    assert_eq!(euler_characteristic(&handle), -1);
    let solution = solve(&handle, &handle.positions, options(1e-8));
    let report = &solution.report;
    println!(
        "torus: {} iterations, {}",
        report.iterations,
        report.outcome.name()
    );
    assert_usable(&handle, &handle.positions, &solution);
    // A known shortfall: three quarters of a torus are not found from what is around the rest.
    bars.ends("torus", &solution, "not_converged");
    bars.finish();
}

/// A torus of radii 2 and 1, fixed where x > 2.5: one boundary curve, genus one.
fn torus(around: usize, across: usize) -> Shape {
    let mut shape = cylinder_blend_coarse();
    let at = |i: usize, j: usize| ((i % around) * across + j % across) as u32;
    let angle = |i: usize, n: usize| std::f64::consts::TAU * i as f64 / n as f64;
    shape.positions.clear();
    shape.normals.clear();
    shape.triangles.clear();
    for i in 0..around {
        for j in 0..across {
            let ((s, c), (sj, cj)) = (angle(i, around).sin_cos(), angle(j, across).sin_cos());
            shape.positions.push([(2.0 + cj) * c, (2.0 + cj) * s, sj]);
            shape.normals.push([cj * c, cj * s, sj]);
            let [a, b, d, e] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            shape.triangles.extend([[a, b, d], [a, d, e]]);
        }
    }
    shape.free = shape.positions.iter().map(|p| p[0] < 2.5).collect();
    shape
}

/// No angle below a degree, no two region triangles folded onto each other by more than 150 degrees.
fn is_sound(shape: &Shape, positions: &[[f64; 3]]) -> bool {
    let mut normals = HashMap::new();
    for t in shape
        .triangles
        .iter()
        .filter(|t| t.iter().any(|&v| shape.free[v as usize]))
    {
        let p = t.map(|v| vector(&positions[v as usize]));
        for k in 0..3 {
            let (e, f) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            let degrees = angle(&e.into(), &f.into());
            if degrees.is_nan() || degrees < 0.99 {
                return false;
            }
        }
        let normal: [f64; 3] = (p[1] - p[0]).cross(&(p[2] - p[0])).into();
        for k in 0..3 {
            normals.insert((t[k], t[(k + 1) % 3]), normal);
        }
    }
    let folded = |(&(a, b), n): (&(u32, u32), &[f64; 3])| {
        normals.get(&(b, a)).is_some_and(|other| angle(n, other) > 150.0)
    };
    !normals.iter().any(folded)
}

/// One boundary normal turned by a lot, about two axes: the surface is sound, but held with first-order curvature only. Once
/// the angle is small enough for both.
#[test]
fn a_contradictory_normal_ends_in_a_loose_sound_surface() {
    let mut bars = Bars::default();
    for (name, shape) in [
        ("cap", sphere_cap(60.0, 1_000, irregular(1), OUTSIDE)),
        ("cylinder", cylinder_band(1_000, irregular(1), OUTSIDE)),
        ("blend", cylinder_blend()),
    ] {
        let exact = shape.boundary_normals();
        let turns = [(7, 90.0f64), (11, 120.0), (3, 60.0), (20, 179.0)];
        for &(k, degrees) in tier(&turns[..2], &turns) {
            for axis in [[0.3, -0.2, 1.0], [1.0, 0.1, 0.2]] {
                let by = Similarity::new(axis, degrees.to_radians(), 1.0, [0.0; 3]);
                let mut given = exact.clone();
                given[k].1 = by.turn(given[k].1);
                let solution = solve_given(&shape, &shape.positions, &given, options(1e-8));
                let report = &solution.report;
                println!(
                    "{name:9} one normal off by {:5.1} degrees: {:3} iterations, {}, sound: {}",
                    angle(&given[k].1, &exact[k].1),
                    report.iterations,
                    report.outcome.name(),
                    is_sound(&shape, &solution.positions)
                );
                let what = format!("{name}, normal {k} turned by {degrees} degrees about {axis:?}");
                let sound = is_sound(&shape, &solution.positions);
                bars.check(&what, sound, "an unsound surface".to_owned());
                let case = (name, k, axis[0]);
                // Off by a right angle or less, the surface meets the normals around and has a crease at this one.
                let creased = [("cap", 7, 0.3), ("cylinder", 7, 0.3), ("blend", 7, 1.0)];
                let outcome = match case {
                    ("blend", 11 | 7, 0.3) => "converged",
                    case if creased.contains(&case) => "boundary_crease",
                    _ => "converged_loosely",
                };
                bars.ends(&what, &solution, outcome);
                assert_usable(&shape, &shape.positions, &solution);
            }
        }
    }
    bars.finish();
}

/// A sphere of meridians and parallels whose cap above `height` is flat and free: positions, triangles, and which vertices are free.
fn globe(meridians: usize, height: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>, Vec<bool>) {
    let parallels = meridians / 2;
    let mut positions = vec![[0.0, 0.0, 1.0]];
    for i in 1..parallels {
        let from_pole = std::f64::consts::PI * i as f64 / parallels as f64;
        for j in 0..meridians {
            let (sin, cos) = (std::f64::consts::TAU * j as f64 / meridians as f64).sin_cos();
            positions.push([from_pole.sin() * cos, from_pole.sin() * sin, from_pole.cos()]);
        }
    }
    let at = |i: usize, j: usize| (1 + (i - 1) * meridians + j % meridians) as u32;
    let mut triangles: Vec<_> = (0..meridians).map(|j| [0, at(1, j), at(1, j + 1)]).collect();
    for i in 1..parallels - 1 {
        for j in 0..meridians {
            triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    let free = positions.iter().map(|p| p[2] > height).collect();
    for p in &mut positions {
        p[2] = p[2].min(height);
    }
    (positions, triangles, free)
}

/// Neither the start from the coarse mesh nor the linear one leads to the surface there; what has led to it on the coarse mesh does.
#[test]
fn a_globe_of_262_meridians_is_a_sphere() {
    let (positions, triangles, free) = globe(262, 0.5);
    let solution = fair(&positions, &triangles, Selection::Mask(&free), &options(1e-8)).unwrap();
    let off = |p: &[f64; 3]| (vector(p).norm() - 1.0).abs();
    let error = solution.positions.iter().map(off).fold(0.0, f64::max);
    println!("{} iterations, error {error:.1e}", solution.report.iterations);
    assert!(
        solution.report.outcome == Outcome::Converged && error < 1e-8,
        "{error}"
    );
}

/// The triangles at the pole of a globe are needles whatever is done: nothing is tried that would not help.
#[test]
#[ignore = "full tier: 3 s"]
fn a_pole_of_400_meridians() {
    let meridians = 400;
    let (positions, triangles, free) = globe(meridians, 0.2);
    let solution = fair(&positions, &triangles, Selection::Mask(&free), &options(1e-8)).unwrap();
    let report = &solution.report;
    let off = |p: &[f64; 3]| (vector(p).norm() - 1.0).abs();
    let error = solution.positions.iter().map(off).fold(0.0, f64::max);
    println!(
        "{} free, {} iterations, error {error:.1e}",
        report.free_vertices, report.iterations
    );
    assert_matches!(report.outcome, Outcome::ConvergedPoorTriangles { .. });
    assert_empty!(report.quality.flipped);
    assert_at_least!(report.quality.needles.len(), meridians);
    assert!(error < 1e-8, "{error}");
    assert!(report.iterations <= 23, "{}", report.iterations);
}
