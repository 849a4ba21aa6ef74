//! Other inner fairness where the asked one folds or leads nowhere: convex at the notches of a jagged boundary, where uniform weights fold
//! triangles; that of the input where most triangles are stretched.

use std::sync::Arc;

use nalgebra::Vector3;

use super::candidate::Candidate;
use super::control::Control;
use super::formulation::Formulation;
use super::iterate_options::{IterateOptions, IterationStatus};
use super::system::System;
use super::untangle::untangle;
use crate::discrete::inner_fairness::FairnessWeights;
use crate::quality::NEEDLE;
use crate::solve::transition::Transition;

/// Triangles below this angle mark their vertices, round by round; each round also takes one ring more.
/// Of 125 cases, half: 12 change by up to 3 edges, 1 get another triangulation, -2 % iterations;
/// double: 23 change by up to 4 edges, 3 get another triangulation, -3 % iterations, 1 more succeeds.
const THRESHOLDS: [f64; 3] = [3.0, 4.0, 5.0];

/// A start from the coarse mesh with a triangle below this angle, half of a needle's, will end with it: it lies almost as the result
/// will, but the bound must not decide by the vertices' numbers.
/// Half or double, of 33 cases: none changes.
const SURE: f64 = 0.5 * NEEDLE;

/// An iteration that begins anew with other weights where triangles end folded or thin.
#[derive(Debug)]
pub(crate) struct WeightRepair {
    /// With the weights of the last round.
    formulation: Formulation,
    options: IterateOptions,
    marks: Marks,
    /// Needles of the start that no weights widen; `None`: there are none, or they are widened.
    stubborn_needles: Option<usize>,
    best: Option<Candidate>,
}

impl WeightRepair {
    /// Iterates from `x`.
    pub(crate) fn begin(
        mut formulation: Formulation,
        mut x: Vec<Vector3<f64>>,
        options: IterateOptions,
        anew: Anew,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> (Self, Transition) {
        let surface = (anew == Anew::FromSurface).then(|| x.clone());
        let mut marks = Marks::new(system, &formulation, surface);
        system.evaluate(&x, &formulation);
        let needles = system.poor(&x, NEEDLE).len();
        let mut stubborn_needles = None;
        // A start is distributed almost as the result will be: what folds here would be found after the iterations.
        let repairs_start = match anew {
            Anew::FromLinear => !system.poor(&x, THRESHOLDS[0]).is_empty(),
            Anew::FromSurface => !system.poor(&x, SURE).is_empty(),
        };
        if repairs_start
            && let Some((start, repaired)) = marks.restart(&x, &formulation, system, control)
            && !control.cancelled
        {
            system.evaluate(&start, &repaired);
            if needles > 0 && system.poor(&start, NEEDLE).len() >= needles {
                stubborn_needles = Some(needles);
            } else {
                (x, formulation) = (start, repaired);
            }
        }
        let repair = Self {
            formulation,
            options,
            marks,
            stubborn_needles,
            best: None,
        };
        let next = repair.iterate(x, stubborn_needles.is_none(), system, control);
        (repair, next)
    }

    /// After an iteration that led to `last`: the next round of repairs, if there is something to repair.
    pub(crate) fn next(
        &mut self,
        mut last: Candidate,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Transition {
        match self.best.take() {
            None => {
                if self
                    .stubborn_needles
                    .is_some_and(|needles| last.has_only_needles(system, needles))
                {
                    last.needles_from_input = true;
                    return Transition::Done(last);
                }
                self.best = Some(last.clone());
            }
            Some(_) if last.is_stopped() => return Transition::Done(last),
            Some(best) if last.rank() < best.rank() => self.best = Some(last.clone()),
            best => self.best = best,
        }
        let is_repairable = matches!(last.status, IterationStatus::Converged | IterationStatus::Folded);
        let restarted = if is_repairable && !last.poor.is_empty() {
            self.marks.restart(&last.x, &self.formulation, system, control)
        } else if !is_repairable && !last.is_stopped() {
            self.marks.restart_as_input(&self.formulation, system, control)
        } else {
            None
        };
        let best = self.best.take().unwrap_or(last);
        match restarted {
            None => Transition::Done(best),
            Some(_) if control.cancelled => Transition::Done(Candidate {
                status: IterationStatus::Stopped,
                ..best
            }),
            Some((start, repaired)) => {
                (self.best, self.formulation) = (Some(best), repaired);
                self.iterate(start, self.marks.has_more(), system, control)
            }
        }
    }

    fn iterate(
        &self,
        x: Vec<Vector3<f64>>,
        stop_on_folds: bool,
        system: &System,
        control: &Control<'_>,
    ) -> Transition {
        let options = IterateOptions {
            stop_on_folds,
            ..self.options
        };
        Transition::iterate(system, self.formulation.clone(), x, options, control)
    }
}

/// Where an iteration with repaired weights begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anew {
    /// At the linear surface with these weights.
    FromLinear,
    /// At the first one, spread by these weights.
    FromSurface,
}

/// Vertices marked so far.
#[derive(Debug)]
struct Marks {
    /// The surface to begin at; `None`: the linear one.
    surface: Option<Vec<Vector3<f64>>>,
    /// The weights before any repair.
    asked: Arc<FairnessWeights>,
    marked: Vec<bool>,
    round: usize,
}

impl Marks {
    /// Nothing marked.
    fn new(system: &System, formulation: &Formulation, surface: Option<Vec<Vector3<f64>>>) -> Self {
        Self {
            surface,
            asked: formulation.weights.clone(),
            marked: vec![false; system.free()],
            round: 0,
        }
    }

