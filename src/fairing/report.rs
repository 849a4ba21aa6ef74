//! How far a run is, and what came of it.

use std::ops::ControlFlow;

use super::continuity::CurvatureContinuity;
use super::sharp_edge::SharpEdge;
use crate::discrete::target::Target;
#[cfg(doc)]
use crate::fairing::options::{Options, SolverKind};
use crate::paper::LevelReport;
use crate::quality::Quality;
use crate::solve::{Trial, TrialEnd};
use crate::support::table::{Entry, choices, table};

/// How far a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Between 0 and 1, never falling.
    pub fraction: f64,
    /// Nonlinear iterations so far, of the component that is at work.
    pub iterations: usize,
    /// Its last step norm, in diagonals.
    pub step: f64,
    /// What is being done, in a word or two.
    pub phase: &'static str,
}

/// What is told how far a run is; `Break` stops it.
pub type ProgressCallback<'a> = dyn FnMut(&Progress) -> ControlFlow<()> + Send + 'a;

/// How the run ended. The positions are usable in every case.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Outcome {
    /// Tolerance met and the surface is sound.
    Converged,
    /// Tolerance met, but some triangles are flipped or have an angle below one degree.
    ConvergedPoorTriangles {
        /// Those triangles.
        triangles: Vec<u32>,
    },
    /// Tolerance met and no triangle is poor, but triangles of the surface intersect each other or the rest of the mesh.
    SelfIntersecting {
        /// How many pairs; [`Report::self_intersections`] names them.
        pairs: usize,
    },
    /// Tolerance met and no triangle is poor, but something else is to be said of the surface.
    ConvergedLoosely {
        /// What.
        reason: LooseReason,
    },
    /// A surface was found only for a part of the right-hand side of [`Options::target`]; that of least bending is returned.
    TargetNotReachable {
        /// The part, 0 to 1: a constant `c` was too large by the inverse.
        reached: f64,
    },
    /// No sound surface was found; that of least bending is returned, tangent to the surroundings as far as it can be.
    NotConverged,
    /// The iteration limit was reached; the best surface so far is returned.
    IterationLimit,
    /// The progress callback stopped the run; the best surface so far is returned, before there is one the input. Of several
    /// components those that were done keep their results, and those not begun yet are as in the input.
    Cancelled,
    /// Tolerance met and the surface is sound, but triangles are flipped or have an angle below one degree once the positions
    /// are rounded to [`Options::output_precision`].
    PoorWhenRounded {
        /// Those triangles.
        triangles: Vec<u32>,
    },
    /// No sound harmonic surface was found between these boundary conditions. The surface solves `Delta_B H = -2 w H (H^2 - K)`
    /// to the tolerance instead, of the family between the harmonic equation (`w` = 0) and that of minimal energy (`w` = 1) the
    /// member nearest to harmonic that was found sound. It meets the boundary normals as a harmonic surface does.
    NearestMember {
        /// Its `w`, over 0 and at most 1.
        weight: f64,
    },
    /// Tolerance met and no triangle is poor, but along the boundary the surface has a crease against the outside, or against
    /// the normals that were given: a kink of more than 45 degrees that exceeds by more than 15 degrees what given normals ask
    /// for and what the input has there (of which no more counts than 45 degrees, or than the outside turns to the next
    /// boundary vertices), or a deviation from the boundary normal of more than 60 degrees.
    BoundaryCrease {
        /// The boundary vertices where it has, ascending.
        vertices: Vec<u32>,
    },
}

choices! {
    /// What is to be said of a surface that [`Outcome::ConvergedLoosely`].
    #[non_exhaustive]
    LooseReason {
        1 "suspicious_normals" SuspiciousNormals =>
            "boundary normals point against the surface beside them: probably flipped",
            "check the suspicious normals that the report names: turn them around, or give none there";
        2 "rounding" Rounding =>
            "max |Delta_B H| is as small as the rounding of the positions allows, but above its limit",
            "set a larger limit, or move the mesh near to the origin and give it in double precision";
        4 "bump" Bump =>
            "the surface has a bump: its curvature inside exceeds what the boundary allows, or it folds at single edges or leaves single normals",
            "look at it; conformal inner fairness, a larger region, or one with a smoother boundary, usually cures it";
        5 "tolerance" Tolerance =>
            "the steps have become as small as double precision allows here, but stay above the tolerance",
            "ask for a larger tolerance: the last step in the report is the smallest that can be met here";
        6 "drawn_normals" DrawnNormals =>
            "no sound surface over this hole has the normals of the mesh: they were drawn towards those of a membrane",
            "look at it; clean the boundary of the hole, or remove faces around it, and fill it again";
        7 "curvature" Curvature =>
            "less than half of the curvature asked for was continued: the surroundings are too rough, or no sound surface has it",
            "look at it; ask for less continuity, or for tangent planes alone, or select a larger region";
        8 "sharp_edge" SharpEdge =>
            "a sharp edge of the surroundings ends at the boundary, at the vertices that the report names, and does not go on",
            "select so much that the edge ends outside, or leaves the region again; or triangulate the region anew";
    }
}

