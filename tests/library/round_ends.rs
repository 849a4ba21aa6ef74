//! Where rounded creases end: faces across from them, and boundaries.

use std::f64::consts::TAU;

use fairmesh::{Outcome, RoundOptions, Rounded, SharpFate, round};

use crate::round::{block_on_floor, euler_number, prism};

const WIDTH: f64 = 0.2;

/// A sheet in the planes x = 0 and z = 0, which reaches to the height `high` and as far as x = 1, folded along the y axis. One end is at y = 0, the other one at
/// y = 2 + `lean` (x + z).
fn folded_sheet(high: f64, lean: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let profile = [[0.0, high], [0.0, 0.0], [1.0, 0.0]];
    let row = |y: f64, lean: f64| profile.map(|[x, z]| [x, y + lean * (x + z), z]);
    let positions = [row(0.0, 0.0), row(1.0, 0.0), row(2.0, lean)].concat();
    let cell = |a: u32| [[a, a + 1, a + 4], [a, a + 4, a + 3]];
    (positions, [0, 1, 3, 4].into_iter().flat_map(cell).collect())
}

fn rounded((positions, triangles): &(Vec<[f64; 3]>, Vec<[u32; 3]>), edges: Vec<[u32; 2]>) -> Rounded {
    let options = RoundOptions {
        width: WIDTH,
        edges,
        ..RoundOptions::default()
    };
    let mesh = round(positions, triangles, &options).unwrap();
    assert_eq!(mesh.report.outcome, Outcome::Converged);
    mesh
}

/// The largest distance of these vertices from the cylinder that touches x = 0 and z = 0.
fn off_cylinder(mesh: &Rounded, vertices: &[u32]) -> f64 {
    let places = vertices.iter().map(|&v| mesh.positions[v as usize]);
    let off = places.map(|[x, _, z]| ((x - WIDTH).hypot(z - WIDTH) - WIDTH).abs());
    off.fold(0.0, f64::max)
}

/// The vertices of a blend in the plane of the end that leans, or between both ends.
fn of_blend(mesh: &Rounded, lean: f64) -> [Vec<u32>; 2] {
    let height = |v: u32| {
        let [x, y, z] = mesh.positions[v as usize];
        y.min(2.0 + lean * (x + z) - y)
    };
    let all = || mesh.free.iter().copied();
    [
        all().filter(|&v| height(v).abs() < 1e-9).collect(),
        all().filter(|&v| height(v) > 1e-9).collect(),
    ]
}

#[test]
fn at_a_boundary_a_blend_runs_out_with_its_profile() {
    for lean in [0.0, 0.5, 1.2, -0.8] {
        let mut sheet = folded_sheet(1.0, lean);
        for _ in 0..2 {
            let mesh = rounded(&sheet, Vec::new());
            let [ends, between] = of_blend(&mesh, lean);
            assert_at_least!(ends.len(), 10);
            assert_below!(off_cylinder(&mesh, &ends), 1e-12);
            assert_below!(off_cylinder(&mesh, &between), 1e-3 * WIDTH);
            sheet.1.iter_mut().for_each(|t| t.swap(0, 1));
        }
    }
}

/// One flange is not as high as the blend is to be wide: there is a little left of it.
#[test]
fn a_blend_keeps_before_a_boundary_beside_its_crease() {
    let mesh = rounded(&folded_sheet(0.15, 0.0), Vec::new());
    let narrowed = mesh.chains[0].narrowed.as_ref().unwrap();
    assert_below!(WIDTH * narrowed.part, 0.13);
    let highest = mesh.free.iter().map(|&v| mesh.positions[v as usize][2]);
    assert_below!(highest.fold(0.0, f64::max), 0.13);
    assert!(mesh.kept_vertices.contains(&0) && mesh.kept_vertices.contains(&6));
}

/// Two folds of five triangles meet at a vertex of the boundary where the faces between them are narrower than any blend. The sheet beside it has a crease that
/// nothing stands in the way of.
#[test]
fn a_blend_keeps_off_faces_that_are_not_its_own() {
    let (mut positions, mut triangles) = folded_sheet(1.0, 0.0);
    let first = positions.len() as u32;
    let folds = [
        [-0.02, 0.32, 0.29],
        [-0.01, 0.32, 0.31],
        [0.69, -0.08, 0.25],
        [0.26, 0.14, 0.19],
        [0.0, 0.32, 0.4],
        [0.48, 0.32, 0.13],
    ];
    positions.extend(folds.map(|[x, y, z]| [x - 3.0, y, z]));
    let of_folds = [[0, 1, 5], [1, 4, 5], [3, 0, 5], [3, 1, 0], [1, 2, 4]];
    triangles.extend(of_folds.map(|t: [u32; 3]| t.map(|v| v + first)));
    let options = RoundOptions {
        width: 0.05,
        ..RoundOptions::default()
    };
    let mesh = round(&positions, &triangles, &options).unwrap();
    assert_eq!(mesh.report.outcome, Outcome::Converged);
    for chain in &mesh.chains {
        let is_of_sheet = chain.vertices.iter().all(|&v| v < first);
        assert_eq!(chain.is_rounded, is_of_sheet, "{chain:?}");
        assert_eq!(chain.unsolved.is_none(), is_of_sheet, "{chain:?}");
    }
    assert_at_least!(mesh.chains.len(), 2);
}

