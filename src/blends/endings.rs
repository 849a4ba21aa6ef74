//! All ends of creases at which blends do not fade out.

use super::crease_graph::CreaseGraph;
use super::legs::Way;
use super::meetings::End;
use super::mitres::{Mitre, mitres};
use super::surface::Surface;
use super::through::{Through, through};

pub(super) struct Endings {
    pub(super) through: Vec<Through>,
    pub(super) mitres: Vec<Mitre>,
}

impl Endings {
    pub(super) fn new(surface: &Surface<'_>, graph: &CreaseGraph) -> Self {
        Self {
            through: through(surface, graph),
            mitres: mitres(surface, graph),
        }
    }

    /// The ends whose rails go straight on there.
    pub(super) fn ends(&self) -> impl Iterator<Item = End> {
        let mitred = self.mitres.iter().flat_map(|of| of.ends);
        self.through.iter().map(|of| of.at).chain(mitred)
    }

    /// The corners around which there are creases, and the lines that these stand for.
    pub(super) fn creases(&self) -> Vec<(u32, [Way; 2])> {
        let across = self.through.iter().filter(|of| of.face.is_some());
        let across = across.map(|of| (of.vertex, of.ways()));
        let mitred = self.mitres.iter().map(|of| (of.vertex, of.ways()));
        across.chain(mitred).collect()
    }

    /// The same with corners of the boundary.
    pub(super) fn lines(&self) -> Vec<(u32, [Way; 2])> {
        let out = self.through.iter().filter(|of| of.face.is_none());
        let mut lines = self.creases();
        lines.extend(out.map(|of| (of.vertex, of.ways())));
        lines
    }
}
