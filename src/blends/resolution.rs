//! How long edges are to be where blends bend much from triangle to triangle.

use super::facets::Facets;
use crate::mesh::halfedge::{next, previous};

/// Edges that bend by more than so many degrees want shorter ones around them, and by how much they are to bend then.
/// Of 12 solids cut from each other, half of the first: as sound, with 0.5 % more vertices; double: 0.2 % fewer. Half or double
/// of the second: 0.2 % more and 0.1 % fewer.
const WIDE: f64 = 25.0;
const AIM: f64 = 20.0;
/// Edges get no shorter than this part of those that there are.
/// Of 12 solids cut from each other, half or double: all are as sound, with as many vertices to 0.1 %.
const LEAST: f64 = 0.4;

/// Per vertex the largest length of edges that the surface allows there; infinity where it asks for nothing. None if it asks for nothing anywhere. The bands are
/// the triangles from number `first` on.
pub(super) fn lengths(positions: &[[f64; 3]], triangles: &[[u32; 3]], first: usize) -> Option<Vec<f64>> {
    let facets = Facets::new(positions, triangles).ok()?;
    let mut lengths = vec![f64::INFINITY; positions.len()];
    let mut is_any = false;
    for h in 3 * first as u32..3 * triangles.len() as u32 {
        let (Some(bend), Some(o)) = (facets.bend(h), facets.links.across(h)) else {
            continue;
        };
        if bend <= WIDE {
            continue;
        }
        // The side of an equilateral triangle as high as these two in the mean.
        let height = 0.5 * (facets.cross(h).norm() + facets.cross(o).norm()) / facets.edge(h).norm();
        let side = height * 2.0 / 3.0_f64.sqrt();
        for v in [h, next(h), previous(h), previous(o)].map(|g| facets.links.origin(g) as usize) {
            lengths[v] = lengths[v].min(side * (AIM / bend).max(LEAST));
        }
        is_any = true;
    }
    is_any.then_some(lengths)
}
