//! Where a crease that is rounded ends between two that are not: its blend runs through to the face across, as a milling cutter does. If one of these
//! is a ridge and the other a groove, there is no such face: the blend would end in the air. At the boundary of the surface it runs out likewise.

use super::crease_graph::{Chain, CreaseGraph};
use super::surface::Surface;

/// An end of a chain that a face is across from, or nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Through {
    pub(super) chain: usize,
    /// 0 at the chain's beginning, 1 at its end.
    pub(super) end: usize,
    pub(super) vertex: u32,
    /// The face that both other creases bound, and this one does not; none at the boundary.
    pub(super) face: Option<u32>,
}

/// All such ends, by their chains.
pub(super) fn through(surface: &Surface<'_>, graph: &CreaseGraph) -> Vec<Through> {
    let count = |counts: &dyn Fn(&Chain) -> bool| {
        let mut at = vec![0; surface.x.len()];
        for chain in graph
            .chains
            .iter()
            .filter(|chain| !chain.is_closed && counts(chain))
        {
            chain.ends(surface).into_iter().for_each(|v| at[v as usize] += 1);
        }
        at
    };
    let chosen = count(&|chain| chain.is_chosen);
    let ridges = count(&|chain| !chain.is_chosen && chain.bend > 0.0);
    let grooves = count(&|chain| !chain.is_chosen && chain.bend <= 0.0);
    let of = |(chain, end, vertex): (usize, usize, u32)| {
        let v = vertex as usize;
        if chosen[v] != 1 || graph.is_sharp(vertex) {
            return None;
        }
        let face = match [ridges[v], grooves[v]] {
            [2, 0] | [0, 2] => Some(across(surface, graph, chain, vertex)?),
            [0, 0] if surface.boundary_edges(vertex) == 1 => None,
            _ => return None,
        };
        Some(Through {
            chain,
            end,
            vertex,
            face,
        })
    };
    let rounded = graph.chains.iter().enumerate();
    let rounded = rounded.filter(|(_, chain)| chain.is_chosen && !chain.is_closed);
    let ends = rounded.flat_map(|(c, chain)| [0, 1].map(|end| (c, end, chain.ends(surface)[end])));
    ends.filter_map(of).collect()
}

/// The one face at a vertex inside the surface that is not beside the chain; there are three there.
fn across(surface: &Surface<'_>, graph: &CreaseGraph, chain: usize, v: u32) -> Option<u32> {
    let around = surface.links.outgoing.row(v as usize);
    let is_inside = around.iter().all(|&h| surface.across(h).is_some());
    let beside = graph.beside(&graph.chains[chain], surface);
    let mut faces: Vec<u32> = around.iter().map(|&h| graph.faces[h as usize / 3]).collect();
    faces.sort_unstable();
    faces.dedup();
    let is_three = is_inside && faces.len() == 3 && beside[0] != beside[1];
    faces.retain(|face| !beside.contains(face));
    (is_three && faces.len() == 1).then(|| faces[0])
}
