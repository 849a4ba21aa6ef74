//! `fairmesh holes`: the boundary loops of a file.

mod picture;

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use fairmesh::{
    BoundaryLoop, FillOptions, JoinSuggestion, LoopKind, Options, Roughness, boundary_loops_joined,
    rim_roughness, suggest_joins,
};
use serde_json::{Value, json};

use crate::answer::Answer;
use crate::explain;
use crate::failure::Failure;
use crate::figures::significant;
use crate::formats::pipe_args::PipeArgs;
use crate::formats::{Geometry, MeshFile};
use crate::join;
use crate::orientation::{self, oriented};
use crate::output::Output;
use crate::places::{LoopPlace, places};
use crate::render;
use crate::rim;
use crate::seams;
use crate::surface::MeshArgs;

/// Decimal digits of a coordinate below the first one of the radius: a ball is told to a thousandth. With half of them it is off by a twentieth, and
/// misses vertices of its loop; with double lines are half as long again.
const DIGITS: f64 = 3.0;
/// The heading of the balls around loops.
const WHERE: &str = "x,y,z,radius";
/// A component of no more faces is debris, or a piece of a soup.
const DEBRIS: usize = 3;

/// What `fairmesh holes` is asked.
#[derive(Debug, Args)]
pub struct HolesArgs {
    /// Mesh file: .ply, .obj, .off or .stl, optionally .gz; '-': stdin
    input: PathBuf,
    /// List the loops that 'fairmesh fill --join auto' would connect, and why
    #[arg(long)]
    suggest: bool,
    /// Picture (.png) of the mesh from two sides, or by --view from one, with the numbers of the loops
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
    /// View of the picture, as in 'fairmesh render'
    #[arg(long, value_name = "VIEW", allow_hyphen_values = true, requires = "picture")]
    view: Option<String>,
    #[command(flatten)]
    mesh: MeshArgs,
    #[command(flatten)]
    pipe: PipeArgs,
    /// Also write the list as JSON; '-': to stdout, instead of the text
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Print no list; errors are still printed
    #[arg(short, long)]
    quiet: bool,
}

/// Runs the command.
pub fn run(args: &HolesArgs) -> Result<bool, Failure> {
    let mesh = MeshFile::read(&args.input, args.pipe.of(&[&args.input])?)?;
    let picture = args.picture.as_deref().map(Output::prepare).transpose()?;
    let view = args.view.as_deref().map(render::direction).transpose()?;
    let answer = Answer::prepare(args.json.as_deref(), args.quiet, None, &[&args.input])?;
    let (mesh, turned) = oriented(&args.input, mesh, &args.mesh)?;
    let geometry = &mesh.geometry;
    let loops = boundary_loops_joined(&geometry.positions, &geometry.triangles, args.mesh.coincident)
        .map_err(|error| explain::refusal(&args.input, &mesh, &error))?;
    let rough = rim_roughness(&geometry.positions, &geometry.triangles, args.mesh.coincident)
        .map_err(|error| explain::refusal(&args.input, &mesh, &error))?;
    let places = places(&geometry.positions, &loops);
    let mut text = listed(&loops, &rough, &places);
    text += &match seams::advice(geometry, args.mesh.coincident) {
        Some(advice) => format!("{advice}\n"),
        None => soup(&loops),
    };
    text += &orientation::told(geometry, turned, args.mesh.coincident).text;
    for (i, of) in rough.iter().enumerate() {
        if let Some(advice) = of.as_ref().and_then(rim::advice) {
            let _ = writeln!(text, "loop {i} {advice}");
        }
    }
    let mut written: Vec<&Path> = Vec::new();
    if let (Some(output), Some(path)) = (picture, &args.picture) {
        output.write(&picture::numbered(geometry, &loops, view)?)?;
        written.push(path);
    }
    let suggested = match args.suggest {
        true => {
            Some(suggested(args, geometry).map_err(|error| explain::refusal(&args.input, &mesh, &error))?)
        }
        false => None,
    };
    for one in suggested.iter().flatten() {
        let _ = writeln!(
            text,
            "--join {}: {}",
            join::list(&one.loops),
            join::told(&one.reason)
        );
    }
    if suggested.as_ref().is_some_and(Vec::is_empty) {
        text += "no loops whose joint patch would bend less than separate ones\n";
    }
    let json = || {
        let loops = Value::from(
            loops
                .iter()
                .zip(&rough)
                .zip(&places)
                .map(described)
                .collect::<Vec<Value>>(),
        );
        match &suggested {
            None => loops,
            Some(list) => {
                let list = list.iter();
                let list = list.map(|one| json!({ "loops": one.loops, "reason": join::json(&one.reason) }));
                json!({ "loops": loops, "joins": list.collect::<Vec<Value>>() })
            }
        }
    };
    answer.tell(&written, json, || text)?;
    Ok(true)
}

