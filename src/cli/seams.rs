//! Boundaries that are none to the eye: copies of vertices that differ in their last digits, and what joins them.

use fairmesh::{Coincident, Error, boundary_loops_joined};

use crate::failure::Failure;
use crate::formats::Geometry;

/// Copies of a vertex are within this part of the mesh's diagonal: what programs that write single precision leave between them, and far less
/// than any edge of use. Of soups with a jitter of 1e-9 to 1e-6 edges all are found; half or double: the same.
const NEAR: f64 = 1e-6;

/// That more vertices are to be joined, where boundary edges vanish by that; a line without an end.
pub fn advice(geometry: &Geometry, coincident: Coincident) -> Option<String> {
    let near = NEAR * geometry.bounds().diagonal();
    let within: f64 = format!("{near:.0e}").parse().ok()?;
    let is_asked = matches!(coincident, Coincident::Join { within: asked } if asked >= within);
    if is_asked || !within.is_normal() {
        return None;
    }
    let edges = |coincident| {
        let loops = boundary_loops_joined(&geometry.positions, &geometry.triangles, coincident).ok()?;
        Some(loops.iter().map(|of| of.vertices.len()).sum::<usize>())
    };
    let (before, after) = (edges(coincident)?, edges(Coincident::Join { within })?);
    (after < before).then(|| {
        format!(
            "the mesh has {before} boundary edges, {after} if vertices within {within:e} of each other are joined: --coincident {within:e}"
        )
    })
}

/// A refusal with that advice, if it has to do with boundaries.
pub fn advised(failure: Failure, error: &Error, geometry: &Geometry, coincident: Coincident) -> Failure {
    match error {
        Error::FreeVertexOnBoundary { .. } | Error::EmptyRegion => match advice(geometry, coincident) {
            Some(advice) => failure.and(&advice),
            None => failure,
        },
        _ => failure,
    }
}
