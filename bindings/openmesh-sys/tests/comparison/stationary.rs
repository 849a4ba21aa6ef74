//! Where OpenMesh's C1 smoother ends, solved directly: the umbrella of umbrellas vanishes at every free vertex.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::DMatrix;

/// The rows of `N^2` for the symmetric `N = I - D^(-1/2) A D^(-1/2)`, which is similar to the umbrella `I - D^(-1) A`.
fn squares(rings: &[BTreeSet<usize>]) -> Vec<BTreeMap<usize, f64>> {
    let root = |i: usize| (rings[i].len() as f64).sqrt();
    let row = |i: usize| {
        let weight = move |&j: &usize| (j, -1.0 / (root(i) * root(j)));
        std::iter::once((i, 1.0)).chain(rings[i].iter().map(weight))
    };
    let square = |i: usize| {
        let mut squared = BTreeMap::new();
        for (k, a) in row(i) {
            row(k).for_each(|(j, b)| *squared.entry(j).or_insert(0.0) += a * b);
        }
        squared
    };
    (0..rings.len()).map(square).collect()
}

/// The positions with `free` ones solved for: `N^2 y = 0` in the free rows, where `y = D^(1/2) x`.
pub fn stationary(positions: &[[f64; 3]], triangles: &[[u32; 3]], free: &[bool]) -> Vec<[f64; 3]> {
    let mut rings = vec![BTreeSet::new(); positions.len()];
    for t in triangles {
        let [a, b, c] = t.map(|v| v as usize);
        for (v, others) in [(a, [b, c]), (b, [c, a]), (c, [a, b])] {
            rings[v].extend(others);
        }
    }
    let squares = squares(&rings);
    let root = |v: usize| (rings[v].len() as f64).sqrt();
    let unknowns: Vec<usize> = (0..free.len()).filter(|&v| free[v]).collect();
    let entry = |i: usize, j: usize| squares[unknowns[i]].get(&unknowns[j]).copied().unwrap_or(0.0);
    let matrix = DMatrix::from_fn(unknowns.len(), unknowns.len(), entry);
    let right = DMatrix::from_fn(unknowns.len(), 3, |i, c| {
        let known = squares[unknowns[i]].iter().filter(|(j, _)| !free[**j]);
        -known
            .map(|(&j, value)| value * root(j) * positions[j][c])
            .sum::<f64>()
    });
    let y = matrix.cholesky().expect("enough fixed vertices").solve(&right);
    let mut all = positions.to_vec();
    for (i, &v) in unknowns.iter().enumerate() {
        all[v] = [0, 1, 2].map(|c| y[(i, c)] / root(v));
    }
    all
}
