//! The creases of the surroundings that arrive at loops.

use super::surroundings::Surroundings;
use crate::fairing::{BoundaryCrease, Options, creases_around, may_be_creased};

impl Surroundings {
    /// The creases at the loops.
    pub(super) fn creases(&self, options: &Options) -> Vec<BoundaryCrease> {
        let positions = self.positions();
        creases_around((&positions, &self.triangles), self.is_boundary(), options)
    }

    /// Whether an edge at the loops bends so much that it may be one of them.
    pub(super) fn may_be_creased(&self, options: &Options) -> bool {
        let positions = self.positions();
        let mesh = (&positions[..], &self.triangles[..]);
        options.asks_sharp() && may_be_creased(mesh, self.is_boundary(), options)
    }

    fn positions(&self) -> Vec<[f64; 3]> {
        self.x.iter().map(|&p| p.into()).collect()
    }

    fn is_boundary(&self) -> Vec<bool> {
        (0..self.x.len()).map(|v| v < self.loop_vertices).collect()
    }
}
