//! The public entry: what is asked, what came of it.

mod normalization;
mod normals;
mod relay;
mod session;
mod solvers;

use std::ops::ControlFlow;
use std::time::Instant;

use crate::discrete::inner_fairness::FairnessWeights;
pub use crate::discrete::target::Target;
use crate::discrete::valence_batches::ValenceBatches;
use crate::error::Error;
pub use crate::mesh::region::Selection;
use crate::mesh::{Region, Rings};
use crate::paper::{LevelReport, PaperOptions, Problem};
use crate::quality::{Quality, Surface};
use crate::solve::Ending;
use crate::solve::control::{Callback, Interrupt};
use crate::solve::globalize::diagonal;
use normalization::Normalization;
pub use normals::{BoundaryNormals, InteriorNormals};
use normals::{boundary_normals, given_vertices};
use relay::relay;
pub(crate) use relay::with_threads;
pub use session::Session;
use solvers::Faired;

/// How vertices are distributed within the surface (paper 7.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum InnerFairness {
    /// Equal weights: a regular distribution.
    #[default]
    Uniform,
    /// Cotangents of the input mesh: least distortion of the input triangles.
    Conformal,
    /// Mean-value weights of the input mesh (Floater): near conformal, but positive for any input, and exact on a plane.
    Convex,
}

/// How normals and mean curvature are discretized (paper 5, 6).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Discretization {
    /// Max's normals and the gradient-corrected curvature: second order on irregular meshes.
    #[default]
    SecondOrder,
    /// The paper's: normals from summed cross products, plain Moreton-Sequin curvature.
    Paper,
}

/// How the equations are solved.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Solver {
    /// Quasi-Newton steps on both equations together.
    #[default]
    Fast,
    /// The paper's own scheme (7): slow, kept as a yardstick. Always with [`Discretization::Paper`]; `tolerance` and
    /// `max_iterations` of [`Options`] have no part in it.
    Paper(PaperOptions),
}

/// What is told how far a run is; `Break` stops it.
pub type Watcher<'a> = dyn FnMut(&Progress) -> ControlFlow<()> + Send + 'a;

/// What is asked. `Options::default()` is right for most uses.
pub struct Options<'a> {
    /// Boundary normals. Default: fitted to the surroundings.
    pub normals: BoundaryNormals<'a>,
    /// Normals of fixed vertices inside the region that have none given. Default: the surface passes smoothly.
    pub interior: InteriorNormals,
    /// What `Delta_B H` has to be. Default: zero.
    pub target: Target,
    /// Inner fairness. Default: uniform.
    pub inner: InnerFairness,
    /// Discretization. Default: second order.
    pub discretization: Discretization,
    /// Solver. Default: the fast one.
    pub solver: Solver,
    /// Stop when the step norm (rms normal step + rms tangential step, over the region's bounding-box
    /// diagonal) is below this. Default 1e-8; 1e-6 is enough for interactive use. In (0, 1).
    pub tolerance: f64,
    /// At most this many nonlinear iterations in all. Default 500. At least 1.
    pub max_iterations: usize,
    /// Worker threads; 0 (default): as many as the machine has. Any number gives the same bits.
    pub threads: usize,
    /// Called on the calling thread: after every iteration, more often while the start is made, and every 50 ms where nothing
    /// is new. `Break` stops the run with the best surface so far; before there is one, with the input.
    pub progress: Option<&'a mut Watcher<'a>>,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self {
            normals: BoundaryNormals::default(),
            interior: InteriorNormals::default(),
            target: Target::default(),
            inner: InnerFairness::default(),
            discretization: Discretization::default(),
            solver: Solver::default(),
            tolerance: 1e-8,
            max_iterations: 500,
            threads: 0,
            progress: None,
        }
    }
}

/// How far a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Between 0 and 1, never falling.
    pub fraction: f64,
    /// Nonlinear iterations so far.
    pub iterations: usize,
    /// The last step norm, in diagonals.
    pub step: f64,
    /// What is being done, in a word or two.
    pub stage: &'static str,
}

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
    /// A sound surface whose step norm stayed above the tolerance, or that holds with the first-order
    /// curvature alone (the reason says which).
    ConvergedLoosely {
        /// What was met.
        reason: String,
    },
    /// No surface with the prescribed boundary normals was found; the linear surface is returned.
    NormalsNotReachable {
        /// How much of the way from the membrane's normals to the prescribed ones was found, 0 to 1.
        reached: f64,
        /// The boundary vertices whose normals stood farthest away, worst first.
        vertices: Vec<u32>,
    },
    /// A surface was found only for a part of the right-hand side of [`Options::target`]; the linear surface is returned.
    TargetNotReachable {
        /// The part, 0 to 1: a constant `c` was too large by the inverse.
        reached: f64,
    },
    /// No sound nonlinear surface was found; the linear surface is returned.
    NotConverged,
    /// The iteration limit was reached; the best surface so far is returned.
    IterationLimit,
    /// The progress callback stopped the run; the best surface so far is returned, before there is one the input.
    Cancelled,
}

