//! Regions around something that become larger step by step, each with its fair surface: the candidates for a bump.

use std::ops::RangeInclusive;

use fairmesh_linear::interrupt::is_stopped;

use super::fair_region::{Faired, Heights};
use super::nested::Nested;

// Figures of constants: as in bump.rs.

/// Growth of the radius from region to region. Half of it: 1.30, 1.00, 2.40, 1.19; double: 1.86, 1.04, 1.21, 1.27, and three more
/// are not found.
const STEP: f64 = 1.12;
/// Regions with fewer free vertices say nothing. Half: the same; double: one more is not found.
const LEAST: usize = 8;
/// No region has more than this part of the surface that the seed lies on. At a third or two thirds: the same, but at a third a bump on half of a
/// sheet is not found, and at two thirds one on a scan takes sixty times as much.
const MOST: f64 = 0.5;
/// Around a region normals have at least this part in common: beneath one whose surroundings face all sides, as beneath the top of a
/// cube, a dome is no surface that was there. Half: 1.01, 1.04, 1.52, 1.15, but half of a head is a bump; double:
/// 1.40, 1.04, 1.61, 1.53.
const FACING: f64 = 0.25;

/// A region that may be the bump's.
pub(super) struct Candidate {
    /// Its radius around the source.
    pub radius: f64,
    pub triangles: Vec<u32>,
    pub heights: Heights,
    /// Of its fair surface, but for noise,
    pub disagreement: f64,
    /// and with it.
    pub uncertainty: f64,
    /// Whether there was enough of a surface to see that larger ones are no better. Where not, it may still tell what stands out.
    pub is_settled: bool,
    /// Whether the surface ends in it: there nothing moves.
    pub meets_an_end: bool,
}

/// Whether heights still grow as fast as the radii of regions: beyond the last one the bump goes on.
pub(super) fn are_rising(known: &[Candidate]) -> bool {
    match known {
        [.., before, last] => last.heights.rms >= STEP * before.heights.rms,
        _ => true,
    }
}

/// Regions ever larger, with their fair surfaces.
pub(super) struct Growth<'n, 'm> {
    around: &'n Nested<'m>,
    /// How their surfaces continue the surroundings' curvature.
    continuity: f64,
    /// Of the next one, and the largest that is asked for.
    radius: f64,
    largest: f64,
    last: Option<(f64, Faired)>,
}

impl<'n, 'm> Growth<'n, 'm> {
    /// Regions around it within these radii.
    pub(super) fn new(around: &'n Nested<'m>, within: RangeInclusive<f64>, continuity: f64) -> Self {
        Self {
            around,
            continuity,
            radius: *within.start(),
            largest: *within.end(),
            last: None,
        }
    }

    /// The next one, compared with the one after it; none once that is too large. Tells which part of the largest there may be it has.
    pub(super) fn next(&mut self, tell: &mut dyn FnMut(f64)) -> Option<Candidate> {
        let around = self.around;
        let most = (MOST * around.reached() as f64) as usize;
        // One region more than is asked for, which the largest is compared with.
        while self.radius <= STEP * self.largest && !is_stopped() {
            let radius = self.radius;
            let region = around.within(radius);
            let free = region.free();
            if free > most || around.is_all_within(radius) {
                break;
            }
            self.radius *= STEP;
            tell((free as f64 / most as f64).min(1.0));
            let is_alike = self.last.as_ref().is_some_and(|(_, last)| last.free() == free);
            if free < LEAST || region.facing() < FACING || is_alike {
                continue;
            }
            let Some(next) = region.faired(self.continuity) else {
                continue;
            };
            let Some((of_radius, of)) = self.last.replace((radius, next)) else {
                continue;
            };
            let apart = self.last.as_ref().map(|(_, next)| of.disagreement(next));
            let [disagreement, uncertainty] = apart.unwrap_or([f64::MAX; 2]);
            let heights = of.heights(|v| around.vertex(v));
            if heights.are_rounding() {
                continue;
            }
            return Some(Candidate {
                radius: of_radius,
                triangles: around.named(&of.triangles),
                heights,
                disagreement,
                uncertainty,
                is_settled: true,
                meets_an_end: of.meets_an_end,
            });
        }
        None
    }
}
