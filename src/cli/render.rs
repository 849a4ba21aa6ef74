//! `fairmesh render`: pictures of meshes.

mod distances;
pub mod range;

use std::ffi::OsStr;
use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use serde_json::{Value, json};

use crate::answer::Answer;
use crate::bounds::Bounds;
use crate::explain;
use crate::failure::Failure;
use crate::formats::colours::Colours;
use crate::formats::pipe_args::PipeArgs;
use crate::formats::textures::Textured;
use crate::formats::{Geometry, Kind, MeshFile};
use crate::normals::unit;
use crate::output::Output;
use crate::picture::{self, Animation, Layout, Palette, PictureOptions, Scale, Shading, View};
use crate::selection;
use distances::Distances;
use range::Shown;

/// How the surface is painted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Shade {
    /// Every triangle by its own normal
    Flat,
    /// As a mirror with rings of light around it: creases break the lines, jumps of curvature kink them
    Reflection,
    /// Mean curvature in colours, with a scale
    Curvature,
    /// The colours of vertices or faces that the file has (PLY, OBJ, OFF)
    Colors,
    /// The textures that the file names (OBJ with MTL, PLY): PNG and JPEG
    Texture,
    /// Every mesh after the first by its distance from the first, with a scale and a table
    Distance,
}

/// What `fairmesh render` is asked.
#[derive(Debug, Args)]
pub struct RenderArgs {
    /// Meshes, shown side by side: .ply, .obj, .off or .stl, optionally .gz; '-': stdin.
    /// By one camera, unless one would be lost among the others: then by one each
    #[arg(required = true, verbatim_doc_comment)]
    inputs: Vec<PathBuf>,
    #[command(flatten)]
    pipe: PipeArgs,
    /// Output: a .png file, with --turntable .gif or .png; '-': PNG to stdout
    #[arg(short, long, value_name = "FILE", verbatim_doc_comment)]
    output: PathBuf,
    /// View: a direction x,y,z from the surface to the eye, or front, back, left,
    /// right, top, bottom or corner
    #[arg(
        long,
        value_name = "VIEW",
        default_value = "corner",
        allow_hyphen_values = true,
        verbatim_doc_comment
    )]
    view: String,
    /// Up direction of the picture: x,y,z
    #[arg(
        long,
        value_name = "X,Y,Z",
        default_value = "0,0,1",
        allow_hyphen_values = true
    )]
    up: String,
    /// flat, reflection, curvature, colors, texture or distance; several, separated by
    /// commas, make a row each. 'distance' colours each mesh after the first by its
    /// distance from the first and prints the unsigned distances both ways, at the
    /// vertices and over whole triangles. The largest is within 1 %; mean and rms are
    /// over the area, with at least one sample per triangle and about one per square of
    /// side diagonal/100
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
    /// Ends of the colour scale. By default, for curvature, the range of the middle 98 per
    /// cent of the area, symmetric about 0 if it is near; for distance, from 0 to the
    /// largest
    #[arg(long, value_name = "LO,HI", allow_hyphen_values = true, verbatim_doc_comment)]
    range: Option<String>,
    /// Coordinates at the edges of the box around the meshes
    #[arg(long, conflicts_with = "turntable")]
    axes: bool,
    /// Text below each picture, once per mesh; the file names by default, '' for none
    #[arg(long, value_name = "TEXT")]
    caption: Vec<String>,
    /// Animation of this many frames (2 to 360) in which the meshes turn once about the up
    /// direction: GIF or animated PNG, by the output's name
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=360), verbatim_doc_comment)]
    turntable: Option<u16>,
    /// Frame the picture around these vertices of each mesh: a text file with one number
    /// per line, from 0 [default: all vertices]
    #[arg(long, value_name = "FILE", verbatim_doc_comment)]
    around: Option<PathBuf>,
    /// Also write the distances of --shade distance as JSON; '-': to stdout, instead of the
    /// table
    #[arg(long, value_name = "FILE", verbatim_doc_comment)]
    json: Option<PathBuf>,
}

/// The least and greatest width and height of a picture.
const SIZES: std::ops::RangeInclusive<usize> = 16..=4096;

/// Runs the command.
pub fn run(args: &RenderArgs) -> Result<bool, Failure> {
    let options = options(args)?;
    let captions = captions(args)?;
    let animation = encoding(args)?;
    let asked_range = args.range.as_deref().map(range).transpose()?;
    let output = Output::prepare_or_stdout(&args.output)?;
    let inputs: Vec<&Path> = args.inputs.iter().map(PathBuf::as_path).collect();
    check_use(args)?;
    let answer = Answer::prepare(args.json.as_deref(), false, Some(&args.output), &inputs)?;
    let piped = args.pipe.of(&inputs)?;
    let files = (args.inputs.iter().map(|path| MeshFile::read(path, piped)))
        .collect::<Result<Vec<MeshFile>, Failure>>()?;
    let scene = Scene::new(args, files, asked_range)?;
    let views = scene.views(&args.shade);
    let columns = match args.shade.len() {
        0 | 1 => args.inputs.len().min(MOST_COLUMNS),
        _ => args.inputs.len(),
    };
    let count = captions.len() * args.shade.len();
    let captions: Vec<String> = captions.into_iter().cycle().take(count).collect();
    let layout = Layout {
        columns,
        captions: &captions,
        scales: &scene.scales(&args.shade, columns),
        ..Layout::default()
    };
    output.write(&match args.turntable {
        Some(frames) => picture::turning(&views, &options, &layout, (usize::from(frames), animation))?,
        None => picture::render(&views, &options, &layout)?,
    })?;
    let distances = &scene.distances;
    if !distances.is_empty() {
        let all = || json!({ "distances": distances.iter().map(Distances::json).collect::<Vec<Value>>() });
        let told = || distances.iter().map(Distances::readable).collect();
        answer.tell(&[&args.output], all, told)?;
    }
    Ok(true)
}