/// A line for each loop, and what the columns mean.
fn listed(loops: &[BoundaryLoop], rough: &[Option<Roughness>], places: &[LoopPlace]) -> String {
    if loops.is_empty() {
        return "no boundary: the mesh is closed\n".to_owned();
    }
    let balls: Vec<String> = places.iter().map(told).collect();
    let wide = balls.iter().map(String::len).max().unwrap_or(0).max(WHERE.len());
    let mut text = format!("loop   edges      length        area  turn  rough  {WHERE:<wide$}  kind\n");
    for (i, boundary) in loops.iter().enumerate() {
        let nearest = places[i]
            .nearest
            .map_or(String::new(), |(of, distance)| match distance {
                0.0 => format!("; loop {of} has a vertex at the same place"),
                _ => format!("; loop {of} is {} away", significant(distance)),
            });
        let _ = writeln!(
            text,
            "{i:>4} {:>7} {:>11.5e} {:>11.5e} {:>5.0} {:>6}  {:<wide$}  {}{}{nearest}",
            boundary.vertices.len(),
            boundary.length,
            boundary.area,
            boundary.turn,
            rough[i].map_or("-".to_owned(), |of| format!("{:.1}", of.ratio())),
            balls[i],
            kind(boundary),
            touching(boundary)
        );
    }
    text + "turn: degrees by which a smooth filling turns: 0 in a plane, 90 at a tube, 180 around a sheet; rough: 1 is a clean mesh\n"
}

/// The ball of a loop, as `--ball` takes it, to a thousandth of its radius.
fn told(place: &LoopPlace) -> String {
    let decimals = (DIGITS - place.radius.log10().floor()).clamp(0.0, 17.0) as usize;
    let numbers = place.centre.iter().chain([&place.radius]);
    // Zero has no sign.
    let unit = 10f64.powi(decimals as i32);
    let rounded = numbers.map(|x| format!("{:.decimals$}", (x * unit).round() / unit + 0.0));
    rounded.collect::<Vec<String>>().join(",")
}

/// What is to be said where most loops are boundaries of single faces.
fn soup(loops: &[BoundaryLoop]) -> String {
    let debris = loops.iter().filter(|of| of.component_triangles <= DEBRIS).count();
    match 2 * debris > loops.len() {
        true => format!(
            "{debris} of {} loops are boundaries of {DEBRIS} faces or fewer: if this is a soup, --coincident DISTANCE joins vertices that are near each \
             other; if it is debris, 'fairmesh fill --drop-components-below' drops it\n",
            loops.len()
        ),
        false => String::new(),
    }
}

fn suggested(args: &HolesArgs, geometry: &Geometry) -> Result<Vec<JoinSuggestion>, fairmesh::Error> {
    let options = FillOptions {
        fairing: Options {
            coincident: args.mesh.coincident,
            ..Options::default()
        },
        ..FillOptions::default()
    };
    suggest_joins(&geometry.positions, &geometry.triangles, &options)
}

fn kind(boundary: &BoundaryLoop) -> String {
    match boundary.kind {
        LoopKind::Hole => "hole".into(),
        LoopKind::OuterBoundary => match boundary.hangs_at {
            Some(vertex) => format!(
                "outer boundary of {} faces that hang at the rest of the mesh by single vertices only (vertex {vertex})",
                boundary.component_triangles
            ),
            None if boundary.component_triangles <= DEBRIS => format!(
                "outer boundary of {} faces that hang at nothing",
                boundary.component_triangles
            ),
            None => "outer boundary".into(),
        },
        LoopKind::NonManifold { a, b } => format!("runs into the non-manifold edge ({a}, {b})"),
        LoopKind::Inconsistent { a, b } => {
            format!("runs into edge ({a}, {b}), whose faces are oriented inconsistently")
        }
        _ => "unknown".into(),
    }
}

fn touching(boundary: &BoundaryLoop) -> String {
    match boundary.touching.len() {
        0 => String::new(),
        1 => format!(", touches another at vertex {}", boundary.touching[0]),
        n => format!(", touches others at {n} vertices"),
    }
}

fn described(((boundary, rough), place): ((&BoundaryLoop, &Option<Roughness>), &LoopPlace)) -> Value {
    let (name, edge) = match boundary.kind {
        LoopKind::Hole => ("hole", Value::Null),
        LoopKind::OuterBoundary => ("outer_boundary", Value::Null),
        LoopKind::NonManifold { a, b } => ("non_manifold", json!([a, b])),
        LoopKind::Inconsistent { a, b } => ("inconsistent", json!([a, b])),
        _ => ("unknown", Value::Null),
    };
    json!({
        "kind": name, "non_manifold_edge": edge, "edges": boundary.vertices.len(), "length": boundary.length,
        "area": boundary.area, "centre": place.centre, "radius": place.radius,
        "nearest": place.nearest.map(|(of, distance)| json!({ "loop": of, "distance": distance })), "turn": boundary.turn, "touching": boundary.touching, "hangs_at": boundary.hangs_at, "component": boundary.component,
        "component_faces": boundary.component_triangles, "roughness": rough.as_ref().map(rim::roughness_json), "vertices": boundary.vertices,
    })
}
