//! Defects of a mesh are told by their causes.

use fairmesh::{FillOptions, FillOutcome, Loops, OpenReason, boundary_loops, fill_holes};
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
