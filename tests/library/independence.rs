//! What the result must not depend on: the start, the triangulation, the numbering, the place and the scale.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::Arc;

use crate::fairing::*;
use fairmesh::{InnerFairness, Options, Solution};
use fairmesh_linear::cholesky::{Cholesky, SolveWork};
use fairmesh_linear::ordering::amd;
use fairmesh_linear::sparse::SymmetricPattern;
use fairmesh_linear::symbolic::Symbolic;
use fairmesh_shapes::*;
use nalgebra::Vector3;

fn free_positions(shape: &Shape, positions: &[[f64; 3]]) -> Vec<[f64; 3]> {
    shape
        .free_vertices()
        .iter()
        .map(|&v| positions[v as usize])
        .collect()
}

/// Largest distance of the free vertices of one result to the triangles of another, in diagonals of the other.
fn off(a: (&Shape, &[[f64; 3]]), b: (&Shape, &[[f64; 3]]), diagonal: f64) -> Errors {
    let e = distances_to_mesh(&free_positions(a.0, a.1), b.1, &b.0.triangles);
    Errors {
        max: e.max / diagonal,
        rms: e.rms / diagonal,
    }
}

#[test]
fn start() {
    the_start_does_not_matter(&[
        ("cap", sphere_cap(60.0, 1_000, irregular(1), OUTSIDE)),
        ("cylinder", cylinder_band(1_000, irregular(2), OUTSIDE)),
        ("blend", cylinder_blend()),
        ("blend", cylinder_blend_refined_patch()),
    ]);
}

#[test]
#[ignore = "full tier: 13,000 vertices"]
fn start_of_large_regions() {
    the_start_does_not_matter(&[
        ("cap", sphere_cap(60.0, 13_000, irregular(1), OUTSIDE)),
        ("cylinder", cylinder_band(13_000, irregular(2), OUTSIDE)),
        ("blend", cylinder_blend_fine()),
    ]);
}

fn the_start_does_not_matter(shapes: &[(&str, Shape)]) {
    let mut bars = Bars::default();
    for (name, shape) in shapes {
        let solved = starts(shape, 3).map(|(_, positions)| solve(shape, &positions, options(TIGHT)));
        let n = shape.free_count();
        let gap = |k: usize| apart(&solved[0].positions, &solved[k].positions) / solved[0].report.diagonal;
        println!(
            "{name:9} {n:6} flat to noise {:.2e}, to random {:.2e}",
            gap(1),
            gap(2)
        );
        bars.at_most(format!("{name} {n}: flat to noise"), gap(1), 1e-7);
        bars.at_most(format!("{name} {n}: flat to random"), gap(2), 1e-7);
        for (k, s) in solved.iter().enumerate() {
            bars.converged(format!("{name} {n} start {k}"), s);
        }
    }
    bars.finish();
}

fn blend(shape: &Shape, inner: InnerFairness) -> Solution {
    solve(
        shape,
        &shape.positions,
        Options {
            inner_fairness: inner,
            ..options(1e-9)
        },
    )
}

/// A triangulation of the blend, and the surface that was found on it.
struct Blend {
    name: &'static str,
    shape: Shape,
    solution: Solution,
}

impl Blend {
    fn new(bars: &mut Bars, name: &'static str, shape: Shape, inner: InnerFairness) -> Self {
        let solution = blend(&shape, inner);
        let report = &solution.report;
        println!(
            "blend {name}: {} iterations, {}",
            report.iterations,
            report.outcome.name()
        );
        bars.converged(name, &solution);
        Self {
            name,
            shape,
            solution,
        }
    }

    fn surface(&self) -> (&Shape, &[[f64; 3]]) {
        (&self.shape, &self.solution.positions)
    }
}

