//! Fixed vertices inside the region that the surface passes smoothly: points and curves that are interpolated in position
//! only (the paper's future work, section 8). Normal and `H` there are those of the surface at hand, by the same fit as
//! at free vertices, so that nothing is prescribed but the place: `H` is continuous across, its flux need not be.

use fairmesh_linear::parallel;
use nalgebra::Vector3;

use super::curvature::TILT_RIDGE;
use super::equations::{Equations, FreeCurvature, State};
use super::normals::cross_product_normal;
use super::simd::{lane, one};
use super::single_ring::SingleRing;
use crate::mesh::NONE;

impl Equations<'_> {
    /// Whether the surface passes boundary vertex `b`: fixed in position, but free in its normal.
    pub(crate) fn is_smooth_interior(&self, b: usize) -> bool {
        self.smooth_interior.get(b).is_some_and(|&p| p)
    }

    /// Normals and, but for the paper's discretization, `H` at the boundary vertices that the surface passes; the
    /// prescribed normals at the others.
    pub(super) fn boundary_normals_at(&self, x: &[Vector3<f64>], state: &mut State) {
        let free = self.free();
        let (_, h) = state.h.split_at_mut(free);
        let (_, normal) = state.corrected.split_at_mut(free);
        normal.copy_from_slice(self.boundary_normals);
        if self.smooth_interior.is_empty() {
            return;
        }
        let pieces = normal.chunks_mut(64).zip(h.chunks_mut(64));
        parallel::for_each(pieces, |piece, (normal, h)| {
            let mut ring = SingleRing::default();
            for (k, (normal, h)) in normal.iter_mut().zip(h).enumerate() {
                let b = 64 * piece + k;
                if self.is_smooth_interior(b) {
                    (*normal, *h) = self.smooth_fit(x, b, &mut ring);
                }
            }
        });
    }

    /// `H` at boundary vertex `b`, whether its normal is prescribed or not.
    pub(crate) fn boundary_curvature_of_any(
        &self,
        x: &[Vector3<f64>],
        corrected: &[Vector3<f64>],
        b: usize,
    ) -> f64 {
        if self.is_smooth_interior(b) && self.curvature != FreeCurvature::Paper {
            self.smooth_fit(x, b, &mut SingleRing::default()).1
        } else {
            self.boundary_curvature(x, corrected, b)
        }
    }

    /// Normal and `H` of the surface at boundary vertex `b`, which has a closed ring. The paper's discretization has no
    /// `H` without the neighbours' normals: it is 0 here.
    fn smooth_fit(&self, x: &[Vector3<f64>], b: usize, ring: &mut SingleRing) -> (Vector3<f64>, f64) {
        let rings = self.rings;
        let q = x[self.free() + b];
        let triangles = rings.boundary_triangles(b);
        let flaps = &rings.boundary_flap[rings.boundary_triangle.range(b)];
        let to = |j: u32| one(&(x[j as usize] - q));
        let edges = triangles.iter().zip(flaps);
        ring.fill(edges.map(|(&[j, _], &flap)| (to(j), (flap != NONE).then(|| to(flap)))));
        if self.curvature != FreeCurvature::GradientCorrected {
            return (lane(&cross_product_normal(&ring.ring), 0), 0.0);
        }
        let fit = ring.fit(TILT_RIDGE);
        (lane(&fit.normal, 0), fit.h.0[0])
    }
}
