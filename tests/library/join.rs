//! Loops that get one patch together: pieces of spheres and cylinders, tubes on axes, islands in a plate.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use crate::fairing::{angle, distances_to_mesh, irregular, vector};
use fairmesh::{
    BoundaryNormals, Error, FillOptions, FillOutcome, Filled, GapKind, Join, Loops, OnFailure, OpenReason,
    Options, Outcome, Selection, boundary_loops, fair, fill_holes, suggest_joins,
};
use fairmesh_shapes::{
    Sampling, Shape, cylinder_band, cylinder_blend_fine, in_parts, plate, sphere_in_pieces, sphere_with_hole,
    sphere_without_band, tubes,
};

fn fill(shape: &Shape, loops: Loops, join: Join) -> Filled {
    fill_with(shape, loops, join, &Options::default())
}

fn fill_with(shape: &Shape, loops: Loops, join: Join, fairing: &Options) -> Filled {
    let options = FillOptions {
        loops,
        join,
        fairing: Options {
            threads: 1,
            ..fairing.clone()
        },
        ..FillOptions::default()
    };
    fill_holes(&shape.positions, &shape.triangles, &options).expect("a sound call")
}

/// All of these loops with one patch, no others.
fn join(shape: &Shape, loops: Vec<usize>) -> Filled {
    fill(shape, Loops::Chosen(Vec::new()), Join::Groups(vec![loops]))
}

/// The same with tangent planes alone.
fn tangent(shape: &Shape, loops: Vec<usize>) -> Filled {
    let tangent = Options {
        continuity: 0.0,
        ..Options::default()
    };
    fill_with(
        shape,
        Loops::Chosen(Vec::new()),
        Join::Groups(vec![loops]),
        &tangent,
    )
}

fn loop_count(shape: &Shape) -> usize {
    boundary_loops(&shape.positions, &shape.triangles).unwrap().len()
}

/// The mouths of tubes: of each tube's two loops the one nearer to the origin.
fn mouths(shape: &Shape) -> Vec<usize> {
    let loops = boundary_loops(&shape.positions, &shape.triangles).unwrap();
    let distance = |l: &usize| {
        let of = loops[*l].vertices.iter();
        let sum: f64 = of.map(|&v| vector(&shape.positions[v as usize]).norm()).sum();
        sum / loops[*l].vertices.len() as f64
    };
    let mut order: Vec<usize> = (0..loops.len()).collect();
    order.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
    order.truncate(loops.len() / 2);
    order
}

/// Vertices less edges plus triangles; no edge has three triangles, and every directed edge is there once.
fn euler(filled: &Filled) -> i64 {
    let mut edges = BTreeMap::new();
    let mut used = vec![false; filled.positions.len()];
    for t in &filled.triangles {
        for k in 0..3 {
            used[t[k] as usize] = true;
            let (a, b) = (t[k], t[(k + 1) % 3]);
            assert!(edges.insert((a, b), ()).is_none(), "edge ({a}, {b}) twice");
        }
    }
    let undirected = edges
        .keys()
        .filter(|&&(a, b)| a < b || !edges.contains_key(&(b, a)));
    let vertices = used.iter().filter(|&&used| used).count();
    vertices as i64 - undirected.count() as i64 + filled.triangles.len() as i64
}

fn new_vertices<'f>(shape: &Shape, filled: &'f Filled) -> &'f [[f64; 3]] {
    &filled.positions[shape.positions.len()..]
}

/// The only patch is faired, and converged.
fn check_fair(name: &str, filled: &Filled) {
    let [report] = &filled.loops[..] else {
        panic!("{name}: {} patches", filled.loops.len());
    };
    let ended = report.fairing.as_ref().map(|fairing| &fairing.outcome);
    assert_eq!(
        (&report.outcome, ended),
        (&FillOutcome::Faired, Some(&Outcome::Converged)),
        "{name}"
    );
    assert!(report.self_intersections.is_empty(), "{name}");
}

