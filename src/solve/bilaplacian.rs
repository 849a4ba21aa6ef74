//! The frozen matrix of the normal step, `P = S_I D S_I^T`, and of the linear start.
//!
//! Moving by `t` along the normals changes `H` by about `-D S t`, so `P t = R1` with the free rows `S_I` of `S` and all its
//! columns: the clamped bilaplacian. `D_i` is the answer of the ring's fit (paper 7.2), within bounds
//! around `3 / (4 A_i)` of (5). The factor `D_b` at fixed boundary vertices says how much the one-sided `H_b` answers to the
//! surface beside it.

use nalgebra::Vector3;

use crate::discrete::equations::{Equations, State};
use crate::discrete::inner_fairness::FairnessWeights;
use crate::discrete::valence_batches::{CHUNK, ValenceBatches, split_lengths};
use crate::mesh::{NONE, RegionMesh, Rings};
use crate::support::profile::clock;
use fairmesh_linear::parallel;
use fairmesh_linear::sparse::SymmetricPattern;

/// `S` and `D` of one surface, vertex by vertex.
#[derive(Debug, Clone, Default)]
pub(crate) struct Metric {
    /// `w_ij` of the free vertices' rings, parallel to `rings.neighbour`.
    weight: Vec<f64>,
    /// `sum_j w_ij` of the free vertices.
    total: Vec<f64>,
    /// One-sided `w_bj` of the boundary vertices, parallel to `rings.boundary_neighbour`.
    boundary_weight: Vec<f64>,
    /// `D` at free, then at boundary vertices.
    d: Vec<f64>,
}

/// `D_i` stays within these factors of `3 / (4 A_i)`.
/// Of 125 cases, half: 17 change by up to 0.6 edges, 2 get another triangulation, -3 % iterations, 1 fails;
/// double: 33 change by up to 0.5 edges, 3 get another triangulation, 1 fails.
const FREE_RANGE: [f64; 2] = [0.1, 5.0];
/// `D_b` stays within this factor of `3 / (4 A_b)`.
/// Of 125 cases, half: 93 change by up to 0.7 edges, 3 get another triangulation, +3 % iterations;
/// double: 78 change by up to 0.4 edges, 1 get another triangulation, -2 % iterations.
const BOUNDARY_RANGE: f64 = 4.0;

impl Metric {
    /// `S` and `D` at the surface `x`, which was evaluated with its response. `D_b` is taken from the finite-difference answer of
    /// `H_b` to a shift of all free vertices along their normals.
    pub(crate) fn update(&mut self, equations: &Equations<'_>, x: &[Vector3<f64>], state: &State) {
        let _clock = clock("assemble P");
        let (rings, batches) = (equations.rings, equations.batches);
        let free = equations.free();
        let boundary = rings.closed.len();
        self.weight.resize(rings.neighbour.values().len(), 0.0);
        self.total.resize(free, 0.0);
        self.boundary_weight.clear();
        self.boundary_weight
            .resize(rings.boundary_neighbour.values().len(), 0.0);
        self.d.resize(free + boundary, 0.0);
        let chunks = (0..free).step_by(CHUNK).map(|i| i..(i + CHUNK).min(free));
        let lengths = chunks.map(|c| c.map(|i| rings.ring(i).len()).sum());
        let pieces = split_lengths(&mut self.weight, lengths).into_iter();
        let per_vertex = self.total.chunks_mut(CHUNK).zip(self.d[..free].chunks_mut(CHUNK));
        parallel::for_each(pieces.zip(per_vertex), |chunk, (weight, (total, d))| {
            let first = chunk * CHUNK;
            let begin = rings.neighbour.range(first).start;
            for (k, (total, d)) in total.iter_mut().zip(d).enumerate() {
                let i = first + k;
                let (slot, lane) = batches.place(i);
                let ring = rings.neighbour.range(i);
                *total = 0.0;
                for (k, w) in weight[ring.start - begin..ring.end - begin]
                    .iter_mut()
                    .enumerate()
                {
                    *w = state.weight[slot + k][lane];
                    *total += *w;
                }
                let plain = 0.75 / state.area[i].max(f64::MIN_POSITIVE);
                *d = (state.response[i] / *total).clamp(plain * FREE_RANGE[0], plain * FREE_RANGE[1]);
            }
        });
        let shift = Shift::new(equations, x, state);
        for b in 0..boundary {
            let neighbours = rings.boundary_ring(b);
            let weights = &mut self.boundary_weight[rings.boundary_neighbour.range(b)];
            equations.boundary_weights(x, b, |j, w| {
                if let Some(k) = neighbours.iter().position(|&n| n == j) {
                    weights[k] += w;
                }
            });
            let plain = 0.75 / equations.boundary_area(x, b).max(f64::MIN_POSITIVE);
            let to_free = neighbours
                .iter()
                .zip(weights)
                .filter(|(j, _)| (**j as usize) < free);
            let sum: f64 = to_free.map(|(_, w)| *w).sum();
            self.d[free + b] = if sum > 0.0 {
                let answer = shift.answer(equations, state, b) / sum;
                answer.clamp(plain / BOUNDARY_RANGE, plain * BOUNDARY_RANGE)
            } else {
                plain
            };
        }
        self.bound(free);
    }

