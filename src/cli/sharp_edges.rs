//! What became of the sharp edges that reach the boundary.

use fairmesh::{SharpEdge, SharpFate};
use serde_json::{Value, json};

use crate::figures::significant;

/// Lines for people, one for each edge or corner.
pub fn lines(edges: &[SharpEdge]) -> Vec<String> {
    edges.iter().map(line).collect()
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
