//! Sharp edges that reach the boundary of a region go on through it: exact solids at several places, sizes and seeds.

use crate::fairing::*;
use crate::regions::cube;
use crate::tier::tier;
use fairmesh::{
    Coincident, FillOptions, Loops, LooseReason, Options, Outcome, Selection, SharpFate, Solution,
    boundary_loops, crease_ends, fair, fill_holes,
};
use fairmesh_shapes::*;

/// A piece of a solid about a place of its chart, with edges of about `edge`.
pub(crate) fn piece(of: Creased, centre: [f64; 2], edge: f64, seed: u64) -> Shape {
    let n = (3.6276 * 0.25 / (edge * edge)) as usize;
    creased(of, (centre, 0.5), n, irregular(seed), 6)
}

fn sharp_options() -> Options {
    Options {
        sharp: 20.0,
        ..options(1e-9)
    }
}

/// How far a point is from the surface of the solid.
pub(crate) fn distance(of: Creased, p: [f64; 3]) -> f64 {
    let [x, y, z] = p;
    let r = x.hypot(y);
    match of {
        Creased::Wedge(degrees) => {
            let (s, c) = degrees.to_radians().sin_cos();
            let (first, second) = (z, y * s + z * c);
            if (degrees > 0.0) == (first < second) {
                second.abs()
            } else {
                first.abs()
            }
        }
        Creased::CappedCylinder => (r - 1.0).max(z).abs(),
        Creased::Cone(degrees) => {
            let (s, c) = degrees.to_radians().sin_cos();
            ((r - 1.0) * c - z * s).max(z).abs()
        }
        Creased::Tee(radius) => {
            let small = y.hypot(z) - radius;
            (r - 1.0).min(small).abs()
        }
        Creased::CubeCorner => x.max(y).max(z).abs(),
    }
}

pub(crate) fn worst(of: Creased, shape: &Shape, solution: &Solution) -> f64 {
    let free = shape.free_vertices().into_iter();
    Errors::of(free.map(|v| distance(of, solution.positions[v as usize]))).max
}

/// Edges of .06, or what else.
pub(crate) const EDGE: f64 = 0.06;
/// Where the crease passes the middle of the region.
pub(crate) const PLACES: [[f64; 2]; 3] = [[0.1, 0.05], [0.0, 0.2], [-0.1, -0.1]];

/// Fairs a piece whose interior is destroyed, and says how far it is off; all creases have to go on.
fn off(of: Creased, centre: [f64; 2], edge: f64, seed: u64) -> f64 {
    let shape = piece(of, centre, edge, seed);
    let solution = solve_as_asked(&shape, &shape.noise(seed, 0.5), sharp_options());
    let what = format!("{of:?} {centre:?} {edge} {seed}");
    let error = worst(of, &shape, &solution);
    println!("{what}: {error:.1e}");
    assert_success(&solution.report.outcome);
    let fates: Vec<SharpFate> = solution.report.sharp_edges.iter().map(|edge| edge.fate).collect();
    let wanted = match of {
        Creased::CubeCorner => SharpFate::Corner,
        _ => SharpFate::GoesOn,
    };
    assert_eq!(fates, [wanted], "{what}");
    error
}

/// The largest error at three places, for some seeds.
fn at_places(of: Creased, edge: f64) -> f64 {
    let seeds = 1..=*tier(&2, &10);
    let cases = PLACES
        .iter()
        .flat_map(|p| seeds.clone().map(move |seed| (*p, seed)));
    cases
        .map(|(place, seed)| off(of, place, edge, seed))
        .fold(0.0, f64::max)
}

#[test]
fn edges_and_corners_of_planes_are_exact() {
    for degrees in [30.0, -30.0, 90.0, -90.0, 150.0] {
        assert_below!(at_places(Creased::Wedge(degrees), EDGE), 1e-6);
    }
    assert_below!(at_places(Creased::CubeCorner, EDGE), 1e-6);
}

