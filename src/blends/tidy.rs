//! Vertices that cuts have left and nothing needs: short edges of rails, and what is inside flat faces.

use fairmesh_linear::interrupt::checkpoint;
use nalgebra::Vector3;

use super::cut::{Cut, LEAVES};
use super::surface::between;
use crate::mesh::NONE;
use crate::mesh::halfedge::previous;

/// Edges of rails shorter than this part of the length wanted are taken away.
/// Of 12 solids cut from each other, half: as sound, with 12 % more vertices; double: four have creases that stay sharp.
const SHORT: f64 = 0.6;
/// Faces that stay move by at most this, of the length wanted. Planes do not move.
/// Of 12 solids cut from each other, half or double: all are as sound, with as many vertices to 0.1 %.
const MOVES: f64 = 1e-2;
/// What counts as not at all.
/// Of 12 solids cut from each other, half or double: 11 are as sound, with as many vertices to 0.5 %; of the twelfth 24 and 21 of 24
/// creases are rounded in place of 22.
const STAYS: f64 = 1e-9;
/// Times that all edges are looked at.
/// Of 12 solids cut from each other, half: as sound, with 0.5 % more vertices; double: 10 do not change, none gets other creases.
const ROUNDS: usize = 4;
/// Edges turned for the sake of one short edge.
/// Of 12 solids cut from each other, half or double: 11 are as sound, with as many vertices to 0.2 %; of the twelfth 23 and 21 of 24
/// creases are rounded in place of 22.
const TURNS: usize = 12;
/// Triangles do not get thinner than this, height over length.
/// Of 12 solids cut from each other, half or double: as sound or sounder, with 0.5 % fewer and 2 % more vertices.
const SHARP: f64 = 0.02;
/// Edges beside triangles thinner than this are turned.
/// Of 12 solids cut from each other, half: as sound; double: one more is sound, with 0.8 % more vertices.
const FLIPPED: f64 = 1e-3;
/// What is thinner than this has no plane.
/// Of 12 solids cut from each other, half or double: as sound, 10 do not change.
const NEEDLE: f64 = 1e-5;
/// Triangles of faces turn from them by less than 20 degrees: the cosine.
/// Of 12 solids cut from each other, 10 degrees: as sound, 10 do not change; 40: none changes.
const TILTED: f64 = 0.94;
/// Those of bands turn by less than the angle whose cosine this is.
/// Of 12 solids cut from each other, 30 and 120 degrees: none changes.
const TURNED: f64 = 0.5;

/// Takes such vertices away, none of those given but where they are on rails.
pub(super) fn tidy(cut: &mut Cut<'_>) {
    let given = cut.given as u32;
    for _ in 0..ROUNDS {
        let is_changed = [flip(cut, given), shorten(cut), thin_faces(cut, given)];
        if !is_changed.contains(&true) {
            return;
        }
    }
}

/// Whether a triangle stays.
fn stays(cut: &Cut<'_>, t: u32) -> bool {
    !cut.is_band[t as usize]
}

/// Whether `h` is on a rail, seen from the face that stays.
fn is_rail(cut: &Cut<'_>, h: u32) -> bool {
    let o = cut.sheet.across(h);
    o != NONE && stays(cut, h / 3) && !stays(cut, o / 3)
}

/// Turns edges of faces towards Delaunay at needles that cuts have made. Whether there were any, as below.
fn flip(cut: &mut Cut<'_>, given: u32) -> bool {
    for round in 0..ROUNDS {
        let mut flips = 0;
        for h in 0..3 * cut.sheet.triangles.len() as u32 {
            checkpoint();
            let (t, o) = (h / 3, cut.sheet.across(h));
            let is_new = |t: u32| cut.sheet.triangles[t as usize].iter().any(|&v| v >= given);
            if cut.sheet.is_there(t)
                && o != NONE
                && o > h
                && is_new(t)
                && is_new(o / 3)
                && is_better_flipped(cut, h)
            {
                cut.sheet.flip(h);
                flips += 1;
            }
        }
        if flips == 0 {
            return round > 0;
        }
    }
    true
}

/// Whether an edge of a face can be turned, one of its triangles is a needle, and the other diagonal is Delaunay.
fn is_better_flipped(cut: &Cut<'_>, h: u32) -> bool {
    let (sheet, o) = (&cut.sheet, cut.sheet.across(h));
    let Some(wanted) = cut.wanted(sheet.origin(h)).filter(|_| stays(cut, h / 3)) else {
        return false;
    };
    let [a, b, c, d] = corners(cut, h);
    let is_needle = |t: u32, p: &Vector3<f64>| thinness(p, &[a, b], &sheet.cross(t, NONE, p)) < FLIPPED;
    let sum = between(&(a - c), &(b - c)) + between(&(a - d), &(b - d));
    (is_needle(h / 3, &c) || is_needle(o / 3, &d))
        && sum > std::f64::consts::PI + STAYS
        && can_turn(cut, h, MOVES * wanted)
}

