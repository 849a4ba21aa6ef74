//! What became of each loop.

use std::ops::Range;

use super::groups::JoinReason;
use super::rim::report::RimReport;
use crate::fairing::{Outcome, Report};
use crate::quality::Quality;
use crate::support::error::Error;
use crate::support::table::table;

/// Degrees: a triangle with a smaller angle has its corners on a line, up to rounding.
/// Half or double, of two caps that touch in a vertex and a slit, whose least angles are 0 exactly: none changes.
const NO_ANGLE: f64 = 1e-6;

/// Why a loop was left open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum OpenReason {
    /// The loop runs into an edge with three triangles or more.
    NonManifold {
        /// One end of that edge, the smaller index.
        a: u32,
        /// The other end.
        b: u32,
    },
    /// The loop runs into an edge that its two triangles run through in the same direction.
    Inconsistent {
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
    /// Of the loops to be joined two fit only if the triangles at one of them faced the other way.
    OppositeSides {
        /// One of them.
        a: usize,
        /// The other one.
        b: usize,
    },
    /// The loop is none of those asked for.
    NotAsked,
    /// No patch was found that is a [success](LoopReport::is_success), and such loops were to stay open.
    NotFair,
    /// Every patch intersects itself, the mesh or another patch, and such loops were to stay open.
    Intersecting,
    /// The loop encloses triangles that hang at the rest of the mesh by single vertices only, and was not named.
    Hanging {
        /// One of these vertices.
        vertex: u32,
    },
    /// Two of the loops to be joined have a vertex in common.
    SharedVertex {
        /// The vertex.
        vertex: u32,
    },
}

/// Why a patch was not faired.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum FlatReason {
    /// Fairing was not asked for.
    NotAsked,
    /// The loop lies in a plane, which was asked to close it: [`Cap::Flat`](super::Cap::Flat).
    Planar,
    /// The patch has no inner vertex: nothing can move.
    NoInnerVertex,
    /// The fairing was refused.
    Refused(Error),
    /// The fairing ended without a sound surface; the report says how.
    Unsound,
    /// The faired patch would intersect itself or the mesh, this one does not.
    Intersecting,
}

impl FlatReason {
    /// Whether a patch that is not faired is what was asked for.
    pub(super) fn is_as_asked(&self) -> bool {
        matches!(self, Self::NotAsked | Self::Planar | Self::NoInnerVertex)
    }
}

/// How a loop ended.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum FillOutcome {
    /// Filled with a faired surface that meets the tolerance; its report says with which reservations, one of them that the
    /// surface is not harmonic, but the [nearest member](Outcome::NearestMember) of a family.
    Faired,
    /// Filled, but the fair surface was not found: the surface of least bending with the same boundary data, or the
    /// best one when the iterations ran out.
    LeastBending,
    /// Filled with the triangulation, refined: not tangent to the surroundings.
    Flat {
        /// Why.
        reason: FlatReason,
    },
    /// Filled, but whatever was tried, the patch intersects itself, the mesh or the patch of another loop, which says so,
    /// too; the one made as asked is kept, faired or not.
    SelfIntersecting,
    /// Left as it was.
    LeftOpen(OpenReason),
}

table!(FillOutcome {
    0 "faired" FillOutcome::Faired => "filled with a faired surface; its report says with which reservations", "";
    1 "least_bending" FillOutcome::LeastBending =>
        "filled with the surface of least bending, or the best one when the iterations ran out",
        "see the remedy of the fairing's outcome";
    2 "flat" FillOutcome::Flat { .. } =>
        "filled with the triangulation, refined, but not faired; the reason says why", "see the remedy of the reason";
    3 "left_open" FillOutcome::LeftOpen(_) => "left as it was; the reason says why", "see the remedy of the reason";
    4 "self_intersecting" FillOutcome::SelfIntersecting =>
        "filled, but the patch intersects itself or the mesh, as did all others that were tried",
        "look at these triangles; clean the boundary of the hole, or remove faces around it, and fill it again";
});

impl FillOutcome {
    /// Whether there is nothing to be said of an end, with the report of the fairing, if there was one.
    pub(super) fn is_success(&self, fairing: Option<&Report>) -> bool {
        match self {
            Self::Faired => fairing.is_some_and(|report| report.outcome.is_success()),
            Self::Flat { reason } => reason.is_as_asked(),
            Self::LeftOpen(
                OpenReason::OuterBoundary
                | OpenReason::Hanging { .. }
                | OpenReason::TooManyEdges
                | OpenReason::NotAsked,
            ) => true,
            _ => false,
        }
    }

