//! Where the surface does not run on smoothly from the outside: creases along the boundary.
//!
//! A *kink* is the angle between the surface's two sides at a boundary vertex: between the sum of the cross products of the
//! region's triangles there and that of the triangles outside; where nothing is outside, between the former and the
//! boundary normal. What is asked has a kink, too: the angle between the boundary normal and the outside, which is small where
//! normals are fitted, and wide where they are given for a crease. The input's interior has no part in it, so that it has none
//! in what is tried and returned either.

use nalgebra::Vector3;

use super::Surface;
use crate::discrete::boundary_normals::{angle, average};
use crate::mesh::Rings;

/// A kink up to this many degrees is that of a coarse mesh.
const KINK: f64 = 45.0;
/// So much more than the kink that is asked for belongs to a coarse mesh, too.
const OVER_ASKED: f64 = 15.0;
/// No surface that deviates from a boundary normal by more than this many degrees meets it.
const DEVIATION: f64 = 60.0;

/// The angles at one boundary vertex, in degrees.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kink {
    /// Local number among the boundary vertices.
    pub b: usize,
    /// Between both sides of the surface.
    pub kink: f64,
    /// Between the boundary normal and the outside; 0 where nothing is outside.
    asked: f64,
    /// Between the region's side and the boundary normal.
    deviation: f64,
    /// The boundary normal points against the outside, or where there is none, against the region.
    is_reversed: bool,
}

impl Kink {
    fn is_crease(&self) -> bool {
        self.kink > KINK.max(self.asked + OVER_ASKED) || self.deviation > DEVIATION
    }
}

/// The kinks at all boundary vertices but those inside the region: there no side is another's outside.
pub(crate) fn kinks(surface: &Surface<'_>, rings: &Rings, input: &[Vector3<f64>]) -> Vec<Kink> {
    (0..rings.boundary())
        .filter(|&b| !rings.closed[b])
        .map(|b| kink(surface, rings, input, b))
        .collect()
}

/// The kink at boundary vertex `b`; `input` has the outside.
pub(crate) fn kink(surface: &Surface<'_>, rings: &Rings, input: &[Vector3<f64>], b: usize) -> Kink {
    let v = surface.region.free + b;
    let normal = &surface.boundary_normals[b];
    let outside = average(input, v, rings.outside_triangles(b));
    // Without area there is no side to be off.
    let inside = average(surface.x, v, rings.boundary_triangles(b)).unwrap_or(*normal);
    let between = |n: &Vector3<f64>, m: &Vector3<f64>| angle(n, m).to_degrees();
    let deviation = between(&inside, normal);
    let asked = outside.map(|o| between(normal, &o));
    Kink {
        b,
        kink: outside.map_or(deviation, |o| between(&inside, &o)),
        asked: asked.unwrap_or(0.0),
        deviation,
        is_reversed: asked.unwrap_or(deviation) > 90.0,
    }
}

/// Those of them that are creases. None where boundary normals are reversed: they explain any crease, and are reported
/// themselves.
pub(crate) fn creases(kinks: &[Kink]) -> Vec<Kink> {
    if kinks.iter().any(|k| k.is_reversed) {
        return Vec::new();
    }
    kinks.iter().copied().filter(Kink::is_crease).collect()
}