    /// `-D S t` at the free vertices: how `H` answers to the motion `t` of these along the normals.
    pub(crate) fn curvature_answer(&self, rings: &Rings, t: &[f64]) -> Vec<f64> {
        let at = |i: usize| {
            let ring = rings.ring(i).iter().zip(&self.weight[rings.neighbour.range(i)]);
            let beside: f64 = ring.map(|(&j, w)| t.get(j as usize).map_or(0.0, |t| w * t)).sum();
            self.d[i] * (beside - self.total[i] * t[i])
        };
        parallel::map_each(t.len(), CHUNK, at)
    }

    /// `S` and `D` of connectivity alone: the fairness weights as a Laplacian, and equal areas. A surface that satisfies
    /// the inner fairness condition has about these weights, whatever its shape.
    pub(crate) fn combinatorial(
        &mut self,
        rings: &Rings,
        batches: &ValenceBatches,
        fairness: &FairnessWeights,
    ) {
        let _clock = clock("assemble P");
        // Of an edge of two equilateral triangles.
        let equilateral = 2.0 / 3f64.sqrt();
        let free = rings.free();
        self.weight.resize(rings.neighbour.values().len(), 0.0);
        self.total.resize(free, 0.0);
        self.boundary_weight.clear();
        self.boundary_weight
            .resize(rings.boundary_neighbour.values().len(), 0.0);
        self.d.clear();
        self.d.resize(free + rings.boundary(), 1.0);
        for i in 0..free {
            let (first, lane) = batches.place(i);
            let ring = rings.neighbour.range(i);
            for (k, s) in ring.clone().enumerate() {
                let own = fairness.at(first + k, lane);
                let twin = rings.twin[s];
                let mean = if twin == NONE {
                    own
                } else {
                    let j = rings.neighbour.values()[s] as usize;
                    let (first, lane) = batches.place(j);
                    0.5 * (own + fairness.at(first + twin as usize - rings.neighbour.range(j).start, lane))
                };
                self.weight[s] = equilateral * mean;
            }
            self.total[i] = self.weight[ring].iter().sum();
        }
        for b in 0..rings.boundary() {
            let first = rings.boundary_neighbour.range(b).start;
            for (k, &j) in rings.boundary_ring(b).iter().enumerate() {
                let triangles = rings
                    .boundary_triangles(b)
                    .iter()
                    .filter(|t| t.contains(&j))
                    .count();
                self.boundary_weight[first + k] = if (j as usize) < free {
                    self.weight_between(rings, j as usize, (free + b) as u32)
                } else {
                    0.5 * equilateral * triangles as f64
                };
            }
        }
    }