fn off_unit_sphere(points: &[[f64; 3]]) -> f64 {
    let off = |p: &[f64; 3]| (vector(p).norm() - 1.0).abs();
    points.iter().map(off).fold(0.0, f64::max)
}

#[test]
fn a_sphere_in_four_pieces_becomes_one() {
    pieces_become_one(1_500, 14.0, 1);
}

#[test]
#[ignore = "full tier: 5,000 vertices"]
fn a_finer_sphere_in_four_pieces_becomes_one() {
    pieces_become_one(5_000, 8.0, 2);
}

fn pieces_become_one(n: usize, gap: f64, seed: u64) {
    let shape = sphere_in_pieces(n, irregular(seed), gap);
    let count = loop_count(&shape);
    assert_eq!(count, 4);
    let filled = join(&shape, (0..count).collect());
    check_fair("pieces", &filled);
    assert_eq!(euler(&filled), 2);
    assert_empty!(boundary_loops(&filled.positions, &filled.triangles).unwrap());
    let error = off_unit_sphere(new_vertices(&shape, &filled));
    println!("{n} vertices, gap {gap}: {error:.1e}");
    assert!(error < 1e-8, "{error}");
    assert_eq!(filled.loops[0].loops, [0, 1, 2, 3]);
}

#[test]
fn a_sphere_without_a_band_is_closed() {
    for (width, seed) in [(15.0, 1), (60.0, 2)] {
        let shape = sphere_without_band(3_000, irregular(seed), width);
        let filled = join(&shape, vec![0, 1]);
        check_fair("band", &filled);
        assert_eq!(euler(&filled), 2);
        let error = off_unit_sphere(new_vertices(&shape, &filled));
        println!("width {width}: {error:.1e}");
        assert!(error < 1e-8, "{error}");
    }
}

#[test]
fn a_cylinder_without_a_band_is_met_as_well_as_with_a_given_one() {
    let off = |x: &[[f64; 3]]| {
        x.iter()
            .map(|p| (p[0].hypot(p[1]) - 1.0).abs())
            .fold(0.0, f64::max)
    };
    let band = cylinder_band(500, irregular(1), 4);
    let free = band.free_vertices();
    let given = fair(
        &band.flat(),
        &band.triangles,
        Selection::Vertices(&free),
        &Options::default(),
    )
    .unwrap();
    let bar = 5.0 * off(&given.positions);
    for gap in [0.5, 1.0, 2.0, 4.0] {
        let shape = tubes(&[[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]], 0.5 * gap, 500, irregular(1));
        let filled = join(&shape, mouths(&shape));
        check_fair("cylinder", &filled);
        let error = off(new_vertices(&shape, &filled));
        println!("gap {gap}: {error:.1e}, bar {bar:.1e}");
        assert!(error < bar, "{gap}: {error} {bar}");
    }
}

/// A map of space.
type Map = fn([f64; 3]) -> [f64; 3];

/// The directions of a star of `n` tubes, and maps of space that move it onto itself.
fn star(n: usize) -> (Vec<[f64; 3]>, Vec<Map>) {
    let axes: Vec<[f64; 3]> = match n {
        2 => vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        3 => (0..3)
            .map(|k| {
                let (sin, cos) = (TAU * f64::from(k) / 3.0).sin_cos();
                [cos, sin, 0.0]
            })
            .collect(),
        4 => vec![
            [1.0, 1.0, 1.0],
            [1.0, -1.0, -1.0],
            [-1.0, 1.0, -1.0],
            [-1.0, -1.0, 1.0],
        ],
        _ => (0..6)
            .map(|k| {
                [0, 1, 2].map(|j| {
                    if j == k / 2 {
                        1.0 - 2.0 * (k % 2) as f64
                    } else {
                        0.0
                    }
                })
            })
            .collect(),
    };
    let maps: Vec<Map> = match n {
        2 => vec![|p| [p[1], p[0], p[2]], |p| [p[0], p[1], -p[2]]],
        3 => vec![
            |p| {
                let (sin, cos) = (TAU / 3.0).sin_cos();
                [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1], p[2]]
            },
            |p| [p[0], p[1], -p[2]],
        ],
        4 => vec![|p| [p[1], p[2], p[0]], |p| [-p[0], -p[1], p[2]]],
        _ => vec![|p| [p[1], p[2], p[0]], |p| [-p[0], p[1], p[2]]],
    };
    (axes, maps)
}

