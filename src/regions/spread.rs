//! Regions that spread from a triangle, and rings added to or taken from a region.

use super::neighbours::Neighbours;

/// What `is_in` and all that its `front` leads to, from one number to those `beside` it that `may_pass` accepts.
pub(super) fn flood<Beside: Iterator<Item = u32>>(
    mut is_in: Vec<bool>,
    mut front: Vec<u32>,
    beside: impl Fn(u32) -> Beside,
    may_pass: impl Fn(u32, u32) -> bool,
) -> Vec<bool> {
    front.iter().for_each(|&i| is_in[i as usize] = true);
    while let Some(i) = front.pop() {
        for other in beside(i) {
            if !is_in[other as usize] && may_pass(i, other) {
                is_in[other as usize] = true;
                front.push(other);
            }
        }
    }
    is_in
}

/// The triangles that hang together with one by edges whose two triangles `may_pass` accepts.
pub(super) fn connected(mesh: &Neighbours<'_>, from: u32, may_pass: impl Fn(u32, u32) -> bool) -> Vec<bool> {
    let none = vec![false; mesh.triangles.len()];
    flood(none, vec![from], |t| mesh.beside(t), may_pass)
}

/// The triangles around one up to edges at which the surface bends by more than `degrees`.
pub(super) fn patch(mesh: &Neighbours<'_>, from: u32, degrees: f64) -> Vec<bool> {
    let least = libm::cos(degrees.to_radians());
    // A triangle without area bends nowhere.
    let is_smooth = |a: u32, b: u32| {
        let [a, b] = [a, b].map(|t| mesh.normal(t));
        a.norm() * b.norm() == 0.0 || a.dot(&b) >= least
    };
    connected(mesh, from, is_smooth)
}

/// The triangles all of whose corners are in.
pub(super) fn whole(mesh: &Neighbours<'_>, is_in: impl Fn(u32) -> bool) -> Vec<bool> {
    let triangles = mesh.triangles.iter();
    triangles.map(|t| t.iter().all(|&v| is_in(v))).collect()
}

/// The region with all triangles that have a vertex in common with it, so often.
pub(super) fn grow(mesh: &Neighbours<'_>, mut region: Vec<bool>, rings: usize) -> Vec<bool> {
    for _ in 0..rings {
        let mut is_touched = vec![false; mesh.positions.len()];
        for (t, _) in mesh.triangles.iter().zip(&region).filter(|(_, is_in)| **is_in) {
            t.iter().for_each(|&v| is_touched[v as usize] = true);
        }
        let is_near = |t: &[u32; 3]| t.iter().any(|&v| is_touched[v as usize]);
        let grown: Vec<bool> = mesh.triangles.iter().map(is_near).collect();
        if grown == region {
            break;
        }
        region = grown;
    }
    region
}

/// The region without the triangles that have a vertex in common with the rest, so often.
pub(super) fn shrink(mesh: &Neighbours<'_>, region: Vec<bool>, rings: usize) -> Vec<bool> {
    not(grow(mesh, not(region), rings))
}

/// What is not in the region.
pub(super) fn not(mut region: Vec<bool>) -> Vec<bool> {
    region.iter_mut().for_each(|is_in| *is_in = !*is_in);
    region
}
