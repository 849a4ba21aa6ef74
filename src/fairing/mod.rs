//! The public entry: `fair`.

mod boundary_curvature;
mod component_solution;
mod component_weights;
mod conclusion;
mod continuity;
mod edit;
mod joined;
mod normalization;
mod normals;
mod options;
mod outcome;
mod prepared;
mod report;
mod sharp;
mod sharp_edge;
mod solver;
mod whole_intersections;
mod whole_solution;
#[cfg_attr(target_family = "wasm", path = "single_thread.rs")]
mod workers;

use std::ops::ControlFlow;

use fairmesh_linear::interrupt::unless_stopped;

pub use crate::discrete::target::Target;
use crate::mesh::Joined;
pub use crate::mesh::coincident::Coincident;
pub use crate::mesh::selection::Selection;
use crate::paper::{self, PaperResult};
use crate::solve::control::Callback;
use crate::solve::{Control, Ladder};
use crate::support::error::Error;
use crate::support::profile;
use crate::support::stopwatch::Stopwatch;
pub use boundary_curvature::BoundaryCurvature;
use component_solution::ComponentSolution;
use component_weights::{ComponentWeights, PREPARED};
use conclusion::Found;
pub use continuity::CurvatureContinuity;
pub(crate) use continuity::check_loops;
pub use edit::{Budget, Edit, Frame};
pub(crate) use joined::{in_given, joined_options};
pub use normals::{BoundaryNormals, InteriorNormals};
pub use options::{Discretization, InnerFairness, Intersections, Options, OutputPrecision, SolverKind};
pub use outcome::{LooseReason, Outcome};
use prepared::Prepared;
pub use report::{
    Attempt, AttemptEnd, ComponentReport, Progress, ProgressCallback, Report, Seconds, SelfIntersections,
    Solution,
};
use sharp::SharpEdges;
pub use sharp::crease_ends;
pub(crate) use sharp::{
    BoundaryCrease, Branch, CreasePoint, GivenCrease, Knot, creases_around, may_be_creased,
};
pub use sharp_edge::{CreaseEnd, SharpEdge, SharpFate};
pub use solver::Solver;
use whole_solution::whole;
pub(crate) use workers::Workers;
use workers::relay;

/// Moves the free vertices of a triangle mesh until the surface solves `Delta_B H = 0` (paper (12)), or what
/// [`Options::target`] asks, between the fixed vertices, with tangent continuity there.
///
/// `positions` is #V by 3, `triangles` #T by 3, counter-clockwise seen from the side that normals point to. Coincident vertices
/// are one vertex of the surface, see [`Coincident`]. Components of the region are independent problems, see
/// [`ComponentReport`].
///
/// ```
/// # // A plane of 7 by 7 vertices with a bump; the nine in the middle are free.
/// # let at = |v: u32| [f64::from(v % 7), f64::from(v / 7), if v == 24 { 1.0 } else { 0.0 }];
/// # let positions: Vec<[f64; 3]> = (0..49).map(at).collect();
/// # let cell = |c: u32| { let v = c / 6 * 7 + c % 6; [[v, v + 1, v + 8], [v, v + 8, v + 7]] };
/// # let triangles: Vec<[u32; 3]> = (0..36).flat_map(cell).collect();
/// # let free = [16, 17, 18, 23, 24, 25, 30, 31, 32];
/// use fairmesh::{Options, Selection, fair};
///
/// let solution = fair(&positions, &triangles, Selection::Vertices(&free), &Options::default())?;
/// assert!(solution.report.outcome.is_success());
/// assert!(solution.positions[24][2].abs() < 1e-7); // the bump is gone
/// # Ok::<(), fairmesh::Error>(())
/// ```
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
    Workers::new(options.threads)?
        .install(|| run_joined(positions, triangles, selection, (options, &[]), None))
}

/// [`fair`], which calls `progress` on the calling thread: after every iteration, more often while the start is made, and
/// every 20 ms where nothing is new; in components of less than a thousandth of all free vertices, whenever another
/// thousandth is done. The last call has the fraction 1, unless the run is stopped. `Break` stops the run with the best surface
/// so far; before there is one, with the input. Components that are done then keep their results.
///
/// ```
/// # // A plane of 7 by 7 vertices with a bump; the nine in the middle are free.
/// # let at = |v: u32| [f64::from(v % 7), f64::from(v / 7), if v == 24 { 1.0 } else { 0.0 }];
/// # let positions: Vec<[f64; 3]> = (0..49).map(at).collect();
/// # let cell = |c: u32| { let v = c / 6 * 7 + c % 6; [[v, v + 1, v + 8], [v, v + 8, v + 7]] };
/// # let triangles: Vec<[u32; 3]> = (0..36).flat_map(cell).collect();
/// # let free = [16, 17, 18, 23, 24, 25, 30, 31, 32];
/// use fairmesh::{Options, Outcome, Progress, Selection, fair_with_progress};
/// use std::ops::ControlFlow;
///
/// let mut stop = |_: &Progress| ControlFlow::Break(());
/// let selection = Selection::Vertices(&free);
/// let solution = fair_with_progress(&positions, &triangles, selection, &Options::default(), &mut stop)?;
/// assert_eq!(solution.report.outcome, Outcome::Cancelled);
/// # Ok::<(), fairmesh::Error>(())
/// ```
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
    relay(
        &Workers::new(options.threads)?,
        progress,
        true,
        |told| run_joined(positions, triangles, selection, (options, &[]), Some(told)),
        Result::is_ok,
    )?
}

/// [`fair`] as a part of another run, on its threads, which tells of it and stops it. The options are valid.
pub(crate) fn fair_within(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    options: &Options,
    progress: &mut ProgressCallback<'_>,
) -> Result<Solution, Error> {
    fair_along(positions, triangles, selection, (options, &[]), progress)
}

