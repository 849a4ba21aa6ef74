//! A picture of a mesh with the numbers of its boundary loops.

use fairmesh::BoundaryLoop;

use crate::failure::Failure;
use crate::formats::Geometry;
use crate::picture::{self, Group, Label, Layout, PictureOptions, Shading, View};

/// The faces beside loops in another colour, and the numbers of those that are seen: from a direction, or from the usual one and from behind.
pub fn numbered(
    geometry: &Geometry,
    loops: &[BoundaryLoop],
    direction: Option<[f64; 3]>,
) -> Result<Vec<u8>, Failure> {
    let usual = PictureOptions::default().direction;
    let directions = match direction {
        Some(direction) => vec![direction],
        None => vec![usual, usual.map(|c| -c)],
    };
    let marked = beside(geometry, loops);
    let view = View {
        positions: &geometry.positions,
        triangles: &geometry.triangles,
        shading: Shading::Marked(&marked),
        focus: &[],
    };
    let at = |v: &u32| geometry.positions[*v as usize];
    let label = |(number, of): (usize, &BoundaryLoop)| Label {
        text: number.to_string(),
        points: of.vertices.iter().map(at).collect(),
    };
    let labels: Vec<Label> = loops.iter().enumerate().map(label).collect();
    let tiles = directions.iter().flat_map(|&direction| {
        picture::tiles(&Group {
            views: std::slice::from_ref(&view),
            options: &PictureOptions {
                direction,
                ..PictureOptions::default().with_axes()
            },
            framed: &[],
            labels: &labels,
        })
    });
    let layout = Layout {
        columns: directions.len(),
        ..Layout::default()
    };
    picture::sheet(&tiles.collect::<Vec<_>>(), &layout)
}

/// Whether each triangle has two vertices on loops.
fn beside(geometry: &Geometry, loops: &[BoundaryLoop]) -> Vec<bool> {
    let mut is_on = vec![false; geometry.positions.len()];
    let vertices = loops.iter().flat_map(|of| &of.vertices);
    vertices.for_each(|&v| is_on[v as usize] = true);
    let count = |t: &[u32; 3]| t.iter().filter(|&&v| is_on[v as usize]).count();
    geometry.triangles.iter().map(|t| count(t) > 1).collect()
}
