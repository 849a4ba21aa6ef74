//! Creases between a patch and the mesh around it.
//!
//! The kink of the surface that was there would excuse one as wide, as in a region (`quality/crease.rs`). Nobody knows it
//! in a hole, and what the refined triangulation has is no measure: only boundary normals that are given excuse a kink.

use nalgebra::Vector3;

use super::patch::Patch;
use super::surroundings::Surroundings;
use crate::discrete::boundary_normals::angle;
use crate::quality::crease::is_too_wide;

/// The loop's vertices where the patch, with its vertices at `x`, has a kink wider than a coarse mesh accounts for. `given`:
/// boundary normals by vertex, ascending.
pub(super) fn creases(
    patch: &Patch,
    x: &[Vector3<f64>],
    around: &Surroundings,
    given: &[(u32, [f64; 3])],
) -> Vec<u32> {
    let count = around.loop_vertices;
    let inside = normals(x, &patch.triangles, count);
    let outside = normals(&around.x, &around.triangles, count);
    let is_crease = |&v: &u32| {
        let (Some(inside), Some(outside)) = (inside[v as usize], outside[v as usize]) else {
            return false;
        };
        let asked = given
            .binary_search_by_key(&v, |entry| entry.0)
            .ok()
            .map_or(0.0, |at| {
                angle(&Vector3::from(given[at].1).normalize(), &outside).to_degrees()
            });
        is_too_wide(angle(&inside, &outside).to_degrees(), asked)
    };
    (0..count as u32).filter(is_crease).collect()
}

/// Per vertex, of the first `count`, the normalized sum of its triangles' cross products.
pub(super) fn normals(x: &[Vector3<f64>], triangles: &[[u32; 3]], count: usize) -> Vec<Option<Vector3<f64>>> {
    let mut sums = vec![Vector3::zeros(); count];
    for t in triangles {
        let [a, b, c] = t.map(|v| x[v as usize]);
        let cross = (b - a).cross(&(c - a));
        for v in t.iter().map(|&v| v as usize).filter(|&v| v < count) {
            sums[v] += cross;
        }
    }
    sums.iter()
        .map(|sum| sum.try_normalize(f64::MIN_POSITIVE))
        .collect()
}
