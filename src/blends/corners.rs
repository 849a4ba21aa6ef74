//! Corners of faces, where two creases meet: rails go around them smoothly.

use super::crease_graph::CreaseGraph;
use super::level::Corner;
use super::surface::Surface;
use crate::mesh::NONE;
use crate::mesh::halfedge::previous;

/// How far from the crossing of two rails at a right angle they leave their lines, in widths. Half or double, of 25 solids cut from each other: all are
/// as sound, with 3 % more triangles at half.
const RADIUS: f64 = 0.5;
/// Below this radius, in widths, a corner is none. Of 25 solids cut from each other, half: one has a crease that stays sharp; double: nothing changes.
const LEAST: f64 = 0.1;

/// The corners of all faces at which bands meet, and per side of a chain the angles of its face at the chain's beginning and end: half a turn where no
/// other band begins. A rail leaves the lines that it has along the creases where they would come near each other: the more pointed the corner,
/// the earlier. At corners that are mitred (ascending) they cross.
pub(super) fn corners(
    surface: &Surface<'_>,
    graph: &CreaseGraph,
    mitred: &[u32],
) -> (Vec<Corner>, Vec<[f64; 2]>) {
    let side = sides(surface, graph);
    let mut corners = Vec::new();
    let mut angles = vec![[std::f64::consts::PI; 2]; 2 * graph.chains.len()];
    let all = 0..surface.half_edges();
    for h in all.filter(|&h| side[h as usize] != NONE && !graph.is_sharp(surface.origin(h))) {
        let Some((other, angle)) = next_crease(surface, &|h| side[h as usize] != NONE, h) else {
            continue;
        };
        let [a, b] = [side[h as usize], side[other as usize]];
        let is_end = |side: u32, h: u32| {
            let all = &graph.chains[side as usize / 2].half_edges;
            [all[0], all[all.len() - 1]].map(|e| e == h || surface.across(e) == Some(h))
        };
        // `h` begins at the corner, `other` ends there; along the right side of a chain both run against it.
        if a != b
            && is_end(a, h)[a as usize % 2]
            && is_end(b, other)[1 - b as usize % 2]
            && !graph.chains[a as usize / 2].is_closed
        {
            angles[a as usize][a as usize % 2] = angle;
            angles[b as usize][1 - b as usize % 2] = angle;
        }
        let radius = RADIUS * 2.0_f64.sqrt() * libm::cos(0.5 * angle.min(std::f64::consts::PI));
        let is_mitre = mitred.binary_search(&surface.origin(h)).is_ok();
        if a != b && radius > LEAST && !is_mitre {
            corners.push(Corner {
                sides: [a.min(b), a.max(b)],
                radius,
            });
        }
    }
    corners.sort_by_key(|corner| corner.sides);
    corners.dedup_by_key(|corner| corner.sides);
    (corners, angles)
}

/// Per half-edge along a crease that is rounded the side of a chain that it belongs to.
fn sides(surface: &Surface<'_>, graph: &CreaseGraph) -> Vec<u32> {
    let mut side = vec![NONE; surface.half_edges() as usize];
    let all = (0..).zip(&graph.chains);
    for (number, chain) in all.filter(|(_, chain)| chain.is_chosen) {
        for &h in &chain.half_edges {
            side[h as usize] = 2 * number;
            let across = surface.across(h).into_iter();
            across.for_each(|o| side[o as usize] = 2 * number + 1);
        }
    }
    side
}

/// From a crease over the face on its left to the next one that arrives at its first vertex, and the angle between them.
pub(super) fn next_crease(
    surface: &Surface<'_>,
    is_crease: &dyn Fn(u32) -> bool,
    h: u32,
) -> Option<(u32, f64)> {
    let (mut g, mut angle) = (h, 0.0);
    loop {
        angle += surface.angle(g);
        let arrives = previous(g);
        if is_crease(arrives) {
            return Some((arrives, angle));
        }
        g = surface.across(arrives).filter(|&g| g != h)?;
    }
}
