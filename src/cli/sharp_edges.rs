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

    /// Edges from each of these vertices to the next one are sharp, too, however little
    /// they bend; may be given several times. Inside of the region they say which edges
    /// are to lie on one that goes on
    #[arg(
        long,
        value_name = "A,B,...",
        value_parser = marked_chain,
        help_heading = "Surface",
        verbatim_doc_comment
    )]
    pub marked_edges: Vec<MarkedChain>,
}

impl SharpArgs {
    /// The edges that are marked, as pairs.
    pub fn marked_edges(&self) -> Vec<[u32; 2]> {
        self.marked_edges.iter().flat_map(MarkedChain::edges).collect()
    }
}

/// Vertices with edges between them.
#[derive(Debug, Clone)]
pub struct MarkedChain(Vec<u32>);

impl MarkedChain {
    /// The edges, as pairs.
    pub fn edges(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.0.windows(2).map(|step| [step[0], step[1]])
    }
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

/// Reads vertices with edges between them.
pub fn marked_chain(text: &str) -> Result<MarkedChain, String> {
    let numbers: Result<Vec<u32>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers {
        Ok(chain) if chain.len() > 1 => Ok(MarkedChain(chain)),
        _ => Err("expected numbers of two or more vertices, counted from 0, as in 12,57,3".to_owned()),
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
