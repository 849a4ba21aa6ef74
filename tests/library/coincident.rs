//! Meshes whose vertices have several numbers: soups, seams, split normals. They end as the joined mesh does, to the last bit.

use crate::fairing::{assert_success, flat, irregular, options, solve_given, vector};
use fairmesh::{
    BoundaryCurvature, BoundaryLoop, BoundaryNormals, Coincident, Error, FillOptions, InnerFairness, Options,
    RemeshOptions, Selection, Solution, Solver, Target, boundary_loops, boundary_loops_joined, fair,
    fill_holes, mean_curvature, mean_curvature_joined, remesh_region,
};
use fairmesh_shapes::{OUTSIDE, Shape, ellipsoid_cap, sphere_cap, sphere_with_hole};

/// A mesh in which triangles of different classes have vertices of their own.
struct Split {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    /// Per vertex its number before; ascending.
    of: Vec<u32>,
}

fn split(positions: &[[f64; 3]], triangles: &[[u32; 3]], class: impl Fn(usize) -> usize) -> Split {
    let corners = triangles.iter().enumerate();
    let mut copies: Vec<(u32, usize)> = corners.flat_map(|(t, tri)| tri.map(|v| (v, class(t)))).collect();
    copies.sort_unstable();
    copies.dedup();
    let number = |v: u32, t: usize| copies.binary_search(&(v, class(t))).unwrap() as u32;
    Split {
        positions: copies.iter().map(|c| positions[c.0 as usize]).collect(),
        triangles: triangles
            .iter()
            .enumerate()
            .map(|(t, tri)| tri.map(|v| number(v, t)))
            .collect(),
        of: copies.iter().map(|c| c.0).collect(),
    }
}

impl Split {
    /// What each vertex had before.
    fn each<T: Copy>(&self, values: &[T]) -> Vec<T> {
        self.of.iter().map(|&v| values[v as usize]).collect()
    }

    /// A list for vertices, for all copies.
    fn listed<T: Copy>(&self, list: &[(u32, T)]) -> Vec<(u32, T)> {
        let found = |v: &u32| list.iter().find(|entry| entry.0 == *v).map(|entry| entry.1);
        (0..)
            .zip(&self.of)
            .filter_map(|(copy, v)| Some((copy, found(v)?)))
            .collect()
    }
}

/// A dented sphere, and the classes of its triangles: a seam through the dent, and a soup.
fn dented() -> (Shape, Vec<[f64; 3]>) {
    let cap = sphere_cap(60.0, 300, irregular(3), OUTSIDE);
    let start = flat(&cap);
    (cap, start)
}

fn by_side(shape: &Shape) -> impl Fn(usize) -> usize {
    |t| {
        usize::from(
            shape.triangles[t]
                .iter()
                .map(|&v| shape.positions[v as usize][0])
                .sum::<f64>()
                > 0.0,
        )
    }
}

fn bits(positions: &[[f64; 3]]) -> Vec<[u64; 3]> {
    positions.iter().map(|p| p.map(f64::to_bits)).collect()
}

/// The surface of the split mesh is that of the joined one, for all copies.
fn assert_same(split: &Split, theirs: &Solution, joined: &Solution) {
    assert_eq!(bits(&theirs.positions), bits(&split.each(&joined.positions)));
    assert_eq!(theirs.mean_curvature, split.listed(&joined.mean_curvature));
    assert_eq!(
        theirs.gaussian_curvature,
        split.listed(&joined.gaussian_curvature)
    );
    assert_eq!(theirs.boundary_normals, split.listed(&joined.boundary_normals));
    let (a, b) = (&theirs.report, &joined.report);
    assert_eq!(
        (&a.outcome, a.iterations, a.free_vertices),
        (&b.outcome, b.iterations, b.free_vertices)
    );
    assert_eq!(
        bits_of(&[a.defect, a.step, a.diagonal]),
        bits_of(&[b.defect, b.step, b.diagonal])
    );
}

