//! Loops that make trouble: pinched ones, ones that something passes through, ones whose normals ask too much.

use fairmesh::{
    BoundaryLoop, Coincident, FillOptions, FillOutcome, Join, LoopKind, Loops, OpenReason, Outcome,
    boundary_loops, boundary_loops_joined, fill_holes, self_intersections,
};

use crate::fairing::vector;

/// A part of the unit sphere of 20 by 20 quads without two blocks of 3 by 3 that meet in one vertex, of which each of its two
/// fans has a copy of its own: so a mesh is written whose vertices have to be manifold.
fn pinched() -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let at = |i: u32, j: u32| 21 * j + i;
    let place = |v: u32| {
        let (i, j) = (f64::from(v % 21), f64::from(v / 21));
        vector(&[0.05 * i - 0.5, 0.05 * j - 0.5, 1.0]).normalize().into()
    };
    let mut x: Vec<[f64; 3]> = (0..441).map(place).collect();
    let (pinch, copy) = (at(10, 10), 441);
    x.push(x[pinch as usize]);
    let mut t = Vec::new();
    for (i, j) in (0..20).flat_map(|j| (0..20).map(move |i| (i, j))) {
        let is_gone = |low: u32| (low..low + 3).contains(&i) && (low..low + 3).contains(&j);
        if is_gone(7) || is_gone(10) {
            continue;
        }
        for tri in [
            [at(i, j), at(i + 1, j), at(i + 1, j + 1)],
            [at(i, j), at(i + 1, j + 1), at(i, j + 1)],
        ] {
            t.push(tri.map(|v| if v == pinch && i < 10 { copy } else { v }));
        }
    }
    (x, t)
}

fn holes(loops: &[BoundaryLoop]) -> Vec<&BoundaryLoop> {
    loops.iter().filter(|of| of.kind == LoopKind::Hole).collect()
}

#[test]
fn holes_that_meet_in_two_copies_of_a_vertex_are_two() {
    let (x, t) = pinched();
    let loops = boundary_loops(&x, &t).unwrap();
    let found = holes(&loops);
    assert_eq!(
        found.iter().map(|of| of.vertices.len()).collect::<Vec<_>>(),
        [12, 12]
    );
    let mut touching: Vec<u32> = found.iter().flat_map(|of| of.touching.iter().copied()).collect();
    touching.sort_unstable();
    assert_eq!(touching, [220, 441]);
    // As its triangles say it is one.
    let separate = boundary_loops_joined(&x, &t, Coincident::Separate).unwrap();
    assert_eq!(holes(&separate).len(), 1);
    assert_eq!(holes(&separate)[0].vertices.len(), 24);
    let filled = fill_holes(&x, &t, &FillOptions::default()).unwrap();
    let off = filled.positions[x.len()..]
        .iter()
        .map(|p| (vector(p).norm() - 1.0).abs());
    assert_above!(filled.positions.len(), x.len() + 4);
    assert_below!(off.fold(0.0, f64::max), 1e-8);
    let rest = boundary_loops(&filled.positions, &filled.triangles).unwrap();
    assert_eq!(holes(&rest).len(), 0);
    assert_eq!(rest.len(), 1);
}

#[test]
fn loops_that_meet_in_two_copies_of_a_vertex_are_not_joined() {
    let (x, t) = pinched();
    let loops = boundary_loops(&x, &t).unwrap();
    let both: Vec<usize> = (0..loops.len())
        .filter(|&l| loops[l].kind == LoopKind::Hole)
        .collect();
    let options = FillOptions {
        loops: Loops::Chosen(Vec::new()),
        join: Join::Groups(vec![both]),
        ..FillOptions::default()
    };
    let filled = fill_holes(&x, &t, &options).unwrap();
    let reason = OpenReason::SharedVertex { vertex: 220 };
    assert_eq!(filled.loops[0].outcome, FillOutcome::LeftOpen(reason));
}

/// A frame around a square whose corners lie at heights 0 and `h` by turns, and a small upright triangle in its middle at height `z`.
fn frame(h: f64, z: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let corner = |k: usize, r: f64| {
        let [a, b] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]][k];
        [r * a, r * b, if k.is_multiple_of(2) { 0.0 } else { h }]
    };
    let mut x: Vec<[f64; 3]> = (0..8)
        .map(|v| corner(v % 4, if v < 4 { 1.0 } else { 2.0 }))
        .collect();
    let mut t = Vec::new();
    for k in 0..4 {
        let next = (k + 1) % 4;
        t.extend([[k, next + 4, next], [k, k + 4, next + 4]]);
    }
    x.extend([
        [-0.05, -0.02, z - 0.1],
        [0.05, 0.02, z - 0.1],
        [0.0, 0.0, z + 0.1],
    ]);
    t.push([8, 9, 10]);
    (x, t)
}

#[test]
fn a_triangulation_passes_beside_what_is_in_the_hole() {
    let hole = |x: &[[f64; 3]], t: &[[u32; 3]]| {
        let loops = boundary_loops(x, t).unwrap();
        (0..loops.len())
            .find(|&l| loops[l].vertices.contains(&0))
            .unwrap()
    };
    // Low, where one diagonal of the square is, and high, where the other one is.
    for z in [0.0, 0.8] {
        let (x, t) = frame(0.8, z);
        let filled = fill_holes(&x, &t, &FillOptions::default()).unwrap();
        let report = &filled.loops[hole(&x, &t)];
        assert!(
            !matches!(report.outcome, FillOutcome::LeftOpen(_)),
            "{z}: {:?}",
            report.outcome
        );
        assert_eq!(report.self_intersections.len(), 0, "{z}: {:?}", report.outcome);
        assert_eq!(
            self_intersections(&filled.positions, &filled.triangles, None)
                .unwrap()
                .len(),
            0,
            "{z}"
        );
    }
}

#[test]
fn normals_that_no_sound_patch_has_are_drawn_towards_a_membrane_s() {
    let report = |height: f64| {
        let (x, t) = ruff(40, height);
        let loops = boundary_loops(&x, &t).unwrap();
        let hole = (0..loops.len())
            .find(|&l| loops[l].vertices.contains(&0))
            .unwrap();
        let mut filled = fill_holes(&x, &t, &FillOptions::default()).unwrap();
        filled.loops.swap_remove(hole)
    };
    let gentle = report(0.1);
    assert_eq!(
        (gentle.outcome, gentle.normals_reached),
        (FillOutcome::Faired, 1.0)
    );
    let steep = report(0.8);
    assert_eq!(steep.outcome, FillOutcome::Faired);
    assert_below!(steep.normals_reached, 1.0);
    assert_eq!(steep.self_intersections.len(), 0);
    let outcome = steep.fairing.unwrap().outcome;
    assert_matches!(outcome, Outcome::BoundaryCrease { .. });
}

/// A circle of `n` vertices around a hole, and around it one that goes up and down by `height`.
fn ruff(n: u32, height: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let at = |k: u32, r: f64, z: f64| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(n)).sin_cos();
        [r * cos, r * sin, z]
    };
    let up = |k: u32| if k % 4 < 2 { height } else { -height };
    let mut x: Vec<[f64; 3]> = (0..n).map(|k| at(k, 1.0, 0.0)).collect();
    x.extend((0..n).map(|k| at(k, 1.2, up(k))));
    let side = |k: u32| {
        let next = (k + 1) % n;
        [[k, next + n, next], [k, k + n, next + n]]
    };
    (x, (0..n).flat_map(side).collect())
}
