//! The region with its frozen matrices: what connectivity decides once, and what is refreshed.

mod curvature_continuity;

use std::sync::Arc;

use nalgebra::Vector3;

use super::bilaplacian::Metric;
use super::domain::Domain;
use super::factor::{Collapsed, Factor, Stacks};
use super::formulation::Formulation;
use super::normal_matrix::{Means, NormalMatrix};
use super::plate::Plate;
use super::problem::Problem;
use crate::discrete::equations::{Equations, FreeCurvature, State};
use crate::discrete::inner_fairness::{FairnessWeights, laplacian};
use crate::discrete::target::RightHandSide;
use crate::mesh::RegionMesh;
use crate::quality::SurfaceState;
use crate::solve::g2::boundary_curvature::AskedContinuity;
use crate::solve::g2::equations::Continuity;
use crate::support::profile::clock;
use fairmesh_linear::ordering::fill_reducing;
use fairmesh_linear::parallel;
use fairmesh_linear::sparse::SymmetricPattern;
use fairmesh_linear::symbolic::Symbolic;

/// From so many free vertices on, memory counts: the update matrices are given back when the iterations begin, and Anderson acceleration
/// looks back on half as many steps.
/// Half or double, of 125 cases: none changes, none of which is as large.
pub(super) const LARGE: usize = 50_000;

/// Equations, matrices and scratch of one fairing problem, in the region's own centred and scaled frame.
///
/// What attempts vary of the problem ([`Formulation`]) is handed to each method that needs it.
pub(crate) struct System {
    /// The region and its rings.
    pub(super) domain: Arc<Domain>,
    asked: Formulation,
    asked_continuity: Option<Arc<AskedContinuity>>,
    curvature: FreeCurvature,
    /// Prescribed normals; those of the last evaluation where the surface passes smoothly.
    pub(super) boundary_normals: Vec<Vector3<f64>>,
    /// Boundary vertices with a closed ring that the surface passes smoothly; empty: none.
    smooth_interior: Vec<bool>,
    /// The last evaluation.
    pub(super) state: State,
    /// The metric that `P` was made from.
    pub(super) metric: Metric,
    /// The unit of step norms: the diagonal of the last linear start's bounding box.
    pub(super) diagonal: f64,
    /// The free one-ring graph.
    graph: SymmetricPattern,
    graph_symbolic: Arc<Symbolic>,
    /// The further unknowns of curvature continuity, while they are.
    pub(super) continuity: Option<Box<Continuity>>,
    pub(super) g: Factor,
    /// The weights that `G` is factored with.
    weights: Arc<FairnessWeights>,
    pub(super) p: NormalMatrix,
    stacks: Stacks,
    pub(super) normal_step: Vec<[f64; 1]>,
    pub(super) tangential_step: Vec<[f64; 3]>,
}

impl System {
    /// Orders and analyses the matrices from connectivity, and factors `G`.
    pub(crate) fn new(problem: &Problem<'_>) -> Self {
        Self::by_means(problem, Means::of(problem.domain.region.free))
    }

    /// The same with this way to solve with `P`.
    pub(crate) fn by_means(problem: &Problem<'_>, means: Means) -> Self {
        let Domain {
            region,
            rings,
            batches,
            ..
        } = &**problem.domain;
        let weights = problem.weights;
        let graph = rings.graph();
        let ((symbolic, g_values), graded) = parallel::join(
            || {
                let order = {
                    let _clock = clock("orders");
                    fill_reducing(&graph, &graph, 1, None)
                };
                let values = laplacian(&graph, rings, batches, weights);
                let _clock = clock("symbolic");
                (Arc::new(Symbolic::new(&graph, &order)), values)
            },
            || {
                let mesh = (means == Means::Plate)
                    .then(|| Plate::mesh(region, rings))
                    .flatten();
                mesh.ok_or_else(|| Box::new(NormalMatrix::by_factor(rings, &graph)))
            },
        );
        let p = match graded {
            Ok(mesh) => NormalMatrix::by_plate(mesh, rings, &symbolic),
            Err(factored) => *factored,
        };
        let mut g = Factor::new(&symbolic, false);
        let mut stacks = Stacks::default();
        // Convex weights make G an irreducible M-matrix with a fixed vertex in every component: it is positive
        // definite, and a failure here would show in the first membrane as a collapsed surface.
        {
            let _clock = clock("factor G");
            let _ = g.factor(&g_values, &mut stacks);
        }
        let free = region.free;
        Self {
            domain: problem.domain.clone(),
            asked: Formulation {
                right_hand_side: problem.right_hand_side,
                weights: weights.clone(),
                of_surface: false,
                along_normals: false,
            },
            asked_continuity: problem.continuity.cloned(),
            curvature: problem.curvature,
            boundary_normals: problem.boundary_normals.to_vec(),
            smooth_interior: problem.smooth_interior.to_vec(),
            state: State::new(batches, region.boundary),
            metric: Metric::default(),
            diagonal: 1.0,
            graph,
            graph_symbolic: symbolic,
            continuity: None,
            g,
            weights: weights.clone(),
            p,
            stacks,
            normal_step: vec![[0.0]; free],
            tangential_step: vec![[0.0; 3]; free],
        }
    }

