//! The boundary operator of the clamped plate on a graded mesh.
//!
//! `C_g = D_b^-1 + S_bg S_gg^-1 D_g^-1 S_gg^-1 S_gb` has the inverse `D_b - D_b S_bg P_g^-1 S_gb D_b` with the clamped plate
//! `P_g = S_gg D_g S_gg + S_gb D_b S_bg`, which is factored. `u . C u` is four times the integral of `v^2`, `v` harmonic with the values `u` on the
//! boundary: a wave along it falls off within its own length, so that triangles may grow with their distance from there.

use std::sync::Arc;

use nalgebra::Vector3;

use super::bilaplacian::Metric;
use crate::mesh::Rings;
use crate::mesh::graded::GradedMesh;
use fairmesh_linear::cholesky::{Cholesky, NotPositiveDefinite, SolveWork};
use fairmesh_linear::ordering::fill_reducing;
use fairmesh_linear::sparse::SymmetricPattern;
use fairmesh_linear::symbolic::Symbolic;

/// A graded mesh with the factor of `P_g` of one metric.
#[derive(Debug)]
pub(crate) struct GradedPlate {
    mesh: GradedMesh,
    pattern: SymmetricPattern,
    factor: Cholesky<f64>,
    work: SolveWork<f64>,
    right: Vec<[f64; 1]>,
    /// The entries of `S_bg`, parallel to `mesh.beside`.
    coupling: Vec<Vec<f64>>,
    /// `D_b`.
    d: Vec<f64>,
}

impl GradedPlate {
    /// Orders and analyses `P_g`.
    pub(crate) fn new(mesh: GradedMesh) -> Self {
        let (mut edges, mut pairs) = (Vec::new(), Vec::new());
        let mut connect = |ring: &[u32]| {
            for (k, &a) in ring.iter().enumerate() {
                pairs.extend(ring[..k].iter().map(|&b| [a, b]));
            }
        };
        let mut ring = Vec::new();
        for s in 0..mesh.free() {
            ring.clear();
            ring.push(s as u32);
            ring.extend(mesh.free_ring(s));
            edges.extend(ring[1..].iter().map(|&j| [s as u32, j]));
            connect(&ring);
        }
        mesh.beside.iter().for_each(|row| connect(row));
        let pattern = SymmetricPattern::from_edges(mesh.free(), &pairs);
        let graph = SymmetricPattern::from_edges(mesh.free(), &edges);
        let order = fill_reducing(&pattern, &graph, 2, None);
        Self {
            factor: Cholesky::new(Arc::new(Symbolic::new(&pattern, &order))),
            pattern,
            work: SolveWork::default(),
            right: Vec::new(),
            coupling: Vec::new(),
            d: Vec::new(),
            mesh,
        }
    }

    /// Takes the matrices of a metric: that of the surface `x`, or of connectivity.
    pub(crate) fn factor(
        &mut self,
        metric: &Metric,
        rings: &Rings,
        x: Option<&[Vector3<f64>]>,
    ) -> Result<(), NotPositiveDefinite> {
        let mesh = &self.mesh;
        let weight = self.weights(metric, rings, x);
        let inverse_d = mesh.gather(metric.free_d().iter().map(|d| 1.0 / d).collect());
        let mut values = vec![0.0; self.pattern.column.len()];
        let mut column = Vec::new();
        for (s, inverse_d) in inverse_d.iter().enumerate() {
            let weights = &weight[mesh.ring.range(s)];
            column.clear();
            let row = mesh.ring.row(s).iter().zip(weights);
            column.extend(
                row.filter(|(j, _)| (**j as usize) < mesh.free())
                    .map(|(&j, w)| (j, -w)),
            );
            column.push((s as u32, weights.iter().sum()));
            add_square(&self.pattern, 1.0 / inverse_d, &column, &mut values);
        }
        self.coupling.clear();
        self.d = metric.boundary_d().to_vec();
        for (b, row) in mesh.beside.iter().enumerate() {
            let weights: Vec<f64> = metric.boundary_row(rings, b).map(|(_, w)| -w).collect();
            column.clear();
            column.extend(row.iter().copied().zip(weights.iter().copied()));
            add_square(&self.pattern, self.d[b], &column, &mut values);
            self.coupling.push(weights);
        }
        self.factor.factor(&values)
    }

    /// Cotangent weights of the graded mesh, and where a ring is that of the region, the metric's.
    fn weights(&self, metric: &Metric, rings: &Rings, x: Option<&[Vector3<f64>]>) -> Vec<f64> {
        let mesh = &self.mesh;
        let mut weight = mesh.cotangent_weights(rings.free(), x);
        for (s, &v) in mesh
            .vertices
            .iter()
            .enumerate()
            .filter(|(s, _)| mesh.is_whole[*s])
        {
            let own = &mut weight[mesh.ring.range(s)];
            for (j, w) in metric.free_row(rings, v as usize) {
                let place = mesh.place(j as u32, rings.free());
                if let Ok(k) = mesh.ring.row(s).binary_search(&place) {
                    own[k] = w;
                }
            }
        }
        weight
    }

    /// `C_g^-1 r`.
    pub(crate) fn solve(&mut self, r: &[f64]) -> Vec<f64> {
        let mut x: Vec<f64> = r.iter().zip(&self.d).map(|(r, d)| r * d).collect();
        self.right.clear();
        self.right.resize(self.mesh.free(), [0.0]);
        let rows = || self.mesh.beside.iter().zip(&self.coupling);
        for ((row, weights), x) in rows().zip(&x) {
            for (&s, w) in row.iter().zip(weights) {
                self.right[s as usize][0] += w * x;
            }
        }
        self.factor.solve(&mut self.right, &mut self.work);
        for (((row, weights), x), d) in rows().zip(&mut x).zip(&self.d) {
            let entries = row.iter().zip(weights);
            *x -= d * entries.map(|(&s, w)| w * self.right[s as usize][0]).sum::<f64>();
        }
        x
    }
}

/// Adds `d c c^T` with a sparse column `c`.
fn add_square(pattern: &SymmetricPattern, d: f64, column: &[(u32, f64)], values: &mut [f64]) {
    for &(a, wa) in column {
        for &(b, wb) in column.iter().filter(|(b, _)| *b <= a) {
            if let Ok(c) = pattern.row(a as usize).binary_search(&b) {
                values[pattern.start[a as usize] + c] += d * wa * wb;
            }
        }
    }
}