/// The corners of the two triangles at an edge: its ends, then the other two.
fn corners(cut: &Cut<'_>, h: u32) -> [Vector3<f64>; 4] {
    let sheet = &cut.sheet;
    let o = sheet.across(h);
    [h, o, previous(h), previous(o)].map(|g| sheet.x[sheet.origin(g) as usize])
}

/// Whether an edge between faces that stay has another label on its other side.
fn is_between_labels(cut: &Cut<'_>, h: u32) -> bool {
    let [t, o] = [h, cut.sheet.across(h)].map(|g| g / 3);
    cut.sheet.across(h) != NONE && stays(cut, t) && stays(cut, o) && cut.label(t) != cut.label(o)
}

/// Whether lines between labels stay where they are if the origin of `h` moves to its target: none is there, or it goes straight on.
fn keeps_labels(cut: &Cut<'_>, h: u32) -> bool {
    if !cut.has_labels() {
        return true;
    }
    let sheet = &cut.sheet;
    let (mut ends, mut is_at_rail) = (Vec::new(), false);
    sheet.fan(h, |g| {
        is_at_rail |= !stays(cut, g / 3);
        if is_between_labels(cut, g) {
            ends.push(sheet.target(g));
        }
    });
    let (at, to) = (sheet.x[sheet.origin(h) as usize], sheet.target(h));
    match ends[..] {
        [] => true,
        [a, b] if !is_at_rail && (a == to || b == to) => {
            let [a, b] = [a, b].map(|v| sheet.x[v as usize] - at);
            a.cross(&b).norm() <= STAYS * (b - a).norm_squared() && a.dot(&b) < 0.0
        }
        _ => false,
    }
}

/// Takes short edges of rails and of the lines of mitres away.
fn shorten(cut: &mut Cut<'_>) -> bool {
    let mut is_changed = false;
    for h in 0..3 * cut.sheet.triangles.len() as u32 {
        checkpoint();
        if !cut.sheet.is_there(h / 3) || !is_rail(cut, h) && !cut.is_mitre(h) {
            continue;
        }
        let Some(wanted) = cut.wanted(cut.sheet.origin(h)) else {
            continue;
        };
        if cut.sheet.squared_length(h) > (SHORT * wanted).powi(2) {
            continue;
        }
        let mut ways = [h, cut.sheet.across(h)];
        for turned in 0..=TURNS {
            let by = ways.map(|g| moves(cut, g, NEEDLE));
            // Of two that move nothing always the first would be one edge that takes up all behind it.
            let is_second = match (by[0] - by[1]).abs() <= STAYS * wanted {
                true => beside(cut, ways[1]) < beside(cut, ways[0]),
                false => by[1] < by[0],
            };
            let k = usize::from(is_second);
            if by[k] <= MOVES * wanted {
                cut.sheet.collapse(ways[k]);
                is_changed = true;
                break;
            }
            if turned == TURNS {
                break;
            }
            let Some(h) = ways.iter().find_map(|&g| turn_away(cut, g, wanted)) else {
                break;
            };
            ways = [h, cut.sheet.across(h)];
            is_changed = true;
        }
    }
    is_changed
}

/// The squared length of the longest edge of a rail or of the line of a mitre that starts where `h` does, besides `h`.
fn beside(cut: &Cut<'_>, h: u32) -> f64 {
    let sheet = &cut.sheet;
    let mut longest = 0.0_f64;
    sheet.fan(h, |g| {
        let o = sheet.across(g);
        if g != h && (is_rail(cut, g) || o != NONE && is_rail(cut, o) || cut.is_mitre(g)) {
            longest = longest.max(sheet.squared_length(g));
        }
    });
    longest
}

/// Turns one edge that ends where `h` starts, so that fewer triangles are there: `h` as it is called then. None if none can be turned.
fn turn_away(cut: &mut Cut<'_>, h: u32, wanted: f64) -> Option<u32> {
    let [a, b] = [cut.sheet.origin(h), cut.sheet.target(h)];
    let mut found = None;
    cut.sheet.fan(h, |g| {
        if g != h && found.is_none() && can_turn(cut, g, LEAVES * wanted) {
            found = Some(g);
        }
    });
    let g = found?;
    let beside = [g / 3, cut.sheet.across(g) / 3];
    if !cut.sheet.flip(g) {
        return None;
    }
    let around = beside.into_iter().flat_map(|t| 3 * t..3 * t + 3);
    let first = { around }.find(|&g| cut.sheet.origin(g) == a)?;
    let mut same = None;
    cut.sheet.fan(first, |g| {
        if cut.sheet.target(g) == b {
            same = Some(g);
        }
    });
    same
}

