//! Where OpenMesh's C1 smoother ends, solved directly: the umbrella of umbrellas vanishes at every free vertex.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use fairmesh_linear::cholesky::{Cholesky, SolveWork};
use fairmesh_linear::ordering::amd;
use fairmesh_linear::sparse::SymmetricPattern;
use fairmesh_linear::symbolic::Symbolic;

/// The neighbours of every vertex.
fn rings(count: usize, triangles: &[[u32; 3]]) -> Vec<BTreeSet<usize>> {
    let mut rings = vec![BTreeSet::new(); count];
    for t in triangles {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            rings[t[a] as usize].insert(t[b] as usize);
            rings[t[b] as usize].insert(t[a] as usize);
        }
    }
    rings
}

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
    let rings = rings(positions.len(), triangles);
    let squares = squares(&rings);
    let root = |v: usize| (rings[v].len() as f64).sqrt();
    let unknowns: Vec<usize> = (0..free.len()).filter(|&v| free[v]).collect();
    let mut number = vec![u32::MAX; free.len()];
    (0..).zip(&unknowns).for_each(|(k, &v)| number[v] = k);

    let mut edges = Vec::new();
    let mut right = vec![[0.0; 3]; unknowns.len()];
    for (k, &v) in unknowns.iter().enumerate() {
        for (&j, value) in &squares[v] {
            if !free[j] {
                (0..3).for_each(|c| right[k][c] -= value * root(j) * positions[j][c]);
            } else if j < v {
                edges.push([k as u32, number[j]]);
            }
        }
    }
    let pattern = SymmetricPattern::from_edges(unknowns.len(), &edges);
    let entries = (0..unknowns.len()).flat_map(|k| pattern.row(k).iter().map(move |&j| (k, j as usize)));
    let values: Vec<f64> = entries.map(|(k, j)| squares[unknowns[k]][&unknowns[j]]).collect();
    let mut cholesky = Cholesky::<f64>::new(Arc::new(Symbolic::new(&pattern, &amd(&pattern))));
    cholesky.factor(&values).expect("enough fixed vertices");
    cholesky.solve(&mut right, &mut SolveWork::default());

    let mut all = positions.to_vec();
    for (&v, y) in unknowns.iter().zip(right) {
        all[v] = y.map(|y| y / root(v));
    }
    all
}
