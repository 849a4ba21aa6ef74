//! `fairmesh round`: creases become blends.

use std::fmt::Write;
use std::path::PathBuf;
use std::time::Instant;

use clap::{ArgGroup, Args, ValueEnum};
use fairmesh::{Creases, Narrowing, Options, OutputPrecision, RoundOptions, Rounded, round};
use serde_json::{Value, json};

use crate::answer::Answer;
use crate::chosen_creases::CreaseArgs;
use crate::comparison::{MeshSide, PictureArgs, story};
use crate::continuity::{self, Asked};
use crate::explain;
use crate::failure::Failure;
use crate::figures::significant;
use crate::formats::pipe_args::PipesArgs;
use crate::formats::{MeshFile, references};
use crate::orientation;
use crate::patches::{Files, MarkArgs, fairing};
use crate::rounded_file;
use crate::surface::{IntersectionArgs, MeshArgs};

/// Creases by whether material or air is inside them.
#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum CreaseKind {
    /// All of them
    #[default]
    All,
    /// Edges that stand out
    Convex,
    /// Edges that lie in a fold
    Concave,
}

/// What `fairmesh round` is asked.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("size").required(true))]
pub struct RoundArgs {
    /// Mesh file: .ply, .obj, .off or .stl, optionally .gz; '-': stdin
    input: PathBuf,
    /// Output file; may be the input; '-': stdout. Written completely or not at all
    #[arg(short, long, value_name = "FILE", verbatim_doc_comment)]
    output: PathBuf,
    #[command(flatten)]
    pipes: PipesArgs,
    /// How far blends reach from the edge, on both sides
    #[arg(long, value_name = "X", group = "size")]
    width: Option<f64>,
    /// Radius of a ball that touches both sides where the blend begins: between planes
    /// the radius of the blend
    #[arg(long, value_name = "X", group = "size", verbatim_doc_comment)]
    radius: Option<f64>,
    /// How many times as far as at its beginning a blend reaches at the end of its edges:
    /// it begins where the first one of --edges does, else at the smaller vertex
    /// [default: 1]
    #[arg(long, value_name = "FACTOR", verbatim_doc_comment)]
    taper: Option<f64>,
    /// Edges that bend by more than so many degrees are creases
    /// [default: by the widest gap between the bends of the mesh]
    #[arg(long, value_name = "DEGREES", verbatim_doc_comment)]
    angle: Option<f64>,
    /// Which creases are rounded
    #[arg(long, value_name = "WHICH", value_enum, default_value_t)]
    creases: CreaseKind,
    /// Refuse where there is less room than the width asked for; otherwise blends are
    /// narrower there
    #[arg(long, verbatim_doc_comment)]
    fit: bool,
    #[command(flatten)]
    chosen: CreaseArgs,
    /// How smoothly blends continue the faces beside them: 'g1' (tangent planes), 'g2'
    /// (mean curvature, too), or a number from 0 (g1) to 1 (g2)
    #[arg(
        long,
        value_name = "HOW-FAR",
        default_value = "g1",
        value_parser = continuity::part,
        verbatim_doc_comment
    )]
    continuity: f64,
    /// Refuse blends that would have more vertices than about so many [default: 1000000]
    #[arg(long, value_name = "N", verbatim_doc_comment)]
    max_blend_vertices: Option<usize>,
    /// Stop when the vertices move less than this part of a blend's diagonal, between
    /// 0 and 1 [default: 1e-8]
    #[arg(long, value_name = "X", verbatim_doc_comment)]
    tolerance: Option<f64>,
    /// Worker threads; 0: one per processor.
    /// The result does not depend on it
    #[arg(long, value_name = "N", default_value_t = 0, verbatim_doc_comment)]
    threads: usize,
    #[command(flatten)]
    mark: MarkArgs,
    #[command(flatten)]
    mesh: MeshArgs,
    #[command(flatten)]
    intersections: IntersectionArgs,
    #[command(flatten)]
    pictures: PictureArgs,
    /// Also write the report as JSON; '-': to stdout, instead of the text
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// No report; errors are still printed
    #[arg(short, long)]
    quiet: bool,
}