#[test]
fn a_dented_sphere_with_a_seam_or_as_a_soup_ends_as_the_joined_one() {
    let (cap, start) = dented();
    let asked = Options {
        inner_fairness: InnerFairness::Conformal,
        ..options(1e-8)
    };
    let joined = fair(&start, &cap.triangles, Selection::Mask(&cap.free), &asked).unwrap();
    assert_success(&joined.report.outcome);
    for split in [
        split(&start, &cap.triangles, by_side(&cap)),
        split(&start, &cap.triangles, |t| t),
    ] {
        assert_above!(split.positions.len(), start.len());
        let mask = split.each(&cap.free);
        let theirs = fair(&split.positions, &split.triangles, Selection::Mask(&mask), &asked).unwrap();
        assert_same(&split, &theirs, &joined);
        // Fixed copies have their bits.
        let fixed = (0..mask.len()).filter(|&v| !mask[v]);
        assert_above!(fixed.clone().count(), 10);
        fixed.for_each(|v| assert_eq!(theirs.positions[v], split.positions[v]));

        let separate = Options {
            coincident: Coincident::Separate,
            ..asked.clone()
        };
        let refused = fair(
            &split.positions,
            &split.triangles,
            Selection::Mask(&mask),
            &separate,
        );
        assert_matches!(refused, Err(Error::FreeVertexOnBoundary { .. }));
    }
}

#[test]
fn faces_that_are_selected_across_a_seam() {
    let (cap, start) = dented();
    let faces: Vec<u32> = (0..)
        .zip(&cap.triangles)
        .filter(|(_, tri)| tri.iter().any(|&v| cap.free[v as usize]))
        .map(|(t, _)| t)
        .collect();
    let asked = options(1e-8);
    let joined = fair(&start, &cap.triangles, Selection::Faces(&faces), &asked).unwrap();
    let split = split(&start, &cap.triangles, |t| t % 3);
    let theirs = fair(
        &split.positions,
        &split.triangles,
        Selection::Faces(&faces),
        &asked,
    )
    .unwrap();
    assert_same(&split, &theirs, &joined);
}

#[test]
fn a_list_names_a_vertex_by_any_copy_and_a_mask_by_all_copies() {
    let (cap, start) = dented();
    let asked = options(1e-8);
    let joined = fair(&start, &cap.triangles, Selection::Mask(&cap.free), &asked).unwrap();
    let split = split(&start, &cap.triangles, |t| t);
    // The last copy of each.
    let last = |v: usize| split.of.get(v + 1) != Some(&split.of[v]);
    let is_free = |v: usize| cap.free[split.of[v] as usize];
    let named = (0..split.of.len()).filter(|&v| last(v) && is_free(v));
    let list: Vec<u32> = named.map(|v| v as u32).collect();
    let theirs = fair(
        &split.positions,
        &split.triangles,
        Selection::Vertices(&list),
        &asked,
    )
    .unwrap();
    assert_same(&split, &theirs, &joined);

    let held = cap.free_vertices()[20];
    let mut mask = cap.free.clone();
    mask[held as usize] = false;
    let joined = fair(&start, &cap.triangles, Selection::Mask(&mask), &asked).unwrap();
    let copy = split.of.iter().position(|&v| v == held).unwrap();
    let mut mask = split.each(&cap.free);
    mask[copy + 1] = false;
    let theirs = fair(&split.positions, &split.triangles, Selection::Mask(&mask), &asked).unwrap();
    assert_same(&split, &theirs, &joined);
}

