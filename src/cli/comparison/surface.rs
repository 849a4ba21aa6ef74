//! A mesh as it was or has become.

use crate::bounds::Bounds;
use crate::formats::Geometry;

pub type V3 = [f64; 3];

/// A mesh as it was or has become.
#[derive(Clone, Copy)]
pub struct MeshSide<'a> {
    pub positions: &'a [V3],
    pub triangles: &'a [[u32; 3]],
}

impl MeshSide<'_> {
    pub(super) fn corners(&self, t: usize) -> [V3; 3] {
        self.triangles[t].map(|v| self.positions[v as usize])
    }

    /// The box around some triangles.
    pub(super) fn bounds(&self, is_in: impl Fn(usize) -> bool) -> Bounds {
        let some = self.triangles.iter().enumerate().filter(|(t, _)| is_in(*t));
        Bounds::of(self.positions, some.map(|(_, t)| t))
    }

    /// The vertices of some triangles.
    pub(super) fn vertices_of(&self, marked: &[bool]) -> Vec<bool> {
        let mut is_in = vec![false; self.positions.len()];
        for (t, _) in self.triangles.iter().zip(marked).filter(|(_, marked)| **marked) {
            t.iter().for_each(|&v| is_in[v as usize] = true);
        }
        is_in
    }
}

impl Geometry {
    /// The triangles of a file.
    pub fn surface(&self) -> MeshSide<'_> {
        MeshSide {
            positions: &self.positions,
            triangles: &self.triangles,
        }
    }
}