/// Rounds; true if all blends are fair.
pub fn run(args: &RoundArgs) -> Result<bool, Failure> {
    let start = Instant::now();
    let piped = args.pipes.of(&args.input, Some(&args.output))?;
    let Files {
        format,
        mesh,
        turned,
        precision,
        output,
    } = Files::open(&args.input, &args.output, piped, &args.mesh, &args.mark)?;
    let answer = Answer::prepare(
        args.json.as_deref(),
        args.quiet,
        Some(&args.output),
        &[&args.input],
    )?;
    args.pictures.check(std::slice::from_ref(&args.input))?;
    let pictures = args.pictures.prepare(&args.input, &args.output)?;
    let solving = Instant::now();
    let geometry = &mesh.geometry;
    let mut options = options(args, &mesh, precision);
    options.edges = args.chosen.edges(&mesh, &args.input, &options)?;
    let rounded = round(&geometry.positions, &geometry.triangles, &options)
        .map_err(|error| refusal(args, &mesh, &error))?;
    if args.fit {
        fits(args, &rounded)?;
    }
    let solve = solving.elapsed().as_secs_f64();
    let (bytes, first) = rounded_file::written(&mesh, (&args.input, format), &rounded, &args.mark)?;
    let led = references::led(bytes, format, &args.input, &args.output);
    output.write(&led.bytes)?;
    let is_good = rounded.is_complete();
    if let Some(pictures) = &pictures {
        let after = MeshSide {
            positions: &rounded.positions,
            triangles: &rounded.triangles,
        };
        let told = story::of_blends(&rounded.report, readable(&rounded));
        pictures.write(geometry.surface(), after, &told)?;
    }
    let total = start.elapsed().as_secs_f64();
    let json = || {
        let narrowed = |of: &Narrowing| json!({ "part": of.part, "place": of.place });
        let chains = rounded.chains.iter().map(|chain| {
            json!({ "vertices": chain.vertices, "bend": chain.bend, "rounded": chain.is_rounded,
                "narrowed": chain.narrowed.as_ref().map(narrowed), "unsolved": chain.unsolved })
        });
        let corners = rounded.sharp_corners.iter();
        let corners = corners.map(|of| json!({ "vertex": of.vertex, "place": of.place }));
        json!({ "angle": rounded.angle, "chains": chains.collect::<Vec<Value>>(),
            "sharp_corners": corners.collect::<Vec<Value>>(), "fairing": fairing(&rounded.report),
            "turned_faces": turned, "kept_vertices": rounded.kept_vertices.len(), "new_vertices": rounded.parents.len(), "first_new_face": first,
            "new_triangles": rounded.triangles.len() - rounded.kept_triangles.len(),
            "references": led.told, "seconds": { "solve": solve, "total": total } })
    };
    answer.tell(&[&args.output], json, || {
        let told = led.told.iter().map(|line| format!("{line}\n"));
        orientation::turned(turned)
            + &readable(&rounded)
            + &continued(args, &rounded)
            + &told.collect::<String>()
    })?;
    Ok(is_good)
}

fn options(args: &RoundArgs, mesh: &MeshFile, output_precision: OutputPrecision) -> RoundOptions {
    let defaults = Options::default();
    let round = RoundOptions::default();
    RoundOptions {
        taper: args.taper.unwrap_or(round.taper),
        max_blend_vertices: args.max_blend_vertices.unwrap_or(round.max_blend_vertices),
        width: args.width.unwrap_or(0.0),
        radius: args.radius.unwrap_or(0.0),
        angle: args.angle.unwrap_or(0.0),
        creases: match args.creases {
            CreaseKind::All => Creases::All,
            CreaseKind::Convex => Creases::Convex,
            CreaseKind::Concave => Creases::Concave,
        },
        labels: mesh.labels(),
        fairing: Options {
            continuity: args.continuity,
            tolerance: args.tolerance.unwrap_or(defaults.tolerance),
            output_precision,
            threads: args.threads,
            intersections: args.intersections.intersections(),
            coincident: args.mesh.coincident,
            ..defaults
        },
        ..round
    }
}