#[test]
fn the_rim_of_a_cylinder_is_met_to_second_order() {
    assert_below!(at_places(Creased::CappedCylinder, EDGE), 1e-4);
    let sizes = [0.12, 0.06, 0.03];
    let median = |edge: f64| {
        let seeds = 1..=7;
        let mut errors: Vec<f64> = seeds
            .map(|seed| off(Creased::CappedCylinder, PLACES[2], edge, seed))
            .collect();
        errors.sort_by(f64::total_cmp);
        errors[3]
    };
    let errors = sizes.map(median);
    let vertices = sizes.map(|edge| (1.0 / (edge * edge)) as usize);
    assert_above!(order(&errors, &vertices), 2.0);
}

/// A cone is not harmonic, nor is a curve in space known by its ends alone.
#[test]
fn other_edges_are_near() {
    assert_below!(at_places(Creased::Cone(30.0), EDGE), 2e-3);
    assert_below!(at_places(Creased::Tee(0.6), EDGE), 5e-2);
}

/// Of twenty ends one or two are not found.
#[test]
fn noise_of_a_tenth_of_an_edge_hides_few_right_angles() {
    let mut found = 0;
    for seed in 1..=10 {
        let of = Creased::Wedge(90.0);
        let mut shape = piece(of, PLACES[0], EDGE, seed);
        let free = shape.free.clone();
        shape.free.fill(true);
        let noisy = shape.noise(seed, 0.1);
        shape.free = free;
        let solution = solve_as_asked(&shape, &noisy, sharp_options());
        let edges = &solution.report.sharp_edges;
        let error = worst(of, &shape, &solution) / EDGE;
        println!(
            "{seed}: off by {error:.2} edges, {:?}, {edges:?}",
            solution.report.outcome
        );
        if edges.iter().any(|edge| edge.fate == SharpFate::GoesOn) {
            found += 1;
            assert_below!(error, 1.0);
        }
    }
    assert_above!(found, 7);
}

#[test]
fn what_is_smooth_keeps_its_bits() {
    for seed in 1..=3 {
        let shape = sphere_cap(60.0, 400, irregular(seed), 6);
        let x = flat(&shape);
        let [with, without] =
            [sharp_options(), options(1e-9)].map(|options| solve_as_asked(&shape, &x, options));
        assert_eq!(with.report.sharp_edges, []);
        assert_eq!(with.positions, without.positions);
    }
}

/// Where an end fits no other, nothing changes, and the report has reservations and says why.
#[test]
fn an_end_alone_is_told() {
    let of = Creased::Wedge(60.0);
    let shape = piece(of, PLACES[0], EDGE, 1);
    let ends = fairmesh::crease_ends(
        &shape.positions,
        &shape.triangles,
        fairmesh::Selection::Mask(&shape.free),
        fairmesh::Coincident::default(),
        20.0,
    );
    let ends = ends.unwrap();
    assert_eq!(ends.len(), 2);
    // Given normals say that the surface is smooth at one of them.
    let given = vec![(ends[0].vertex, ends[0].normals[0])];
    let given = fairmesh::BoundaryNormals::Given(given);
    let [with, without] = [sharp_options(), options(1e-9)].map(|options| {
        let options = Options {
            boundary_normals: given.clone(),
            ..options
        };
        solve_as_asked(&shape, &shape.positions, options)
    });
    assert_eq!(with.positions, without.positions);
    assert_eq!(with.report.sharp_edges.len(), 1);
    assert_eq!(with.report.sharp_edges[0].fate, SharpFate::Alone);
    let reason = LooseReason::SharpEdge;
    assert_eq!(with.report.outcome, Outcome::ConvergedLoosely { reason });
    assert_eq!(with.report.sharp_edges[0].ends[0].vertex, ends[1].vertex);
}

/// A cube with dented vertices about a point, faired: where it is after that is exact, and this many ends were found.
fn dented_cube(centre: impl Fn(f64, f64) -> [f64; 3], radius: f64, count: usize) {
    dented_cube_without(|_| false, centre, radius, count);
}

