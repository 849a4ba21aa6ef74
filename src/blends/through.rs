//! Where a crease that is rounded ends between two that are not: its blend runs through to the face across, as a milling cutter does. If one of these
//! is a ridge and the other a groove, there is no such face: the blend would end in the air. At the boundary of the surface it runs out likewise.

use super::crease_graph::{Chain, CreaseGraph};
use super::legs::{Sense, Way};
use super::meetings::{End, Meeting, meetings};
use super::surface::Surface;

/// An end of a chain that a face is across from, or nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Through {
    pub(super) at: End,
    pub(super) vertex: u32,
    /// The face that both other creases bound, and this one does not; none at the boundary.
    pub(super) face: Option<u32>,
}

impl Through {
    /// From the corner to both sides.
    pub(super) fn ways(&self) -> [Way; 2] {
        [Sense::Away, Sense::Towards].map(|sense| match self.face {
            Some(face) => Way::Crease(face, sense),
            None => Way::Boundary(sense),
        })
    }
}

/// All such ends, by their vertices.
pub(super) fn through(surface: &Surface<'_>, graph: &CreaseGraph) -> Vec<Through> {
    let of = |at: Meeting| {
        let [end] = at.rounded[..] else {
            return None;
        };
        let face = match at.others.len() {
            2 if Meeting::are_alike(graph, &at.others) => {
                Some(across(surface, graph, end.chain(graph), at.vertex)?)
            }
            0 if surface.boundary_edges(at.vertex) == 1 => None,
            _ => return None,
        };
        Some(Through {
            at: end,
            vertex: at.vertex,
            face,
        })
    };
    meetings(surface, graph).into_iter().filter_map(of).collect()
}

/// The one face at a vertex inside the surface that is not beside the chain; there are three there.
fn across(surface: &Surface<'_>, graph: &CreaseGraph, chain: &Chain, v: u32) -> Option<u32> {
    let around = surface.links.outgoing.row(v as usize);
    let is_inside = around.iter().all(|&h| surface.across(h).is_some());
    let beside = graph.beside(chain, surface);
    let mut faces: Vec<u32> = around.iter().map(|&h| graph.faces[h as usize / 3]).collect();
    faces.sort_unstable();
    faces.dedup();
    let is_three = is_inside && faces.len() == 3 && beside[0] != beside[1];
    faces.retain(|face| !beside.contains(face));
    (is_three && faces.len() == 1).then(|| faces[0])
}