impl Outcome {
    /// Tolerance met and the surface is sound: the only case without reservation.
    pub fn is_success(&self) -> bool {
        matches!(self, Outcome::Converged)
    }

    /// A stable lower-case name: `converged`, `converged_poor_triangles`, `converged_loosely`,
    /// `normals_not_reachable`, `target_not_reachable`, `not_converged`, `iteration_limit`, `cancelled`.
    pub fn name(&self) -> &'static str {
        match self {
            Outcome::Converged => "converged",
            Outcome::ConvergedPoorTriangles { .. } => "converged_poor_triangles",
            Outcome::ConvergedLoosely { .. } => "converged_loosely",
            Outcome::NormalsNotReachable { .. } => "normals_not_reachable",
            Outcome::TargetNotReachable { .. } => "target_not_reachable",
            Outcome::NotConverged => "not_converged",
            Outcome::IterationLimit => "iteration_limit",
            Outcome::Cancelled => "cancelled",
        }
    }
}

/// Wall seconds per stage.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Seconds {
    /// Half-edges, rings, boundary normals.
    pub setup: f64,
    /// Symbolic analysis, membrane and linear start.
    pub start: f64,
    /// Nonlinear iterations.
    pub iterate: f64,
    /// Soundness figures.
    pub quality: f64,
    /// All of it.
    pub total: f64,
}

/// What came of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// What `Delta_B H` was to be.
    pub target: Target,
    /// How the run ended.
    pub outcome: Outcome,
    /// Nonlinear iterations.
    pub iterations: usize,
    /// Defect `max_i |sum_j w_ij (H_i - H_j) + (2 A_i / 3) rhs_i| / sum_j |w_ij| x L` of the equation `Delta_B H = rhs`,
    /// `A_i` the area of the 1-disk, `L` the region's diagonal.
    pub defect: f64,
    /// The last step norm, in diagonals.
    pub step: f64,
    /// Seconds per stage.
    pub seconds: Seconds,
    /// Soundness of the result.
    pub quality: Quality,
    /// The levels of [`Solver::Paper`] from the base to the given mesh; empty for the fast solver.
    pub levels: Vec<LevelReport>,
    /// Number of free vertices.
    pub free_vertices: usize,
    /// The region's bounding-box diagonal, in the unit of the positions.
    pub diagonal: f64,
    /// The returned surface is the linear one: no sound nonlinear surface was found.
    pub linear_surface: bool,
    /// Boundary vertices whose prescribed normal points against the surface beside it or contradicts its
    /// neighbours': probably flipped or wrong.
    pub suspicious_normals: Vec<u32>,
    /// Free vertices that took fallback weights, because their input triangles allow no conformal or
    /// convex ones; all of them where no surface was found with those, and the vertices are spread evenly.
    pub fallback_weights: usize,
}

/// The result: all vertices of the mesh, and the report.
#[derive(Debug, Clone)]
pub struct Solution {
    /// All positions; fixed vertices keep their bits.
    pub positions: Vec<[f64; 3]>,
    /// The boundary vertices and the unit normals that were used there.
    pub boundary_normals: Vec<(u32, [f64; 3])>,
    /// Free vertices and the mean curvature of the result there; negative on a sphere with outward normals.
    pub mean_curvature: Vec<(u32, f64)>,
    /// Free vertices and the Gaussian curvature of the result there; positive on a sphere.
    pub gaussian_curvature: Vec<(u32, f64)>,
    /// How it went.
    pub report: Report,
}

/// Moves the free vertices of a triangle mesh until the surface solves `Delta_B H = 0` (paper (12)), or what
/// [`Options::target`] asks, between the fixed vertices, with tangent continuity there.
///
/// `positions` is #V by 3, `triangles` #T by 3, counter-clockwise seen from the side that normals point to.
///
/// # Errors
/// Anything in the region or the ring of triangles around it that makes the problem meaningless; see [`Error`].
pub fn fair(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    options: Options<'_>,
) -> Result<Solution, Error> {
    check(&options)?;
    let request = Request {
        positions,
        triangles,
        selection,
        normals: options.normals,
        interior: options.interior,
        target: options.target,
        inner: options.inner,
        discretization: options.discretization,
        solver: options.solver,
        tolerance: options.tolerance,
        max_iterations: options.max_iterations,
    };
    let progress = options.progress;
    with_threads(options.threads, |pool| match progress {
        None => pool.install(|| run(&request, None, &Interrupt::default())),
        Some(callback) => relay(pool, callback, |told, interrupt| {
            run(&request, Some(told), interrupt)
        })?,
    })?
}

