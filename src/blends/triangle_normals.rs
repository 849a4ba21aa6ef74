//! Normals of triangles, of those too that are too thin to tell one.

use nalgebra::Vector3;

use super::surface::Surface;
use crate::mesh::halfedge::{next, previous};

/// Triangles that are thinner than this, height over longest edge, tell nothing where coordinates are rounded to single precision.
/// Half, of 13 solids cut from each other: no bit changes; double: one changes, with as many creases, vertices and iterations. A plate with 16 bosses whose edges were
/// divided, with triangles of 1e-6: the same creases at both.
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
    let sound = |t: u32| (!is_thin(t)).then(|| crosses[t as usize].normalize());
    let mut normals: Vec<Option<Vector3<f64>>> = (0..count).map(sound).collect();
    spread(surface, &longest, &mut normals);
    let own = |cross: &Vector3<f64>| cross.try_normalize(0.0).unwrap_or_default();
    let all = normals.into_iter().zip(&crosses);
    all.map(|(normal, cross)| normal.unwrap_or_else(|| own(cross)))
        .collect()
}

/// From triangles that have a normal on to those that have none, as far as these are beside each other.
fn spread(surface: &Surface<'_>, longest: &dyn Fn(u32) -> u32, normals: &mut [Option<Vector3<f64>>]) {
    let around = |h: u32| [h, next(h), previous(h)];
    let mut waiting: Vec<u32> = (0..normals.len() as u32)
        .filter(|&t| normals[t as usize].is_none())
        .collect();
    while !waiting.is_empty() {
        let from = |&t: &u32| {
            let first = longest(t);
            let is_first_of_both = surface.across(first).is_none_or(|o| longest(o / 3) == o);
            let edges = around(first);
            let edges = &edges[..if is_first_of_both { 3 } else { 1 }];
            let mut beside = edges.iter().filter_map(|&h| surface.across(h));
            Some((t, beside.find_map(|o| normals[o as usize / 3])?))
        };
        let found: Vec<(u32, Vector3<f64>)> = waiting.iter().filter_map(from).collect();
        for &(t, normal) in &found {
            normals[t as usize] = Some(normal);
        }
        let beside = found.iter().flat_map(|of| around(3 * of.0));
        let beside = beside.filter_map(|h| surface.across(h)).map(|o| o / 3);
        waiting = beside.filter(|&t| normals[t as usize].is_none()).collect();
        waiting.sort_unstable();
        waiting.dedup();
    }
}
