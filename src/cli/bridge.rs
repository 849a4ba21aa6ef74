//! `fairmesh bridge`: a strip between two runs of boundary edges.

use std::fmt::Write;
use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use fairmesh::{
    BridgeOptions, Bridged, FillOutcome, LoopReport, OpenReason, OutputPrecision, Progress,
    bridge_with_progress,
};
use serde_json::{Value, json};

use crate::bar::Bar;
use crate::comparison::{MeshSide, PictureArgs, Story, story};
use crate::continuity::Asked;
use crate::explain;
use crate::failure::Failure;
use crate::fill::{reported, told, with_size};
use crate::formats::pipe_args::PipesArgs;
use crate::formats::{Added, MeshFile, references};
use crate::orientation;
use crate::patches::{Files, PatchArgs, face_numbers};

/// What `fairmesh bridge` is asked.
#[derive(Debug, Args)]
pub struct BridgeArgs {
    /// Mesh file: .ply, .obj, .off or .stl, optionally .gz; '-': stdin
    input: PathBuf,
    /// Output file; may be the input; '-': stdout. Written completely or not at all
    #[arg(short, long, value_name = "FILE", verbatim_doc_comment)]
    output: PathBuf,
    #[command(flatten)]
    pipes: PipesArgs,
    /// Where the bridge begins: consecutive boundary vertices, in either direction,
    /// as in 12,13,14; with --width, one is enough
    #[arg(
        long,
        visible_alias = "start",
        value_name = "VERTICES",
        value_delimiter = ',',
        required = true,
        verbatim_doc_comment
    )]
    from: Vec<u32>,
    /// Where it ends, on the same boundary or another one
    #[arg(
        long,
        visible_alias = "end",
        value_name = "VERTICES",
        value_delimiter = ',',
        required = true
    )]
    to: Vec<u32>,
    /// Width of the bridge: both ends are lengthened or shortened along their
    /// boundaries to about this length [default: as given]
    #[arg(long, value_name = "X", verbatim_doc_comment)]
    width: Option<f64>,
    /// Also fill the holes beside the bridge, and fair everything new together
    #[arg(long)]
    fill: bool,
    #[command(flatten)]
    pictures: PictureArgs,
    #[command(flatten)]
    patches: PatchArgs,
}

/// Makes the bridge; true if it is fair, and the rest, too, if that was asked for. Where none can be made nothing is written.
pub fn run(args: &BridgeArgs) -> Result<bool, Failure> {
    let start = Instant::now();
    let Files {
        format,
        mesh,
        turned,
        precision,
        output,
    } = args.patches.open(
        &args.input,
        &args.output,
        args.pipes.of(&args.input, Some(&args.output))?,
    )?;
    let answer = args.patches.answer(&args.output, &args.input)?;
    args.pictures.check(std::slice::from_ref(&args.input))?;
    let pictures = args.pictures.prepare(&args.input, &args.output)?;
    let solving = Instant::now();
    let bridged = solve(args, &mesh, precision).map_err(|error| refusal(args, &mesh, &error))?;
    let solve = solving.elapsed().as_secs_f64();
    if matches!(bridged.strip.outcome, FillOutcome::LeftOpen(_)) {
        let why = match bridged.strip.outcome {
            FillOutcome::LeftOpen(OpenReason::OppositeSides { .. }) => format!(
                "its ends face opposite ways: it would be twisted by {:.0} degrees; turn the faces of one of the two parts around",
                bridged.twist.abs()
            ),
            _ => told(&bridged.strip),
        };
        let name = args.input.display();
        return Err(Failure::new(format!("{name}: no bridge was made: {why}")));
    }
    let added = Added {
        positions: &bridged.positions,
        triangles: &bridged.triangles,
        parents: &bridged.parents,
        carry: None,
        mark: args.patches.mark.from(0),
    };
    let led = references::led(
        mesh.with_added(format, &added, None),
        format,
        &args.input,
        &args.output,
    );
    output.write(&led.bytes)?;
    let mut drawn = None;
    if let Some(pictures) = &pictures {
        let after = MeshSide {
            positions: &bridged.positions,
            triangles: &bridged.triangles,
        };
        drawn = Some(pictures.write(mesh.geometry.surface(), after, &in_story(&bridged))?);
    }
    let total = start.elapsed().as_secs_f64();
    let json = || {
        let (first, face) = face_numbers(&mesh, format);
        let rest: Vec<Value> = bridged.rest.iter().map(|l| reported(l, first, face)).collect();
        json!({ "strip": reported(&bridged.strip, first, face), "chains": bridged.chains, "sides": bridged.sides,
            "twist": bridged.twist, "loops": rest, "references": led.told,
            "whole": bridged.whole.as_ref().map(|report| report.outcome.name()),
            "turned_faces": turned, "new_vertices": bridged.parents.len(), "new_triangles": bridged.triangles.len() - mesh.geometry.triangles.len(),
            "seconds": { "solve": solve, "pictures": drawn, "total": total } })
    };
    answer.tell(&[&args.output], json, || {
        let told = led.told.iter().map(|line| format!("{line}\n"));
        orientation::turned(turned) + &readable(&bridged) + &told.collect::<String>()
    })?;
    Ok(bridged.is_success())
}

fn solve(
    args: &BridgeArgs,
    mesh: &MeshFile,
    output_precision: OutputPrecision,
) -> Result<Bridged, fairmesh::Error> {
    let mut bar = Bar::new(args.patches.quiet);
    let mut progress = |progress: &Progress| bar.show(progress);
    let options = BridgeOptions {
        width: args.width,
        fill: args.fill,
        filling: args.patches.options(output_precision),
    };
    let geometry = &mesh.geometry;
    let chains = [&args.from[..], &args.to];
    let bridged = bridge_with_progress(
        &geometry.positions,
        &geometry.triangles,
        chains,
        &options,
        &mut progress,
    );
    bar.finish();
    bridged
}

/// The library's refusal; of a chain, by its flag.
fn refusal(args: &BridgeArgs, mesh: &MeshFile, error: &fairmesh::Error) -> Failure {
    match error {
        fairmesh::Error::BadChain { chain, vertex, why } => {
            let flag = if *chain == 0 { "from" } else { "to" };
            Failure::new(format!(
                "--{flag}, vertex {vertex} of {}: {why}; {}",
                args.input.display(),
                error.entry().remedy()
            ))
        }
        _ => explain::refusal(&args.input, mesh, error),
    }
}

/// For a page.
fn in_story(bridged: &Bridged) -> Story {
    let name = |of: &LoopReport| format!("beside it, {} edges", of.edges);
    let strip = ("bridge".to_owned(), with_size(&bridged.strip), &bridged.strip);
    let rest = bridged.rest.iter().map(|of| (name(of), with_size(of), of));
    let patches: Vec<_> = std::iter::once(strip).chain(rest).collect();
    let ended = (bridged.is_success(), told(&bridged.strip));
    story::of_patches("bridge", ended, &patches, Asked::Auto, readable(bridged))
}

fn readable(bridged: &Bridged) -> String {
    let ends = bridged.chains.each_ref().map(|chain| chain.len() - 1);
    let mut text = format!(
        "bridge from {} edges to {}, twisted by {:.1} degrees: {}",
        ends[0],
        ends[1],
        bridged.twist,
        with_size(&bridged.strip)
    );
    for report in &bridged.rest {
        let _ = write!(text, "beside it, {} edges: {}", report.edges, with_size(report));
    }
    if let Some(whole) = &bridged.whole {
        let _ = writeln!(
            text,
            "all of it together: {}",
            whole.outcome.name().replace('_', " ")
        );
    }
    text
}