/// The same, where vertices with these coordinates (from 0 to 1) are fixed, too.
fn dented_cube_without(
    is_fixed: impl Fn([f64; 3]) -> bool,
    centre: impl Fn(f64, f64) -> [f64; 3],
    radius: f64,
    count: usize,
) {
    let (positions, triangles) = cube(8);
    let all = || positions.iter().flatten();
    let (low, high) = (
        all().copied().fold(f64::MAX, f64::min),
        all().copied().fold(f64::MIN, f64::max),
    );
    let centre = centre(low, high);
    let far = |p: &[f64; 3]| (0..3).map(|k| (p[k] - centre[k]).powi(2)).sum::<f64>().sqrt();
    let is_free =
        |p: &[f64; 3]| far(p) < radius * (high - low) && !is_fixed(p.map(|x| (x - low) / (high - low)));
    let free: Vec<bool> = positions.iter().map(is_free).collect();
    let mut dented = positions.clone();
    let inside = free.iter().zip(&mut dented).filter(|(free, _)| **free);
    inside.for_each(|(_, p)| {
        p.iter_mut()
            .for_each(|x| *x = 0.7 * *x + 0.3 * 0.5 * (low + high))
    });
    let solution = fair(&dented, &triangles, Selection::Mask(&free), &sharp_options()).unwrap();
    let edges = &solution.report.sharp_edges;
    assert_eq!(
        edges.iter().map(|edge| edge.ends.len()).sum::<usize>(),
        count,
        "{edges:?}"
    );
    assert_success(&solution.report.outcome);
    let off = |p: &[f64; 3]| {
        p.iter()
            .map(|x| (x - low).min(high - x).abs())
            .fold(f64::MAX, f64::min)
    };
    assert_below!(solution.positions.iter().map(off).fold(0.0, f64::max), 1e-6);
}

/// On a small part the next corner is five edges away, and wide fits see three faces.
#[test]
fn ends_are_found_beside_other_edges() {
    dented_cube(|low, _| [low; 3], 0.3, 3);
    dented_cube(|low, high| [low, low, 0.5 * (low + high)], 0.2, 2);
}

/// Four edges meet at two corners, and a fifth leads from one to the other, which nobody sees at the boundary.
#[test]
fn an_edge_between_two_corners_is_found() {
    dented_cube(|low, high| [low, low, 0.5 * (low + high)], 0.56, 4);
}

/// Where the boundary runs along a crease and through the corner, no free vertices take their places.
#[test]
fn a_corner_may_be_at_the_boundary() {
    let is_fixed = |[_, y, z]: [f64; 3]| y < 0.01 && z < 0.35;
    dented_cube_without(is_fixed, |low, _| [low; 3], 0.6, 3);
}

/// Three quadrants of planes about a corner, the first vertex, from which the diagonals of their cells lead away; the free ones of these places dented.
fn quadrants(is_free: impl Fn([u32; 3]) -> bool) -> Solution {
    const N: u32 = 12;
    let number = |[x, y, z]: [u32; 3]| (x * (N + 1) + y) * (N + 1) + z;
    let of = |v: &u32| [v / (N + 1) / (N + 1), v / (N + 1) % (N + 1), v % (N + 1)];
    let cells = (0..3).flat_map(|face| (0..N).flat_map(move |i| (0..N).map(move |j| (face, i, j))));
    let cell = |(face, i, j): (usize, u32, u32)| {
        let at = |i: u32, j: u32| {
            let mut cell = [0; 3];
            (cell[(face + 1) % 3], cell[(face + 2) % 3]) = (i, j);
            number(cell)
        };
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, c, b], [a, d, c]]
    };
    let mut triangles: Vec<[u32; 3]> = cells.flat_map(cell).collect();
    let mut ids: Vec<u32> = triangles.iter().flatten().copied().collect();
    ids.sort_unstable();
    ids.dedup();
    let local = |v: &u32| ids.binary_search(v).unwrap() as u32;
    triangles.iter_mut().flatten().for_each(|v| *v = local(v));
    let free: Vec<bool> = ids.iter().map(|v| is_free(of(v))).collect();
    let dented = |v: &u32| of(v).map(|x| f64::from(x) + if is_free(of(v)) { 0.3 } else { 0.0 });
    let positions: Vec<[f64; 3]> = ids.iter().map(dented).collect();
    fair(&positions, &triangles, Selection::Mask(&free), &sharp_options()).unwrap()
}