    /// `S` and `D` of the metric in which the region's triangles have these edges, from each corner to the next.
    pub(crate) fn of_lengths(&mut self, region: &RegionMesh, rings: &Rings, lengths: &[[f64; 3]]) {
        // Of six equilateral triangles with edges of length 1.
        let hexagon = 1.5 * 3f64.sqrt();
        let free = rings.free();
        self.weight.clear();
        self.weight.resize(rings.neighbour.values().len(), 0.0);
        self.boundary_weight.clear();
        self.boundary_weight
            .resize(rings.boundary_neighbour.values().len(), 0.0);
        let mut disk = vec![0.0; free + rings.boundary()];
        for (corners, &[ab, bc, ca]) in region.triangles().iter().zip(lengths) {
            let area = heron(ab, bc, ca).max(f64::MIN_POSITIVE);
            for (k, opposite, beside) in [(0, bc, [ab, ca]), (1, ca, [bc, ab]), (2, ab, [ca, bc])] {
                let squares = beside[0] * beside[0] + beside[1] * beside[1] - opposite * opposite;
                let cotangent = squares / (4.0 * area);
                let (u, v) = (corners[(k + 1) % 3], corners[(k + 2) % 3]);
                *self.slot(rings, u, v) += cotangent;
                *self.slot(rings, v, u) += cotangent;
                disk[corners[k] as usize] += area;
            }
        }
        let total = |i: usize| self.weight[rings.neighbour.range(i)].iter().sum();
        self.total = (0..free).map(total).collect();
        self.d.clear();
        let whole = (0..disk.len()).map(|v| if v < free { disk[v] } else { 2.0 * disk[v] });
        self.d.extend(whole.map(|disk| hexagon / disk));
    }

    /// `w_uv` of two neighbours in the region.
    fn slot(&mut self, rings: &Rings, u: u32, v: u32) -> &mut f64 {
        let (u, free) = (u as usize, rings.free());
        let place = rings.neighbours(u).iter().position(|&n| n == v).unwrap_or(0);
        if u < free {
            &mut self.weight[rings.neighbour.range(u).start + place]
        } else {
            &mut self.boundary_weight[rings.boundary_neighbour.range(u - free).start + place]
        }
    }

    /// `D` at free vertices.
    pub(crate) fn free_d(&self) -> &[f64] {
        &self.d[..self.total.len()]
    }

    /// `D` at boundary vertices.
    pub(crate) fn boundary_d(&self) -> &[f64] {
        &self.d[self.total.len()..]
    }

