//! Curvature-continuous fairing: `Delta_B^2 H = 0` with positions, normals and mean curvature prescribed along boundary loops.
//!
//! With `phi = Delta_B H` as an unknown of its own the equations are `R1 = S H + (2A/3) phi = 0` and `S phi = 0` at the free vertices, and
//! `H = H*` along the loops. Along a loop `phi` is a sum of its lowest modes, whose coefficients `c` are the further unknowns of the
//! iteration; inside it is their harmonic extension. In one step, with matrices frozen: `E = ` extension of the modes,
//! `W = P^-1 (2A/3) E`, and `c` such that `H - D S (t + W c)` has the trace `H*` along the loops, as far as the modes tell.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector, Dyn, LU, Vector3};

use crate::discrete::equations::{Equations, State};
use crate::discrete::valence_batches::CHUNK;
use crate::mesh::Rings;
use crate::solve::bilaplacian::Metric;
use crate::solve::factor::Collapsed;
use crate::solve::factor::{Factor, Stacks};
use crate::solve::g2::boundary_curvature::LoopCondition;
use crate::solve::normal_matrix::NormalMatrix;
use crate::support::profile::clock;
use fairmesh_linear::parallel;
use fairmesh_linear::sparse::SymmetricPattern;
use fairmesh_linear::symbolic::Symbolic;

/// Right-hand sides solved at once.
const COLUMNS: usize = 8;

/// A mode of a loop.
#[derive(Debug, Default, Clone)]
struct Column {
    /// `E`, at free vertices.
    extension: Vec<f64>,
    /// `W`, the normal motion that it causes.
    motion: Vec<f64>,
    /// The root of the sum of squares of the first `W`: the coefficient is measured in motions.
    unit: f64,
}

/// The further unknowns, with what their steps need.
pub(crate) struct Continuity {
    /// What holds along the loops.
    pub(in crate::solve) loops: Vec<LoopCondition>,
    /// `Delta_B H` at the vertices of the region.
    phi: Vec<f64>,
    columns: Vec<Column>,
    coefficients: Vec<f64>,
    /// `S` between free vertices.
    laplacian: Factor,
    /// `H - H*` along the loops, one after the other, at the last evaluation,
    mismatch: Vec<f64>,
    /// and with which weights `H` there is made of that at free vertices.
    trace: Vec<Vec<(u32, f64)>>,
    /// Projected answer of the mismatch to the modes.
    answer: Option<LU<f64, Dyn, Dyn>>,
    residual: Vec<[f64; 1]>,
}

impl Continuity {
    /// No `phi` yet.
    pub(in crate::solve) fn new(
        loops: Vec<LoopCondition>,
        symbolic: &Arc<Symbolic>,
        (free, boundary): (usize, usize),
    ) -> Self {
        let modes = loops.iter().map(|l| l.modes.modes.len()).sum();
        let vertices = loops.iter().map(|l| l.vertices.len()).sum();
        Self {
            loops,
            phi: vec![0.0; free + boundary],
            columns: vec![Column::default(); modes],
            coefficients: vec![0.0; modes],
            laplacian: Factor::new(symbolic, false),
            mismatch: vec![0.0; vertices],
            trace: vec![Vec::new(); vertices],
            answer: None,
            residual: vec![[0.0]; free],
        }
    }

    /// How many modes there are.
    pub(in crate::solve) fn modes(&self) -> usize {
        self.coefficients.len()
    }

    /// `Delta_B H`, at free, then at boundary vertices.
    pub(in crate::solve) fn phi(&self) -> &[f64] {
        &self.phi
    }

    /// Takes these coefficients, as steps measure them.
    pub(in crate::solve) fn set(&mut self, values: &[f64]) {
        let free = self.residual.len();
        for (m, (column, value)) in self.columns.iter().zip(values).enumerate() {
            let value = if column.unit > 0.0 {
                value / column.unit
            } else {
                0.0
            };
            let change = value - self.coefficients[m];
            if change != 0.0 {
                let pieces = self.phi[..free]
                    .chunks_mut(CHUNK)
                    .zip(column.extension.chunks(CHUNK));
                parallel::for_each(pieces, |_, (phi, e)| {
                    phi.iter_mut().zip(e).for_each(|(phi, e)| *phi += change * e);
                });
            }
            self.coefficients[m] = value;
        }
        self.phi[free..].fill(0.0);
        let mut coefficients = self.coefficients.iter();
        for l in &self.loops {
            for (m, c) in (0..l.modes.modes.len()).zip(&mut coefficients) {
                l.mode(m).for_each(|(b, value)| self.phi[free + b] += c * value);
            }
        }
    }

    /// After an evaluation at `x`: `phi` becomes harmonic on that surface, and takes its part in `R1`.
    pub(in crate::solve) fn evaluate(
        &mut self,
        equations: &Equations<'_>,
        x: &[Vector3<f64>],
        state: &mut State,
    ) {
        let _clock = clock("curvature continuity");
        if self.coefficients.iter().any(|c| *c != 0.0) {
            equations.laplacian(state, &self.phi, &mut self.residual);
            self.laplacian.solve(&mut self.residual);
            self.phi
                .iter_mut()
                .zip(&self.residual)
                .for_each(|(phi, [d])| *phi -= d);
            Equations::add_load(state, &self.phi);
        }
        let free = equations.free();
        let mut row = 0;
        for l in &self.loops {
            for (k, target) in l.target.iter().enumerate() {
                let weights = l.trace(k, free, x, equations.boundary_normals);
                let h: f64 = weights.iter().map(|&(j, w)| w * state.h[j as usize]).sum();
                self.mismatch[row] = h - target;
                self.trace[row] = weights;
                row += 1;
            }
        }
    }

