//! Time of one evaluation of both fairness equations, per free vertex: an irregular spherical cap with noise, the default
//! discretization and the paper's, on one thread and on two.

use divan::Bencher;
use divan::counter::ItemsCount;
use fairmesh::Selection;
use fairmesh::discrete::curvature::TILT_RIDGE;
use fairmesh::discrete::equations::{Equations, FreeCurvature, State};
use fairmesh::discrete::inner_fairness::FairnessWeights;
use fairmesh::discrete::target::{RightHandSide, Target};
use fairmesh::discrete::valence_batches::ValenceBatches;
use fairmesh::mesh::{Region, Rings};
use fairmesh::shapes::{Sampling, sphere_cap};

fn main() {
    divan::main();
}

const VERTICES: [usize; 3] = [1_000, 13_000, 100_000];

fn evaluate(
    bencher: Bencher,
    vertices: usize,
    threads: usize,
    curvature: FreeCurvature,
    right_hand_side: RightHandSide,
) {
    let shape = sphere_cap(60.0, vertices, Sampling::Irregular { seed: 7 }, 4);
    let region = Region::new(&shape.positions, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
    let x = region.positions(&shape.noise(3, 0.1));
    let exact = region.positions(&shape.positions);
    let boundary_normals: Vec<_> = exact[region.free..region.region_vertices()]
        .iter()
        .map(|p| p.normalize())
        .collect();
    let rings = Rings::new(&region);
    let batches = ValenceBatches::new(&rings);
    let weights = FairnessWeights::uniform();
    let equations = Equations {
        rings: &rings,
        batches: &batches,
        boundary_normals: &boundary_normals,
        smooth_interior: &[],
        weights: &weights,
        curvature,
        right_hand_side,
    };
    let mut state = State::new(&batches, region.boundary);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    bencher
        .counter(ItemsCount::new(region.free))
        .bench_local(|| pool.install(|| equations.evaluate(&x, &mut state)));
}

const SECOND_ORDER: FreeCurvature = FreeCurvature::GradientCorrected {
    tilt_ridge: TILT_RIDGE,
};

#[divan::bench(args = VERTICES, consts = [1, 2])]
fn second_order<const THREADS: usize>(bencher: Bencher, vertices: usize) {
    evaluate(bencher, vertices, THREADS, SECOND_ORDER, RightHandSide::default());
}

#[divan::bench(args = VERTICES, consts = [1, 2])]
fn paper<const THREADS: usize>(bencher: Bencher, vertices: usize) {
    evaluate(
        bencher,
        vertices,
        THREADS,
        FreeCurvature::Paper,
        RightHandSide::default(),
    );
}

/// The default discretization with the right-hand side of minimal energy.
#[divan::bench(args = VERTICES, consts = [1, 2])]
fn minimal_energy<const THREADS: usize>(bencher: Bencher, vertices: usize) {
    evaluate(
        bencher,
        vertices,
        THREADS,
        SECOND_ORDER,
        Target::MinimalEnergy.right_hand_side(1.0),
    );
}
