//! Factor and solve times of the sparse direct solver on triangulated jittered grids, for the scalar
//! Laplacian `G` (1-ring graph) and a bilaplacian-like matrix `P` (2-ring graph).

use std::sync::{Arc, OnceLock};

use divan::Bencher;
use fairmesh_linear::Real;
use fairmesh_linear::cholesky::{Cholesky, SolveWork};
use fairmesh_linear::ordering::{amd, fill_reducing, landmark_coordinates, nested_dissection};
use fairmesh_linear::sparse::SymmetricPattern;
use fairmesh_linear::symbolic::Symbolic;

fn main() {
    divan::main();
}

const SIDES: [usize; 3] = [32, 116, 316];

struct Case {
    graph: SymmetricPattern,
    pattern: SymmetricPattern,
    values: Vec<f64>,
    order: Vec<u32>,
    symbolic: Arc<Symbolic>,
}

fn noise(state: &mut u64) -> f64 {
    *state = state
        .wrapping_mul(6364136223846793005)
        .wrapping_add(1442695040888963407);
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

fn grid(side: usize) -> SymmetricPattern {
    let mut state = 7;
    let mut edges = Vec::new();
    for r in 0..side {
        for c in 0..side {
            let v = r * side + c;
            edges.extend((c + 1 < side).then_some([v, v + 1]));
            edges.extend((r + 1 < side).then_some([v, v + side]));
            if c + 1 < side && r + 1 < side {
                let down = noise(&mut state) < 0.5;
                edges.push(if down {
                    [v, v + side + 1]
                } else {
                    [v + 1, v + side]
                });
            }
        }
    }
    let edges: Vec<[u32; 2]> = edges.into_iter().map(|e| e.map(|v| v as u32)).collect();
    SymmetricPattern::from_edges(side * side, &edges)
}

fn laplacian(pattern: &SymmetricPattern) -> Vec<f64> {
    let mut state = 11;
    let mut values = vec![0.0; pattern.column.len()];
    let mut diagonal = vec![0.01; pattern.order()];
    for i in 0..pattern.order() {
        for t in pattern.start[i]..pattern.start[i + 1] - 1 {
            let w = 0.5 + noise(&mut state);
            values[t] = -w;
            diagonal[i] += w;
            diagonal[pattern.column[t] as usize] += w;
        }
    }
    for i in 0..pattern.order() {
        values[pattern.start[i + 1] - 1] = diagonal[i];
    }
    values
}

fn case(side: usize, ring: usize) -> &'static Case {
    static CASES: [OnceLock<Case>; 6] = [const { OnceLock::new() }; 6];
    let at = SIDES.iter().position(|&s| s == side).unwrap_or(0) * 2 + ring - 1;
    CASES[at].get_or_init(|| {
        let graph = grid(side);
        let pattern = if ring == 2 { graph.square() } else { graph.clone() };
        let order = fill_reducing(&pattern, &graph, ring, None);
        let symbolic = Arc::new(Symbolic::new(&pattern, &order));
        Case {
            values: laplacian(&pattern),
            graph,
            pattern,
            order,
            symbolic,
        }
    })
}

#[divan::bench(args = SIDES, consts = [1, 2])]
fn order_amd<const RING: usize>(bencher: Bencher, side: usize) {
    let case = case(side, RING);
    bencher.bench_local(|| amd(&case.pattern));
}

#[divan::bench(args = SIDES, consts = [1, 2])]
fn order_dissection<const RING: usize>(bencher: Bencher, side: usize) {
    let case = case(side, RING);
    bencher.bench_local(|| nested_dissection(&case.graph, RING, &landmark_coordinates(&case.graph)));
}

#[divan::bench(args = SIDES)]
fn coordinates(bencher: Bencher, side: usize) {
    let case = case(side, 1);
    bencher.bench_local(|| landmark_coordinates(&case.graph));
}

#[divan::bench(args = SIDES, consts = [1, 2])]
fn symbolic<const RING: usize>(bencher: Bencher, side: usize) {
    let case = case(side, RING);
    bencher.bench_local(|| Symbolic::new(&case.pattern, &case.order));
}

#[divan::bench(args = SIDES, types = [f32, f64], consts = [1, 2])]
fn factor<T: Real, const RING: usize>(bencher: Bencher, side: usize) {
    let case = case(side, RING);
    let mut factor = Cholesky::<T>::new(case.symbolic.clone());
    bencher.bench_local(|| factor.factor(&case.values).is_ok());
}

fn solve<T: Real, const RING: usize, const K: usize>(bencher: Bencher, side: usize) {
    let case = case(side, RING);
    let mut factor = Cholesky::<T>::new(case.symbolic.clone());
    let ok = factor.factor(&case.values);
    let mut work = SolveWork::default();
    let mut x = vec![[1.0; K]; side * side];
    bencher.bench_local(|| {
        x.fill([1.0; K]);
        factor.solve(&mut x, &mut work);
        ok
    });
}

#[divan::bench(args = SIDES, types = [f32, f64], consts = [1, 2])]
fn solve_1<T: Real, const RING: usize>(bencher: Bencher, side: usize) {
    solve::<T, RING, 1>(bencher, side);
}

#[divan::bench(args = SIDES, types = [f32, f64], consts = [1, 2])]
fn solve_3<T: Real, const RING: usize>(bencher: Bencher, side: usize) {
    solve::<T, RING, 3>(bencher, side);
}
