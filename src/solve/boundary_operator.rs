//! What the simply supported plate lacks to the clamped one, on the fixed vertices `b` alone:
//! `C = D_b^-1 + S_bf S_ff^-1 D_f^-1 S_ff^-1 S_fb`, and a preconditioner for it.
//!
//! `u . C u` is four times the integral of `v^2` over the surface, `v` harmonic with the values `u` on the boundary. A wave
//! `exp(i k s)` along a loop falls off inwards as `exp(-k t)`, from one row of vertices to the next, so that on each chain
//! `C ~ 4 l^1/2 g(L)^-1 l^1/2` with the lengths `l` and the one-dimensional Laplacian `L = l^-1/2 K l^-1/2`. `g` is
//! approximated by a rational function with few poles; what is global is left to a coarse space of long waves.

use nalgebra::{SMatrix, SVector};
use std::f64::consts::PI;
use std::sync::Arc;

use super::bilaplacian::Metric;
use super::boundary_chains::Chain;
use fairmesh_linear::cholesky::{Cholesky, NotPositiveDefinite, SolveWork};
use fairmesh_linear::sparse::SymmetricPattern;
use fairmesh_linear::symbolic::Symbolic;

/// Waves of a chain in the coarse space, where there are not too many chains.
const WAVES: [usize; 4] = [15, 7, 3, 1];
/// Vertices at each end of an open chain that are in the coarse space by themselves: there the harmonic function is singular.
const AT_ENDS: usize = 2;
/// The coarse space is of at most this dimension.
const LARGEST_SPACE: usize = 256;
/// Poles of the rational function.
const POLES: usize = 4;
/// Where it is fitted.
const SAMPLES: usize = 48;

/// How many waves each chain gets, or `None` where there are too many chains.
pub(crate) fn waves(chains: &[Chain]) -> Option<usize> {
    let dimension = |waves: usize| -> usize {
        let of = |chain: &Chain| chain.vertices.len().min(waves + if chain.is_closed { 0 } else { 2 * AT_ENDS });
        chains.iter().map(of).sum()
    };
    WAVES.into_iter().find(|&waves| dimension(waves) <= LARGEST_SPACE)
}

/// The preconditioner `B` of `C`, by the chains of the boundary.
#[derive(Debug)]
pub(crate) struct BoundaryOperator {
    /// `D_b`.
    d: Vec<f64>,
    chains: Vec<ChainOperator>,
    space: CoarseSpace,
}