table!(Outcome {
    0 "converged" Outcome::Converged => "tolerance met, and the surface is sound", "";
    1 "converged_poor_triangles" Outcome::ConvergedPoorTriangles { .. } =>
        "tolerance met, but triangles are flipped or have an angle below one degree",
        "look at these triangles; remeshing the region, or uniform inner fairness, usually cures them";
    2 "converged_loosely" Outcome::ConvergedLoosely { .. } =>
        "tolerance met, and no triangle is poor, but the surface has a reservation, which the reason names",
        "see the remedy of the reason";
    4 "target_not_reachable" Outcome::TargetNotReachable { .. } =>
        "a surface was found for a part of the target only; that of least bending is returned",
        "ask for a smaller constant, or select a smaller region";
    5 "not_converged" Outcome::NotConverged =>
        "no sound surface was found; that of least bending is returned",
        "select more, check the boundary normals (flipped? noise?) or average them, or remesh the region";
    6 "iteration_limit" Outcome::IterationLimit =>
        "the iterations ran out; the best surface so far is returned",
        "allow more iterations, or fair the result once more";
    7 "cancelled" Outcome::Cancelled =>
        "the progress callback stopped the run; the best surface so far is returned, before there is one the input",
        "run it again, to its end";
    8 "boundary_crease" Outcome::BoundaryCrease { .. } =>
        "tolerance met, but the surface has a crease along the boundary, at the vertices that the report names",
        "move the boundary away from sharp features or noise: select more or less there; or refine the mesh there";
    9 "self_intersecting" Outcome::SelfIntersecting { .. } =>
        "tolerance met, and no triangle is poor, but triangles of the surface intersect each other or the rest of the mesh",
        "look at these triangles; select more, prescribe other normals, or fill the region as a hole";
    10 "poor_when_rounded" Outcome::PoorWhenRounded { .. } =>
        "tolerance met, but rounding the positions to the numbers that are written flips triangles or leaves them without angles",
        "write the mesh in double precision, or move it near to the origin";
    11 "nearest_member" Outcome::NearestMember { .. } =>
        "no harmonic surface was found; a smooth one with the same normals, between harmonic and minimal energy, is returned",
        "look at it: it is fair, but bends by another equation; less extreme normals, or another region, may have a harmonic surface";
});

impl Outcome {
    /// Tolerance met and the surface is sound: the only case without reservation.
    ///
    /// ```
    /// use fairmesh::Outcome;
    ///
    /// assert!(Outcome::Converged.is_success() && Outcome::Converged.remedy().is_empty());
    /// let limit = Outcome::IterationLimit;
    /// println!("{}: {}; {}", limit.name(), limit.text(), limit.remedy());
    /// assert!(!limit.is_success() && !limit.remedy().is_empty());
    /// ```
    pub fn is_success(&self) -> bool {
        matches!(self, Outcome::Converged)
    }

    /// A success becomes one with a reservation: a sharp edge stops at the boundary.
    pub(crate) fn reserve_edge(&mut self) {
        if self.is_success() {
            let reason = LooseReason::SharpEdge;
            *self = Self::ConvergedLoosely { reason };
        }
    }

    /// A success, or one with other poor triangles, becomes one with this poor triangle.
    pub(crate) fn reserve_triangle(&mut self, triangle: u32) {
        match self {
            Self::ConvergedPoorTriangles { triangles } | Self::PoorWhenRounded { triangles } => {
                triangles.push(triangle);
                triangles.sort_unstable();
            }
            _ if self.is_tolerance_met() => {
                *self = Self::ConvergedPoorTriangles {
                    triangles: vec![triangle],
                };
            }
            _ => {}
        }
    }

    /// A success, or a surface with creases elsewhere, becomes one with a crease at this vertex.
    pub(crate) fn reserve_crease(&mut self, vertex: u32) {
        match self {
            Self::BoundaryCrease { vertices } => {
                vertices.push(vertex);
                vertices.sort_unstable();
                vertices.dedup();
            }
            Self::Converged | Self::ConvergedLoosely { .. } | Self::NearestMember { .. } => {
                *self = Self::BoundaryCrease {
                    vertices: vec![vertex],
                };
            }
            _ => {}
        }
    }

