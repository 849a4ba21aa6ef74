//! `fairmesh fair`: files in, files out.

mod input;
mod remesh;

use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use fairmesh::{Options, Outcome, OutputPrecision, Progress, Solution, SolverKind};
use serde_json::Value;

use crate::advice::may_depend_on_triangles;
use crate::bar::Bar;
use crate::batch::{self, Done, Telling};
use crate::comparison::{MeshSide, PictureArgs, story};
use crate::continuity::ContinuityArgs;
use crate::explain;
use crate::failure::{ExitCode, Failure};
use crate::formats::{self, Format, MeshFile, Written, references};
use crate::jobs::{FilesArgs, Job};
use crate::orientation::{self, oriented};
use crate::output::Output;
use crate::report::{Summary, Times};
use crate::seams;
use crate::selection::{self, RegionArgs};
use crate::sharp_edges::SharpArgs;
use crate::solver::SolverArgs;
use crate::surface::{IntersectionArgs, MeshArgs, SurfaceArgs};
use input::FairInput;

/// What `fairmesh fair` is asked.
#[derive(Debug, Args)]
pub struct FairArgs {
    #[command(flatten)]
    files: FilesArgs,
    /// Also write the report as JSON; '-': to stdout, instead of the text
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// No progress bar, no report; errors are still printed
    #[arg(short, long)]
    quiet: bool,
    /// List in the report every attempt, on which mesh, and how it ended
    #[arg(short, long, conflicts_with = "quiet")]
    verbose: bool,
    #[command(flatten)]
    mesh: MeshArgs,
    #[command(flatten)]
    region: RegionArgs,
    /// Normals along the boundary of the region: 'fitted' to the surroundings,
    /// 'averaged' over the triangles outside, or a text file with
    /// 'vertex nx ny nz' per line (others are fitted)
    #[arg(
        long,
        visible_alias = "boundary-normals",
        value_name = "WHICH",
        default_value = "fitted",
        help_heading = "Surface",
        verbatim_doc_comment
    )]
    normals: PathBuf,
    #[command(flatten)]
    continuity: ContinuityArgs,
    #[command(flatten)]
    sharp: SharpArgs,
    #[command(flatten)]
    surface: SurfaceArgs,
    #[command(flatten)]
    intersections: IntersectionArgs,
    /// Triangulate the region anew first, with edges as long as those around it:
    /// for features whose vertices would crowd. If that leads to no sound surface,
    /// the region is deleted and the hole filled. The output then has only
    /// vertices and triangles
    #[arg(long, help_heading = "Surface", verbatim_doc_comment)]
    remesh: bool,
    #[command(flatten)]
    pictures: PictureArgs,
    #[command(flatten)]
    solver: SolverArgs,
    /// Stop when the vertices move less than this part of the region's
    /// diagonal, between 0 and 1 [default: 1e-8]
    #[arg(long, value_name = "X", help_heading = "Solver", verbatim_doc_comment)]
    tolerance: Option<f64>,
    /// Worker threads; 0: one per processor.
    /// The result does not depend on it
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        help_heading = "Solver",
        verbatim_doc_comment
    )]
    threads: usize,
}

/// Runs the command on every mesh.
pub fn run(args: &FairArgs) -> Result<ExitCode, Failure> {
    let telling = Telling {
        json: args.json.as_deref(),
        is_quiet: args.quiet,
        is_verbose: args.verbose,
    };
    args.pictures.check(args.files.inputs())?;
    batch::run(&args.files, &telling, |job| one(args, job))
}

