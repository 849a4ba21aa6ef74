//! Edits and frames lead to the surfaces that fresh solves of the edited problems have.

use crate::fairing::*;
use fairmesh::{
    BoundaryNormals, Budget, Edit, Error, Frame, InnerFairness, Options, Selection, Solution, Solver, Target,
    fair,
};
use fairmesh_shapes::*;
use nalgebra::{Rotation3, Vector3};

const DEGREE: f64 = std::f64::consts::PI / 180.0;
const NO_LIMIT: Budget = Budget {
    evaluations: 0,
    seconds: 0.0,
    tolerance: 0.0,
};

fn given(shape: &Shape) -> Options {
    Options {
        boundary_normals: BoundaryNormals::Given(shape.boundary_normals()),
        ..options(1e-8)
    }
}

fn begin(shape: &Shape, options: &Options) -> Solver {
    let selection = Selection::Mask(&shape.free);
    Solver::new(&shape.positions, &shape.triangles, selection, options).unwrap()
}

/// The solver at the fair surface.
fn finished(shape: &Shape, options: &Options) -> Solver {
    let mut solver = begin(shape, options);
    assert_success(&solver.finish(None).unwrap().report.outcome);
    solver
}

/// Updates without a limit, and so to the end.
#[track_caller]
fn settle(solver: &mut Solver) {
    let frame = solver.update(&NO_LIMIT).unwrap();
    assert!(frame.is_settled, "{frame:?}");
}

fn tilt(vertex: u32, degrees: f64) -> Edit {
    Edit::Tilt {
        vertex,
        angle: degrees * DEGREE,
        falloff: 0.0,
    }
}

fn motion(vertices: &[u32], rotation: [f64; 3], translation: [f64; 3]) -> Edit {
    Edit::Move {
        vertices: vertices.to_vec(),
        rotation,
        centre: [0.3, -0.2, 0.1],
        translation,
        falloff: 0.0,
    }
}

fn bits(positions: &[[f64; 3]]) -> Vec<u64> {
    positions.iter().flatten().map(|x| x.to_bits()).collect()
}

