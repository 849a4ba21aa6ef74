//! `fairmesh fair`: a file in, a file out.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::{Args, ValueEnum};
use fairmesh::{
    BoundaryNormals, Discretization, InnerFairness, InteriorNormals, Options, Outcome, Progress, Selection,
    Solution, Solver, Target,
};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::explain;
use crate::failure::Failure;
use crate::formats::{self, Format, Geometry, Kind, MeshFile};
use crate::output::Output;
use crate::remesh;
use crate::report::{Summary, Times};
use crate::selection::{self, Selected, Ways};
use crate::solver::SolverArgs;

/// How vertices are distributed within the surface.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Inner {
    /// A regular distribution
    Uniform,
    /// The least distortion of the input's triangles
    Conformal,
    /// Nearly that, by positive weights for any triangles
    Convex,
}

/// How normals and mean curvature are discretized.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Scheme {
    /// Second order on irregular meshes
    SecondOrder,
    /// As Schneider and Kobbelt 2001
    Paper,
}

/// What `fairmesh fair` is asked.
#[derive(Debug, Args)]
pub struct FairArgs {
    /// The mesh: .ply, .obj, .off or .stl
    input: PathBuf,
    /// Where the result goes; may be the input itself. It is written whole or not at all
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Vertices that may move: a text file with one number per line, from 0
    #[arg(long, value_name = "FILE", group = "region", help_heading = "Region")]
    free: Option<PathBuf>,
    /// Faces to be faired: a text file with one number per line, from 0;
    /// a vertex moves if all faces around it are listed
    #[arg(
        long,
        value_name = "FILE",
        group = "region",
        help_heading = "Region",
        verbatim_doc_comment
    )]
    faces: Option<PathBuf>,
    /// Property of a PLY file that is nonzero on what is selected:
    /// NAME, vertex:NAME or face:NAME
    #[arg(
        long,
        value_name = "NAME",
        group = "region",
        help_heading = "Region",
        verbatim_doc_comment
    )]
    selection: Option<String>,
    /// Normals at fixed vertices beside the region: a text file with
    /// 'vertex nx ny nz' per line; the others are fitted to the surroundings
    #[arg(long, value_name = "FILE", help_heading = "Surface", verbatim_doc_comment)]
    normals: Option<PathBuf>,
    /// Boundary normals are the average of the triangles outside the region,
    /// instead of fitted
    #[arg(
        long,
        conflicts_with = "normals",
        help_heading = "Surface",
        verbatim_doc_comment
    )]
    average_normals: bool,
    /// Normals of fixed vertices inside the region come from their triangles
    /// in the input; without, the surface passes them smoothly
    #[arg(long, help_heading = "Surface", verbatim_doc_comment)]
    interior_from_input: bool,
    /// How vertices are distributed within the surface
    #[arg(
        long,
        value_enum,
        value_name = "HOW",
        default_value = "uniform",
        help_heading = "Surface"
    )]
    inner: Inner,
    /// What the Laplacian of the mean curvature H shall be: 'harmonic' (0),
    /// 'constant=C' (C per cubic length, positive: pushes outward) or
    /// 'minimal-energy' (-2 H (H^2 - K))
    #[arg(
        long,
        value_name = "WHAT",
        default_value = "harmonic",
        value_parser = target,
        help_heading = "Surface",
        verbatim_doc_comment
    )]
    target: Target,
    /// How normals and mean curvature are discretized
    #[arg(
        long,
        value_enum,
        value_name = "HOW",
        default_value = "second-order",
        help_heading = "Surface"
    )]
    discretization: Scheme,
    /// Triangulates the region anew before, with edges as long as those
    /// around it: for features whose vertices would crowd. The output then
    /// holds vertices and triangles and nothing else
    #[arg(long, help_heading = "Surface", verbatim_doc_comment)]
    remesh: bool,
    #[command(flatten)]
    solver: SolverArgs,
    /// Stop when the vertices move less than this part of the region's
    /// diagonal, between 0 and 1 [default: 1e-8]
    #[arg(long, value_name = "X", help_heading = "Solver", verbatim_doc_comment)]
    tolerance: Option<f64>,
    /// Stop after this many iterations [default: 500]
    #[arg(long, value_name = "N", help_heading = "Solver")]
    max_iterations: Option<usize>,
    /// Worker threads, 0: as many as the machine has;
    /// the result is the same to the last bit
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        help_heading = "Solver",
        verbatim_doc_comment
    )]
    threads: usize,
    /// Writes the report as JSON, too
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// No progress bar and no report; errors are still told
    #[arg(short, long)]
    quiet: bool,
}

