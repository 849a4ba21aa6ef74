//! The safe layer: meshes, files, status, normals and the smoother do what OpenMesh's documents say.

use fairmesh_shapes::{OUTSIDE, Sampling, Shape, sphere_cap};
use openmesh_sys::openmesh::*;

fn cap() -> Shape {
    sphere_cap(60.0, 300, Sampling::Irregular { seed: 1 }, OUTSIDE)
}

fn float(p: &[f64; 3]) -> [f64; 3] {
    p.map(|x| f64::from(x as f32))
}

/// Vertices with a triangle whose edges are not all shared: by counting directed edges.
fn on_boundary(shape: &Shape) -> Vec<bool> {
    let edges = |t: &[u32; 3]| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])];
    let directed: std::collections::BTreeSet<_> = shape.triangles.iter().flat_map(edges).collect();
    let mut boundary = vec![false; shape.positions.len()];
    for &(a, b) in directed.iter().filter(|&&(a, b)| !directed.contains(&(b, a))) {
        boundary[a as usize] = true;
        boundary[b as usize] = true;
    }
    boundary
}

#[test]
fn arrays_come_back() {
    let shape = cap();
    let doubles = Mesh::<f64>::new(&shape.positions, &shape.triangles).unwrap();
    assert_eq!(doubles.positions(), shape.positions);
    assert_eq!(doubles.triangles(), shape.triangles);
    // Euler: a disc.
    let (v, e, f) = (doubles.vertex_count(), doubles.edge_count(), doubles.face_count());
    assert_eq!(v + f, e + 1);
    let mut floats = Mesh::<f32>::new(&shape.positions, &shape.triangles).unwrap();
    assert!(
        floats
            .positions()
            .iter()
            .zip(&shape.positions)
            .all(|(a, b)| *a == float(b))
    );
    floats.set_positions(&shape.flat());
    assert!(
        floats
            .positions()
            .iter()
            .zip(&shape.flat())
            .all(|(a, b)| *a == float(b))
    );
    let [a, b, _] = shape.triangles[0].map(|v| v as usize);
    assert_eq!(doubles.edge(a, b), doubles.edge(b, a));
    assert!(doubles.edge(a, b).is_some() && doubles.edge(a, a).is_none());
}

#[test]
fn bad_meshes_are_refused() {
    let positions = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [1.0, 1.0, 1.0],
    ];
    let book = [[0, 1, 2], [1, 0, 3], [0, 1, 4]];
    for (triangles, bad) in [(&book[..], "triangle 2"), (&[[0, 1, 2], [1, 2, 5]], "triangle 1")] {
        let why = Mesh::<f64>::new(&positions, triangles).unwrap_err().to_string();
        assert!(why.contains(bad), "{why}");
    }
    assert!(Mesh::<f64>::read("there/is/no.ply".as_ref()).is_err());
    let mesh = Mesh::<f64>::new(&positions, &book[..2]).unwrap();
    assert!(mesh.write("there/is/no.ply".as_ref()).is_err());
}

#[test]
fn files_keep_floats_and_almost_doubles() {
    let shape = cap();
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    for ending in ["ply", "off", "obj"] {
        let floats = Mesh::<f32>::new(&shape.positions, &shape.triangles).unwrap();
        let path = folder.join(format!("floats.{ending}"));
        floats.write(&path).unwrap();
        let again = Mesh::<f32>::read(&path).unwrap();
        assert_eq!(again.triangles(), floats.triangles(), "{ending}");
        assert_eq!(again.positions(), floats.positions(), "{ending}");
        // Its readers and writers keep more than a float or nothing more, by the format.
        let doubles = Mesh::<f64>::new(&shape.positions, &shape.triangles).unwrap();
        let path = folder.join(format!("doubles.{ending}"));
        doubles.write(&path).unwrap();
        let again = Mesh::<f64>::read(&path).unwrap();
        let off = |(a, b): (&[f64; 3], &[f64; 3])| (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max);
        let worst = again
            .positions()
            .iter()
            .zip(&shape.positions)
            .map(off)
            .fold(0.0, f64::max);
        assert!(worst < 1e-7, "{ending}: {worst}");
    }
}

#[test]
fn status_is_kept_per_element() {
    let shape = cap();
    let mut mesh = Mesh::<f64>::new(&shape.positions, &shape.triangles).unwrap();
    let elements = [Element::Vertex(7), Element::Edge(7), Element::Face(7)];
    let flags = [Flag::Selected, Flag::Locked, Flag::Feature];
    for (k, &element) in elements.iter().enumerate() {
        for (l, &flag) in flags.iter().enumerate() {
            mesh.set_status(element, flag, k != l);
        }
    }
    for (k, &element) in elements.iter().enumerate() {
        for (l, &flag) in flags.iter().enumerate() {
            assert_eq!(mesh.status(element, flag), k != l, "{element:?} {flag:?}");
        }
    }
    assert!(!mesh.status(Element::Vertex(8), Flag::Locked));
}

