//! Which vertices of a mesh may move.

/// Which vertices may move.
#[derive(Debug, Clone, Copy)]
pub enum Selection<'a> {
    /// One entry per vertex, true: free.
    Mask(&'a [bool]),
    /// The free vertices, in any order, repeats allowed.
    Vertices(&'a [u32]),
    /// Selected triangles: free are the vertices all of whose triangles are selected and that are not on
    /// the boundary of the mesh.
    Faces(&'a [u32]),
}
