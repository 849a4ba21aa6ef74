//! A few rows of free vertices beside the boundary, and the boundary operator of the surface as far as they reach.
//!
//! `C_s = D_b^-1 + S_bs S_ss^-1 D_s^-1 S_ss^-1 S_sb` has the inverse `D_b - D_b S_bs P_s^-1 S_sb D_b` with the clamped plate
//! `P_s = S_ss D_s S_ss + S_sb D_b S_bs` of the strip, which is factored. At its inner edge the strip goes on as a wave of
//! middle length would: with the factor `f` from row to row.

use std::sync::Arc;

use super::bilaplacian::Metric;
use super::boundary_chains::Chain;
use crate::mesh::{NONE, Rings};
use fairmesh_linear::cholesky::{Cholesky, NotPositiveDefinite, SolveWork};
use fairmesh_linear::ordering::amd;
use fairmesh_linear::sparse::SymmetricPattern;
use fairmesh_linear::symbolic::Symbolic;

/// Rows of the strip.
const ROWS: usize = 5;

/// The strip of a region, with the factor of `P_s` of one metric.
#[derive(Debug)]
pub(crate) struct Strip {
    /// The free vertices, ascending.
    vertices: Vec<u32>,
    /// Per vertex how a wave falls off inwards from there.
    falloff: Vec<f64>,
    /// Per vertex its neighbours in the strip by their places, or [`NONE`] for those beyond, in the order of its ring;
    /// fixed ones left out.
    ring: Vec<Vec<u32>>,
    /// The free neighbours of each fixed vertex, by their places.
    beside: Vec<Vec<u32>>,
    pattern: SymmetricPattern,
    factor: Cholesky<f64>,
    work: SolveWork<f64>,
    /// The entries of `S_bs`, parallel to `beside`.
    coupling: Vec<Vec<f64>>,
}

impl Strip {
    /// The strip of a region whose coarse space has so many `waves` of each chain, unless it has more vertices than `most`.
    pub(crate) fn new(rings: &Rings, chains: &[Chain], waves: usize, most: usize) -> Option<Self> {
        let (vertices, falloff, place) = rows(rings, chains, waves);
        if vertices.len() > most {
            return None;
        }
        let free = rings.free();
        let places = |ring: &[u32]| -> Vec<u32> {
            let ring = ring.iter().filter(|&&j| (j as usize) < free);
            ring.map(|&j| place[j as usize]).collect()
        };
        let ring: Vec<Vec<u32>> = vertices.iter().map(|&v| places(rings.ring(v as usize))).collect();
        let beside: Vec<Vec<u32>> = (0..rings.boundary())
            .map(|b| places(rings.boundary_ring(b)))
            .collect();
        let mut pairs = Vec::new();
        let mut connect = |a: u32, others: &[u32]| {
            let others = others.iter().filter(|&&b| b != NONE);
            pairs.extend(others.map(|&b| [a, b]));
        };
        for (s, ring) in (0..).zip(&ring) {
            connect(s, ring);
            ring.iter()
                .filter(|&&a| a != NONE)
                .for_each(|&a| connect(a, ring));
        }
        for row in &beside {
            row.iter().for_each(|&a| connect(a, row));
        }
        let pattern = SymmetricPattern::from_edges(vertices.len(), &pairs);
        let symbolic = Symbolic::new(&pattern, &amd(&pattern));
        Some(Self {
            vertices,
            falloff,
            ring,
            beside,
            pattern,
            factor: Cholesky::new(Arc::new(symbolic)),
            work: SolveWork::default(),
            coupling: Vec::new(),
        })
    }

