//! What a solve ends with.

use nalgebra::Vector3;

use crate::solve::g2::boundary_curvature::Blend;

/// How a solve ended.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum SolveStatus {
    /// Tolerance met.
    Converged,
    /// Met as far as the rounding of positions shows: the limit set on `Delta_B H` lies below that.
    ConvergedToRounding,
    /// As small a step as rounding allows, but above the tolerance.
    AboveTolerance,
    /// Tolerance met by a surface that has a bump, see [`Candidate::has_bump`](super::candidate::Candidate::has_bump).
    Bump,
    /// No sound harmonic surface; the member `w` of the family `Delta_B H = -2 w H (H^2 - K)` that is nearest to it.
    NearestMember(f64),
    /// No sound surface; that of least bending.
    Failed,
    /// A surface was found for this part of the right-hand side only; that of least bending.
    TargetNotReached(f64),
    /// The limit of iterations: the best surface so far.
    IterationLimit,
    /// Stopped by the caller: the best surface so far.
    Cancelled,
}

impl SolveStatus {
    /// Whether the surface is that of least bending, for want of a better.
    pub(crate) fn is_least_bending(&self) -> bool {
        matches!(self, Self::Failed | Self::TargetNotReached(_))
    }
}

/// What an attempt at a surface has led to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Trial {
    /// Free vertices of its mesh.
    pub free: usize,
    /// Its name in the ladder.
    pub name: &'static str,
    /// Iterations.
    pub iterations: usize,
    /// How its last iteration ended; `None`: without a surface.
    pub ended: Option<TrialEnd>,
    /// Bending energy of the surface, the integral of `H^2`; not a number where there is none.
    pub bending_energy: f64,
}

/// How an attempt ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TrialEnd {
    /// At a sound surface that meets its tolerance.
    Sound,
    /// At one with poor triangles, a bump or a crease.
    Unsound,
    /// Above the tolerance.
    Unconverged,
    /// Stopped.
    Stopped,
}

/// What came of the continuity of curvature along a boundary loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LoopContinuity {
    /// Its smallest boundary vertex.
    pub vertex: u32,
    /// How many vertices it has.
    pub vertices: usize,
    /// How much of the way to the curvature of the surroundings was asked for,
    pub asked: Blend,
    /// and was taken.
    pub reached: f64,
    /// The jump of `H`, root mean square and largest, of the tangent-continuous surface,
    pub jump_before: [f64; 2],
    /// and of this one.
    pub jump: [f64; 2],
    /// The root mean square of `H` of the surroundings,
    pub curvature: f64,
    /// and of its uncertainty.
    pub uncertainty: f64,
    /// Whether less than half of what was asked for was reached, although the jump that is left is far from nothing and larger than the
    /// uncertainty of the surroundings.
    pub is_short: bool,
}

/// What was found.
#[derive(Debug, Clone)]
pub(crate) struct SolveResult {
    /// What was tried, in its order, that on the coarse mesh first.
    pub trials: Vec<Trial>,
    /// The surface: free and boundary vertices.
    pub x: Vec<Vector3<f64>>,
    /// How it ended.
    pub status: SolveStatus,
    /// The last step norm.
    pub step: f64,
    /// Of the outer equation, without unit.
    pub defect: f64,
    /// Iterations.
    pub iterations: usize,
    /// Triangles of the region (local numbers) that are folded or needles.
    pub poor: Vec<u32>,
    /// No vertex is spread as asked: the weights are those of the surface of least bending, or there are none.
    pub spread_otherwise: bool,
    /// Inner fairness is not met, because none was found to go with a surface: the vertices were moved along the normals alone.
    pub along_normals: bool,
    /// Where the curvature of the surroundings was to be continued, what came of it.
    pub continuity: Vec<LoopContinuity>,
    /// Seconds until the first iteration.
    pub start_seconds: f64,
}
