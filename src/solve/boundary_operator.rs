//! What the simply supported plate lacks to the clamped one, on the fixed vertices `b` alone:
//! `C = D_b^-1 + S_bf S_ff^-1 D_f^-1 S_ff^-1 S_fb`, and a preconditioner for it.
//!
//! `u . C u` is four times the integral of `v^2` over the surface, `v` harmonic with the values `u` on the boundary. Short
//! waves along the boundary fall off within a few rows of vertices: for them `C` is that of a [`Strip`] beside it. Long
//! waves make a coarse space, on which `C` is taken as it is.

use std::f64::consts::PI;
use std::sync::Arc;

use super::bilaplacian::Metric;
use super::boundary_chains::Chain;
use super::boundary_strip::Strip;
use fairmesh_linear::cholesky::{Cholesky, NotPositiveDefinite, SolveWork};
use fairmesh_linear::sparse::SymmetricPattern;
use fairmesh_linear::symbolic::Symbolic;

/// Waves of a chain in the coarse space, where there are not too many chains.
const WAVES: [usize; 4] = [15, 7, 3, 1];
/// Vertices at each end of an open chain that are in the coarse space by themselves: there the harmonic function is singular.
const AT_ENDS: usize = 2;
/// The coarse space is of at most this dimension.
const LARGEST_SPACE: usize = 256;

/// How many waves each chain gets, or `None` where there are too many chains.
pub(crate) fn waves(chains: &[Chain]) -> Option<usize> {
    let dimension = |waves: usize| -> usize {
        let of = |chain: &Chain| chain.vertices.len().min(waves + singles(chain));
        chains.iter().map(of).sum()
    };
    WAVES.into_iter().find(|&waves| dimension(waves) <= LARGEST_SPACE)
}

/// How many vertices of a long chain are basis vectors by themselves.
fn singles(chain: &Chain) -> usize {
    if chain.is_closed { 0 } else { 2 * AT_ENDS }
}

/// The preconditioner `B` of `C`.
#[derive(Debug, Default)]
pub(crate) struct BoundaryOperator {
    /// `D_b`.
    d: Vec<f64>,
    space: CoarseSpace,
}

impl BoundaryOperator {
    /// The coarse space of the operator of a metric, to be completed.
    pub(crate) fn new(chains: &[Chain], metric: &Metric, waves: usize) -> Self {
        let mut space = CoarseSpace::default();
        chains.iter().for_each(|chain| space.add(chain, waves));
        Self {
            d: metric.boundary_d().to_vec(),
            space,
        }
    }

    /// The basis vectors of the coarse space, each with one value per fixed vertex.
    pub(crate) fn basis(&self) -> impl Iterator<Item = Vec<f64>> {
        let vectors = self.space.vectors.iter();
        vectors.map(|(vertices, values)| {
            let mut full = vec![0.0; self.d.len()];
            for (&b, v) in vertices.iter().zip(values) {
                full[b as usize] = *v;
            }
            full
        })
    }

    /// Completes it by the images `S_bf S_ff^-1 D_f^-1 S_ff^-1 S_fb v` of the basis vectors.
    pub(crate) fn complete(&mut self, mut images: Vec<Vec<f64>>) -> Result<(), NotPositiveDefinite> {
        for (image, (vertices, values)) in images.iter_mut().zip(&self.space.vectors) {
            for (&b, v) in vertices.iter().zip(values) {
                image[b as usize] += v / self.d[b as usize];
            }
        }
        self.space.complete(images)
    }

    /// `B r`: `(I - V E (C V)^T) T (I - C V E V^T) r + V E V^T r` with the basis `V`, `E = (V^T C V)^-1`, and `T` the inverse of
    /// the `strip`'s operator.
    pub(crate) fn apply(&self, r: &[f64], strip: &mut Strip) -> Vec<f64> {
        let coarse = self.space.solve(self.space.project(r));
        let mut rest = r.to_vec();
        self.space.subtract_images(&coarse, &mut rest);
        let mut fine = strip.solve(&self.d, &rest);
        let back = self.space.solve(self.space.project_images(&fine));
        let coefficients: Vec<f64> = coarse.iter().zip(&back).map(|(a, b)| a - b).collect();
        self.space.add_vectors(&coefficients, &mut fine);
        fine
    }
}