/// Two edges end outside in a corner at the boundary; the third one leads from there through the region.
#[test]
fn a_corner_at_the_boundary_starts_an_edge() {
    let solution = quadrants(|place| matches!(place, [0, 0, 1..5] | [0, 1..3, 3..5]));
    let [edge] = &solution.report.sharp_edges[..] else {
        panic!("{:?}", solution.report.sharp_edges);
    };
    assert_eq!(edge.fate, SharpFate::GoesOn);
    let ends = edge.ends.iter().map(|end| (end.vertex, end.chains.len()));
    assert_eq!(ends.collect::<Vec<_>>(), [(0, 2), (5, 1)]);
    assert_success(&solution.report.outcome);
    let off = |p: &[f64; 3]| p.iter().copied().fold(f64::MAX, f64::min).abs();
    assert_below!(solution.positions.iter().map(off).fold(0.0, f64::max), 1e-9);
}

/// Stairs with two regions on edges beside each other: neither edge is the other one's.
#[test]
fn regions_near_to_each_other_have_ends_of_their_own() {
    const LONG: u32 = 45;
    let at = |v: u32| {
        let (x, k) = (f64::from(v % LONG), v / LONG);
        let uneven = 1e-3 * f64::from(v * v % 7);
        [x, f64::from(k.div_ceil(2)) + uneven, -f64::from(k / 2) - uneven]
    };
    let positions: Vec<[f64; 3]> = (0..6 * LONG).map(at).collect();
    let cells = (0..5).flat_map(|k| (0..LONG - 1).map(move |i| k * LONG + i));
    let cell = |v: u32| [[v, v + 1, v + LONG + 1], [v, v + LONG + 1, v + LONG]];
    let triangles: Vec<[u32; 3]> = cells.flat_map(cell).collect();
    let free: Vec<u32> = [LONG + 16, 3 * LONG + 20]
        .into_iter()
        .flat_map(|v| v..v + 3)
        .collect();
    let selection = Selection::Vertices(&free);
    let mut ends = crease_ends(&positions, &triangles, selection, Coincident::default(), 20.0).unwrap();
    ends.retain(|end| [1, 3].contains(&(end.vertex / LONG)));
    assert_eq!(
        ends.iter().map(|end| end.vertex).collect::<Vec<_>>(),
        [LONG + 15, LONG + 19, 3 * LONG + 19, 3 * LONG + 23]
    );
}

/// Nothing is left to be solved, and there is no problem without free vertices.
#[test]
fn vertices_of_an_edge_alone_are_told_to_have_no_path() {
    let edges = quadrants(|place| matches!(place, [0, 0, 1..5]))
        .report
        .sharp_edges;
    assert_eq!(
        edges.iter().map(|edge| edge.fate).collect::<Vec<_>>(),
        [SharpFate::NoPath]
    );
}

/// A pyramid on a square, each side in planes of slope `down`, and which vertices are near to its top.
fn pyramid(down: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>, Vec<bool>) {
    const N: u32 = 24;
    let at = |v: u32| [v % (N + 1), v / (N + 1)].map(|k| f64::from(k) - 0.5 * f64::from(N));
    let count = 0..(N + 1) * (N + 1);
    let position = |v: u32| {
        let [x, y] = at(v);
        [x, y, -down * x.abs().max(y.abs())]
    };
    let cells = (0..N).flat_map(|j| (0..N).map(move |i| (i, j)));
    let triangles = cells.flat_map(|(i, j)| {
        let a = j * (N + 1) + i;
        let [a, b, c, d] = [a, a + 1, a + N + 2, a + N + 1];
        match (i < N / 2) == (j < N / 2) {
            true => [[a, b, c], [a, c, d]],
            false => [[a, b, d], [b, c, d]],
        }
    });
    let is_near = |v: u32| at(v)[0].hypot(at(v)[1]) < 5.2;
    (
        count.clone().map(position).collect(),
        triangles.collect(),
        count.map(is_near).collect(),
    )
}