/// How far the new surface is from itself when space is moved so, in its diagonals.
fn asymmetry(filled: &Filled, shape: &Shape, map: Map) -> f64 {
    let moved: Vec<[f64; 3]> = new_vertices(shape, filled).iter().map(|&p| map(p)).collect();
    let range = &filled.loops[0].triangles;
    let triangles = &filled.triangles[range.start as usize..range.end as usize];
    let diagonal = filled.loops[0].fairing.as_ref().unwrap().diagonal;
    let distances = distances_to_mesh(&moved, &filled.positions, triangles);
    distances.max / diagonal
}

#[test]
fn tubes_on_the_axes_of_polyhedra_are_blended_with_their_symmetry() {
    // The elbow of two tubes is sharp for its edges.
    tubes_are_blended_with_their_symmetry(&[(2, 2.0, 2e-3), (3, 2.4, 1e-3)]);
}

#[test]
#[ignore = "full tier: four and six tubes"]
fn more_tubes_on_the_axes_of_polyhedra_are_blended_with_their_symmetry() {
    tubes_are_blended_with_their_symmetry(&[(4, 2.5, 1e-3), (6, 2.5, 1e-3)]);
}

fn tubes_are_blended_with_their_symmetry(cases: &[(usize, f64, f64)]) {
    for &(n, distance, bar) in cases {
        let (axes, maps) = star(n);
        let shape = tubes(&axes, distance, 500, Sampling::Regular);
        let filled = join(&shape, mouths(&shape));
        check_fair(&format!("{n} tubes"), &filled);
        assert_eq!(euler(&filled), 2 - n as i64);
        for map in maps {
            let asymmetry = asymmetry(&filled, &shape, map);
            println!("{n} tubes: {asymmetry:.1e}");
            assert!(asymmetry < bar, "{n}: {asymmetry}");
        }
    }
}

#[test]
fn three_tubes_get_the_surface_that_is_found_on_the_given_blend() {
    let (axes, _) = star(3);
    let blend = cylinder_blend_fine();
    let options = Options {
        boundary_normals: BoundaryNormals::Given(blend.boundary_normals()),
        ..Options::default()
    };
    let free = blend.free_vertices();
    let given = fair(
        &blend.positions,
        &blend.triangles,
        Selection::Vertices(&free),
        &options,
    )
    .unwrap();
    // Its tubes have half the radius.
    let exact: Vec<[f64; 3]> = given.positions.iter().map(|p| p.map(|x| 2.0 * x)).collect();
    // Irregular tubes end in a zigzag, elsewhere than those circles.
    let shape = tubes(&axes, 2.4, 500, Sampling::Regular);
    // With tangent planes alone, as the blend.
    let filled = tangent(&shape, mouths(&shape));
    check_fair("blend", &filled);
    let distances = distances_to_mesh(new_vertices(&shape, &filled), &exact, &blend.triangles);
    let diagonal = filled.loops[0].fairing.as_ref().unwrap().diagonal;
    let largest = distances.max / diagonal;
    println!("{largest:.1e}");
    assert!(largest < 5e-3, "{largest}");
}

