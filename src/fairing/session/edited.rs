//! What edits make of the boundary of one component.

use nalgebra::Vector3;

use crate::fairing::edit::along_loop::{arc_lengths, part, tangent, turned};
use crate::fairing::edit::resolved::{Bend, Resolved};
use crate::fairing::normalization::Normalization;
use crate::mesh::boundary_loops::boundary_loops;
use crate::solve::Domain;

/// What is prescribed to a component, in its own frame.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Prescribed {
    /// Positions of the fixed vertices (boundary, outside, and beyond).
    pub(super) fixed: Vec<Vector3<f64>>,
    /// Normals of the boundary vertices.
    pub(super) normals: Vec<Vector3<f64>>,
}

/// What is prescribed without edits, and the loops that edits name.
pub(super) struct Unedited {
    /// As it was given.
    pub(super) prescribed: Prescribed,
    /// Boundary vertices (from the first one) with the region on their left.
    loops: Vec<Vec<u32>>,
    /// Along each loop the arc length, and that of the whole.
    lengths: Vec<(Vec<f64>, f64)>,
}

impl Unedited {
    pub(super) fn new(domain: &Domain, normals: &[Vector3<f64>]) -> Self {
        let region = &domain.region;
        let loops = boundary_loops(region, &domain.rings);
        let fixed = domain.input[region.free..].to_vec();
        let points = |along: &Vec<u32>| along.iter().map(|&b| fixed[b as usize]).collect::<Vec<_>>();
        let lengths = loops.iter().map(|along| arc_lengths(&points(along))).collect();
        Self {
            loops,
            lengths,
            prescribed: Prescribed {
                fixed,
                normals: normals.to_vec(),
            },
        }
    }

    /// The vertices of the loops, by the caller's numbers.
    pub(super) fn on_loops<'u>(&'u self, domain: &'u Domain) -> impl Iterator<Item = u32> + 'u {
        let ids = &domain.region.vertex_ids[domain.region.free..];
        self.loops.iter().flatten().map(|&b| ids[b as usize])
    }

    /// What is prescribed with these edits.
    pub(super) fn edited(&self, edits: &Resolved, domain: &Domain, frame: &Normalization) -> Prescribed {
        let mut all = self.prescribed.clone();
        let ids = &domain.region.vertex_ids[domain.region.free..];
        self.move_fixed(edits, ids, frame, &mut all);
        if edits.bulge != 0.0 || !edits.bends.is_empty() {
            for (along, lengths) in self.loops.iter().zip(&self.lengths) {
                let angles = angles(along, lengths, edits, ids, frame.scale);
                bend(along, &angles, &mut all);
            }
        }
        all
    }

    /// Moves fixed vertices and their normals: those on loops turn further with the direction of the boundary, where neighbours do not follow
    /// alike.
    fn move_fixed(&self, edits: &Resolved, ids: &[u32], frame: &Normalization, all: &mut Prescribed) {
        if edits.moved.is_empty() {
            return;
        }
        for ((p, &v), b) in all.fixed.iter_mut().zip(ids).zip(0..) {
            let Some(moved) = edits.at(v) else { continue };
            let mut at = [Vector3::from(moved.at)];
            frame.enter(&mut at);
            *p = at[0];
            if let Some(n) = all.normals.get_mut(b) {
                *n = moved.turn * *n;
            }
        }
        for along in &self.loops {
            for k in 0..along.len() {
                let b = along[k] as usize;
                let turn = edits.at(ids[b]).map(|m| m.turn);
                let before = direction(along, k, &self.prescribed.fixed);
                let after = direction(along, k, &all.fixed);
                let (Some(before), Some(after)) = (before, after) else {
                    continue;
                };
                let carried = turn.map_or(before, |turn| turn * before);
                all.normals[b] = turned_along(all.normals[b], carried, after);
            }
        }
    }
}

/// The direction of a loop at its k-th vertex.
fn direction(along: &[u32], k: usize, points: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    let (n, at) = (along.len(), |k: usize| points[along[k % along.len()] as usize]);
    tangent(at(k + n - 1), at(k), at(k + 1))
}

/// Turned as the shortest way from one direction to another is; not where both are the same to rounding.
fn turned_along(n: Vector3<f64>, from: Vector3<f64>, to: Vector3<f64>) -> Vector3<f64> {
    const ROUNDING: f64 = 1e-13;
    let (axis, cos) = (from.cross(&to), from.dot(&to));
    if axis.norm() < ROUNDING || 1.0 + cos < ROUNDING {
        return n;
    }
    // Rodrigues, with the sine in the axis.
    let turned = n * cos + axis.cross(&n) + axis * (axis.dot(&n) / (1.0 + cos));
    turned.try_normalize(f64::MIN_POSITIVE).unwrap_or(n)
}

/// The angles along a loop.
fn angles(
    along: &[u32],
    (lengths, around): &(Vec<f64>, f64),
    edits: &Resolved,
    ids: &[u32],
    scale: f64,
) -> Vec<f64> {
    let mut angles = vec![edits.bulge; along.len()];
    for bend in &edits.bends {
        for named in (0..along.len()).filter(|&k| ids[along[k] as usize] == bend.vertex) {
            for (angle, s) in angles.iter_mut().zip(lengths) {
                let ahead = s - lengths[named];
                let s = if ahead < 0.0 { ahead + around } else { ahead };
                *angle += bend.angle * part(bend.kind, s, *around, bend.falloff / scale);
            }
        }
    }
    angles
}

/// Turns the normals along a loop.
fn bend(along: &[u32], angles: &[f64], all: &mut Prescribed) {
    for (k, &angle) in angles.iter().enumerate().filter(|(_, a)| **a != 0.0) {
        if let Some(direction) = direction(along, k, &all.fixed) {
            let n = &mut all.normals[along[k] as usize];
            *n = turned(*n, direction, angle);
        }
    }
}

/// The first bend that no loop of these vertices (ascending) has.
pub(super) fn astray<'b>(bends: &'b [Bend], on_loops: &[u32]) -> Option<&'b Bend> {
    bends
        .iter()
        .find(|bend| on_loops.binary_search(&bend.vertex).is_err())
}
