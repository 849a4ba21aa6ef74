//! What comes of rounding.

use super::crease_graph::Chain;
use super::surface::Surface;
use crate::fairing::Report;
use crate::holes::Parents;

/// A mesh with blends in place of creases.
#[derive(Debug, Clone)]
pub struct Rounded {
    /// The vertices given that are left, in their order, then the new ones.
    pub positions: Vec<[f64; 3]>,
    /// The triangles outside the blends, in the order of those that they are parts of, then the blends'.
    pub triangles: Vec<[u32; 3]>,
    /// Per vertex that is left its number before; ascending.
    pub kept_vertices: Vec<u32>,
    /// Per triangle outside the blends that of the mesh given that it is, or is a part of.
    pub kept_triangles: Vec<u32>,
    /// Where the new vertices come from: vertices of the mesh given.
    pub parents: Vec<Parents>,
    /// The vertices of the blends, without their rails; ascending.
    pub free: Vec<u32>,
    /// Edges that bend by more than so many degrees were taken for creases.
    pub angle: f64,
    /// The creases of the mesh given.
    pub chains: Vec<CreaseChain>,
    /// Corners that stay sharp, as no sound blend was found there: blends fade out towards them.
    pub sharp_corners: Vec<SharpCorner>,
    /// How the blends were faired.
    pub report: Report,
}

impl Rounded {
    /// Whether all that was asked to be rounded is, and the blends are fair.
    pub fn is_complete(&self) -> bool {
        let is_left = self.chains.iter().any(|chain| chain.unsolved.is_some());
        self.report.outcome.is_success() && !is_left && self.sharp_corners.is_empty()
    }
}

/// A corner that stays sharp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SharpCorner {
    /// The vertex of the mesh given.
    pub vertex: u32,
    /// The worst place of what was tried.
    pub place: [f64; 3],
}

/// A crease from one corner or end to the next.
#[derive(Debug, Clone, PartialEq)]
pub struct CreaseChain {
    /// Its vertices in the mesh given, one after the other; those of a closed one end with the first.
    pub vertices: Vec<u32>,
    /// By how many degrees the surface bends there, in the mean; positive where it is convex.
    pub bend: f64,
    /// Whether it was rounded.
    pub is_rounded: bool,
    /// Where there is less room than was asked for, at the narrowest place.
    pub narrowed: Option<Narrowing>,
    /// Where the worst of what was tried is, if it stays sharp as no sound blend was found.
    pub unsolved: Option<[f64; 3]>,
}

impl CreaseChain {
    /// As far as the creases of the mesh tell it.
    pub(super) fn new(chain: &Chain, surface: &Surface<'_>) -> Self {
        let first = chain.half_edges.iter().take(1).map(|&h| surface.origin(h));
        Self {
            vertices: first
                .chain(chain.half_edges.iter().map(|&h| surface.target(h)))
                .collect(),
            bend: chain.bend,
            is_rounded: chain.is_chosen,
            narrowed: None,
            unsolved: chain.unsolved.map(|place| (place + surface.centre).into()),
        }
    }
}

/// A blend is narrower than asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Narrowing {
    /// The least part of the width asked.
    pub part: f64,
    /// Where that is, on the crease.
    pub place: [f64; 3],
}