#[test]
fn zero_with_a_sign_is_zero_and_nan_is_refused_as_ever() {
    let (cap, start) = dented();
    let mut split = split(&start, &cap.triangles, |t| t);
    let inside = cap.boundary_normals()[0].0;
    let fixed = split.of.iter().position(|&v| v == inside).unwrap();
    let asked = options(1e-4);
    // All vertices of the plane y = 0 have both zeros.
    for (v, p) in split.positions.iter_mut().enumerate() {
        p[1] = if p[1].abs() < 0.02 {
            [0.0, -0.0][v % 2]
        } else {
            p[1]
        };
    }
    assert_eq!(
        boundary_loops(&split.positions, &split.triangles).unwrap().len(),
        1
    );
    split.positions[fixed][0] = f64::NAN;
    let loops = boundary_loops(&split.positions, &split.triangles).unwrap();
    assert_above!(loops.len(), 1);
    let vertex = split.of.iter().position(|&v| cap.free[v as usize]).unwrap();
    split.positions[vertex][1] = f64::NAN;
    let refused = fair(
        &split.positions,
        &split.triangles,
        Selection::Vertices(&[vertex as u32]),
        &asked,
    );
    assert_eq!(refused.unwrap_err(), Error::NotFinite { vertex });
}

/// The mesh `(positions, triangles)` is the same whether coincident vertices are joined or not.
fn assert_left_apart(positions: &[[f64; 3]], triangles: &[[u32; 3]]) {
    let loops = |coincident| -> Vec<BoundaryLoop> {
        boundary_loops_joined(positions, triangles, coincident).unwrap()
    };
    assert_eq!(loops(Coincident::default()), loops(Coincident::Separate));
    assert_eq!(
        bits_of(&mean_curvature(positions, triangles).unwrap()),
        bits_of(&mean_curvature_joined(positions, triangles, Coincident::Separate).unwrap())
    );
}

fn bits_of(values: &[f64]) -> Vec<u64> {
    values.iter().map(|x| x.to_bits()).collect()
}

/// A sheet of `n` by `n` squares with vertices of its own, and its place.
fn add_sheet(mesh: &mut (Vec<[f64; 3]>, Vec<[u32; 3]>), n: u32, at: impl Fn(f64, f64) -> [f64; 3]) {
    let first = mesh.0.len() as u32;
    let grid = |m: u32| (0..m).flat_map(move |i| (0..m).map(move |j| (i, j)));
    mesh.0
        .extend(grid(n + 1).map(|(i, j)| at(f64::from(i), f64::from(j))));
    let number = |i, j| first + (n + 1) * i + j;
    for (i, j) in grid(n) {
        let [a, b, c, d] = [
            number(i, j),
            number(i + 1, j),
            number(i + 1, j + 1),
            number(i, j + 1),
        ];
        mesh.1.extend([[a, b, c], [a, c, d]]);
    }
}

#[test]
fn sheets_that_touch_stay_apart() {
    // In a corner; a book of four leaves; two sides of one sheet; the same sheet twice.
    let mut corner = Default::default();
    add_sheet(&mut corner, 4, |u, v| [u, v, 0.0]);
    add_sheet(&mut corner, 4, |u, v| [-u, -v, 0.1 * u * v]);
    assert_left_apart(&corner.0, &corner.1);

    let mut book = Default::default();
    add_sheet(&mut book, 4, |u, v| [u, v, 0.0]);
    add_sheet(&mut book, 4, |u, v| [-u, -v + 4.0, 0.0]);
    add_sheet(&mut book, 4, |u, v| [0.0, v, u]);
    add_sheet(&mut book, 4, |u, v| [0.0, -v + 4.0, -u]);
    assert_left_apart(&book.0, &book.1);

    let mut sides = Default::default();
    add_sheet(&mut sides, 4, |u, v| [u, v, 0.1 * u * v]);
    add_sheet(&mut sides, 4, |u, v| [v, u, 0.1 * u * v]);
    assert_left_apart(&sides.0, &sides.1);

    let mut twice = Default::default();
    add_sheet(&mut twice, 4, |u, v| [u, v, 0.1 * u * v]);
    add_sheet(&mut twice, 4, |u, v| [u, v, 0.1 * u * v]);
    assert_left_apart(&twice.0, &twice.1);

    // A sheet that is rolled up until an edge of it meets its own in the same direction: a strip of Moebius.
    let turn = |u: f64| std::f64::consts::TAU * u / 8.0;
    let mut strip = Default::default();
    add_sheet(&mut strip, 8, |u, v| {
        let (r, h) = (
            4.0 + (v - 4.0) * (turn(u) / 2.0).cos(),
            (v - 4.0) * (turn(u) / 2.0).sin(),
        );
        [r * turn(u).cos(), r * turn(u).sin(), h]
    });
    for k in 0..9 {
        strip.0[72 + k] = strip.0[8 - k];
    }
    assert_left_apart(&strip.0, &strip.1);
}

