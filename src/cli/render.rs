//! `fairmesh render`: pictures of meshes.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use crate::explain;
use crate::failure::Failure;
use crate::formats::pipes::PipeArgs;
use crate::formats::{Geometry, MeshFile};
use crate::normals::unit;
use crate::output::Output;
use crate::picture::{self, Layout, PictureOptions, Shading, View};
use crate::selection;

/// How the surface is painted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Shade {
    /// Every triangle by its own normal
    Flat,
    /// As a mirror with rings of light around it: creases break the lines, jumps of curvature kink them
    Reflection,
    /// Mean curvature in colours, with a scale
    Curvature,
}

/// What `fairmesh render` is asked.
#[derive(Debug, Args)]
pub struct RenderArgs {
    /// Meshes, side by side: .ply, .obj, .off or .stl, perhaps with .gz behind it; '-': from stdin
    #[arg(required = true)]
    inputs: Vec<PathBuf>,
    #[command(flatten)]
    pipe: PipeArgs,
    /// Where the picture goes: a .png file; '-': to stdout
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// From where: x,y,z (from the surface to the eye), front, back, left, right,
    /// top, bottom or corner
    #[arg(
        long,
        value_name = "VIEW",
        default_value = "corner",
        allow_hyphen_values = true,
        verbatim_doc_comment
    )]
    view: String,
    /// What points up in the picture: x,y,z
    #[arg(
        long,
        value_name = "X,Y,Z",
        default_value = "0,0,1",
        allow_hyphen_values = true
    )]
    up: String,
    /// How: flat, reflection or curvature; several, separated by commas, give a
    /// row each
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        default_value = "flat",
        verbatim_doc_comment
    )]
    shade: Vec<Shade>,
    /// Width and height of each picture, in pixels
    #[arg(long, value_name = "WxH", default_value = "480x480")]
    size: String,
    /// Ends of the curvature's scale; by default those that the middle 98 per
    /// cent of all vertices have
    #[arg(long, value_name = "LO,HI", allow_hyphen_values = true, verbatim_doc_comment)]
    range: Option<String>,
    /// Text below each picture, once per mesh; the file names by default, '' for none
    #[arg(long, value_name = "TEXT")]
    caption: Vec<String>,
    /// Vertices that have to be in the picture: a text file with one number per
    /// line, from 0; for all meshes. By default all vertices
    #[arg(long, value_name = "FILE", verbatim_doc_comment)]
    around: Option<PathBuf>,
}

/// The least and greatest width and height of a picture.
const SIZES: std::ops::RangeInclusive<usize> = 16..=4096;

/// Runs the command.
pub fn run(args: &RenderArgs) -> Result<bool, Failure> {
    let options = options(args)?;
    let captions = captions(args)?;
    let asked_range = args.range.as_deref().map(range).transpose()?;
    let output = Output::prepare_or_stdout(&args.output)?;
    let inputs: Vec<&Path> = args.inputs.iter().map(PathBuf::as_path).collect();
    let piped = args.pipe.of(&inputs)?;
    let meshes = (args
        .inputs
        .iter()
        .map(|path| Ok(MeshFile::read(path, piped)?.geometry)))
    .collect::<Result<Vec<Geometry>, Failure>>()?;
    let focus = (meshes.iter().map(|mesh| focus(args, mesh))).collect::<Result<Vec<_>, Failure>>()?;
    let has_scale = args.shade.contains(&Shade::Curvature);
    let curvatures = if has_scale {
        curvatures(args, &meshes)?
    } else {
        vec![Vec::new(); meshes.len()]
    };
    let range = asked_range.unwrap_or_else(|| usual_range(&curvatures, &focus));
    let mut views = Vec::new();
    for shade in &args.shade {
        for ((mesh, focus), curvature) in meshes.iter().zip(&focus).zip(&curvatures) {
            views.push(View {
                positions: &mesh.positions,
                triangles: &mesh.triangles,
                shading: match shade {
                    Shade::Flat => Shading::Flat,
                    Shade::Reflection => Shading::ReflectionLines,
                    Shade::Curvature => Shading::Values(curvature, range),
                },
                focus,
            });
        }
    }
    let columns = if args.shade.len() > 1 {
        meshes.len()
    } else {
        meshes.len().min(MOST_COLUMNS)
    };
    let captions: Vec<String> = captions.iter().cycle().take(views.len()).cloned().collect();
    let layout = Layout {
        columns,
        captions: &captions,
        scale: has_scale.then_some(("H", range)),
    };
    output.write(&picture::render(&views, &options, &layout)?)?;
    Ok(true)
}

