//! Defects of a mesh are told by their causes.

use fairmesh::{
    Coincident, Error, FillOptions, FillOutcome, LoopKind, Loops, OpenReason, boundary_loops,
    boundary_loops_joined, fill_holes, inconsistent_edges, triangles_to_turn,
};
use fairmesh_shapes::{Sampling, sphere_with_hole};

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// The closed unit sphere.
fn closed() -> Mesh {
    let shape = sphere_with_hole(40.0, 300, Sampling::Regular, 0);
    let filled = fill_holes(&shape.positions, &shape.triangles, &FillOptions::default()).unwrap();
    (filled.positions, filled.triangles)
}

/// Another triangle that has one vertex of the mesh.
fn hang_triangle((x, t): &mut Mesh, at: u32) {
    let first = x.len() as u32;
    let [p, q, r] = x[at as usize];
    x.extend([
        [1.2 * p, 1.2 * q, 1.2 * r + 0.2],
        [1.2 * p, 1.2 * q + 0.2, 1.2 * r],
    ]);
    t.push([at, first, first + 1]);
}

#[test]
fn triangles_that_hang_at_a_vertex_are_told_as_such() {
    let mut mesh = closed();
    hang_triangle(&mut mesh, 7);
    let (x, t) = mesh;
    let loops = boundary_loops(&x, &t).unwrap();
    assert_eq!(loops.iter().map(|of| of.hangs_at).collect::<Vec<_>>(), [Some(7)]);
    let filled = fill_holes(&x, &t, &FillOptions::default()).unwrap();
    let hanging = FillOutcome::LeftOpen(OpenReason::Hanging { vertex: 7 });
    assert_eq!(filled.loops[0].outcome, hanging);
    // As with any outer boundary: nothing was filled.
    assert!(filled.loops[0].is_success() && !filled.is_success());
}

#[test]
fn triangles_that_hang_at_the_rim_of_a_hole_do_not_disturb_its_filling() {
    let shape = sphere_with_hole(40.0, 300, Sampling::Regular, 0);
    let mut mesh = (shape.positions, shape.triangles);
    let rim = boundary_loops(&mesh.0, &mesh.1).unwrap()[0].vertices[0];
    hang_triangle(&mut mesh, rim);
    let loops = boundary_loops(&mesh.0, &mesh.1).unwrap();
    assert_eq!(
        loops.iter().map(|of| of.hangs_at).collect::<Vec<_>>(),
        [None, Some(rim)]
    );
    let filled = fill_holes(&mesh.0, &mesh.1, &FillOptions::default()).unwrap();
    assert_eq!(filled.loops[0].outcome, FillOutcome::Faired);
    let hanging = FillOutcome::LeftOpen(OpenReason::Hanging { vertex: rim });
    assert_eq!(filled.loops[1].outcome, hanging);
    assert!(filled.is_success());
}

/// Of a bow tie, each triangle hangs at the other one; of a triangle at a sheet, only the triangle.
#[test]
fn the_smaller_part_hangs_at_the_larger_one() {
    let x =
        [[0, 0], [-1, 1], [-1, -1], [1, -1], [1, 1], [2, 0]].map(|[x, y]| [f64::from(x), f64::from(y), 0.0]);
    let hangs = |t: &[[u32; 3]]| -> Vec<Option<u32>> {
        boundary_loops(&x, t)
            .unwrap()
            .iter()
            .map(|of| of.hangs_at)
            .collect()
    };
    assert_eq!(hangs(&[[0, 1, 2], [0, 3, 4]]), [Some(0); 2]);
    assert_eq!(hangs(&[[0, 1, 2], [0, 3, 4], [4, 3, 5]]), [Some(0), None]);
    // Named, it is tried as any other loop.
    let options = FillOptions {
        loops: Loops::Chosen(vec![0]),
        ..FillOptions::default()
    };
    let filled = fill_holes(&x, &[[0, 1, 2], [0, 3, 4]], &options).unwrap();
    assert_eq!(
        filled.loops[0].outcome,
        FillOutcome::LeftOpen(OpenReason::NoTriangulation)
    );
}

/// The same for every run, of no pattern.
fn chosen(i: usize, of: usize) -> bool {
    (i as u64)
        .wrapping_mul(0x9e37_79b9_7f4a_7c15)
        .rotate_left(29)
        .wrapping_mul(0xbf58_476d_1ce4_e5b9)
        .rotate_left(31)
        .is_multiple_of(of as u64)
}

/// Turns every third triangle or so around; which these are.
fn turn_some(t: &mut [[u32; 3]]) -> Vec<u32> {
    let turned: Vec<u32> = (0..t.len()).filter(|&i| chosen(i, 3)).map(|i| i as u32).collect();
    turned.iter().for_each(|&i| t[i as usize].swap(1, 2));
    turned
}

