//! What the equation says about the extent of `H` inside, as a guard against bumps: surfaces that satisfy the discrete
//! equations, but no smooth one does.

use super::formulation::Formulation;
use super::system::System;
use crate::discrete::equations::State;
use crate::discrete::target::RightHandSide;
use crate::solve::g2::equations::Continuity;

/// The largest `|H|` inside, against the boundary's.
/// Of 126 cases, half: 82 change by up to 4e-4 edges, +130 % iterations, 87 fail; double: none changes.
const OVERSHOOT: f64 = 1.05;
/// Curvatures below this, times the diagonal, count as none.
/// Half or double, of 126 cases: none changes.
const OVERSHOOT_FLOOR: f64 = 0.1;
/// The most that a 1-disk may hold of the total curvature `kappa_1^2 + kappa_2^2` (paper (1)): on a sphere of equilateral
/// triangles that is a turn of 50 degrees along every edge.
/// Of 46 cases, half: 2 change, 1 get another triangulation, 1 fails; double: 2 change, -1 % iterations, 1 fails, 1 more succeeds.
const TOTAL_CURVATURE: f64 = 4.0;

impl System {
    /// [`Judged::overshoots`] at the last evaluation.
    pub(crate) fn overshoots(&self, formulation: &Formulation) -> bool {
        let judged = Judged {
            state: self.state(),
            right_hand_side: formulation.right_hand_side,
            phi: self.continuity().map_or(&[], Continuity::phi),
            diagonal: self.diagonal,
        };
        judged.overshoots()
    }
}

/// A surface and the equation that it should satisfy.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Judged<'a> {
    /// Evaluated at the surface.
    pub state: &'a State,
    /// What `Delta_B H` should be.
    pub right_hand_side: RightHandSide,
    /// What it should be besides, at the vertices of the region, where the curvature of the surroundings is continued; empty: nothing.
    pub phi: &'a [f64],
    /// The region's diagonal.
    pub diagonal: f64,
}

impl Judged<'_> {
    fn free(&self) -> usize {
        self.state.k.len()
    }

    /// Whether `H` inside exceeds what the equation allows, and the discretization besides.
    pub(crate) fn overshoots(&self) -> bool {
        let right = &self.right_hand_side;
        if right.energy != 0.0 {
            self.is_unresolved()
        } else if self.phi.iter().any(|phi| *phi != 0.0) {
            let [low, high] = range(self.phi.iter().map(|phi| phi + right.constant));
            self.is_unresolved() || self.overshoots_loads([low, high])
        } else if right.constant != 0.0 {
            self.overshoots_load(right.constant)
        } else {
            self.overshoots_boundary()
        }
    }

    /// Harmonic functions have their extrema on the boundary.
    fn overshoots_boundary(&self) -> bool {
        let largest = |h: &[f64]| h.iter().fold(0.0f64, |m, h| m.max(h.abs()));
        let (inside, boundary) = self.state.h.split_at(self.free());
        largest(inside) > OVERSHOOT * largest(boundary) + OVERSHOOT_FLOOR / self.diagonal
    }

    /// With `Delta_B H = c > 0` the maximum still is on the boundary. The minimum is lower than there by at most `c` times
    /// the largest `u` with `-Delta_B u = 1` and no boundary value, for which that of a strip as wide as the diagonal is
    /// taken, `L^2 / 8`: no domain in a plane or on a cylinder between two planes `L` apart has a larger one.
    fn overshoots_load(&self, c: f64) -> bool {
        let (inside, boundary) = self.state.h.split_at(self.free());
        let upward = c.signum();
        let range = |h: &[f64]| {
            h.iter()
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], h| {
                    [low.min(upward * h), high.max(upward * h)]
                })
        };
        let ([low, high], [boundary_low, boundary_high]) = (range(inside), range(boundary));
        let slack =
            (OVERSHOOT - 1.0) * boundary_low.abs().max(boundary_high.abs()) + OVERSHOOT_FLOOR / self.diagonal;
        let dip = c.abs() * self.diagonal * self.diagonal / 8.0;
        high > boundary_high + slack || low < boundary_low - dip - slack
    }

    /// The same of `Delta_B H` between these bounds, that may have both signs.
    fn overshoots_loads(&self, [least, most]: [f64; 2]) -> bool {
        let (inside, boundary) = self.state.h.split_at(self.free());
        let ([low, high], [boundary_low, boundary_high]) =
            (range(inside.iter().copied()), range(boundary.iter().copied()));
        let slack =
            (OVERSHOOT - 1.0) * boundary_low.abs().max(boundary_high.abs()) + OVERSHOOT_FLOOR / self.diagonal;
        let dip = |load: f64| load.max(0.0) * self.diagonal * self.diagonal / 8.0;
        high > boundary_high + dip(-least) + slack || low < boundary_low - dip(most) - slack
    }

    /// Surfaces of minimal energy obey no maximum principle: a strip bent round is curved most in its middle. But where a
    /// single 1-disk holds much of the energy, the surface is none that the mesh can tell.
    fn is_unresolved(&self) -> bool {
        let state = self.state;
        (0..self.free()).any(|i| {
            let h = state.h[i];
            state.area[i] * (4.0 * h * h - 2.0 * state.k[i]) > TOTAL_CURVATURE
        })
    }
}

/// The smallest and the largest.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| {
        [low.min(v), high.max(v)]
    })
}
