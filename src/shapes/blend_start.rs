//! The blend of three cylinders: a smooth start, and the refinement of a patch.
//!
//! The start lies on the level set of a soft minimum of the distances to the three half axes: `f = r` with
//! `f^-6 = d0^-6 + d1^-6 + d2^-6`. Far out on tube i it is the cylinder d_i = r.

use super::conjugate_gradients::conjugate_gradients;
use super::shape::Shape;
use std::collections::HashMap;

/// Radius of the three tubes of the cylinder blend.
pub const BLEND_RADIUS: f64 = 0.5;

/// Distance of the three fixed circles of the cylinder blend from the origin.
pub const BLEND_DISTANCE: f64 = 1.2;

/// Direction of tube t and the horizontal direction across it, counter-clockwise from it.
pub(super) fn tube_frame(t: usize) -> ([f64; 3], [f64; 3]) {
    // Not by cosines, so that the three frames are images of each other to the last bit.
    const SINE: f64 = 0.866_025_403_784_438_6;
    let (x, y) = [(1.0, 0.0), (-0.5, SINE), (-0.5, -SINE)][t % 3];
    ([x, y, 0.0], [-y, x, 0.0])
}

/// Moves a point onto the start surface along the gradient of the soft minimum.
pub(super) fn project(mut p: [f64; 3]) -> [f64; 3] {
    for _ in 0..6 {
        let (mut sum, mut gradient) = (0.0, [0.0; 3]);
        for t in 0..3 {
            let axis = tube_frame(t).0;
            let along = (p[0] * axis[0] + p[1] * axis[1]).max(0.0);
            let off: [f64; 3] = std::array::from_fn(|i| p[i] - along * axis[i]);
            let square = (off[0] * off[0] + off[1] * off[1] + off[2] * off[2]).max(1e-6);
            let term = square.powi(-3);
            sum += term;
            (0..3).for_each(|i| gradient[i] += term / square * off[i]);
        }
        // f = sum^(-1/6), grad f = f / sum * gradient
        let f = sum.powf(-1.0 / 6.0);
        let g = gradient.map(|x| f / sum * x);
        let slope = (g[0] * g[0] + g[1] * g[1] + g[2] * g[2]).max(1e-6);
        let step = ((BLEND_RADIUS - f) / slope).clamp(-0.5, 0.5);
        p = std::array::from_fn(|i| p[i] + step * g[i]);
        // Newton's method: what is left is of the order of the step squared.
        if step.abs() < 1e-9 {
            break;
        }
    }
    p
}

/// Neighbours of every vertex, flat.
pub(super) struct Neighbours {
    start: Vec<u32>,
    list: Vec<u32>,
}

impl Neighbours {
    pub(super) fn new(triangles: &[[u32; 3]], n: usize) -> Self {
        let mut edges: Vec<(u32, u32)> = Vec::with_capacity(6 * triangles.len());
        for &[a, b, c] in triangles {
            edges.extend([(a, b), (b, a), (b, c), (c, b), (c, a), (a, c)]);
        }
        edges.sort_unstable();
        edges.dedup();
        let mut start = vec![0u32; n + 1];
        edges.iter().for_each(|e| start[e.0 as usize + 1] += 1);
        (0..n).for_each(|v| start[v + 1] += start[v]);
        Neighbours {
            start,
            list: edges.into_iter().map(|e| e.1).collect(),
        }
    }

    pub(super) fn of(&self, v: usize) -> &[u32] {
        &self.list[self.start[v] as usize..self.start[v + 1] as usize]
    }

    pub(super) fn mean(&self, positions: &[[f64; 3]], v: usize) -> [f64; 3] {
        let of = self.of(v);
        let mut sum = [0.0; 3];
        for &w in of {
            (0..3).for_each(|i| sum[i] += positions[w as usize][i]);
        }
        sum.map(|x| x / of.len() as f64)
    }
}

/// Gives the free vertices positions: harmonic with uniform weights, projected to the start surface, then
/// evened out on it.
pub(super) fn relax(shape: &mut Shape) {
    let near = Neighbours::new(&shape.triangles, shape.positions.len());
    let free: Vec<usize> = shape.free_vertices().into_iter().map(|v| v as usize).collect();
    harmonic(shape, &near, &free);
    free.iter()
        .for_each(|&v| shape.positions[v] = project(shape.positions[v]));
    for _ in 0..60 {
        let moved: Vec<[f64; 3]> = free
            .iter()
            .map(|&v| project(near.mean(&shape.positions, v)))
            .collect();
        free.iter().zip(moved).for_each(|(&v, p)| shape.positions[v] = p);
    }
    shape.flattened = shape.positions.clone();
}

/// Puts every free vertex into the mean of its neighbours. The matrix, valence on the diagonal and -1 for
/// free neighbours, is positive definite because every free vertex is connected to a circle.
fn harmonic(shape: &mut Shape, near: &Neighbours, free: &[usize]) {
    let sum = |x: &[[f64; 3]], v: usize| near.mean(x, v).map(|m| m * near.of(v).len() as f64);
    let mut fixed = shape.positions.clone();
    free.iter().for_each(|&v| fixed[v] = [0.0; 3]);
    let mut right = vec![[0.0; 3]; fixed.len()];
    free.iter().for_each(|&v| right[v] = sum(&fixed, v));
    let apply = |x: &[[f64; 3]]| {
        let mut image = vec![[0.0; 3]; x.len()];
        for &v in free {
            let (valence, sum) = (near.of(v).len() as f64, sum(x, v));
            image[v] = std::array::from_fn(|a| valence * x[v][a] - sum[a]);
        }
        image
    };
    let solution = conjugate_gradients(apply, right);
    free.iter().for_each(|&v| shape.positions[v] = solution[v]);
}

