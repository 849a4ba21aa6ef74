//! What was done on a level of the hierarchy.

/// What was done on one level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelReport {
    /// Vertices of the region on this level: free and boundary.
    pub vertices: usize,
    /// Triangles of the region on this level.
    pub triangles: usize,
    /// Updates of the mesh.
    pub updates: usize,
    /// The harmonic defect at the end.
    pub defect: f64,
}
