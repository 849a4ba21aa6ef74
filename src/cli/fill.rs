//! `fairmesh fill`: the holes of a file filled.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use fairmesh::{
    BoundaryCurvature, FillOptions, FillOutcome, Filled, FlatReason, Join, LoopReport, Loops, OpenReason,
    Options, OutputPrecision, Progress, TrimLimits, fill_holes_with_progress,
};
use serde_json::{Value, json};

use crate::advice;
use crate::attempts;
use crate::bar::Bar;
use crate::batch::{self, Done};
use crate::comparison::{MeshSide, PictureArgs, story};
use crate::components;
use crate::continuity::{self, ContinuityArgs};
use crate::explain;
use crate::failure::{ExitCode, Failure};
use crate::formats::{Added, MeshFile, references};
use crate::jobs::{FilesArgs, Job};
use crate::join;
use crate::left_open;
use crate::orientation;
use crate::patches::{self, Files, PatchArgs, face_numbers};
use crate::region::{RegionReport, RegionSteps};
use crate::report::member_weight;
use crate::rim::{self, RimArgs};
use crate::seams;
use crate::selection;
use crate::sharp_edges;
use crate::which::WhichArgs;

/// What `fairmesh fill` is asked.
#[derive(Debug, Args)]
pub struct FillArgs {
    #[command(flatten)]
    files: FilesArgs,
    #[command(flatten)]
    which: WhichArgs,
    /// First remove components of the mesh with fewer triangles than this
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        conflicts_with = "boundary_curvature",
        verbatim_doc_comment
    )]
    drop_components_below: usize,
    /// Delete faces, and what would hang loose without them, and fill only the holes that
    /// this makes. The faces are listed in a text file, one number per line, from 0;
    /// without a file, the region flags choose them
    #[arg(
        long,
        value_name = "FILE",
        num_args = 0..=1,
        conflicts_with_all = ["boundary_curvature", "drop_components_below", "loops", "join", "which"],
        verbatim_doc_comment
    )]
    erase: Option<Option<PathBuf>>,
    #[command(flatten)]
    region: RegionSteps,
    /// Also remove up to this many bad faces at the edge of what is erased: slender ones
    /// (an angle below 5 degrees) and fins (more than 100 degrees against a neighbour)
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        requires = "erase",
        verbatim_doc_comment
    )]
    clean_boundary: usize,
    /// Remove up to this many bad faces around holes before filling: slender ones, spikes,
    /// fins, and faces attached by one edge only
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        conflicts_with_all = ["boundary_curvature", "erase", "loops", "join", "which", "guides"],
        verbatim_doc_comment
    )]
    trim: usize,
    /// Limit of --trim by area, in squared units of the file
    #[arg(long, value_name = "A", requires = "trim", verbatim_doc_comment)]
    trim_area: Option<f64>,
    /// Take colours, quality, texture coordinates and other attributes of new vertices and
    /// faces from the nearest point of what was erased, not from the edge of the hole
    #[arg(long, requires = "erase", verbatim_doc_comment)]
    carry_over: bool,
    /// Connect these two boundary vertices by an edge of the first triangulation, for example
    /// across a long tear, or between two joined loops. May be repeated, with each vertex
    /// once; the patch has no crease there
    #[arg(long = "guide", visible_alias = "guides", value_name = "A,B", value_parser = join::parse_pair, verbatim_doc_comment)]
    guides: Vec<[u32; 2]>,
    #[command(flatten)]
    rim: RimArgs,
    #[command(flatten)]
    continuity: ContinuityArgs,
    #[command(flatten)]
    pictures: PictureArgs,
    #[command(flatten)]
    patches: PatchArgs,
    /// List in the report every attempt at each patch, and how it ended
    #[arg(short, long, conflicts_with = "quiet")]
    verbose: bool,
}

