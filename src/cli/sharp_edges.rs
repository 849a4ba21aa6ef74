//! Sharp edges that reach the boundary: which go on, and what became of them.

use clap::Args;
use fairmesh::{Options, SharpEdge, SharpFate};
use serde_json::{Value, json};

use crate::figures::significant;

/// The flag.
#[derive(Debug, Args)]
pub struct SharpArgs {
    /// Sharp edges that reach the boundary go on through the region: 'auto', those that
    /// are certain; DEGREES, those that bend by so much or more; 'off', none
    #[arg(
        long,
        value_name = "WHICH",
        default_value = default(),
        value_parser = sharp,
        help_heading = "Surface",
        verbatim_doc_comment
    )]
    pub sharp: f64,
}

/// The library's default, in the flag's words.
fn default() -> &'static str {
    if Options::default().sharp == Options::SHARP_AUTO {
        "auto"
    } else {
        "off"
    }
}

/// Reads `--sharp`.
fn sharp(text: &str) -> Result<f64, String> {
    match text {
        "auto" => Ok(Options::SHARP_AUTO),
        "off" => Ok(0.0),
        _ => {
            let degrees = text.parse::<f64>().ok();
            degrees
                .filter(|degrees| (0.0..=180.0).contains(degrees))
                .ok_or_else(|| "expected auto, off or an angle from 0 to 180 degrees".to_owned())
        }
    }
}

/// Lines for people, one for each edge or corner.
pub fn lines(edges: &[SharpEdge]) -> Vec<String> {
    edges.iter().map(line).collect()
}

/// The same below a patch.
pub fn of_patch(edges: &[SharpEdge]) -> Vec<String> {
    let told = |edge| format!("sharp edge: {}", line(edge));
    edges.iter().map(told).collect()
}

fn line(edge: &SharpEdge) -> String {
    let end = |end: &fairmesh::CreaseEnd| {
        let angle = significant(end.angle);
        format!("vertex {} ({angle} degrees)", end.vertex)
    };
    let ends: Vec<String> = edge.ends.iter().map(end).collect();
    let ends = ends.join(", ");
    let count = edge.vertices.len();
    let fate = edge.fate.entry().text();
    match edge.fate {
        SharpFate::GoesOn | SharpFate::Corner => format!("{ends}: {fate}, along {count} vertices"),
        _ => format!("{ends}: {fate}; {}", edge.fate.entry().remedy()),
    }
}

/// The same for programs.
pub fn json(edges: &[SharpEdge]) -> Value {
    let end = |end: &fairmesh::CreaseEnd| {
        json!({
            "vertex": end.vertex,
            "angle": end.angle,
            "error": end.error,
            "direction": end.direction,
            "curvature": end.curvature,
            "normals": end.normals,
        })
    };
    let edge = |edge: &SharpEdge| {
        json!({
            "fate": edge.fate.name(),
            "ends": edge.ends.iter().map(end).collect::<Vec<_>>(),
            "vertices": edge.vertices,
        })
    };
    edges.iter().map(edge).collect()
}