#[test]
fn a_corner_of_four_is_found() {
    for down in [0.5, 1.5, -1.0] {
        let (mut positions, triangles, free) = pyramid(down);
        let is_free = |tri: &&[u32; 3]| tri.iter().any(|&v| free[v as usize]);
        let mut open = triangles.clone();
        open.retain(|tri| !is_free(&tri));
        let asked = FillOptions {
            loops: Loops::UpTo(60),
            ..FillOptions::default()
        };
        let filled = fill_holes(&positions, &open, &asked).unwrap();
        let inside = (0..).zip(&mut positions).filter(|(v, _)| free[*v as usize]);
        inside.for_each(|(_, p)| p[2] = 0.0);
        let faired = fair(&positions, &triangles, Selection::Mask(&free), &sharp_options()).unwrap();
        let hole = filled.loops.iter().find_map(|of| of.fairing.as_ref());
        for (report, positions) in [
            (&faired.report, &faired.positions),
            (hole.unwrap(), &filled.positions),
        ] {
            assert_success(&report.outcome);
            let fates: Vec<_> = report
                .sharp_edges
                .iter()
                .map(|of| (of.fate, of.ends.len()))
                .collect();
            assert_eq!(fates, [(SharpFate::Corner, 4)]);
            let off = |p: &[f64; 3]| (p[2] + down * p[0].abs().max(p[1].abs())).abs();
            // Free vertices beside those that a hole has no more are not new.
            let new = positions.iter().filter(|p| p[0].hypot(p[1]) < 5.2);
            assert_below!(new.map(off).fold(0.0, f64::max), 1e-6);
        }
    }
}

/// The crease has one or two edges outside before three meet.
#[test]
fn ends_are_found_beside_corners() {
    for cells in [3.0, 4.0] {
        let along = |low: f64, high: f64| [low, low, low + cells / 8.0 * (high - low)];
        dented_cube(along, 0.19, 2);
    }
}

/// A piece without its free vertices.
pub(crate) fn with_hole(of: Creased, centre: [f64; 2], edge: f64, seed: u64) -> Shape {
    let mut shape = piece(of, centre, edge, seed);
    let is_free = shape.free.clone();
    shape
        .triangles
        .retain(|tri| !tri.iter().any(|&v| is_free[v as usize]));
    shape
}

/// Fills the hole of a piece, and says how far the new vertices are off; all creases have to go on, and parents are of the loop.
fn filled_off(of: Creased, centre: [f64; 2], edge: f64, seed: u64) -> f64 {
    let shape = with_hole(of, centre, edge, seed);
    let loops = boundary_loops(&shape.positions, &shape.triangles).unwrap();
    let shortest = (0..loops.len()).min_by(|&a, &b| loops[a].length.total_cmp(&loops[b].length));
    let asked = FillOptions {
        loops: Loops::Chosen(vec![shortest.unwrap()]),
        fairing: sharp_options(),
        ..FillOptions::default()
    };
    let filled = fill_holes(&shape.positions, &shape.triangles, &asked).unwrap();
    let hole = filled
        .loops
        .iter()
        .find(|report| !report.triangles.is_empty())
        .unwrap();
    let fairing = hole.fairing.as_ref().unwrap();
    let what = format!("{of:?} {centre:?} {edge} {seed}: {:?}", fairing.sharp_edges);
    assert!(hole.is_success(), "{what}: {:?}", fairing.outcome);
    assert_eq!(fairing.sharp_edges.len(), 1, "{what}");
    assert!(!fairing.sharp_edges[0].vertices.is_empty(), "{what}");
    let loops = boundary_loops(&filled.positions, &filled.triangles).unwrap();
    assert_eq!(loops.len(), 1, "{what}");
    for parents in &filled.parents {
        assert_near!(parents.weights.iter().sum::<f64>(), 1.0, 1e-12);
        assert!(
            parents
                .vertices
                .iter()
                .all(|&v| (v as usize) < shape.positions.len())
        );
    }
    let new = filled.positions[shape.positions.len()..].iter();
    let error = new.map(|p| distance(of, *p)).fold(0.0, f64::max);
    println!("{what}: {error:.1e}");
    error
}

#[test]
fn holes_across_edges_are_closed_with_them() {
    let bars = [
        (Creased::Wedge(30.0), 1e-6),
        (Creased::Wedge(-90.0), 1e-6),
        (Creased::Wedge(150.0), 1e-6),
        (Creased::CubeCorner, 1e-6),
        (Creased::CappedCylinder, 1e-4),
        (Creased::Cone(30.0), 2e-4),
    ];
    for (of, bar) in bars {
        for place in PLACES {
            for seed in 1..=*tier(&2, &10) {
                assert_below!(filled_off(of, place, EDGE, seed), bar);
            }
        }
    }
}