/// The library's refusal; that there is nothing to be done, by what was asked.
fn refusal(args: &RoundArgs, mesh: &MeshFile, error: &fairmesh::Error) -> Failure {
    match error {
        fairmesh::Error::NoCrease => Failure::new(format!(
            "{}: no such edge bends enough to be rounded, or its sides lie almost on each other; --angle says from how many degrees on",
            args.input.display()
        )),
        _ => explain::refusal(&args.input, mesh, error),
    }
}

/// Refuses blends that are narrower than asked.
fn fits(args: &RoundArgs, rounded: &Rounded) -> Result<(), Failure> {
    let narrowed: Vec<&Narrowing> = rounded
        .chains
        .iter()
        .filter_map(|chain| chain.narrowed.as_ref())
        .collect();
    let Some(least) = narrowed.iter().min_by(|a, b| a.part.total_cmp(&b.part)) else {
        return Ok(());
    };
    let all: Vec<[f64; 3]> = narrowed.iter().map(|of| of.place).collect();
    Err(Failure::new(format!(
        "{}: {} creases have less room than that, down to {} % of it: at {}; --fit refuses that",
        args.input.display(),
        all.len(),
        significant(100.0 * least.part),
        places(&all)
    )))
}

/// How far the curvature of the faces goes on in the blends, if that was asked for.
fn continued(args: &RoundArgs, rounded: &Rounded) -> String {
    let asked = match args.continuity > 0.0 {
        true => Asked::Curvature,
        false => Asked::Tangent,
    };
    let lines = continuity::lines(&rounded.report.components, asked);
    lines.iter().map(|line| format!("continuity: {line}\n")).collect()
}

fn readable(rounded: &Rounded) -> String {
    let count = rounded.chains.iter().filter(|chain| chain.is_rounded).count();
    let mut text = format!(
        "{count} of {} creases rounded, those of more than {} degrees: {}\n",
        rounded.chains.len(),
        significant(rounded.angle),
        explain::outcome(&rounded.report)
    );
    let _ = writeln!(
        text,
        "{} new vertices, {} new faces; {} iterations",
        rounded.parents.len(),
        rounded.triangles.len() - rounded.kept_triangles.len(),
        rounded.report.iterations
    );
    let corners: Vec<[f64; 3]> = rounded.sharp_corners.iter().map(|of| of.place).collect();
    let unsolved: Vec<[f64; 3]> = rounded.chains.iter().filter_map(|of| of.unsolved).collect();
    for (what, all) in [("corners", corners), ("creases", unsolved)] {
        if !all.is_empty() {
            let _ = writeln!(
                text,
                "{} {what} stay sharp, as no sound blend was found: at {}",
                all.len(),
                places(&all)
            );
        }
    }
    let narrowed: Vec<&Narrowing> = rounded
        .chains
        .iter()
        .filter_map(|of| of.narrowed.as_ref())
        .collect();
    let least = narrowed.iter().min_by(|a, b| a.part.total_cmp(&b.part));
    if let Some(least) = least {
        let _ = writeln!(
            text,
            "{} creases have less room than asked for, the least {} of the width at {}",
            narrowed.len(),
            significant(least.part),
            places(&[least.place])
        );
    }
    text
}

/// The first few places, for people.
fn places(all: &[[f64; 3]]) -> String {
    const MOST: usize = 3;
    let place = |p: &[f64; 3]| format!("({})", p.map(significant).join(", "));
    let told: Vec<String> = all.iter().take(MOST).map(place).collect();
    let more = if all.len() > MOST { ", ..." } else { "" };
    told.join(", ") + more
}