#[test]
fn closed_bodies_that_touch_stay_apart() {
    let body = |at: [f64; 3]| {
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
            .map(|p: [f64; 3]| [p[0] + at[0], p[1] + at[1], p[2] + at[2]])
    };
    let triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    let other = triangles.map(|t| t.map(|v| v + 4));
    let positions = [body([0.0; 3]), body([1.0, 0.0, 0.0])].concat();
    assert_left_apart(&positions, &[triangles, other].concat());
}

#[test]
fn two_sheets_along_an_edge_are_one_and_a_slit_is_closed() {
    let mut sheets = Default::default();
    add_sheet(&mut sheets, 4, |u, v| [u, v, 0.0]);
    add_sheet(&mut sheets, 4, |u, v| [u + 4.0, v, 0.0]);
    assert_eq!(boundary_loops(&sheets.0, &sheets.1).unwrap().len(), 1);
    // And a third one on the same edge: none of them.
    add_sheet(&mut sheets, 4, |u, v| [4.0, v, u]);
    assert_left_apart(&sheets.0, &sheets.1);

    let mut sheet: (Vec<[f64; 3]>, Vec<[u32; 3]>) = Default::default();
    add_sheet(&mut sheet, 6, |u, v| [u, v, 0.0]);
    // Inside, from (2, 3) to (4, 3): the middle vertex gets a copy for the triangles on one side.
    sheet.0.push(sheet.0[24]);
    let is_beyond = |t: &[u32; 3], x: &[[f64; 3]]| t.iter().map(|&v| x[v as usize][1]).sum::<f64>() > 9.0;
    let (x, triangles) = (&sheet.0, &mut sheet.1);
    for t in triangles.iter_mut().filter(|t| is_beyond(t, x)) {
        t.iter_mut().filter(|v| **v == 24).for_each(|v| *v = 49);
    }
    let loops = |coincident| boundary_loops_joined(x, &sheet.1, coincident).unwrap().len();
    assert_eq!(
        (loops(Coincident::Separate), loops(Coincident::default())),
        (2, 1)
    );
}

#[test]
fn copies_at_a_distance() {
    let (cap, start) = dented();
    let split = split(&start, &cap.triangles, |t| t);
    let mask = split.each(&cap.free);
    let near: Vec<[f64; 3]> = (0..)
        .zip(&split.positions)
        .map(|(k, p)| [0, 1, 2].map(|axis| p[axis] + 1e-9 * f64::from((7 * k + 3 * axis as u32) % 5)))
        .collect();
    let within = |within| Options {
        coincident: Coincident::Join { within },
        ..options(1e-8)
    };
    let selection = Selection::Mask(&mask);
    let refused = fair(&near, &split.triangles, selection, &within(0.0));
    assert_matches!(refused, Err(Error::FreeVertexOnBoundary { .. }));
    let joined = fair(&start, &cap.triangles, Selection::Mask(&cap.free), &within(0.0)).unwrap();
    let theirs = fair(&near, &split.triangles, selection, &within(1e-7)).unwrap();
    assert_success(&theirs.report.outcome);
    assert_eq!(theirs.report.free_vertices, joined.report.free_vertices);
    for v in 0..mask.len() {
        if mask[v] {
            let first = split.of.partition_point(|&w| w < split.of[v]);
            assert_eq!(theirs.positions[v], theirs.positions[first]);
        } else {
            assert_eq!(theirs.positions[v], near[v]);
        }
        let off = vector(&theirs.positions[v]) - vector(&joined.positions[split.of[v] as usize]);
        assert!(off.norm() < 1e-6, "{off}");
    }
    for wrong in [-1.0, f64::NAN, f64::INFINITY] {
        let refused = fair(&near, &split.triangles, selection, &within(wrong)).unwrap_err();
        assert_matches!(
            refused,
            Error::BadOption {
                name: "coincident_within",
                ..
            }
        );
    }
    // More than the edges are long: nothing can be told apart, and nothing is joined.
    let loops = boundary_loops_joined(&near, &split.triangles, Coincident::Join { within: 100.0 }).unwrap();
    assert_above!(loops.len(), 100);
}