    /// What a fairing makes of a patch. `is_wild`: triangles are flipped, or vertices far outside the loop's box, which is no
    /// flaw of a sound surface: there its equation puts it.
    pub(super) fn of_fairing(of: &Outcome, is_wild: bool) -> Self {
        let is_sound = matches!(of, Outcome::Converged | Outcome::NearestMember { .. });
        if is_wild && !is_sound {
            let reason = FlatReason::Unsound;
            return Self::Flat { reason };
        }
        match of.is_tolerance_met() {
            true => Self::Faired,
            false => Self::LeastBending,
        }
    }
}

// Reasons of both kinds share their numbers.
table!(OpenReason {
    1 "non_manifold" OpenReason::NonManifold { .. } =>
        "the boundary runs into an edge with more than two triangles", "repair the mesh there";
    2 "outer_boundary" OpenReason::OuterBoundary =>
        "it is the outer boundary of an open surface, and was not named", "name the loop to have it filled all the same";
    3 "too_many_edges" OpenReason::TooManyEdges => "it has more edges than asked for", "allow more edges, or name the loop";
    4 "no_triangulation" OpenReason::NoTriangulation =>
        "every triangulation has an edge or a triangle that the mesh has already", "remove the triangles that span the hole";
    5 "not_finite" OpenReason::NotFinite { .. } =>
        "a vertex of the boundary is NaN or infinite, or all of them are the same point", "repair or remove these vertices";
    6 "cancelled" OpenReason::Cancelled => "the run was stopped before this loop was done", "run it again, to its end";
    7 "opposite_sides" OpenReason::OppositeSides { .. } =>
        "two of the loops to be joined fit only if the triangles at one of them faced the other way",
        "turn the triangles of one of the two parts around, or leave its loop out";
    8 "shared_vertex" OpenReason::SharedVertex { .. } =>
        "two of the loops to be joined have a vertex in common", "fill them by themselves, or give each a vertex of its own";
    9 "not_asked_for" OpenReason::NotAsked => "it is not one of those that were asked for", "name the loop, or ask for more of them";
    10 "not_fair" OpenReason::NotFair =>
        "no patch was found that is fair and without reservations, and such loops were to stay open",
        "fill it with what there is, whose report has the reasons, or join it to its neighbours, or remove faces around it";
    11 "intersects" OpenReason::Intersecting =>
        "every patch that was tried intersects itself or the mesh, and such loops were to stay open",
        "join the loop to its neighbours, clean its boundary, or remove faces around it";
    12 "hanging" OpenReason::Hanging { .. } =>
        "it is the outer boundary of triangles that hang at the rest of the mesh by single vertices only, one of which is told",
        "remove these triangles, or name the loop to have it filled all the same";
    13 "inconsistent" OpenReason::Inconsistent { .. } =>
        "the boundary runs into an edge whose two triangles face opposite ways: they are oriented inconsistently",
        "turn triangles around, so that all face the same way";
});

table!(FlatReason {
    32 "not_asked" FlatReason::NotAsked => "fairing was not asked for", "";
    33 "no_inner_vertex" FlatReason::NoInnerVertex => "the patch has no inner vertex: nothing can move", "";
    34 "refused" FlatReason::Refused(_) =>
        "the fairing was refused, because the mesh around the hole is defective", "repair the mesh there";
    35 "unsound" FlatReason::Unsound =>
        "the fairing found no sound surface; its report says how it ended", "see the remedy of the fairing's outcome";
    36 "intersecting" FlatReason::Intersecting =>
        "faired, the patch would intersect itself or the mesh", "clean the boundary of the hole, or remove faces around it";
    37 "planar" FlatReason::Planar => "the boundary lies in a plane, which closes it, as asked", "";
});

/// What became of a loop, or of loops that are joined.
#[derive(Debug, Clone, PartialEq)]
pub struct LoopReport {
    /// The loop, as numbered by [`boundary_loops`](super::boundary_loops); of several the first.
    pub index: usize,
    /// All the loops that the patch is for, ascending: more than one if they are joined.
    pub loops: Vec<usize>,
    /// Why they are joined, if that was left to [`Join::Auto`](super::Join::Auto).
    pub joined: Option<JoinReason>,
    /// The number of edges, of all loops together.
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
    /// 1 where the boundary normals are those asked for. Less where no sound patch has them, or none that intersects nothing: so much of
    /// the way from the normals of a membrane over the loops to the averages of the mesh's.
    pub normals_reached: f64,
    /// Pairs of triangles of the filled mesh that intersect, the smaller number first, ascending; at least one of each is
    /// of this patch. Not looked for if the fairing's
    /// [`Options::intersections`](crate::Options::intersections) says so. No more than
    /// [`SelfIntersections::MOST`](crate::SelfIntersections::MOST).
    pub self_intersections: Vec<[u32; 2]>,
    /// What became of the vertices around the loop, if they were [allowed to move](super::Rim::relax).
    pub rim: Option<RimReport>,
    /// Wall seconds for this loop.
    pub seconds: f64,
}