    /// The start surface with the weights of the next round, and those.
    fn restart(
        &mut self,
        x: &[Vector3<f64>],
        formulation: &Formulation,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Option<(Vec<Vector3<f64>>, Formulation)> {
        let weights = self.next(system, formulation, x)?;
        let repaired = formulation.weighted(weights.into());
        system.factor_inner(&repaired.weights).ok()?;
        let start = match &self.surface {
            None => system.start(&repaired, control).ok()?,
            Some(surface) => {
                let mut x = surface.clone();
                system.tangential_steps(&mut x, &repaired, control);
                x
            }
        };
        Some((start, repaired))
    }

    /// The linear surface with the weights of the input, and those, where uniform ones have led nowhere and the input's triangles are stretched.
    fn restart_as_input(
        &mut self,
        formulation: &Formulation,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Option<(Vec<Vector3<f64>>, Formulation)> {
        // Repairs that have begun at the start go on.
        let is_due = self.surface.is_none() && self.round == 0 && self.asked.slots.is_none();
        if !is_due || !system.domain.is_stretched() {
            return None;
        }
        let as_input = Formulation {
            right_hand_side: formulation.right_hand_side,
            ..system.spread_as_input()?
        };
        *self = Self::new(system, &as_input, None);
        system.factor_inner(&as_input.weights).ok()?;
        let start = system.start(&as_input, control).ok()?;
        Some((start, as_input))
    }

    /// Marks the vertices of poor triangles at `x` and gives them the mean-value weights of better places in their rings:
    /// like everything here, taken from connectivity and boundary alone and not from the input's interior. `None` when
    /// there is nothing left to try.
    fn next(
        &mut self,
        system: &mut System,
        formulation: &Formulation,
        x: &[Vector3<f64>],
    ) -> Option<FairnessWeights> {
        let threshold = *THRESHOLDS.get(self.round)?;
        self.round += 1;
        system.evaluate(x, formulation);
        for t in system.poor(x, threshold) {
            for v in system.domain.region.half_edges.triangles[t as usize] {
                if (v as usize) < system.free() {
                    self.marked[v as usize] = true;
                }
            }
        }
        for _ in 1..self.round {
            self.grow(system);
        }
        let mut better = x.to_vec();
        let domain = &system.domain;
        untangle(&domain.region, &domain.rings, &self.marked, &mut better);
        let mut weights = FairnessWeights::clone(&self.asked);
        for i in (0..system.free()).filter(|&i| self.marked[i]) {
            weights.set_mean_value(&system.domain.batches, &better, i);
        }
        Some(weights)
    }

    /// Whether another round would be left after this one.
    fn has_more(&self) -> bool {
        self.round < THRESHOLDS.len()
    }

    fn grow(&mut self, system: &System) {
        let before = self.marked.clone();
        for i in (0..system.free()).filter(|&i| before[i]) {
            for &j in system.domain.rings.ring(i) {
                if (j as usize) < system.free() {
                    self.marked[j as usize] = true;
                }
            }
        }
    }
}
