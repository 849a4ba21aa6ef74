//! What filling returns: the mesh with its patches.

use super::groups::LoopGroup;
use super::outcome::{LoopReport, renumber};
use super::parents::Parents;
use crate::holes::patch_surface::PatchSurface;

/// The filled mesh.
#[derive(Debug, Clone)]
pub struct Filled {
    /// The positions given, then the new ones. Those given are as they were, unless [`FillOptions::rim`](crate::FillOptions::rim) lets them move.
    pub positions: Vec<[f64; 3]>,
    /// The triangles given, then the new ones.
    pub triangles: Vec<[u32; 3]>,
    /// Per new vertex where it comes from.
    pub parents: Vec<Parents>,
    /// Per loop of the mesh (or per loop chosen) what became of it; loops that are joined have one report.
    pub loops: Vec<LoopReport>,
}

impl Filled {
    /// Whether there is nothing to be said of the result: all loops are [successes](LoopReport::is_success), and it is not so that
    /// outer boundaries stayed open and nothing was filled. The same in every host.
    pub fn is_success(&self) -> bool {
        let is_skipped =
            self.loops.iter().all(LoopReport::is_open) && self.loops.iter().any(LoopReport::is_outer);
        self.loops.iter().all(LoopReport::is_success) && !is_skipped
    }
    /// Appends a piece and its report.
    pub(super) fn append(&mut self, piece: PatchSurface, group: &LoopGroup, edges: usize, seconds: f64) {
        let (vertex, triangle) = (self.positions.len() as u32, self.triangles.len() as u32);
        let boundary = piece.boundary.len() as u32;
        let number = |v: u32| {
            if v < boundary {
                piece.boundary[v as usize]
            } else {
                vertex + (v - boundary)
            }
        };
        self.positions.extend(&piece.positions);
        self.triangles
            .extend(piece.triangles.iter().map(|t| t.map(number)));
        self.parents.extend(&piece.parents);
        let mut fairing = piece.fairing;
        if let Some(report) = &mut fairing {
            let (known, known_triangles) = (&piece.known, &piece.known_triangles);
            renumber(
                report,
                |v| {
                    let known_count = known.len() as u32;
                    known
                        .get(v as usize)
                        .copied()
                        .unwrap_or_else(|| vertex + v - known_count)
                },
                |t| {
                    let known_count = known_triangles.len() as u32;
                    let known = known_triangles.get(t as usize).copied();
                    known.unwrap_or_else(|| triangle + t - known_count)
                },
            );
        }
        self.loops.push(LoopReport {
            index: group.loops[0],
            loops: group.loops.clone(),
            joined: group.reason,
            edges,
            outcome: piece.outcome,
            vertices: vertex..self.positions.len() as u32,
            triangles: triangle..self.triangles.len() as u32,
            fairing,
            worst_angle: piece.worst_angle,
            outside: piece.outside.iter().map(|&i| vertex + i).collect(),
            coarsened: piece.coarsened,
            normals_reached: piece.normals_reached,
            self_intersections: Vec::new(),
            rim: None,
            seconds,
        });
    }
}
