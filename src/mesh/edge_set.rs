//! Edges by their vertices, whichever is named first.

/// Some edges of a mesh.
pub(crate) struct EdgeSet {
    /// Ascending, the smaller vertex of each first.
    edges: Vec<[u32; 2]>,
}

impl EdgeSet {
    pub(crate) fn new(edges: &[[u32; 2]]) -> Self {
        let mut edges: Vec<[u32; 2]> = edges.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
        edges.sort_unstable();
        edges.dedup();
        Self { edges }
    }

    /// Those of the edges that a question is answered with yes for.
    pub(crate) fn retain(&mut self, is_kept: impl FnMut(&[u32; 2]) -> bool) {
        self.edges.retain(is_kept);
    }

    /// The vertices of all edges, ascending, as often as there are edges at them.
    pub(crate) fn ends(&self) -> Vec<u32> {
        let mut ends: Vec<u32> = self.edges.iter().flatten().copied().collect();
        ends.sort_unstable();
        ends
    }

    /// Whether there is an edge between two vertices.
    pub(crate) fn has(&self, a: u32, b: u32) -> bool {
        self.edges.binary_search(&[a.min(b), a.max(b)]).is_ok()
    }
}
