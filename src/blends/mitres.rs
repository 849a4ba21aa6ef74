//! Where two creases that are rounded meet a third one that is not: it goes on between their blends, as the edge of a mitre, to where their rails cross.

use nalgebra::Vector3;

use super::chain_curve::ChainCurve;
use super::crease_graph::CreaseGraph;
use super::cut::{Cut, ON};
use super::ends::SHARE;
use super::legs::{Sense, Way, outgoing};
use super::level::{Entry, Side};
use super::meetings::{End, Meeting, meetings};
use super::surface::Surface;
use super::widths::SLOPE;
use crate::mesh::halfedge::{next, previous};

/// A third crease that goes almost along one that is rounded is none: the sine. Half or double: of 25 convex solids with one face rounded one more converges loosely.
const LEAST: f64 = 0.1;

/// A corner of three creases, two of which are rounded and bend the same way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mitre {
    pub(super) vertex: u32,
    /// The ends of both that are rounded, first that on the right of the third one, seen from the corner.
    pub(super) ends: [End; 2],
    /// Their sides on the face between them.
    sides: [u32; 2],
    face: u32,
    /// Whether the third one bends the other way: the face between the two turns by more than half a turn, as a floor around the foot of a block.
    is_around: bool,
    /// How long the third one is.
    length: f64,
    /// Where they go from the corner, unit length.
    along: [Vector3<f64>; 2],
    /// The cosines and the sines of the angles between them and the third one.
    angles: [[f64; 2]; 2],
    /// The face on the left of the third one, seen from the corner.
    left: u32,
}

impl Mitre {
    /// Along the third crease, and between both bands.
    pub(super) fn ways(&self) -> [Way; 2] {
        [
            Way::Crease(self.left, Sense::Away),
            Way::Mitre(self.face, self.along),
        ]
    }

    /// Lets both rails on the faces beside the third crease arrive at one place of it, the nearer one, as far as it reaches.
    pub(super) fn taper(&self, curves: &[ChainCurve], sides: &mut [Side]) {
        let widths = self.widths(sides);
        let reach = (widths[0] / self.angles[0][1])
            .min(widths[1] / self.angles[1][1])
            .min(SHARE * self.length);
        for (k, End { chain, end }) in self.ends.into_iter().enumerate() {
            // The other side of the same chain.
            let side = &mut sides[self.sides[k] as usize ^ 1];
            for (i, width) in side.widths.iter_mut().enumerate() {
                // The place on the third crease is across from a point of this one.
                let [foot, across] = self.angles[k].map(|part| (part * reach).max(0.0));
                let behind = (curves[chain].to_ends(i)[end] - foot).max(0.0);
                *width = width.min(across + SLOPE * behind);
            }
        }
    }
}

impl Mitre {
    /// Those of both bands at the corner.
    fn widths(&self, sides: &[Side]) -> [f64; 2] {
        self.ends.map(|end| {
            let all = &sides[2 * end.chain].widths;
            [all[0], all[all.len() - 1]][end.end]
        })
    }

    /// On a face that goes around the corner a place beyond both ends is in neither band, unless it is near both.
    pub(super) fn join(&self, sides: &mut [Side]) {
        for k in [0, 1].into_iter().filter(|_| self.is_around) {
            sides[self.sides[k] as usize].with[self.ends[k].end] = Some(self.sides[1 - k]);
        }
    }

    /// On such a face the straight line from the corner to where rails cross, as a function that is zero there: places beyond one end are as near to that
    /// band as to the other elsewhere, too.
    fn line(&self, cut: &Cut<'_>) -> Option<Line> {
        let [first, second] = self.widths(&cut.level.sides);
        let to = self.along[0] * second + self.along[1] * first;
        let across = self.along[0].cross(&self.along[1]).cross(&to);
        self.is_around.then(|| Line {
            from: cut.sheet.x[self.vertex as usize],
            across: across.try_normalize(0.0).unwrap_or_default(),
        })
    }
}

/// A line in a plane.
struct Line {
    from: Vector3<f64>,
    /// Unit length.
    across: Vector3<f64>,
}

/// All such corners.
pub(super) fn mitres(surface: &Surface<'_>, graph: &CreaseGraph) -> Vec<Mitre> {
    let all = meetings(surface, graph).into_iter();
    all.filter_map(|at| mitre(surface, graph, &at)).collect()
}

fn mitre(surface: &Surface<'_>, graph: &CreaseGraph, at: &Meeting) -> Option<Mitre> {
    let ([first, second], [third]) = (&at.rounded[..], &at.others[..]) else {
        return None;
    };
    let is_inside = surface.boundary_edges(at.vertex) == 0;
    if !is_inside || !Meeting::are_alike(graph, [first, second]) {
        return None;
    }
    let h = third.leaves(surface, graph)?;
    let beside = [h, surface.across(h)?].map(|g| graph.faces[g as usize / 3]);
    // The first one is that on the right of the third, seen from the corner: on the left of the way to it.
    let is_right = |end: &End| graph.beside(end.chain(graph), surface).contains(&beside[1]);
    let ends = if is_right(first) {
        [*first, *second]
    } else {
        [*second, *first]
    };
    let faces = ends.map(|end| graph.beside(end.chain(graph), surface));
    let face = faces[0]
        .into_iter()
        .find(|face| faces[1].contains(face) && !beside.contains(face))?;
    let side = |k: usize| 2 * ends[k].chain as u32 + u32::from(faces[k][0] != face);
    let away = surface.edge(h);
    let along = |end: End| surface.edge(end.leaves(surface, graph)?).try_normalize(0.0);
    let along = [along(ends[0])?, along(ends[1])?];
    let angles =
        along.map(|along| [along.dot(&away), along.cross(&away).norm()].map(|part| part / away.norm()));
    let is_three = angles.iter().all(|[_, sine]| *sine > LEAST)
        && beside[0] != beside[1]
        && faces.iter().all(|of| of[0] != of[1]);
    is_three.then(|| Mitre {
        vertex: at.vertex,
        ends,
        sides: [side(0), side(1)],
        face,
        is_around: !Meeting::are_alike(graph, [first, third]),
        length: third.chain(graph).length(surface),
        along,
        angles,
        left: beside[0],
    })
}

