//! Vertices that cuts have left and nothing needs: short edges of rails, and what is inside flat faces.

use super::cut::Cut;
use crate::mesh::NONE;
use crate::mesh::halfedge::next;

/// Edges of rails shorter than this part of the length wanted are taken away.
const SHORT: f64 = 0.6;
/// Faces that stay move by at most this, of the length wanted. Planes do not move.
const MOVES: f64 = 2e-3;
/// What counts as not at all.
const STAYS: f64 = 1e-9;
/// Times that all edges are looked at.
const ROUNDS: usize = 4;
/// The smallest angle (its sine) that a triangle of a face may get.
const SHARP: f64 = 0.02;

/// Takes such vertices away, none of the first `given` but where they are on rails.
pub(super) fn tidy(cut: &mut Cut<'_>, given: usize) {
    for _ in 0..ROUNDS {
        shorten_rails(cut);
    }
    for _ in 0..ROUNDS {
        thin_faces(cut, given as u32);
    }
}

/// Whether a triangle stays.
fn stays(cut: &Cut<'_>, t: u32) -> bool {
    cut.sheet.triangles[t as usize]
        .iter()
        .all(|&v| cut.value[v as usize] >= 0.0)
}

/// Whether `h` is on a rail, seen from the face that stays.
fn is_rail(cut: &Cut<'_>, h: u32) -> bool {
    let o = cut.sheet.across(h);
    o != NONE && stays(cut, h / 3) && !stays(cut, o / 3)
}

fn shorten_rails(cut: &mut Cut<'_>) {
    for h in 0..3 * cut.sheet.triangles.len() as u32 {
        if !cut.sheet.is_there(h / 3) || !is_rail(cut, h) {
            continue;
        }
        let Some(wanted) = cut.wanted(cut.sheet.origin(h)) else {
            continue;
        };
        if cut.sheet.squared_length(h) > (SHORT * wanted).powi(2) {
            continue;
        }
        let o = cut.sheet.across(h);
        let ways = [h, o].map(|g| (moves(cut, g), g));
        let way = if ways[0].0 <= ways[1].0 { ways[0] } else { ways[1] };
        if way.0 <= MOVES * wanted {
            cut.sheet.collapse(way.1);
        }
    }
}

/// How far the faces that stay would move if the origin of `h` moved to its target; infinity: that cannot be.
fn moves(cut: &Cut<'_>, h: u32) -> f64 {
    let sheet = &cut.sheet;
    if !sheet.can_collapse(h) {
        return f64::INFINITY;
    }
    let (a, b) = (sheet.origin(h), sheet.target(h));
    let (from, to) = (sheet.x[a as usize], sheet.x[b as usize]);
    let mut moves = 0.0_f64;
    let mut rails = 0;
    sheet.fan(h, |g| {
        let t = g / 3;
        rails += usize::from(is_rail(cut, g));
        if sheet.triangles[t as usize].contains(&b) {
            return;
        }
        let [before, after] = [from, to].map(|x| sheet.cross(t, a, &x));
        if before.dot(&after) <= 0.5 * before.norm() * after.norm() {
            moves = f64::INFINITY;
        } else if stays(cut, t) {
            let normal = before.normalize();
            moves = moves.max((to - from).dot(&normal).abs());
            let longest = |at: &nalgebra::Vector3<f64>| {
                let [p, q] = [
                    sheet.x[sheet.target(g) as usize],
                    sheet.x[sheet.target(next(g)) as usize],
                ];
                (p - at)
                    .norm_squared()
                    .max((q - at).norm_squared())
                    .max((p - q).norm_squared())
            };
            if after.norm() < SHARP * longest(&to)
                && after.norm() * longest(&from) < before.norm() * longest(&to)
            {
                moves = f64::INFINITY;
            }
        }
    });
    // Where two rails meet neither moves.
    if rails > 1 { f64::INFINITY } else { moves }
}

/// Takes away vertices inside faces that were put there for the cuts.
fn thin_faces(cut: &mut Cut<'_>, given: u32) {
    for h in 0..3 * cut.sheet.triangles.len() as u32 {
        if !cut.sheet.is_there(h / 3) || cut.sheet.origin(h) < given {
            continue;
        }
        let mut is_inside = true;
        let is_closed = cut.sheet.fan(h, |g| is_inside &= stays(cut, g / 3));
        if !is_inside || !is_closed {
            continue;
        }
        let length = cut.sheet.squared_length(h).sqrt();
        if moves(cut, h) <= STAYS * length {
            cut.sheet.collapse(h);
        }
    }
}
