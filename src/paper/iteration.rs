//! One level: estimate, update, estimate, update (paper 7.1, Figure 6), until the outer fairness equation holds.

use nalgebra::Vector3;

use super::estimate::{Dirichlet, Residual};
use super::local::Answer;
use super::options::{Estimate, PaperOptions};
use super::vertex::Ring;
use crate::discrete::equations::State;
use crate::discrete::inner_fairness::FairnessWeights;
use crate::discrete::valence_batches::ValenceBatches;
use crate::mesh::Rings;
use crate::solve::{Control, Domain, Problem};

/// What the iteration has to reach on a level.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Goal {
    /// Harmonic defect.
    pub defect: f64,
    /// `|Delta_B H|` without unit.
    pub laplacian: f64,
    /// Updates on this level at most.
    pub updates: usize,
}

impl Goal {
    /// Whether it is met, or never will be.
    fn judge(&self, residual: &Residual) -> Option<LevelStatus> {
        let Residual {
            defect,
            laplacian,
            rounding,
        } = *residual;
        if !(defect.is_finite() && laplacian.is_finite()) {
            Some(LevelStatus::Diverged)
        } else if defect > self.defect || laplacian > self.laplacian.max(rounding) {
            None
        } else if laplacian <= self.laplacian {
            Some(LevelStatus::Met)
        } else {
            Some(LevelStatus::Rounding)
        }
    }
}

/// How it ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LevelStatus {
    /// The goal is met.
    Met,
    /// Met as far as the rounding of positions lets one see.
    Rounding,
    /// The level's share of updates is used up.
    Spent,
    /// The run's limit, or cancelled.
    Stopped,
    /// The surface has left the numbers.
    Diverged,
}

/// What came of it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LevelResult {
    /// How it ended.
    pub status: LevelStatus,
    /// Of the surface returned.
    pub residual: Residual,
    /// Updates made.
    pub updates: usize,
    /// Root mean square of the last update's normal and tangential steps together, in diagonals.
    pub step: f64,
}

/// One level of the hierarchy with room for the iteration.
pub(crate) struct Level<'a> {
    rings: &'a Rings,
    problem: Problem<'a>,
    /// `lambda_ij`, ring after ring; empty where all are one.
    lambda: Vec<f64>,
    pub(super) state: State,
    dirichlet: Dirichlet<'a>,
    /// Unit normals of free and boundary vertices, the newest.
    normal: Vec<Vector3<f64>>,
    /// Estimated mean curvature, free and boundary.
    h: Vec<f64>,
    /// `s` of each free vertex.
    damping: Vec<f64>,
    answer: Answer,
}

impl<'a> Level<'a> {
    /// Room for the region of a problem.
    pub(crate) fn new(problem: &Problem<'a>) -> Self {
        let Domain { rings, batches, .. } = &**problem.domain;
        let weights = problem.weights;
        let free = rings.free();
        let mut normal = vec![Vector3::zeros(); free];
        normal.extend_from_slice(problem.boundary_normals);
        Self {
            rings,
            problem: *problem,
            lambda: in_rings(rings, batches, weights),
            state: State::new(batches, problem.boundary_normals.len()),
            dirichlet: Dirichlet::new(rings, batches, problem.right_hand_side),
            h: vec![0.0; normal.len()],
            damping: vec![1.0; free],
            answer: Answer::default(),
            normal,
        }
    }

