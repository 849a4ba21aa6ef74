//! From a sound surface that was found with another inner fairness to the one that is asked for: the shape is one of the boundary alone, and
//! the vertices lie as asked, wherever they can.

use nalgebra::Vector3;

use super::bending::Bending;
use super::candidate::{BENDS_MORE, Candidate};
use super::control::Control;
use super::descent::SECOND;
use super::formulation::Formulation;
use super::iterate_options::{IterateOptions, IterationStatus};
use super::system::System;
use super::weight_repair::{Anew, WeightRepair};
use crate::solve::transition::Transition;

/// The attempt with other weights, and what it has led to.
#[derive(Debug)]
pub(crate) struct Regain {
    repair: WeightRepair,
    options: IterateOptions,
    /// Where it began, until it has begun further down.
    start: Option<Vec<Vector3<f64>>>,
    found: Option<Candidate>,
}

impl Regain {
    /// Iterates from `x` with the weights of `formulation`.
    pub(crate) fn begin(
        formulation: Formulation,
        x: Vec<Vector3<f64>>,
        options: IterateOptions,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> (Self, Transition) {
        let start = system.domain.is_stretched().then(|| x.clone());
        let (repair, next) = WeightRepair::begin(formulation, x, options, Anew::FromSurface, system, control);
        let regain = Self {
            repair,
            options,
            start,
            found: None,
        };
        (regain, next)
    }

    /// After an iteration that led to `last`: of two sound surfaces the one as asked.
    pub(crate) fn next(
        &mut self,
        last: Candidate,
        system: &mut System,
        control: &mut Control<'_>,
    ) -> Transition {
        match (self.repair.next(last, system, control), self.found.take()) {
            (Transition::Done(last), Some(found)) => {
                let bending = Bending::new(&system.domain, system.boundary_normals(), 0.0);
                let is_regained =
                    last.is_sound() && bending.bends(&last.x) <= BENDS_MORE * bending.bends(&found.x);
                Transition::Done(if is_regained { last } else { found })
            }
            (Transition::Done(found), None) if found.is_sound() => {
                let (asked, mut x) = (system.asked().clone(), found.x.clone());
                // `P` is made of vertices about where they will lie.
                system.tangential_steps(&mut x, &asked, control);
                self.found = Some(found);
                let (repair, next) =
                    WeightRepair::begin(asked, x, self.options, Anew::FromSurface, system, control);
                self.repair = repair;
                next
            }
            (Transition::Done(failed), None) if failed.status == IterationStatus::Stalled => self
                .begin_further_down(system, control)
                .unwrap_or(Transition::Done(failed)),
            (next, found) => {
                self.found = found;
                next
            }
        }
    }

    /// Once more where triangles are stretched, from a surface of less bending energy.
    fn begin_further_down(&mut self, system: &mut System, control: &mut Control<'_>) -> Option<Transition> {
        let asked = system.asked().clone();
        let x = system
            .descend(self.start.take()?, &SECOND, &asked, control)
            .ok()?;
        let formulation = system.spread_as(&x);
        let (repair, next) =
            WeightRepair::begin(formulation, x, self.options, Anew::FromSurface, system, control);
        self.repair = repair;
        Some(next)
    }
}