#[test]
fn errors_name_the_callers_vertices() {
    let (cap, start) = dented();
    let split = split(&start, &cap.triangles, |t| t);
    let everything = vec![true; split.of.len()];
    let refused = fair(
        &split.positions,
        &split.triangles,
        Selection::Mask(&everything),
        &options(1e-8),
    );
    let Err(Error::FreeVertexOnBoundary { vertex }) = refused else {
        panic!("{refused:?}")
    };
    let all = vec![true; cap.free.len()];
    let joined = fair(&start, &cap.triangles, Selection::Mask(&all), &options(1e-8));
    assert_eq!(
        joined.unwrap_err(),
        Error::FreeVertexOnBoundary {
            vertex: split.of[vertex] as usize
        }
    );

    let mut triangles = split.triangles.clone();
    triangles[5][1] = 999_999;
    let refused = fair(
        &split.positions,
        &triangles,
        Selection::Mask(&everything),
        &options(1e-8),
    );
    let expected = Error::IndexOutOfRange {
        triangle: 5,
        index: 999_999,
        vertex_count: split.of.len(),
    };
    assert_eq!(refused.unwrap_err(), expected);
}

/// Curvature given for copies is that of the joined vertex: their mean.
#[test]
fn curvature_given_for_copies_is_that_of_the_vertex() {
    let cap = ellipsoid_cap([1.0, 0.95, 0.9], 50.0, 600, irregular(1), OUTSIDE);
    let start = flat(&cap);
    let split = split(&start, &cap.triangles, |t| t);
    let mask = split.each(&cap.free);
    let given = |list: Vec<(u32, f64)>| Options {
        continuity: 1.0,
        boundary_curvature: BoundaryCurvature::Given(list),
        ..options(1e-8)
    };
    let exact: Vec<(u32, f64)> = cap.boundary_normals().iter().map(|&(v, _)| (v, -1.0)).collect();
    let selection = Selection::Mask(&cap.free);
    let joined = fair(&start, &cap.triangles, selection, &given(exact.clone())).unwrap();
    let reached = &joined.report.components[0].continuity[0];
    assert!(reached.reached > 0.5, "{reached:?}");
    // The copies differ, their mean does not.
    let of_copy = |(copy, &v): (usize, &u32)| {
        let of_vertex = exact.iter().find(|entry| entry.0 == v)?.1;
        let copies = split.of.iter().filter(|of| **of == v).count();
        let before = split.of[..copy].iter().filter(|of| **of == v).count();
        let off = before as f64 - 0.5 * (copies - 1) as f64;
        Some((copy as u32, of_vertex + 0.125 * off))
    };
    let list = split.of.iter().enumerate().filter_map(of_copy).collect();
    let theirs = fair(
        &split.positions,
        &split.triangles,
        Selection::Mask(&mask),
        &given(list),
    )
    .unwrap();
    let (a, b) = (&theirs.report.components[0].continuity[0], reached);
    assert!((a.reached - b.reached).abs() < 1e-9, "{a:?} {b:?}");
    assert!((a.jump - b.jump).abs() < 1e-9, "{a:?} {b:?}");
}

