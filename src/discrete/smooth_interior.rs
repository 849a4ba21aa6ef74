//! Fixed vertices inside the region that the surface passes smoothly: points and curves that are interpolated in position
//! only (the paper's future work, section 8). Normal and `H` there are those of the surface at hand, by the same fit as
//! at free vertices, so that nothing is prescribed but the place: `H` is continuous across, its flux need not be.

use nalgebra::Vector3;
use rayon::prelude::*;

use super::curvature::{FLAP_WEIGHT, gradient_corrected};
use super::equations::{Equations, FreeCurvature, State};
use super::normals::{cross_product_normal, max_normal};
use super::ring_edges::{RingEdge, measure};
use super::simd::{Simd, Vec3, lane, one};
use crate::mesh::NONE;

/// Room for one closed ring.
#[derive(Debug, Default)]
struct RingRoom {
    ring: Vec<RingEdge<1>>,
    flaps: Vec<(Vec3<1>, Simd<1>)>,
}

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
        normal
            .par_iter_mut()
            .zip(h)
            .with_min_len(64)
            .enumerate()
            .for_each_init(RingRoom::default, |room, (b, (normal, h))| {
                if self.is_smooth_interior(b) {
                    (*normal, *h) = self.smooth_fit(x, b, room);
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
            self.smooth_fit(x, b, &mut RingRoom::default()).1
        } else {
            self.boundary_curvature(x, corrected, b)
        }
    }

    /// Normal and `H` of the surface at boundary vertex `b`, which has a closed ring. The paper's discretization has no
    /// `H` without the neighbours' normals: it is 0 here.
    fn smooth_fit(&self, x: &[Vector3<f64>], b: usize, room: &mut RingRoom) -> (Vector3<f64>, f64) {
        let rings = self.rings;
        let q = x[self.free() + b];
        let triangles = rings.boundary_triangles(b);
        let flaps = &rings.boundary_flap[rings.boundary_triangle.range(b)];
        let to = |j: u32| one(&(x[j as usize] - q));
        room.ring.clear();
        room.ring.extend(triangles.iter().map(|&[j, _]| RingEdge {
            edge: to(j),
            ..RingEdge::zero()
        }));
        measure(&mut room.ring);
        let FreeCurvature::GradientCorrected { tilt_ridge } = self.curvature else {
            return (lane(&cross_product_normal(&room.ring), 0), 0.0);
        };
        room.flaps.clear();
        room.flaps
            .extend(triangles.iter().zip(flaps).map(|(&[j, _], &flap)| match flap {
                NONE => (to(j), Simd([0.0])),
                flap => (to(flap), Simd([FLAP_WEIGHT])),
            }));
        let n = max_normal(&room.ring);
        let fit = gradient_corrected::<1, false>(&n, &room.ring, &room.flaps, tilt_ridge);
        (lane(&fit.normal, 0), fit.h.0[0])
    }
}
