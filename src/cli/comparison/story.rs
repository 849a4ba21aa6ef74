//! What the commands have to say of a mesh, for its page.

use fairmesh::{FillOutcome, LoopReport, Outcome, Report};

use super::page::Story;
use crate::advice::of_patch;
use crate::continuity::{self, Asked};
use crate::explain;
use crate::figures::{VERTICES, listed, range, significant};

/// Where the eye finds what figures may hide.
const LINES: &str = "Look at the reflection lines: they should run over the edge of what has changed without a break, which is a crease";
const KINKS: &str = "; a kink there is a jump of curvature, which '--continuity g2' takes away.";
/// Where faces beside the boundary turn from its normals by more than so many degrees, root mean square, the surroundings are too rough to tell a
/// curvature. On four regions of smooth scans they turn by 1 to 4.6, on two of rough ones by 12 and 13; at half two of the smooth ones get no advice,
/// at double none changes.
const ROUGH: f64 = 5.0;

/// Of a region that was faired.
pub fn of_fairing(report: &Report, asked: Asked, remedy: &str, printed: String) -> Story {
    let is_good = report.outcome == Outcome::Converged;
    let mut facts = vec![("vertices that moved", report.free_vertices.to_string())];
    facts.extend(surface(report, asked));
    Story {
        command: "fair",
        is_good,
        outcome: explain::outcome(report),
        advice: advice([remedy], is_good, asked == Asked::Tangent && is_smooth(report)),
        facts: named(facts),
        printed,
    }
}

/// Of creases that were rounded.
pub fn of_blends(report: &Report, printed: String) -> Story {
    let is_good = report.outcome.is_success();
    Story {
        command: "round",
        is_good,
        outcome: explain::outcome(report),
        advice: advice([""], is_good, false),
        facts: named(surface(report, Asked::Tangent)),
        printed,
    }
}

/// Of holes that were filled, or a bridge; each with its name and how it ended.
pub fn of_patches(
    command: &'static str,
    (is_good, outcome): (bool, String),
    patches: &[(String, String, &LoopReport)],
    asked: Asked,
    printed: String,
) -> Story {
    let mut facts = Vec::new();
    for (name, told, report) in patches {
        facts.push((name.clone(), told.trim_end().to_owned()));
        if matches!(report.outcome, FillOutcome::LeftOpen(_)) {
            continue;
        }
        let fairing = report.fairing.iter();
        let mut about = fairing.flat_map(|of| surface(of, asked)).collect::<Vec<_>>();
        // Of a patch the pairs are told by its own report.
        about.retain(|(name, _)| *name != INTERSECTIONS);
        let pairs = report.self_intersections.len();
        about.push((INTERSECTIONS, counted(pairs)));
        facts.extend(
            about
                .into_iter()
                .map(|(what, text)| (format!("{name}: {what}"), text)),
        );
    }
    let remedies = patches
        .iter()
        .filter_map(|(_, _, report)| Some(of_patch(command == "bridge", &report.fairing.as_ref()?.outcome)));
    let mut faired = patches
        .iter()
        .filter_map(|(_, _, report)| report.fairing.as_ref());
    let has_more = asked == Asked::Tangent && faired.all(is_smooth);
    Story {
        command,
        is_good,
        outcome,
        advice: advice(remedies, is_good, has_more),
        facts,
        printed,
    }
}

const INTERSECTIONS: &str = "self-intersections";

fn counted(pairs: usize) -> String {
    match pairs {
        0 => "none found".to_owned(),
        n => format!("{n} pairs of triangles"),
    }
}

/// How sound a surface is, and how it meets what is around it.
fn surface(report: &Report, asked: Asked) -> Vec<(&'static str, String)> {
    let quality = &report.quality;
    let [kink, before] = [quality.boundary_kink, quality.boundary_kink_before].map(significant);
    let mut rows = vec![
        (
            "kink across the boundary",
            format!("at most {kink} degrees ({before} there in the input)"),
        ),
        (
            "from boundary normals to faces",
            format!(
                "at most {} degrees, root mean square {}",
                significant(quality.normal_deviation),
                significant(quality.normal_deviation_rms)
            ),
        ),
        ("mean curvature inside", range(quality.h_inside)),
        ("mean curvature at the boundary", range(quality.h_boundary)),
    ];
    let lines = continuity::lines(&report.components, asked);
    if !lines.is_empty() {
        rows.push(("continuous curvature", lines.join("; ")));
    }
    rows.push((
        "smallest angle",
        format!("{} degrees", significant(quality.worst_angle)),
    ));
    let pairs = report.self_intersections.as_ref();
    rows.push((
        INTERSECTIONS,
        pairs.map_or("not checked".to_owned(), |found| counted(found.pairs.len())),
    ));
    if !report.suspicious_normals.is_empty() {
        rows.push(("suspicious normals", listed(&report.suspicious_normals, VERTICES)));
    }
    rows
}

/// Whether what is around is smooth enough to continue its curvature.
fn is_smooth(report: &Report) -> bool {
    report.quality.normal_deviation_rms < ROUGH
}

/// These, each once; what to look at where all is well, and whether curvature may be asked for.
fn advice<'a>(remedies: impl IntoIterator<Item = &'a str>, is_good: bool, has_more: bool) -> Vec<String> {
    let mut advice: Vec<String> = Vec::new();
    for remedy in remedies.into_iter().map(str::to_owned) {
        if !remedy.is_empty() && !advice.contains(&remedy) {
            advice.push(remedy);
        }
    }
    if is_good {
        advice.push(LINES.to_owned() + if has_more { KINKS } else { "." });
    }
    advice
}

fn named(rows: Vec<(&'static str, String)>) -> Vec<(String, String)> {
    rows.into_iter()
        .map(|(name, text)| (name.to_owned(), text))
        .collect()
}
