//! Creases that fade and come back: where one ends and goes on as a weaker bend to another one, or to itself, that is part of it.

use super::surface::Surface;
use crate::mesh::rows::Rows;

/// What goes on bends by at least this part of what makes a crease. Half, of 25 solids cut from each other: all are as sound, and 8 edges of blends bend by
/// more than 30 degrees in place of 61.
const WEAKER: f64 = 0.6;
/// A crease turns by less than this (the cosine) from edge to edge; where it turns more is a corner.
/// Half: of 13 solids cut from each other none changes.
pub(super) const TURN: f64 = 0.7;

/// Adds the edges between such ends to the creases; per half-edge, as are the bends, in degrees.
pub(super) fn connect(surface: &Surface<'_>, bends: &[f64], least: f64, is_crease: &mut [bool]) {
    let creases = (0..surface.half_edges()).filter(|&h| is_crease[h as usize]);
    let from = Rows::collect(surface.x.len(), creases.map(|h| (surface.origin(h), h)));
    let count = |v: u32| from.row(v as usize).len();
    let mut found = Vec::new();
    for v in (0..surface.x.len() as u32).filter(|&v| count(v) == 1) {
        let Some(mut h) = surface.across(from.row(v as usize)[0]) else {
            continue;
        };
        let mut path = Vec::new();
        while let Some(next) = weaker(surface, bends, WEAKER * least, h) {
            if path.len() > surface.x.len() {
                break;
            }
            path.push(next);
            h = next;
            if count(surface.target(h)) > 0 {
                found.append(&mut path);
                break;
            }
        }
    }
    for h in found {
        is_crease[h as usize] = true;
        surface
            .across(h)
            .into_iter()
            .for_each(|o| is_crease[o as usize] = true);
    }
}

/// The edge that goes on where `h` ends: of those that bend so much, to the same side, the one that bends most.
fn weaker(surface: &Surface<'_>, bends: &[f64], least: f64, h: u32) -> Option<u32> {
    let around = surface.links.outgoing.row(surface.target(h) as usize);
    let goes_on = |g: &u32| {
        let [e, f] = [h, *g].map(|g| surface.edge(g));
        let is_like = bends[*g as usize] * bends[h as usize] > 0.0 && bends[*g as usize].abs() > least;
        is_like && e.dot(&f) > TURN * e.norm() * f.norm()
    };
    let bend = |g: &u32| bends[*g as usize].abs();
    let all = around.iter().copied().filter(goes_on);
    all.max_by(|g, h| bend(g).total_cmp(&bend(h)))
}
