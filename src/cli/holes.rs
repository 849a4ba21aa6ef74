//! `fairmesh holes`: the boundary loops of a file.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use fairmesh::{
    BoundaryLoop, FillOptions, JoinSuggestion, LoopKind, Options, Roughness, boundary_loops_joined,
    rim_roughness, suggest_joins,
};
use serde_json::{Value, json};

use crate::answer::Answer;
use crate::explain;
use crate::failure::Failure;
use crate::formats::pipe_args::PipeArgs;
use crate::formats::{Geometry, MeshFile};
use crate::join;
use crate::orientation::{self, oriented};
use crate::rim;
use crate::seams;
use crate::surface::MeshArgs;

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
    let answer = Answer::prepare(args.json.as_deref(), args.quiet, None, &[&args.input])?;
    let (mesh, turned) = oriented(&args.input, mesh, &args.mesh)?;
    let geometry = &mesh.geometry;
    let loops = boundary_loops_joined(&geometry.positions, &geometry.triangles, args.mesh.coincident)
        .map_err(|error| explain::refusal(&args.input, &mesh, &error))?;
    let rough = rim_roughness(&geometry.positions, &geometry.triangles, args.mesh.coincident)
        .map_err(|error| explain::refusal(&args.input, &mesh, &error))?;
    let mut text = match loops.len() {
        0 => "no boundary: the mesh is closed\n".to_owned(),
        _ => "loop   edges      length        area  turn  rough  kind\n".to_owned(),
    };
    for (i, boundary) in loops.iter().enumerate() {
        let _ = writeln!(
            text,
            "{i:>4} {:>7} {:>11.5e} {:>11.5e} {:>5.0} {:>6}  {}{}",
            boundary.vertices.len(),
            boundary.length,
            boundary.area,
            boundary.turn,
            rough[i].map_or("-".to_owned(), |of| format!("{:.1}", of.ratio())),
            kind(boundary),
            touching(boundary)
        );
    }
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
        let loops = Value::from(loops.iter().zip(&rough).map(described).collect::<Vec<Value>>());
        match &suggested {
            None => loops,
            Some(list) => {
                let list = list.iter();
                let list = list.map(|one| json!({ "loops": one.loops, "reason": join::json(&one.reason) }));
                json!({ "loops": loops, "joins": list.collect::<Vec<Value>>() })
            }
        }
    };
    answer.tell(&[], json, || text)?;
    Ok(true)
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

fn described((boundary, rough): (&BoundaryLoop, &Option<Roughness>)) -> Value {
    let (name, edge) = match boundary.kind {
        LoopKind::Hole => ("hole", Value::Null),
        LoopKind::OuterBoundary => ("outer_boundary", Value::Null),
        LoopKind::NonManifold { a, b } => ("non_manifold", json!([a, b])),
        LoopKind::Inconsistent { a, b } => ("inconsistent", json!([a, b])),
        _ => ("unknown", Value::Null),
    };
    json!({
        "kind": name, "non_manifold_edge": edge, "edges": boundary.vertices.len(), "length": boundary.length,
        "area": boundary.area, "turn": boundary.turn, "touching": boundary.touching, "hangs_at": boundary.hangs_at, "component": boundary.component,
        "component_faces": boundary.component_triangles, "roughness": rough.as_ref().map(rim::roughness_json), "vertices": boundary.vertices,
    })
}