    /// Asks for other boundary normals from now on, and says where the surface passes smoothly instead.
    pub(crate) fn prescribe(&mut self, normals: Vec<Vector3<f64>>, smooth_interior: Vec<bool>) {
        self.boundary_normals = normals;
        self.smooth_interior = smooth_interior;
    }

    /// The same region, with its fixed vertices elsewhere.
    pub(crate) fn take_domain(&mut self, domain: &Arc<Domain>) {
        self.domain = domain.clone();
    }

    /// Asks for another right-hand side from now on.
    pub(crate) fn ask_right_hand_side(&mut self, right_hand_side: RightHandSide) {
        self.asked.right_hand_side = right_hand_side;
    }

    /// What is asked for, spread by the mean-value weights of a surface, which is so its solution already.
    pub(crate) fn spread_as(&self, x: &[Vector3<f64>]) -> Formulation {
        Formulation {
            of_surface: true,
            ..self
                .asked()
                .weighted(FairnessWeights::mean_value(&self.domain.batches, x).into())
        }
    }

    /// What is asked for, spread as the triangles of the input are, where it is to be uniform.
    pub(crate) fn spread_as_input(&self) -> Option<Formulation> {
        let domain = &self.domain;
        let weights = || FairnessWeights::conformal(&domain.batches, domain.surface());
        self.asked().weights.slots.is_none().then(|| Formulation {
            of_surface: true,
            ..self.asked().weighted(weights().into())
        })
    }

    /// What is asked for.
    pub(crate) fn asked(&self) -> &Formulation {
        &self.asked
    }

    /// Whether another right-hand side than zero is asked for.
    pub(crate) fn asks_for_target(&self) -> bool {
        !self.asked.right_hand_side.is_zero()
    }

    /// Factors `G` with these weights, if it is not.
    pub(super) fn factor_inner(&mut self, weights: &Arc<FairnessWeights>) -> Result<(), Collapsed> {
        if Arc::ptr_eq(&self.weights, weights) {
            return Ok(());
        }
        let Domain { rings, batches, .. } = &*self.domain;
        let values = laplacian(&self.graph, rings, batches, weights);
        self.weights = weights.clone();
        let _clock = clock("factor G");
        self.g.factor(&values, &mut self.stacks).map_err(|_| Collapsed)
    }

    /// The boundary normals in force.
    pub(crate) fn boundary_normals(&self) -> &[Vector3<f64>] {
        &self.boundary_normals
    }

