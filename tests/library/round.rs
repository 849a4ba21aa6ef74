//! Creases that become blends: `round`.

use fairmesh::{
    Creases, Error, LooseReason, Outcome, Progress, RoundOptions, Rounded, SharpFate, blend_vertices,
    find_creases, round, round_with_progress,
};
use std::f64::consts::TAU;
use std::ops::ControlFlow;

use crate::fairing::vector;

/// A right prism over a convex polygon, between two heights: closed, two triangles per side, and a fan at each end.
pub(crate) fn prism(polygon: &[[f64; 2]], heights: [f64; 2]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let count = polygon.len() as u32;
    let level = |z: f64| polygon.iter().map(move |&[x, y]| [x, y, z]);
    let positions = level(heights[0]).chain(level(heights[1])).collect();
    let mut triangles = Vec::new();
    for i in 0..count {
        let j = (i + 1) % count;
        triangles.extend([[i, j, count + j], [i, count + j, count + i]]);
    }
    for i in 1..count - 1 {
        triangles.extend([[0, i + 1, i], [count, count + i, count + i + 1]]);
    }
    (positions, triangles)
}

/// A regular polygon around the origin.
fn polygon(corners: u32, radius: f64) -> Vec<[f64; 2]> {
    let at = |i: u32| TAU * f64::from(i) / f64::from(corners);
    (0..corners)
        .map(|i| [radius * at(i).cos(), radius * at(i).sin()])
        .collect()
}

fn cube() -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    prism(&square, [-1.0, 1.0])
}

fn rounded((positions, triangles): &(Vec<[f64; 3]>, Vec<[u32; 3]>), width: f64) -> Rounded {
    let options = RoundOptions {
        width,
        ..RoundOptions::default()
    };
    round(positions, triangles, &options).unwrap()
}

/// Vertices minus edges plus faces of a mesh every edge of which has two triangles.
pub(crate) fn euler_number(mesh: &Rounded) -> i64 {
    let mut edges: Vec<[u32; 2]> = Vec::new();
    for t in &mesh.triangles {
        edges.extend((0..3).map(|k| [t[k], t[(k + 1) % 3]]));
    }
    let count = edges.len();
    let back: std::collections::BTreeSet<[u32; 2]> = edges.iter().map(|&[a, b]| [b, a]).collect();
    assert_eq!(back.len(), count, "an edge twice");
    assert!(edges.iter().all(|edge| back.contains(edge)), "an open edge");
    let used: std::collections::BTreeSet<u32> = mesh.triangles.iter().flatten().copied().collect();
    assert_eq!(used.len(), mesh.positions.len(), "a vertex without a triangle");
    mesh.positions.len() as i64 - count as i64 / 2 + mesh.triangles.len() as i64
}

/// The widest angle between neighbouring triangles, degrees.
fn widest_bend(mesh: &Rounded) -> f64 {
    let mut normals = std::collections::BTreeMap::new();
    let mut widest = 0.0_f64;
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|v| vector(&mesh.positions[v as usize]));
        let normal = (b - a).cross(&(c - a)).normalize();
        for k in 0..3 {
            let (u, v) = (t[k], t[(k + 1) % 3]);
            if let Some(other) = normals.insert((u.min(v), u.max(v)), normal) {
                widest = widest.max(normal.angle(&other).to_degrees());
            }
        }
    }
    widest
}

#[test]
fn a_cube_gets_cylinders_along_its_edges_between_planes() {
    let mesh = rounded(&cube(), 0.2);
    assert!(mesh.report.outcome.is_success(), "{:?}", mesh.report.outcome);
    assert_eq!(euler_number(&mesh), 2);
    assert_below!(widest_bend(&mesh), 20.0);
    let (mut seen, mut off) = (0, 0.0_f64);
    for p in &mesh.positions {
        let mut sorted = p.map(f64::abs);
        sorted.sort_by(f64::total_cmp);
        let [least, middle, most] = sorted;
        if least < 0.4 && middle > 0.8 {
            off = off.max(((middle - 0.8).hypot(most - 0.8) - 0.2).abs());
            seen += 1;
        }
        if middle < 0.5 {
            assert_below!((most - 1.0).abs(), 1e-15);
        }
    }
    assert!(seen > 500, "{seen} vertices between corners");
    assert_below!(off, 2e-4);
}

