//! The further unknowns of curvature continuity, while they are.

use std::sync::Arc;

use nalgebra::Vector3;

use crate::discrete::equations::Equations;
use crate::solve::factor::Collapsed;
use crate::solve::formulation::Formulation;
use crate::solve::g2::boundary_curvature::{AskedContinuity, LoopCondition};
use crate::solve::g2::equations::Continuity;
use crate::solve::system::System;

impl System {
    /// The continuity of curvature that is asked for.
    pub(in crate::solve) fn asked_continuity(&self) -> Option<Arc<AskedContinuity>> {
        self.asked_continuity.clone()
    }

    /// Asks for another continuity of curvature from now on.
    pub(crate) fn ask_continuity(&mut self, asked: Option<Arc<AskedContinuity>>) {
        self.asked_continuity = asked;
    }

    /// Takes the curvatures along the loops as conditions, until [`System::end_continuity`].
    pub(in crate::solve) fn set_continuity(&mut self, loops: Vec<LoopCondition>) {
        let size = (self.free(), self.region().boundary);
        self.continuity = Some(Box::new(Continuity::new(loops, &self.graph_symbolic, size)));
    }

    /// Back to tangent continuity. Returns what held along the loops.
    pub(in crate::solve) fn end_continuity(&mut self) -> Option<Vec<LoopCondition>> {
        self.continuity.take().map(|continuity| continuity.loops)
    }

    /// The further unknowns, where they are.
    pub(in crate::solve) fn continuity(&self) -> Option<&Continuity> {
        self.continuity.as_deref()
    }

    /// How many modes are unknowns.
    pub(in crate::solve) fn modes(&self) -> usize {
        self.continuity().map_or(0, Continuity::modes)
    }

    /// Takes these coefficients of the modes, zero where there are fewer.
    pub(in crate::solve) fn set_modes(&mut self, values: &[f64]) {
        if let Some(continuity) = &mut self.continuity {
            let mut all = values.to_vec();
            all.resize(continuity.modes(), 0.0);
            continuity.set(&all);
        }
    }

    /// Sets out for a part of the way to the surroundings' curvature, for each loop its own.
    pub(in crate::solve) fn aim(&mut self, parts: &[f64]) {
        if let Some(continuity) = &mut self.continuity {
            let loops = continuity.loops.iter_mut().zip(parts);
            loops.for_each(|(l, part)| l.aim(*part));
        }
    }

    pub(super) fn evaluate_continuity(&mut self, x: &[Vector3<f64>], formulation: &Formulation) {
        if let Some(mut continuity) = self.continuity.take() {
            let mut state = std::mem::take(&mut self.state);
            continuity.evaluate(&self.equations(formulation), x, &mut state);
            self.state = state;
            self.continuity = Some(continuity);
        }
    }

    pub(super) fn prepare_continuity(&mut self, formulation: &Formulation) -> Result<(), Collapsed> {
        let Some(mut continuity) = self.continuity.take() else {
            return Ok(());
        };
        let state = std::mem::take(&mut self.state);
        let domain = self.domain.clone();
        let equations = Equations {
            rings: &domain.rings,
            batches: &domain.batches,
            boundary_normals: &self.boundary_normals,
            smooth_interior: &self.smooth_interior,
            weights: &formulation.weights,
            curvature: self.curvature,
            right_hand_side: formulation.right_hand_side,
        };
        let made = continuity.prepare(
            &equations,
            (&state, &self.metric),
            (&self.graph, &mut self.p, &mut self.stacks),
        );
        self.state = state;
        self.continuity = Some(continuity);
        made
    }
}
