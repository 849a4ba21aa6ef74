//! What bounds the face across from a crease's end, or the surface there, from that corner to the rails.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector3;

use super::cut::Cut;
use super::through::Through;
use crate::mesh::NONE;
use crate::mesh::halfedge::{next, previous};

/// What is left of the two creases inside the band is divided into edges as short as those of the band: they are to be the arc's.
pub(super) fn divide(cut: &mut Cut<'_>, through: &[Through]) {
    loop {
        let outgoing = outgoing(cut, through);
        let ways = through
            .iter()
            .flat_map(|of| [Sense::Away, Sense::Towards].map(|sense| (of, sense)));
        let steps: Vec<u32> = ways
            .flat_map(|(of, sense)| steps(cut, of, sense, &outgoing))
            .collect();
        let ends = |cut: &Cut<'_>, h: u32| [cut.sheet.origin(h), cut.sheet.target(h)];
        let is_long = |h: &u32| {
            let wanted = ends(cut, *h).map(|v| cut.wanted(v).unwrap_or(f64::INFINITY));
            cut.sheet.squared_length(*h).sqrt() > wanted[0].min(wanted[1])
        };
        let long: Vec<(u32, [u32; 2])> = steps
            .into_iter()
            .filter(is_long)
            .map(|h| (h, ends(cut, h)))
            .collect();
        if long.is_empty() {
            return;
        }
        for (h, known) in long {
            // Another one at the same corner may have taken its number.
            if ends(cut, h) == known {
                cut.halve(h);
            }
        }
    }
}

/// A half-edge from each of the corners.
pub(super) fn outgoing(cut: &Cut<'_>, through: &[Through]) -> BTreeMap<u32, u32> {
    let sheet = &cut.sheet;
    let all = (0..3 * sheet.triangles.len() as u32).filter(|h| sheet.is_there(h / 3));
    match through.is_empty() {
        true => BTreeMap::new(),
        false => {
            let corners: BTreeSet<u32> = through.iter().map(|of| of.vertex).collect();
            all.map(|h| (sheet.origin(h), h))
                .filter(|(v, _)| corners.contains(v))
                .collect()
        }
    }
}

/// Whether the face across is on the left of the way from the corner, or on the right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sense {
    Away,
    Towards,
}

impl Sense {
    /// The vertices of a half-edge of that face, on the way from the corner.
    pub(super) fn ends(self, cut: &Cut<'_>, h: u32) -> [u32; 2] {
        let [a, b] = [cut.sheet.origin(h), cut.sheet.target(h)];
        match self {
            Self::Away => [a, b],
            Self::Towards => [b, a],
        }
    }
}

/// From a crease's end to a rail.
pub(super) struct Leg {
    /// Its half-edges, and the next one.
    pub(super) steps: Vec<u32>,
    /// Its vertices, their places and how far along it they are.
    pub(super) vertices: Vec<(u32, Vector3<f64>, f64)>,
    /// The face of the blend there, and that across; at the boundary the same one.
    pub(super) faces: [u32; 2],
}

impl Leg {
    /// None where it does not end on a rail.
    pub(super) fn new(
        cut: &Cut<'_>,
        of: &Through,
        sense: Sense,
        outgoing: &BTreeMap<u32, u32>,
    ) -> Option<Self> {
        let steps = steps(cut, of, sense, outgoing);
        let last = *steps.last()?;
        let at = |v: u32| cut.sheet.x[v as usize];
        let mut along = 0.0;
        let vertex = |&h: &u32| {
            let [v, on] = sense.ends(cut, h);
            let vertex = (v, at(v), along);
            along += (at(on) - at(v)).norm();
            vertex
        };
        let beside = match cut.sheet.across(last) {
            NONE => last,
            across => across,
        };
        let leg = Self {
            vertices: steps.iter().map(vertex).collect(),
            faces: [beside, last].map(|h| cut.face(h / 3)),
            steps,
        };
        let is_on_rail = cut.value[leg.rail() as usize] == 0.0;
        (is_on_rail && leg.length() > 0.0).then_some(leg)
    }

    /// The vertex on the rail.
    pub(super) fn rail(&self) -> u32 {
        self.vertices[self.vertices.len() - 1].0
    }

    pub(super) fn length(&self) -> f64 {
        self.vertices[self.vertices.len() - 1].2
    }

    /// From the corner to the point at this part of its length, and the derivative by that part.
    pub(super) fn at(&self, part: f64) -> [Vector3<f64>; 2] {
        let (along, all) = (part * self.length(), &self.vertices);
        let k = all.partition_point(|of| of.2 <= along).clamp(1, all.len() - 1);
        let ((_, p, before), (_, q, behind)) = (all[k - 1], all[k]);
        let slope = (q - p) / (behind - before);
        [p + slope * (along - before) - all[0].1, slope * self.length()]
    }
}

/// The half-edges of the face across, or of the boundary, from the corner along it to the rail, and the next one.
fn steps(cut: &Cut<'_>, of: &Through, sense: Sense, outgoing: &BTreeMap<u32, u32>) -> Vec<u32> {
    let mut steps = Vec::new();
    let first = outgoing.get(&of.vertex);
    let mut ahead = first.and_then(|&g| step(cut, g, of.face, sense));
    while let Some(h) = ahead
        && steps.len() < cut.sheet.x.len()
    {
        steps.push(h);
        let [from, _] = sense.ends(cut, h);
        let on = match sense {
            Sense::Away => next(h),
            Sense::Towards => h,
        };
        ahead = step(cut, on, of.face, sense).filter(|_| cut.value[from as usize] < 0.0);
    }
    steps
}

/// The half-edge along a crease of the face, or along the boundary if there is none, that starts, or ends, where `g` starts.
fn step(cut: &Cut<'_>, g: u32, face: Option<u32>, sense: Sense) -> Option<u32> {
    let (sheet, mut found) = (&cut.sheet, None);
    sheet.fan(g, |g| {
        let h = match sense {
            Sense::Away => g,
            Sense::Towards => previous(g),
        };
        let o = sheet.across(h);
        let is_step = match face {
            Some(face) => cut.face(h / 3) == face && o != NONE && cut.face(o / 3) != face,
            None => o == NONE,
        };
        if is_step {
            found = Some(h);
        }
    });
    found
}