    /// Tolerance met, with whatever reservation.
    pub(crate) fn is_tolerance_met(&self) -> bool {
        matches!(
            self,
            Self::Converged
                | Self::ConvergedPoorTriangles { .. }
                | Self::ConvergedLoosely { .. }
                | Self::NearestMember { .. }
                | Self::BoundaryCrease { .. }
                | Self::PoorWhenRounded { .. }
        )
    }

    /// Tolerance met, but some triangles are poor, or will be once they are written.
    pub(crate) fn has_poor_triangles(&self) -> bool {
        matches!(
            self,
            Self::ConvergedPoorTriangles { .. } | Self::PoorWhenRounded { .. }
        )
    }

    /// What the outcome means: its text in the table, or that of its reason.
    pub fn text(&self) -> &'static str {
        self.most_telling().text()
    }

    /// What the user can do about it; empty if there is nothing to do.
    pub fn remedy(&self) -> &'static str {
        self.most_telling().remedy()
    }

    /// The outcome of a whole: the worst of its parts', with what all parts of that outcome tell of it. From bad to good:
    /// cancelled, iteration limit, not converged, target not reachable, poor triangles, boundary crease, intersecting,
    /// nearest member, loosely, converged.
    pub(crate) fn of_all(parts: &[&Self]) -> Self {
        let first = parts
            .iter()
            .copied()
            .reduce(|a, b| if b.severity() > a.severity() { b } else { a });
        let mut whole = first.cloned().unwrap_or(Self::Converged);
        let all = |list: fn(&Self) -> &[u32]| {
            let mut all: Vec<u32> = parts.iter().flat_map(|o| list(o)).copied().collect();
            all.sort_unstable();
            all.dedup();
            all
        };
        match &mut whole {
            Self::ConvergedPoorTriangles { triangles } => *triangles = all(Self::poor),
            Self::PoorWhenRounded { triangles } => *triangles = all(Self::poor_when_rounded),
            Self::BoundaryCrease { vertices } => *vertices = all(Self::creased),
            Self::TargetNotReachable { reached: least } => {
                for part in parts {
                    if let Self::TargetNotReachable { reached } = part {
                        *least = least.min(*reached);
                    }
                }
            }
            Self::NearestMember { weight: most } => {
                for part in parts {
                    if let Self::NearestMember { weight } = part {
                        *most = most.max(*weight);
                    }
                }
            }
            _ => {}
        }
        whole
    }

    /// The larger the worse.
    fn severity(&self) -> u32 {
        match self {
            Self::Converged => 0,
            Self::ConvergedLoosely { reason } => match reason {
                LooseReason::Curvature => 2,
                LooseReason::Rounding => 3,
                LooseReason::Tolerance => 4,
                LooseReason::SuspiciousNormals => 5,
                LooseReason::Bump => 6,
                LooseReason::DrawnNormals => 7,
                LooseReason::SharpEdge => 8,
            },
            Self::NearestMember { .. } => 9,
            Self::SelfIntersecting { .. } => 10,
            Self::BoundaryCrease { .. } => 11,
            Self::PoorWhenRounded { .. } => 12,
            Self::ConvergedPoorTriangles { .. } => 13,
            Self::TargetNotReachable { .. } => 14,
            Self::NotConverged => 15,
            Self::IterationLimit => 16,
            Self::Cancelled => 17,
        }
    }

    fn poor(&self) -> &[u32] {
        match self {
            Self::ConvergedPoorTriangles { triangles } => triangles,
            _ => &[],
        }
    }

    fn poor_when_rounded(&self) -> &[u32] {
        match self {
            Self::PoorWhenRounded { triangles } => triangles,
            _ => &[],
        }
    }

    fn creased(&self) -> &[u32] {
        match self {
            Self::BoundaryCrease { vertices } => vertices,
            _ => &[],
        }
    }

    fn most_telling(&self) -> &'static Entry {
        match self {
            Outcome::ConvergedLoosely { reason } => reason.entry(),
            outcome => outcome.entry(),
        }
    }
}

/// Wall seconds per phase.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Seconds {
    /// Half-edges, rings, boundary normals.
    pub setup: f64,
    /// Symbolic analysis, and the search on the coarse mesh or the linear start.
    pub start: f64,
    /// Nonlinear iterations.
    pub iterate: f64,
    /// Soundness figures.
    pub quality: f64,
    /// All of it.
    pub total: f64,
}

