//! The region with its frozen matrices: what connectivity decides once, and what is refreshed.

use std::sync::Arc;

use nalgebra::Vector3;
use rayon::prelude::*;

use super::bilaplacian::Metric;
use super::direction;
use super::factor::Factor;
use crate::discrete::equations::{Equations, FreeCurvature, State};
use crate::discrete::inner_fairness::{FairnessWeights, laplacian};
use crate::discrete::target::RightHandSide;
use crate::discrete::valence_batches::{CHUNK, ValenceBatches};
use crate::mesh::{Region, Rings};
use fairmesh_linear::interrupt::Interrupt;
use fairmesh_linear::ordering::fill_reducing;
use fairmesh_linear::sparse::SymmetricPattern;
use fairmesh_linear::symbolic::Symbolic;

/// Tangential steps below this, in diagonals, are projected.
const NEAR: f64 = 1e-3;

/// With more free vertices `P` is factored in 64 bits from the start: its condition grows with their square, and the lowest
/// modes of a 32-bit factor are then hardly right to a single digit. (With fewer, the linear start finds out.)
const SINGLE_UP_TO: usize = 250_000;

/// Largest edge-relative change of one step.
pub(crate) const LARGEST_CHANGE: f64 = 0.5;

/// Equations, matrices and scratch of one fairing problem, in the region's own centred and scaled frame.
pub(crate) struct System<'a> {
    /// The region.
    pub region: &'a Region,
    /// Its rings.
    pub rings: &'a Rings,
    /// The same, transposed.
    pub batches: &'a ValenceBatches,
    /// The input surface of the region (free, boundary).
    pub input: &'a [Vector3<f64>],
    /// Prescribed normals; those of the last evaluation where the surface passes.
    pub boundary_normals: Vec<Vector3<f64>>,
    /// Boundary vertices with a closed ring that the surface passes smoothly; empty: none.
    pub smooth_interior: Vec<bool>,
    /// Inner fairness.
    pub weights: FairnessWeights,
    /// Curvature at free vertices.
    pub curvature: FreeCurvature,
    /// What `Delta_B H` has to be, in the frame; zero unless set.
    pub right_hand_side: RightHandSide,
    /// The last evaluation.
    pub state: State,
    /// The metric that `P` was made from.
    pub metric: Metric,
    /// The unit of step norms: the diagonal of the region's bounding box.
    pub diagonal: f64,
    g_pattern: SymmetricPattern,
    g: Factor,
    p_pattern: SymmetricPattern,
    p_symbolic: Arc<Symbolic>,
    p: Factor,
    p_values: Vec<f64>,
    normal_step: Vec<[f64; 1]>,
    tangential_step: Vec<[f64; 3]>,
    interrupt: Interrupt,
}

/// A matrix that should be positive definite is not: the surface behind it has collapsed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Collapsed;

/// One quasi-Newton step's size, in diagonals.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepNorm {
    /// Root mean square of the normal step.
    pub normal: f64,
    /// Root mean square of the tangential step.
    pub tangential: f64,
    /// The largest normal step of a single vertex.
    pub largest: f64,
}

impl StepNorm {
    /// Both together: what tolerances are about.
    pub(crate) fn total(&self) -> f64 {
        self.normal + self.tangential
    }
}

impl<'a> System<'a> {
    /// Orders and analyses both matrices from connectivity, and factors `G`.
    pub(crate) fn new(
        region: &'a Region,
        rings: &'a Rings,
        batches: &'a ValenceBatches,
        input: &'a [Vector3<f64>],
        boundary_normals: Vec<Vector3<f64>>,
        weights: FairnessWeights,
        curvature: FreeCurvature,
    ) -> Self {
        let g_pattern = rings.graph();
        let ((g_symbolic, g_values), (p_pattern, p_symbolic)) = rayon::join(
            || {
                let order = fill_reducing(&g_pattern, &g_pattern, 1, None);
                let values = laplacian(&g_pattern, rings, batches, &weights);
                (Arc::new(Symbolic::new(&g_pattern, &order)), values)
            },
            || {
                let pattern = rings.two_ring_pattern();
                let order = fill_reducing(&pattern, &g_pattern, 2, None);
                let symbolic = Arc::new(Symbolic::new(&pattern, &order));
                (pattern, symbolic)
            },
        );
        let mut g = Factor::new(&g_symbolic, false);
        // Convex weights make G an irreducible M-matrix with a fixed vertex in every component: it is positive
        // definite, and a failure here would show in the first membrane as a collapsed surface.
        let _ = g.factor(&g_values);
        let free = region.free;
        Self {
            region,
            rings,
            batches,
            input,
            boundary_normals,
            smooth_interior: Vec::new(),
            weights,
            curvature,
            right_hand_side: RightHandSide::default(),
            state: State::new(batches, region.boundary),
            metric: Metric::default(),
            diagonal: 1.0,
            g_pattern,
            g,
            p: Factor::new(&p_symbolic, free > SINGLE_UP_TO),
            p_values: vec![0.0; p_pattern.column.len()],
            p_pattern,
            p_symbolic,
            normal_step: vec![[0.0]; free],
            tangential_step: vec![[0.0; 3]; free],
            interrupt: Interrupt::default(),
        }
    }