/// The blend of three cylinders on different triangulations, against each other.
#[test]
fn triangulation() {
    use InnerFairness::{Conformal, Convex, Uniform};
    let mut bars = Bars::default();
    let coarse = Blend::new(&mut bars, "118", cylinder_blend_coarse(), Uniform);
    let [uniform, conformal, convex] = [
        ("920 uniform", Uniform),
        ("920 conformal", Conformal),
        ("920 convex", Convex),
    ]
    .map(|(name, inner)| Blend::new(&mut bars, name, cylinder_blend(), inner));
    let patch = Blend::new(
        &mut bars,
        "refined patch",
        cylinder_blend_refined_patch(),
        Uniform,
    );
    let fine = Blend::new(&mut bars, "13,308", cylinder_blend_fine(), Uniform);
    for (a, b, bar) in [
        (&uniform, &conformal, 1.5e-3),
        (&uniform, &convex, 1.5e-3),
        (&convex, &uniform, 1.5e-3),
        (&conformal, &uniform, 1.5e-3),
        (&coarse, &uniform, 4e-3),
        (&uniform, &fine, 1e-3),
        (&patch, &fine, 1e-3),
    ] {
        let what = format!("{} to {}", a.name, b.name);
        let e = off(a.surface(), b.surface(), fine.solution.report.diagonal);
        println!("{what:36} max {:.2e} rms {:.2e}", e.max, e.rms);
        bars.at_most(what, e.max, bar);
    }
    compare_linear_fairing(&mut bars, &patch, &fine);
    bars.finish();
}

/// Linear fairing depends more on the triangulation.
fn compare_linear_fairing(bars: &mut Bars, patch: &Blend, fine: &Blend) {
    let d = fine.solution.report.diagonal;
    let ours = off(patch.surface(), fine.surface(), d);
    for (name, weights) in [
        ("uniform", uniform_weights as Weights),
        ("cotangent", cotangent_weights),
    ] {
        let [p, f] = [patch, fine].map(|blend| linear_fairing(&blend.shape, weights));
        let e = off((&patch.shape, &p), (&fine.shape, &f), d);
        let to_ours = off((&patch.shape, &p), fine.surface(), d);
        println!(
            "linear bilaplacian, {name:9}          max {:.2e} rms {:.2e}, to the nonlinear surface {:.2e}",
            e.max, e.rms, to_ours.max
        );
        bars.at_least(format!("linear over nonlinear, {name}"), e.max / ours.max, 5.0);
    }
}

/// Off-diagonal weight and mass of a discrete Laplacian: what a triangle adds to its three edges (opposite to
/// its corners) and to its corners.
type Weights = fn([Vector3<f64>; 3]) -> ([f64; 3], f64);

/// The umbrella of uniform weights: an inner edge has two triangles.
fn uniform_weights(_: [Vector3<f64>; 3]) -> ([f64; 3], f64) {
    ([0.5; 3], 1.0)
}

fn cotangent_weights(p: [Vector3<f64>; 3]) -> ([f64; 3], f64) {
    let double_area = (p[1] - p[0]).cross(&(p[2] - p[0])).norm();
    let cotangent = |k: usize| (p[(k + 1) % 3] - p[k]).dot(&(p[(k + 2) % 3] - p[k])) / double_area;
    (std::array::from_fn(|k| 0.5 * cotangent(k)), double_area / 6.0)
}

/// Linear fairing of the blend, the usual peer: minimises `|M^(-1/2) L x|^2` of a fixed Laplacian of the input
/// over the free vertices, with the boundary and one more ring outside of it fixed, which lies on the tubes.
fn linear_fairing(shape: &Shape, weights: Weights) -> Vec<[f64; 3]> {
    let (positions, triangles) = with_ring_outside(shape);
    let n = shape.positions.len();
    let mut edges: BTreeMap<(u32, u32), f64> = BTreeMap::new();
    let mut mass = vec![0.0; positions.len()];
    for t in &triangles {
        let (weight, share) = weights(t.map(|v| vector(&positions[v as usize])));
        for k in 0..3 {
            let (a, b) = (t[(k + 1) % 3], t[(k + 2) % 3]);
            *edges.entry((a, b)).or_default() += weight[k];
            *edges.entry((b, a)).or_default() += weight[k];
            mass[t[k] as usize] += share;
        }
    }
    let mut rows: Vec<Vec<(usize, f64)>> = vec![Vec::new(); n];
    for (&(a, b), &w) in edges.iter().filter(|((a, _), _)| (*a as usize) < n) {
        let row = &mut rows[a as usize];
        row.push((a as usize, w));
        row.push((b as usize, -w));
    }
    let mut unknown = vec![None; positions.len()];
    shape
        .free_vertices()
        .iter()
        .enumerate()
        .for_each(|(i, &v)| unknown[v as usize] = Some(i));
    let count = shape.free_count();
    let (mut entries, mut right) = (BTreeMap::new(), vec![[0.0; 3]; count]);
    for (v, row) in rows.iter().enumerate() {
        for &(a, wa) in row {
            let Some(i) = unknown[a] else { continue };
            for &(b, wb) in row {
                let product = wa * wb / mass[v];
                match unknown[b] {
                    Some(j) => *entries.entry((i, j)).or_insert(0.0) += product,
                    None => (0..3).for_each(|c| right[i][c] -= product * positions[b][c]),
                }
            }
        }
    }
    let edges: Vec<[u32; 2]> = entries.keys().map(|&(i, j)| [i as u32, j as u32]).collect();
    let pattern = SymmetricPattern::from_edges(count, &edges);
    let row = |i: usize| pattern.row(i).iter().map(move |&j| (i, j as usize));
    let values: Vec<f64> = (0..count).flat_map(row).map(|entry| entries[&entry]).collect();
    let mut cholesky = Cholesky::<f64>::new(Arc::new(Symbolic::new(&pattern, &amd(&pattern))));
    cholesky.factor(&values).expect("positive definite");
    cholesky.solve(&mut right, &mut SolveWork::default());
    let place = |(v, p): (usize, &[f64; 3])| unknown[v].map_or(*p, |i| right[i]);
    positions[..n].iter().enumerate().map(place).collect()
}

