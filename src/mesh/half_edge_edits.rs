//! Edits of triangles and of what lies across their half-edges: half-edge `3 t + k` runs from corner `k` of triangle `t` to the next one.

use super::halfedge::{NONE, next, previous};

/// Two half-edges lie across from each other; [`NONE`]: nothing does.
pub(crate) fn link(opposite: &mut [u32], g: u32, h: u32) {
    if g != NONE {
        opposite[g as usize] = h;
    }
    if h != NONE {
        opposite[h as usize] = g;
    }
}

/// Turns an edge with two triangles to their other two corners.
pub(crate) fn flip(triangles: &mut [[u32; 3]], opposite: &mut [u32], h: u32) {
    let o = opposite[h as usize];
    let corner = |h: u32| triangles[h as usize / 3][h as usize % 3];
    let [a, b, c, d] = [h, o, previous(h), previous(o)].map(corner);
    let [bc, ca, ad, db] = [next(h), previous(h), next(o), previous(o)].map(|g| opposite[g as usize]);
    let (t, u) = (h / 3, o / 3);
    triangles[t as usize] = [c, a, d];
    triangles[u as usize] = [d, b, c];
    link(opposite, 3 * t, ca);
    link(opposite, 3 * t + 1, ad);
    link(opposite, 3 * t + 2, 3 * u + 2);
    link(opposite, 3 * u, db);
    link(opposite, 3 * u + 1, bc);
}

/// Moves the vertex that `h` and the other `outgoing` half-edges start at onto the one where `h` ends; both triangles at `h` are gone then. What lay across
/// the other sides of these: behind `h`, before it, and the same of the half-edge across.
pub(crate) fn collapse(
    triangles: &mut [[u32; 3]],
    opposite: &mut [u32],
    h: u32,
    outgoing: &[u32],
) -> [u32; 4] {
    let (b, o) = (
        triangles[h as usize / 3][next(h) as usize % 3],
        opposite[h as usize],
    );
    let across @ [bc, ca, ad, db] =
        [next(h), previous(h), next(o), previous(o)].map(|g| opposite[g as usize]);
    for &g in outgoing {
        triangles[g as usize / 3][g as usize % 3] = b;
    }
    for t in [h / 3, o / 3] {
        triangles[t as usize] = [NONE; 3];
        (0..3).for_each(|k| opposite[(3 * t + k) as usize] = NONE);
    }
    link(opposite, bc, ca);
    link(opposite, ad, db);
    across
}