#[test]
fn a_hexagonal_prism_and_a_cylinder_stay_closed_and_sound() {
    for corners in [6, 96] {
        let mesh = rounded(&prism(&polygon(corners, 1.0), [-1.0, 1.0]), 0.15);
        assert!(
            mesh.report.outcome.is_success(),
            "{corners}: {:?}",
            mesh.report.outcome
        );
        assert_eq!(euler_number(&mesh), 2);
        assert_below!(widest_bend(&mesh), 20.0);
        // What stays lies on the faces that there were.
        let ends = mesh.positions.iter().filter(|p| p[0].hypot(p[1]) < 0.6);
        assert!(ends.clone().count() > 0);
        ends.for_each(|p| assert_below!((p[2].abs() - 1.0).abs(), 1e-15));
    }
}

/// Between a plane and a curved side, too, whose facets tell its curvature by their normals.
#[test]
fn blends_are_as_curved_at_their_rails_as_the_faces_beside_them_if_asked() {
    for (positions, triangles) in [cube(), prism(&polygon(64, 1.0), [-1.0, 1.0])] {
        let mut options = RoundOptions {
            width: 0.15,
            ..RoundOptions::default()
        };
        options.fairing.continuity = 1.0;
        let made = round(&positions, &triangles, &options).unwrap();
        assert!(made.is_complete(), "{:?}", made.report.outcome);
        let loops = made.report.components.iter().flat_map(|of| &of.continuity);
        let loops: Vec<_> = loops.collect();
        assert!(!loops.is_empty());
        for of in loops {
            assert!(of.reached > 0.95 && of.jump < 0.1 * of.jump_before, "{of:?}");
        }
    }
}

#[test]
fn vertices_that_stay_come_first_and_new_ones_have_parents_near_them() {
    let given = cube();
    let options = RoundOptions {
        width: 0.2,
        edges: vec![[0, 1]],
        ..RoundOptions::default()
    };
    let mesh = round(&given.0, &given.1, &options).unwrap();
    assert_eq!(mesh.chains.iter().filter(|chain| chain.is_rounded).count(), 1);
    assert_eq!(
        mesh.kept_vertices.len() + mesh.parents.len(),
        mesh.positions.len()
    );
    for (p, &v) in mesh.positions.iter().zip(&mesh.kept_vertices) {
        assert_eq!(*p, given.0[v as usize]);
    }
    let new = &mesh.positions[mesh.kept_vertices.len()..];
    for (p, of) in new.iter().zip(&mesh.parents) {
        let mean: nalgebra::Vector3<f64> = (0..3)
            .map(|k| vector(&given.0[of.vertices[k] as usize]) * of.weights[k])
            .sum();
        assert_below!((vector(p) - mean).norm(), 0.15);
        assert_below!((of.weights.iter().sum::<f64>() - 1.0).abs(), 1e-12);
    }
    for (t, &source) in mesh.triangles.iter().zip(&mesh.kept_triangles) {
        let [normal, before] = [(&mesh.positions, t), (&given.0, &given.1[source as usize])].map(|(x, t)| {
            let [a, b, c] = t.map(|v| vector(&x[v as usize]));
            (b - a).cross(&(c - a)).normalize()
        });
        assert_below!((normal - before).norm(), 1e-9);
    }
}

/// The cube, each face in `n` by `n` squares; vertices on its edges are there for each face.
fn divided_cube(n: u32) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    let at = |i: u32| 2.0 * f64::from(i) / f64::from(n) - 1.0;
    for (axis, side) in (0..3).flat_map(|axis| [(axis, -1.0), (axis, 1.0)]) {
        let base = positions.len() as u32;
        for (j, i) in (0..=n).flat_map(|j| (0..=n).map(move |i| (j, i))) {
            let mut p = [side; 3];
            (p[(axis + 1) % 3], p[(axis + 2) % 3]) = (at(i), at(j));
            positions.push(p);
            if i < n && j < n {
                let a = base + (n + 1) * j + i;
                let [b, c, d] = [a + 1, a + n + 2, a + n + 1];
                let turned = |t: [u32; 3]| if side > 0.0 { t } else { [t[0], t[2], t[1]] };
                triangles.extend([[a, b, c], [a, c, d]].map(turned));
            }
        }
    }
    (positions, triangles)
}

