//! Where a new vertex comes from, so that colours and the like can be interpolated.

use fairmesh_linear::interrupt::is_stopped;
use nalgebra::Vector3;

use super::patch::Patch;

/// Original vertices of the boundary and their weights, which sum to one and are not negative. Unused entries repeat a
/// vertex with weight 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parents {
    /// Vertices of the mesh.
    pub vertices: [u32; 3],
    /// Their weights.
    pub weights: [f64; 3],
}

/// The barycentric coordinates of the vertices' places in the surface (`coarse`) that the patch was made from: each vertex
/// walks from its hint to the nearest triangle. `ids` turns its corners into the mesh's numbers.
pub(super) fn parents(patch: &Patch, coarse: &Patch, ids: &[u32]) -> Vec<Parents> {
    (patch.fixed..patch.x.len())
        // What is stopped drops them.
        .take_while(|_| !is_stopped())
        .map(|v| {
            let (t, weights) = walk(coarse, patch.hint[v], &patch.source[v]);
            Parents {
                vertices: coarse.triangles[t as usize].map(|c| ids[c as usize]),
                weights,
            }
        })
        .collect()
}

/// Distances that differ by less are equal: relative, of their squares.
/// Half or double, of 44 cases: none changes.
const EQUAL: f64 = 1e-9;

/// From triangle to triangle as long as the point comes nearer; where the nearest place is a corner, through all triangles around
/// that are as near: the way on may begin behind them.
fn walk(coarse: &Patch, start: u32, p: &Vector3<f64>) -> (u32, [f64; 3]) {
    let (mut best, mut weights) = nearest(coarse, start, p);
    let mut found = start;
    let mut seen = vec![start];
    let mut next = 0;
    while next < seen.len() {
        let t = seen[next];
        next += 1;
        for k in 0..3 {
            let o = coarse.across(3 * t + k);
            if o == crate::mesh::NONE || seen.contains(&(o / 3)) {
                continue;
            }
            let (distance, w) = nearest(coarse, o / 3, p);
            if distance < best * (1.0 - EQUAL) {
                (best, weights, found) = (distance, w, o / 3);
                seen.clear();
                seen.push(found);
                next = 0;
                break;
            }
            if distance <= best * (1.0 + EQUAL) {
                seen.push(o / 3);
            }
        }
    }
    (found, weights)
}

/// Turns parents that are new vertices themselves into theirs: those from `first` on, of vertices behind the mesh's `old` ones, name only
/// what comes before them. Of more than three the heaviest are taken.
pub(crate) fn compose(parents: &mut [Parents], old: usize, first: usize) {
    for i in first..parents.len() {
        let mut sums: Vec<(u32, f64)> = Vec::new();
        let mut add = |v: u32, w: f64| match sums.iter_mut().find(|sum| sum.0 == v) {
            Some(sum) => sum.1 += w,
            None => sums.push((v, w)),
        };
        let own = parents[i];
        for (v, w) in own.vertices.into_iter().zip(own.weights) {
            match (v as usize).checked_sub(old).map(|new| parents[new]) {
                None => add(v, w),
                Some(of) => (0..3).for_each(|k| add(of.vertices[k], w * of.weights[k])),
            }
        }
        sums.sort_unstable_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        sums.truncate(3);
        let total: f64 = sums.iter().map(|sum| sum.1).sum();
        let at = |k: usize| sums.get(k).copied().unwrap_or((sums[0].0, 0.0));
        parents[i] = Parents {
            vertices: [0, 1, 2].map(|k| at(k).0),
            weights: [0, 1, 2].map(|k| at(k).1 / total),
        };
    }
}

/// [`nearest_on`] for a triangle of a patch.
fn nearest(patch: &Patch, t: u32, p: &Vector3<f64>) -> (f64, [f64; 3]) {
    nearest_on(&patch.triangles[t as usize].map(|v| patch.x[v as usize]), p)
}

/// Squared distance of a point to a triangle and the barycentric coordinates of the nearest point.
pub(crate) fn nearest_on(x: &[Vector3<f64>; 3], p: &Vector3<f64>) -> (f64, [f64; 3]) {
    let cross = (x[1] - x[0]).cross(&(x[2] - x[0]));
    let square = cross.norm_squared();
    let part = |k: usize| {
        let (a, b) = (x[(k + 1) % 3], x[(k + 2) % 3]);
        (b - a).cross(&(p - a)).dot(&cross) / square
    };
    let inside = [part(0), part(1), part(2)];
    if square > 0.0 && inside.iter().all(|&w| w >= 0.0) {
        let sum: f64 = inside.iter().sum();
        let distance = (p - x[0]).dot(&cross).powi(2) / square;
        return (distance, inside.map(|w| w / sum));
    }
    let mut best = (f64::INFINITY, [1.0, 0.0, 0.0]);
    for k in 0..3 {
        let (i, j) = (k, (k + 1) % 3);
        let e = x[j] - x[i];
        let s = (e.dot(&(p - x[i])) / e.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let distance = (x[i] + e * s - p).norm_squared();
        if distance < best.0 {
            let mut weights = [0.0; 3];
            weights[i] = 1.0 - s;
            weights[j] = s;
            best = (distance, weights);
        }
    }
    best
}
