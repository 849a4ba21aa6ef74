//! Where blends run out to the boundary of the surface.

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
    /// It reaches over the boundary beside its crease.
    Beside { chain: usize, place: Vector3<f64> },
}

/// The arcs of the boundary at all ends that have no face across.
///
/// # Errors
/// A band for which there is none.
pub(super) fn rims(
    cut: &Cut<'_>,
    through: &[Through],
    normals: &FaceNormals<'_>,
) -> Result<Vec<Arc>, Unlaid> {
    let ends: Vec<&Through> = through.iter().filter(|of| of.face.is_none()).collect();
    let from = outgoing(cut, ends.iter().map(|of| of.vertex));
    let mut is_laid = vec![false; cut.sheet.x.len()];
    let mut rims = Vec::new();
    for of in ends {
        let unlaid = || Unlaid::End {
            vertex: of.vertex,
            place: cut.sheet.x[of.vertex as usize],
        };
        let [Some(first), Some(last)] = of.ways().map(|way| Leg::new(cut, of.vertex, way, &from)) else {
            return Err(unlaid());
        };
        let rim = arc(cut, [&first, &last], normals).ok_or_else(unlaid)?;
        for (v, _) in &rim[1..rim.len() - 1] {
            if std::mem::replace(&mut is_laid[*v as usize], true) {
                return Err(unlaid());
            }
        }
        rims.push(rim);
    }
    beside(cut, &is_laid).map_or(Ok(rims), Err)
}

/// A band with vertices on the boundary that are none of a rim's.
fn beside(cut: &Cut<'_>, is_laid: &[bool]) -> Option<Unlaid> {
    let sheet = &cut.sheet;
    let all = (0..3 * sheet.triangles.len() as u32).filter(|h| sheet.is_there(h / 3));
    let mut on_boundary = all.filter(|&h| sheet.across(h) == NONE).map(|h| sheet.origin(h));
    let v = on_boundary.find(|&v| cut.value[v as usize] < 0.0 && !is_laid[v as usize])?;
    let nearest = cut.level.nearest(&cut.near[v as usize])?;
    Some(Unlaid::Beside {
        chain: cut.level.sides[nearest.side as usize].curve as usize,
        place: sheet.x[v as usize],
    })
}