/// A cylinder that a plane cuts at a slant ends in an ellipse.
#[test]
fn a_blend_runs_through_to_a_face_that_leans() {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    for lean in [0.5, 1.2, -0.8] {
        let (mut positions, triangles) = prism(&square, [0.0, 2.0]);
        for p in &mut positions {
            // The edge to be rounded is the y axis.
            let [z, x, y] = *p;
            *p = [x, if y > 1.0 { y + lean * (x + z) } else { y }, z];
        }
        let mesh = rounded(&(positions, triangles), vec![[0, 4]]);
        for arc in &mesh.report.sharp_edges {
            assert_at_least!(arc.vertices.len(), 5);
            assert_below!(off_cylinder(&mesh, &arc.vertices), 1e-12);
        }
        let [_, between] = of_blend(&mesh, lean);
        assert_below!(off_cylinder(&mesh, &between), 3e-3 * WIDTH);
    }
}

/// The blends of the edges around the top of a prism, whose sides lean by so much, from 0 to 1.
fn rounded_top(turned: bool, lean: f64) -> Rounded {
    let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let (mut positions, mut triangles) = prism(&square, [-1.0, 1.0]);
    for [x, y, z] in &mut positions {
        let size = 1.0 - lean * (*z - 1.0);
        (*x, *y) = (*x * size, *y * size);
    }
    if turned {
        triangles.iter_mut().for_each(|t| t.swap(0, 1));
    }
    rounded(
        &(positions, triangles),
        (0..4).map(|i| [4 + i, 4 + (i + 1) % 4]).collect(),
    )
}

/// Cylinders between the top and the sides meet in ellipses from the third edges of the corners to where their rails cross on the top.
#[test]
fn edges_between_blends_go_on_as_mitres() {
    for turned in [false, true] {
        let mesh = rounded_top(turned, 0.0);
        let from_axis = |[x, y, z]: [f64; 3]| (x.abs().max(y.abs()) - 1.0 + WIDTH).hypot(z - 1.0 + WIDTH);
        for v in &mesh.free {
            assert_near!(from_axis(mesh.positions[*v as usize]), WIDTH, 1e-3 * WIDTH);
        }
        assert_eq!(mesh.report.sharp_edges.len(), 4);
        for edge in &mesh.report.sharp_edges {
            assert_eq!(edge.fate, SharpFate::GoesOn);
            assert_at_least!(edge.vertices.len(), 5);
            for v in &edge.vertices {
                let p = mesh.positions[*v as usize];
                assert_near!(p[0].abs(), p[1].abs(), 1e-12);
                assert_near!(from_axis(p), WIDTH, 1e-12);
            }
        }
        assert_eq!(euler_number(&mesh), 2);
    }
}

/// Rails on the faces beside a third edge arrive at one place of it, though they would cross it at different ones.
#[test]
fn rails_arrive_at_a_mitre_together() {
    let (mut positions, triangles) =
        prism(&[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]], [-1.0, 1.0]);
    // The edges along z lean along x.
    positions.iter_mut().for_each(|p| p[0] += 0.8 * p[2]);
    let top = (0..4).map(|i| [4 + i, 4 + (i + 1) % 4]).collect();
    let mesh = rounded(&(positions, triangles), top);
    assert_eq!(mesh.report.sharp_edges.len(), 4);
    assert!(mesh.sharp_corners.is_empty());
    assert_eq!(euler_number(&mesh), 2);
    assert_eq!(rounded_top(false, 0.4).report.sharp_edges.len(), 4);
}

/// Blends around the foot of a block meet in its upright edges, which go on to where rails cross on the floor.
#[test]
fn edges_of_a_block_go_on_to_the_floor_between_blends() {
    let foot = (0..4).map(|i| [4 + i, 4 + (i + 1) % 4]).collect();
    let mesh = rounded(&block_on_floor(), foot);
    let from_axis = |[x, y, z]: [f64; 3]| (x.abs().max(y.abs()) - 1.0 - WIDTH).hypot(z - WIDTH);
    for v in &mesh.free {
        assert_near!(from_axis(mesh.positions[*v as usize]), WIDTH, 2e-3 * WIDTH);
    }
    assert_eq!(mesh.report.sharp_edges.len(), 4);
    for v in mesh.report.sharp_edges.iter().flat_map(|edge| &edge.vertices) {
        let p = mesh.positions[*v as usize];
        assert_near!(p[0].abs(), p[1].abs(), 1e-12);
        assert_near!(from_axis(p), WIDTH, 1e-12);
    }
}