/// Divides every triangle whose centre is `inside` into nine, keeping the mesh conforming: a neighbour with
/// one divided side becomes a fan of three, one with more is divided too. New vertices lie where `place` puts
/// the mean of the corners.
pub(super) fn trisect(
    shape: &mut Shape,
    place: impl Fn([f64; 3]) -> [f64; 3],
    inside: impl Fn([f64; 3]) -> bool,
) {
    let centre = |t: &[u32; 3]| -> [f64; 3] {
        std::array::from_fn(|i| t.iter().map(|&v| shape.positions[v as usize][i]).sum::<f64>() / 3.0)
    };
    let mut fine: Vec<bool> = shape.triangles.iter().map(|t| inside(centre(t))).collect();
    let mut cuts = cut_edges(&shape.triangles, &mut fine);
    let old = std::mem::take(&mut shape.triangles);
    // In the order of the triangles, so that the numbering does not depend on hashing.
    for t in &old {
        for k in 0..3 {
            let (a, b) = edge(t[k], t[(k + 1) % 3]);
            if let Some(cut) = cuts.get_mut(&(a, b)).filter(|cut| **cut == [0; 2]) {
                *cut =
                    [1.0, 2.0].map(|w| add_between(shape, &place, [a, a, b], [0.0, 1.0 - w / 3.0, w / 3.0]));
            }
        }
    }
    let third = |a: u32, b: u32| {
        let cut = cuts.get(&edge(a, b)).copied();
        cut.map(|c| if a < b { c } else { [c[1], c[0]] })
    };
    for (&[a, b, c], fine) in old.iter().zip(fine) {
        match (third(a, b), third(b, c), third(c, a)) {
            (Some(ab), Some(bc), Some(ca)) if fine => {
                let m = add_between(shape, &place, [a, b, c], [1.0 / 3.0; 3]);
                let around = [a, ab[0], ab[1], b, bc[0], bc[1], c, ca[0], ca[1]];
                nine(&mut shape.triangles, m, around);
            }
            (Some(cut), None, None) => fan(&mut shape.triangles, a, cut, b, c),
            (None, Some(cut), None) => fan(&mut shape.triangles, b, cut, c, a),
            (None, None, Some(cut)) => fan(&mut shape.triangles, c, cut, a, b),
            _ => shape.triangles.push([a, b, c]),
        }
    }
    shape.flattened = shape.positions.clone();
}

/// The edges that are cut: those of `fine` triangles, which those with two cuts become.
fn cut_edges(triangles: &[[u32; 3]], fine: &mut [bool]) -> HashMap<(u32, u32), [u32; 2]> {
    let edges = |t: &[u32; 3]| [edge(t[0], t[1]), edge(t[1], t[2]), edge(t[2], t[0])];
    let mut cuts = HashMap::new();
    loop {
        for (t, _) in triangles.iter().zip(&*fine).filter(|(_, fine)| **fine) {
            cuts.extend(edges(t).map(|e| (e, [0; 2])));
        }
        let mut grown = false;
        for (t, fine) in triangles.iter().zip(&mut *fine) {
            let is_cut = edges(t).iter().filter(|e| cuts.contains_key(*e)).count() >= 2;
            grown |= is_cut && !*fine;
            *fine |= is_cut;
        }
        if !grown {
            return cuts;
        }
    }
}

/// The nine triangles of one with the vertex `m` in its middle and these around it, a corner first.
fn nine(triangles: &mut Vec<[u32; 3]>, m: u32, around: [u32; 9]) {
    for k in 0..9 {
        let (v, w, before) = (around[k], around[(k + 1) % 9], around[(k + 8) % 9]);
        match k % 3 {
            // A corner is cut off by the edge between its neighbours.
            0 => triangles.extend([[v, w, before], [m, before, w]]),
            1 => triangles.push([m, v, w]),
            _ => {}
        }
    }
}

fn edge(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

fn fan(triangles: &mut Vec<[u32; 3]>, a: u32, cut: [u32; 2], b: u32, apex: u32) {
    triangles.extend([[a, cut[0], apex], [cut[0], cut[1], apex], [cut[1], b, apex]]);
}

/// A new free vertex where `place` puts a weighted mean.
fn add_between(
    shape: &mut Shape,
    place: impl Fn([f64; 3]) -> [f64; 3],
    of: [u32; 3],
    weight: [f64; 3],
) -> u32 {
    let p = of.map(|v| shape.positions[v as usize]);
    let mean = std::array::from_fn(|i| (0..3).map(|k| weight[k] * p[k][i]).sum());
    shape.positions.push(place(mean));
    shape.normals.push([0.0; 3]);
    shape.free.push(true);
    shape.positions.len() as u32 - 1
}
