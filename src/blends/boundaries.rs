//! The boundary of the surface: bands end before it, but where their creases do.

use std::collections::BTreeSet;

use nalgebra::Vector3;
use rstar::RTree;
use rstar::primitives::{GeomWithData, Line};

use super::crease_ends::TURN;
use super::crease_graph::CreaseGraph;
use super::surface::Surface;
use crate::mesh::halfedge::previous;

/// An edge of the boundary, by its half-edge.
type Edge = GeomWithData<Line<[f64; 3]>, u32>;

pub(super) struct Boundaries {
    tree: RTree<Edge>,
    /// Edges on which creases end, with the number of the crease, and those that go straight on there.
    own: BTreeSet<(u32, u32)>,
}

impl Boundaries {
    pub(super) fn new(surface: &Surface<'_>, graph: &CreaseGraph) -> Self {
        let all = (0..surface.half_edges()).filter(|&h| surface.across(h).is_none());
        let line = |h: u32| {
            let ends = [surface.origin(h), surface.target(h)].map(|v| surface.x[v as usize].into());
            Edge::new(Line::new(ends[0], ends[1]), h)
        };
        let mut own = BTreeSet::new();
        let chosen = (0..).zip(&graph.chains).filter(|(_, chain)| chain.is_chosen);
        for (number, chain) in chosen {
            for v in chain.ends(surface) {
                for way in [Way::On, Way::Back] {
                    let edges = straight_on(surface, v, way);
                    own.extend(edges.into_iter().map(|h| (h, number)));
                }
            }
        }
        Self {
            tree: RTree::bulk_load(all.map(line).collect()),
            own,
        }
    }

    /// The distance from a point of a crease to the nearest edge that is not its own and `counts`, by its half-edge and the way to it; infinite if none is
    /// nearer than `most`.
    pub(super) fn distance(
        &self,
        crease: u32,
        p: &Vector3<f64>,
        most: f64,
        counts: impl Fn(u32, &Vector3<f64>) -> bool,
    ) -> f64 {
        let near = self.tree.locate_within_distance((*p).into(), most * most);
        let ways = near.filter(|edge| !self.own.contains(&(edge.data, crease)));
        let ways = ways.map(|edge| {
            (
                edge.data,
                Vector3::from(edge.geom().nearest_point(&(*p).into())) - p,
            )
        });
        let counting = ways.filter(|(h, to)| counts(*h, to)).map(|(_, to)| to.norm());
        counting.fold(f64::INFINITY, f64::min)
    }
}

/// Which way along the boundary.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Way {
    On,
    Back,
}

/// The edges of the boundary from a vertex, as far as they turn little.
fn straight_on(surface: &Surface<'_>, v: u32, way: Way) -> Vec<u32> {
    let (mut edges, mut at) = (Vec::new(), v);
    while let Some(h) = step(surface, at, way) {
        let [first, here] = [edges.first().copied().unwrap_or(h), h].map(|h| surface.edge(h));
        if first.dot(&here) < TURN * first.norm() * here.norm() {
            break;
        }
        edges.push(h);
        at = match way {
            Way::On => surface.target(h),
            Way::Back => surface.origin(h),
        };
        if at == v {
            break;
        }
    }
    edges
}

/// The edge of the boundary that starts at a vertex, or ends there; none where there are more.
fn step(surface: &Surface<'_>, v: u32, way: Way) -> Option<u32> {
    let around = surface.links.outgoing.row(v as usize).iter();
    let mut edges = around
        .map(|&h| if way == Way::On { h } else { previous(h) })
        .filter(|&h| surface.across(h).is_none());
    let first = edges.next();
    first.filter(|_| edges.next().is_none())
}
