//! What the faces beside rails tell of them.

use nalgebra::Vector3;

use super::cut::Cut;
use super::face_normals::FaceNormals;
use super::level::Entry;
use crate::mesh::NONE;
use crate::mesh::halfedge::next;

/// Where the width is below this part of the largest one, a band ends.
/// Of 12 solids cut from each other, half or double: none changes.
const END: f64 = 1e-6;

/// Per vertex the faces across the rails there.
pub(super) struct Rails(Vec<[u32; 2]>);

impl Rails {
    /// Of these triangles of bands.
    pub(super) fn new(cut: &Cut<'_>, band: &[usize]) -> Self {
        let sheet = &cut.sheet;
        let mut faces = vec![[NONE; 2]; sheet.x.len()];
        for h in band.iter().flat_map(|&t| 3 * t as u32..3 * t as u32 + 3) {
            let o = sheet.across(h);
            if o == NONE || cut.is_band[o as usize / 3] {
                continue;
            }
            let face = cut.face(o / 3);
            for v in [h, next(h)].map(|g| sheet.origin(g) as usize) {
                if faces[v][0] == NONE {
                    faces[v][0] = face;
                } else if faces[v][0] != face {
                    faces[v][1] = face;
                }
            }
        }
        Self(faces)
    }

    /// The normal at a vertex. None where a crease arrives that is not rounded: there are two of them there; where a band ends, the mean holds.
    pub(super) fn normal(&self, v: u32, cut: &Cut<'_>, normals: &FaceNormals<'_>) -> Option<Vector3<f64>> {
        let [face, other] = self.faces(v, cut)?;
        let of = |face: u32| normals.between(&cut.sheet.parents[v as usize], face);
        let first = of(face)?;
        match other {
            NONE => Some(first),
            _ => (first + of(other)?).try_normalize(0.0),
        }
    }

    /// The faces across a rail, if one normal is theirs; the second one is [`NONE`] but where a band ends.
    fn faces(&self, v: u32, cut: &Cut<'_>) -> Option<[u32; 2]> {
        let faces = self.0[v as usize];
        (faces[0] != NONE && !self.is_crossed(v, cut)).then_some(faces)
    }

    /// The mean curvature of the faces there; none where there is no normal.
    pub(super) fn curvature(&self, v: u32, cut: &Cut<'_>, normals: &FaceNormals<'_>) -> Option<f64> {
        let [face, other] = self.faces(v, cut)?;
        let of = |face: u32| normals.curvature(&cut.sheet.parents[v as usize], face);
        match other {
            NONE => Some(of(face)),
            _ => Some(0.5 * (of(face) + of(other))),
        }
    }

    /// Whether a crease that is not rounded arrives at a rail there.
    fn is_crossed(&self, v: u32, cut: &Cut<'_>) -> bool {
        let ends = |e: &Entry| e.distance - e.excess <= END * cut.level.sides[e.side as usize].widest;
        self.0[v as usize][1] != NONE && !cut.near[v as usize].iter().any(ends)
    }

    /// The edges of such creases that end at rails; both triangles are among these ones of faces.
    pub(super) fn creases(&self, cut: &Cut<'_>, faces: &[usize]) -> Vec<[u32; 2]> {
        let sheet = &cut.sheet;
        let mut edges = Vec::new();
        for h in faces.iter().flat_map(|&t| 3 * t as u32..3 * t as u32 + 3) {
            let o = sheet.across(h);
            let ends = [sheet.origin(h), sheet.target(h)];
            let is_crease =
                o != NONE && o > h && !cut.is_band[o as usize / 3] && cut.face(h / 3) != cut.face(o / 3);
            if is_crease && ends.iter().any(|&v| self.is_crossed(v, cut)) {
                edges.push(ends);
            }
        }
        edges
    }
}