/// What is asked, without the callback.
struct Request<'a> {
    positions: &'a [[f64; 3]],
    triangles: &'a [[u32; 3]],
    selection: Selection<'a>,
    normals: BoundaryNormals<'a>,
    interior: InteriorNormals,
    target: Target,
    inner: InnerFairness,
    discretization: Discretization,
    solver: Solver,
    tolerance: f64,
    max_iterations: usize,
}

/// Checks the ranges.
pub(crate) fn check(options: &Options<'_>) -> Result<(), Error> {
    if !(options.tolerance > 0.0 && options.tolerance < 1.0) {
        return Err(Error::BadOption {
            name: "tolerance",
            value: options.tolerance,
            range: "greater than 0 and less than 1",
        });
    }
    if let Target::Constant(c) = options.target
        && !c.is_finite()
    {
        return Err(Error::BadOption {
            name: "target",
            value: c,
            range: "a finite constant",
        });
    }
    if options.max_iterations == 0 {
        return Err(Error::BadOption {
            name: "max_iterations",
            value: 0.0,
            range: "at least 1",
        });
    }
    match &options.solver {
        Solver::Fast => Ok(()),
        Solver::Paper(options) => solvers::check(options),
    }
}

fn run<'a>(
    request: &Request<'_>,
    progress: Option<&'a mut Callback<'a>>,
    interrupt: &Interrupt,
) -> Result<Solution, Error> {
    let clock = Instant::now();
    let mut seconds = Seconds::default();
    let prescribed = given_vertices(request.normals);
    let region = Region::with_normals(request.positions, request.triangles, request.selection, |v| {
        prescribed.binary_search(&v).is_ok()
    })?;
    let rings = Rings::new(&region);
    let mut x = region.positions(request.positions);
    let normalization = Normalization::new(&region, &x);
    normalization.enter(&mut x);
    let (boundary_normals, smooth_interior) =
        boundary_normals(&region, &rings, &x, request.normals, request.interior)?;
    let batches = ValenceBatches::new(&rings);
    let weights = match request.inner {
        InnerFairness::Uniform => FairnessWeights::uniform(),
        InnerFairness::Conformal => FairnessWeights::conformal(&batches, &x),
        InnerFairness::Convex => FairnessWeights::convex(&batches, &x),
    };
    let fallback_weights = weights.clamped;
    seconds.setup = clock.elapsed().as_secs_f64();
    let problem = Problem {
        region: &region,
        rings: &rings,
        batches: &batches,
        input: &x,
        boundary_normals: &boundary_normals,
        smooth_interior: &smooth_interior,
        weights: &weights,
        weigh: match request.inner {
            InnerFairness::Uniform => None,
            InnerFairness::Conformal => Some(FairnessWeights::conformal),
            InnerFairness::Convex => Some(FairnessWeights::convex),
        },
        right_hand_side: request.target.right_hand_side(normalization.scale),
    };
    let faired = match request.solver {
        Solver::Fast => solvers::fast(&problem, request, progress, interrupt),
        Solver::Paper(options) => solvers::paper(&problem, &options, progress),
    }
    .map_err(|_| Error::NothingFixed { vertex: 0 })?;
    let given = Given {
        positions: request.positions,
        target: request.target,
        region: &region,
        rings: &rings,
        input: &x,
        normalization: &normalization,
        fallback_weights,
    };
    Ok(conclude(&given, faired, seconds, clock))
}

/// What a result is measured against.
struct Given<'a> {
    positions: &'a [[f64; 3]],
    target: Target,
    region: &'a Region,
    rings: &'a Rings,
    /// The region's positions, in the normalization.
    input: &'a [nalgebra::Vector3<f64>],
    normalization: &'a Normalization,
    fallback_weights: usize,
}

