//! `fairmesh demo`: the paper's blend of three cylinders, before and after.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use fairmesh::{BoundaryNormals, Options, Outcome, Selection, Solution};
use fairmesh_shapes::Shape;

use crate::failure::Failure;
use crate::formats::{self, Format, Geometry};
use crate::output::Output;
use crate::picture::{self, Layout, PictureOptions, Shading, View};
use crate::report::{Summary, Times};

/// What `fairmesh demo` is asked.
#[derive(Debug, Args)]
pub struct DemoArgs {
    /// Directory for start.ply, result.ply and blend.png; made if it does not exist
    directory: PathBuf,
}

/// Noise on the start, in edge lengths: to be seen, and to show that the result does not depend on it.
const ROUGHNESS: f64 = 0.15;

const WHAT_TO_LOOK_AT: &str = "
blend.png shows the start on the left and the result on the right: above as a matte surface, below as a mirror
with rings of light around it. The three circles at the ends are fixed, with the normals of the tubes that would
continue there; the surface between them follows from these circles and normals alone. The start was roughened on
purpose, and its rings are torn; in the result they flow, up to the open ends.

start.ply and result.ply are the two meshes, for any viewer. Next, fair a mesh of your own:
  fairmesh fair part.ply -o fair.ply
";

/// Runs the command; true if the surface converged and is sound.
pub fn run(args: &DemoArgs) -> Result<bool, Failure> {
    let start = Instant::now();
    let directory = &args.directory;
    let name = directory.display();
    fs::create_dir_all(directory)
        .map_err(|why| Failure::new(format!("{name}: cannot make this directory: {why}")))?;
    let shape = fairmesh_shapes::cylinder_blend();
    let rough = shape.noise(1, ROUGHNESS);
    let solving = Instant::now();
    let solution = solve(&shape, &rough).map_err(|error| Failure::new(format!("demo: {error}")))?;
    let solve = solving.elapsed().as_secs_f64();

    let writing = Instant::now();
    let mesh = |positions: &[[f64; 3]]| formats::plain(Format::Ply, positions, &shape.triangles);
    write(&directory.join("start.ply"), &mesh(&rough))?;
    write(&directory.join("result.ply"), &mesh(&solution.positions))?;
    let picture = picture(&shape.triangles, &rough, &solution.positions)?;
    write(&directory.join("blend.png"), &picture)?;
    let summary = Summary {
        report: &solution.report,
        geometry: &Geometry::default(),
        times: Times {
            read: 0.0,
            solve,
            write: writing.elapsed().as_secs_f64(),
            total: start.elapsed().as_secs_f64(),
        },
        stale_normals: 0,
    };
    crate::say(&format!(
        "Written to {name}: start.ply, result.ply, blend.png\n{WHAT_TO_LOOK_AT}\n{}",
        summary.readable()
    ));
    Ok(solution.report.outcome == Outcome::Converged)
}

fn solve(shape: &Shape, start: &[[f64; 3]]) -> Result<Solution, fairmesh::Error> {
    let normals = boundary_normals(shape);
    let options = Options {
        boundary_normals: BoundaryNormals::Given(normals),
        ..Options::default()
    };
    fairmesh::fair(start, &shape.triangles, Selection::Mask(&shape.free), &options)
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    Output::prepare(path)?.write(bytes)
}

/// The fixed vertices and their normals.
fn boundary_normals(shape: &Shape) -> Vec<(u32, [f64; 3])> {
    let normals = shape.normals.iter().zip(&shape.free).enumerate();
    normals
        .filter(|(_, (_, free))| !**free)
        .map(|(v, (&normal, _))| (v as u32, normal))
        .collect()
}

/// Start and result side by side, matte and mirrored.
fn picture(triangles: &[[u32; 3]], start: &[[f64; 3]], result: &[[f64; 3]]) -> Result<Vec<u8>, Failure> {
    let view = |positions, shading| View {
        positions,
        triangles,
        shading,
        focus: &[],
    };
    let views = [
        view(start, Shading::Flat),
        view(result, Shading::Flat),
        view(start, Shading::ReflectionLines),
        view(result, Shading::ReflectionLines),
    ];
    // From above, along one of the three tubes.
    let options = PictureOptions {
        tile: [490, 400],
        direction: [0.45, -0.75, 0.8],
        ..PictureOptions::default()
    };
    let layout = Layout {
        columns: 2,
        ..Layout::default()
    };
    picture::render(&views, &options, &layout)
}
