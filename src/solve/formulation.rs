//! Which equations an attempt solves: those that are asked for, or others near them.

use std::sync::Arc;

use crate::discrete::inner_fairness::FairnessWeights;
use crate::discrete::target::RightHandSide;

/// What an attempt varies of the problem. Boundary data and curvature are always those that are asked for.
#[derive(Debug, Clone)]
pub(crate) struct Formulation {
    /// What `Delta_B H` has to be.
    pub right_hand_side: RightHandSide,
    /// Inner fairness (7.3).
    pub weights: Arc<FairnessWeights>,
    /// They are those of a surface, that of least bending or the input's, in place of those that are asked for.
    pub of_surface: bool,
    /// Steps have no tangential part: inner fairness is not asked for.
    pub along_normals: bool,
}

impl Formulation {
    /// Whether no vertex is spread as asked.
    pub(crate) fn spreads_otherwise(&self) -> bool {
        self.of_surface || self.along_normals
    }

    /// The same with the member `w` of the family between the harmonic equation and minimal energy.
    pub(crate) fn member(&self, w: f64) -> Self {
        Self {
            right_hand_side: RightHandSide {
                constant: 0.0,
                energy: w,
            },
            ..self.clone()
        }
    }

    /// The same with a part of the right-hand side, from 0 to 1.
    pub(crate) fn part(&self, part: f64) -> Self {
        let right_hand_side = if part >= 1.0 {
            self.right_hand_side
        } else if part > 0.0 {
            self.right_hand_side.share(part)
        } else {
            RightHandSide::default()
        };
        Self {
            right_hand_side,
            ..self.clone()
        }
    }

    /// The same with these weights.
    pub(crate) fn weighted(&self, weights: Arc<FairnessWeights>) -> Self {
        Self {
            weights,
            ..self.clone()
        }
    }
}