    /// The neighbours of a free vertex, and their weights.
    pub(crate) fn free_row<'m>(&'m self, rings: &'m Rings, i: usize) -> impl Iterator<Item = (usize, f64)> {
        let weights = &self.weight[rings.neighbour.range(i)];
        let row = rings.ring(i).iter().zip(weights);
        row.map(|(&j, &w)| (j as usize, w))
    }

    /// The free neighbours of a boundary vertex, and their one-sided weights.
    pub(crate) fn boundary_row<'m>(
        &'m self,
        rings: &'m Rings,
        b: usize,
    ) -> impl Iterator<Item = (usize, f64)> {
        let weights = &self.boundary_weight[rings.boundary_neighbour.range(b)];
        let row = rings.boundary_ring(b).iter().zip(weights);
        row.map(|(&j, &w)| (j as usize, w))
            .filter(|(j, _)| *j < self.total.len())
    }

    /// The values of the free block `S_ff` on the pattern of the free one-ring graph.
    pub(crate) fn dirichlet(&self, rings: &Rings, pattern: &SymmetricPattern) -> Vec<f64> {
        let mut values = vec![0.0; pattern.column.len()];
        let pieces = split_rows(pattern, &mut values).into_iter();
        parallel::for_each(pieces, |chunk, piece| {
            let first = chunk * CHUNK;
            for i in first..(first + CHUNK).min(pattern.order()) {
                let row = pattern.row(i);
                let offset = pattern.start[i] - pattern.start[first];
                let own = &mut piece[offset..offset + row.len()];
                for (&j, w) in rings.ring(i).iter().zip(&self.weight[rings.neighbour.range(i)]) {
                    if (j as usize) < i
                        && let Some(c) = row.iter().position(|&k| k == j)
                    {
                        own[c] = -w;
                    }
                }
                own[row.len() - 1] = self.total[i];
            }
        });
        values
    }

    /// `w_ij` of free vertex `i` and its neighbour `j`.
    fn weight_between(&self, rings: &Rings, i: usize, j: u32) -> f64 {
        let place = rings.ring(i).iter().position(|&n| n == j);
        place.map_or(0.0, |k| self.weight[rings.neighbour.range(i)][k])
    }

    /// Collapsed disks would make single entries of `D` astronomically large: none exceeds the median by more than
    /// this factor.
    fn bound(&mut self, free: usize) {
        const LARGEST: f64 = 1e6;
        let mut sorted = self.d[..free].to_vec();
        let middle = sorted.len() / 2;
        let median = *sorted.select_nth_unstable_by(middle, f64::total_cmp).1;
        for d in &mut self.d {
            *d = d.min(median * LARGEST);
        }
    }

    /// Puts the values of `P` on `pattern`, row by row.
    pub(crate) fn assemble(&self, rings: &Rings, pattern: &SymmetricPattern, values: &mut [f64]) {
        let _clock = clock("assemble P");
        let free = pattern.order();
        let pieces = split_rows(pattern, values);
        parallel::map_with(
            || vec![0u32; free],
            pieces.into_iter().enumerate(),
            |place, (chunk, piece)| {
                let first = chunk * CHUNK;
                for i in first..(first + CHUNK).min(free) {
                    let offset = pattern.start[i] - pattern.start[first];
                    let row = &mut piece[offset..offset + pattern.row(i).len()];
                    self.row(rings, pattern, i, place, row);
                }
            },
        );
    }

    /// Row `i` of `P`: `sum_k D_k s_ki s_kj` over `k` in the closed ring of `i`, `s_k` the `k`-th column of `S_I`.
    fn row(&self, rings: &Rings, pattern: &SymmetricPattern, i: usize, place: &mut [u32], row: &mut [f64]) {
        let free = pattern.order();
        for (c, &j) in pattern.row(i).iter().enumerate() {
            place[j as usize] = c as u32;
        }
        row.fill(0.0);
        let limit = i as u32;
        let mut column = |factor: f64, neighbours: &[u32], weights: &[f64]| {
            for (&j, w) in neighbours.iter().zip(weights) {
                if j <= limit {
                    row[place[j as usize] as usize] -= factor * w;
                }
            }
        };
        let ring = rings.neighbour.range(i);
        column(
            self.d[i] * self.total[i],
            rings.ring(i),
            &self.weight[ring.clone()],
        );
        let mut diagonal = self.d[i] * self.total[i] * self.total[i];
        for s in ring {
            let k = rings.neighbour.values()[s] as usize;
            let factor = -self.d[k] * self.weight[s];
            if k < free {
                column(factor, rings.ring(k), &self.weight[rings.neighbour.range(k)]);
                if k < i {
                    column(factor, &[k as u32], &[-self.total[k]]);
                }
            } else {
                let b = k - free;
                let weights = &self.boundary_weight[rings.boundary_neighbour.range(b)];
                column(factor, rings.boundary_ring(b), weights);
            }
        }
        let last = row.len() - 1;
        diagonal += row[last];
        row[last] = diagonal;
    }

    /// `y = S_I D (S x - flux)`, all vertices of the region in `x`, `flux` at boundary vertices; `u` is scratch of the
    /// same length as `x`.
    pub(crate) fn apply<const K: usize>(
        &self,
        rings: &Rings,
        x: &[[f64; K]],
        flux: Option<&[[f64; K]]>,
        u: &mut [[f64; K]],
        y: &mut [[f64; K]],
    ) {
        let _clock = clock("start: products with P");
        let free = y.len();
        parallel::for_each(u.chunks_mut(CHUNK), |chunk, u| {
            for (k, u) in (chunk * CHUNK..).zip(u) {
                let weights = if k < free {
                    &self.weight[rings.neighbour.range(k)]
                } else {
                    &self.boundary_weight[rings.boundary_neighbour.range(k - free)]
                };
                let mut sum = [0.0; K];
                for (j, w) in rings.neighbours(k).iter().zip(weights) {
                    for c in 0..K {
                        sum[c] += w * (x[k][c] - x[*j as usize][c]);
                    }
                }
                if let (Some(flux), true) = (flux, k >= free) {
                    for c in 0..K {
                        sum[c] -= flux[k - free][c];
                    }
                }
                *u = sum.map(|s| s * self.d[k]);
            }
        });
        let u = &*u;
        parallel::for_each(y.chunks_mut(CHUNK), |chunk, y| {
            for (i, y) in (chunk * CHUNK..).zip(y) {
                let weights = &self.weight[rings.neighbour.range(i)];
                let mut sum = [0.0; K];
                for (j, w) in rings.ring(i).iter().zip(weights) {
                    for c in 0..K {
                        sum[c] += w * (u[i][c] - u[*j as usize][c]);
                    }
                }
                *y = sum;
            }
        });
    }
}