/// Where it is smooth, a hole is filled with the same bits.
#[test]
fn smooth_holes_keep_their_bits() {
    let shape = sphere_cap(60.0, 400, irregular(1), 6);
    let triangles = shape
        .triangles
        .iter()
        .filter(|tri| !tri.iter().any(|&v| shape.free[v as usize]));
    let triangles: Vec<[u32; 3]> = triangles.copied().collect();
    let [with, without] = [sharp_options(), options(1e-9)].map(|fairing| {
        let asked = FillOptions {
            fairing,
            ..FillOptions::default()
        };
        fill_holes(&shape.positions, &triangles, &asked).unwrap()
    });
    assert_eq!(with.positions, without.positions);
    assert_eq!(with.triangles, without.triangles);
}

/// A divided hole keeps to the limit on new vertices, or is closed as others are; the curvature of its ends is in the unit of the mesh.
#[test]
fn divided_holes_keep_limits_and_units() {
    let mut shape = with_hole(Creased::CappedCylinder, PLACES[0], EDGE, 1);
    shape.positions.iter_mut().flatten().for_each(|x| *x *= 8.0);
    let loops = boundary_loops(&shape.positions, &shape.triangles).unwrap();
    let shortest = (0..loops.len()).min_by(|&a, &b| loops[a].length.total_cmp(&loops[b].length));
    for most in [0, 3, 30, 60, 1_000] {
        let asked = FillOptions {
            loops: Loops::Chosen(vec![shortest.unwrap()]),
            max_new_vertices: most,
            fairing: sharp_options(),
            ..FillOptions::default()
        };
        let filled = fill_holes(&shape.positions, &shape.triangles, &asked).unwrap();
        assert!(filled.positions.len() - shape.positions.len() <= most, "{most}");
        let fairing = filled.loops.last().unwrap().fairing.as_ref();
        for end in fairing
            .iter()
            .flat_map(|report| &report.sharp_edges)
            .flat_map(|edge| &edge.ends)
        {
            let curvature = end.curvature.iter().map(|k| k * k).sum::<f64>().sqrt();
            assert!((curvature - 1.0 / 8.0).abs() < 0.02, "{curvature}");
        }
    }
}

/// Beside the boundary an edge that goes on leaves triangles without a vertex that is free: they have moved, too, and are told of.
#[test]
fn triangles_between_an_edge_and_the_boundary_are_judged() {
    let (mut positions, triangles) = cube(8);
    let all = || positions.iter().flatten().copied();
    let (low, high) = (all().fold(f64::MAX, f64::min), all().fold(f64::MIN, f64::max));
    let h = (high - low) / 8.0;
    let place = |p: &[f64; 3]| p.map(|x| ((x - low) / h).round() as i32);
    let is_free = |p: &[f64; 3]| matches!(place(p), [2..=6, 0..=3, 0]);
    let free: Vec<bool> = positions.iter().map(is_free).collect();
    for p in &mut positions {
        match place(p) {
            // Fixed, in its plane, near the edge.
            [4, 0, 1] => p[2] = low + 0.05 * h,
            _ if is_free(p) => p[1] += 0.2 * h,
            _ => {}
        }
    }
    let solution = fair(&positions, &triangles, Selection::Mask(&free), &sharp_options()).unwrap();
    let edges = &solution.report.sharp_edges;
    assert!(
        edges.iter().any(|edge| edge.fate == SharpFate::GoesOn),
        "{edges:?}"
    );
    let moved = triangles.iter().filter(|t| t.iter().any(|&v| free[v as usize]));
    let angle = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| vector(&solution.positions[v as usize]));
        let at = |[p, q, r]: [nalgebra::Vector3<f64>; 3]| (q - p).angle(&(r - p)).to_degrees();
        at([a, b, c]).min(at([b, c, a])).min(at([c, a, b]))
    };
    let worst = moved.map(angle).fold(f64::MAX, f64::min);
    assert!(worst < 6.0);
    assert_below!((solution.report.quality.worst_angle - worst).abs(), 1e-9);
}
