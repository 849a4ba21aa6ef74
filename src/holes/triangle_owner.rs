//! Whose a triangle of a filled mesh is.

/// A triangle of the mesh, or of a patch (by its place among those asked for).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Owned {
    Mesh(u32),
    Patch { of: usize, triangle: u32 },
}