/// A loop is named by any copy of any of its vertices, at once and in steps, and so is a vertex that is on none.
#[test]
fn a_loop_is_named_by_any_copy() {
    let cap = ellipsoid_cap([1.0, 0.95, 0.9], 50.0, 600, irregular(1), OUTSIDE);
    let split = split(&flat(&cap), &cap.triangles, |t| t);
    let mask = split.each(&cap.free);
    let on = cap.boundary_normals()[5].0;
    let last_copy = |v: u32| split.of.iter().rposition(|of| *of == v).unwrap() as u32;
    let asked = |continuity: f64, loop_continuity: Vec<(u32, f64)>| Options {
        continuity,
        loop_continuity,
        ..options(1e-8)
    };
    let solved = |options: &Options| {
        fair(
            &split.positions,
            &split.triangles,
            Selection::Mask(&mask),
            options,
        )
    };
    let whole = solved(&asked(1.0, Vec::new())).unwrap();
    let one = solved(&asked(0.0, vec![(last_copy(on), 1.0)])).unwrap();
    assert_same_items!(one.positions, whole.positions);
    let inside = last_copy(cap.free_vertices()[3]);
    let named = Error::NotOnLoop {
        vertex: inside as usize,
    };
    assert_eq!(solved(&asked(0.0, vec![(inside, 1.0)])).unwrap_err(), named);
    let selection = Selection::Mask(&mask);
    let plain = asked(0.0, Vec::new());
    let mut solver = Solver::new(&split.positions, &split.triangles, selection, &plain).unwrap();
    assert_eq!(solver.set_continuity(0.0, &[(inside, 1.0)]), Err(named));
    solver.set_continuity(0.0, &[(last_copy(on), 1.0)]).unwrap();
    solver.run(1000, None).unwrap();
    assert_same_items!(solver.solution().positions, whole.positions);
}

/// Fairs the dented sphere, split as it may be, with normals that are given.
fn fair_given(split: &Split, free: &[bool], list: Vec<(u32, [f64; 3])>) -> Result<Solution, Error> {
    let given = Options {
        boundary_normals: BoundaryNormals::Given(list),
        ..options(1e-8)
    };
    fair(
        &split.positions,
        &split.triangles,
        Selection::Mask(&split.each(free)),
        &given,
    )
}

#[test]
fn a_normal_may_be_given_for_each_copy_or_for_one() {
    let (cap, start) = dented();
    let split = split(&start, &cap.triangles, |t| t);
    let exact = cap.boundary_normals();
    let joined = solve_given(&cap, &start, &exact, options(1e-8));
    let all = split.listed(&exact);
    assert_same(
        &split,
        &fair_given(&split, &cap.free, all.clone()).unwrap(),
        &joined,
    );
    let mut one = all;
    one.reverse();
    one.dedup_by_key(|entry| split.of[entry.0 as usize]);
    assert_same(&split, &fair_given(&split, &cap.free, one).unwrap(), &joined);
}

