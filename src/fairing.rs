//! The public entry: `fair`.

mod normalization;
mod normals;
mod options;
mod relay;
mod report;
mod session;
mod solvers;

use std::time::Instant;

use crate::discrete::inner_fairness::FairnessWeights;
pub use crate::discrete::target::Target;
use crate::discrete::valence_batches::ValenceBatches;
use crate::error::Error;
pub use crate::mesh::region::Selection;
use crate::mesh::{Region, Rings};
use crate::paper::Problem;
use crate::quality::Surface;
use crate::solve::Ending;
use crate::solve::control::{Callback, Interrupt};
use crate::solve::globalize::diagonal;
use normalization::Normalization;
pub use normals::{BoundaryNormals, InteriorNormals};
use normals::{boundary_normals, given_vertices};
pub use options::{Discretization, InnerFairness, Options, Solver};
use relay::relay;
pub(crate) use relay::with_threads;
pub use report::{LooseReason, Outcome, Progress, ProgressCallback, Report, Seconds, Solution};
pub use session::Session;
use solvers::Faired;

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
    options: &Options,
) -> Result<Solution, Error> {
    options.validate()?;
    with_threads(options.threads, |pool| {
        pool.install(|| {
            run(
                positions,
                triangles,
                selection,
                options,
                None,
                &Interrupt::default(),
            )
        })
    })?
}

/// [`fair`], which calls `progress` on the calling thread: after every iteration, more often while the start is made, and
/// every 50 ms where nothing is new. `Break` stops the run with the best surface so far; before there is one, with the input.
///
/// # Errors
/// Those of [`fair`].
pub fn fair_with_progress(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    options: &Options,
    progress: &mut ProgressCallback<'_>,
) -> Result<Solution, Error> {
    options.validate()?;
    with_threads(options.threads, |pool| {
        relay(pool, progress, |told, interrupt| {
            run(positions, triangles, selection, options, Some(told), interrupt)
        })
    })??
}

fn run<'a>(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    options: &Options,
    progress: Option<&'a mut Callback<'a>>,
    interrupt: &Interrupt,
) -> Result<Solution, Error> {
    let clock = Instant::now();
    let mut seconds = Seconds::default();
    let prescribed = given_vertices(&options.boundary_normals);
    let region = Region::with_normals(positions, triangles, selection, |v| {
        prescribed.binary_search(&v).is_ok()
    })?;
    let rings = Rings::new(&region);
    let mut x = region.positions(positions);
    let normalization = Normalization::new(&region, &x);
    normalization.enter(&mut x);
    let (boundary_normals, smooth_interior) = boundary_normals(
        &region,
        &rings,
        &x,
        &options.boundary_normals,
        options.interior_normals,
    )?;
    let batches = ValenceBatches::new(&rings);
    let weights = match options.inner_fairness {
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
        weigh: match options.inner_fairness {
            InnerFairness::Uniform => None,
            InnerFairness::Conformal => Some(FairnessWeights::conformal),
            InnerFairness::Convex => Some(FairnessWeights::convex),
        },
        right_hand_side: options.target.right_hand_side(normalization.scale),
    };
    let faired = match &options.solver {
        Solver::Fast => solvers::fast(&problem, options, progress, interrupt),
        Solver::Paper(paper) => solvers::paper(&problem, paper, progress),
    }
    .map_err(|_| Error::NothingFixed { vertex: 0 })?;
    let given = Given {
        positions,
        target: options.target,
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
    let loosely = |reason| Outcome::ConvergedLoosely { reason };
    let report = Report {
        target: given.target,
        outcome: match &solved.ending {
            Ending::Converged | Ending::FirstOrder
                if solved.poor.is_empty() && !suspicious_normals.is_empty() =>
            {
                loosely(LooseReason::SuspiciousNormals)
            }
            Ending::Converged if solved.poor.is_empty() && faired.rounding => loosely(LooseReason::Rounding),
            Ending::Converged if solved.poor.is_empty() => Outcome::Converged,
            Ending::FirstOrder if solved.poor.is_empty() => loosely(LooseReason::FirstOrderCurvature),
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
            Ending::Doubtful if solved.poor.is_empty() => loosely(LooseReason::Bump),
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
        fallback_weights: if solved.even {
            region.free
        } else {
            given.fallback_weights
        },
    };
    Solution {
        positions,
        boundary_normals,
        mean_curvature,
        gaussian_curvature,
        report,
    }
}