fn farthest(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// A fresh solve with the positions and normals that the edited solver has.
fn afresh(shape: &Shape, edited: &Solution, options: &Options) -> Solution {
    let mut positions = shape.positions.clone();
    for (v, p) in positions.iter_mut().enumerate().filter(|(v, _)| !shape.free[*v]) {
        *p = edited.positions[v];
    }
    let options = Options {
        boundary_normals: BoundaryNormals::Given(edited.boundary_normals.clone()),
        ..options.clone()
    };
    fair(
        &positions,
        &shape.triangles,
        Selection::Mask(&shape.free),
        &options,
    )
    .unwrap()
}

/// The boundary vertices of the blend's first tube, and of the second.
fn circles(shape: &Shape) -> [Vec<u32>; 2] {
    let all: Vec<u32> = shape.boundary_normals().iter().map(|n| n.0).collect();
    let along = |v: u32, degrees: f64| {
        let (s, c) = (degrees * DEGREE).sin_cos();
        let p = shape.positions[v as usize];
        p[0] * c + p[1] * s
    };
    [0.0, 120.0].map(|d| {
        let on = all
            .iter()
            .copied()
            .filter(|&v| (along(v, d) - BLEND_DISTANCE).abs() < 1e-9);
        on.collect()
    })
}

#[test]
fn edits_lead_to_the_surface_of_a_fresh_solve() {
    let shape = cylinder_blend();
    let asked = given(&shape);
    let [first, second] = circles(&shape);
    assert_eq!((first.len(), second.len()), (32, 32));
    let mut solver = finished(&shape, &asked);
    let fair_surface = solver.solution().positions.clone();
    for edits in [
        vec![tilt(first[3], 20.0)],
        vec![tilt(first[0], -15.0), tilt(second[0], 10.0)],
        vec![Edit::Tilt {
            vertex: first[5],
            angle: 0.4,
            falloff: 0.8,
        }],
        vec![Edit::Twist {
            vertex: second[7],
            angle: 0.3,
            falloff: 0.0,
        }],
        vec![Edit::Bulge { amount: 0.25 }],
        vec![
            motion(&first, [0.1, 0.2, -0.1], [0.2, 0.0, 0.1]),
            tilt(first[0], 8.0),
        ],
        vec![Edit::Move {
            vertices: vec![first[4]],
            rotation: [0.0; 3],
            centre: [0.0; 3],
            translation: [0.1, 0.0, 0.0],
            falloff: 0.9,
        }],
    ] {
        solver.edit(&edits).unwrap();
        let frame = solver.update(&NO_LIMIT).unwrap();
        assert!(frame.is_settled && frame.step <= 1e-6, "{edits:?}: {frame:?}");
        let shown = solver.positions().to_vec();
        let found = solver.finish(None).unwrap();
        assert!(found.report.outcome.is_success(), "{edits:?}");
        let diagonal = found.report.diagonal;
        let fresh = afresh(&shape, found, &asked);
        let away = farthest(&found.positions, &fresh.positions) / diagonal;
        println!(
            "{edits:?}: {} evaluations, {away:e} away, {:e} shown",
            frame.evaluations,
            farthest(&found.positions, &shown) / diagonal
        );
        assert!(away < 1e-8, "{edits:?}: {away}");
        assert_below!(farthest(&found.positions, &shown), 3e-6 * diagonal);
        assert_above!(farthest(&found.positions, &fair_surface), 1e-3 * diagonal);
        assert_eq!(bits(solver.positions()), bits(&solver.solution().positions));
    }
    solver.edit(&[]).unwrap();
    let back = solver.finish(None).unwrap();
    let away = farthest(&back.positions, &fair_surface) / back.report.diagonal;
    assert!(away < 1e-8, "{away}");
}

/// A cap of the unit sphere about the north pole: rings of 6, 12, 18 ... vertices, the last of which is fixed.
fn cap_of_rings(half_angle: f64, rings: u32) -> Shape {
    let mut shape = sphere_cap(60.0, 50, Sampling::Regular, 0);
    let at = |ring: u32, k: u32| match ring {
        0 => 0,
        _ => 1 + 3 * ring * (ring - 1) + k % (6 * ring),
    };
    let place = |ring: u32, k: u32| {
        let theta = half_angle * DEGREE * f64::from(ring) / f64::from(rings);
        let phi = 60.0 * DEGREE * f64::from(k) / f64::from(ring.max(1));
        [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()]
    };
    let all = (0..=rings).flat_map(|ring| (0..(6 * ring).max(1)).map(move |k| (ring, k)));
    shape.positions = all.clone().map(|(ring, k)| place(ring, k)).collect();
    shape.free = all.map(|(ring, _)| ring < rings).collect();
    shape.normals = shape.positions.clone();
    shape.triangles.clear();
    for ring in 1..=rings {
        for (side, k) in (0..6).flat_map(|side| (0..ring).map(move |k| (side, k))) {
            let (outer, inner) = (side * ring + k, side * (ring - 1) + k);
            let (a, b, c) = (at(ring, outer), at(ring, outer + 1), at(ring - 1, inner));
            shape.triangles.push([a, b, c]);
            if k + 1 < ring {
                shape.triangles.push([c, b, at(ring - 1, inner + 1)]);
            }
        }
    }
    shape
}

/// Through the circle at the polar angle of 60 degrees goes a sphere for every tilt: that whose normals there have that angle more.
#[test]
fn a_cap_that_is_tilted_becomes_the_cap_of_another_sphere() {
    let shape = cap_of_rings(60.0, 16);
    let vertex = shape.boundary_normals()[0].0;
    for edit in [
        |_, degrees: f64| Edit::Bulge {
            amount: degrees * DEGREE,
        },
        tilt,
    ] {
        let mut solver = finished(&shape, &given(&shape));
        for degrees in [5.0, 15.0, 20.0, -10.0, -30.0] {
            solver.edit(&[edit(vertex, degrees)]).unwrap();
            settle(&mut solver);
            let found = solver.finish(None).unwrap();
            assert_success(&found.report.outcome);
            let (s, c) = (60.0 * DEGREE).sin_cos();
            let (s1, c1) = ((60.0 + degrees) * DEGREE).sin_cos();
            let (radius, centre) = (s / s1, c - s * c1 / s1);
            let free = shape
                .free_vertices()
                .into_iter()
                .map(|v| found.positions[v as usize]);
            let errors =
                Errors::of(free.map(|[x, y, z]| (x * x + y * y + (z - centre).powi(2)).sqrt() - radius));
            println!("{degrees}: {:e}", errors.max);
            assert!(errors.max < 1e-8, "{degrees}: {}", errors.max);
        }
    }
}

/// What has moved off its surroundings does not continue them.
#[test]
fn auto_continues_nothing_along_a_moved_loop() {
    let shape = ellipsoid_cap([1.0, 0.8, 0.6], 50.0, 400, irregular(7), 10);
    let mut solver = finished(&shape, &options(1e-8));
    let reached = |solution: &Solution| {
        let loops = solution.report.components[0].continuity.iter();
        loops.map(|of_loop| of_loop.reached).collect::<Vec<f64>>()
    };
    assert_above!(reached(solver.solution())[0], 0.5);
    let rim: Vec<u32> = shape.boundary_normals().iter().map(|(v, _)| *v).collect();
    solver.edit(&[motion(&rim, [0.0; 3], [0.0, 0.0, 0.1])]).unwrap();
    assert_empty!(reached(solver.finish(None).unwrap()));
    solver.edit(&[]).unwrap();
    assert_above!(reached(solver.finish(None).unwrap())[0], 0.5);
}

#[test]
fn a_rigid_motion_of_all_that_is_fixed_moves_the_surface() {
    let shape = sphere_cap(60.0, 500, irregular(1), OUTSIDE);
    let fixed: Vec<u32> = (0..shape.positions.len() as u32)
        .filter(|&v| !shape.free[v as usize])
        .collect();
    let (rotation, centre, translation) = ([0.3, -0.5, 0.4], [0.3, -0.2, 0.1], [0.7, 0.1, -0.4]);
    let turn = Rotation3::new(Vector3::from(rotation));
    let moved = |p: [f64; 3]| -> [f64; 3] {
        let about = Vector3::from(centre);
        (about + turn * (Vector3::from(p) - about) + Vector3::from(translation)).into()
    };
    // Fitted normals turn with what they were fitted to.
    for asked in [given(&shape), options(1e-8)] {
        let mut solver = finished(&shape, &asked);
        let before = solver.solution().clone();
        solver.edit(&[motion(&fixed, rotation, translation)]).unwrap();
        for &v in &fixed {
            let off = Vector3::from(solver.positions()[v as usize])
                - Vector3::from(moved(shape.positions[v as usize]));
            assert!(off.norm() < 1e-14, "at once, outside of the region as well");
        }
        solver.update(&NO_LIMIT).unwrap();
        let found = solver.finish(None).unwrap();
        let expected: Vec<[f64; 3]> = before.positions.iter().map(|&p| moved(p)).collect();
        assert_below!(
            farthest(&found.positions, &expected),
            1e-8 * before.report.diagonal
        );
        assert_eq!(found.report.outcome, before.report.outcome);
        for (a, b) in found.boundary_normals.iter().zip(&before.boundary_normals) {
            assert_below!((Vector3::from(a.1) - turn * Vector3::from(b.1)).norm(), 1e-13);
        }
    }
}

#[test]
fn a_twist_turns_the_normals_of_both_sides_by_opposite_angles() {
    let shape = cylinder_blend();
    let [first, _] = circles(&shape);
    let normals = |edit: Edit| {
        let mut solver = finished(&shape, &given(&shape));
        solver.edit(&[edit]).unwrap();
        solver.finish(None).unwrap().boundary_normals.clone()
    };
    let angle = 0.2;
    for (falloff, reach) in [(0.0, 32.0), (1.0, f64::NAN)] {
        let vertex = first[4];
        let turned = normals(Edit::Twist {
            vertex,
            angle,
            falloff,
        });
        // The tube's axis is x: what a normal has of it is the sine of its angle, and towards the region is outward.
        let of = |v: u32| turned.iter().find(|n| n.0 == v).unwrap().1[0];
        let phi = |v: u32| {
            let [_, y, z] = shape.positions[v as usize];
            z.atan2(y)
        };
        let mut largest = 0.0f64;
        for &v in &first {
            let away = (phi(v) - phi(vertex)).rem_euclid(std::f64::consts::TAU);
            let opposite = first
                .iter()
                .find(|&&w| {
                    let sum = away + phi(w) - phi(vertex);
                    (sum / std::f64::consts::TAU - (sum / std::f64::consts::TAU).round()).abs() < 1e-6
                })
                .unwrap();
            assert_below!((of(v) + of(*opposite)).abs(), 1e-12);
            if reach == 32.0 {
                // Seen from outside the region is on the left of who goes around the tube clockwise or not: the sign is that of a sine.
                let expected = (angle * away.sin()).sin();
                assert_near!(of(v).abs(), expected.abs(), 1e-12);
            }
            largest = largest.max(of(v).abs());
        }
        assert_below!(of(vertex).abs(), 1e-15);
        assert!(
            largest > 0.9 * angle.sin() && largest <= angle.sin() + 1e-12,
            "{largest}"
        );
        let other = normals(Edit::Twist {
            vertex,
            angle: -angle,
            falloff,
        });
        for (a, b) in turned.iter().zip(&other) {
            assert!((a.1[0] + b.1[0]).abs() < 1e-12 || !first.contains(&a.0));
        }
    }
}

#[test]
fn the_order_of_edits_that_do_not_meet_is_all_one() {
    let shape = cylinder_blend();
    let [first, second] = circles(&shape);
    let edits = [
        tilt(first[0], 10.0),
        tilt(second[3], -5.0),
        motion(&first, [0.0; 3], [0.1, 0.0, 0.0]),
        motion(&second, [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]),
    ];
    let found = |order: [usize; 4]| {
        let mut solver = finished(&shape, &given(&shape));
        solver.edit(&order.map(|k| edits[k].clone())).unwrap();
        solver.update(&NO_LIMIT).unwrap();
        bits(solver.positions())
    };
    let one = found([0, 1, 2, 3]);
    assert!(one == found([3, 1, 2, 0]));
    assert!(one == found([2, 3, 0, 1]));
}

/// Ten frames of a drag with these evaluations each, then one without limit.
fn dragged(solver: &mut Solver, vertex: u32, evaluations: usize) -> Vec<Frame> {
    let budget = Budget {
        evaluations,
        ..NO_LIMIT
    };
    let drag = (1..=10).map(|k| {
        solver.edit(&[tilt(vertex, f64::from(k))]).unwrap();
        solver.update(&budget).unwrap()
    });
    let mut frames: Vec<Frame> = drag.collect();
    frames.push(solver.update(&NO_LIMIT).unwrap());
    frames
}

#[test]
fn frames_by_evaluations_are_the_same_in_every_run_and_for_any_number_of_threads() {
    let shape = cylinder_blend_of(2000, irregular(1));
    let vertex = shape.boundary_normals()[0].0;
    let run = |threads| {
        let asked = Options {
            threads,
            ..given(&shape)
        };
        let mut solver = finished(&shape, &asked);
        let frames = dragged(&mut solver, vertex, 3);
        assert_all!(frames[..10].iter(), |f| f.evaluations <= 3);
        assert!(frames[10].is_settled, "{frames:?}");
        (frames, bits(solver.positions()))
    };
    let one = run(1);
    for k in 1..=3 {
        assert!(one == run(k), "{k}");
    }
}

#[test]
fn a_budget_is_kept_and_frames_go_on_where_the_last_one_has_ended() {
    let shape = cylinder_blend();
    let vertex = shape.boundary_normals()[0].0;
    let mut whole = finished(&shape, &given(&shape));
    whole.edit(&[tilt(vertex, 12.0)]).unwrap();
    let needed = whole.update(&NO_LIMIT).unwrap();
    assert!(needed.is_settled, "{needed:?}");
    assert_above!(needed.evaluations, 4);
    for evaluations in [1, 2, 3] {
        let mut solver = finished(&shape, &given(&shape));
        solver.edit(&[tilt(vertex, 12.0)]).unwrap();
        let budget = Budget {
            evaluations,
            ..NO_LIMIT
        };
        let (mut spent, mut last) = (0, f64::INFINITY);
        loop {
            let frame = solver.update(&budget).unwrap();
            assert_at_most!(frame.evaluations, evaluations);
            assert_above!(frame.evaluations, 0);
            assert!(frame.step <= last, "the best so far is shown");
            (spent, last) = (spent + frame.evaluations, frame.step);
            if frame.is_settled {
                break;
            }
        }
        assert_eq!(spent, needed.evaluations);
        assert_eq!(bits(solver.positions()), bits(whole.positions()));
        // The end is the end.
        let more = solver.update(&budget).unwrap();
        assert_eq!(more.evaluations, 0);
        assert!(more.is_settled, "{more:?}");
    }
}

/// However late it is, one evaluation is made: a drag comes on.
#[test]
fn a_budget_of_no_time_leaves_one_evaluation() {
    let shape = cylinder_blend();
    let vertex = shape.boundary_normals()[0].0;
    let mut solver = finished(&shape, &given(&shape));
    solver.edit(&[tilt(vertex, 5.0)]).unwrap();
    let budget = Budget {
        seconds: 1e-12,
        ..NO_LIMIT
    };
    let mut frames = 0;
    while !solver.update(&budget).unwrap().is_settled {
        frames += 1;
        assert_below!(frames, 100);
    }
    assert!(frames > 2, "{frames}");
    solver.edit(&[tilt(vertex, 6.0)]).unwrap();
    assert_eq!(solver.update(&budget).unwrap().evaluations, 1);
}

/// By one degree a frame over 30 degrees, to a step norm of 1e-6.
#[test]
fn a_degree_of_tilt_takes_few_evaluations() {
    for (shape, loops) in [
        (cylinder_blend(), 2),
        (cylinder_blend_of(5_000, Sampling::Regular), 1),
    ] {
        for circle in circles(&shape).iter().take(loops) {
            for direction in [1.0, -1.0] {
                let mut solver = finished(&shape, &given(&shape));
                let drag = (1..=30).map(|k| {
                    solver.edit(&[tilt(circle[0], direction * f64::from(k))]).unwrap();
                    let frame = solver.update(&NO_LIMIT).unwrap();
                    assert!(frame.is_settled, "{frame:?}");
                    assert_at_most!(frame.step, 1e-6);
                    frame.evaluations
                });
                let mut evaluations: Vec<usize> = drag.collect();
                println!("{} free, {direction}: {evaluations:?}", shape.free_count());
                evaluations.sort_unstable();
                assert!(evaluations[28] <= 12 && evaluations[15] <= 6, "{evaluations:?}");
            }
        }
    }
}

#[test]
fn frames_before_any_surface_are_those_of_the_first_solve() {
    let shape = cylinder_blend();
    let whole = finished(&shape, &given(&shape));
    let mut solver = begin(&shape, &given(&shape));
    assert_eq!(solver.positions(), &shape.positions[..]);
    let budget = Budget {
        evaluations: 4,
        ..NO_LIMIT
    };
    let mut frames = 0;
    while !solver.update(&budget).unwrap().is_settled {
        frames += 1;
        assert_below!(frames, 100);
    }
    assert_above!(frames, 1);
    assert_eq!(bits(solver.positions()), bits(&whole.solution().positions));
    let found = solver.finish(None).unwrap();
    assert_eq!(found.report.iterations, whole.solution().report.iterations);
    assert_eq!(bits(&found.positions), bits(&whole.solution().positions));
}

#[test]
fn an_edit_leaves_other_components_as_they_are() {
    let one = sphere_cap(60.0, 300, irregular(1), 2);
    let mut two = one.clone();
    let count = one.positions.len() as u32;
    let far = one.positions.iter().map(|p| [p[0] + 5.0, p[1], p[2]]);
    two.positions.extend(far);
    two.triangles
        .extend(one.triangles.iter().map(|t| t.map(|v| v + count)));
    two.free.extend(&one.free);
    two.normals.extend(&one.normals);
    let mut solver = finished(&two, &given(&two));
    let before = solver.solution().clone();
    solver.edit(&[tilt(one.boundary_normals()[0].0, 10.0)]).unwrap();
    settle(&mut solver);
    let of_second = |positions: &[[f64; 3]]| bits(&positions[count as usize..]);
    assert_eq!(of_second(solver.positions()), of_second(&before.positions));
    let found = solver.finish(None).unwrap();
    assert_eq!(of_second(&found.positions), of_second(&before.positions));
    assert_eq!(found.report.components[1], before.report.components[1]);
    assert_ne!(
        found.positions[..count as usize],
        before.positions[..count as usize]
    );
}

/// The curve has one normal for both of its sides: it turns with a tilt, and stays with a bulge, which would crease it.
#[test]
fn a_curve_between_two_components_has_one_normal() {
    let mut shape = cap_of_rings(60.0, 16);
    let on_ring = |v: usize, ring: usize| (1 + 3 * ring * (ring - 1)..1 + 3 * ring * (ring + 1)).contains(&v);
    (0..shape.free.len()).for_each(|v| shape.free[v] &= !on_ring(v, 8));
    let curve = 1 + 3 * 8 * 7;
    let asked = given(&shape);
    let mut solver = finished(&shape, &asked);
    assert_eq!(solver.solution().report.components.len(), 2);
    for (edit, turned) in [
        (tilt(curve, 10.0), 10.0),
        (Edit::Bulge { amount: 0.2 }, 0.0),
        (tilt(curve, -10.0), -10.0),
    ] {
        solver.edit(std::slice::from_ref(&edit)).unwrap();
        settle(&mut solver);
        let found = solver.finish(None).unwrap();
        // At the curve the cap's normals have a polar angle of 30 degrees; the inner side has the smaller vertex.
        let of_curve = found.boundary_normals.iter().filter(|n| on_ring(n.0 as usize, 8));
        for (v, n) in of_curve {
            let polar = n[2].acos() / DEGREE;
            assert!(
                (polar - 30.0 - turned).abs() < 1e-9,
                "{edit:?}, vertex {v}: {polar}"
            );
        }
        let fresh = afresh(&shape, found, &asked);
        let away = farthest(&found.positions, &fresh.positions) / found.report.diagonal;
        assert!(away < 1e-8, "{edit:?}: {away}");
    }
}

#[test]
fn copies_of_a_vertex_are_edited_as_one() {
    let shape = cylinder_blend();
    let [first, _] = circles(&shape);
    // Every triangle has vertices of its own.
    let corners: Vec<u32> = shape.triangles.iter().flatten().copied().collect();
    let soup: Vec<[f64; 3]> = corners.iter().map(|&v| shape.positions[v as usize]).collect();
    let triangles: Vec<[u32; 3]> = (0..shape.triangles.len() as u32)
        .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
        .collect();
    let free: Vec<bool> = corners.iter().map(|&v| shape.free[v as usize]).collect();
    let normals = corners
        .iter()
        .enumerate()
        .filter(|(_, v)| !shape.free[**v as usize]);
    let normals = normals
        .map(|(c, v)| (c as u32, shape.normals[*v as usize]))
        .collect();
    let asked = Options {
        boundary_normals: BoundaryNormals::Given(normals),
        ..options(1e-8)
    };
    let copy_of = |v: u32| corners.iter().rposition(|&c| c == v).unwrap() as u32;
    let handle: Vec<u32> = first.iter().map(|&v| copy_of(v)).collect();
    let edits = |vertex: u32, vertices: &[u32]| {
        [
            tilt(vertex, 10.0),
            motion(vertices, [0.0, 0.1, 0.0], [0.1, 0.0, 0.0]),
        ]
    };
    let mut solver = Solver::new(&soup, &triangles, Selection::Mask(&free), &asked).unwrap();
    solver.edit(&edits(handle[2], &handle)).unwrap();
    solver.finish(None).unwrap();
    let mut whole = finished(&shape, &given(&shape));
    whole.edit(&edits(first[2], &first)).unwrap();
    whole.finish(None).unwrap();
    for positions in [solver.positions(), &solver.solution().positions[..]] {
        for (c, &v) in corners.iter().enumerate() {
            let off = farthest(&[positions[c]], &[whole.positions()[v as usize]]);
            assert!(off < 1e-7, "{c}: {off}");
            assert_eq!(
                positions[c],
                positions[corners.iter().position(|&w| w == v).unwrap()]
            );
        }
    }
}

/// The matrix of a small surface makes the steps of a large one too short.
#[test]
fn a_surface_that_is_drawn_out_settles_where_it_is_finished() {
    let shape = cylinder_blend();
    let [first, _] = circles(&shape);
    let mut solver = finished(&shape, &given(&shape));
    for k in 1..=3 {
        solver
            .edit(&[motion(&first, [0.0; 3], [0.2 * f64::from(k), 0.0, 0.0])])
            .unwrap();
        let frame = solver.update(&NO_LIMIT).unwrap();
        assert!(frame.is_settled, "{k}: {frame:?}");
    }
    let shown = solver.positions().to_vec();
    let found = solver.finish(None).unwrap();
    let away = farthest(&shown, &found.positions) / found.report.diagonal;
    println!("{away:e}");
    assert!(away < 5e-6, "{away}");
}

#[test]
fn points_inside_the_region_are_moved() {
    let mut shape = sphere_cap(60.0, 1000, irregular(3), OUTSIDE);
    let inside = (0..shape.positions.len())
        .find(|&v| shape.positions[v][2] > 0.98)
        .unwrap();
    shape.free[inside] = false;
    let selected = shape.free_vertices();
    let asked = given(&shape);
    let mut solver = Solver::new(
        &shape.positions,
        &shape.triangles,
        Selection::Vertices(&selected),
        &asked,
    )
    .unwrap();
    solver.finish(None).unwrap();
    for height in [0.05, 0.1] {
        solver
            .edit(&[motion(&[inside as u32], [0.0; 3], [0.0, 0.0, height])])
            .unwrap();
        settle(&mut solver);
        let found = solver.finish(None).unwrap();
        assert_near!(
            found.positions[inside][2] - shape.positions[inside][2],
            height,
            1e-15
        );
        // The normal at the point is the surface's own.
        let mut fresh = shape.clone();
        fresh.positions[inside] = found.positions[inside];
        let selection = Selection::Vertices(&selected);
        let fresh = fair(&fresh.positions, &shape.triangles, selection, &asked).unwrap();
        let away = farthest(&found.positions, &fresh.positions) / found.report.diagonal;
        assert!(away < 1e-8, "{away}");
    }
}

#[test]
fn units_and_places_make_no_difference() {
    let shape = cylinder_blend();
    let [first, _] = circles(&shape);
    let surface = |scale: f64, away: f64| {
        let placed = |p: [f64; 3]| p.map(|x| x * scale + away);
        let mut there = shape.clone();
        there.positions.iter_mut().for_each(|p| *p = placed(*p));
        let mut solver = finished(&there, &given(&there));
        solver
            .edit(&[
                Edit::Move {
                    vertices: first.clone(),
                    rotation: [0.0, 0.2, 0.1],
                    centre: placed([1.2, 0.0, 0.0]),
                    translation: [0.1 * scale, 0.0, 0.05 * scale],
                    falloff: 0.5 * scale,
                },
                Edit::Tilt {
                    vertex: first[1],
                    angle: 0.2,
                    falloff: 0.7 * scale,
                },
            ])
            .unwrap();
        let frame = solver.update(&NO_LIMIT).unwrap();
        assert!(frame.is_settled, "{frame:?}");
        solver.finish(None).unwrap();
        let back = solver.positions().iter().map(|p| p.map(|x| (x - away) / scale));
        (frame.evaluations, back.collect::<Vec<_>>())
    };
    let (evaluations, here) = surface(1.0, 0.0);
    for (scale, away, bar) in [(1e-6, 0.0, 1e-8), (1e6, 0.0, 1e-8), (1.0, 1e4, 1e-7)] {
        let (needed, there) = surface(scale, away);
        println!(
            "{scale} {away}: {needed} evaluations, {:e}",
            farthest(&here, &there)
        );
        assert_below!(farthest(&here, &there), bar);
        assert_at_most!(needed.abs_diff(evaluations), 1);
    }
}

#[test]
fn the_constant_is_dragged_as_well() {
    let shape = sphere_cap(60.0, 1000, irregular(4), OUTSIDE);
    let mut solver = finished(&shape, &given(&shape));
    for c in [0.1, 0.2, 0.3] {
        solver.set_target(Target::Constant(c)).unwrap();
        let frame = solver.update(&NO_LIMIT).unwrap();
        assert!(frame.is_settled && frame.evaluations < 20, "{frame:?}");
    }
    let found = solver.finish(None).unwrap();
    let asked = Options {
        target: Target::Constant(0.3),
        ..given(&shape)
    };
    let fresh = afresh(&shape, found, &asked);
    assert_below!(
        farthest(&found.positions, &fresh.positions),
        1e-8 * found.report.diagonal
    );
}

#[test]
fn new_boundary_normals_are_edited_as_the_old_ones_were() {
    let shape = cylinder_blend();
    let vertex = shape.boundary_normals()[0].0;
    let asked = given(&shape);
    let mut solver = finished(&shape, &asked);
    solver
        .edit(&[Edit::Bulge { amount: 0.1 }, tilt(vertex, 5.0)])
        .unwrap();
    solver.update(&NO_LIMIT).unwrap();
    let expected = solver.finish(None).unwrap().clone();
    let mut other = shape.boundary_normals();
    // Shorter than one, within what is allowed.
    other.iter_mut().for_each(|n| n.1 = n.1.map(|x| x * 0.9995));
    solver
        .set_boundary_normals(BoundaryNormals::Given(other))
        .unwrap();
    assert_eq!(solver.edits().len(), 2);
    let found = solver.finish(None).unwrap();
    assert_below!(
        farthest(&found.positions, &expected.positions),
        1e-8 * found.report.diagonal
    );
}

/// Edits that are refused, and why.
fn wrong_edits(shape: &Shape) -> Vec<(Vec<Edit>, Error)> {
    let [first, _] = circles(shape);
    let inside = shape.free_vertices()[0];
    let count = shape.positions.len();
    let bad = |edit, vertex, why| Error::BadEdit { edit, vertex, why };
    let infinite = Edit::Bulge {
        amount: f64::INFINITY,
    };
    let backward = Edit::Tilt {
        vertex: first[0],
        angle: 0.1,
        falloff: -1.0,
    };
    let far = Error::CoordinateTooLarge {
        vertex: first[1] as usize,
        coordinate: 1e200,
    };
    let not_on_loop = Error::NotOnLoop {
        vertex: inside as usize,
    };
    let free = "only fixed vertices are moved, and this one is free";
    vec![
        (vec![tilt(inside, 1.0)], not_on_loop),
        (
            vec![tilt(first[0], 1.0), infinite],
            bad(1, None, "a number is not finite"),
        ),
        (
            vec![backward],
            bad(0, None, "the falloff has to be finite, and at least 0"),
        ),
        (
            vec![tilt(count as u32, 1.0)],
            Error::SelectionOutOfRange { index: count, count },
        ),
        (
            vec![motion(&[first[0], inside], [0.0; 3], [0.0; 3])],
            bad(0, Some(inside as usize), free),
        ),
        (vec![motion(&[first[1]], [0.0; 3], [1e200, 0.0, 0.0])], far),
    ]
}

#[test]
fn wrong_edits_and_budgets_are_refused_and_change_nothing() {
    let shape = cylinder_blend();
    let made = tilt(circles(&shape)[0][0], 5.0);
    let mut solver = finished(&shape, &given(&shape));
    solver.edit(std::slice::from_ref(&made)).unwrap();
    solver.update(&NO_LIMIT).unwrap();
    let before = bits(solver.positions());
    for (edits, error) in wrong_edits(&shape) {
        assert_eq!(solver.edit(&edits), Err(error));
        assert_eq!(solver.edits(), std::slice::from_ref(&made));
    }
    let (mut past, mut vague) = (NO_LIMIT, NO_LIMIT);
    past.seconds = -1.0;
    vague.tolerance = f64::NAN;
    for (budget, option) in [(past, "seconds"), (vague, "tolerance")] {
        let refused = solver.update(&budget);
        assert!(
            matches!(refused, Err(Error::BadOption { name, .. }) if name == option),
            "{option}: {refused:?}"
        );
    }
    settle(&mut solver);
    assert_eq!(bits(solver.positions()), before);
}

#[test]
fn a_wrong_edit_is_told_by_its_number_and_vertex() {
    let error = Error::BadEdit {
        edit: 3,
        vertex: Some(7),
        why: "no",
    };
    assert_eq!(error.to_string(), "edit 3, vertex 7: no");
}

/// The tube's end is pushed through the middle, or turned inside out: whatever comes of it, no folded surface is said to have settled, and
/// back at the beginning all is as it was.
#[test]
fn edits_that_are_too_much_are_not_said_to_settle_folded_and_are_taken_back() {
    let shape = cylinder_blend();
    let [first, _] = circles(&shape);
    let asked = given(&shape);
    let mut solver = finished(&shape, &asked);
    let fair_surface = solver.solution().positions.clone();
    for edit in [
        motion(&first, [0.0; 3], [-2.2, 0.0, 0.0]),
        motion(&first, [0.0, std::f64::consts::PI, 0.0], [0.0; 3]),
        tilt(first[0], 150.0),
        motion(&first, [0.0; 3], [1e5, 0.0, 0.0]),
    ] {
        solver.edit(std::slice::from_ref(&edit)).unwrap();
        let budget = Budget {
            evaluations: 100,
            ..NO_LIMIT
        };
        let frame = solver.update(&budget).unwrap();
        println!("{edit:?}: {frame:?}");
        assert_all!(solver.positions().iter().flatten(), |x| x.is_finite());
        if frame.is_settled {
            assert_at_most!(frame.step, 1e-6);
            let free_run = solver.run(1, None).unwrap();
            assert_empty!(free_run.report.quality.flipped);
        }
        solver.edit(&[]).unwrap();
        let frame = solver.update(&budget).unwrap();
        let found = solver.finish(None).unwrap();
        assert!(
            found.report.outcome.is_success(),
            "{frame:?}, {:?}",
            found.report.outcome
        );
        let away = farthest(&found.positions, &fair_surface) / found.report.diagonal;
        assert!(away < 1e-8, "{edit:?}: {away}");
    }
}

/// The options' limit of iterations ends a frame that has none of its own; the next one goes on.
#[test]
fn a_frame_without_a_limit_ends_where_the_iterations_do() {
    let shape = sphere_cap(60.0, 500, irregular(2), OUTSIDE);
    let asked = Options {
        max_iterations: 2,
        ..options(1e-8)
    };
    let mut solver = begin(&shape, &asked);
    let frame = solver.update(&NO_LIMIT).unwrap();
    assert!(!frame.is_settled);
    assert_at_most!(frame.evaluations, 3);
    let mut frames = 1;
    while !solver.update(&NO_LIMIT).unwrap().is_settled {
        frames += 1;
        assert_below!(frames, 50);
    }
}

/// Who turns the normals wants the edge that the surface has with its surroundings then: it is no crease that fitted normals have made.
#[test]
fn a_kink_that_edits_ask_for_is_no_crease() {
    let shape = sphere_cap(60.0, 500, irregular(2), OUTSIDE);
    let fitted = options(1e-8);
    let mut solver = finished(&shape, &fitted);
    for k in 1..=11 {
        let amount = -5.0 * f64::from(k) * DEGREE;
        solver.edit(&[Edit::Bulge { amount }]).unwrap();
        solver.update(&NO_LIMIT).unwrap();
    }
    let found = solver.finish(None).unwrap();
    let fresh = afresh(&shape, found, &fitted);
    println!(
        "{:?}, kink {}",
        found.report.outcome, found.report.quality.boundary_kink
    );
    assert_above!(found.report.quality.boundary_kink, 45.0);
    assert_eq!(found.report.outcome, fresh.report.outcome);
    assert_eq!(found.report.outcome, fairmesh::Outcome::Converged);
}

#[test]
fn other_inner_fairness_follows_too() {
    let shape = sphere_cap(60.0, 500, irregular(9), OUTSIDE);
    for inner_fairness in [InnerFairness::Conformal, InnerFairness::Convex] {
        let asked = Options {
            inner_fairness,
            ..given(&shape)
        };
        let mut solver = finished(&shape, &asked);
        solver.edit(&[Edit::Bulge { amount: 0.2 }]).unwrap();
        settle(&mut solver);
        let found = solver.finish(None).unwrap();
        let fresh = afresh(&shape, found, &asked);
        assert_below!(
            farthest(&found.positions, &fresh.positions),
            1e-8 * found.report.diagonal
        );
    }
}

#[test]
fn the_range_of_the_bulge_has_sound_surfaces_and_leaves_the_surface_at_hand() {
    let shape = sphere_cap(60.0, 500, irregular(5), OUTSIDE);
    let vertex = shape.boundary_normals()[0].0;
    let mut solver = finished(&shape, &given(&shape));
    solver
        .edit(&[Edit::Bulge { amount: 0.1 }, tilt(vertex, 3.0)])
        .unwrap();
    solver.update(&NO_LIMIT).unwrap();
    let before = solver.finish(None).unwrap().clone();
    let range = solver.bulge_range(None).unwrap();
    println!("{:?} degrees", range.map(|x| x / DEGREE));
    assert!(range[0] < -0.5 && range[1] > 0.5, "{range:?}");
    assert_eq!(solver.edits().len(), 2);
    assert_eq!(bits(solver.positions()), bits(&before.positions));
    assert_eq!(
        bits(&solver.finish(None).unwrap().positions),
        bits(&before.positions)
    );
    // In steps of the search the ends are reached.
    for end in range {
        let mut solver = finished(&shape, &given(&shape));
        for k in 1..=20 {
            let amount = end * f64::from(k) / 20.0;
            solver.edit(&[Edit::Bulge { amount }, tilt(vertex, 3.0)]).unwrap();
            solver.update(&NO_LIMIT).unwrap();
        }
        assert!(solver.finish(None).unwrap().report.outcome.is_success(), "{end}");
    }
    // Who stops the search gets what was found until then.
    let mut calls = 0;
    let mut stop = |_: &fairmesh::Progress| {
        calls += 1;
        if calls > 3 {
            std::ops::ControlFlow::Break(())
        } else {
            std::ops::ControlFlow::Continue(())
        }
    };
    let part = solver.bulge_range(Some(&mut stop)).unwrap();
    assert!(
        part[0] >= range[0] && part[1] <= range[1] && part != range,
        "{part:?}"
    );
    assert_eq!(bits(solver.positions()), bits(&before.positions));
}
