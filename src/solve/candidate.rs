//! What an attempt has led to, and how good it is.

use nalgebra::Vector3;

use super::formulation::Formulation;
use super::iterate_options::IterationStatus;
use super::result::TrialEnd;
use super::rivals::may_have_rival;
use super::system::System;
use crate::discrete::equations::State;
use crate::quality::NEEDLE;
use crate::quality::crease::{creases_by_outside, kinks_as_given};
use crate::quality::folds::Folds;
use crate::support::profile::clock;

/// A step norm that only rounding keeps from falling, in diagonals: it grows with the number of vertices.
/// Half or double, of 27 cases: none changes.
const ROUNDING_FLOOR: f64 = 1e-9;

/// As asked, edges bend by no more than so many times as much, in squares: where triangles are stretched, uniform weights fold them. Of 70 such
/// bands one ends off its surface by a hundredth of the radius at 1.6 times. Of 244 regions, half or double: as many succeed.
pub(crate) const BENDS_MORE: f64 = 1.5;
/// Of two surfaces the later one is taken if its bending energy is less by this part.
/// Half or double, of 16 cases: none changes.
const LESS_ENERGY: f64 = 1e-3;

/// There may be a poor triangle for so many vertices in a surface that is only somewhere to begin.
/// Half or double, of 2 cases: none changes.
const POOR_OF_START: usize = 100;

/// A surface that an iteration has led to.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    /// The surface.
    pub x: Vec<Vector3<f64>>,
    /// How the iteration ended.
    pub status: IterationStatus,
    /// Its step norm.
    pub step: f64,
    /// What it solves, and what spreads its vertices.
    pub formulation: Formulation,
    /// Its poor triangles (local numbers).
    pub poor: Vec<u32>,
    /// Its mean curvature inside exceeds what the equation allows ([`super::curvature_bounds`]).
    pub curvature_overshoot: bool,
    /// It stands off single boundary normals far more than off the others.
    pub detached_from_normals: bool,
    /// At so many edges it folds ([`crate::quality::folds`]).
    pub folds: usize,
    /// At so many boundary vertices it has a crease ([`crate::quality::crease`]), going by the outside, not by the interior of the input.
    pub creases: usize,
    /// So many boundary normals are told to be probably flipped, by what this surface is beside them.
    pub suspicious_normals: usize,
    /// Its bending energy, the integral of `H^2`.
    pub bending_energy: f64,
    /// There may be another surface that solves the same ([`super::rivals`]).
    pub may_have_rival: bool,
    /// All that is wrong are needles that the start has, too, and that no repair of the weights widens: they come from the
    /// connectivity, such as at the pole of a sphere with hundreds of meridians. No other attempt would end without.
    pub needles_from_input: bool,
}

impl Candidate {
    /// Evaluates and judges `x`, at which an iteration ended.
    pub(crate) fn new(
        system: &mut System,
        formulation: &Formulation,
        x: Vec<Vector3<f64>>,
        status: IterationStatus,
        step: f64,
    ) -> Self {
        system.evaluate(&x, formulation);
        let _clock = clock("poor triangles, judging");
        let surface = system.surface(&x);
        let domain = &system.domain;
        Self {
            bending_energy: bending_energy(system.state()),
            may_have_rival: may_have_rival(&x, system.state(), &domain.rings),
            creases: creases_by_outside(&kinks_as_given(&surface, &domain.rings, &domain.input)),
            folds: Folds {
                surface: &surface,
                k: &system.state().k,
                rings: &domain.rings,
                input: &domain.input,
            }
            .found()
            .len(),
            suspicious_normals: surface.suspicious_normals(&domain.rings, &domain.input).len(),
            status,
            step,
            formulation: formulation.clone(),
            poor: surface.poor(NEEDLE),
            curvature_overshoot: system.overshoots(formulation),
            detached_from_normals: surface.is_detached_from_normals(),
            needles_from_input: false,
            x,
        }
    }

    /// The coarse equations admit it, but no smooth surface has it.
    pub(crate) fn has_bump(&self) -> bool {
        self.curvature_overshoot || self.detached_from_normals || self.folds > 0
    }

    /// Something may be better. Whether a crease is told is decided at the end, by the input as well.
    pub(crate) fn is_flawed(&self) -> bool {
        self.has_bump() || self.creases > 0
    }

    /// Tolerance met.
    pub(crate) fn is_converged(&self) -> bool {
        self.status == IterationStatus::Converged
    }

    /// Sound, and as near to the solution as rounding lets it come: it stalled above the tolerance, but far below any step
    /// that could be seen.
    pub(crate) fn is_at_rounding(&self) -> bool {
        let is_near = self.status == IterationStatus::Stalled && self.step < ROUNDING_FLOOR;
        is_near && self.poor.is_empty() && !self.is_flawed()
    }

    /// Limit or cancel.
    pub(crate) fn is_stopped(&self) -> bool {
        self.status == IterationStatus::Stopped
    }

    /// Converged, with sound triangles, and no flaw.
    pub(crate) fn is_sound(&self) -> bool {
        self.is_converged() && self.poor.is_empty() && !self.is_flawed()
    }

    /// How the attempt that has led here ended.
    pub(crate) fn end(&self) -> TrialEnd {
        match self.status {
            IterationStatus::Stopped => TrialEnd::Stopped,
            IterationStatus::Converged if self.is_sound() => TrialEnd::Sound,
            IterationStatus::Converged => TrialEnd::Unsound,
            _ => TrialEnd::Unconverged,
        }
    }

    /// The smaller the better.
    pub(crate) fn rank(&self) -> (bool, usize, bool, usize) {
        (
            !self.is_converged(),
            self.poor.len(),
            self.is_flawed(),
            self.creases,
        )
    }

    /// Of two sound surfaces the one of less bending energy is the better one, unless it turns away from boundary normals, or has the weights of
    /// the surface of least bending: on coarse meshes these alone change the energy by a third, so that it has to be less by more ([`BENDS_MORE`]).
    pub(crate) fn is_better_than(&self, other: &Self) -> bool {
        let is_as_asked = other.formulation.of_surface || !self.formulation.of_surface;
        let is_far_better = BENDS_MORE * self.bending_energy < other.bending_energy;
        (is_as_asked || is_far_better)
            && self.bending_energy < (1.0 - LESS_ENERGY) * other.bending_energy
            && self.suspicious_normals <= other.suspicious_normals
    }

    /// Whether nothing is wrong but so many needles, at most. The system was evaluated here last.
    pub(crate) fn has_only_needles(&self, system: &System, most: usize) -> bool {
        let is_folded = || !system.poor(&self.x, 0.0).is_empty();
        self.is_converged() && !self.is_flawed() && self.poor.len() <= most && !is_folded()
    }

    /// Converged, and wrong in a few places at most, which a finer mesh may mend: somewhere to begin there.
    pub(crate) fn is_good_start(&self) -> bool {
        self.is_converged() && !self.curvature_overshoot && self.poor.len() <= self.x.len() / POOR_OF_START
    }

    /// Whether nothing better is to be looked for.
    pub(crate) fn is_settled(&self) -> bool {
        self.is_sound() || self.is_stopped() || self.needles_from_input
    }
}

/// The integral of `H^2` over the free vertices: a third of its 1-disk belongs to each.
pub(crate) fn bending_energy(state: &State) -> f64 {
    let vertices = state.h.iter().zip(&state.area);
    vertices.map(|(h, area)| area / 3.0 * h * h).sum()
}