    /// Takes the matrices of a metric.
    pub(crate) fn factor(&mut self, metric: &Metric, rings: &Rings) -> Result<(), NotPositiveDefinite> {
        let mut values = vec![0.0; self.pattern.column.len()];
        let mut column = Vec::new();
        for (s, &v) in self.vertices.iter().enumerate() {
            let mut d = metric.free_d()[v as usize];
            let mut diagonal = metric.total(v as usize);
            column.clear();
            let row = metric.free_row(rings, v as usize);
            let row = row.filter(|(j, _)| *j < rings.free());
            for (&t, (_, w)) in self.ring[s].iter().zip(row) {
                if t == NONE {
                    diagonal -= self.falloff[s] * w;
                } else {
                    column.push((t, -w));
                }
            }
            if column.len() < self.ring[s].len() {
                d *= 1.0 - self.falloff[s] * self.falloff[s];
            }
            column.push((s as u32, diagonal));
            add_square(&self.pattern, d, &column, &mut values);
        }
        self.coupling.clear();
        for (b, row) in self.beside.iter().enumerate() {
            let weights: Vec<f64> = metric.boundary_row(rings, b).map(|(_, w)| -w).collect();
            column.clear();
            column.extend(row.iter().copied().zip(weights.iter().copied()));
            add_square(&self.pattern, metric.boundary_d()[b], &column, &mut values);
            self.coupling.push(weights);
        }
        self.factor.factor(&values)
    }

    /// `C_s^-1 r`.
    pub(crate) fn solve(&mut self, d: &[f64], r: &[f64]) -> Vec<f64> {
        let mut x: Vec<f64> = r.iter().zip(d).map(|(r, d)| r * d).collect();
        let mut y = vec![[0.0]; self.vertices.len()];
        let rows = || self.beside.iter().zip(&self.coupling);
        for ((row, weights), x) in rows().zip(&x) {
            for (&s, w) in row.iter().zip(weights) {
                y[s as usize][0] += w * x;
            }
        }
        self.factor.solve(&mut y, &mut self.work);
        for (((row, weights), x), d) in rows().zip(&mut x).zip(d) {
            let sum: f64 = row.iter().zip(weights).map(|(&s, w)| w * y[s as usize][0]).sum();
            *x -= d * sum;
        }
        x
    }
}

/// The free vertices within [`ROWS`] of the boundary, how waves fall off inwards from each, and the place of each free
/// vertex among them.
fn rows(rings: &Rings, chains: &[Chain], waves: usize) -> (Vec<u32>, Vec<f64>, Vec<u32>) {
    let free = rings.free();
    let mut owner = vec![NONE; free];
    let mut found: Vec<u32> = Vec::new();
    for (c, chain) in (0..).zip(chains) {
        for j in chain
            .vertices
            .iter()
            .flat_map(|&b| rings.boundary_ring(b as usize))
        {
            if (*j as usize) < free && owner[*j as usize] == NONE {
                owner[*j as usize] = c;
                found.push(*j);
            }
        }
    }
    let mut begin = 0;
    for _ in 1..ROWS {
        let end = found.len();
        for k in begin..end {
            let v = found[k] as usize;
            for &j in rings.ring(v).iter().filter(|&&j| (j as usize) < free) {
                if owner[j as usize] == NONE {
                    owner[j as usize] = owner[v];
                    found.push(j);
                }
            }
        }
        begin = end;
    }
    found.sort_unstable();
    let falloffs: Vec<f64> = chains.iter().map(|chain| falloff(chain, waves)).collect();
    let of = |&v: &u32| falloffs[owner[v as usize] as usize];
    let falloff = found.iter().map(of).collect();
    let mut place = vec![NONE; free];
    (0..).zip(&found).for_each(|(s, &v)| place[v as usize] = s);
    (found, falloff, place)
}

/// `exp(-k h)` from row to row, `k` between the longest waves that are not in the coarse space and those that fall off
/// within the strip.
fn falloff(chain: &Chain, waves: usize) -> f64 {
    let longest = std::f64::consts::PI * (waves + 1) as f64 / chain.vertices.len() as f64;
    let shortest = 1.0 / ROWS as f64;
    (-(longest.min(shortest) * shortest).sqrt()).exp()
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