/// What a user sees of a sphere whose faces are turned here and there: bad edges, all of one kind, and the triangles to turn.
#[test]
fn triangles_that_face_the_wrong_way_are_found_and_turned() {
    let shape = sphere_with_hole(40.0, 300, Sampling::Regular, 0);
    let (x, t) = (shape.positions, shape.triangles);
    let loops = boundary_loops(&x, &t).unwrap();
    let mut mixed = t.clone();
    let turned = turn_some(&mut mixed);
    let edges = inconsistent_edges(&x, &mixed, Coincident::default()).unwrap();
    assert_above!(edges.len(), turned.len());
    let [a, b] = edges[0].triangles.map(|f| mixed[f as usize]);
    let runs = |t: [u32; 3]| (0..3).any(|k| [t[k], t[(k + 1) % 3]] == edges[0].vertices);
    assert!(runs(a) && runs(b));
    let found = boundary_loops(&x, &mixed).unwrap();
    assert_above!(found.len(), 1);
    let inconsistent = |kind| matches!(kind, LoopKind::Inconsistent { .. });
    assert!(found.iter().all(|of| inconsistent(of.kind)));
    let filled = fill_holes(&x, &mixed, &FillOptions::default()).unwrap();
    let reason =
        |outcome: &FillOutcome| matches!(outcome, FillOutcome::LeftOpen(OpenReason::Inconsistent { .. }));
    assert!(filled.loops.iter().all(|of| reason(&of.outcome)));
    assert_eq!(
        triangles_to_turn(&x, &mixed, Coincident::default()).unwrap(),
        turned
    );
    turned.iter().for_each(|&i| mixed[i as usize].swap(1, 2));
    assert_empty!(inconsistent_edges(&x, &mixed, Coincident::default()).unwrap());
    assert_eq!(boundary_loops(&x, &mixed).unwrap(), loops);
}

/// Of each component its own smaller part, also where each triangle has vertices of its own.
#[test]
fn each_component_keeps_the_orientation_of_its_larger_part() {
    let shape = sphere_with_hole(40.0, 300, Sampling::Regular, 0);
    let (mut x, mut t) = (shape.positions, shape.triangles);
    let (vertices, count) = (x.len() as u32, t.len());
    x.extend_from_within(..);
    x[vertices as usize..].iter_mut().for_each(|p| p[0] += 5.0);
    t.extend_from_within(..);
    // The second is inside out.
    for tri in &mut t[count..] {
        *tri = [tri[0] + vertices, tri[2] + vertices, tri[1] + vertices];
    }
    let turned = turn_some(&mut t);
    assert_eq!(triangles_to_turn(&x, &t, Coincident::default()).unwrap(), turned);
    let soup: Vec<[f64; 3]> = t.iter().flatten().map(|&v| x[v as usize]).collect();
    let corners: Vec<[u32; 3]> = (0..t.len() as u32)
        .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
        .collect();
    assert_eq!(
        triangles_to_turn(&soup, &corners, Coincident::default()).unwrap(),
        turned
    );
    assert_empty!(triangles_to_turn(&soup, &corners, Coincident::Separate).unwrap());
}

#[test]
fn a_closed_component_of_which_half_is_turned_comes_to_face_outwards() {
    let x = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]].map(|p| p.map(f64::from));
    let outwards = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    for first in [0, 2] {
        let mut t = outwards;
        t[first..first + 2].iter_mut().for_each(|t| t.swap(1, 2));
        let turned = triangles_to_turn(&x, &t, Coincident::default()).unwrap();
        assert_eq!(turned, [first as u32, first as u32 + 1]);
    }
    // Of an open one the first triangle stays.
    let open = [[0, 2, 1], [0, 3, 1]];
    assert_eq!(triangles_to_turn(&x, &open, Coincident::default()).unwrap(), [1]);
}

#[test]
fn a_moebius_strip_cannot_be_oriented() {
    let at = |i: u32| {
        let angle = f64::from(i / 2) * std::f64::consts::TAU / 8.0;
        let side = if i.is_multiple_of(2) { 0.3 } else { -0.3 };
        let radius = 1.0 + side * (angle / 2.0).cos();
        [
            radius * angle.cos(),
            radius * angle.sin(),
            side * (angle / 2.0).sin(),
        ]
    };
    let x: Vec<[f64; 3]> = (0..16).map(at).collect();
    // The last rung is the first one upside down.
    let rung = |i: u32| if i < 8 { [2 * i, 2 * i + 1] } else { [1, 0] };
    let t: Vec<[u32; 3]> = (0..8)
        .flat_map(|i| {
            let [[a, b], [c, d]] = [rung(i), rung(i + 1)];
            [[a, c, b], [b, c, d]]
        })
        .collect();
    let refused = triangles_to_turn(&x, &t, Coincident::default()).unwrap_err();
    assert!(
        matches!(refused, Error::NotOrientable { triangle } if triangle < t.len()),
        "{refused}"
    );
    assert_eq!(
        inconsistent_edges(&x, &t, Coincident::default()).unwrap().len(),
        1
    );
}

/// Each triangle with corners of its own, which are off by up to so much.
fn soup(x: &[[f64; 3]], t: &[[u32; 3]], jitter: f64) -> Mesh {
    let off = |i: usize| (i.wrapping_mul(0x9e37_79b9) >> 7 & 0xffff) as f64 / 32768.0 - 1.0;
    let corners = t.iter().flatten().enumerate();
    let corners = corners.map(|(i, &v)| [0, 1, 2].map(|k| x[v as usize][k] + jitter * off(3 * i + k)));
    let numbers = (0..t.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
    (corners.collect(), numbers.collect())
}

#[test]
fn copies_of_a_vertex_of_many_triangles_are_joined() {
    // A cone of 48 triangles.
    let at = |i: u32| f64::from(i) * std::f64::consts::TAU / 48.0;
    let rim = (0..48).map(|i| [at(i).cos(), at(i).sin(), 0.0]);
    let x: Vec<[f64; 3]> = std::iter::once([0.0, 0.0, 1.0]).chain(rim).collect();
    let t: Vec<[u32; 3]> = (0..48).map(|i| [0, i + 1, (i + 1) % 48 + 1]).collect();
    let (x, t) = soup(&x, &t, 1e-8);
    for within in [1e-7, 1e-6, 1e-5] {
        let loops = boundary_loops_joined(&x, &t, Coincident::Join { within }).unwrap();
        let edges: Vec<usize> = loops.iter().map(|of| of.vertices.len()).collect();
        assert_eq!(edges, [48], "{within}");
    }
}
