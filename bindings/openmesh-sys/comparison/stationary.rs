//! Where OpenMesh's C1 smoother ends, solved directly: the umbrella of umbrellas vanishes at every free vertex.

use std::collections::{BTreeMap, BTreeSet};

use faer::Mat;
use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};

/// Rows of I - D⁻¹A: one vertex minus the mean of its neighbours.
fn umbrellas(count: usize, triangles: &[[u32; 3]]) -> Vec<Vec<(usize, f64)>> {
    let mut rings = vec![BTreeSet::new(); count];
    for t in triangles {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            rings[t[a] as usize].insert(t[b] as usize);
            rings[t[b] as usize].insert(t[a] as usize);
        }
    }
    let row = |(i, ring): (usize, &BTreeSet<usize>)| {
        let weight = -1.0 / ring.len() as f64;
        std::iter::once((i, 1.0))
            .chain(ring.iter().map(|&j| (j, weight)))
            .collect()
    };
    rings.iter().enumerate().map(row).collect()
}

/// The positions with `free` ones solved for.
pub fn stationary(positions: &[[f64; 3]], triangles: &[[u32; 3]], free: &[bool]) -> Vec<[f64; 3]> {
    let rows = umbrellas(positions.len(), triangles);
    let unknowns: Vec<usize> = (0..free.len()).filter(|&v| free[v]).collect();
    let mut number = vec![usize::MAX; free.len()];
    unknowns.iter().enumerate().for_each(|(k, &v)| number[v] = k);
    let mut entries = Vec::new();
    let mut right = Mat::<f64>::zeros(unknowns.len(), 3);
    for (k, &v) in unknowns.iter().enumerate() {
        let mut squared = BTreeMap::new();
        for &(i, a) in &rows[v] {
            rows[i]
                .iter()
                .for_each(|&(j, b)| *squared.entry(j).or_insert(0.0) += a * b);
        }
        for (j, value) in squared {
            if free[j] {
                entries.push(Triplet::new(k, number[j], value));
            } else {
                (0..3).for_each(|c| right[(k, c)] -= value * positions[j][c]);
            }
        }
    }
    let size = unknowns.len();
    let matrix =
        SparseColMat::<usize, f64>::try_new_from_triplets(size, size, &entries).expect("indices within");
    let solved = matrix.sp_lu().expect("enough fixed vertices").solve(&right);
    let mut all = positions.to_vec();
    for (k, &v) in unknowns.iter().enumerate() {
        all[v] = [0, 1, 2].map(|c| solved[(k, c)]);
    }
    all
}
