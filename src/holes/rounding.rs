//! A patch in the numbers that it will be written in.

use nalgebra::Vector3;

use super::creases::creases;
use super::patch::Patch;
use super::surroundings::Surroundings;
use crate::fairing::{Outcome, OutputPrecision, Report};
use crate::quality::{NEEDLE, smallest_angle};

/// A patch with all its vertices rounded, in the frame of the surroundings.
pub(super) struct Rounded<'a> {
    patch: &'a Patch,
    around: &'a Surroundings,
    x: Vec<Vector3<f64>>,
}

impl<'a> Rounded<'a> {
    pub(super) fn new(patch: &'a Patch, around: &'a Surroundings, precision: OutputPrecision) -> Self {
        let round = |p| around.place(precision.round(around.leave(p)));
        Self {
            patch,
            around,
            x: patch.x.iter().map(round).collect(),
        }
    }

    fn angle(&self, t: &[u32; 3]) -> f64 {
        smallest_angle(&t.map(|v| self.x[v as usize]))
    }

    /// The smallest angle in degrees.
    pub(super) fn worst_angle(&self) -> f64 {
        let angles = self.patch.triangles.iter().map(|t| self.angle(t));
        angles.fold(f64::INFINITY, f64::min)
    }

    /// Whether rounding turns a triangle over.
    fn is_flipped(&self, t: &[u32; 3]) -> bool {
        let cross = |x: &[Vector3<f64>]| {
            let [a, b, c] = t.map(|v| x[v as usize]);
            (b - a).cross(&(c - a))
        };
        let side = cross(&self.x).dot(&cross(&self.patch.x));
        side < 0.0 || side.is_nan()
    }

    /// The report of a fairing that ended with this patch before it was rounded; boundary normals that were given, by
    /// vertex, ascending.
    pub(super) fn tell(&self, report: &mut Report, given: &[(u32, [f64; 3])]) {
        let known = self.around.triangles.len() as u32;
        let quality = &mut report.quality;
        quality.worst_angle = f64::INFINITY;
        for (id, t) in (known..).zip(&self.patch.triangles) {
            if t.iter().all(|&v| (v as usize) < self.patch.fixed) {
                continue;
            }
            let angle = self.angle(t);
            if angle < quality.worst_angle {
                (quality.worst_angle, quality.worst_triangle) = (angle, id as usize);
            }
            add(&mut quality.needles, id, angle < NEEDLE);
            add(&mut quality.flipped, id, self.is_flipped(t));
        }
        let was_sound = !matches!(report.outcome, Outcome::ConvergedPoorTriangles { .. });
        let is_met = report.outcome.is_tolerance_met();
        if is_met && was_sound && !report.quality.is_sound() {
            let triangles = report.quality.poor();
            report.outcome = Outcome::PoorWhenRounded { triangles };
        }
        if matches!(
            report.outcome,
            Outcome::Converged | Outcome::ConvergedLoosely { .. } | Outcome::NearestMember { .. }
        ) {
            let vertices = creases(self.patch, &self.x, self.around, given);
            if !vertices.is_empty() {
                report.outcome = Outcome::BoundaryCrease { vertices };
            }
        }
        if let [only] = &mut report.components[..] {
            only.outcome = report.outcome.clone();
            only.quality = report.quality.clone();
        }
    }
}

/// Adds a number to an ascending list, once.
fn add(list: &mut Vec<u32>, id: u32, is_one: bool) {
    if is_one && let Err(at) = list.binary_search(&id) {
        list.insert(at, id);
    }
}