/// Measures the surface, and takes it back to the host's numbers and units. `clock` has run since the beginning.
fn conclude(given: &Given<'_>, faired: Faired, mut seconds: Seconds, clock: Instant) -> Solution {
    let (region, normalization) = (given.region, given.normalization);
    let solved = &faired.solved;
    seconds.start = solved.start_seconds;
    seconds.iterate = clock.elapsed().as_secs_f64() - seconds.start - seconds.setup;
    let surface = Surface {
        region,
        x: &solved.x,
        normals: &faired.state.corrected,
        boundary_normals: &faired.boundary_normals,
        h: &faired.state.h,
    };
    let mut quality = surface.quality();
    for h in quality.h_inside.iter_mut().chain(&mut quality.h_boundary) {
        *h /= normalization.scale;
    }
    let mut positions = given.positions.to_vec();
    for ((p, before), &v) in solved.x[..region.free]
        .iter()
        .zip(given.input)
        .zip(&region.vertex_ids)
    {
        // What has not moved keeps its bits, without the rounding of the normalization.
        if p != before {
            positions[v as usize] = normalization.leave(p);
        }
    }
    let boundary = region.vertex_ids[region.free..region.region_vertices()].iter();
    let mut boundary_normals: Vec<(u32, [f64; 3])> = boundary
        .zip(&faired.boundary_normals)
        .map(|(&v, n)| (v, (*n).into()))
        .collect();
    // One for each side of a curve, all alike.
    boundary_normals.dedup_by_key(|(v, _)| *v);
    let inside = |values: &[f64], unit: f64| -> Vec<(u32, f64)> {
        let ids = region.vertex_ids[..region.free].iter();
        ids.zip(values).map(|(&v, x)| (v, x / unit)).collect()
    };
    let mean_curvature = inside(&faired.state.h, normalization.scale);
    let gaussian_curvature = inside(&faired.state.k, normalization.scale * normalization.scale);
    seconds.total = clock.elapsed().as_secs_f64();
    seconds.quality = seconds.total - seconds.iterate - seconds.start - seconds.setup;
    let suspicious_normals = surface.suspicious_normals(given.rings, given.input);
    let local_ids = |list: &[u32], of: &[u32]| list.iter().map(|&t| of[t as usize]).collect::<Vec<u32>>();
    let boundary_ids = &region.vertex_ids[region.free..];
    let linear_surface = matches!(
        solved.ending,
        Ending::Failed | Ending::Partly(..) | Ending::Loaded(..)
    );
    let report = Report {
        target: given.target,
        outcome: match &solved.ending {
            Ending::Converged | Ending::FirstOrder if solved.poor.is_empty() && !suspicious_normals.is_empty() => {
                Outcome::ConvergedLoosely {
                    reason: "boundary normals point against the surface beside them: probably flipped".to_owned(),
                }
            }
            Ending::Converged if solved.poor.is_empty() && faired.rounding => Outcome::ConvergedLoosely {
                reason: "max |Delta_B H| is as small as the rounding of positions allows, but above its limit".to_owned(),
            },
            Ending::Converged if solved.poor.is_empty() => Outcome::Converged,
            Ending::FirstOrder if solved.poor.is_empty() => Outcome::ConvergedLoosely {
                reason: "the surface holds with the first-order curvature alone".to_owned(),
            },
            Ending::Converged | Ending::FirstOrder => Outcome::ConvergedPoorTriangles {
                triangles: local_ids(&solved.poor, &region.half_edges.triangle_ids),
            },
            Ending::Stopped if faired.cancelled => Outcome::Cancelled,
            Ending::Stopped => Outcome::IterationLimit,
            Ending::Partly(reached, farthest) => Outcome::NormalsNotReachable {
                reached: *reached,
                vertices: local_ids(farthest, boundary_ids),
            },
            Ending::Loaded(reached) => Outcome::TargetNotReachable { reached: *reached },
            Ending::Doubtful if solved.poor.is_empty() => Outcome::ConvergedLoosely {
                reason: "the surface has a bump: its curvature inside exceeds what the boundary allows, or it leaves single boundary normals".to_owned(),
            },
            Ending::Doubtful => Outcome::ConvergedPoorTriangles {
                triangles: local_ids(&solved.poor, &region.half_edges.triangle_ids),
            },
            Ending::Failed => Outcome::NotConverged,
        },
        iterations: faired.iterations,
        defect: faired.defect,
        step: solved.step,
        seconds,
        quality,
        levels: faired.levels,
        free_vertices: region.free,
        diagonal: diagonal(&solved.x) * normalization.scale,
        linear_surface,
        suspicious_normals,
        fallback_weights: if solved.even { region.free } else { given.fallback_weights },
    };
    Solution {
        positions,
        boundary_normals,
        mean_curvature,
        gaussian_curvature,
        report,
    }
}