/// The same, with creases laid through the region. Coincident vertices are separate ones then.
pub(crate) fn fair_along(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    how: (&Options, &[GivenCrease]),
    progress: &mut ProgressCallback<'_>,
) -> Result<Solution, Error> {
    let mut tell = |fraction, iterations, step, phase| {
        progress(&Progress {
            fraction,
            iterations,
            step,
            phase,
        })
    };
    run_joined(positions, triangles, selection, how, Some(&mut tell))
}

/// Runs `work` on a pool of so many threads. It is handed what tells `progress`, which is called on this thread.
pub(crate) fn on_workers<T: Send>(
    threads: usize,
    progress: Option<&mut ProgressCallback<'_>>,
    work: impl FnOnce(&mut ProgressCallback<'_>) -> Result<T, Error> + Send,
) -> Result<T, Error> {
    let workers = Workers::new(threads)?;
    match progress {
        Some(progress) => relay(
            &workers,
            progress,
            true,
            |told| work(&mut |p: &Progress| told(p.fraction, p.iterations, p.step, p.phase)),
            Result::is_ok,
        )?,
        None => {
            let mut untold = |_: &Progress| ControlFlow::Continue(());
            workers.install(|| work(&mut untold))
        }
    }
}

/// The same for work that tells fractions of itself, and has no result where it is stopped: none then.
pub(crate) fn on_workers_unless_stopped<T: Send>(
    threads: usize,
    progress: &mut ProgressCallback<'_>,
    phase: &'static str,
    work: impl FnOnce(&mut dyn FnMut(f64)) -> Result<T, Error> + Send,
) -> Result<Option<T>, Error> {
    on_workers(threads, Some(progress), |progress| {
        let mut tell = |fraction: f64| {
            // Whatever takes long looks by itself whether it is to stop.
            let _ = progress(&Progress {
                fraction,
                iterations: 0,
                step: f64::NAN,
                phase,
            });
        };
        unless_stopped(|| work(&mut tell)).transpose()
    })
}

/// The surface of the joined mesh, for all copies of its vertices.
fn run_joined<'a>(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    (options, creases): (&Options, &[GivenCrease]),
    progress: Option<&'a mut Callback<'a>>,
) -> Result<Solution, Error> {
    let clock = Stopwatch::start();
    let joined = {
        let _clock = profile::clock("coincident vertices");
        Joined::new(positions, triangles, options.coincident)?
    };
    let selected = joined.copies.selection(selection);
    let asked = joined_options(&joined.copies, options);
    let seconds = clock.seconds();
    let mut solution = run(
        positions,
        &joined.triangles,
        selected.selection(),
        (&asked, creases),
        progress,
    )
    .map_err(|error| in_given(error, &joined.copies, options))?;
    joined::spread(&mut solution, positions, &joined.copies);
    solution.report.seconds.setup += seconds;
    solution.report.seconds.total += seconds;
    Ok(solution)
}

fn run<'a>(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    (options, creases): (&Options, &[GivenCrease]),
    progress: Option<&'a mut Callback<'a>>,
) -> Result<Solution, Error> {
    let clock = Stopwatch::start();
    let _clock = profile::clock("rest");
    let components = Prepared::of_components(
        positions,
        triangles,
        selection,
        options,
        options.asks_continuity(),
    )?;
    let sharp = SharpEdges::find(positions, triangles, &components, options, creases);
    let components = match &sharp.parted {
        Some(parted) => parted.prepared(options)?,
        None => components,
    };
    let setup = clock.seconds();
    let undone = components.iter().map(|prepared| (prepared.free(), 0.0));
    let mut shares = ComponentWeights::new(progress, PREPARED, undone);
    let mut solutions = Vec::with_capacity(components.len());
    for prepared in components {
        solutions.push(component(&prepared, options, &mut shares)?);
        shares.end(prepared.free(), 1.0);
    }
    solutions[0].seconds.setup = setup;
    if let Some(parted) = &sharp.parted {
        parted.restore(&mut solutions);
        parted.judge_between(positions, &mut solutions);
    }
    sharp.judge(&mut solutions);
    let mut solution = whole(positions, triangles, options, &solutions);
    solution.report.sharp_edges = sharp.told;
    Ok(solution)
}

/// Solves one component.
fn component(
    prepared: &Prepared,
    options: &Options,
    shares: &mut ComponentWeights<'_>,
) -> Result<ComponentSolution, Error> {
    let clock = Stopwatch::start();
    let problem = prepared.problem();
    let mut tell =
        |fraction, iterations, step, phase| shares.tell(prepared.free(), (fraction, iterations, step, phase));
    let nothing_fixed = |_| prepared.nothing_fixed();
    let (result, state, levels) = match &options.solver {
        SolverKind::Fast => {
            let mut control = Control::new(options.tolerance, options.max_iterations, Some(&mut tell));
            let (result, state) = Ladder::default()
                .solve(&problem, &mut control)
                .map_err(nothing_fixed)?;
            (result, state, Vec::new())
        }
        SolverKind::Paper(paper) => {
            let mut control = Control::new(paper.defect, paper.max_updates, Some(&mut tell));
            let PaperResult {
                result,
                state,
                levels,
            } = paper::solve(&problem, paper, &mut control).map_err(nothing_fixed)?;
            (result, state, levels)
        }
    };
    let seconds = Seconds {
        start: result.start_seconds,
        iterate: clock.seconds() - result.start_seconds,
        ..Seconds::default()
    };
    let found = Found {
        prepared,
        output_precision: options.output_precision,
        result: &result,
        state: &state,
        levels,
        seconds,
    };
    Ok(found.conclude())
}