/// Area of a triangle with these edges (W. Kahan's order of Heron's formula).
fn heron(a: f64, b: f64, c: f64) -> f64 {
    let mut edges = [a, b, c];
    edges.sort_unstable_by(|x, y| y.total_cmp(x));
    let [a, b, c] = edges;
    let product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    0.25 * product.max(0.0).sqrt()
}

/// The values of a pattern by chunks of rows.
fn split_rows<'v>(pattern: &SymmetricPattern, values: &'v mut [f64]) -> Vec<&'v mut [f64]> {
    let free = pattern.order();
    let lengths = (0..free).step_by(CHUNK).map(|i| {
        let end = (i + CHUNK).min(free);
        pattern.start[end] - pattern.start[i]
    });
    split_lengths(values, lengths)
}

/// The surface with every free vertex moved a little along its normal.
struct Shift {
    x: Vec<Vector3<f64>>,
    length: f64,
}

impl Shift {
    /// The shift is this fraction of the typical edge.
    /// Of 125 cases, half: 112 change by up to 7e-6 edges, 2 get another triangulation;
    /// double: 113 change by up to 0.3 edges, 2 get another triangulation.
    const FRACTION: f64 = 1e-5;

    fn new(equations: &Equations<'_>, x: &[Vector3<f64>], state: &State) -> Self {
        let free = equations.free();
        let mean_area = state.area.iter().sum::<f64>() / free as f64;
        let length = Self::FRACTION * mean_area.sqrt();
        let mut shifted = x.to_vec();
        for (x, n) in shifted.iter_mut().zip(&state.normal) {
            *x += n * length;
        }
        Self { x: shifted, length }
    }

    /// Change of `H_b` per unit shift.
    fn answer(&self, equations: &Equations<'_>, state: &State, b: usize) -> f64 {
        let after = equations.boundary_curvature_of_any(&self.x, &state.corrected, b);
        (after - state.h[equations.free() + b]) / self.length
    }
}

/// The conormal flux that the G1 data prescribe: at boundary vertex `b` the sum over its boundary edges of `e x n`, `e`
/// running with the region on its left and `n` the mean of the edge's two normals (the outward conormal times the
/// edge's length; paper, section 7.4, asks for a linear start without saying how normals enter).
pub(crate) fn conormal_flux(
    region: &RegionMesh,
    rings: &Rings,
    x: &[Vector3<f64>],
    boundary_normals: &[Vector3<f64>],
) -> Vec<[f64; 3]> {
    let mut flux = vec![Vector3::zeros(); region.boundary];
    for &half_edge in &rings.boundary_half_edges {
        let (a, b) = (
            region.half_edges.origin(half_edge) as usize,
            region.half_edges.target(half_edge) as usize,
        );
        let (n_a, n_b) = (
            boundary_normals[a - region.free],
            boundary_normals[b - region.free],
        );
        let n = (n_a + n_b).try_normalize(1e-9).unwrap_or(n_a);
        let conormal = (x[b] - x[a]).cross(&n);
        flux[a - region.free] += conormal;
        flux[b - region.free] += conormal;
    }
    flux.iter().map(|f| [f.x, f.y, f.z]).collect()
}