/// Runs the command on every mesh.
pub fn run(args: &FillArgs) -> Result<ExitCode, Failure> {
    if args.erase.is_none() && !args.region.is_empty() {
        return Err(Failure::new(format!(
            "{}: this names faces; give --erase, too, to have them made anew, or --within for the holes in a place",
            args.region.told()
        )));
    }
    let telling = args.patches.telling(args.verbose);
    args.pictures.check(args.files.inputs())?;
    batch::run(&args.files, &telling, |job| one(args, job))
}

/// Fills holes of a mesh; good if all that were asked for are filled and fair.
fn one(args: &FillArgs, job: &Job) -> Result<Done, Failure> {
    let start = Instant::now();
    let Files {
        format,
        mesh,
        turned,
        precision,
        output,
    } = args.patches.open(&job.input, &job.output, job.piped)?;
    let pictures = args.pictures.prepare(&job.input, &job.output)?;
    let before = pictures.as_ref().map(|_| mesh.geometry.clone());
    let boundary_curvature = args
        .continuity
        .boundary_curvature(mesh.geometry.positions.len())?;
    let groups = args.which.join()?;
    let solving = Instant::now();
    let (mesh, dropped) = components::without_small(
        &job.input,
        mesh,
        args.drop_components_below,
        args.patches.mesh.coincident,
    )?;
    let limits = TrimLimits {
        triangles: args.trim,
        area: args.trim_area,
    };
    let (mesh, trimmed, trimmed_area) = match args.trim {
        0 => (mesh, 0, 0.0),
        _ => components::trimmed(&job.input, mesh, &limits, args.patches.mesh.coincident)?,
    };
    let coincident = args.patches.mesh.coincident;
    let mut region = RegionReport::default();
    let (mesh, erased) = match &args.erase {
        None => (mesh, None),
        Some(list) => {
            let found = selection::to_erase(&mesh, &job.input, (list.as_deref(), &args.region), coincident)?;
            region = found.report;
            let cleaning = (coincident, args.clean_boundary);
            let (rest, erased) = components::without_faces(&job.input, mesh, found.selected, cleaning)?;
            (rest, Some(erased))
        }
    };
    let loops = match &erased {
        Some(erased) => Loops::Chosen(erased.loops.clone()),
        None => args.which.loops(&groups, &mesh.geometry),
    };
    let filled = solve(args, (loops, groups), &mesh, boundary_curvature, precision)
        .map_err(|error| refusal(args, &job.input, &mesh, &error))?;
    let solve = solving.elapsed().as_secs_f64();
    let source = erased.as_ref().filter(|_| args.carry_over);
    let carried = source.map(|of| of.carried(&filled, mesh.geometry.triangles.len()));
    let carried = carried
        .transpose()
        .map_err(|error| refusal(args, &job.input, &mesh, &error))?;
    let carry = source
        .zip(carried.as_ref())
        .map(|(of, carried)| of.carry(carried, &filled));
    let mesh = with_moved(&job.input, mesh, &filled)?;
    let added = Added {
        positions: &filled.positions,
        triangles: &filled.triangles,
        parents: &filled.parents,
        carry: carry.as_ref(),
        mark: args.patches.mark.from(0),
    };
    let grown = mesh.with_added(format, &added, source.map(|of| &of.was));
    let led = references::led(grown, format, &job.input, &job.output);
    output.write(&led.bytes)?;
    // Outer boundaries that are passed over are no success by themselves; beside something that was done they are.
    let is_good =
        filled.is_success() || dropped + trimmed > 0 && filled.loops.iter().all(LoopReport::is_success);
    let oriented = match is_good && turned == 0 && !filled.loops.is_empty() {
        true => None,
        false => Some(orientation::told(&mesh.geometry, turned, coincident)),
    };
    let is_open = |of: &LoopReport| matches!(of.outcome, FillOutcome::LeftOpen(_));
    let seams = match filled.loops.iter().any(is_open) {
        true => seams::advice(&mesh.geometry, coincident),
        false => None,
    };
    let in_words = || {
        let more = erased.as_ref().map_or([0; 2], |of| [of.dropped, of.cleaned]);
        let trimmed = match trimmed {
            0 => String::new(),
            _ => format!("{trimmed} faces at the holes were taken away, of area {trimmed_area:.3e}\n"),
        };
        let region: String = region.told.iter().map(|line| format!("{line}\n")).collect();
        let oriented = oriented.as_ref().map_or("", |of| &of.text);
        let seams = seams
            .as_ref()
            .map_or(String::new(), |advice| format!("{advice}\n"));
        region + oriented + &seams + &trimmed + &readable(&filled, args, dropped, more)
    };
    let mut drawn = None;
    if let Some((pictures, before)) = pictures.as_ref().zip(before.as_ref()) {
        let after = MeshSide {
            positions: &filled.positions,
            triangles: &filled.triangles,
        };
        let told = filled.loops.iter().map(|l| (named(l), with_size(l), l));
        let ended = (is_good, format!("holes: {}", counted(&filled)));
        let asked = args.continuity.asked();
        let story = story::of_patches("fill", ended, &told.collect::<Vec<_>>(), asked, in_words());
        drawn = Some(pictures.write(before.surface(), after, &story)?);
    }
    let total = start.elapsed().as_secs_f64();
    let json = || {
        let (first, face) = face_numbers(&mesh, format);
        let loops: Vec<Value> = filled.loops.iter().map(|l| reported(l, first, face)).collect();
        json!({ "success": is_good, "loops": loops, "region": region.json(), "advice": seams, "orientation": oriented.as_ref().map(|of| &of.json), "dropped_components": dropped, "new_vertices": filled.parents.len(),
            "trimmed_faces": trimmed, "trimmed_area": trimmed_area,
            "dropped_faces": erased.as_ref().map_or(0, |of| of.dropped),
            "cleaned_faces": erased.as_ref().map_or(0, |of| of.cleaned),
            "new_triangles": filled.triangles.len() - mesh.geometry.triangles.len(),
            "seconds": { "solve": solve, "pictures": drawn, "total": total } })
    };
    Ok(Done {
        is_good,
        outcome: counted(&filled),
        json: match job.asks_json {
            true => json(),
            false => Value::Null,
        },
        readable: in_words(),
        references: led.told,
    })
}

