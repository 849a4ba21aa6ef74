//! Where blends run out to the boundary of the surface.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::arcs::{Arc, arc};
use super::cut::Cut;
use super::face_normals::FaceNormals;
use super::legs::{Leg, outgoing};
use super::through::Through;
use crate::mesh::NONE;

/// A band whose boundary cannot be a blend's.
pub(super) enum Unlaid {
    /// A crease ends there, and the rails do not go around that end.
    End { vertex: u32, place: Vector3<f64> },
    /// It reaches over the boundary beside its crease, or over another crease to a face that is not its own.
    Beside { chain: usize, place: Vector3<f64> },
}

/// The arcs of the boundary at all ends that have no face across.
///
/// # Errors
/// The ends for which there is none, or else the creases whose bands reach too far.
pub(super) fn rims(
    cut: &Cut<'_>,
    through: &[Through],
    normals: &FaceNormals<'_>,
) -> Result<Vec<Arc>, Vec<Unlaid>> {
    let ends: Vec<&Through> = through.iter().filter(|of| of.face.is_none()).collect();
    let from = outgoing(cut, ends.iter().map(|of| of.vertex));
    let mut is_laid = vec![false; cut.sheet.x.len()];
    let (mut rims, mut unlaid) = (Vec::new(), Vec::new());
    for of in ends {
        match rim(cut, of, normals, &from).filter(|rim| lay(rim, &mut is_laid)) {
            Some(rim) => rims.push(rim),
            None => unlaid.push(Unlaid::End {
                vertex: of.vertex,
                place: cut.sheet.x[of.vertex as usize],
            }),
        }
    }
    if unlaid.is_empty() {
        unlaid = beside(cut, &is_laid);
    }
    if unlaid.is_empty() { Ok(rims) } else { Err(unlaid) }
}

/// The arc of the boundary around an end, from rail to rail.
fn rim(cut: &Cut<'_>, of: &Through, normals: &FaceNormals<'_>, from: &BTreeMap<u32, u32>) -> Option<Arc> {
    let [first, last] = of.ways().map(|way| Leg::new(cut, of.vertex, way, from));
    arc(cut, [&first?, &last?], normals)
}

/// Whether no other rim has a vertex of this one; it has them then.
fn lay(rim: &Arc, is_laid: &mut [bool]) -> bool {
    let inside = || rim[1..rim.len() - 1].iter().map(|&(v, _)| v as usize);
    let is_free = !inside().any(|v| is_laid[v]);
    if is_free {
        inside().for_each(|v| is_laid[v] = true);
    }
    is_free
}

/// Bands that reach too far, each with the first place where one does.
fn beside(cut: &Cut<'_>, is_laid: &[bool]) -> Vec<Unlaid> {
    let sheet = &cut.sheet;
    let inside = |v: u32| (cut.value[v as usize] < 0.0).then_some(v);
    let mut places = BTreeMap::new();
    for h in (0..3 * sheet.triangles.len() as u32).filter(|h| sheet.is_there(h / 3)) {
        let v = sheet.origin(h);
        let from = if sheet.across(h) == NONE && !is_laid[v as usize] {
            inside(v)
        } else if cut.is_lost(v) {
            sheet.triangles[h as usize / 3].into_iter().find_map(inside)
        } else {
            None
        };
        if let Some(nearest) = from.and_then(|v| cut.level.nearest(&cut.near[v as usize])) {
            let chain = cut.level.sides[nearest.side as usize].curve as usize;
            places.entry(chain).or_insert(sheet.x[v as usize]);
        }
    }
    let of = |(chain, place)| Unlaid::Beside { chain, place };
    places.into_iter().map(of).collect()
}
