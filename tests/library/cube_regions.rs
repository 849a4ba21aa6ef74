//! Regions near a corner of a cube, whose boundaries run as they like: along edges, through the corner, beside it. All are exact.

use crate::fairing::*;
use crate::regions::cube;
use crate::tier::tier;
use fairmesh::{Coincident, Options, Selection, fair, rim_roughness};

/// A number from 0 to 1 that looks random.
fn chance(seed: u32, of: f64) -> f64 {
    (f64::from(seed) * of).sin().abs()
}

/// A cube whose vertices lie unevenly on its faces and edges.
fn uneven_cube(seed: u32) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let (mut positions, triangles) = cube(10);
    for p in &mut positions {
        let q = *p;
        for k in 0..3 {
            let phase = 37.0 * q[k] + 61.0 * q[(k + 1) % 3] + 83.0 * q[(k + 2) % 3];
            if q[k] > 0.01 && q[k] < 0.99 {
                p[k] += 0.035 * (f64::from(seed) * 1.7 + phase).sin();
            }
        }
    }
    (positions, triangles)
}

/// How far a point is off the nearest face.
fn off(p: &[f64; 3]) -> f64 {
    let faces = p.iter().map(|x| x.abs().min((x - 1.0).abs()));
    faces.fold(f64::MAX, f64::min)
}

/// The free vertices near a corner.
fn ball(positions: &[[f64; 3]], seed: u32) -> Vec<bool> {
    let centre = [
        0.0,
        0.1 + 0.2 * chance(seed, 0.77),
        0.1 + 0.2 * chance(seed, 1.31),
    ];
    let radius = 0.1 + 0.3 * chance(seed, 2.3);
    let far = |p: &[f64; 3]| (0..3).map(|k| (p[k] - centre[k]).powi(2)).sum::<f64>().sqrt();
    positions.iter().map(|p| far(p) < radius).collect()
}

/// A rim that bends where sharp edges pass it is not noise, and relaxing it would crumple them.
#[test]
fn rims_across_sharp_edges_are_never_advised_to_be_relaxed() {
    let mut bent = 0;
    for seed in 1..=60 {
        let (positions, mut triangles) = uneven_cube(seed);
        let free = ball(&positions, seed);
        triangles.retain(|tri| !tri.iter().any(|&v| free[v as usize]));
        let rough = rim_roughness(&positions, &triangles, Coincident::default()).unwrap();
        for of in rough.iter().flatten() {
            assert_eq!(of.advice, None, "{seed}");
            bent += usize::from(of.ratio() > 2.0);
        }
    }
    assert_above!(bent, 20);
}

#[test]
fn regions_near_a_corner_are_exact_wherever_their_boundary_runs() {
    let seeds = *tier(&60, &400);
    let (mut crossed, mut failed) = (0, 0);
    for seed in 1..=seeds {
        let (positions, triangles) = uneven_cube(seed);
        let free = ball(&positions, seed);
        let asked = Options {
            sharp: Options::SHARP_AUTO,
            ..options(1e-9)
        };
        let solution = fair(&positions, &triangles, Selection::Mask(&free), &asked).unwrap();
        let edges = &solution.report.sharp_edges;
        failed += usize::from(!solution.report.outcome.is_success());
        assert!(
            edges.iter().all(|edge| !edge.vertices.is_empty()),
            "{seed}: {edges:?}"
        );
        // The normals of a region on one face are fitted to what is beyond its edges, too.
        let bar = if edges.is_empty() { 1e-3 } else { 1e-6 };
        assert_below!(solution.positions.iter().map(off).fold(0.0, f64::max), bar);
        crossed += usize::from(!edges.is_empty());
    }
    assert!(failed <= seeds as usize / 200, "{failed}");
    assert_above!(crossed, 40);
}
