//! The frame that the work is done in: the boundary's bounding box centred, its diagonal about one. The scale is a power of
//! two, so that only the translation rounds.

use nalgebra::Vector3;

use crate::mesh::RegionMesh;
use crate::solve::problem::bounding_box;

/// A centre and a unit of length.
pub(super) struct Normalization {
    centre: Vector3<f64>,
    /// Its unit of length in that of the input.
    pub scale: f64,
}

impl Normalization {
    /// The frame of a region with the positions `x` (free, boundary, outside).
    pub(super) fn new(region: &RegionMesh, x: &[Vector3<f64>]) -> Self {
        let boundary = &x[region.free..region.region_vertices()];
        let size = bounding_box(boundary);
        let (low, high) = if (size.1 - size.0).norm() > 0.0 {
            size
        } else {
            bounding_box(x)
        };
        let diagonal = (high - low).norm();
        let exponent = if diagonal > 0.0 && diagonal.is_finite() {
            libm::log2(diagonal).round()
        } else {
            0.0
        };
        Self {
            centre: low + (high - low) * 0.5,
            scale: libm::exp2(exponent),
        }
    }

    /// Takes positions into the normalization.
    pub(super) fn enter(&self, x: &mut [Vector3<f64>]) {
        for p in x {
            *p = (*p - self.centre) / self.scale;
        }
    }

    /// Takes a position back.
    pub(super) fn leave(&self, p: &Vector3<f64>) -> [f64; 3] {
        (p * self.scale + self.centre).into()
    }
}