    /// Iterates from `x` (free, boundary) until the goal is met. `x` becomes the surface of smallest defect on the way;
    /// the last one, where the goal is met. Progress is told after every update.
    pub(crate) fn iterate(
        &mut self,
        x: &mut [Vector3<f64>],
        options: &PaperOptions,
        (goal, diagonal): (Goal, f64),
        control: &mut Control<'_>,
        tell: &mut dyn FnMut(&mut Control<'_>, f64, &Residual),
    ) -> LevelResult {
        let mut best = (
            x.to_vec(),
            Residual {
                defect: f64::INFINITY,
                ..Residual::default()
            },
        );
        let mut ended = LevelResult {
            status: LevelStatus::Spent,
            residual: Residual::default(),
            updates: 0,
            step: f64::NAN,
        };
        let mut next_measure = 0;
        loop {
            self.evaluate(x);
            self.dirichlet.refresh(&self.state);
            ended.residual = self.dirichlet.measure(x, &self.state, diagonal);
            if let Some(status) = goal.judge(&ended.residual) {
                ended.status = status;
                if status == LevelStatus::Diverged {
                    break;
                }
                return ended;
            }
            if ended.residual.defect < best.1.defect {
                best.0.copy_from_slice(x);
                best.1 = ended.residual;
            }
            if control.exhausted() {
                ended.status = LevelStatus::Stopped;
                break;
            }
            if ended.updates == goal.updates {
                break;
            }
            self.estimate(options.estimate, ended.updates);
            if ended.updates == next_measure {
                self.measure_answers(x, options.damping);
                next_measure = (2 * next_measure).max(FIRST_MEASURE);
            }
            ended.step = self.update(x) / diagonal;
            ended.updates += 1;
            tell(control, ended.step, &ended.residual);
        }
        x.copy_from_slice(&best.0);
        ended.residual = best.1;
        ended
    }

    /// Evaluates both equations at `x`.
    pub(super) fn evaluate(&mut self, x: &[Vector3<f64>]) {
        self.problem.equations().evaluate(x, &mut self.state);
    }

    /// The estimate for update number `count`, in `h`.
    fn estimate(&mut self, estimate: Estimate, count: usize) {
        self.h.copy_from_slice(&self.state.h);
        match estimate {
            Estimate::Alternating { .. } if count.is_multiple_of(2) => {
                self.dirichlet.gauss_seidel(&mut self.h)
            }
            Estimate::Alternating { iterations } | Estimate::ConjugateGradients { iterations } => {
                self.dirichlet.conjugate_gradients(&mut self.h, iterations);
            }
            Estimate::GaussSeidel { sweeps } => {
                (0..sweeps).for_each(|_| self.dirichlet.gauss_seidel(&mut self.h));
            }
        }
    }

    /// Sets every vertex's `s`: `damping`, or less where the estimate at a vertex answers to its own steps more than its
    /// curvature does. That is the case beside boundary vertices with short edges, whose one-sided `H` is what the estimate
    /// is made from: the "rare constellations" of 7.5 in which a vertex alternates between two positions.
    fn measure_answers(&mut self, x: &mut [Vector3<f64>], damping: f64) {
        let free = self.rings.free();
        self.normal.copy_from_slice(&self.state.corrected);
        for i in 0..free {
            let ring = Ring {
                neighbour: self.rings.ring(i),
                lambda: &[],
            };
            let own = ring.slope(i, x, &self.normal);
            let mut others = 0.0;
            let at = (&mut *x, &mut self.normal[..], &self.state.h[..]);
            self.answer.of_neighbours(self.rings, i as u32, at, |k, slope| {
                others += self.dirichlet.share(i, k) * slope;
            });
            let answer = 1.0 + others / own;
            self.damping[i] = damping.min(LARGEST_ANSWER / answer.max(f64::MIN_POSITIVE));
        }
    }

    /// Updates all free vertices, one after the other, each with the newest positions of its neighbours. Returns the
    /// root mean square step.
    fn update(&mut self, x: &mut [Vector3<f64>]) -> f64 {
        let free = self.rings.free();
        self.normal.copy_from_slice(&self.state.corrected);
        let mut squares = 0.0;
        for i in 0..free {
            let ring = Ring {
                neighbour: self.rings.ring(i),
                lambda: self.lambda.get(self.rings.neighbour.range(i)).unwrap_or(&[]),
            };
            let update = ring.update(i, x, &self.normal, self.h[i], self.damping[i]);
            x[i] = update.position;
            self.normal[i] = update.normal;
            squares += update.normal_step.powi(2) + update.tangential_step.powi(2);
        }
        (squares / free as f64).sqrt()
    }
}

/// The normal step of a vertex times the answer of estimate and curvature to it is at most this. From 2 on it would
/// alternate between two positions; a regular mesh has 0.9 times 1.2.
/// Of 3 cases, half: 3 change by up to 9e-6 edges, +103 % iterations, 1 fails;
/// double: 3 change by up to 6e-6 edges, +61 % iterations, 1 fails.
const LARGEST_ANSWER: f64 = 1.25;
/// The answers are measured before the first update and after this many, then after twice as many, and so on.
/// Of 3 cases, half: 3 change by up to 3e-8 edges; double: 3 change by up to 2e-8 edges.
const FIRST_MEASURE: usize = 8;

/// The weights, ring after ring.
fn in_rings(rings: &Rings, batches: &ValenceBatches, weights: &FairnessWeights) -> Vec<f64> {
    let mut lambda = Vec::new();
    if weights.slots.is_some() {
        lambda.reserve(rings.neighbour.values().len());
        for i in 0..rings.free() {
            let (first, lane) = batches.place(i);
            lambda.extend((0..rings.ring(i).len()).map(|k| weights.at(first + k, lane)));
        }
    }
    lambda
}