/// How many holes ended how.
fn counted(filled: &Filled) -> String {
    let loops = &filled.loops;
    let is_open = |report: &&LoopReport| matches!(report.outcome, FillOutcome::LeftOpen(_));
    let open = loops.iter().filter(is_open).count();
    let unfair = loops.iter().filter(|l| !is_open(l) && !l.is_success()).count();
    let mut text = format!("{} filled", loops.len() - open);
    if unfair > 0 {
        let _ = write!(text, ", {unfair} of them not fair");
    }
    if open > 0 {
        let _ = write!(text, ", {open} left open");
    }
    text
}

/// The mesh with the vertices of rims where they have moved to.
fn with_moved(name: &Path, mesh: MeshFile, filled: &Filled) -> Result<MeshFile, Failure> {
    let has_moved = |report: &LoopReport| report.rim.as_ref().is_some_and(|rim| rim.moved > 0);
    if !filled.loops.iter().any(has_moved) {
        return Ok(mesh);
    }
    let written = mesh.with_positions(&filled.positions[..mesh.geometry.positions.len()]);
    MeshFile::parse(&name.display().to_string(), mesh.format(), written.bytes)
}

/// The library's refusal; of a loop, by its flag.
fn refusal(args: &FillArgs, name: &Path, mesh: &MeshFile, error: &fairmesh::Error) -> Failure {
    match error {
        fairmesh::Error::SelectionOutOfRange { index, count } => {
            let flag = if args.which.loops.contains(index) {
                "loop"
            } else {
                "join"
            };
            Failure::new(format!(
                "--{flag} {index}: {} has {count} boundary loops, counted from 0; 'fairmesh holes' lists them",
                name.display()
            ))
        }
        fairmesh::Error::BadOption {
            name: "join", value, ..
        } => Failure::new(format!(
            "--join: loop {value} is named twice; each loop is in one group, and once"
        )),
        _ => explain::refusal(name, mesh, error),
    }
}

