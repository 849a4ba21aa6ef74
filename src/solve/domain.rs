//! The region that a problem is solved on, in its own centred and scaled frame.

use nalgebra::Vector3;

use crate::discrete::valence_batches::ValenceBatches;
use crate::mesh::{RegionMesh, Rings};

/// Triangles of a larger distortion are stretched, to twice their width: where most are, they have their shapes on purpose, and uniform weights
/// fold some. Of 265 bands of stretched triangles 18 fail without, 10 with; of 2,031 regions of 94 public meshes 4 more succeed. Half, 0: one of
/// the regions fewer succeeds; double: of 177 of the bands one fewer, and of the regions one.
const STRETCHED: f64 = 0.25;

/// The region and what is made of its connectivity once.
#[derive(Debug, Clone)]
pub(crate) struct Domain {
    /// The region.
    pub region: RegionMesh,
    /// Its rings.
    pub rings: Rings,
    /// The same, transposed.
    pub batches: ValenceBatches,
    /// The given positions (free, boundary, outside).
    pub input: Vec<Vector3<f64>>,
    /// On a coarse mesh the lengths of the edges of the region's triangles, from each corner to the next, in the metric that spreads the
    /// vertices of the fine mesh; else all edges are alike in it.
    pub lengths: Option<Vec<[f64; 3]>>,
}

impl Domain {
    /// Makes the rings of a region with these positions.
    pub(crate) fn new(region: RegionMesh, input: Vec<Vector3<f64>>) -> Self {
        let rings = Rings::new(&region);
        Self {
            batches: ValenceBatches::new(&rings),
            region,
            rings,
            input,
            lengths: None,
        }
    }

    /// The same with these positions of the fixed vertices (boundary, outside).
    pub(crate) fn with_fixed(&self, fixed: &[Vector3<f64>]) -> Self {
        let mut moved = self.clone();
        moved.input[self.region.free..].copy_from_slice(fixed);
        moved
    }

    /// The same with the lengths of a coarse mesh.
    pub(crate) fn with_lengths(self, lengths: Vec<[f64; 3]>) -> Self {
        Self {
            lengths: Some(lengths),
            ..self
        }
    }

    /// The given surface of the region (free, boundary).
    pub(crate) fn surface(&self) -> &[Vector3<f64>] {
        &self.input[..self.region.region_vertices()]
    }

    /// Whether most triangles of the input are stretched.
    pub(crate) fn is_stretched(&self) -> bool {
        let x = self.surface();
        let triangles = self.region.triangles();
        let corners = |t: &[u32; 3]| t.map(|v| x[v as usize]);
        let stretched = triangles.iter().filter(|t| distortion(&corners(t)) > STRETCHED);
        2 * stretched.count() > triangles.len()
    }
}

/// The conformal distortion of an equilateral triangle into this one: the mean of what it is stretched by and of its inverse, less 1.
fn distortion([a, b, c]: &[Vector3<f64>; 3]) -> f64 {
    let squares = (b - a).norm_squared() + (c - b).norm_squared() + (a - c).norm_squared();
    squares / (2.0 * 3f64.sqrt() * (b - a).cross(&(c - a)).norm()) - 1.0
}