/// Short edges of rails once went all into one, ten times as long as the others.
#[test]
fn blends_do_not_depend_on_how_fine_the_faces_are() {
    let coarse = rounded(&cube(), 0.3);
    for n in [20, 60] {
        let fine = rounded(&divided_cube(n), 0.3);
        assert!(fine.is_complete(), "{n}: {:?}", fine.report.outcome);
        let [a, b] = [&coarse, &fine].map(|mesh| mesh.free.len() as f64);
        assert!((b / a - 1.0).abs() < 0.3, "{n}: {a} and {b} vertices");
        assert_below!(fine.report.iterations, 15);
        assert_below!(widest_bend(&fine), 20.0);
    }
}

/// All vertices of the cube are deep in bands then; the middles of its faces stay.
#[test]
fn bands_leave_the_middle_of_faces_between_them() {
    let wide = rounded(&cube(), 0.7);
    assert!(wide.is_complete(), "{:?}", wide.report.outcome);
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let kept = &wide.triangles[..wide.kept_triangles.len()];
            let is_on = |t: &&[u32; 3]| {
                t.iter()
                    .all(|&v| (wide.positions[v as usize][axis] - side).abs() < 1e-12)
            };
            assert!(kept.iter().any(|t| is_on(&t)), "face {axis} {side}");
        }
    }
}

/// How far parts of triangles on one side of x = 0 reach over to the other.
fn reaches_over(labels: Vec<u32>) -> f64 {
    let (positions, triangles) = divided_cube(2);
    let options = RoundOptions {
        width: 0.26,
        labels,
        ..RoundOptions::default()
    };
    let made = round(&positions, &triangles, &options).unwrap();
    assert!(made.is_complete());
    let mut over = 0.0_f64;
    for (t, &from) in made.triangles.iter().zip(&made.kept_triangles) {
        let is_left = triangles[from as usize]
            .iter()
            .any(|&v| positions[v as usize][0] < 0.0);
        for &v in t {
            let x = made.positions[v as usize][0];
            over = over.max(if is_left { x } else { -x });
        }
    }
    over
}

#[test]
fn lines_between_labels_stay_where_they_are() {
    let (positions, triangles) = divided_cube(2);
    let label = |t: &[u32; 3]| u32::from(t.iter().any(|&v| positions[v as usize][0] < 0.0));
    assert_eq!(reaches_over(triangles.iter().map(label).collect()), 0.0);
    // Without them rails have vertices as they need them.
    assert!(reaches_over(Vec::new()) > 1e-3);
    let options = RoundOptions {
        width: 0.26,
        labels: vec![0; 3],
        ..RoundOptions::default()
    };
    let refused = round(&positions, &triangles, &options).unwrap_err();
    assert!(
        matches!(refused, Error::BadOption { name: "labels", .. }),
        "{refused}"
    );
}

/// A width or radius that cannot be, and what is said of it.
#[test]
fn widths_that_cannot_be_are_refused() {
    let cube = cube();
    let asked = |width: f64, radius: f64| RoundOptions {
        width,
        radius,
        ..RoundOptions::default()
    };
    for (width, radius, named) in [
        (0.0, 0.0, "width"),
        (-1.0, 0.0, "width"),
        (f64::INFINITY, 0.0, "width"),
        (0.0, f64::NAN, "radius"),
        (1e-12, 0.0, "width"),
        (0.0, 1e-12, "radius"),
        (1e-5, 0.0, "max_blend_vertices"),
        (0.0, 1e-9, "max_blend_vertices"),
    ] {
        match round(&cube.0, &cube.1, &asked(width, radius)) {
            Err(Error::BadOption { name, .. }) => assert_eq!(name, named),
            other => panic!("{width}, {radius}: {other:?}"),
        }
    }
    let wide = round(&cube.0, &cube.1, &asked(1e3, 0.0));
    assert!(matches!(wide, Err(Error::NothingFixed { .. })), "{wide:?}");
    let concave = RoundOptions {
        creases: Creases::Concave,
        ..asked(0.2, 0.0)
    };
    assert_eq!(round(&cube.0, &cube.1, &concave).unwrap_err(), Error::NoCrease);
}

/// The cube beside a triangle that is far away: found by fuzzing, coordinates did not tell the width, and edges were halved without end.
#[test]
fn a_width_that_coordinates_do_not_tell_is_refused() {
    let beside = |far: f64| {
        let (mut positions, mut triangles) = cube();
        positions.extend([[far; 3], [far + 1.0, far, far], [far, far + 1.0, far]]);
        triangles.push([8, 9, 10]);
        rounded_or_refused(&positions, &triangles)
    };
    assert!(beside(1e9).unwrap().report.outcome.is_success());
    for far in [1e11, 1e13, 1e14] {
        match beside(far) {
            Err(Error::BadOption { name, range, .. }) => {
                assert_eq!((name, range), ("width", "larger, for a mesh as large as this"));
            }
            other => panic!("{far}: {other:?}"),
        }
    }
}

