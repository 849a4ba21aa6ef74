//! `fairmesh select`: what the flags of a region take, as a list, as a mesh, in a picture.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;

use crate::answer::Answer;
use crate::failure::Failure;
use crate::formats::packed;
use crate::formats::pipe_args::PipesArgs;
use crate::formats::references::{self, Led};
use crate::formats::{Format, Geometry, Kind, MeshFile};
use crate::orientation::oriented;
use crate::output::Output;
use crate::picture::{self, Layout, PictureOptions, Shading, View};
use crate::region;
use crate::render;
use crate::selected::Selected;
use crate::selection::{self, RegionArgs};
use crate::surface::MeshArgs;

/// What `fairmesh select` is asked.
#[derive(Debug, Args)]
pub struct SelectArgs {
    /// Mesh file: .ply, .obj, .off or .stl, optionally .gz; '-': stdin
    input: PathBuf,
    /// Output: a list of face numbers for --faces (.txt), or a mesh of these faces alone
    /// (.ply, .obj, .off or .stl, optionally .gz; '-': stdout)
    #[arg(short, long, value_name = "FILE", verbatim_doc_comment)]
    output: Option<PathBuf>,
    #[command(flatten)]
    pipes: PipesArgs,
    /// Picture (.png) that shows the selected faces in another colour
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
    /// View of the picture, as in 'fairmesh render' [default: from above the
    /// faces]
    #[arg(long, value_name = "VIEW", allow_hyphen_values = true, verbatim_doc_comment)]
    view: Option<String>,
    /// Up direction of the picture: x,y,z [default: 0,0,1]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    up: Option<String>,
    /// Also write the result as JSON; '-': to stdout, instead of the text
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// No report; errors are still printed
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    mesh: MeshArgs,
    #[command(flatten)]
    region: RegionArgs,
}

/// Runs the command.
pub fn run(args: &SelectArgs) -> Result<bool, Failure> {
    let piped = args.pipes.of(&args.input, args.output.as_deref())?;
    let mesh = MeshFile::read(&args.input, piped.input)?;
    let (mesh, _) = oriented(&args.input, mesh, &args.mesh)?;
    let geometry = &mesh.geometry;
    let output = args
        .output
        .as_deref()
        .map(Output::prepare_or_stdout)
        .transpose()?;
    let picture = args.picture.as_deref().map(Output::prepare).transpose()?;
    let answer = Answer::prepare(
        args.json.as_deref(),
        args.quiet,
        args.output.as_deref(),
        &[&args.input],
    )?;
    let view = args.view.as_deref().map(render::direction).transpose()?;
    let up = args.up.as_deref().map(render::upwards).transpose()?;
    let found = selection::find(&mesh, &args.input, &args.region, args.mesh.coincident)?;
    let marked = marked(geometry, found.selected.in_triangles(geometry));
    let triangles: Vec<u32> = (0..)
        .zip(&marked)
        .filter(|(_, is_in)| **is_in)
        .map(|(t, _)| t)
        .collect();
    let [_, polygons] = region::polygons(geometry, &triangles);
    let (mut written, mut named) = (Vec::new(), Vec::new());
    if let (Some(output), Some(path)) = (output, &args.output) {
        let led = list_or_mesh(args, (path, piped.output), &mesh, &polygons)?;
        output.write(&led.bytes)?;
        named = led.told;
        written.push(path.as_path());
    }
    if let (Some(output), Some(path)) = (picture, &args.picture) {
        output.write(&shown(geometry, &marked, view, up)?)?;
        written.push(path.as_path());
    }
    let faces: Vec<usize> = (0..polygons.len()).filter(|&p| polygons[p]).collect();
    let moving = moving(geometry, &marked);
    let json = || json!({ "region": found.report.json(), "faces": faces, "moving_vertices": moving });
    let readable = || {
        let mut text: String = found.report.told.iter().map(|line| format!("{line}\n")).collect();
        let _ = writeln!(
            text,
            "selected: {} of {} faces; {moving} vertices have all their faces among them{}",
            faces.len(),
            geometry.polygon_count,
            if moving == 0 {
                ": nothing would move, --grow 1 takes more"
            } else {
                ""
            }
        );
        if marked.iter().all(|&is_in| is_in) {
            text += "this is the whole mesh: nothing would stay where it is\n";
        }
        named.iter().for_each(|line| text += &format!("{line}\n"));
        text
    };
    answer.tell(&written, json, readable)?;
    Ok(true)
}

/// Whether each triangle is selected; of vertices, those with all corners among them.
fn marked(geometry: &Geometry, selected: Selected) -> Vec<bool> {
    let (kind, list) = (selected.kind, selected.elements);
    let count = match kind {
        Kind::Vertex => geometry.positions.len(),
        Kind::Face => geometry.triangles.len(),
    };
    let mut is_in = vec![false; count];
    list.iter().for_each(|&i| is_in[i as usize] = true);
    match kind {
        Kind::Face => is_in,
        Kind::Vertex => {
            let triangles = geometry.triangles.iter();
            triangles.map(|t| t.iter().all(|&v| is_in[v as usize])).collect()
        }
    }
}

/// How many vertices have all their triangles among the marked ones.
fn moving(geometry: &Geometry, marked: &[bool]) -> usize {
    let mut has = vec![[false; 2]; geometry.positions.len()];
    for (t, &is_in) in geometry.triangles.iter().zip(marked) {
        t.iter().for_each(|&v| has[v as usize][usize::from(is_in)] = true);
    }
    has.iter().filter(|&&of| of == [false, true]).count()
}

/// The faces as a list of numbers, or as a mesh, by the name of the file.
fn list_or_mesh(
    args: &SelectArgs,
    (path, piped): (&Path, Option<Format>),
    mesh: &MeshFile,
    polygons: &[bool],
) -> Result<Led, Failure> {
    let inner = packed::inner_name(path);
    if inner.extension().is_some_and(|extension| extension == "txt") {
        let numbers = (0..polygons.len()).filter(|&p| polygons[p]);
        return Ok(Led {
            bytes: numbers.map(|p| format!("{p}\n")).collect::<String>().into_bytes(),
            told: Vec::new(),
        });
    }
    let format = Format::of(path, piped).map_err(|failure| failure.and("a list of faces ends in .txt"))?;
    let (part, _) = mesh.only(&path.display().to_string(), polygons)?;
    Ok(references::led(part.in_format(format), format, &args.input, path))
}

/// A picture of the whole mesh with the marked triangles in another colour.
fn shown(
    geometry: &Geometry,
    marked: &[bool],
    view: Option<[f64; 3]>,
    up: Option<[f64; 3]>,
) -> Result<Vec<u8>, Failure> {
    let usual = PictureOptions {
        up: up.unwrap_or(PictureOptions::default().up),
        ..PictureOptions::default().with_axes()
    };
    let above = || picture::best_direction(&geometry.positions, &geometry.triangles, marked, &usual);
    let options = PictureOptions {
        direction: view.unwrap_or_else(above),
        ..usual
    };
    let view = View {
        positions: &geometry.positions,
        triangles: &geometry.triangles,
        shading: Shading::Marked(marked),
        focus: &[],
    };
    picture::render(&[vec![view]], &options, &Layout::default())
}