/// Cuts along the lines that are as far inside one band as inside the other, from the corners to where rails cross. Where that cannot be done the rest
/// of the cut stays as it is.
pub(super) fn trace(cut: &mut Cut<'_>, mitres: &[Mitre]) {
    let mut left: Vec<&Mitre> = mitres.iter().collect();
    while !left.is_empty() {
        let outgoing = outgoing(cut, left.iter().map(|of| of.vertex));
        left.retain(|of| match outgoing.get(&of.vertex) {
            // Another one has taken its number.
            Some(&g) if cut.sheet.origin(g) != of.vertex => true,
            Some(&g) => {
                trace_one(cut, of, g);
                false
            }
            None => false,
        });
    }
}

fn trace_one(cut: &mut Cut<'_>, of: &Mitre, first: u32) {
    let line = of.line(cut);
    let mut at = Some(first);
    while let Some(g) = at {
        let v = cut.sheet.origin(g);
        cut.set_on_mitre(v);
        let is_inside = cut.value[v as usize] < 0.0;
        at = is_inside.then(|| step(cut, of, line.as_ref(), g)).flatten();
    }
}

/// A half-edge that starts at the next vertex of the line after that where `g` starts.
fn step(cut: &mut Cut<'_>, of: &Mitre, line: Option<&Line>, g: u32) -> Option<u32> {
    let v = cut.sheet.origin(g);
    let mut around = Vec::new();
    cut.sheet.fan(g, |g| around.push(g));
    around.retain(|&g| cut.face(g / 3) == of.face);
    let on_line = around.iter().flat_map(|&g| [next(g), previous(g)]);
    if let Some(h) =
        { on_line }.find(|&h| is_on_line(cut, of, line, h) && is_ahead(cut, v, cut.sheet.origin(h)))
    {
        return reached(cut, h, v);
    }
    for h in around.into_iter().map(next) {
        let ends = [cut.sheet.origin(h), cut.sheet.target(h)];
        if let [Some(a), Some(b)] = ends.map(|w| difference(cut, of, line, w))
            && a * b < 0.0
            && ![h, next(h)].into_iter().any(|g| is_on_line(cut, of, line, g))
        {
            let m = match line {
                Some(_) => cut.put_at(h, a / (a - b)),
                None => cut.put_where(h, [a, b], |entries| excess(of, entries).unwrap_or(0.0)),
            };
            if is_ahead(cut, v, cut.sheet.origin(m)) {
                return reached(cut, m, v);
            }
        }
    }
    None
}

/// How far a vertex is from the line, to one side of it.
fn difference(cut: &Cut<'_>, of: &Mitre, line: Option<&Line>, v: u32) -> Option<f64> {
    match line {
        Some(line) => Some((cut.sheet.x[v as usize] - line.from).dot(&line.across)),
        None => excess(of, &cut.near[v as usize]),
    }
}

/// By how much a place is farther outside of one band than of the other.
fn excess(of: &Mitre, near: &[Entry]) -> Option<f64> {
    let excess = |side: u32| near.iter().find(|e| e.side == side).map(|e| e.excess);
    Some(excess(of.sides[0])? - excess(of.sides[1])?)
}

/// Whether the vertex where `h` starts is on the line.
fn is_on_line(cut: &Cut<'_>, of: &Mitre, line: Option<&Line>, h: u32) -> bool {
    let v = cut.sheet.origin(h);
    let wanted = cut.wanted(v).unwrap_or(0.0);
    difference(cut, of, line, v).is_some_and(|d| d.abs() <= ON * wanted)
}

/// Whether `w` is nearer to the rails than `v`.
fn is_ahead(cut: &Cut<'_>, v: u32, w: u32) -> bool {
    cut.value[w as usize] > cut.value[v as usize]
}

/// The line has reached the vertex where `h` starts, or where rails cross before it on its way from `v`: a half-edge that starts there.
fn reached(cut: &mut Cut<'_>, h: u32, v: u32) -> Option<u32> {
    let w = cut.sheet.origin(h);
    let wanted = cut.wanted(w).unwrap_or(0.0);
    if cut.value[w as usize].abs() <= ON * wanted {
        cut.value[w as usize] = 0.0;
    }
    if cut.value[w as usize] <= 0.0 {
        return Some(h);
    }
    let mut back = None;
    cut.sheet.fan(h, |g| {
        if cut.sheet.target(g) == v {
            back = Some(g);
        }
    });
    let back = back?;
    cut.cross(back);
    Some(next(back))
}