/// Two triangles without area, one against the other, in the lid of a cube: what they are turned to by rounding is no crease. Found in the plate of a
/// boolean whose edges had been divided.
#[test]
fn triangles_without_area_beside_each_other_are_no_crease() {
    let (mut positions, mut triangles) = cube();
    let is_lid = |t: &[u32; 3]| t.iter().all(|&v| v >= 4);
    triangles.retain(|t| !is_lid(t));
    for off in [1e-7, -1e-7] {
        positions.truncate(8);
        positions.extend([
            [-0.6, 0.0, 1.0],
            [0.6, 0.0, 1.0],
            [0.0, off, 1.0],
            [0.0, -off, 1.0],
        ]);
        let [a, b, c, d] = [8, 9, 10, 11];
        let lid = [
            [a, b, c],
            [b, a, d],
            [a, c, 7],
            [c, 6, 7],
            [c, b, 6],
            [4, a, 7],
            [5, 6, b],
            [4, d, a],
            [4, 5, d],
            [5, b, d],
        ];
        let triangles = [&triangles[..], &lid[..]].concat();
        let (chains, _) = find_creases(&positions, &triangles, &RoundOptions::default()).unwrap();
        assert_eq!(chains.len(), 12, "{off}");
    }
}

fn rounded_or_refused(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Rounded, Error> {
    let options = RoundOptions {
        width: 0.2,
        ..RoundOptions::default()
    };
    round(positions, triangles, &options)
}

/// A pyramid, and three of the four edges at its apex are rounded; the fourth one arrives there, and ends: that is told, by its vertex.
#[test]
fn a_crease_that_is_not_rounded_and_arrives_at_a_blend_is_told() {
    let square = [
        [-1.0, -1.0, 0.0],
        [1.0, -1.0, 0.0],
        [1.0, 1.0, 0.0],
        [-1.0, 1.0, 0.0],
    ];
    let positions = [&square[..], &[[0.0, 0.0, 1.0]]].concat();
    let triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 2, 1], [0, 3, 2]];
    let options = RoundOptions {
        width: 0.1,
        edges: vec![[0, 4], [1, 4], [2, 4]],
        ..RoundOptions::default()
    };
    let mesh = round(&positions, &triangles, &options).unwrap();
    let reason = LooseReason::SharpEdge;
    assert_eq!(mesh.report.outcome, Outcome::ConvergedLoosely { reason });
    let alone = mesh
        .report
        .sharp_edges
        .iter()
        .filter(|edge| edge.fate == SharpFate::Alone);
    let ends: Vec<usize> = alone
        .flat_map(|edge| &edge.ends)
        .map(|end| end.vertex as usize)
        .collect();
    let [end] = ends[..] else { panic!("{ends:?}") };
    let [x, y, z] = mesh.positions[end];
    assert_below!((x + 1.0 - z).abs() + (y - 1.0 + z).abs(), 1e-12);
    assert_above!(z, 0.7);
}

/// The edge from z = 0 to 2 above the corner (1, 1) of a square, rounded: a part of a cylinder from face to face, and these are planes still.
fn assert_runs_through(positions: &[[f64; 3]], triangles: &[[u32; 3]], edge: [u32; 2]) {
    let width = 0.3;
    let options = RoundOptions {
        width,
        edges: vec![edge],
        ..RoundOptions::default()
    };
    let mesh = round(positions, triangles, &options).unwrap();
    assert_eq!(mesh.report.outcome, Outcome::Converged);
    let edges = &mesh.report.sharp_edges;
    let fates: Vec<SharpFate> = edges.iter().map(|edge| edge.fate).collect();
    assert_eq!(fates, [SharpFate::GoesOn; 2]);
    let from_axis = |[x, y, _]: [f64; 3]| (x - 1.0 + width).hypot(y - 1.0 + width);
    let is_in_corner = |[x, y, _]: [f64; 3]| x.min(y) > 1.0 - width;
    let new = mesh.free.iter().map(|&v| mesh.positions[v as usize]);
    for p in new.filter(|p| p[2].min(2.0 - p[2]) > 1e-9) {
        assert!(is_in_corner(p), "{p:?}");
        assert_near!(from_axis(p), width, 1e-4);
    }
    for &v in edges.iter().flat_map(|edge| &edge.vertices) {
        let p = mesh.positions[v as usize];
        assert_near!(p[2].min(2.0 - p[2]), 0.0, 1e-12);
        assert_near!(from_axis(p), width, 1e-9);
    }
}

