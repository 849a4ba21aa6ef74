//! A mesh as a file has it: polygons, and the triangles that the solver wants.

use crate::bounds::Bounds;
use crate::failure::Malformed;

/// What a mesh file says about the shape, as the solver wants it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Geometry {
    /// One per vertex, in the file's order.
    pub positions: Vec<[f64; 3]>,
    /// The polygons as fans of triangles, in the file's order.
    pub triangles: Vec<[u32; 3]>,
    /// The polygon of each triangle; None if polygons and triangles are the same.
    polygon_of: Option<Vec<u32>>,
    /// Number of polygons in the file.
    pub polygon_count: usize,
    /// The largest vertex number used and where, to be checked when all vertices are known.
    largest: (u32, usize),
}

impl Geometry {
    /// Of triangles alone.
    pub fn of_triangles(positions: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Self {
        Self {
            positions,
            polygon_count: triangles.len(),
            triangles,
            ..Self::default()
        }
    }

    /// The box around all faces.
    pub fn bounds(&self) -> Bounds {
        Bounds::of(&self.positions, &self.triangles)
    }

    /// Adds a polygon found at byte `at`. Fewer than three corners: a polygon without triangles.
    pub(super) fn push_polygon(&mut self, corners: &[u32], at: usize) {
        let polygon = self.polygon_count as u32;
        if corners.len() != 3 && self.polygon_of.is_none() {
            self.polygon_of = Some((0..polygon).collect());
        }
        for pair in corners.get(1..).unwrap_or_default().windows(2) {
            self.triangles.push([corners[0], pair[0], pair[1]]);
            if let Some(polygon_of) = &mut self.polygon_of {
                polygon_of.push(polygon);
            }
        }
        for &corner in corners {
            if corner >= self.largest.0 {
                self.largest = (corner, at);
            }
        }
        self.polygon_count += 1;
    }

    /// A vertex number of a face as the file has it, 0-based.
    pub(super) fn corner(index: i64, at: usize, by_line: bool) -> Result<u32, Malformed> {
        u32::try_from(index).map_err(|_| Malformed {
            at,
            by_line,
            what: format!("a face names vertex {index}, which cannot exist"),
        })
    }

    /// All faces name vertices that exist.
    pub(super) fn check(&self, by_line: bool) -> Result<(), Malformed> {
        let (index, at) = self.largest;
        if self.polygon_count > 0 && index as usize >= self.positions.len() && self.has_corners() {
            let count = self.positions.len();
            let what =
                format!("a face names vertex {index} (counted from 0), but there are only {count} vertices");
            return Err(Malformed { at, by_line, what });
        }
        Ok(())
    }

    /// Whether any polygon has a corner: `largest` means nothing otherwise.
    fn has_corners(&self) -> bool {
        self.largest != (0, 0) || !self.triangles.is_empty()
    }

    /// The file's own number of the polygon that a triangle belongs to.
    pub fn polygon_of(&self, triangle: usize) -> usize {
        let polygon = self.polygon_of.as_ref().and_then(|of| of.get(triangle));
        polygon.map_or(triangle, |&polygon| polygon as usize)
    }

    /// The first triangle of every polygon that has at least three corners.
    pub fn first_triangles(&self) -> Vec<usize> {
        let is_first = |t: &usize| *t == 0 || self.polygon_of(*t) != self.polygon_of(*t - 1);
        (0..self.triangles.len()).filter(is_first).collect()
    }

    /// The corners of every polygon that has at least three.
    pub fn polygons(&self) -> Vec<Vec<u32>> {
        let mut polygons: Vec<Vec<u32>> = Vec::new();
        let mut last = None;
        for (t, &[a, b, c]) in self.triangles.iter().enumerate() {
            let polygon = self.polygon_of(t);
            match polygons.last_mut() {
                Some(corners) if last == Some(polygon) => corners.push(c),
                _ => polygons.push(vec![a, b, c]),
            }
            last = Some(polygon);
        }
        polygons
    }
}

/// Vertex or face: what a selection stored in a file belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Vertex,
    Face,
}