/// How far the rails of a blend are from where they should be, which is as far from the y axis as `width` says of y.
fn off_rails(mesh: &Rounded, width: impl Fn(f64) -> f64) -> f64 {
    let of_blend = mesh.triangles[mesh.kept_triangles.len()..].iter().flatten();
    let of_rails = of_blend.filter(|v| mesh.free.binary_search(v).is_err());
    let off = of_rails.map(|v| {
        let [x, y, z] = mesh.positions[*v as usize];
        assert_below!(x.min(z).abs(), 1e-12);
        (x.max(z) - width(y)).abs()
    });
    off.fold(0.0, f64::max)
}

#[test]
fn widths_change_evenly_from_where_a_chain_begins() {
    let sheet = folded_sheet(1.0, 0.0);
    let tapered = |edges: &[[u32; 2]], taper: f64| {
        let options = RoundOptions {
            width: 0.1,
            taper,
            edges: edges.to_vec(),
            ..RoundOptions::default()
        };
        let mesh = round(&sheet.0, &sheet.1, &options).unwrap();
        assert_eq!(mesh.report.outcome, Outcome::Converged);
        assert_eq!(mesh.chains[0].narrowed, None);
        mesh
    };
    let (rising, falling) = (|y: f64| 0.1 + 0.1 * y, |y: f64| 0.3 - 0.1 * y);
    assert_below!(off_rails(&tapered(&[], 3.0), rising), 1e-6);
    assert_below!(off_rails(&tapered(&[[1, 4], [4, 7]], 3.0), rising), 1e-6);
    assert_below!(off_rails(&tapered(&[[7, 4], [1, 4]], 3.0), falling), 1e-6);
    assert_below!(off_rails(&tapered(&[[4, 1], [4, 7]], 3.0), falling), 1e-6);
    // By the number of a copy of vertex 7, too, which another triangle has.
    let mut copied = sheet.clone();
    copied.0.push(sheet.0[7]);
    *copied.1.last_mut().unwrap() = copied.1.last().unwrap().map(|v| if v == 7 { 9 } else { v });
    let options = RoundOptions {
        width: 0.1,
        taper: 3.0,
        edges: vec![[9, 4], [4, 1]],
        ..RoundOptions::default()
    };
    let mesh = round(&copied.0, &copied.1, &options).unwrap();
    assert_below!(off_rails(&mesh, falling), 1e-6);
    // As steep as that nothing else makes widths change.
    assert_below!(off_rails(&tapered(&[], 8.0), |y| 0.1 + 0.35 * y), 1e-6);
    assert_eq!(
        tapered(&[], 1.0).positions,
        tapered(&[[7, 4], [4, 1]], 1.0).positions
    );
}

/// A face's fan has triangles without area along a mitre's line, once that is cut: they cross nothing.
#[test]
fn the_line_of_a_mitre_passes_triangles_without_area() {
    for (corners, width) in [(5, 0.13), (3, 0.05)] {
        let at = |i: u32| TAU * (f64::from(i) + 0.3) / f64::from(corners);
        let polygon: Vec<[f64; 2]> = (0..corners).map(|i| [at(i).cos(), at(i).sin()]).collect();
        let (positions, triangles) = prism(&polygon, [-1.0, 1.0]);
        let options = RoundOptions {
            width,
            edges: (0..corners)
                .map(|i| [corners + i, corners + (i + 1) % corners])
                .collect(),
            ..RoundOptions::default()
        };
        let mesh = round(&positions, &triangles, &options).unwrap();
        assert!(mesh.is_complete(), "{corners}: {:?}", mesh.sharp_corners);
        assert_eq!(mesh.report.sharp_edges.len(), corners as usize);
    }
}

/// The front of a block is so narrow that the blend at its foot would have to fade out at both ends before it begins.
#[test]
fn a_crease_too_short_to_fade_out_stays_sharp() {
    let (mut positions, triangles) = block_on_floor();
    [4, 5, 8, 9]
        .into_iter()
        .for_each(|v: usize| positions[v][0] *= 0.002);
    let mesh = rounded(&(positions, triangles), vec![[4, 5], [10, 11]]);
    let is_rounded: Vec<bool> = mesh.chains.iter().map(|of| of.is_rounded).collect();
    let sharp = mesh.chains.iter().filter(|of| of.unsolved.is_some());
    let sharp: Vec<&[u32]> = sharp.map(|of| &of.vertices[..]).collect();
    assert_eq!(sharp, [[5, 4]]);
    assert_eq!(is_rounded.iter().filter(|is| **is).count(), 1);
    assert!(!mesh.is_complete());
}
