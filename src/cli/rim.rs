//! Flags for rims that are noise, and how what became of them is told.

use clap::Args;
use fairmesh::{Rim, RimReport, Roughness};
use serde_json::{Value, json};

/// Flags that let the mesh around a hole move.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Rough rims")]
pub struct RimArgs {
    /// Smooth noisy rims first: move K rings of vertices around each hole onto the
    /// average surface there, the rim itself counted; 3 is a good value. 'auto': of
    /// holes that 'fairmesh holes' calls rough, and where nothing folds
    #[arg(long, value_name = "K", default_value = "0", value_parser = rings, verbatim_doc_comment)]
    relax_rim: usize,
    /// Limit of --relax-rim for each vertex [default: the mean edge length there]
    #[arg(long, value_name = "D", requires = "relax_rim")]
    relax_within: Option<f64>,
}

/// Reads `--relax-rim`.
fn rings(text: &str) -> Result<usize, String> {
    match text {
        "auto" => Ok(Rim::AUTO),
        _ => text
            .parse()
            .map_err(|_| "expected auto or a number of rings".to_owned()),
    }
}

impl RimArgs {
    pub fn rim(&self) -> Rim {
        Rim {
            relax: self.relax_rim,
            within: self.relax_within,
        }
    }
}

/// What became of a rim, in a line.
pub fn told(report: &RimReport) -> String {
    if report.radius == 0.0 {
        return "rim: too small to tell what it is like; no vertex moved".to_owned();
    }
    let mut text = format!(
        "rim: {} vertices moved by {:.3e} (rms), {:.3e} at most; noise {:.3e} over {:.3e}",
        report.moved, report.rms, report.largest, report.noise, report.radius
    );
    if report.bounded > 0 {
        text += &format!(
            "; {} would have moved further than {:.3e}",
            report.bounded, report.within
        );
    }
    if !report.is_even() {
        text += "; it is in some places only, so that features may have been taken for noise: look at them";
    }
    if report.folded > 0 {
        text += &format!(
            "; {} faces beside the hole are folded: let more rings move, or further",
            report.folded
        );
    }
    if !report.self_intersections.is_empty() {
        text += &format!(
            "; {} pairs of the mesh's own faces intersect now: let fewer rings move, or less far",
            report.self_intersections.len()
        );
    }
    text
}

/// The same for programs; `face` is a triangle's polygon.
pub fn json(report: &RimReport, face: impl Fn(u32) -> usize) -> Value {
    let pairs = report.self_intersections.iter().map(|pair| pair.map(&face));
    json!({
        "moved": report.moved, "rms": report.rms, "largest": report.largest, "within": report.within,
        "bounded": report.bounded, "folded": report.folded, "noise": report.noise, "evenness": report.evenness, "radius": report.radius,
        "intersections": pairs.collect::<Vec<_>>(),
    })
}

/// What to do about a rim, if it is rough.
pub fn advice(of: &Roughness) -> Option<String> {
    let rim = of.advice?;
    Some(format!(
        "is rough: {:.0} degrees between neighbouring faces, {:.0} expected; 'fairmesh fill --relax-rim auto' smooths {} rings",
        of.angle, of.expected, rim.relax
    ))
}

/// The roughness for programs.
pub fn roughness_json(of: &Roughness) -> Value {
    let advice = of
        .advice
        .map(|rim| json!({ "relax_rim": rim.relax, "relax_within": rim.within }));
    json!({ "ratio": of.ratio(), "angle": of.angle, "expected": of.expected, "noise": of.noise, "advice": advice })
}