fn solve(
    args: &FillArgs,
    (loops, join): (Loops, Join),
    mesh: &MeshFile,
    boundary_curvature: BoundaryCurvature,
    output_precision: OutputPrecision,
) -> Result<Filled, fairmesh::Error> {
    let mut bar = Bar::new(args.patches.quiet);
    let mut progress = |progress: &Progress| bar.show(progress);
    let asked = args.patches.options(output_precision);
    let options = FillOptions {
        loops,
        join,
        guides: args.guides.clone(),
        on_failure: args.which.on_failure(),
        rim: args.rim.rim(),
        fairing: Options {
            continuity: args.continuity.continuity,
            loop_continuity: args.continuity.continuity_at.clone(),
            boundary_curvature,
            ..asked.fairing
        },
        ..asked
    };
    let filled = fill_holes_with_progress(
        &mesh.geometry.positions,
        &mesh.geometry.triangles,
        &options,
        &mut progress,
    );
    bar.finish();
    filled
}

/// How a patch ended, in words.
pub fn told(report: &LoopReport) -> String {
    let fairing = report.fairing.as_ref();
    let ended = fairing.map_or(String::new(), |f| {
        let which = member_weight(&f.outcome).map_or(String::new(), explain::member);
        f.outcome.name().replace('_', " ") + &which
    });
    let mut text = match &report.outcome {
        FillOutcome::Faired => ended,
        FillOutcome::LeastBending => format!("{ended}: the surface of least bending"),
        FillOutcome::Flat { reason } => match reason {
            FlatReason::NotAsked => "triangulated and refined".into(),
            FlatReason::Planar => "closed by the plane of its boundary".into(),
            FlatReason::NoInnerVertex => "triangulated; no new vertex was needed".into(),
            FlatReason::Intersecting => format!("triangulated and refined only: {}", reason.entry().text()),
            FlatReason::Refused(error) => format!("triangulated and refined only: {error}"),
            _ => format!("triangulated and refined only: fairing ended as {ended}, with an unsound surface"),
        },
        FillOutcome::SelfIntersecting => format!(
            "{}: {} pairs of faces",
            report.outcome.entry().text(),
            report.self_intersections.len()
        ),
        FillOutcome::LeftOpen(reason) => format!("left open: {}", left_open::why(*reason)),
        _ => report.outcome.name().to_owned(),
    };
    if report.normals_reached < 1.0 {
        let percent = 100.0 * report.normals_reached;
        let _ = write!(text, ", with {percent:.0} % of the mesh's normals");
    }
    if report.has_no_area() {
        text += ", with triangles that have no area";
    }
    if report.coarsened {
        text += ", coarser inside, to keep to --max-new-vertices, or to 1000 + N^2 for a loop of N edges";
    }
    if !report.outside.is_empty() {
        let _ = write!(
            text,
            ", {} vertices far outside the loop's box",
            report.outside.len()
        );
    }
    text
}

/// The same with the size of the patch, as a line.
pub fn with_size(report: &LoopReport) -> String {
    let mut text = told(report);
    if !matches!(report.outcome, FillOutcome::LeftOpen(_)) {
        let (vertices, triangles) = (report.vertices.len(), report.triangles.len());
        let angle = report.worst_angle;
        let _ = write!(
            text,
            "; {vertices} vertices, {triangles} faces, smallest angle {angle:.1}"
        );
    }
    text.push('\n');
    text
}

fn named(report: &LoopReport) -> String {
    match &report.loops[..] {
        [_] => format!("loop {}", report.index),
        joined => format!("loops {} joined", join::list(joined)),
    }
}