/// The direction of the tube whose circle a boundary vertex of the blend lies on.
fn tube_axis(p: &[f64; 3]) -> Vector3<f64> {
    let axes = (0..3).map(|t| {
        let (sin, cos) = (TAU * f64::from(t) / 3.0).sin_cos();
        Vector3::new(cos, sin, 0.0)
    });
    axes.max_by(|a, b| a.dot(&vector(p)).total_cmp(&b.dot(&vector(p))))
        .unwrap()
}

/// The blend with one more ring of vertices on every tube, one edge length further out.
fn with_ring_outside(shape: &Shape) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let (mut positions, mut triangles) = (shape.positions.clone(), shape.triangles.clone());
    let mut run: Vec<(u32, u32)> = Vec::new();
    for t in &shape.triangles {
        run.extend((0..3).map(|k| (t[k], t[(k + 1) % 3])));
    }
    run.sort_unstable();
    let boundary: Vec<(u32, u32)> = run
        .iter()
        .copied()
        .filter(|&(a, b)| run.binary_search(&(b, a)).is_err())
        .collect();
    let mut beyond = BTreeMap::new();
    for &(a, b) in &boundary {
        let (p, q) = (vector(&positions[a as usize]), vector(&positions[b as usize]));
        beyond.insert(a, positions.len() as u32);
        positions.push((p + tube_axis(&positions[a as usize]) * (p - q).norm()).into());
    }
    for (a, b) in boundary {
        triangles.push([b, a, beyond[&a]]);
        triangles.push([b, beyond[&a], beyond[&b]]);
    }
    (positions, triangles)
}

/// The input has the symmetry by construction, to rounding; nothing in the solver may break it.
#[test]
fn threefold_symmetry() {
    let shape = cylinder_blend();
    let turn = Similarity::new([0.0, 0.0, 1.0], TAU / 3.0, 1.0, [0.0; 3]);
    let image: Vec<usize> = shape
        .positions
        .iter()
        .map(|&p| {
            let p = vector(&turn.apply(p));
            let distance = |q: &[f64; 3]| (vector(q) - p).norm();
            let nearest = (0..shape.positions.len())
                .min_by(|&a, &b| distance(&shape.positions[a]).total_cmp(&distance(&shape.positions[b])))
                .unwrap();
            assert!(
                distance(&shape.positions[nearest]) < 1e-12,
                "the input is not symmetric"
            );
            nearest
        })
        .collect();
    let mut bars = Bars::default();
    for tolerance in [1e-8, TIGHT] {
        let solution = solve(&shape, &shape.positions, options(tolerance));
        let gaps = image.iter().zip(&solution.positions).map(|(&image, &p)| {
            (vector(&turn.apply(p)) - vector(&solution.positions[image])).norm() / solution.report.diagonal
        });
        let e = Errors::of(gaps);
        println!(
            "tolerance {tolerance:.0e}: asymmetry max {:.2e} rms {:.2e}",
            e.max, e.rms
        );
        bars.at_most(format!("asymmetry at {tolerance:.0e}"), e.max, 1e-9);
    }
    bars.finish();
}

