//! Which creases end at which vertices.

use std::collections::BTreeMap;

use super::crease_graph::{Chain, CreaseGraph};
use super::surface::Surface;

/// An end of a chain that is not closed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct End {
    pub(super) chain: usize,
    /// 0 at the chain's beginning, 1 at its end.
    pub(super) end: usize,
}

impl End {
    pub(super) fn chain(self, graph: &CreaseGraph) -> &Chain {
        &graph.chains[self.chain]
    }

    /// The half-edge along the chain that starts there.
    pub(super) fn leaves(self, surface: &Surface<'_>, graph: &CreaseGraph) -> Option<u32> {
        let all = &self.chain(graph).half_edges;
        match self.end {
            0 => all.first().copied(),
            _ => all.last().and_then(|&h| surface.across(h)),
        }
    }
}

/// The ends at one vertex.
pub(super) struct Meeting {
    pub(super) vertex: u32,
    /// Of chains that are rounded.
    pub(super) rounded: Vec<End>,
    /// Of the others.
    pub(super) others: Vec<End>,
}

impl Meeting {
    /// Whether all of these bend the same way.
    pub(super) fn are_alike<'e>(graph: &CreaseGraph, ends: impl IntoIterator<Item = &'e End>) -> bool {
        let mut ridges = ends.into_iter().map(|end| end.chain(graph).bend > 0.0);
        let first = ridges.next();
        ridges.all(|is_ridge| Some(is_ridge) == first)
    }
}

/// All vertices at which chains end, ascending, but those corners that stay sharp.
pub(super) fn meetings(surface: &Surface<'_>, graph: &CreaseGraph) -> Vec<Meeting> {
    let mut all: BTreeMap<u32, Meeting> = BTreeMap::new();
    let chains = graph.chains.iter().enumerate();
    for (number, chain) in chains.filter(|(_, chain)| !chain.is_closed) {
        for (end, vertex) in chain.ends(surface).into_iter().enumerate() {
            let at = all.entry(vertex).or_insert_with(|| Meeting {
                vertex,
                rounded: Vec::new(),
                others: Vec::new(),
            });
            let ends = if chain.is_chosen {
                &mut at.rounded
            } else {
                &mut at.others
            };
            ends.push(End { chain: number, end });
        }
    }
    let round = all.into_values().filter(|at| !graph.is_sharp(at.vertex));
    round.collect()
}
