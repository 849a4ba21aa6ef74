//! Where the surface does not run on smoothly from the outside: creases along the boundary.
//!
//! A *kink* is the angle between the surface's two sides at a boundary vertex: between the sum of the cross products of the
//! region's triangles there and that of the triangles outside; where nothing is outside, between the former and the
//! boundary normal. It is a crease if it is wider than a coarse mesh accounts for, and wider than two others:
//!
//! - the kink that is asked for, between the boundary normal and the outside: small where normals are fitted, wide where they
//!   are given for a crease;
//! - the kink of the input, but not more than the outside itself turns from this vertex to its neighbours on the boundary:
//!   beside a jagged outside no surface is without kinks, but a destroyed interior excuses none.
//!
//! What is tried and returned must not depend on the interior of the input, so the solver counts as much for the
//! input as any input could account for. The verdict may depend on it.

use nalgebra::Vector3;

use super::Surface;
use crate::discrete::boundary_normals::{angle, average};
use crate::mesh::Rings;

/// A kink up to this many degrees is that of a coarse mesh.
pub(crate) const KINK: f64 = 45.0;
/// So many more than the kinks it is compared with, too.
pub(crate) const EXCESS: f64 = 15.0;
/// No surface that deviates from a boundary normal by more than this many degrees meets it.
const DEVIATION: f64 = 60.0;

/// The angles at one boundary vertex, in degrees.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kink {
    /// Local number among the boundary vertices.
    pub b: usize,
    /// Between both sides of the surface.
    pub kink: f64,
    /// The same in the input.
    pub before: f64,
    /// Between the boundary normal and the outside; 0 where nothing is outside.
    asked: f64,
    /// By which the outside turns to the next boundary vertices.
    turn: f64,
    /// Between the region's side and the boundary normal.
    deviation: f64,
    /// The boundary normal points against the outside, or where there is none, against the region.
    is_reversed: bool,
}

impl Kink {
    fn is_crease(&self, before: f64) -> bool {
        let expected = self.asked.max(before.min(self.turn));
        self.kink > KINK.max(expected + EXCESS) || self.deviation > DEVIATION
    }
}

/// The kinks at all boundary vertices but those inside the region: there no side is another's outside.
///
/// Against the outside as it will be: what other components move is left out.
pub(crate) fn kinks(surface: &Surface<'_>, rings: &Rings, input: &[Vector3<f64>]) -> Vec<Kink> {
    let outside = (0..rings.boundary()).map(|b| surface.final_outside(rings, input, b));
    against(surface, rings, input, &outside.collect::<Vec<_>>())
}

/// The same against the outside as it is given, which is all that what is tried may depend on: so a component's surface is
/// the same whatever else moves.
pub(crate) fn kinks_as_given(surface: &Surface<'_>, rings: &Rings, input: &[Vector3<f64>]) -> Vec<Kink> {
    let free = surface.region.free;
    let outside = (0..rings.boundary()).map(|b| average(input, free + b, rings.outside_triangles(b)));
    against(surface, rings, input, &outside.collect::<Vec<_>>())
}

fn against(
    surface: &Surface<'_>,
    rings: &Rings,
    input: &[Vector3<f64>],
    outside: &[Option<Vector3<f64>>],
) -> Vec<Kink> {
    (0..rings.boundary())
        .filter(|&b| !rings.closed[b])
        .map(|b| kink(surface, rings, input, outside, b))
        .collect()
}

fn kink(
    surface: &Surface<'_>,
    rings: &Rings,
    input: &[Vector3<f64>],
    outside: &[Option<Vector3<f64>>],
    b: usize,
) -> Kink {
    let free = surface.region.free;
    let normal = surface.boundary_normals[b];
    // Without area there is no side to be off.
    let side = |x| average(x, free + b, rings.boundary_triangles(b)).unwrap_or(normal);
    let (inside, before) = (side(surface.x), side(input));
    let deviation = degrees(&inside, &normal);
    let Some(o) = outside[b] else {
        return Kink {
            b,
            kink: deviation,
            before: degrees(&before, &normal),
            asked: 0.0,
            turn: 0.0,
            deviation,
            is_reversed: deviation > 90.0,
        };
    };
    let asked = degrees(&normal, &o);
    let beside = rings.boundary_ring(b).iter();
    let beside = beside.filter_map(|&j| outside[(j as usize).checked_sub(free)?]);
    Kink {
        b,
        kink: degrees(&inside, &o),
        before: degrees(&before, &o),
        asked,
        turn: beside.map(|n| degrees(&n, &o)).fold(0.0, f64::max),
        deviation,
        is_reversed: asked > 90.0,
    }
}

fn degrees(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    angle(a, b).to_degrees()
}

/// Those of them that are creases. None where boundary normals are reversed: they explain any crease, and are reported
/// themselves.
pub(crate) fn creases(kinks: &[Kink]) -> Vec<Kink> {
    select(kinks, |k| k.is_crease(k.before))
}

/// How many there are whatever the interior of the input.
pub(crate) fn certain_creases(kinks: &[Kink]) -> usize {
    select(kinks, |k| k.is_crease(f64::INFINITY)).len()
}

fn select(kinks: &[Kink], is_crease: impl Fn(&Kink) -> bool) -> Vec<Kink> {
    if kinks.iter().any(|k| k.is_reversed) {
        return Vec::new();
    }
    kinks.iter().copied().filter(is_crease).collect()
}