/// So it is for the same faces from the other side, a groove in a hollow.
#[test]
fn a_blend_runs_through_to_the_faces_at_its_ends() {
    let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let (positions, mut triangles) = prism(&square, [0.0, 2.0]);
    assert_runs_through(&positions, &triangles, [2, 6]);
    triangles.iter_mut().for_each(|t| t.swap(0, 1));
    assert_runs_through(&positions, &triangles, [2, 6]);
}

/// A block on a square of floor: the corners of the floor, of the block's foot and of its top.
pub(crate) fn block_on_floor() -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let square = |half: f64, z: f64| {
        [[-half, -half], [half, -half], [half, half], [-half, half]].map(|[x, y]| [x, y, z])
    };
    let positions = [square(3.0, 0.0), square(1.0, 0.0), square(1.0, 2.0)].concat();
    let sides = |from: u32| {
        (0..4).flat_map(move |i| {
            let [a, b] = [from + i, from + (i + 1) % 4];
            [[a, b, b + 4], [a, b + 4, a + 4]]
        })
    };
    let triangles = sides(0).chain(sides(4)).chain([[8, 9, 10], [8, 10, 11]]);
    (positions, triangles.collect())
}

/// A block on a floor: under a rounded edge there is more floor than before.
#[test]
fn a_blend_runs_through_to_a_face_around_its_end() {
    let (positions, triangles) = block_on_floor();
    assert_runs_through(&positions, &triangles, [6, 10]);
}

/// The face across is narrower than the blend is asked to be wide: so is the blend there.
#[test]
fn a_blend_is_as_narrow_as_the_face_that_it_runs_through_to() {
    let (positions, triangles) = prism(&[[0.0, 0.0], [2.0, 0.0], [2.4, 0.3]], [0.0, 2.0]);
    let options = RoundOptions {
        width: 0.3,
        edges: vec![[1, 4]],
        ..RoundOptions::default()
    };
    let mesh = round(&positions, &triangles, &options).unwrap();
    assert_eq!(mesh.report.outcome, Outcome::Converged);
    let chain = mesh.chains.iter().find(|chain| chain.is_rounded).unwrap();
    let part = chain.narrowed.as_ref().unwrap().part;
    // The third edge is .248 from the corner.
    assert_below!(0.3 * part, 0.248);
    assert!(mesh.kept_vertices.contains(&0) && mesh.kept_vertices.contains(&2));
}

/// An arc that cuts a corner off leaves the same triangle on both sides of it, unless edges from one of its vertices to another are divided.
#[test]
fn each_edge_of_a_wedge_is_rounded_by_itself() {
    let (positions, triangles) = prism(&[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0]], [0.0, 2.0]);
    let edges = (0..3).flat_map(|i| {
        let j = (i + 1) % 3;
        [[i, j], [i + 3, j + 3], [i, i + 3]]
    });
    for edge in edges {
        let options = RoundOptions {
            width: 0.3,
            edges: vec![edge],
            ..RoundOptions::default()
        };
        let mesh = round(&positions, &triangles, &options).unwrap();
        assert_eq!(mesh.report.outcome, Outcome::Converged, "{edge:?}");
        assert_eq!(mesh.report.sharp_edges.len(), 2, "{edge:?}");
        assert_eq!(euler_number(&mesh), 2);
    }
}

/// An edge that ends between a ridge and a groove fades out there: its blend would end in the air.
#[test]
fn a_blend_fades_out_between_a_ridge_and_a_groove() {
    let (positions, triangles) = block_on_floor();
    let options = RoundOptions {
        width: 0.3,
        edges: vec![[4, 5]],
        ..RoundOptions::default()
    };
    let mesh = round(&positions, &triangles, &options).unwrap();
    assert_eq!(mesh.report.outcome, Outcome::Converged);
    assert_eq!(mesh.report.sharp_edges, []);
}

/// No ball touches two sides of an edge that does not bend but in the edge itself.
#[test]
fn an_edge_that_does_not_bend_can_be_named_with_a_radius() {
    let cube = cube();
    let diagonal = RoundOptions {
        radius: 0.2,
        edges: vec![[0, 5]],
        ..RoundOptions::default()
    };
    let mesh = round(&cube.0, &cube.1, &diagonal).unwrap();
    assert_below!(mesh.triangles.len(), 60_000);
}

