//! Convex inner fairness where the asked one folds: uniform weights invert triangles at the notches of a jagged boundary.

use nalgebra::Vector3;

use super::system::System;
use super::untangle::untangle;
use crate::discrete::inner_fairness::FairnessWeights;

/// Triangles below this angle mark their vertices, round by round; each round also takes one ring more.
pub(crate) const THRESHOLDS: [f64; 3] = [3.0, 4.0, 5.0];

/// Vertices marked so far.
#[derive(Debug)]
pub(crate) struct Repair {
    asked: FairnessWeights,
    marked: Vec<bool>,
    round: usize,
}

impl Repair {
    /// Nothing marked; the system's weights are the asked ones.
    pub(crate) fn new(system: &System<'_>) -> Self {
        Self {
            asked: system.weights.clone(),
            marked: vec![false; system.free()],
            round: 0,
        }
    }

    /// Marks the vertices of poor triangles at `x` and gives them the mean-value weights of better places in their rings:
    /// like everything here, taken from connectivity and boundary alone and not from the input's interior. `None` when
    /// there is nothing left to try.
    pub(crate) fn next(&mut self, system: &mut System<'_>, x: &[Vector3<f64>]) -> Option<FairnessWeights> {
        let threshold = *THRESHOLDS.get(self.round)?;
        self.round += 1;
        system.evaluate(x);
        for t in system.poor(x, threshold) {
            for v in system.region.half_edges.triangles[t as usize] {
                if (v as usize) < system.free() {
                    self.marked[v as usize] = true;
                }
            }
        }
        for _ in 1..self.round {
            self.grow(system);
        }
        let mut better = x.to_vec();
        untangle(system.rings, &self.marked, &mut better);
        let mut weights = self.asked.clone();
        for i in (0..system.free()).filter(|&i| self.marked[i]) {
            weights.set_mean_value(system.batches, &better, i);
        }
        Some(weights)
    }

    /// Whether another round would be left after this one.
    pub(crate) fn has_more(&self) -> bool {
        self.round < THRESHOLDS.len()
    }

    fn grow(&mut self, system: &System<'_>) {
        let before = self.marked.clone();
        for i in (0..system.free()).filter(|&i| before[i]) {
            for &j in system.rings.ring(i) {
                if (j as usize) < system.free() {
                    self.marked[j as usize] = true;
                }
            }
        }
    }
}