/// Triangles of the surface that intersect each other or the rest of the mesh. Two triangles intersect if they have more in
/// common than a vertex of both or an edge of both, see [`self_intersections`](crate::self_intersections).
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SelfIntersections {
    /// Pairs of triangles by the caller's numbers, the smaller first, ascending; at least one of each has a free vertex. No
    /// more than [`SelfIntersections::MOST`].
    pub pairs: Vec<[u32; 2]>,
    /// How many pairs there were in the input among the same triangles and the rest of the mesh, counted up to the same
    /// limit; 0 where there are none now.
    pub in_input: usize,
}

impl SelfIntersections {
    /// The search ends when it has found so many pairs.
    pub const MOST: usize = 10_000;
}

choices! {
    /// How an attempt at a surface ended, see [`Attempt`].
    #[non_exhaustive]
    AttemptEnd {
        0 "sound" Sound => "a sound surface that meets the tolerance of the attempt", "";
        1 "unsound" Unsound => "a surface that meets the tolerance, but has poor triangles, a bump or a crease", "";
        2 "not_converged" NotConverged => "no surface that meets the tolerance", "";
        3 "stopped" Stopped => "stopped by the limit of iterations or by the caller", "";
    }
}

/// An attempt at a surface. Those on the coarse mesh decide where the fine one begins; of two sound surfaces there that differ the one of
/// less bending energy is taken.
///
/// ```
/// # // A plane of 7 by 7 vertices with a bump; the nine in the middle are free.
/// # let at = |v: u32| [f64::from(v % 7), f64::from(v / 7), if v == 24 { 1.0 } else { 0.0 }];
/// # let positions: Vec<[f64; 3]> = (0..49).map(at).collect();
/// # let cell = |c: u32| { let v = c / 6 * 7 + c % 6; [[v, v + 1, v + 8], [v, v + 8, v + 7]] };
/// # let triangles: Vec<[u32; 3]> = (0..36).flat_map(cell).collect();
/// # let free = [16, 17, 18, 23, 24, 25, 30, 31, 32];
/// use fairmesh::{AttemptEnd, Options, Selection, fair};
///
/// let solution = fair(&positions, &triangles, Selection::Vertices(&free), &Options::default())?;
/// let attempts = &solution.report.components[0].attempts;
/// for attempt in attempts {
///     println!("{} free vertices, {}: {}", attempt.free_vertices, attempt.name, attempt.end.name());
/// }
/// assert_eq!(attempts.last().map(|attempt| attempt.end), Some(AttemptEnd::Sound));
/// # Ok::<(), fairmesh::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attempt {
    /// The free vertices of its mesh: fewer than the component's on the coarse mesh.
    pub free_vertices: usize,
    /// What was tried, in a few words.
    pub name: &'static str,
    /// Nonlinear iterations.
    pub iterations: usize,
    /// How it ended.
    pub end: AttemptEnd,
    /// The bending energy of its surface, the integral of `H^2` over the free vertices, without unit; not a number where it has none.
    pub bending_energy: f64,
}

impl Attempt {
    pub(super) fn new(trial: &Trial) -> Self {
        Self {
            free_vertices: trial.free,
            name: trial.name,
            iterations: trial.iterations,
            end: match trial.ended {
                Some(TrialEnd::Sound) => AttemptEnd::Sound,
                Some(TrialEnd::Unsound) => AttemptEnd::Unsound,
                Some(TrialEnd::Stopped) => AttemptEnd::Stopped,
                Some(TrialEnd::Unconverged) | None => AttemptEnd::NotConverged,
            },
            bending_energy: trial.bending_energy,
        }
    }
}

/// What came of one component of the region. Components are independent problems: free vertices belong to the same one where
/// they are neighbours, or lie around a fixed vertex inside the region whose normal is not given. Any other fixed vertex
/// separates; what is beyond it is outside. A component's result is, to the last bit, that of a call where its free vertices
/// alone are selected.
#[derive(Debug, Clone, PartialEq)]
pub struct ComponentReport {
    /// Its free vertex with the smallest index.
    pub vertex: usize,
    /// Number of its free vertices.
    pub free_vertices: usize,
    /// How its run ended.
    pub outcome: Outcome,
    /// Nonlinear iterations on its own mesh, but for those of attempts at a second surface that found none better.
    pub iterations: usize,
    /// Defect, see [`Report::defect`], with its own diagonal.
    pub defect: f64,
    /// The last step norm, in its diagonals.
    pub step: f64,
    /// Its bounding-box diagonal, in the unit of the positions: the unit of its tolerance.
    pub diagonal: f64,
    /// Its surface is that of least bending: no sound harmonic one was found.
    pub least_bending: bool,
    /// What was tried, in its order: on the coarse mesh, where the component is large, and then on its own. Empty for
    /// [`SolverKind::Paper`].
    pub attempts: Vec<Attempt>,
    /// Soundness of its surface.
    pub quality: Quality,
    /// What came of [`Options::continuity`] along each boundary loop with surroundings; empty where it was not asked for, where no surface was
    /// found to begin with, and where the loops are too short, or the region too narrow, to tell curvature.
    pub continuity: Vec<CurvatureContinuity>,
}

