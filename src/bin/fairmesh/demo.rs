//! `fairmesh demo`: the paper's blend of three cylinders, before and after.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use fairmesh::shapes::{self, Shape};
use fairmesh::{BorderNormals, Options, Outcome, Selection};

use crate::failure::Failure;
use crate::formats::{self, Format};
use crate::output::Output;
use crate::render::{self, Shading, View};
use crate::report::{Summary, Times};

/// What `fairmesh demo` is asked.
#[derive(Debug, Args)]
pub struct DemoArgs {
    /// Directory for start.ply, result.ply and blend.png; made if it does not exist
    directory: PathBuf,
}

const WHAT_TO_LOOK_AT: &str = "
blend.png shows the start on the left and the result on the right, above as a matte surface, below as a mirror of
rings of light. The three tubes' ends are fixed, with the normals of the cylinders that would continue them; the
surface between them is computed from these circles and normals alone. Look at the rings: in the start they break
at the ends and wander with the triangles; in the result they flow.

start.ply and result.ply are the meshes, for any viewer. Try your own:
  fairmesh fair part.ply -o fair.ply
";

/// Runs the command; true if the surface converged and is sound.
pub fn run(args: &DemoArgs) -> Result<bool, Failure> {
    let start = Instant::now();
    let directory = &args.directory;
    fs::create_dir_all(directory)
        .map_err(|why| Failure::new(format!("{}: cannot make this directory: {why}", directory.display())))?;
    let shape = shapes::cylinder_blend();
    let normals = border_normals(&shape);
    let options = Options { normals: BorderNormals::Given(&normals), ..Options::default() };
    let solving = Instant::now();
    let solution = fairmesh::fair(&shape.positions, &shape.triangles, Selection::Mask(&shape.free), options)
        .map_err(|error| Failure::new(format!("demo: {error}")))?;
    let solve = solving.elapsed().as_secs_f64();

    let writing = Instant::now();
    let polygons: Vec<Vec<u32>> = shape.triangles.iter().map(|triangle| triangle.to_vec()).collect();
    let result = &solution.positions;
    write(&directory.join("start.ply"), &formats::plain(Format::Ply, &shape.positions, &polygons))?;
    write(&directory.join("result.ply"), &formats::plain(Format::Ply, result, &polygons))?;
    write(&directory.join("blend.png"), &picture(&shape, result)?)?;
    let times = Times {
        read: 0.0,
        solve,
        write: writing.elapsed().as_secs_f64(),
        total: start.elapsed().as_secs_f64(),
    };

    let geometry = formats::Geometry::default();
    let summary = Summary { report: &solution.report, geometry: &geometry, times, stale_normals: 0 };
    crate::say(&format!("Written to {}: start.ply, result.ply, blend.png\n", directory.display()));
    crate::say(WHAT_TO_LOOK_AT);
    crate::say(&format!("\n{}", summary.readable()));
    Ok(solution.report.outcome == Outcome::Converged)
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    Output::prepare(path)?.write(bytes)
}

/// The fixed vertices and their normals.
fn border_normals(shape: &Shape) -> Vec<(u32, [f64; 3])> {
    let normals = shape.normals.iter().zip(&shape.free).enumerate();
    normals.filter(|(_, (_, free))| !**free).map(|(v, (&normal, _))| (v as u32, normal)).collect()
}

/// Start and result side by side, matte and mirrored.
fn picture(shape: &Shape, result: &[[f64; 3]]) -> Result<Vec<u8>, Failure> {
    let view = |positions, shading| View { positions, triangles: &shape.triangles, shading, region: &[] };
    let views = [
        view(&shape.positions, Shading::Flat),
        view(result, Shading::Flat),
        view(&shape.positions, Shading::ReflectionLines),
        view(result, Shading::ReflectionLines),
    ];
    render::render(&views, &render::Options::default())
}
