//! Where bands fade out: chains end there and no other one goes on, nor is there a face or a boundary to run out to, or their corner stays sharp.

use super::corners::next_crease;
use super::crease_graph::{Chain, CreaseGraph};
use super::surface::Surface;
use super::through::Through;

/// Over so many widths a band fades out.
/// Half or double, of 13 solids cut from each other: none changes.
const FADE: f64 = 2.0;
/// Two bands on one face take at most this part of what is between their creases each: of the distance, and of the angle where both fade out.
/// Half or double, of 13 solids cut from each other: all stay sound, with 4 % more vertices or 1 % fewer.
pub(super) const SHARE: f64 = 0.42;

pub(super) struct Ends<'a> {
    surface: &'a Surface<'a>,
    graph: &'a CreaseGraph,
    /// Per vertex how many chains that are rounded end there.
    meet: Vec<u32>,
    /// Per half-edge.
    is_crease: Vec<bool>,
}

impl<'a> Ends<'a> {
    pub(super) fn new(surface: &'a Surface<'a>, graph: &'a CreaseGraph) -> Self {
        let mut of = Self {
            surface,
            graph,
            meet: vec![0; surface.x.len()],
            is_crease: vec![false; surface.half_edges() as usize],
        };
        for chain in &graph.chains {
            for &h in &chain.half_edges {
                let both = [Some(h), surface.across(h)];
                both.into_iter()
                    .flatten()
                    .for_each(|h| of.is_crease[h as usize] = true);
            }
            if chain.is_chosen && !chain.is_closed {
                let ends = chain.ends(surface);
                ends.into_iter().for_each(|v| of.meet[v as usize] += 1);
            }
        }
        of
    }

    /// By how much the width of a chain's band grows per length from its beginning and from its end on, where the band fades out.
    pub(super) fn slopes(&self, chain: &Chain, through: &[Through]) -> [Option<f64>; 2] {
        let surface = self.surface;
        let last = chain.half_edges[chain.half_edges.len() - 1];
        // Half-edges that leave the corner and arrive there.
        let ways = [
            (Some(chain.half_edges[0]), surface.across(chain.half_edges[0])),
            (surface.across(last), Some(last)),
        ];
        let ends = chain.ends(surface);
        [0, 1].map(|k| {
            let v = ends[k] as usize;
            let meets = self.meet[v] > 1 && self.surface.boundary_edges(ends[k]) == 0;
            let goes_on = meets || through.iter().any(|of| of.vertex == ends[k]);
            let fades = !goes_on || self.graph.is_sharp(ends[k]);
            (fades && !chain.is_closed).then(|| self.slope(ends[k], ways[k]))
        })
    }

    fn slope(&self, v: u32, (leaves, arrives): (Option<u32>, Option<u32>)) -> f64 {
        let mut slope = 1.0 / FADE;
        let around = self.surface.links.outgoing.row(v as usize);
        for &g in around.iter().filter(|g| self.is_crease[**g as usize]) {
            let is_crease = |h: u32| self.is_crease[h as usize];
            if let Some((next, angle)) = next_crease(self.surface, &is_crease, g)
                && (leaves == Some(g) || arrives == Some(next))
            {
                slope = slope.min(libm::tan((SHARE * angle).min(1.0)));
            }
        }
        slope
    }
}