/// A plate with a round hole, and in it an island of so many fragments.
fn plate_with_island(n: usize, fragments: usize, seed: u64) -> Shape {
    in_parts(&plate(n, irregular(seed)), |p| {
        let (r, turns) = (p[0].hypot(p[1]), p[1].atan2(p[0]) / TAU);
        let sector = turns.rem_euclid(1.0) * fragments as f64;
        let off = (sector - sector.round()).abs() / fragments as f64 * TAU * r;
        if r > 0.6 {
            Some(0)
        } else {
            (r < 0.35 && off > 0.03).then_some(1 + sector as usize)
        }
    })
}

#[test]
fn a_plate_with_an_island_in_its_hole_becomes_flat() {
    plates_with_islands_become_flat(&[2]);
}

#[test]
#[ignore = "full tier: more fragments"]
fn a_plate_with_more_fragments_in_its_hole_becomes_flat() {
    plates_with_islands_become_flat(&[5, 10]);
}

fn plates_with_islands_become_flat(cases: &[usize]) {
    for &fragments in cases {
        let shape = plate_with_island(3_000, fragments, fragments as u64);
        let loops = boundary_loops(&shape.positions, &shape.triangles).unwrap();
        let outer = (0..loops.len()).max_by(|&a, &b| loops[a].length.total_cmp(&loops[b].length));
        let group: Vec<usize> = (0..loops.len()).filter(|&l| Some(l) != outer).collect();
        assert_eq!(group.len(), fragments + 1);
        let filled = join(&shape, group.clone());
        check_fair("plate", &filled);
        assert_eq!(euler(&filled), 1);
        assert_all!(filled.positions.iter(), |p| p[2].abs() < 1e-12);
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| vector(&filled.positions[v as usize]));
            (b - a).cross(&(c - a)).z
        };
        assert_all!(filled.triangles.iter(), |t| area(t) > 0.0);
        // Nobody has to say so.
        let found = suggest_joins(&shape.positions, &shape.triangles, &FillOptions::default()).unwrap();
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].loops, group);
        let auto = fill(&shape, Loops::UpTo(usize::MAX), Join::Auto);
        assert_eq!(auto.positions, filled.positions);
        assert_eq!(auto.triangles, filled.triangles);
        let open: Vec<_> = auto.loops.iter().filter(|of| of.joined.is_none()).collect();
        assert_eq!(open.len(), 1);
        assert_eq!(open[0].outcome, FillOutcome::LeftOpen(OpenReason::OuterBoundary));
    }
}

#[test]
fn only_what_belongs_together_is_joined_by_itself() {
    let groups = |shape: &Shape| -> Vec<Vec<usize>> {
        let found = suggest_joins(&shape.positions, &shape.triangles, &FillOptions::default()).unwrap();
        found.into_iter().map(|of| of.loops).collect()
    };
    assert_eq!(
        groups(&sphere_in_pieces(1_500, irregular(3), 14.0)),
        [[0, 1, 2, 3]]
    );
    assert_eq!(groups(&sphere_without_band(1_500, irregular(3), 40.0)), [[0, 1]]);
    let (axes, _) = star(3);
    let mut expected = mouths(&tubes(&axes, 2.4, 300, Sampling::Regular));
    expected.sort_unstable();
    assert_eq!(groups(&tubes(&axes, 2.4, 300, Sampling::Regular)), [expected]);
    // Two mouths that face each other from far away, two holes of one sphere, and a hole in a plate.
    assert_empty!(groups(&tubes(
        &[[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]],
        6.0,
        300,
        irregular(1)
    )));
    let sphere = fairmesh_shapes::sphere_with_hole(1.0, 2_000, irregular(1), 0);
    let near = |p: [f64; 3], q: [f64; 3]| angle(&p, &q) < 15.0;
    let holes = in_parts(&sphere, |p| {
        (!near(p, [0.0, 0.0, -1.0]) && !near(p, [0.64, 0.0, -0.77])).then_some(0)
    });
    assert_eq!(loop_count(&holes), 2);
    assert_empty!(groups(&holes));
    let plate = plate(1_000, irregular(1));
    let ring = in_parts(&plate, |p| (p[0].hypot(p[1]) > 0.5).then_some(0));
    assert_empty!(groups(&ring));
}