/// The answer of the moved problem, moved back, against the answer. The tolerances are rounding times its
/// amplification: a position that is off by e turns the normals of its triangles by e / h, and a boundary strip of
/// width h carries that far into the region as a slope, so that the surface moves by about e / h; with
/// h of about 1/30 of the diagonal by 30 e, and by some hundred e where triangles are small.
#[test]
fn place_and_scale() {
    let mut bars = Bars::default();
    let turned = Similarity::new([1.0, 2.0, -0.5], 0.7, 1.0, [0.3, -4.0, 2.0]);
    let scaled = |scale: f64| Similarity::new([0.0, 0.0, 1.0], 0.0, scale, [0.0; 3]);
    for (name, shape) in [
        ("cap", sphere_cap(60.0, 1_000, irregular(1), OUTSIDE)),
        ("cylinder", cylinder_band(1_000, irregular(1), OUTSIDE)),
        ("blend", cylinder_blend()),
    ] {
        let start = if name == "blend" {
            shape.positions.clone()
        } else {
            shape.flat()
        };
        let solution = solve(&shape, &start, options(TIGHT));
        let d = solution.report.diagonal;
        let far = Similarity::new([0.0, 0.0, 1.0], 0.0, 1.0, [0.6e6 * d, -0.8e6 * d, 0.0]);
        // (0.6, -0.8, 0) 1e6 d: coordinates below 2^20 d, half a unit in the last place is below 1.2e-10 d.
        for (what, by, bar) in [
            ("rotated and moved", turned, 1e-9),
            ("scaled by 1e-6", scaled(1e-6), 1e-9),
            ("scaled by 1e+6", scaled(1e6), 1e-9),
            ("moved by 1e6 diagonals", far, 1e-7),
        ] {
            let moved = shape.transformed(&by);
            let start: Vec<[f64; 3]> = start.iter().map(|&p| by.apply(p)).collect();
            let answer = solve(&moved, &start, options(TIGHT));
            let back: Vec<[f64; 3]> = answer.positions.iter().map(|&p| by.undo(p)).collect();
            let gap = apart(&back, &solution.positions) / d;
            println!("{name:9} {what:24} {gap:.2e}");
            bars.at_most(format!("{name} {what}"), gap, bar);
            bars.converged(format!("{name} {what}"), &answer);
            if what != "rotated and moved" {
                // The bounding box is parallel to the axes.
                let size = (answer.report.diagonal / (by.scale * d) - 1.0).abs();
                bars.at_most(format!("{name} {what}: diagonal"), size, 1e-9);
            }
            let curvature = Errors::of(
                answer
                    .mean_curvature
                    .iter()
                    .zip(&solution.mean_curvature)
                    .map(|(moved, h)| (moved.1 * by.scale - h.1) * d),
            );
            // Curvature is second differences: e / h^2.
            bars.at_most(format!("{name} {what}: curvature"), curvature.max, 1e5 * bar);
        }
    }
    bars.finish();
}

/// Another numbering is another elimination order and other sums: rounding, amplified as above.
#[test]
fn numbering() {
    let mut bars = Bars::default();
    for (name, shape) in [
        ("cap", sphere_cap(60.0, 1_000, irregular(1), OUTSIDE)),
        ("cylinder", cylinder_band(5_000, irregular(1), OUTSIDE)),
        ("blend", cylinder_blend()),
    ] {
        let start = shape.noise(1, 0.3);
        let solution = solve(&shape, &start, options(TIGHT));
        let (other, new) = shape.renumbered(9);
        let mut other_start = start.clone();
        new.iter()
            .zip(&start)
            .for_each(|(&new, &p)| other_start[new as usize] = p);
        let answer = solve(&other, &other_start, options(TIGHT));
        let back: Vec<[f64; 3]> = new.iter().map(|&v| answer.positions[v as usize]).collect();
        let gap = apart(&back, &solution.positions) / solution.report.diagonal;
        println!("{name:9} renumbered {gap:.2e}");
        bars.at_most(format!("{name} renumbered"), gap, 1e-9);
        bars.converged(name, &answer);
    }
    bars.finish();
}