/// Reads `--target`.
fn target(text: &str) -> Result<Target, String> {
    match text {
        "harmonic" => Ok(Target::Harmonic),
        "minimal-energy" => Ok(Target::MinimalEnergy),
        _ => text
            .strip_prefix("constant=")
            .and_then(|c| c.parse::<f64>().ok())
            .filter(|c| c.is_finite())
            .map(Target::Constant)
            .ok_or_else(|| "expected harmonic, constant=NUMBER or minimal-energy".to_owned()),
    }
}

/// The same as text.
pub fn target_name(target: Target) -> String {
    match target {
        Target::Harmonic => "harmonic".to_owned(),
        Target::Constant(c) => format!("constant={c}"),
        Target::MinimalEnergy => "minimal-energy".to_owned(),
    }
}

/// Runs the command; true if the surface converged and is sound.
pub fn run(args: &FairArgs) -> Result<bool, Failure> {
    let start = Instant::now();
    let format = Format::of(&args.output)?;
    let name = args.input.display().to_string();
    let mesh = MeshFile::read(&args.input)?;
    let ways = Ways {
        free: args.free.as_deref(),
        faces: args.faces.as_deref(),
        property: args.selection.as_deref(),
    };
    let selected = selection::find(&mesh, &name, ways)?;
    let vertex_count = mesh.geometry.positions.len();
    let given = args
        .normals
        .as_deref()
        .map(|path| selection::boundary_normals(path, vertex_count))
        .transpose()?;
    let solver = args.solver.solver(args.max_iterations)?;
    let output = Output::prepare(&args.output)?;
    let json = prepare_json(args.json.as_deref(), &[&args.output, &args.input])?;
    let mut times = Times {
        read: start.elapsed().as_secs_f64(),
        ..Times::default()
    };

    let refused =
        |error: fairmesh::Error| Failure::new(format!("{name}: {}", explain::refusal(&error, &mesh)));
    let solving = Instant::now();
    let region = Region::selected(&mesh, &selected, given);
    let remeshed = if args.remesh {
        Some(remesh::remesh(args, solver, &mesh.geometry, &region).map_err(refused)?)
    } else {
        None
    };
    let (geometry, region) = match &remeshed {
        Some((geometry, region)) => (geometry, region),
        None => (&mesh.geometry, &region),
    };
    let solution = solve(args, solver, geometry, region, args.tolerance).map_err(refused)?;
    times.solve = solving.elapsed().as_secs_f64();

    let writing = Instant::now();
    let stale_normals = if args.remesh {
        let triangles: Vec<Vec<u32>> = geometry.triangles.iter().map(|t| t.to_vec()).collect();
        output.write(&formats::plain(format, &solution.positions, &triangles))?;
        0
    } else {
        write(&mesh, format, &solution, &output)?
    };
    times.write = writing.elapsed().as_secs_f64();
    times.total = start.elapsed().as_secs_f64();
    let summary = Summary {
        report: &solution.report,
        geometry,
        times,
        stale_normals,
    };
    if let Some(json) = json {
        json.write(format!("{:#}\n", summary.json()).as_bytes())?;
    }
    if !args.quiet {
        crate::say(&summary.readable());
    }
    Ok(solution.report.outcome == Outcome::Converged)
}

/// Where the report as JSON goes: not over these files.
pub fn prepare_json(json: Option<&Path>, others: &[&Path]) -> Result<Option<Output>, Failure> {
    let Some(path) = json else { return Ok(None) };
    if others.iter().any(|other| same_file(path, other)) {
        return Err(Failure::new(format!(
            "{}: --json would overwrite the mesh; name another file",
            path.display()
        )));
    }
    Output::prepare(path).map(Some)
}

fn same_file(a: &Path, b: &Path) -> bool {
    let resolved = |path: &Path| {
        std::fs::canonicalize(path)
            .or_else(|_| std::path::absolute(path))
            .ok()
    };
    resolved(a) == resolved(b)
}