/// The meshes, with what the shades that are asked for need.
struct Scene<'a> {
    meshes: Vec<Geometry>,
    focus: Vec<Vec<bool>>,
    colours: Vec<Colours>,
    textures: Vec<Textured>,
    curvatures: Vec<Vec<f64>>,
    /// Of all meshes but the first.
    distances: Vec<Distances<'a>>,
    curvature_scale: Scale,
    distance_scale: Scale,
}

impl<'a> Scene<'a> {
    fn new(
        args: &'a RenderArgs,
        files: Vec<MeshFile>,
        asked_range: Option<[f64; 2]>,
    ) -> Result<Self, Failure> {
        let colours = needed(args, Shade::Colors, &files, colours)?;
        let textures = needed(args, Shade::Texture, &files, |path, file| file.textured(path))?;
        let meshes: Vec<Geometry> = files.into_iter().map(|file| file.geometry).collect();
        let focus = (meshes.iter().map(|mesh| focus(args, mesh))).collect::<Result<Vec<_>, Failure>>()?;
        let distances = match args.shade.contains(&Shade::Distance) {
            true => distances::measured(&args.inputs, &meshes.iter().collect::<Vec<_>>())?,
            false => Vec::new(),
        };
        let curvatures = match args.shade.contains(&Shade::Curvature) {
            true => curvatures(args, &meshes)?,
            false => vec![Vec::new(); meshes.len()],
        };
        Ok(Self {
            curvature_scale: match asked_range {
                Some(ends) => range::asked("H", ends),
                None => range::usual("H", &shown(&meshes, &curvatures, &focus)),
            },
            distance_scale: distance_scale(asked_range, &distances),
            meshes,
            focus,
            colours,
            textures,
            curvatures,
            distances,
        })
    }

    /// A row of all meshes for each shade, in one list. Where a mesh would be lost among the others, each has a list, and so a camera, of its own.
    fn views(&self, shades: &[Shade]) -> Vec<Vec<View<'_>>> {
        let of = |meshes: Range<usize>| {
            let row = move |&shade: &Shade| meshes.clone().map(move |k| self.view(shade, k));
            shades.iter().flat_map(row).collect()
        };
        let count = self.meshes.len();
        match shades.contains(&Shade::Distance) || self.are_together() {
            true => vec![of(0..count)],
            false => (0..count).map(|k| of(k..k + 1)).collect(),
        }
    }

    /// Whether each mesh takes a good part of the box around all.
    fn are_together(&self) -> bool {
        let boxes: Vec<Bounds> = self
            .meshes
            .iter()
            .map(|mesh| Bounds::of(&mesh.positions, &mesh.triangles))
            .collect();
        let all = boxes.iter().fold(Bounds::of(&[], &[]), |all, one| all.with(one));
        boxes
            .iter()
            .all(|one| one.diagonal() >= picture::LOST * all.diagonal())
    }

    fn view(&self, shade: Shade, k: usize) -> View<'_> {
        let measured = k.checked_sub(1).filter(|_| shade == Shade::Distance);
        let measured = measured.map(|other| &self.distances[other]);
        let shading = match (shade, measured) {
            (Shade::Distance, Some(found)) => Shading::Values(&found.there.vertices, &self.distance_scale),
            (Shade::Flat | Shade::Distance, _) => Shading::Flat,
            (Shade::Reflection, _) => Shading::ReflectionLines,
            (Shade::Curvature, _) => Shading::Values(&self.curvatures[k], &self.curvature_scale),
            (Shade::Colors, _) => match self.colours[k].kind {
                Kind::Vertex => Shading::VertexColours(&self.colours[k].values),
                Kind::Face => Shading::FaceColours(&self.colours[k].values),
            },
            (Shade::Texture, _) => Shading::Textured(&self.textures[k]),
        };
        let mesh = &self.meshes[k];
        let (positions, triangles) = match measured {
            Some(found) => (&found.painted.positions, &found.painted.triangles),
            None => (&mesh.positions, &mesh.triangles),
        };
        View {
            positions,
            triangles,
            shading,
            focus: &self.focus[k],
        }
    }

    /// The scales, and the rows of pictures that they are beside.
    fn scales(&self, shades: &[Shade], columns: usize) -> Vec<(Range<usize>, &Scale)> {
        let rows = |row: usize| match shades.len() {
            0 | 1 => 0..self.meshes.len().div_ceil(columns),
            _ => row..row + 1,
        };
        let scale = |(row, shade): (usize, &Shade)| match shade {
            Shade::Curvature => Some((rows(row), &self.curvature_scale)),
            Shade::Distance => Some((rows(row), &self.distance_scale)),
            _ => None,
        };
        shades.iter().enumerate().filter_map(scale).collect()
    }
}