    /// What is asked, on this mesh.
    pub(crate) fn problem(&self) -> Problem<'_> {
        Problem {
            continuity: None,
            domain: &self.domain,
            boundary_normals: &self.boundary_normals,
            smooth_interior: &self.smooth_interior,
            weights: &self.asked.weights,
            weigh: None,
            curvature: self.curvature,
            right_hand_side: self.asked.right_hand_side,
        }
    }

    /// The last evaluation.
    pub(crate) fn state(&self) -> &State {
        &self.state
    }

    /// Takes the last evaluation away.
    pub(crate) fn into_state(self) -> State {
        self.state
    }

    /// The region.
    pub(crate) fn region(&self) -> &RegionMesh {
        &self.domain.region
    }

    /// Number of free vertices.
    pub(crate) fn free(&self) -> usize {
        self.domain.region.free
    }

    /// The equations.
    pub(crate) fn equations<'s>(&'s self, formulation: &'s Formulation) -> Equations<'s> {
        Equations {
            rings: &self.domain.rings,
            batches: &self.domain.batches,
            boundary_normals: &self.boundary_normals,
            smooth_interior: &self.smooth_interior,
            weights: &formulation.weights,
            curvature: self.curvature,
            right_hand_side: formulation.right_hand_side,
        }
    }

    /// Three times the area of the surface evaluated last: that of all 1-disks.
    pub(crate) fn area(&self) -> f64 {
        self.state.area.iter().sum()
    }

    /// Defect of the outer equation at the last evaluation, without unit.
    pub(crate) fn defect(&self, formulation: &Formulation) -> f64 {
        self.equations(formulation).defect(&self.state).0 * self.diagonal
    }

    /// The surface `x`, which was evaluated last, to be judged.
    pub(crate) fn surface<'s>(&'s self, x: &'s [Vector3<f64>]) -> SurfaceState<'s> {
        SurfaceState {
            region: self.region(),
            x,
            normals: &self.state.corrected,
            boundary_normals: &self.boundary_normals,
            h: &self.state.h,
        }
    }

    /// Region triangles (local numbers) that are folded or have an angle below `degrees` at `x`, which was evaluated
    /// last.
    pub(crate) fn poor(&self, x: &[Vector3<f64>], degrees: f64) -> Vec<u32> {
        let _clock = clock("poor triangles, judging");
        self.surface(x).poor(degrees)
    }

    /// Evaluates both equations at `x` ((4), 7.3).
    pub(crate) fn evaluate(&mut self, x: &[Vector3<f64>], formulation: &Formulation) {
        let mut state = std::mem::take(&mut self.state);
        self.equations(formulation).evaluate(x, &mut state);
        self.state = state;
        self.evaluate_continuity(x, formulation);
        self.take_smooth_interior_normals();
    }

    fn take_smooth_interior_normals(&mut self) {
        let (_, current) = self.state.corrected.split_at(self.domain.region.free);
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
    pub(crate) fn evaluate_inner(&mut self, x: &[Vector3<f64>], formulation: &Formulation) {
        let mut state = std::mem::take(&mut self.state);
        self.equations(formulation).evaluate_inner(x, &mut state);
        self.state = state;
    }

    /// Evaluates at `x`, and makes `P` from that.
    pub(crate) fn rebuild(&mut self, x: &[Vector3<f64>], formulation: &Formulation) -> Result<(), Collapsed> {
        let mut state = std::mem::take(&mut self.state);
        self.equations(formulation).evaluate_with_response(x, &mut state);
        self.state = state;
        self.evaluate_continuity(x, formulation);
        self.take_smooth_interior_normals();
        let mut metric = std::mem::take(&mut self.metric);
        metric.update(&self.equations(formulation), x, &self.state);
        self.metric = metric;
        let made = self.refactor_at(Some(x));
        let made = made.and_then(|()| self.prepare_continuity(formulation));
        // The next one is far off, and the iterations need the memory.
        if self.free() > LARGE {
            self.stacks = Stacks::default();
        }
        made
    }

    /// Makes `P` of the metric that is there.
    pub(crate) fn refactor(&mut self) -> Result<(), Collapsed> {
        self.refactor_at(None)
    }

    fn refactor_at(&mut self, x: Option<&[Vector3<f64>]>) -> Result<(), Collapsed> {
        let rings = &self.domain.rings;
        self.p
            .factor(&self.metric, rings, x, &self.graph, &mut self.stacks)
    }

    /// Goes over to a 64-bit factor of the same matrix.
    pub(crate) fn refactor_double(&mut self) -> Result<(), Collapsed> {
        let rings = &self.domain.rings;
        self.p
            .factor_double(&self.metric, rings, &self.graph, &mut self.stacks)
    }

    /// Whether `P` is factored in 64 bits.
    pub(crate) fn is_double(&self) -> bool {
        self.p.is_double()
    }

    /// Whether `P` is solved with by the plate.
    #[cfg(test)]
    pub(crate) fn is_by_plate(&self) -> bool {
        self.p.is_by_plate()
    }

    /// Solves with `P`.
    pub(crate) fn solve_p<const K: usize>(&mut self, x: &mut [[f64; K]]) {
        let _clock = clock("start: solves with P");
        self.p.solve(x);
    }
}
