//! How far a run is, and the report of it.

use std::ops::ControlFlow;

use super::continuity::CurvatureContinuity;
use super::outcome::Outcome;
use super::sharp_edge::SharpEdge;
use crate::discrete::target::Target;
#[cfg(doc)]
use crate::fairing::options::{Options, SolverKind};
use crate::paper::LevelReport;
use crate::quality::Quality;
use crate::solve::{Trial, TrialEnd};
use crate::support::table::choices;

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
/// alone are selected, but that sharp edges and curvatures are looked for outside of all components, the latter up to sixteen edges away: see
/// [`Options::sharp`] and [`Options::continuity`].
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