fn readable(filled: &Filled, args: &FillArgs, dropped: usize, [loose, cleaned]: [usize; 2]) -> String {
    let mut text = String::new();
    if dropped > 0 {
        let _ = writeln!(
            text,
            "{dropped} components of fewer than {} triangles were dropped",
            args.drop_components_below
        );
    }
    if loose > 0 {
        let _ = writeln!(text, "{loose} faces more were dropped: they hung loose then");
    }
    if cleaned > 0 {
        let _ = writeln!(
            text,
            "{cleaned} faces more were dropped: they were slender, or fins"
        );
    }
    if filled.loops.is_empty() {
        text += "no boundary: nothing to fill\n";
    } else if !filled.is_success() && filled.loops.iter().all(LoopReport::is_success) {
        text += "nothing was filled: no boundary of the mesh is a hole\n";
    }
    let is_inconsistent = |report: &&LoopReport| {
        matches!(
            report.outcome,
            FillOutcome::LeftOpen(OpenReason::Inconsistent { .. })
        )
    };
    // One cause: a line is enough.
    let inconsistent = filled.loops.iter().filter(is_inconsistent).count();
    let in_one_line = inconsistent > 1 && !args.verbose;
    if in_one_line {
        let _ = writeln!(
            text,
            "{inconsistent} loops left open: they run into edges whose faces are oriented inconsistently"
        );
    }
    let has_line = |report: &&LoopReport| !in_one_line || !is_inconsistent(report);
    for report in filled.loops.iter().filter(has_line) {
        let _ = write!(
            text,
            "{}, {} edges: {}",
            named(report),
            report.edges,
            with_size(report)
        );
        if let Some(reason) = &report.joined {
            let _ = writeln!(text, "  {}", join::told(reason));
        }
        if let Some(report) = &report.rim {
            let _ = writeln!(text, "  {}", rim::told(report));
        }
        let Some(fairing) = &report.fairing else { continue };
        let advice = advice::of_patch(false, &fairing.outcome);
        if !advice.is_empty() && !report.is_success() {
            let _ = writeln!(text, "  what to do: {advice}");
        }
        let tried = args.verbose.then(|| attempts::lines(&fairing.components));
        let continued = continuity::of_patch(&fairing.components, args.continuity.asked(), args.verbose);
        let edges = sharp_edges::of_patch(&fairing.sharp_edges);
        for line in edges
            .into_iter()
            .chain(tried.into_iter().flatten())
            .chain(continued)
        {
            let _ = writeln!(text, "  {line}");
        }
    }
    text
}

/// A loop's report for programs; `face` is a triangle's polygon, new ones have the numbers of the output, from `first` on.
pub fn reported(report: &LoopReport, first: usize, face: impl Fn(u32) -> usize) -> Value {
    let faces = if report.triangles.is_empty() {
        json!([first, first])
    } else {
        json!([face(report.triangles.start), face(report.triangles.end)])
    };
    let rim = report.rim.as_ref().map(|report| rim::json(report, &face));
    let pairs: Vec<Vec<usize>> = report
        .self_intersections
        .iter()
        .map(|pair| pair.iter().map(|&t| face(t)).collect())
        .collect();
    let fairing = report.fairing.as_ref().map(patches::fairing);
    json!({
        "index": report.index, "loops": report.loops, "joined": report.joined.as_ref().map(join::json),
        "edges": report.edges, "outcome": report.outcome.name(), "success": report.is_success(), "told": told(report),
        "vertices": [report.vertices.start, report.vertices.end], "faces": faces, "fairing": fairing,
        "normals_reached": report.normals_reached, "worst_angle": report.worst_angle, "outside": report.outside, "coarsened": report.coarsened,
        "intersections": { "count": pairs.len(), "list": pairs }, "rim": rim, "seconds": report.seconds,
    })
}