    /// Factorizations fail from when this is set; [`Control::goes_on`](super::Control::goes_on) tells whether it is.
    pub(crate) fn heed(&mut self, interrupt: &Interrupt) {
        self.interrupt = interrupt.clone();
        self.g.heed(interrupt);
        self.p.heed(interrupt);
    }

    /// Number of free vertices.
    pub(crate) fn free(&self) -> usize {
        self.region.free
    }

    /// The equations with the current normals, weights and curvature.
    pub(crate) fn equations(&self) -> Equations<'_> {
        Equations {
            rings: self.rings,
            batches: self.batches,
            boundary_normals: &self.boundary_normals,
            smooth_interior: &self.smooth_interior,
            weights: &self.weights,
            curvature: self.curvature,
            right_hand_side: self.right_hand_side,
        }
    }

    /// Evaluates both equations at `x` into `state`.
    pub(crate) fn evaluate(&mut self, x: &[Vector3<f64>]) {
        let mut state = std::mem::take(&mut self.state);
        self.equations().evaluate(x, &mut state);
        self.state = state;
        self.take_smooth_interior_normals();
    }

    fn take_smooth_interior_normals(&mut self) {
        let (_, current) = self.state.corrected.split_at(self.region.free);
        for ((normal, current), passes) in self
            .boundary_normals
            .iter_mut()
            .zip(current)
            .zip(&self.smooth_interior)
        {
            if *passes {
                *normal = *current;
            }
        }
    }

    /// Evaluates only what a tangential step needs.
    pub(crate) fn evaluate_inner(&mut self, x: &[Vector3<f64>]) {
        let mut state = std::mem::take(&mut self.state);
        self.equations().evaluate_inner(x, &mut state);
        self.state = state;
    }

    /// Takes new inner-fairness weights.
    pub(crate) fn set_weights(&mut self, weights: FairnessWeights) -> Result<(), Collapsed> {
        self.weights = weights;
        let values = laplacian(&self.g_pattern, self.rings, self.batches, &self.weights);
        self.g.factor(&values).map_err(|_| Collapsed)
    }

    /// Makes `P` from the last evaluation, which was at `x`, with `mass(i)` on its diagonal. With `response` it evaluates at
    /// `x` itself.
    pub(crate) fn rebuild(
        &mut self,
        x: &[Vector3<f64>],
        response: bool,
        mass: impl Fn(usize) -> f64 + Sync,
    ) -> Result<(), Collapsed> {
        if response {
            let mut state = std::mem::take(&mut self.state);
            self.equations().evaluate_with_response(x, &mut state);
            self.state = state;
            self.take_smooth_interior_normals();
        }
        let mut metric = std::mem::take(&mut self.metric);
        metric.update(&self.equations(), x, &self.state, response);
        self.metric = metric;
        self.refactor(mass)
    }

    /// Factors `P` of the metric that is there.
    pub(crate) fn refactor(&mut self, mass: impl Fn(usize) -> f64 + Sync) -> Result<(), Collapsed> {
        self.metric
            .assemble(self.rings, &self.p_pattern, mass, &mut self.p_values);
        match self.p.factor(&self.p_values) {
            Ok(()) => Ok(()),
            Err(_) if !self.p.is_double() => self.refactor_double(),
            Err(_) => Err(Collapsed),
        }
    }

    /// Goes over to a 64-bit factor of the same matrix.
    pub(crate) fn refactor_double(&mut self) -> Result<(), Collapsed> {
        self.p = Factor::new(&self.p_symbolic, true);
        self.p.heed(&self.interrupt);
        self.p.factor(&self.p_values).map_err(|_| Collapsed)
    }

    /// Whether `P` is factored in 64 bits.
    pub(crate) fn is_double(&self) -> bool {
        self.p.is_double()
    }

    /// Solves with the factor of `P`, three columns.
    pub(crate) fn solve_p(&mut self, x: &mut [[f64; 3]]) {
        self.p.solve(x);
    }

    /// Solves with the factor of `G`, three columns.
    pub(crate) fn solve_g(&mut self, x: &mut [[f64; 3]]) {
        self.g.solve(x);
    }

    /// The quasi-Newton step at the last evaluation, as one vector of three numbers per free vertex: along the normals
    /// (see [`direction`]) `P^-1 R1`, and the tangential field `G^-1(inner residual)`. Far from the solution the field is taken as it is:
    /// projecting it with each vertex's own normal would turn the crowding of a collapsed feature into normal noise.
    /// Near the solution it is projected, or each equation would disturb the other.
    pub(crate) fn step(&mut self, step: &mut [f64], normal_part: bool) -> StepNorm {
        let (state, p, g) = (&self.state, &mut self.p, &mut self.g);
        let (t, d) = (&mut self.normal_step, &mut self.tangential_step);
        rayon::join(
            || {
                if normal_part {
                    t.iter_mut().zip(&state.outer).for_each(|(t, r)| *t = [*r]);
                    p.solve(t);
                } else {
                    t.fill([0.0]);
                }
            },
            || {
                d.iter_mut()
                    .zip(&state.inner)
                    .for_each(|(d, r)| *d = [r.x, r.y, r.z]);
                g.solve(d);
            },
        );
        let rms = |sum: f64| (sum / self.free() as f64).sqrt() / self.diagonal;
        let norm = StepNorm {
            normal: rms(self.normal_step.iter().map(|t| t[0] * t[0]).sum()),
            tangential: rms(self
                .tangential_step
                .iter()
                .map(|d| d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
                .sum()),
            largest: self.normal_step.iter().fold(0.0f64, |m, t| m.max(t[0].abs())) / self.diagonal,
        };
        let project = norm.tangential < NEAR;
        let disk = self.state.area.iter().sum::<f64>() / self.free() as f64;
        let rounds = direction::rounds(norm.largest * self.diagonal, disk);
        let averaged = (rounds > 0)
            .then(|| direction::averaged(self.rings, &self.state.normal, &self.boundary_normals, rounds));
        let along = averaged.as_ref().unwrap_or(&self.state.normal);
        for (i, s) in step.chunks_exact_mut(3).enumerate() {
            let n = &self.state.normal[i];
            let d = Vector3::from(self.tangential_step[i]);
            let off = if project { d.dot(n) } else { 0.0 };
            for c in 0..3 {
                s[c] = self.normal_step[i][0] * along[i][c] - off * n[c] + d[c];
            }
        }
        norm
    }

    /// The normal part of the last step.
    pub(crate) fn normal_step(&self, step: &mut [f64]) {
        for ((s, t), n) in step
            .chunks_exact_mut(3)
            .zip(&self.normal_step)
            .zip(&self.state.normal)
        {
            s.copy_from_slice((n * t[0]).as_slice());
        }
    }

    /// The tangential part of the last step.
    pub(crate) fn tangential_step(&self, step: &mut [f64]) {
        step.copy_from_slice(self.tangential_step.as_flattened());
    }

    /// The largest change of an edge by `step` relative to its length at `x`.
    pub(crate) fn edge_change(&self, x: &[Vector3<f64>], step: &[f64]) -> f64 {
        let free = self.free();
        let of = |i: usize| Vector3::new(step[3 * i], step[3 * i + 1], step[3 * i + 2]);
        let squared = (0..free.div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| {
                let mut largest = 0.0f64;
                for i in chunk * CHUNK..((chunk + 1) * CHUNK).min(free) {
                    let own = of(i);
                    for &j in self.rings.ring(i) {
                        let other = if (j as usize) < free {
                            of(j as usize)
                        } else {
                            Vector3::zeros()
                        };
                        let edge = (x[i] - x[j as usize]).norm_squared().max(f64::MIN_POSITIVE);
                        largest = largest.max((own - other).norm_squared() / edge);
                    }
                }
                largest
            })
            .reduce(|| 0.0, f64::max);
        squared.sqrt()
    }
}

/// `x += scale step` at the free vertices.
pub(crate) fn advance(x: &mut [Vector3<f64>], step: &[f64], scale: f64) {
    for (x, s) in x.iter_mut().zip(step.chunks_exact(3)) {
        *x += Vector3::new(s[0], s[1], s[2]) * scale;
    }
}
