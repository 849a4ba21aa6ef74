//! Where chains end and no other one goes on.

use super::crease_graph::{Chain, CreaseGraph};
use super::surface::Surface;

pub(super) struct Ends {
    /// Per vertex how many chains that are rounded end there.
    meet: Vec<u32>,
    is_boundary: Vec<bool>,
}

impl Ends {
    pub(super) fn new(surface: &Surface<'_>, graph: &CreaseGraph) -> Self {
        let mut of = Self {
            meet: vec![0; surface.x.len()],
            is_boundary: vec![false; surface.x.len()],
        };
        for chain in graph
            .chains
            .iter()
            .filter(|chain| chain.is_chosen && !chain.is_closed)
        {
            chain
                .ends(surface)
                .into_iter()
                .for_each(|v| of.meet[v as usize] += 1);
        }
        for h in (0..surface.half_edges()).filter(|&h| surface.across(h).is_none()) {
            of.is_boundary[surface.origin(h) as usize] = true;
        }
        of
    }

    /// At which ends of a chain its band fades out.
    pub(super) fn fade(&self, chain: &Chain, surface: &Surface<'_>) -> [bool; 2] {
        let is_alone = |v: u32| self.meet[v as usize] == 1 || self.is_boundary[v as usize];
        chain.ends(surface).map(|v| !chain.is_closed && is_alone(v))
    }
}