/// What may move, and the normals given, in the numbers of a mesh of triangles.
pub struct Region {
    pub kind: Kind,
    /// Vertices or triangles.
    pub elements: Vec<u32>,
    pub normals: Option<Vec<(u32, [f64; 3])>>,
}

impl Region {
    fn selected(mesh: &MeshFile, selected: &Selected, normals: Option<Vec<(u32, [f64; 3])>>) -> Self {
        let elements = match selected.kind {
            Kind::Vertex => selected.elements.clone(),
            Kind::Face => triangles_of(mesh, &selected.elements),
        };
        Self {
            kind: selected.kind,
            elements,
            normals,
        }
    }

    /// As the library wants it.
    pub fn selection(&self) -> Selection<'_> {
        match self.kind {
            Kind::Vertex => Selection::Vertices(&self.elements),
            Kind::Face => Selection::Faces(&self.elements),
        }
    }
}

/// The library's call.
pub fn solve(
    args: &FairArgs,
    solver: Solver,
    geometry: &Geometry,
    region: &Region,
    tolerance: Option<f64>,
) -> Result<Solution, fairmesh::Error> {
    let mut bar = Bar::new(args.quiet);
    let mut progress = |progress: &Progress| bar.show(progress);
    let defaults = Options::default();
    let options = Options {
        boundary_normals: match &region.normals {
            Some(given) => BoundaryNormals::Given(given.clone()),
            None if args.average_normals => BoundaryNormals::Averaged,
            None => BoundaryNormals::Fitted,
        },
        interior_normals: if args.interior_from_input {
            InteriorNormals::Input
        } else {
            InteriorNormals::Smooth
        },
        target: args.target,
        inner_fairness: match args.inner {
            Inner::Uniform => InnerFairness::Uniform,
            Inner::Conformal => InnerFairness::Conformal,
            Inner::Convex => InnerFairness::Convex,
        },
        discretization: match args.discretization {
            Scheme::SecondOrder => Discretization::SecondOrder,
            Scheme::Paper => Discretization::Paper,
        },
        solver,
        tolerance: tolerance.unwrap_or(defaults.tolerance),
        max_iterations: args.max_iterations.unwrap_or(defaults.max_iterations),
        threads: args.threads,
    };
    let solution = fairmesh::fair_with_progress(
        &geometry.positions,
        &geometry.triangles,
        region.selection(),
        &options,
        &mut progress,
    );
    bar.finish();
    solution
}

/// The triangles of these polygons.
fn triangles_of(mesh: &MeshFile, polygons: &[u32]) -> Vec<u32> {
    let mut chosen = vec![false; mesh.geometry.polygon_count];
    polygons
        .iter()
        .for_each(|&polygon| chosen[polygon as usize] = true);
    let triangles = 0..mesh.geometry.triangles.len();
    triangles
        .filter(|&t| chosen[mesh.geometry.polygon_of(t)])
        .map(|t| t as u32)
        .collect()
}

/// Writes the result; returns the number of vertices whose normals in the file could not be updated.
fn write(mesh: &MeshFile, format: Format, solution: &Solution, output: &Output) -> Result<usize, Failure> {
    if format == mesh.format() {
        let written = mesh.with_positions(&solution.positions);
        output.write(&written.bytes)?;
        return Ok(written.stale_normals);
    }
    output.write(&formats::plain(
        format,
        &solution.positions,
        &mesh.geometry.polygons(),
    ))?;
    Ok(0)
}

/// The progress bar; it shows itself on a terminal only.
pub struct Bar(ProgressBar);

impl Bar {
    /// Steps of the bar.
    const LENGTH: u64 = 1000;

    /// A bar from 0 to 1; nothing is shown if `quiet`.
    pub fn new(quiet: bool) -> Self {
        let target = if quiet {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let bar = ProgressBar::with_draw_target(Some(Self::LENGTH), target);
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {elapsed}  {wide_msg}") {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(200));
        Self(bar)
    }

    /// Takes it away.
    pub fn finish(&self) {
        self.0.finish_and_clear();
    }

    /// Shows how far the run is.
    pub fn show(&mut self, progress: &Progress) -> ControlFlow<()> {
        self.0
            .set_position((progress.fraction.clamp(0.0, 1.0) * Self::LENGTH as f64) as u64);
        self.0
            .set_message(format!("{}, iteration {}", progress.stage, progress.iterations));
        ControlFlow::Continue(())
    }
}