/// A torus of tube radius .4 about the unit circle, without a sixth of the way around: both ends are of the same part.
fn open_torus() -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let (n, m) = (40, 16);
    let at = |i: u32, j: u32| {
        let (u, v) = (
            TAU / 1.2 * f64::from(i) / f64::from(n),
            TAU * f64::from(j) / f64::from(m),
        );
        let r = 1.0 + 0.4 * v.cos();
        [r * u.cos(), r * u.sin(), 0.4 * v.sin()]
    };
    let x = (0..=n).flat_map(|i| (0..m).map(move |j| at(i, j))).collect();
    let quad = |i: u32, j: u32| {
        let next = (j + 1) % m;
        let [a, b, c, d] = [m * i + j, m * (i + 1) + j, m * (i + 1) + next, m * i + next];
        [[a, b, c], [a, c, d]]
    };
    (
        x,
        (0..n)
            .flat_map(|i| (0..m).flat_map(move |j| quad(i, j)))
            .collect(),
    )
}

#[test]
fn what_lies_between_loops_that_are_joined_is_named() {
    let kinds = |x: &[[f64; 3]], t: &[[u32; 3]]| -> Vec<GapKind> {
        let found = suggest_joins(x, t, &FillOptions::default()).unwrap();
        found.iter().map(|of| of.reason.kind).collect()
    };
    let of_shape = |shape: Shape| kinds(&shape.positions, &shape.triangles);
    assert_eq!(
        of_shape(sphere_without_band(1_500, irregular(3), 40.0)),
        [GapKind::Gap]
    );
    assert_eq!(of_shape(plate_with_island(1_500, 2, 1)), [GapKind::Island]);
    let (x, t) = open_torus();
    assert_eq!(kinds(&x, &t), [GapKind::Tunnel]);
    // The torus is whole again: as many vertices and triangles as edges.
    let options = FillOptions {
        join: Join::Auto,
        ..FillOptions::default()
    };
    let filled = fill_holes(&x, &t, &options).unwrap();
    assert_eq!(filled.loops[0].outcome, FillOutcome::Faired);
    assert_eq!(euler(&filled), 0);
}

#[test]
fn parts_that_face_opposite_ways_are_refused_by_name() {
    let turned = |mut shape: Shape, is_turned: fn([f64; 3]) -> bool| {
        let positions = &shape.positions;
        for t in &mut shape.triangles {
            if is_turned(positions[t[0] as usize]) {
                t.swap(1, 2);
            }
        }
        shape
    };
    let below = |p: [f64; 3]| p[2] < 0.0;
    for gap in [0.5, 1.0, 2.0, 4.0] {
        let shape = turned(
            tubes(&[[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]], 0.5 * gap, 300, irregular(1)),
            below,
        );
        let filled = join(&shape, mouths(&shape));
        let outcome = &filled.loops[0].outcome;
        let FillOutcome::LeftOpen(OpenReason::OppositeSides { a, b }) = *outcome else {
            panic!("gap {gap}: {outcome:?}");
        };
        assert_eq!(vec![a, b], filled.loops[0].loops);
        assert_eq!(filled.triangles, shape.triangles);
    }
    let shape = turned(sphere_without_band(2_000, irregular(1), 20.0), |p| p[0] > 0.0);
    let outcome = &join(&shape, vec![0, 1]).loops[0].outcome;
    assert_eq!(
        *outcome,
        FillOutcome::LeftOpen(OpenReason::OppositeSides { a: 0, b: 1 })
    );
    let shape = turned(plate_with_island(1_500, 2, 1), |p| {
        p[0].hypot(p[1]) < 0.4 && p[1] > 0.0
    });
    let loops = boundary_loops(&shape.positions, &shape.triangles).unwrap();
    let group: Vec<usize> = (0..loops.len()).filter(|&l| loops[l].length < 5.0).collect();
    assert_eq!(group.len(), 3);
    let outcome = &join(&shape, group).loops[0].outcome;
    assert_matches!(outcome, FillOutcome::LeftOpen(OpenReason::OppositeSides { .. }));
}