/// What came of it: of the whole, and of each component. The whole has the worst of its components: their worst outcome and
/// largest figures, and the vertices and triangles of all.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// What `Delta_B H` was to be.
    pub target: Target,
    /// How the run ended; of several components the worst outcome: the first of cancelled, iteration limit, not converged,
    /// target not reachable, normals not reachable, converged with poor triangles, poor when rounded, boundary crease,
    /// self-intersecting, nearest member, loosely, converged.
    pub outcome: Outcome,
    /// Nonlinear iterations: the most of any component.
    pub iterations: usize,
    /// Defect `max_i |sum_j w_ij (H_i - H_j) + (2 A_i / 3) rhs_i| / sum_j |w_ij| x L` of the equation `Delta_B H = rhs`,
    /// `A_i` the area of the 1-disk, `L` the component's diagonal; the largest of any component.
    pub defect: f64,
    /// The last step norm, in the component's diagonals; the largest of any component.
    pub step: f64,
    /// Seconds per phase, of all components.
    pub seconds: Seconds,
    /// Soundness of the result.
    pub quality: Quality,
    /// The levels of [`SolverKind::Paper`] from the base to the given mesh, of all components; empty for the fast solver.
    pub levels: Vec<LevelReport>,
    /// Number of free vertices.
    pub free_vertices: usize,
    /// The largest bounding-box diagonal of a component, in the unit of the positions.
    pub diagonal: f64,
    /// The returned surface, or that of some component, is that of least bending: no sound harmonic one was found.
    pub least_bending: bool,
    /// Boundary vertices whose prescribed normal points against the surface beside it or contradicts its
    /// neighbours': probably flipped or wrong.
    pub suspicious_normals: Vec<u32>,
    /// Free vertices that inner fairness does not spread as asked: those that took fallback weights, because their input triangles allow no
    /// conformal or convex ones; all of a component where no surface was found with the weights asked for, and they are spread evenly; and
    /// all where none was found with these either, as on a surface that is nearly closed, and they were moved along the normals alone.
    pub fallback_weights: usize,
    /// Triangles that intersect, measured on the positions returned. None: not looked for, because
    /// [`Options::intersections`] says so or because the run was held up before its end.
    pub self_intersections: Option<SelfIntersections>,
    /// What became of the sharp edges that reach the boundary, where [`Options::sharp`] asks for them.
    pub sharp_edges: Vec<SharpEdge>,
    /// Each component, by its smallest free vertex; at least one.
    pub components: Vec<ComponentReport>,
}

/// The result: all vertices of the mesh, and the report.
#[derive(Debug, Clone)]
pub struct Solution {
    /// All positions; fixed vertices keep their bits.
    pub positions: Vec<[f64; 3]>,
    /// The boundary vertices, ascending, and the unit normals that were used there. A vertex that several components have
    /// different normals at stands there with each.
    pub boundary_normals: Vec<(u32, [f64; 3])>,
    /// Free vertices and the mean curvature of the result there; negative on a sphere with outward normals.
    pub mean_curvature: Vec<(u32, f64)>,
    /// Free vertices and the Gaussian curvature of the result there; positive on a sphere.
    pub gaussian_curvature: Vec<(u32, f64)>,
    /// How it went.
    pub report: Report,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_whole_is_as_far_from_harmonic_as_its_farthest_component() {
        let member = |weight| Outcome::NearestMember { weight };
        let bump = Outcome::ConvergedLoosely {
            reason: LooseReason::Bump,
        };
        let parts = [
            &Outcome::Converged,
            &member(0.25),
            &bump,
            &member(0.5),
            &member(0.125),
        ];
        assert_eq!(Outcome::of_all(&parts), member(0.5));
        let crossing = Outcome::SelfIntersecting { pairs: 1 };
        assert_eq!(Outcome::of_all(&[&member(0.25), &crossing]), crossing);
    }
}
