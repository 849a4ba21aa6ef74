//! Regions deleted and filled: `refill_region`.

use fairmesh::{Error, FillOptions, Selection, boundary_loops, refill_region};
use fairmesh_shapes::{Sampling, Shape, cylinder_band, sphere_with_hole};

use crate::fairing::vector;

fn refill(shape: &Shape, free: &[u32]) -> Option<fairmesh::Remeshed> {
    let (x, t) = (&shape.positions, &shape.triangles);
    refill_region(x, t, Selection::Vertices(free), &FillOptions::default()).unwrap()
}

/// The free vertices of a shape.
fn free(shape: &Shape) -> Vec<u32> {
    (0..)
        .zip(&shape.free)
        .filter(|(_, free)| **free)
        .map(|(v, _)| v)
        .collect()
}

#[test]
fn an_ear_of_any_shape_gives_way_to_the_sphere_around_it() {
    let mut shape = sphere_with_hole(1.0, 900, Sampling::Regular, 0);
    let ear: Vec<u32> = (0..shape.positions.len() as u32)
        .filter(|&v| shape.positions[v as usize][2] > 0.8)
        .collect();
    for &v in &ear {
        let p = vector(&shape.positions[v as usize]);
        shape.positions[v as usize] = (p * (1.0 + 40.0 * (p.z - 0.8) * (9.0 * p.x).sin().abs())).into();
    }
    let given = shape.positions.clone();
    let refilled = refill(&shape, &ear).expect("a fair patch");
    let new = refilled.kept_vertices.len();
    assert_eq!(new, given.len() - ear.len());
    for (p, &v) in refilled.positions.iter().zip(&refilled.kept_vertices) {
        assert_eq!(*p, given[v as usize]);
    }
    assert_eq!(
        refilled.free,
        (new as u32..refilled.positions.len() as u32).collect::<Vec<_>>()
    );
    let off = refilled.positions[new..]
        .iter()
        .map(|p| (vector(p).norm() - 1.0).abs());
    assert_below!(off.fold(0.0, f64::max), 1e-7);
    let before = boundary_loops(&given, &shape.triangles).unwrap().len();
    assert_eq!(
        boundary_loops(&refilled.positions, &refilled.triangles)
            .unwrap()
            .len(),
        before
    );
    for (t, &old) in refilled.triangles.iter().zip(&refilled.kept_triangles) {
        assert_eq!(
            t.map(|v| refilled.kept_vertices[v as usize]),
            shape.triangles[old as usize]
        );
    }
}

#[test]
fn a_band_is_filled_with_one_patch_between_its_loops() {
    let shape = cylinder_band(700, Sampling::Regular, 3);
    let refilled = refill(&shape, &free(&shape)).expect("a fair patch");
    let loops = |x: &[[f64; 3]], t: &[[u32; 3]]| boundary_loops(x, t).unwrap().len();
    let before = loops(&shape.positions, &shape.triangles);
    assert_eq!(loops(&refilled.positions, &refilled.triangles), before);
    let new = &refilled.positions[refilled.kept_vertices.len()..];
    let off = new.iter().map(|p| (p[0].hypot(p[1]) - 1.0).abs());
    assert_below!(off.fold(0.0, f64::max), 0.02);
}

#[test]
fn a_fixed_vertex_inside_is_not_lost() {
    let shape = sphere_with_hole(1.0, 900, Sampling::Regular, 0);
    let middle = (0..shape.positions.len() as u32)
        .max_by(|&a, &b| shape.positions[a as usize][2].total_cmp(&shape.positions[b as usize][2]))
        .unwrap();
    let cap = (0..shape.positions.len() as u32).filter(|&v| shape.positions[v as usize][2] > 0.8);
    let without: Vec<u32> = cap.filter(|&v| v != middle).collect();
    assert!(refill(&shape, &without).is_none());
    let wrong = refill_region(
        &shape.positions,
        &shape.triangles,
        Selection::Vertices(&[]),
        &FillOptions::default(),
    );
    assert_matches!(wrong, Err(Error::EmptyRegion));
}
