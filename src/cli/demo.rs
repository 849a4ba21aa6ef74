//! `fairmesh demo`: the paper's blend of three cylinders, before and after.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use fairmesh::{BoundaryNormals, Options, Outcome, Selection, Solution};
use fairmesh_shapes::Shape;

use crate::answer::say;
use crate::continuity::Asked;
use crate::explain;
use crate::failure::Failure;
use crate::formats::{self, Format, Geometry};
use crate::generate::{free_list, normal_list};
use crate::output::Output;
use crate::picture::{self, Layout, PictureOptions, Shading, View};
use crate::region::RegionReport;
use crate::report::{Summary, Times};
use crate::shell::quoted;

/// What `fairmesh demo` is asked.
#[derive(Debug, Args)]
pub struct DemoArgs {
    /// Directory for the meshes, lists and picture; made if it does not exist
    directory: PathBuf,
}

/// Noise on the start, in edge lengths: to be seen, and to show that the result does not depend on it.
const ROUGHNESS: f64 = 0.15;

/// What is written.
const FILES: [&str; 5] = ["start.ply", "free.txt", "normals.txt", "result.ply", "blend.png"];

const WHAT_TO_LOOK_AT: &str = "
blend.png shows the start on the left and the result on the right: above as a matte surface, below as a mirror
with rings of light around it. The three circles at the ends are fixed, with the normals of the tubes that would
continue there; the surface between them follows from these circles and normals alone. The start was roughened on
purpose, and its rings are torn; in the result they flow, up to the open ends.

start.ply and result.ply are the two meshes, for any viewer. free.txt lists the vertices that may move, normals.txt the
normals at the three circles. The result can be made again with
";

/// The command that makes the result from the files.
fn again(directory: &Path) -> String {
    let quoted = |name: &str| quoted(&directory.join(name).display().to_string());
    let [start, free, normals, result] = [FILES[0], FILES[1], FILES[2], FILES[3]].map(quoted);
    format!("  fairmesh fair {start} -o {result} --free {free} --normals {normals}\n")
}

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
    let solution = solve(&shape, &rough).map_err(|error| explain::plain_refusal("demo", &error))?;
    let solve = solving.elapsed().as_secs_f64();

    let writing = Instant::now();
    let mesh = |positions: &[[f64; 3]]| formats::plain(Format::Ply, positions, &shape.triangles);
    let picture = picture(&shape.triangles, &rough, &solution.positions)?;
    let contents = [
        mesh(&rough),
        free_list(&shape),
        normal_list(&shape),
        mesh(&solution.positions),
        picture,
    ];
    for (file, bytes) in FILES.iter().zip(contents) {
        Output::prepare(&directory.join(file))?.write(&bytes)?;
    }
    let summary = Summary {
        report: &solution.report,
        geometry: &Geometry::default(),
        region: &RegionReport::default(),
        times: Times {
            read: 0.0,
            solve,
            write: writing.elapsed().as_secs_f64(),
            pictures: None,
            total: start.elapsed().as_secs_f64(),
        },
        stale_normals: 0,
        is_verbose: false,
        asked: Asked::Tangent,
        has_with_others: None,
    };
    let text = format!(
        "Written to {name}: {}\n{WHAT_TO_LOOK_AT}{}\n{}",
        FILES.join(", "),
        again(directory),
        summary.readable()
    );
    say(&text, &[directory])?;
    Ok(solution.report.outcome == Outcome::Converged)
}

fn solve(shape: &Shape, start: &[[f64; 3]]) -> Result<Solution, fairmesh::Error> {
    let options = Options {
        boundary_normals: BoundaryNormals::Given(shape.boundary_normals()),
        ..Options::default()
    };
    fairmesh::fair(start, &shape.triangles, Selection::Mask(&shape.free), &options)
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
    picture::render(&[Vec::from(views)], &options, &layout)
}
