//! The gradient-corrected fit at one vertex with a closed ring, apart from any batch.

use super::curvature::{Curvature, FLAP_WEIGHT, gradient_corrected};
use super::normals::max_normal;
use super::ring_edges::{RingEdge, measure};
use super::simd::{Simd, Vec3};

/// Ring and flaps of a vertex; filled again for the next one.
#[derive(Debug, Default)]
pub(super) struct SingleRing {
    pub ring: Vec<RingEdge<1>>,
    flaps: Vec<(Vec3<1>, Simd<1>)>,
}

impl SingleRing {
    /// Takes the edges to the neighbours, counter-clockwise, each with the vector to its flap, if there is one.
    pub(super) fn fill(&mut self, edges: impl Iterator<Item = (Vec3<1>, Option<Vec3<1>>)>) {
        self.ring.clear();
        self.flaps.clear();
        for (edge, flap) in edges {
            self.ring.push(RingEdge {
                edge,
                ..RingEdge::zero()
            });
            let missing = (edge, Simd::zero());
            let sample = flap.map_or(missing, |flap| (flap, Simd::splat(FLAP_WEIGHT)));
            self.flaps.push(sample);
        }
        measure(&mut self.ring);
    }

    /// Curvature and normal, with this tilt ridge.
    pub(super) fn fit(&self, tilt_ridge: f64) -> Curvature<1> {
        let n = max_normal(&self.ring);
        gradient_corrected::<1, false>(&n, &self.ring, &self.flaps, tilt_ridge)
    }
}
