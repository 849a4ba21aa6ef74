//! Lines from the ends of creases to rails.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector3;

use super::cut::Cut;
use crate::mesh::NONE;
use crate::mesh::halfedge::{next, previous};

/// What is left of these lines inside bands is divided into edges as short as those of the bands: they are to be the arcs'.
pub(super) fn divide(cut: &mut Cut<'_>, lines: &[(u32, [Way; 2])]) {
    loop {
        let outgoing = outgoing(cut, lines.iter().map(|of| of.0));
        let ways = lines.iter().flat_map(|(v, ways)| ways.map(|way| (*v, way)));
        let steps: Vec<u32> = ways.flat_map(|(v, way)| steps(cut, v, way, &outgoing)).collect();
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

/// A half-edge from each of these vertices.
pub(super) fn outgoing(cut: &Cut<'_>, vertices: impl Iterator<Item = u32>) -> BTreeMap<u32, u32> {
    let sheet = &cut.sheet;
    let vertices: BTreeSet<u32> = vertices.collect();
    if vertices.is_empty() {
        return BTreeMap::new();
    }
    let all = (0..3 * sheet.triangles.len() as u32).filter(|h| sheet.is_there(h / 3));
    all.map(|h| (sheet.origin(h), h))
        .filter(|(v, _)| vertices.contains(v))
        .collect()
}

/// Which line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Way {
    /// The crease with this face on the left of the way from the corner, or on the right.
    Crease(u32, Sense),
    /// The boundary likewise.
    Boundary(Sense),
    /// Between two bands on this face, whose creases leave the corner in these directions.
    Mitre(u32, [Vector3<f64>; 2]),
}

impl Way {
    fn sense(self) -> Sense {
        match self {
            Self::Crease(_, sense) | Self::Boundary(sense) => sense,
            Self::Mitre(..) => Sense::Away,
        }
    }
}

/// Whether the half-edges of a line lead away from its corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sense {
    Away,
    Towards,
}

impl Sense {
    /// The vertices of a half-edge on the way from the corner.
    pub(super) fn ends(self, cut: &Cut<'_>, h: u32) -> [u32; 2] {
        let [a, b] = [cut.sheet.origin(h), cut.sheet.target(h)];
        match self {
            Self::Away => [a, b],
            Self::Towards => [b, a],
        }
    }

    /// A half-edge that starts where `h` ends on that way.
    fn on(self, h: u32) -> u32 {
        match self {
            Self::Away => next(h),
            Self::Towards => h,
        }
    }
}

/// From a crease's end to a rail.
pub(super) struct Leg {
    pub(super) sense: Sense,
    /// Its vertices, their places and how far along it they are.
    pub(super) vertices: Vec<(u32, Vector3<f64>, f64)>,
    /// The next vertex, if it goes on behind the rail.
    pub(super) outside: Option<u32>,
    /// Between two bands: what of it is along the first crease, if it is parted along both.
    pub(super) aside: Option<Vector3<f64>>,
    /// The faces on its sides there: of the blend, and across; on a boundary and between bands there is but one.
    pub(super) faces: [u32; 2],
}

impl Leg {
    /// None where it does not end on a rail.
    pub(super) fn new(cut: &Cut<'_>, corner: u32, way: Way, outgoing: &BTreeMap<u32, u32>) -> Option<Self> {
        let (steps, sense) = (steps(cut, corner, way, outgoing), way.sense());
        let last = *steps.last()?;
        let place = |v: u32| cut.sheet.x[v as usize];
        let mut vertices = vec![(corner, place(corner), 0.0)];
        for &h in &steps {
            let [from, to] = sense.ends(cut, h);
            let along = vertices[vertices.len() - 1].2 + (place(to) - place(from)).norm();
            vertices.push((to, place(to), along));
        }
        let outside = step(cut, sense.on(last), way);
        let beside = outside.unwrap_or(last);
        let across = match (cut.sheet.across(beside), way) {
            (NONE, _) | (_, Way::Mitre(..)) => beside,
            (across, _) => across,
        };
        let whole = vertices[vertices.len() - 1].1 - vertices[0].1;
        let leg = Self {
            sense,
            aside: match way {
                Way::Mitre(_, along) => Some(part_along(&whole, along)),
                _ => None,
            },
            outside: outside.map(|h| sense.ends(cut, h)[1]),
            faces: [across, beside].map(|h| cut.face(h / 3)),
            vertices,
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

/// The part along the first of two directions of a vector in their plane.
fn part_along(v: &Vector3<f64>, [first, second]: [Vector3<f64>; 2]) -> Vector3<f64> {
    let across = first.cross(&second);
    first * (v.cross(&second).dot(&across) / across.norm_squared().max(f64::MIN_POSITIVE))
}

/// The half-edges of a line from its corner to the rail.
fn steps(cut: &Cut<'_>, corner: u32, way: Way, outgoing: &BTreeMap<u32, u32>) -> Vec<u32> {
    let mut steps = Vec::new();
    let mut ahead = outgoing.get(&corner).and_then(|&g| step(cut, g, way));
    while let Some(h) = ahead
        && steps.len() < cut.sheet.x.len()
    {
        steps.push(h);
        let [_, to] = way.sense().ends(cut, h);
        let is_inside = cut.value[to as usize] < 0.0;
        ahead = is_inside.then(|| step(cut, way.sense().on(h), way)).flatten();
    }
    steps
}

/// The half-edge of a line on from the vertex where `g` starts.
fn step(cut: &Cut<'_>, g: u32, way: Way) -> Option<u32> {
    let (sheet, mut found) = (&cut.sheet, None);
    sheet.fan(g, |g| {
        let h = match way.sense() {
            Sense::Away => g,
            Sense::Towards => previous(g),
        };
        let o = sheet.across(h);
        let is_step = match way {
            Way::Crease(face, _) => cut.face(h / 3) == face && o != NONE && cut.face(o / 3) != face,
            Way::Boundary(_) => o == NONE,
            Way::Mitre(face, _) => {
                let [from, to] = [sheet.origin(h), sheet.target(h)].map(|v| cut.value[v as usize]);
                cut.face(h / 3) == face && cut.is_mitre(h) && to > from
            }
        };
        if is_step {
            found = Some(h);
        }
    });
    found
}
