//! What edits make of the boundary of one component.

use nalgebra::Vector3;

use crate::fairing::edit::along_loop::{arc_lengths, part, tangent, turned};
use crate::fairing::edit::resolved::{Bend, ResolvedEdits};
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
    /// Which of them edits have turned off the surroundings: they are as good as given.
    pub(super) is_turned: Vec<bool>,
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
                is_turned: vec![false; normals.len()],
            },
        }
    }

    /// The vertices of the loops, by the caller's numbers.
    pub(super) fn on_loops<'u>(&'u self, domain: &'u Domain) -> impl Iterator<Item = u32> + 'u {
        let ids = &domain.region.vertex_ids[domain.region.free..];
        self.loops.iter().flatten().map(|&b| ids[b as usize])
    }

    /// What is prescribed where these edits have moved fixed vertices.
    pub(super) fn moved(&self, edits: &ResolvedEdits, domain: &Domain, frame: &Normalization) -> Prescribed {
        let mut all = self.prescribed.clone();
        let ids = &domain.region.vertex_ids[domain.region.free..];
        self.move_fixed(edits, ids, frame, &mut all);
        all
    }

    /// The first loop through a vertex.
    pub(super) fn loop_of(&self, domain: &Domain, vertex: u32) -> Option<usize> {
        let ids = &domain.region.vertex_ids[domain.region.free..];
        let has = |along: &Vec<u32>| along.iter().any(|&b| ids[b as usize] == vertex);
        self.loops.iter().position(has)
    }

    /// How the normals turn along a loop by these bends of it, and by as much more everywhere.
    pub(super) fn turns(
        &self,
        of_loop: usize,
        bends: &[Bend],
        bulge: f64,
        (domain, frame): (&Domain, &Normalization),
        prescribed: &Prescribed,
    ) -> Vec<Turn> {
        let ids = &domain.region.vertex_ids[domain.region.free..];
        let along = &self.loops[of_loop];
        let angles = angles(along, &self.lengths[of_loop], (bends, bulge), ids, frame.scale);
        let turns = angles.into_iter().enumerate().filter_map(|(k, angle)| {
            Some(Turn {
                vertex: ids[along[k] as usize],
                along: direction(along, k, &prescribed.fixed)?,
                angle,
            })
        });
        turns.collect()
    }

    /// How many loops there are.
    pub(super) fn loops(&self) -> usize {
        self.loops.len()
    }

    /// Moves fixed vertices and their normals: those on loops turn further with the direction of the boundary, where neighbours do not follow
    /// alike.
    fn move_fixed(&self, edits: &ResolvedEdits, ids: &[u32], frame: &Normalization, all: &mut Prescribed) {
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
    (bends, bulge): (&[Bend], f64),
    ids: &[u32],
    scale: f64,
) -> Vec<f64> {
    let mut angles = vec![bulge; along.len()];
    for bend in bends {
        let Some(named) = along.iter().position(|&b| ids[b as usize] == bend.vertex) else {
            continue;
        };
        for (angle, s) in angles.iter_mut().zip(lengths) {
            let ahead = s - lengths[named];
            let s = if ahead < 0.0 { ahead + around } else { ahead };
            *angle += bend.angle * part(bend.kind, s, *around, bend.falloff / scale);
        }
    }
    angles
}

/// How far a vertex's normal turns about the direction of the boundary there, by the caller's number.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn {
    vertex: u32,
    along: Vector3<f64>,
    angle: f64,
}

/// Each vertex has one normal, on whatever loops it is: those of both sides of a curve run in opposite directions, and opposite turns cancel. Ascending.
pub(super) fn united(mut turns: Vec<Turn>) -> Vec<Turn> {
    turns.sort_by_key(|turn| turn.vertex);
    let of_vertices = turns.chunk_by(|a, b| a.vertex == b.vertex);
    let united = of_vertices.map(|of_vertex| {
        let first = of_vertex[0];
        let signed = |t: &Turn| t.angle * t.along.dot(&first.along).signum();
        Turn {
            angle: of_vertex.iter().map(signed).sum(),
            ..first
        }
    });
    united.filter(|turn| turn.angle != 0.0).collect()
}

impl Prescribed {
    /// Turns the normals, of which there is one for each of these vertices.
    pub(super) fn turn(&mut self, boundary: &[u32], turns: &[Turn]) {
        let normals = self.normals.iter_mut().zip(&mut self.is_turned);
        for ((n, is_turned), v) in normals.zip(boundary) {
            if let Ok(k) = turns.binary_search_by_key(v, |turn| turn.vertex) {
                *n = turned(*n, turns[k].along, turns[k].angle);
                *is_turned = true;
            }
        }
    }
}
