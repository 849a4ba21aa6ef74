//! Vertices or faces that the user selected.

use fairmesh::Selection;

use crate::formats::{Geometry, Kind};

/// What the user selected: vertices, or faces, which are the polygons of a file or the triangles of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Selected {
    pub kind: Kind,
    pub elements: Vec<u32>,
}

impl Selected {
    /// The triangles for the polygons of a file.
    pub fn in_triangles(self, geometry: &Geometry) -> Self {
        if self.kind == Kind::Vertex {
            return self;
        }
        let mut chosen = vec![false; geometry.polygon_count];
        self.elements
            .iter()
            .for_each(|&polygon| chosen[polygon as usize] = true);
        let triangles = 0..geometry.triangles.len();
        let elements = triangles.filter(|&t| chosen[geometry.polygon_of(t)]);
        Self {
            kind: Kind::Face,
            elements: elements.map(|t| t as u32).collect(),
        }
    }

    /// The same for the library, in triangles.
    pub fn selection(&self) -> Selection<'_> {
        match self.kind {
            Kind::Vertex => Selection::Vertices(&self.elements),
            Kind::Face => Selection::Faces(&self.elements),
        }
    }
}