impl BoundaryOperator {
    /// The operator of a metric, without its coarse space.
    pub(crate) fn new(chains: &[Chain], metric: &Metric, waves: usize) -> Self {
        let d = metric.boundary_d().to_vec();
        let mut space = CoarseSpace::default();
        let operators = chains.iter().map(|chain| {
            let shape = ChainShape::new(chain, metric);
            space.add(chain, &shape, waves);
            ChainOperator::new(chain, &shape, &d, waves)
        });
        Self {
            chains: operators.collect(),
            d,
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

    /// `B r`: `(I - V E (C V)^T) T (I - C V E V^T) r + V E V^T r` with the basis `V`, `E = (V^T C V)^-1`, and `T` the chains'
    /// rational functions.
    pub(crate) fn apply(&self, r: &[f64]) -> Vec<f64> {
        let coarse = self.space.solve(self.space.project(r));
        let mut rest = r.to_vec();
        self.space.subtract_images(&coarse, &mut rest);
        let mut fine = vec![0.0; r.len()];
        for chain in &self.chains {
            chain.apply(&rest, &mut fine);
        }
        let back = self.space.solve(self.space.project_images(&fine));
        let coefficients: Vec<f64> = coarse.iter().zip(&back).map(|(a, b)| a - b).collect();
        self.space.add_vectors(&coefficients, &mut fine);
        fine
    }
}

/// The lengths of a chain on a surface.
struct ChainShape {
    /// From each vertex to the next, around a closed chain.
    edge: Vec<f64>,
    /// Half the edges at each vertex.
    length: Vec<f64>,
    total: f64,
    /// The mean geodesic curvature.
    curvature: f64,
}

impl ChainShape {
    fn new(chain: &Chain, metric: &Metric) -> Self {
        let n = chain.vertices.len();
        let mut edge: Vec<f64> = (0..if chain.is_closed { n } else { n - 1 })
            .map(|k| metric.boundary_edge(chain.vertices[k], chain.vertices[(k + 1) % n]))
            .collect();
        let total: f64 = edge.iter().sum();
        // Vertices at one place.
        let least = 1e-3 * total / n as f64;
        edge.iter_mut().for_each(|e| *e = e.max(least).max(f64::MIN_POSITIVE));
        let mut length = vec![0.0; n];
        for (k, e) in edge.iter().enumerate() {
            length[k] += 0.5 * e;
            length[(k + 1) % n] += 0.5 * e;
        }
        let turning: f64 = chain.vertices.iter().map(|&b| metric.turning(b)).sum();
        let is_loop = chain.is_closed && !chain.is_two_sided;
        Self {
            curvature: if is_loop { turning / total } else { 0.0 },
            edge,
            length,
            total,
        }
    }
}

/// `T` on one chain.
#[derive(Debug)]
struct ChainOperator {
    vertices: Vec<u32>,
    /// `c_0 / (4 l)`; `D_b` on a chain that is wholly in the coarse space.
    diagonal: Vec<f64>,
    /// `(K + s_j l)^-1` with its factor `c_j s_j / 4`.
    poles: Vec<(f64, Tridiagonal)>,
}

impl ChainOperator {
    fn new(chain: &Chain, shape: &ChainShape, d: &[f64], waves: usize) -> Self {
        let vertices = chain.vertices.clone();
        if is_small(chain, waves) {
            return Self {
                diagonal: vertices.iter().map(|&b| d[b as usize]).collect(),
                vertices,
                poles: Vec::new(),
            };
        }
        let symbol = Symbol::new(chain, shape, d);
        let [constant, factors @ ..] = symbol.fit();
        let poles = symbol.poles().into_iter().zip(factors);
        Self {
            vertices,
            diagonal: shape.length.iter().map(|l| constant / (4.0 * l)).collect(),
            poles: poles
                .map(|(s, c)| (0.25 * c * s, Tridiagonal::new(&shape.edge, &shape.length, s)))
                .collect(),
        }
    }

    /// `T r` at the chain's vertices.
    fn apply(&self, r: &[f64], result: &mut [f64]) {
        let own: Vec<f64> = self.vertices.iter().map(|&b| r[b as usize]).collect();
        let mut sum: Vec<f64> = own.iter().zip(&self.diagonal).map(|(r, d)| r * d).collect();
        for (factor, matrix) in &self.poles {
            let mut u = own.clone();
            matrix.solve(&mut u);
            sum.iter_mut().zip(&u).for_each(|(s, u)| *s -= factor * u);
        }
        for (&b, s) in self.vertices.iter().zip(&sum) {
            result[b as usize] = *s;
        }
    }
}

/// Whether each vertex of the chain is a basis vector.
fn is_small(chain: &Chain, waves: usize) -> bool {
    let ends = if chain.is_closed { 0 } else { 2 * AT_ENDS };
    chain.vertices.len() <= waves + ends
}

/// `g(L)` of one chain.
struct Symbol {
    /// The mean of `1 / (4 D_b)` per length.
    own: f64,
    /// The mean length at a vertex: the distance of rows.
    step: f64,
    sides: f64,
    curvature: f64,
    /// The least wave number,
    least: f64,
    /// and that of one wave around.
    first: f64,
}

impl Symbol {
    fn new(chain: &Chain, shape: &ChainShape, d: &[f64]) -> Self {
        let own: f64 = chain.vertices.iter().map(|&b| 0.25 / d[b as usize]).sum();
        Self {
            own: own / shape.total,
            step: shape.total / chain.vertices.len() as f64,
            sides: if chain.is_two_sided { 2.0 } else { 1.0 },
            curvature: shape.curvature,
            least: PI / shape.total,
            first: 2.0 * PI / shape.total,
        }
    }

    fn at(&self, square: f64) -> f64 {
        let k = (square.sqrt() + self.curvature).max(self.least);
        1.0 / (self.own + self.sides * self.step / ((2.0 * self.step * k).exp() - 1.0))
    }

    /// Squares of wave numbers between these, in geometric progression.
    fn between(low: f64, high: f64, k: usize, count: usize) -> f64 {
        low * (high / low).powf(k as f64 / (count - 1) as f64)
    }

    fn highest(&self) -> f64 {
        4.0 / (self.step * self.step)
    }

    fn poles(&self) -> [f64; POLES] {
        let low = 0.5 * self.first * self.first;
        std::array::from_fn(|j| Self::between(low, self.highest(), j, POLES))
    }

    /// `g(x) ~ c_0 - sum_j c_j s_j / (x + s_j)` by least squares of the relative error.
    fn fit(&self) -> [f64; POLES + 1] {
        let poles = self.poles();
        let basis = |x: f64| {
            SVector::<f64, { POLES + 1 }>::from_fn(|j, _| match j {
                0 => 1.0,
                _ => -poles[j - 1] / (x + poles[j - 1]),
            })
        };
        let low = 0.25 * self.first * self.first;
        let samples = || (0..SAMPLES).map(|k| Self::between(low, self.highest(), k, SAMPLES));
        let mut normal = SMatrix::<f64, { POLES + 1 }, { POLES + 1 }>::zeros();
        let mut right = SVector::<f64, { POLES + 1 }>::zeros();
        for x in samples() {
            let row = basis(x) / self.at(x);
            normal += row * row.transpose();
            right += row;
        }
        let ridge = 1e-12 * normal.trace();
        normal += SMatrix::identity() * ridge;
        let fitted = normal.cholesky().map(|c| c.solve(&right));
        let is_positive = |c: &SVector<f64, { POLES + 1 }>| {
            samples().chain([0.0]).all(|x| basis(x).dot(c) > 0.05 * self.at(x))
        };
        match fitted.filter(is_positive) {
            Some(c) => c.into(),
            // Its largest value everywhere: too stiff for long waves, which the coarse space has.
            None => std::array::from_fn(|j| if j == 0 { self.at(self.highest()) } else { 0.0 }),
        }
    }
}

/// The factor of `K + s l`, `K` the stiffness `1 / e` of a chain, closed or open.
#[derive(Debug)]
struct Tridiagonal {
    /// Below the unit diagonal of `L` in `L D L^T`, and the reciprocals of `D`.
    below: Vec<f64>,
    inverse: Vec<f64>,
    /// Of a closed chain: the solution for the couplings of the last vertex, and the reciprocal of its pivot.
    last: Option<(Vec<f64>, f64)>,
}

impl Tridiagonal {
    fn new(edge: &[f64], length: &[f64], s: f64) -> Self {
        let n = length.len();
        let is_closed = edge.len() == n;
        let stiffness: Vec<f64> = edge.iter().map(|e| 1.0 / e).collect();
        let mut diagonal: Vec<f64> = length.iter().map(|l| s * l).collect();
        for (k, w) in stiffness.iter().enumerate() {
            diagonal[k] += w;
            diagonal[(k + 1) % n] += w;
        }
        let open = if is_closed { n - 1 } else { n };
        let mut this = Self {
            below: Vec::with_capacity(open),
            inverse: Vec::with_capacity(open),
            last: None,
        };
        let mut pivot = diagonal[0];
        this.inverse.push(1.0 / pivot);
        for k in 1..open {
            let ratio = -stiffness[k - 1] / pivot;
            this.below.push(ratio);
            pivot = diagonal[k] + ratio * stiffness[k - 1];
            this.inverse.push(1.0 / pivot);
        }
        if is_closed {
            let mut coupling = vec![0.0; open];
            coupling[0] -= stiffness[n - 1];
            coupling[open - 1] -= stiffness[n - 2];
            let mut column = coupling.clone();
            this.solve_open(&mut column);
            let taken: f64 = coupling.iter().zip(&column).map(|(a, b)| a * b).sum();
            this.last = Some((column, 1.0 / (diagonal[n - 1] - taken)));
        }
        this
    }

    fn solve_open(&self, x: &mut [f64]) {
        for k in 1..x.len() {
            x[k] -= self.below[k - 1] * x[k - 1];
        }
        x.iter_mut().zip(&self.inverse).for_each(|(x, d)| *x *= d);
        for k in (1..x.len()).rev() {
            x[k - 1] -= self.below[k - 1] * x[k];
        }
    }

    fn solve(&self, x: &mut [f64]) {
        let Some((column, inverse)) = &self.last else {
            self.solve_open(x);
            return;
        };
        let Some((last, open)) = x.split_last_mut() else {
            return;
        };
        // The column is also that of the couplings' transpose: the matrix is symmetric.
        let taken: f64 = open.iter().zip(column).map(|(x, c)| x * c).sum();
        self.solve_open(open);
        *last = (*last - taken) * inverse;
        open.iter_mut().zip(column).for_each(|(x, c)| *x -= c * *last);
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
    fn add(&mut self, chain: &Chain, shape: &ChainShape, waves: usize) {
        let vertices = &chain.vertices;
        let mut single = |b: u32| self.vectors.push((vec![b], vec![1.0]));
        if is_small(chain, waves) {
            vertices.iter().for_each(|&b| single(b));
            return;
        }
        if !chain.is_closed {
            vertices[..AT_ENDS].iter().for_each(|&b| single(b));
            vertices[vertices.len() - AT_ENDS..].iter().for_each(|&b| single(b));
        }
        let mut position = 0.0;
        let along: Vec<f64> = (0..vertices.len())
            .map(|k| {
                let at = position / shape.total;
                position += shape.edge.get(k).copied().unwrap_or(0.0);
                at
            })
            .collect();
        for wave in 0..waves {
            let value = |s: &f64| match (chain.is_closed, wave % 2) {
                (false, _) => (PI * wave as f64 * s).cos(),
                (true, 0) => (PI * wave as f64 * s).cos(),
                (true, _) => (PI * (wave + 1) as f64 * s).sin(),
            };
            self.vectors.push((vertices.clone(), along.iter().map(value).collect()));
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