/// Two unit spheres that face outwards, and whose holes of 40 degrees face each other, with centres at this distance.
fn facing_spheres(distance: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let one = sphere_with_hole(40.0, 600, irregular(1), 0);
    let count = one.positions.len() as u32;
    let other = one.positions.iter().map(|&[x, y, z]| [x, y, -z - distance]);
    let turned = one
        .triangles
        .iter()
        .map(|&[a, b, c]| [a, c, b].map(|v| v + count));
    (
        one.positions.iter().copied().chain(other).collect(),
        one.triangles.iter().copied().chain(turned).collect(),
    )
}

/// At a distance of 3 the energy of the triangulation between them was less with one of them turned around.
#[test]
fn spheres_that_face_each_other_are_not_refused_at_any_distance() {
    for distance in [2.2, 2.5, 3.0, 4.0, 8.0] {
        let (x, t) = facing_spheres(distance);
        let options = FillOptions {
            join: Join::Groups(vec![vec![0, 1]]),
            ..FillOptions::default()
        };
        let outcome = &fill_holes(&x, &t, &options).unwrap().loops[0].outcome;
        let is_refused = matches!(outcome, FillOutcome::LeftOpen(OpenReason::OppositeSides { .. }));
        assert!(!is_refused, "distance {distance}");
    }
}

#[test]
fn groups_that_make_no_sense_are_refused() {
    let shape = sphere_without_band(1_000, irregular(1), 40.0);
    let refused = |join: Join| {
        let options = FillOptions {
            join,
            ..FillOptions::default()
        };
        fill_holes(&shape.positions, &shape.triangles, &options).unwrap_err()
    };
    let twice = refused(Join::Groups(vec![vec![0, 1], vec![1]]));
    assert_matches!(twice, Error::BadOption { name: "join", value, .. } if *value == 1.0);
    let none = refused(Join::Groups(vec![vec![0, 7]]));
    assert_matches!(none, Error::SelectionOutOfRange { index: 7, count: 2 });
}

#[test]
fn a_joint_patch_is_the_same_for_any_number_of_threads_and_order_of_its_loops() {
    let shape = sphere_in_pieces(600, irregular(4), 14.0);
    let with = |loops: Vec<usize>, threads: usize| {
        let options = FillOptions {
            loops: Loops::Chosen(Vec::new()),
            join: Join::Groups(vec![loops]),
            fairing: Options {
                threads,
                ..Options::default()
            },
            ..FillOptions::default()
        };
        fill_holes(&shape.positions, &shape.triangles, &options).unwrap()
    };
    let (one, two) = (with(vec![0, 1, 2, 3], 1), with(vec![2, 0, 3, 1], 2));
    assert_eq!(one.positions, two.positions);
    assert_eq!(one.triangles, two.triangles);
}

#[test]
fn what_has_no_fair_patch_stays_open_if_asked() {
    // The boundary of a flat sheet: nothing smooth lies over it.
    let shape = plate(300, irregular(1));
    let with = |on_failure: OnFailure| {
        let options = FillOptions {
            loops: Loops::Chosen(vec![0]),
            on_failure,
            ..FillOptions::default()
        };
        fill_holes(&shape.positions, &shape.triangles, &options).unwrap()
    };
    let open = with(OnFailure::Open);
    assert!(
        matches!(
            open.loops[0].outcome,
            FillOutcome::LeftOpen(OpenReason::NotFair | OpenReason::Intersecting)
        ),
        "{:?}",
        open.loops[0].outcome
    );
    assert_eq!(open.triangles, shape.triangles);
    for on_failure in [OnFailure::Best, OnFailure::Flat] {
        assert_above!(with(on_failure).triangles.len(), shape.triangles.len());
    }
}