/// The lids of the prism over a concave polygon, as a fan from a wrong corner: one of their triangles lies on others.
#[test]
fn an_edge_at_which_a_face_is_folded_over_stays_sharp_and_the_rest_ends_soon() {
    let corners = [
        [2.0, 0.5],
        [0.5, 0.5],
        [0.5, 2.0],
        [0.0, 2.0],
        [0.0, 0.0],
        [2.0, 0.0],
    ];
    let (positions, triangles) = prism(&corners, [0.0, 1.0]);
    let options = RoundOptions {
        width: 0.1,
        ..RoundOptions::default()
    };
    let made = round(&positions, &triangles, &options).unwrap();
    let folded = made.chains.iter().filter(|of| of.bend.abs() > 179.0);
    assert!(folded.clone().count() > 0 && { folded }.all(|of| !of.is_rounded && of.unsolved.is_some()));
    assert!(!made.is_complete());
}

#[test]
fn a_plate_much_thinner_than_the_width_takes_no_triangles_without_number() {
    let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let mesh = rounded(&prism(&square, [0.0, 0.01]), 0.2);
    assert_below!(mesh.triangles.len(), 60_000);
}

/// A roof over a strip, flat on one side: its ridge bends by these degrees at its edges, from one end to the other.
fn roof(bends: &[f64]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let row = |(i, bend): (usize, &f64)| {
        let (y, tilt) = (i as f64, bend.to_radians());
        [[-1.0, y, 0.0], [0.0, y, 0.0], [tilt.cos(), y, -tilt.sin()]]
    };
    let first = bends.iter().take(1);
    let positions = first.chain(bends).enumerate().flat_map(row).collect();
    let mut triangles = Vec::new();
    for v in (0..bends.len() as u32).flat_map(|i| [3 * i, 3 * i + 1]) {
        triangles.extend([[v, v + 1, v + 4], [v, v + 4, v + 3]]);
    }
    (positions, triangles)
}

#[test]
fn a_crease_that_bends_less_in_between_is_one() {
    let weak = [40.0, 36.0, 32.0, 28.0, 20.0, 17.0, 20.0, 28.0, 32.0, 36.0, 40.0];
    let bends = [[44.0; 6].as_slice(), &weak, &[44.0; 6]].concat();
    let mesh = rounded(&roof(&bends), 0.2);
    assert!(mesh.angle > 20.5 && mesh.angle < 28.0, "{}", mesh.angle);
    assert_eq!(mesh.chains.len(), 1);
    assert_eq!(mesh.chains[0].vertices.len(), 24);
    assert!(mesh.is_complete(), "{:?}", mesh.report.outcome);
}

#[test]
fn progress_rises_and_a_run_that_is_stopped_has_no_result() {
    let (positions, triangles) = cube();
    let options = RoundOptions {
        width: 0.2,
        ..RoundOptions::default()
    };
    let mut told = Vec::new();
    let mut tell = |progress: &Progress| {
        told.push(progress.fraction);
        ControlFlow::Continue(())
    };
    let whole = round_with_progress(&positions, &triangles, &options, &mut tell)
        .unwrap()
        .unwrap();
    assert!(
        told.len() > 2 && told.is_sorted() && told[told.len() - 1] <= 1.0,
        "{told:?}"
    );
    assert_eq!(
        whole.positions,
        rounded(&(positions.clone(), triangles.clone()), 0.2).positions
    );
    let mut calls = 0;
    let mut stop = |_: &Progress| {
        calls += 1;
        match calls {
            1 => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        }
    };
    let stopped = round_with_progress(&positions, &triangles, &options, &mut stop).unwrap();
    assert!(stopped.is_none());
}

#[test]
fn the_vertices_of_blends_are_told_before() {
    for (mesh, width) in [
        (cube(), 0.2),
        (cube(), 0.05),
        (prism(&polygon(48, 1.0), [0.0, 1.0]), 0.1),
    ] {
        let options = RoundOptions {
            width,
            ..RoundOptions::default()
        };
        let told = blend_vertices(&mesh.0, &mesh.1, &options).unwrap() as f64;
        let made = rounded(&mesh, width).parents.len() as f64;
        assert!(told > made / 2.0 && told < 2.0 * made, "{told} of {made}");
    }
}