/// Long waves, and what no wave describes.
#[derive(Debug, Default)]
struct CoarseSpace {
    /// The basis `V` by the vertices and their values.
    vectors: Vec<(Vec<u32>, Vec<f64>)>,
    /// `C V`, each vector with one value per fixed vertex.
    images: Vec<Vec<f64>>,
    /// The factor of `V^T C V`.
    energy: Option<Cholesky<f64>>,
}

impl CoarseSpace {
    fn add(&mut self, chain: &Chain, waves: usize) {
        let vertices = &chain.vertices;
        let n = vertices.len();
        let mut single = |b: u32| self.vectors.push((vec![b], vec![1.0]));
        if n <= waves + singles(chain) {
            vertices.iter().for_each(|&b| single(b));
            return;
        }
        if !chain.is_closed {
            vertices[..AT_ENDS].iter().for_each(|&b| single(b));
            vertices[n - AT_ENDS..].iter().for_each(|&b| single(b));
        }
        for wave in 0..waves {
            let value = |k: usize| match (chain.is_closed, wave % 2) {
                (false, _) => (PI * (wave * k) as f64 / (n - 1) as f64).cos(),
                (true, 0) => (PI * (wave * k) as f64 / n as f64).cos(),
                (true, _) => (PI * ((wave + 1) * k) as f64 / n as f64).sin(),
            };
            self.vectors.push((vertices.clone(), (0..n).map(value).collect()));
        }
    }

    fn complete(&mut self, images: Vec<Vec<f64>>) -> Result<(), NotPositiveDefinite> {
        self.images = images;
        let n = self.vectors.len();
        let pattern = SymmetricPattern {
            start: (0..=n).map(|i| i * (i + 1) / 2).collect(),
            column: (0..n as u32).flat_map(|i| 0..=i).collect(),
        };
        let rows = self.images.iter().enumerate();
        let values: Vec<f64> = rows
            .flat_map(|(i, image)| self.vectors[..=i].iter().map(|v| dot(v, image)))
            .collect();
        let order: Vec<u32> = (0..n as u32).collect();
        let mut energy = Cholesky::new(Arc::new(Symbolic::new(&pattern, &order)));
        energy.factor(&values)?;
        self.energy = Some(energy);
        Ok(())
    }

    fn project(&self, r: &[f64]) -> Vec<f64> {
        self.vectors.iter().map(|v| dot(v, r)).collect()
    }

    fn project_images(&self, r: &[f64]) -> Vec<f64> {
        let product = |image: &Vec<f64>| image.iter().zip(r).map(|(a, b)| a * b).sum();
        self.images.iter().map(product).collect()
    }

    fn solve(&self, right: Vec<f64>) -> Vec<f64> {
        let mut x: Vec<[f64; 1]> = right.into_iter().map(|r| [r]).collect();
        if let Some(energy) = &self.energy {
            energy.solve(&mut x, &mut SolveWork::default());
        }
        x.into_iter().map(|[x]| x).collect()
    }

    fn subtract_images(&self, coefficients: &[f64], r: &mut [f64]) {
        for (a, image) in coefficients.iter().zip(&self.images) {
            r.iter_mut().zip(image).for_each(|(r, i)| *r -= a * i);
        }
    }

    fn add_vectors(&self, coefficients: &[f64], r: &mut [f64]) {
        for (a, (vertices, values)) in coefficients.iter().zip(&self.vectors) {
            for (&b, v) in vertices.iter().zip(values) {
                r[b as usize] += a * v;
            }
        }
    }
}

fn dot((vertices, values): &(Vec<u32>, Vec<f64>), r: &[f64]) -> f64 {
    vertices.iter().zip(values).map(|(&b, v)| v * r[b as usize]).sum()
}