/// Of every mesh what a shade needs, if it is asked for.
fn needed<T>(
    args: &RenderArgs,
    shade: Shade,
    files: &[MeshFile],
    of: impl Fn(&Path, &MeshFile) -> Result<T, Failure>,
) -> Result<Vec<T>, Failure> {
    match args.shade.contains(&shade) {
        true => args
            .inputs
            .iter()
            .zip(files)
            .map(|(path, file)| of(path, file))
            .collect(),
        false => Ok(Vec::new()),
    }
}

/// The colours of a file; of polygons, one for each of their triangles.
fn colours(path: &Path, file: &MeshFile) -> Result<Colours, Failure> {
    let none = || {
        Failure::new(format!(
            "{}: it has no colours; --shade flat needs none, texture takes those of its pictures",
            path.display()
        ))
    };
    let colours = file.colours().ok_or_else(none)?;
    Ok(match colours.kind {
        Kind::Vertex => colours,
        Kind::Face => Colours {
            values: (0..file.geometry.triangles.len())
                .map(|t| colours.values[file.geometry.polygon_of(t)])
                .collect(),
            ..colours
        },
    })
}

/// What scales of curvature are made for.
fn shown<'a>(meshes: &'a [Geometry], values: &'a [Vec<f64>], focus: &'a [Vec<bool>]) -> Vec<Shown<'a>> {
    let all = meshes.iter().zip(values).zip(focus);
    all.map(|((mesh, values), focus)| Shown {
        positions: &mesh.positions,
        triangles: &mesh.triangles,
        values,
        focus,
    })
    .collect()
}

/// From 0 to the largest distance from the first mesh.
fn distance_scale(asked: Option<[f64; 2]>, distances: &[Distances<'_>]) -> Scale {
    let most = distances.iter().map(|of| of.there.largest).fold(0.0, f64::max);
    Scale {
        title: "distance".to_owned(),
        range: asked.unwrap_or([0.0, if most > 0.0 { most } else { 1.0 }]),
        palette: Palette::Sequential,
    }
}

/// How the picture is encoded, by the name of its file.
fn encoding(args: &RenderArgs) -> Result<Animation, Failure> {
    let extension = args.output.extension().map(|e| e.to_ascii_lowercase());
    let is = |ending: &str| extension.as_deref() == Some(OsStr::new(ending));
    if args.turntable.is_some() && is("gif") {
        return Ok(Animation::Gif);
    }
    let told = |what: &str| Err(Failure::new(format!("{}: {what}", args.output.display())));
    match &extension {
        _ if is("gif") => told("GIF is written with --turntable only; let the name end in .png"),
        Some(_) if OTHERS.iter().any(|other| is(other)) => {
            told("only PNG is written, and GIF with --turntable; let the name end in .png")
        }
        _ => Ok(Animation::Png),
    }
}

/// Endings of pictures that would not be what their names say.
const OTHERS: [&str; 7] = ["jpg", "jpeg", "webp", "bmp", "tif", "tiff", "svg"];

/// Flags that go with some shades only.
fn check_use(args: &RenderArgs) -> Result<(), Failure> {
    let has = |shade| args.shade.contains(&shade);
    if args.json.is_some() && !has(Shade::Distance) {
        return Err(Failure::new(
            "--json: nothing is measured without --shade distance",
        ));
    }
    if args.range.is_some() && has(Shade::Distance) && has(Shade::Curvature) {
        return Err(Failure::new(
            "--range: curvature and distance have a scale each; make a picture of each",
        ));
    }
    Ok(())
}

/// More meshes than this go to the next row.
const MOST_COLUMNS: usize = 4;

fn options(args: &RenderArgs) -> Result<PictureOptions, Failure> {
    let wrong = |what: &str, text: &str, form: &str| Failure::new(format!("{what} {text}: give {form}"));
    let direction = direction(&args.view)?;
    let up = upwards(&args.up)?;
    let tile = args
        .size
        .split_once('x')
        .and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]))
        .filter(|tile: &[usize; 2]| tile.iter().all(|side| SIZES.contains(side)))
        .ok_or_else(|| wrong("--size", &args.size, "WIDTHxHEIGHT, each from 16 to 4096"))?;
    let plain = PictureOptions {
        tile,
        direction,
        up,
        ..PictureOptions::default()
    };
    Ok(match args.axes {
        true => plain.with_axes(),
        false => plain,
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

/// What points up, by x,y,z.
pub fn upwards(up: &str) -> Result<[f64; 3], Failure> {
    let found = numbers(up).and_then(unit);
    found.ok_or_else(|| Failure::new(format!("--up {up}: give x,y,z")))
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
