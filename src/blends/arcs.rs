//! Where a blend runs through to the face across, its edge with that face: from one of the other two creases to the other, in place of their corner.

use std::collections::{BTreeMap, BTreeSet};

use super::cut::Cut;
use super::face_normals::FaceNormals;
use super::surface::between;
use super::through::Through;
use crate::fairing::{CreaseEnd, GivenCrease};
use crate::mesh::NONE;
use crate::mesh::halfedge::{self, previous};

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

/// The arcs of these ends; none where a corner was not cut as it should be.
pub(super) fn arcs(cut: &Cut<'_>, through: &[Through], normals: &FaceNormals<'_>) -> Vec<GivenCrease> {
    let outgoing = outgoing(cut, through);
    through
        .iter()
        .filter_map(|of| arc(cut, of, &outgoing, normals))
        .collect()
}

/// A half-edge from each of the corners.
fn outgoing(cut: &Cut<'_>, through: &[Through]) -> BTreeMap<u32, u32> {
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
enum Sense {
    Away,
    Towards,
}

impl Sense {
    /// The vertices of a half-edge of that face, on the way from the corner.
    fn ends(self, cut: &Cut<'_>, h: u32) -> [u32; 2] {
        let [a, b] = [cut.sheet.origin(h), cut.sheet.target(h)];
        match self {
            Self::Away => [a, b],
            Self::Towards => [b, a],
        }
    }
}

fn arc(
    cut: &Cut<'_>,
    of: &Through,
    outgoing: &BTreeMap<u32, u32>,
    normals: &FaceNormals<'_>,
) -> Option<GivenCrease> {
    let way = |sense: Sense| {
        let steps = steps(cut, of, sense, outgoing);
        let end = end(cut, of.face, &steps, sense, normals)?;
        let ends = steps.iter().map(|&h| sense.ends(cut, h)[1]);
        let mut inside: Vec<u32> = ends.collect();
        // The last vertex is outside.
        inside.pop();
        Some((end, inside))
    };
    let ((first, before), (last, behind)) = (way(Sense::Away)?, way(Sense::Towards)?);
    let corner = std::iter::once(of.vertex);
    let vertices: Vec<u32> = before.into_iter().rev().chain(corner).chain(behind).collect();
    let at = |v: u32| cut.sheet.x[v as usize];
    let mut along = vec![0.0];
    for step in vertices.windows(2) {
        along.push(along[along.len() - 1] + (at(step[1]) - at(step[0])).norm());
    }
    let length = along[along.len() - 1];
    Some(GivenCrease {
        ends: [first, last],
        vertices,
        parts: along.into_iter().map(|s| s / length).collect(),
    })
}

/// The half-edges of the face across from the corner along a crease to the rail, and one more.
fn steps(cut: &Cut<'_>, of: &Through, sense: Sense, outgoing: &BTreeMap<u32, u32>) -> Vec<u32> {
    let mut steps = Vec::new();
    let mut next = outgoing
        .get(&of.vertex)
        .and_then(|&g| step(cut, g, of.face, sense));
    while let Some(h) = next
        && steps.len() < cut.sheet.x.len()
    {
        steps.push(h);
        let [from, _] = sense.ends(cut, h);
        let on = match sense {
            Sense::Away => halfedge::next(h),
            Sense::Towards => h,
        };
        next = step(cut, on, of.face, sense).filter(|_| cut.value[from as usize] < 0.0);
    }
    steps
}

/// How the crease arrives at the rail, along whose last step but one it comes in.
fn end(
    cut: &Cut<'_>,
    face: u32,
    steps: &[u32],
    sense: Sense,
    normals: &FaceNormals<'_>,
) -> Option<CreaseEnd> {
    let [inside, h] = *steps.last_chunk()?;
    let [v, outside] = sense.ends(cut, h);
    let at = |v: u32| cut.sheet.x[v as usize];
    let direction = (at(sense.ends(cut, inside)[0]) - at(v)).try_normalize(0.0)?;
    let other = cut.face(cut.sheet.across(h) / 3);
    let of = |face: u32| normals.between(&cut.sheet.parents[v as usize], face);
    // On the left of the way from the corner is right of the way to it.
    let [left, right] = match sense {
        Sense::Away => [of(other)?, of(face)?],
        Sense::Towards => [of(face)?, of(other)?],
    };
    let is_on_rail = cut.value[v as usize] == 0.0;
    is_on_rail.then(|| CreaseEnd {
        vertex: v,
        direction: direction.into(),
        curvature: [0.0; 3],
        curvature_error: f64::INFINITY,
        normals: [left, right].map(Into::into),
        angle: between(&left, &right).to_degrees() * left.cross(&right).dot(&direction).signum(),
        error: 0.0,
        chains: vec![vec![v, outside]],
    })
}

/// The half-edge along a crease of the face that starts, or ends, where `g` starts.
fn step(cut: &Cut<'_>, g: u32, face: u32, sense: Sense) -> Option<u32> {
    let (sheet, mut found) = (&cut.sheet, None);
    sheet.fan(g, |g| {
        let h = match sense {
            Sense::Away => g,
            Sense::Towards => previous(g),
        };
        let o = sheet.across(h);
        if cut.face(h / 3) == face && o != NONE && cut.face(o / 3) != face {
            found = Some(h);
        }
    });
    found
}
