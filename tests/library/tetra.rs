//! The tetra thing (paper Fig. 8): fixed curves inside a closed surface, and two sizes of one shape.

use crate::fairing::*;
use crate::tier::tier;
use fairmesh::{BoundaryNormals, InnerFairness, Options, Solution, mean_curvature};
use fairmesh_shapes::{Sampling, Shape, tetra_thing, tetra_thing_coarse, tetra_thing_of};

/// The coarse surface may leave the fine one by this much of the diagonal.
const COARSE_TO_FINE: f64 = 1.2e-2;

fn faired(shape: &Shape, inner: InnerFairness) -> Solution {
    let options = Options {
        boundary_normals: BoundaryNormals::Given(shape.boundary_normals()),
        inner_fairness: inner,
        ..options(1e-8)
    };
    attempt(shape, options).unwrap()
}

#[test]
fn both_sizes_are_the_same_shape() {
    let mut bars = Bars::default();
    let (coarse, fine) = (tetra_thing_coarse(), tetra_thing());
    let both = [InnerFairness::Uniform, InnerFairness::Conformal];
    for &inner in tier(&both[..1], &both) {
        let (small, large) = (faired(&coarse, inner), faired(&fine, inner));
        let apart = distances_to_mesh(&small.positions, &large.positions, &fine.triangles);
        let apart = apart.max / large.report.diagonal;
        let (few, many) = (small.report.iterations, large.report.iterations);
        println!("{inner:?}: {apart:.2e} apart, {few} and {many} iterations");
        bars.at_most(format!("{inner:?}"), apart, COARSE_TO_FINE);
        for (n, solution) in [(500, &small), (13_308, &large)] {
            bars.converged(format!("{inner:?} {n}"), solution);
            // The extremes of a harmonic H are on the circles (paper 3).
            let ([low, high], [least, most]) = (
                solution.report.quality.h_inside,
                solution.report.quality.h_boundary,
            );
            bars.at_least(format!("{inner:?} {n}, least H"), low, least);
            bars.at_most(format!("{inner:?} {n}, largest H"), high, most);
        }
    }
    bars.finish();
}

/// What is shown of a surface is what was solved for: H of the whole mesh is the solver's at the free vertices, but for
/// those beside a circle, of which the solver sees one side only.
#[test]
fn the_curvature_shown_is_the_curvature_solved_for() {
    let mut bars = Bars::default();
    let shape = tetra_thing_coarse();
    let solution = faired(&shape, InnerFairness::Uniform);
    let shown = mean_curvature(&solution.positions, &shape.triangles).unwrap();
    let mut beside = vec![false; shape.free.len()];
    for t in shape
        .triangles
        .iter()
        .filter(|t| t.iter().any(|&v| !shape.free[v as usize]))
    {
        t.iter().for_each(|&v| beside[v as usize] = true);
    }
    let worst = solution
        .mean_curvature
        .iter()
        .filter(|(v, _)| !beside[*v as usize])
        .map(|&(v, h)| (h - shown[v as usize]).abs())
        .fold(0.0, f64::max);
    bars.at_most("difference", worst, 1e-9);
    bars.finish();
}

/// The triangulation does not matter: irregular meshes and a finely divided corner give the shape of the regular one.
#[test]
fn irregular_and_refined_ones_are_the_same_shape() {
    are_the_same_shape(tier(1_500, 3_000));
}

#[test]
#[ignore = "full tier: 13,308 vertices"]
fn irregular_and_refined_ones_of_full_size_are_the_same_shape() {
    are_the_same_shape(13_308);
}

fn are_the_same_shape(n: usize) {
    let mut bars = Bars::default();
    let fine = tetra_thing();
    let wanted = faired(&fine, InnerFairness::Uniform);
    // Whatever its fields.
    let refined = Sampling::LocallyRefined {
        factor: 3.0,
        min: [0.0; 2],
        max: [1.0; 2],
    };
    let irregular = [1, 2, 3].map(|seed| Sampling::Irregular { seed });
    let cases = irregular.into_iter().chain([refined]);
    for sampling in cases {
        let shape = tetra_thing_of(n, sampling);
        let solution = faired(&shape, InnerFairness::Uniform);
        let apart = distances_to_mesh(&solution.positions, &wanted.positions, &fine.triangles);
        let apart = apart.max / wanted.report.diagonal;
        println!(
            "{n} {sampling:?}: {apart:.2e} apart, {} iterations",
            solution.report.iterations
        );
        bars.converged(format!("{n} {sampling:?}"), &solution);
        bars.at_most(format!("{n} {sampling:?}"), apart, COARSE_TO_FINE);
    }
    bars.finish();
}
