//! How a patch is laid out before it is refined: without new vertices, or in rows between the ends of a tube.

use crate::holes::joint;
use crate::holes::patch::Patch;
use crate::holes::patch_surface::{Layout, Task};
use crate::holes::sweep::{is_long, sweep};
use crate::holes::triangulate::{Barred, Measure};

/// On short edges of the boundary, edges may be this much longer than those: triangles keep 15 degrees.
/// Of 44 cases, half: 41 change, 34 get another triangulation, +13 % iterations, 3 fail;
/// double: 32 change, 28 get another triangulation, +2 % iterations.
const BESIDE_SHORT: f64 = 1.5;
/// But they need not be shorter than this part of the edges around: one edge of nearly no length would ask for as many vertices as
/// numbers have digits, and one narrow triangle does for it.
/// Of 44 cases, half: 1 changes; double: 2 change, 2 get another triangulation.
const SHORTEST: f64 = 1.0 / 30.0;
/// The largest length of edges at a boundary vertex, by the shorter boundary edge there and the mean length around.
pub(super) fn limit(shorter: f64, size: f64) -> f64 {
    (BESIDE_SHORT * shorter).max(SHORTEST * size)
}

impl Task<'_> {
    /// One after the other, until one leads to a clean surface: which does is not known before.
    pub(super) fn layouts(&self) -> &'static [Layout] {
        match self.is_joint() {
            true if is_long(&self.surroundings.loop_set()) => &[Layout::Swept],
            true => &[Layout::Swept, Layout::First, Layout::Other],
            false => &[Layout::First],
        }
    }

    /// The patch without new vertices, and where its refinement begins.
    pub(super) fn laid_out(&self, layout: Layout) -> Option<(Patch, Patch)> {
        if layout == Layout::Swept {
            return self.swept();
        }
        let coarse = self.triangulate(layout == Layout::Other, None)?;
        Some((coarse.clone(), coarse))
    }

    /// The loops triangulated, with the sizes of their surroundings: by the bends, or otherwise. (The least area of several loops
    /// is that of a patch for each, and tubes without width between them.)
    /// Without triangles that are barred.
    pub(super) fn triangulate(&self, is_other: bool, barred: Barred<'_>) -> Option<Patch> {
        let around = self.surroundings;
        let n = around.loop_vertices;
        let measure = match (self.is_joint(), is_other) {
            (false, false) => Measure::WorstBend,
            (false, true) => Measure::Area,
            (true, false) => Measure::TotalBend,
            (true, true) => Measure::Energy,
        };
        let triangles = joint::triangulate(&around.loop_set(), measure, barred)?;
        let is_there = |t: &[u32; 3]| t.iter().all(|&v| (v as usize) < n);
        if n == 3 && around.triangles.iter().any(is_there) {
            return None;
        }
        let mut patch = Patch::new(around.x[..n].to_vec(), triangles, n);
        patch.size = around.sizes().0;
        self.bound_lengths(&mut patch);
        Some(patch)
    }

    /// Between two loops that are ends of a tube: without new vertices, and with rows of them.
    fn swept(&self) -> Option<(Patch, Patch)> {
        let around = self.surroundings;
        let sweep = sweep(&around.loop_set(), &around.sizes().0, self.factor, self.most)?;
        let (mut coarse, mut patch) = (sweep.coarse, sweep.patch);
        coarse.size = patch.size[..patch.fixed].to_vec();
        self.bound_lengths(&mut coarse);
        self.bound_lengths(&mut patch);
        Some((coarse, patch))
    }

    /// What edges at the loops may be, by those of the mesh there.
    fn bound_lengths(&self, patch: &mut Patch) {
        let shorter = self.surroundings.sizes().1;
        for (v, &shorter) in shorter.iter().enumerate() {
            patch.limit[v] = limit(shorter, patch.size[v]);
        }
        patch.range = self.surroundings.ranges();
    }
}