    /// Makes the matrices of the steps at the last evaluation, with the `P` that is there.
    pub(in crate::solve) fn prepare(
        &mut self,
        equations: &Equations<'_>,
        (state, metric): (&State, &Metric),
        (pattern, p, stacks): (&SymmetricPattern, &mut NormalMatrix, &mut Stacks),
    ) -> Result<(), Collapsed> {
        let _clock = clock("curvature continuity");
        let values = equations.free_laplacian(state, pattern);
        self.laplacian.factor(&values, stacks).map_err(|_| Collapsed)?;
        let free = equations.free();
        let of_columns: Vec<(usize, usize)> = self
            .loops
            .iter()
            .enumerate()
            .flat_map(|(l, condition)| (0..condition.modes.modes.len()).map(move |m| (l, m)))
            .collect();
        let mut boundary = vec![[0.0; COLUMNS]; state.h.len() - free];
        let mut block = vec![[0.0; COLUMNS]; free];
        for (first, part) in of_columns.chunks(COLUMNS).enumerate() {
            boundary.fill([0.0; COLUMNS]);
            for (c, &(l, m)) in part.iter().enumerate() {
                self.loops[l]
                    .mode(m)
                    .for_each(|(b, value)| boundary[b][c] = value);
            }
            // S_II E = - S_IB of the modes.
            for (i, sums) in block.iter_mut().enumerate() {
                *sums = [0.0; COLUMNS];
                let (slot, lane) = equations.batches.place(i);
                for (k, &j) in equations.rings.ring(i).iter().enumerate() {
                    if let Some(values) = (j as usize).checked_sub(free).map(|b| &boundary[b]) {
                        let weight = state.weight[slot + k][lane];
                        sums.iter_mut()
                            .zip(values)
                            .for_each(|(sum, v)| *sum += weight * v);
                    }
                }
            }
            self.laplacian.solve(&mut block);
            let columns = &mut self.columns[COLUMNS * first..][..part.len()];
            for (c, column) in columns.iter_mut().enumerate() {
                column.extension = block.iter().map(|e| e[c]).collect();
            }
            for (row, area) in block.iter_mut().zip(&state.area) {
                row.iter_mut().for_each(|e| *e *= 2.0 / 3.0 * area);
            }
            p.solve(&mut block);
            for (c, column) in columns.iter_mut().enumerate() {
                column.motion = block.iter().map(|w| w[c]).collect();
                if column.unit == 0.0 {
                    column.unit = column.motion.iter().map(|w| w * w).sum::<f64>().sqrt();
                }
            }
        }
        let mut answer = DMatrix::zeros(self.modes(), self.modes());
        for m in 0..self.modes() {
            let along = self.answer_to(metric, equations.rings, &self.columns[m].motion);
            answer.set_column(m, &self.projected(&along));
        }
        let answer = answer.lu();
        let is_sound = answer.is_invertible();
        self.answer = Some(answer);
        if is_sound { Ok(()) } else { Err(Collapsed) }
    }

    /// How the mismatch answers to a normal motion, by that of `H` in `P`.
    fn answer_to(&self, metric: &Metric, rings: &Rings, motion: &[f64]) -> Vec<f64> {
        let answer = metric.curvature_answer(rings, motion);
        let of_vertex = |weights: &Vec<(u32, f64)>| {
            let inside = weights.iter();
            inside
                .map(|&(j, w)| answer.get(j as usize).map_or(0.0, |h| w * h))
                .sum()
        };
        self.trace.iter().map(of_vertex).collect()
    }

    /// The parts of the modes in values along the loops.
    fn projected(&self, along: &[f64]) -> DVector<f64> {
        let mut parts = Vec::with_capacity(self.modes());
        let mut first = 0;
        for l in &self.loops {
            let values = &along[first..first + l.vertices.len()];
            parts.extend(l.modes.modes.iter().map(|mode| l.modes.product(mode, values)));
            first += l.vertices.len();
        }
        DVector::from_vec(parts)
    }

    /// Adds to the normal step what closes the mismatch, and writes the step of the coefficients.
    pub(in crate::solve) fn correct(
        &self,
        (metric, rings): (&Metric, &Rings),
        t: &mut [[f64; 1]],
        steps: &mut [f64],
    ) {
        let _clock = clock("curvature continuity");
        let plain: Vec<f64> = t.iter().map(|t| t[0]).collect();
        let answered = self.answer_to(metric, rings, &plain);
        let left: Vec<f64> = self.mismatch.iter().zip(&answered).map(|(m, a)| m + a).collect();
        let solved = self
            .answer
            .as_ref()
            .and_then(|lu| lu.solve(&self.projected(&left)));
        let Some(c) = solved else {
            steps.fill(0.0);
            return;
        };
        parallel::for_each(t.chunks_mut(CHUNK), |chunk, t| {
            for (column, c) in self.columns.iter().zip(&c) {
                let motion = &column.motion[chunk * CHUNK..];
                t.iter_mut().zip(motion).for_each(|(t, w)| t[0] -= c * w);
            }
        });
        for ((step, column), c) in steps.iter_mut().zip(&self.columns).zip(&c) {
            *step = -c * column.unit;
        }
    }
}
