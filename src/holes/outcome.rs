//! What became of each loop.

use std::ops::Range;

use crate::error::Error;
use crate::fairing::{Outcome, Report};

/// Why a loop was left open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum OpenReason {
    /// The loop runs into an edge with three triangles or more, or with inconsistent ones.
    NonManifold {
        /// One end of that edge, the smaller index.
        a: u32,
        /// The other end.
        b: u32,
    },
    /// The loop encloses the mesh rather than a gap, and was not named.
    OuterBoundary,
    /// The loop has more edges than asked for.
    TooManyEdges,
    /// Every triangulation has an edge or a triangle that the mesh has already.
    NoTriangulation,
    /// A vertex of the loop is NaN or infinite, or all of them are the same point.
    NotFinite {
        /// The vertex.
        vertex: u32,
    },
    /// The run was stopped before this loop was done.
    Cancelled,
}

/// Why a patch was not faired.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum FlatReason {
    /// Fairing was not asked for.
    NotAsked,
    /// The patch has no inner vertex: nothing can move.
    NoInnerVertex,
    /// The fairing was refused.
    Refused(Error),
    /// The fairing ended without a sound surface; the report says how.
    Unsound,
}

/// How a loop ended.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum FillOutcome {
    /// Filled with a faired surface that meets the tolerance; its report says with which reservations.
    Faired,
    /// Filled, but the fair surface was not found: the surface of the linear problem with the same boundary data, or the
    /// best one when the iterations ran out.
    Linear,
    /// Filled with the triangulation, refined: not tangent to the surroundings.
    Flat {
        /// Why.
        reason: FlatReason,
    },
    /// Left as it was.
    LeftOpen(OpenReason),
}

impl FillOutcome {
    /// A stable lower-case name: `faired`, `linear`, `flat`, `left_open`.
    pub fn name(&self) -> &'static str {
        match self {
            FillOutcome::Faired => "faired",
            FillOutcome::Linear => "linear",
            FillOutcome::Flat { .. } => "flat",
            FillOutcome::LeftOpen(_) => "left_open",
        }
    }
}

/// What became of a loop.
#[derive(Debug, Clone, PartialEq)]
pub struct LoopReport {
    /// The loop, as numbered by [`boundary_loops`](super::boundary_loops).
    pub index: usize,
    /// Its number of edges.
    pub edges: usize,
    /// How it ended.
    pub outcome: FillOutcome,
    /// Numbers of the new vertices.
    pub vertices: Range<u32>,
    /// Numbers of the new triangles.
    pub triangles: Range<u32>,
    /// The report of the fairing, where there was one. Its numbers are those of the filled mesh.
    pub fairing: Option<Report>,
    /// The smallest angle of the new triangles, in degrees.
    pub worst_angle: f64,
    /// New vertices that lie outside the loop's bounding box by more than a quarter of its diagonal.
    pub outside: Vec<u32>,
    /// The limit on new vertices was met: the patch is coarser inside than asked for.
    pub coarsened: bool,
    /// Wall seconds for this loop.
    pub seconds: f64,
}

/// Turns the numbers in a report into others.
pub(super) fn renumber(report: &mut Report, vertex: impl Fn(u32) -> u32, triangle: impl Fn(u32) -> u32) {
    let quality = &mut report.quality;
    quality.worst_triangle = triangle(quality.worst_triangle as u32) as usize;
    quality.normal_deviation_vertex = vertex(quality.normal_deviation_vertex as u32) as usize;
    for list in [&mut quality.flipped, &mut quality.needles] {
        list.iter_mut().for_each(|t| *t = triangle(*t));
    }
    report.suspicious_normals.iter_mut().for_each(|v| *v = vertex(*v));
    match &mut report.outcome {
        Outcome::ConvergedPoorTriangles { triangles } => triangles.iter_mut().for_each(|t| *t = triangle(*t)),
        Outcome::NormalsNotReachable { vertices, .. } => vertices.iter_mut().for_each(|v| *v = vertex(*v)),
        _ => {}
    }
}