#[test]
fn normals_of_a_sphere_point_outwards() {
    let shape = cap();
    let mut mesh = Mesh::<f64>::new(&shape.positions, &shape.triangles).unwrap();
    mesh.update_normals();
    for (v, (n, p)) in mesh.normals().iter().zip(&shape.positions).enumerate() {
        let dot: f64 = (0..3).map(|k| n[k] * p[k]).sum();
        assert!(dot > 0.95, "{v}: {dot}");
    }
}

/// One iteration, written down a second time: x - (1/4) B x / diag with B the square of I - D⁻¹A, or x - (1/2) (I - D⁻¹A) x.
#[test]
fn one_iteration_is_the_one_that_we_think() {
    let shape = cap();
    let x = shape.noise(1, 0.3);
    let mut rings = vec![std::collections::BTreeSet::new(); x.len()];
    for t in &shape.triangles {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            rings[t[a] as usize].insert(t[b] as usize);
            rings[t[b] as usize].insert(t[a] as usize);
        }
    }
    let umbrella = |x: &[[f64; 3]], i: usize| -> [f64; 3] {
        std::array::from_fn(|k| {
            x[i][k] - rings[i].iter().map(|&j| x[j][k]).sum::<f64>() / rings[i].len() as f64
        })
    };
    let first: Vec<_> = (0..x.len()).map(|i| umbrella(&x, i)).collect();
    let diagonal = |i: usize| {
        1.0 + rings[i].iter().map(|&j| 1.0 / rings[j].len() as f64).sum::<f64>() / rings[i].len() as f64
    };
    for continuity in [Continuity::C0, Continuity::C1] {
        let mut mesh = Mesh::<f64>::new(&x, &shape.triangles).unwrap();
        mesh.select(&shape.free);
        let asked = Smoothing {
            continuity,
            ..Smoothing::c1(1)
        };
        mesh.smooth(asked).unwrap();
        for (i, p) in mesh.positions().into_iter().enumerate() {
            let (step, factor) = match continuity {
                Continuity::C0 => (first[i], 0.5),
                Continuity::C1 => (umbrella(&first, i), 0.25 / diagonal(i)),
            };
            for k in 0..3 {
                let expected = if shape.free[i] {
                    x[i][k] - factor * step[k]
                } else {
                    x[i][k]
                };
                assert!((p[k] - expected).abs() < 1e-14, "{continuity:?}, vertex {i}");
            }
        }
    }
}

/// What is selected and neither locked nor on the boundary moves; without a selection everything; with features not they.
#[test]
fn the_smoother_moves_what_it_may() {
    let shape = cap();
    let x = shape.noise(1, 0.3);
    let boundary = on_boundary(&shape);
    let edge = shape
        .triangles
        .iter()
        .find(|t| t.iter().all(|&v| shape.free[v as usize]))
        .unwrap();
    let [a, b] = [edge[0] as usize, edge[1] as usize];
    let locked = shape.free.iter().rposition(|&free| free).unwrap();
    for (selected, skip_features) in [(true, false), (true, true), (false, false)] {
        let mut mesh = Mesh::<f64>::new(&x, &shape.triangles).unwrap();
        if selected {
            mesh.select(&shape.free);
        }
        mesh.set_status(Element::Vertex(locked), Flag::Locked, true);
        mesh.set_status(Element::Edge(mesh.edge(a, b).unwrap()), Flag::Feature, true);
        let asked = Smoothing {
            continuity: Continuity::C0,
            skip_features,
            ..Smoothing::c1(1)
        };
        mesh.smooth(asked).unwrap();
        for (v, p) in mesh.positions().iter().enumerate() {
            let feature = skip_features && (v == a || v == b);
            let may = !boundary[v] && v != locked && !feature && (!selected || shape.free[v]);
            assert_eq!(
                *p != x[v],
                may,
                "vertex {v}, selected {selected}, features {skip_features}"
            );
        }
    }
}

/// The tangential component stays in the tangent planes of the start, the cotangent weights keep a plane a plane.
#[test]
fn components_differ_as_they_should() {
    let shape = cap();
    let smoothed = |component| {
        let mut mesh = Mesh::<f64>::new(&shape.positions, &shape.triangles).unwrap();
        mesh.select(&shape.free);
        mesh.update_normals();
        let normals = mesh.normals();
        mesh.smooth(Smoothing {
            component,
            ..Smoothing::c1(20)
        })
        .unwrap();
        let moved = mesh.positions();
        let dots = |v: usize| {
            (0..3)
                .map(|k| (moved[v][k] - shape.positions[v][k]) * normals[v][k])
                .sum::<f64>()
                .abs()
        };
        (0..moved.len()).map(dots).fold(0.0, f64::max)
    };
    assert!(smoothed(Component::Tangential) < 1e-14);
    assert!(smoothed(Component::Both) > 1e-4);
    assert!(smoothed(Component::Normal) > 1e-6);
}