/// More meshes than this go to the next row.
const MOST_COLUMNS: usize = 4;

fn options(args: &RenderArgs) -> Result<PictureOptions, Failure> {
    let wrong = |what: &str, text: &str, form: &str| Failure::new(format!("{what} {text}: give {form}"));
    let direction = direction(&args.view)?;
    let up = numbers(&args.up)
        .and_then(unit)
        .ok_or_else(|| wrong("--up", &args.up, "x,y,z"))?;
    let tile = args
        .size
        .split_once('x')
        .and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]))
        .filter(|tile: &[usize; 2]| tile.iter().all(|side| SIZES.contains(side)))
        .ok_or_else(|| wrong("--size", &args.size, "WIDTHxHEIGHT, each from 16 to 4096"))?;
    Ok(PictureOptions {
        tile,
        direction,
        up,
        ..PictureOptions::default()
    })
}

/// Where the eye is, by a name or x,y,z.
pub fn direction(view: &str) -> Result<[f64; 3], Failure> {
    Ok(match view {
        "front" => [0.0, -1.0, 0.0],
        "back" => [0.0, 1.0, 0.0],
        "left" => [-1.0, 0.0, 0.0],
        "right" => [1.0, 0.0, 0.0],
        "top" => [0.0, 0.0, 1.0],
        "bottom" => [0.0, 0.0, -1.0],
        "corner" => [1.0, 0.7, 0.8],
        text => numbers(text).and_then(unit).ok_or_else(|| {
            Failure::new(format!(
                "--view {text}: give x,y,z or front, back, left, right, top, bottom, corner"
            ))
        })?,
    })
}

/// So many finite numbers, separated by commas.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers: Vec<f64> = text
        .split(',')
        .map(|word| word.trim().parse().ok().filter(|x: &f64| x.is_finite()))
        .collect::<Option<_>>()?;
    numbers.try_into().ok()
}

fn range(text: &str) -> Result<[f64; 2], Failure> {
    numbers(text)
        .filter(|[low, high]| low < high)
        .ok_or_else(|| Failure::new(format!("--range {text}: give LOW,HIGH with LOW below HIGH")))
}

fn captions(args: &RenderArgs) -> Result<Vec<String>, Failure> {
    if args.caption.is_empty() {
        let stem = |path: &PathBuf| {
            path.file_stem()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned()
        };
        return Ok(args.inputs.iter().map(stem).collect());
    }
    if args.caption.len() != args.inputs.len() {
        return Err(Failure::new(format!(
            "--caption: {} for {} meshes; give one for each",
            args.caption.len(),
            args.inputs.len()
        )));
    }
    Ok(if args.caption.iter().all(String::is_empty) {
        Vec::new()
    } else {
        args.caption.clone()
    })
}

fn focus(args: &RenderArgs, mesh: &Geometry) -> Result<Vec<bool>, Failure> {
    let Some(path) = &args.around else {
        return Ok(Vec::new());
    };
    let mut focus = vec![false; mesh.positions.len()];
    for v in selection::indices(path, mesh.positions.len(), "vertices")? {
        focus[v as usize] = true;
    }
    Ok(focus)
}

fn curvatures(args: &RenderArgs, meshes: &[Geometry]) -> Result<Vec<Vec<f64>>, Failure> {
    let of = |(path, mesh): (&PathBuf, &Geometry)| {
        fairmesh::mean_curvature(&mesh.positions, &mesh.triangles)
            .map_err(|error| explain::plain_refusal(path.display(), &error))
    };
    args.inputs.iter().zip(meshes).map(of).collect()
}

/// From the first to the last percentile over all meshes, of what is in the picture.
fn usual_range(curvatures: &[Vec<f64>], focus: &[Vec<bool>]) -> [f64; 2] {
    let mut values: Vec<f64> = Vec::new();
    for (h, focus) in curvatures.iter().zip(focus) {
        let shown = (0..h.len()).filter(|&v| focus.is_empty() || focus[v]);
        values.extend(shown.map(|v| h[v]).filter(|h| h.is_finite()));
    }
    values.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let last = values.len().checked_sub(1)?;
        values.get((share * last as f64).round() as usize).copied()
    };
    let (low, high) = (at(0.01).unwrap_or(0.0), at(0.99).unwrap_or(1.0));
    // A surface of constant curvature is all in the middle of a scale that does not show rounding.
    let least = 1e-3 * low.abs().max(high.abs());
    let room = (0.5 * (least - (high - low))).max(0.0);
    let range = [low - room, high + room];
    if range[0] < range[1] {
        range
    } else {
        [low - 1.0, low + 1.0]
    }
}