#[test]
fn normals_of_copies_are_averaged_and_refused_where_they_cancel() {
    let (cap, start) = dented();
    let split = split(&start, &cap.triangles, |t| t);
    let all = split.listed(&cap.boundary_normals());
    // Two copies, tilted this way and that.
    let vertex = all[0].0;
    assert_eq!(split.of[vertex as usize], split.of[vertex as usize + 1]);
    let n = vector(&all[0].1);
    let across = n.cross(&vector(&[0.3, 0.4, 0.5])).normalize();
    let tilted = |by: f64| -> [f64; 3] { (n * by.cos() + across * by.sin()).into() };
    let solve = |second: [f64; 3]| {
        let mut two = all[2..].to_vec();
        two.retain(|entry| split.of[entry.0 as usize] != split.of[vertex as usize]);
        two.extend([(vertex, tilted(0.4)), (vertex + 1, second)]);
        fair_given(&split, &cap.free, two)
    };
    let solution = solve(tilted(-0.4)).unwrap();
    let mut used = solution.boundary_normals.iter();
    let used = used.find(|entry| entry.0 == vertex + 1).unwrap();
    assert_below!((vector(&used.1) - n).norm(), 1e-12);

    let vertex = vertex as usize;
    let opposite = solve(tilted(-2.0)).unwrap_err();
    assert_eq!(opposite, Error::BadNormal { vertex });
    let long = solve([0.0, 0.0, 2.0]).unwrap_err();
    assert_eq!(long, Error::BadNormal { vertex: vertex + 1 });
}

#[test]
fn a_solver_of_a_soup_ends_as_that_of_the_joined_mesh() {
    let (cap, start) = dented();
    let split = split(&start, &cap.triangles, |t| t);
    let mask = split.each(&cap.free);
    let asked = options(1e-8);
    let mut theirs = Solver::new(&split.positions, &split.triangles, Selection::Mask(&mask), &asked).unwrap();
    let mut joined = Solver::new(&start, &cap.triangles, Selection::Mask(&cap.free), &asked).unwrap();
    assert_same(&split, theirs.solution(), joined.solution());
    theirs.run(2, None).unwrap();
    joined.run(2, None).unwrap();
    assert_same(&split, theirs.solution(), joined.solution());

    let exact = cap.boundary_normals();
    theirs
        .set_boundary_normals(BoundaryNormals::Given(split.listed(&exact)))
        .unwrap();
    joined
        .set_boundary_normals(BoundaryNormals::Given(exact))
        .unwrap();
    theirs.set_target(Target::Constant(0.01)).unwrap();
    joined.set_target(Target::Constant(0.01)).unwrap();
    theirs.run(1000, None).unwrap();
    joined.run(1000, None).unwrap();
    assert_same(&split, theirs.solution(), joined.solution());

    let vertex = split
        .of
        .iter()
        .position(|&v| v == theirs_boundary(&joined))
        .unwrap();
    let wrong = BoundaryNormals::Given(vec![(vertex as u32 + 1, [0.0; 3])]);
    assert_eq!(
        theirs.set_boundary_normals(wrong),
        Err(Error::BadNormal { vertex: vertex + 1 })
    );
}

fn theirs_boundary(solver: &Solver) -> u32 {
    solver.solution().boundary_normals[0].0
}

/// A sphere with a hole, and its soup.
fn holed() -> (Shape, Split) {
    let mut shape = sphere_with_hole(1.0, 400, irregular(2), 0);
    let (x, triangles) = (&shape.positions, &shape.triangles);
    let is_kept = |t: &&[u32; 3]| t.iter().all(|&v| x[v as usize][2] < 0.5);
    let kept: Vec<[u32; 3]> = triangles.iter().filter(is_kept).copied().collect();
    shape.triangles = kept;
    let split = split(&shape.positions, &shape.triangles, |t| t);
    (shape, split)
}

#[test]
fn loops_of_a_soup_are_named_by_the_callers_vertices() {
    let (shape, split) = holed();
    let joined = boundary_loops(&shape.positions, &shape.triangles).unwrap();
    let theirs = boundary_loops(&split.positions, &split.triangles).unwrap();
    assert!(!joined.is_empty());
    assert_eq!(theirs.len(), joined.len());
    for (a, b) in theirs.iter().zip(&joined) {
        let before: Vec<u32> = a.vertices.iter().map(|&v| split.of[v as usize]).collect();
        assert_eq!(before, b.vertices);
        assert_eq!(
            (a.length, a.area, a.turn, a.kind),
            (b.length, b.area, b.turn, b.kind)
        );
        // The copy belongs to the triangle at the edge to the next vertex.
        for (&v, k) in a.vertices.iter().zip(1..) {
            let next = b.vertices[k % b.vertices.len()];
            let has = |t: &&[u32; 3]| t.contains(&v) && t.iter().any(|&w| split.of[w as usize] == next);
            assert!(split.triangles.iter().any(|t| has(&t)));
        }
    }
}

