//! Normals of triangles, of those too that are too thin to tell one.

use nalgebra::Vector3;

use super::surface::Surface;
use crate::mesh::halfedge::{next, previous};

/// Triangles that are thinner than this, height over longest edge, tell nothing where coordinates are rounded to single precision.
/// Half or double, of 13 solids cut from each other: none changes.
const THIN: f64 = 1e-4;

/// Unit normals. A triangle that is as thin as rounding has that of the one across its longest edge; if that one is as thin, and it is the longest edge of
/// both, across its other edges, too.
pub(super) fn normals(surface: &Surface<'_>) -> Vec<Vector3<f64>> {
    let count = surface.half_edges() / 3;
    let cross = |t: u32| surface.edge(3 * t).cross(&surface.edge(3 * t + 1));
    let crosses: Vec<Vector3<f64>> = (0..count).map(cross).collect();
    let length = |h: &u32| surface.edge(*h).norm_squared();
    let longest = |t: u32| {
        let order = |g: &u32, h: &u32| length(g).total_cmp(&length(h));
        (3 * t..3 * t + 3).max_by(order).unwrap_or(3 * t)
    };
    let is_thin = |t: u32| crosses[t as usize].norm() <= THIN * length(&longest(t));
    let (thin, sound): (Vec<u32>, Vec<u32>) = (0..count).partition(|&t| is_thin(t));
    let mut normals = vec![Vector3::zeros(); count as usize];
    for t in sound {
        normals[t as usize] = crosses[t as usize].normalize();
    }
    let mut is_told = vec![true; count as usize];
    thin.iter().for_each(|&t| is_told[t as usize] = false);
    let around = |h: u32| [h, next(h), previous(h)];
    let across = |h: u32| surface.across(h).map(|o| o / 3);
    // From those that have one on: who is beside them may have it next.
    let mut waiting = thin.clone();
    while !waiting.is_empty() {
        let from = |&t: &u32| {
            let first = longest(t);
            let is_first_of_both = surface.across(first).is_none_or(|o| longest(o / 3) == o);
            let edges = around(first);
            let edges = &edges[..if is_first_of_both { 3 } else { 1 }];
            let mut beside = edges.iter().filter_map(|&h| across(h));
            Some((t, beside.find(|&u| is_told[u as usize])?))
        };
        let found: Vec<(u32, u32)> = waiting.iter().filter_map(from).collect();
        for &(t, from) in &found {
            normals[t as usize] = normals[from as usize];
        }
        found.iter().for_each(|of| is_told[of.0 as usize] = true);
        let beside = found.iter().flat_map(|of| around(3 * of.0)).filter_map(across);
        waiting = beside.filter(|&u| !is_told[u as usize]).collect();
        waiting.sort_unstable();
        waiting.dedup();
    }
    for t in thin.into_iter().filter(|&t| !is_told[t as usize]) {
        normals[t as usize] = crosses[t as usize].try_normalize(0.0).unwrap_or_default();
    }
    normals
}