/// Whether one of so many triangles has no area, by the least angle (degrees).
pub(super) fn has_no_area(triangles: usize, worst_angle: f64) -> bool {
    triangles > 0 && worst_angle < NO_ANGLE
}

impl LoopReport {
    /// Whether there is nothing to be said of it: a patch that converged without reservation, or was not to be faired, and whose triangles have
    /// areas; or a loop that stayed open because it was not asked for. The same in every host.
    pub fn is_success(&self) -> bool {
        if self.rim.as_ref().is_some_and(|rim| !rim.is_sound()) || self.has_no_area() {
            return false;
        }
        self.outcome.is_success(self.fairing.as_ref())
    }

    /// Whether a new triangle has no area: its corners are on a line.
    pub fn has_no_area(&self) -> bool {
        !self.is_open() && has_no_area(self.triangles.len(), self.worst_angle)
    }

    /// Whether an outer boundary stayed open.
    pub(super) fn is_outer(&self) -> bool {
        matches!(
            self.outcome,
            FillOutcome::LeftOpen(OpenReason::OuterBoundary | OpenReason::Hanging { .. })
        )
    }

    pub(super) fn is_open(&self) -> bool {
        matches!(self.outcome, FillOutcome::LeftOpen(_))
    }
}

/// Turns the numbers in a report into others.
pub(super) fn renumber(report: &mut Report, vertex: impl Fn(u32) -> u32, triangle: impl Fn(u32) -> u32) {
    renumber_judgement(&mut report.quality, &mut report.outcome, &vertex, &triangle);
    for component in &mut report.components {
        component.vertex = vertex(component.vertex as u32) as usize;
        for of_loop in &mut component.continuity {
            of_loop.vertex = vertex(of_loop.vertex as u32) as usize;
        }
        renumber_judgement(&mut component.quality, &mut component.outcome, &vertex, &triangle);
    }
    report.suspicious_normals.iter_mut().for_each(|v| *v = vertex(*v));
    for edge in &mut report.sharp_edges {
        edge.vertices.iter_mut().for_each(|v| *v = vertex(*v));
        for end in &mut edge.ends {
            end.vertex = vertex(end.vertex);
            end.chains.iter_mut().flatten().for_each(|v| *v = vertex(*v));
        }
    }
}

fn renumber_judgement(
    quality: &mut Quality,
    outcome: &mut Outcome,
    vertex: impl Fn(u32) -> u32,
    triangle: impl Fn(u32) -> u32,
) {
    quality.worst_triangle = triangle(quality.worst_triangle as u32) as usize;
    let ends = quality.sharpest_edge_vertices;
    quality.sharpest_edge_vertices = ends.map(|v| vertex(v as u32) as usize);
    quality.normal_deviation_vertex = vertex(quality.normal_deviation_vertex as u32) as usize;
    quality.boundary_kink_vertex = vertex(quality.boundary_kink_vertex as u32) as usize;
    for list in [&mut quality.flipped, &mut quality.needles] {
        list.iter_mut().for_each(|t| *t = triangle(*t));
    }
    match outcome {
        Outcome::ConvergedPoorTriangles { triangles } | Outcome::PoorWhenRounded { triangles } => {
            triangles.iter_mut().for_each(|t| *t = triangle(*t))
        }
        Outcome::BoundaryCrease { vertices } => {
            vertices.iter_mut().for_each(|v| *v = vertex(*v));
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fairing::LooseReason;

    #[test]
    fn a_patch_that_is_the_nearest_member_is_faired() {
        let member = Outcome::NearestMember { weight: 0.25 };
        let loosely = Outcome::ConvergedLoosely {
            reason: LooseReason::Bump,
        };
        for outcome in [&Outcome::Converged, &member, &loosely] {
            assert_eq!(FillOutcome::of_fairing(outcome, false), FillOutcome::Faired);
        }
        for outcome in [&Outcome::Converged, &member] {
            assert_eq!(FillOutcome::of_fairing(outcome, true), FillOutcome::Faired);
        }
        let flat = FillOutcome::Flat {
            reason: FlatReason::Unsound,
        };
        for outcome in [&loosely, &Outcome::NotConverged] {
            assert_eq!(FillOutcome::of_fairing(outcome, true), flat);
        }
        let left = FillOutcome::of_fairing(&Outcome::IterationLimit, false);
        assert_eq!(left, FillOutcome::LeastBending);
    }
}