#[test]
fn the_hole_of_a_soup_is_filled_as_that_of_the_joined_mesh() {
    let (shape, split) = holed();
    let asked = FillOptions {
        fairing: options(1e-8),
        ..FillOptions::default()
    };
    let joined = fill_holes(&shape.positions, &shape.triangles, &asked).unwrap();
    let theirs = fill_holes(&split.positions, &split.triangles, &asked).unwrap();
    assert_eq!(theirs.triangles[..split.triangles.len()], split.triangles);
    assert_eq!(theirs.positions[..split.positions.len()], split.positions);
    let (old, known) = (split.positions.len(), shape.positions.len());
    assert_above!(joined.positions.len(), known);
    assert_eq!(bits(&theirs.positions[old..]), bits(&joined.positions[known..]));
    let before = |v: u32| match (v as usize).checked_sub(old) {
        None => split.of[v as usize],
        Some(new) => (known + new) as u32,
    };
    let renamed: Vec<[u32; 3]> = theirs.triangles.iter().map(|t| t.map(before)).collect();
    assert_eq!(renamed, joined.triangles);
    assert_eq!(theirs.loops[0].outcome, joined.loops[0].outcome);
    assert_empty!(boundary_loops(&theirs.positions, &theirs.triangles).unwrap());
    for (a, b) in theirs.parents.iter().zip(&joined.parents) {
        assert_eq!((a.vertices.map(before), a.weights), (b.vertices, b.weights));
    }
}

#[test]
fn a_region_of_a_soup_is_remeshed_as_that_of_the_joined_mesh() {
    let (cap, _) = dented();
    let split = split(&cap.positions, &cap.triangles, |t| t);
    let mask = split.each(&cap.free);
    let finer = RemeshOptions {
        density: 2.0,
        ..RemeshOptions::default()
    };
    let joined = remesh_region(&cap.positions, &cap.triangles, Selection::Mask(&cap.free), &finer).unwrap();
    let theirs = remesh_region(&split.positions, &split.triangles, Selection::Mask(&mask), &finer).unwrap();
    let places = |x: &[[f64; 3]], triangles: &[[u32; 3]]| -> Vec<[[f64; 3]; 3]> {
        triangles.iter().map(|t| t.map(|v| x[v as usize])).collect()
    };
    assert_eq!(
        places(&theirs.positions, &theirs.triangles),
        places(&joined.positions, &joined.triangles)
    );
    assert_eq!(theirs.kept_triangles, joined.kept_triangles);
    assert_eq!(theirs.free.len(), joined.free.len());
    // No vertex is left behind, and the new mesh is one surface again.
    let mut used = vec![false; theirs.positions.len()];
    theirs
        .triangles
        .iter()
        .flatten()
        .for_each(|&v| used[v as usize] = true);
    assert_all!(used.iter(), |u| *u);
    let loops = boundary_loops(&theirs.positions, &theirs.triangles)
        .unwrap()
        .len();
    assert_eq!(
        loops,
        boundary_loops(&cap.positions, &cap.triangles).unwrap().len()
    );
}

#[test]
fn the_mean_curvature_of_a_soup_is_that_of_the_joined_mesh() {
    let (cap, start) = dented();
    let split = split(&start, &cap.triangles, |t| t);
    let joined = mean_curvature(&start, &cap.triangles).unwrap();
    let theirs = mean_curvature(&split.positions, &split.triangles).unwrap();
    assert_eq!(bits_of(&theirs), bits_of(&split.each(&joined)));
}