/// Whether the two triangles at an edge lie in one plane, at most so far off it, inside one band or outside of it, and are a convex quadrangle.
fn can_turn(cut: &Cut<'_>, h: u32, most: f64) -> bool {
    let o = cut.sheet.across(h);
    if o == NONE
        || stays(cut, h / 3) != stays(cut, o / 3)
        || cut.face(h / 3) != cut.face(o / 3)
        || is_between_labels(cut, h)
        || cut.is_mitre(h)
    {
        return false;
    }
    let [a, b, c, d] = corners(cut, h);
    let cross = |p: Vector3<f64>, q: Vector3<f64>, r: Vector3<f64>| (q - p).cross(&(r - p));
    let normal = cross(a, b, c) + cross(b, a, d);
    let size = normal.norm();
    let off = (c - a).dot(&normal).abs().max((d - a).dot(&normal).abs());
    let long = (d - c).norm_squared();
    let is_right = |s: Vector3<f64>| s.dot(&normal) > TILTED * s.norm() * size && s.norm() > NEEDLE * long;
    off <= most * size && is_right(cross(c, a, d)) && is_right(cross(d, b, c))
}

/// Whether the line of a mitre stays where it is if the origin of `h` moves to its target: a vertex within it may move along it.
fn keeps_mitre(cut: &Cut<'_>, h: u32) -> bool {
    let v = cut.sheet.origin(h);
    let is_within = cut.value[v as usize] < 0.0 && v as usize >= cut.given;
    !cut.is_on_mitre(v) || is_within && cut.is_mitre(h)
}

/// How far the faces that stay would move if the origin of `h` moved to its target; infinity: that cannot be.
fn moves(cut: &Cut<'_>, h: u32, least: f64) -> f64 {
    let sheet = &cut.sheet;
    if !sheet.can_collapse(h) || !keeps_labels(cut, h) || !keeps_mitre(cut, h) {
        return f64::INFINITY;
    }
    let (a, b) = (sheet.origin(h), sheet.target(h));
    let (from, to) = (sheet.x[a as usize], sheet.x[b as usize]);
    let mut moves = 0.0_f64;
    let mut rails = 0;
    // The normals of the pieces of faces around.
    let mut pieces: Vec<(u32, bool, Vector3<f64>)> = Vec::new();
    sheet.fan(h, |g| {
        let piece = (cut.face(g / 3), stays(cut, g / 3), sheet.cross(g / 3, a, &from));
        match pieces.iter_mut().find(|of| (of.0, of.1) == (piece.0, piece.1)) {
            Some(of) => of.2 += piece.2,
            None => pieces.push(piece),
        }
    });
    sheet.fan(h, |g| {
        let t = g / 3;
        rails += usize::from(is_rail(cut, g));
        if sheet.triangles[t as usize].contains(&b) {
            return;
        }
        let (face, is_kept) = (cut.face(t), stays(cut, t));
        let is_free = |v: u32| cut.value[v as usize] < 0.0;
        if !is_kept
            && ![b, sheet.target(g), sheet.origin(previous(g))]
                .into_iter()
                .any(is_free)
        {
            moves = f64::INFINITY;
        }
        let [before, after] = [from, to].map(|x| sheet.cross(t, a, &x));
        let of_piece = pieces.iter().find(|of| (of.0, of.1) == (face, is_kept));
        let turned = if is_kept { TILTED } else { TURNED };
        if of_piece.is_none_or(|of| of.2.dot(&after) <= turned * of.2.norm() * after.norm()) {
            moves = f64::INFINITY;
        }
        let ends = [sheet.target(g), sheet.origin(previous(g))].map(|v| sheet.x[v as usize]);
        let [thin, thinner] = [(from, before), (to, after)].map(|(at, cross)| thinness(&at, &ends, &cross));
        if thinner < least && thinner < thin {
            moves = f64::INFINITY;
        }
        // A needle has no plane.
        if is_kept && thin > NEEDLE {
            moves = moves.max((to - from).dot(&before).abs() / before.norm());
        }
    });
    // Where two rails meet neither moves.
    if rails > 1 { f64::INFINITY } else { moves }
}

/// Height over length of a triangle with this cross product.
fn thinness(at: &Vector3<f64>, ends: &[Vector3<f64>; 2], cross: &Vector3<f64>) -> f64 {
    let sides = [ends[0] - at, ends[1] - at, ends[1] - ends[0]];
    let longest = sides
        .iter()
        .map(Vector3::norm_squared)
        .fold(f64::MIN_POSITIVE, f64::max);
    cross.norm() / longest
}

/// Takes away vertices inside faces that were put there for the cuts.
fn thin_faces(cut: &mut Cut<'_>, given: u32) -> bool {
    let mut is_changed = false;
    for h in 0..3 * cut.sheet.triangles.len() as u32 {
        checkpoint();
        if !cut.sheet.is_there(h / 3) || cut.sheet.origin(h) < given {
            continue;
        }
        let mut is_inside = true;
        let is_closed = cut.sheet.fan(h, |g| is_inside &= stays(cut, g / 3));
        if !is_inside || !is_closed {
            continue;
        }
        let length = cut.sheet.squared_length(h).sqrt();
        if moves(cut, h, SHARP) <= STAYS * length {
            cut.sheet.collapse(h);
            is_changed = true;
        }
    }
    is_changed
}