/// Fairs a mesh; good if the surface converged and is sound.
fn one(args: &FairArgs, job: &Job) -> Result<Done, Failure> {
    let start = Instant::now();
    let format = Format::of(&job.output, job.piped.output)?;
    let mesh = MeshFile::read(&job.input, job.piped.input)?;
    let (mesh, turned) = oriented(&job.input, mesh, &args.mesh)?;
    let input = input(args, &job.input, &mesh)?;
    let solver = args.solver.solver()?;
    if !args.remesh {
        mesh.check_writable(&job.input, format)?;
    }
    let precision = if format == mesh.format() && !args.remesh {
        mesh.output_precision()
    } else {
        format.output_precision()
    };
    let output = Output::prepare_or_stdout(&job.output)?;
    let pictures = args.pictures.prepare(&job.input, &job.output)?;
    let read = start.elapsed().as_secs_f64();

    let solving = Instant::now();
    let refused = |error| {
        let failure = explain::refusal(&job.input, &mesh, &error);
        seams::advised(failure, &error, &mesh.geometry, args.mesh.coincident)
    };
    let input = match args.remesh {
        true => with_other_triangles(args, solver, &input).map_err(refused)?,
        false => input,
    };
    let solution = solve(args, solver, &input, args.tolerance, precision).map_err(refused)?;
    let solve = solving.elapsed().as_secs_f64();

    // Nobody reads the advice of a quiet run.
    let is_told = !args.quiet || job.asks_json || pictures.is_some();
    let has_with_others = (is_told && !args.remesh && may_depend_on_triangles(&solution.report.outcome))
        .then(|| has_with_others(args, solver, &input));

    let writing = Instant::now();
    let written = if args.remesh {
        plain(format, &solution, &input.geometry.triangles)
    } else if format == mesh.format() {
        mesh.with_positions(&solution.positions)
    } else {
        plain(format, &solution, &mesh.geometry.polygons())
    };
    let led = references::led(written.bytes, format, &job.input, &job.output);
    output.write(&led.bytes)?;
    let mut summary = Summary {
        report: &solution.report,
        geometry: &input.geometry,
        region: &input.region,
        times: Times {
            read,
            solve,
            write: writing.elapsed().as_secs_f64(),
            pictures: None,
            total: start.elapsed().as_secs_f64(),
        },
        stale_normals: written.stale_normals,
        is_verbose: args.verbose,
        asked: args.continuity.asked(),
        has_with_others,
    };
    if let Some(pictures) = &pictures {
        let after = MeshSide {
            positions: &solution.positions,
            triangles: &input.geometry.triangles,
        };
        let asked = args.continuity.asked();
        let story = story::of_fairing(&solution.report, asked, summary.advice(), summary.readable());
        summary.times.pictures = Some(pictures.write(mesh.geometry.surface(), after, &story)?);
        summary.times.total = start.elapsed().as_secs_f64();
    }
    Ok(Done {
        is_good: solution.report.outcome == Outcome::Converged,
        outcome: solution.report.outcome.name().replace('_', " "),
        json: match job.asks_json {
            true => {
                let mut json = summary.json();
                json["turned_faces"] = turned.into();
                json
            }
            false => Value::Null,
        },
        readable: orientation::turned(turned) + &summary.readable(),
        references: led.told,
    })
}

/// The region triangulated anew.
fn with_other_triangles(
    args: &FairArgs,
    solver: SolverKind,
    input: &FairInput<'_>,
) -> Result<FairInput<'static>, fairmesh::Error> {
    let tolerance = Some(remesh::TOLERANCE);
    let rough = solve(args, solver, input, tolerance, OutputPrecision::Double)?;
    remesh::remesh(input, &rough, args.mesh.coincident, args.threads)
}

/// Whether `--remesh` leads to a sound surface.
fn has_with_others(args: &FairArgs, solver: SolverKind, input: &FairInput<'_>) -> bool {
    let Ok(others) = with_other_triangles(args, solver, input) else {
        return false;
    };
    let solution = solve(args, solver, &others, args.tolerance, OutputPrecision::Double);
    solution.is_ok_and(|solution| solution.report.outcome.is_success())
}

/// What the user chose in a file.
fn input<'a>(args: &FairArgs, name: &Path, mesh: &'a MeshFile) -> Result<FairInput<'a>, Failure> {
    let found = selection::find(mesh, name, &args.region, args.mesh.coincident)?;
    let geometry = &mesh.geometry;
    let vertex_count = geometry.positions.len();
    Ok(FairInput {
        geometry: Cow::Borrowed(geometry),
        selected: found.selected.in_triangles(geometry),
        region: found.report,
        boundary_normals: selection::boundary_normals(&args.normals, vertex_count)?,
        boundary_curvature: args.continuity.boundary_curvature(vertex_count)?,
        loop_continuity: args.continuity.continuity_at.clone(),
        marked_edges: args.sharp.marked_edges(),
    })
}

/// A new file with the result.
fn plain(format: Format, solution: &Solution, polygons: &[impl AsRef<[u32]>]) -> Written {
    Written {
        bytes: formats::plain(format, &solution.positions, polygons),
        stale_normals: 0,
    }
}

/// The library's call.
fn solve(
    args: &FairArgs,
    solver: SolverKind,
    input: &FairInput<'_>,
    tolerance: Option<f64>,
    output_precision: OutputPrecision,
) -> Result<Solution, fairmesh::Error> {
    let defaults = Options::default();
    let surface = &args.surface;
    let options = Options {
        boundary_normals: input.boundary_normals.clone(),
        interior_normals: surface.interior_normals(),
        continuity: args.continuity.continuity,
        loop_continuity: input.loop_continuity.clone(),
        boundary_curvature: input.boundary_curvature.clone(),
        sharp: args.sharp.sharp,
        marked_edges: input.marked_edges.clone(),
        target: surface.target,
        inner_fairness: surface.inner_fairness(),
        discretization: surface.discretization(),
        solver,
        tolerance: tolerance.unwrap_or(defaults.tolerance),
        max_iterations: args.solver.max_iterations.unwrap_or(defaults.max_iterations),
        output_precision,
        threads: args.threads,
        intersections: args.intersections.intersections(),
        coincident: args.mesh.coincident,
    };
    let mut bar = Bar::new(args.quiet);
    let geometry = &input.geometry;
    let solution = fairmesh::fair_with_progress(
        &geometry.positions,
        &geometry.triangles,
        input.selected.selection(),
        &options,
        &mut |progress: &Progress| bar.show(progress),
    );
    bar.finish();
    solution
}
