//! Where the surface does not run on smoothly from the outside: creases along the boundary.
//!
//! A *kink* is the angle between the surface's two sides at a boundary vertex: between the sum of the cross products of the
//! region's triangles there and that of the triangles outside; where nothing is outside, between the former and the
//! boundary normal. It is a crease if it is wider than [`KINK`], and wider by more than [`EXCESS`] than both of:
//!
//! - the kink that is asked for, between a given boundary normal and the outside. A fitted normal asks for none;
//! - the kink of the input, but not more than a coarse mesh has, or the outside itself turns from this vertex to its neighbours
//!   on the boundary: beside a jagged outside no surface is without kinks, but a destroyed interior excuses no wide one.
//!
//! What is tried and returned must not depend on the interior of the input, so the solver goes by the outside alone, and takes
//! every normal as given. The verdict may depend on them.

use nalgebra::Vector3;

use super::SurfaceState;
use crate::discrete::boundary_normals::{angle, average};
use crate::mesh::Rings;

/// A kink up to this many degrees is that of a coarse mesh.
/// Of 126 cases, half: 3 change, 1 get another triangulation, +5 % iterations, 11 fail; double: 1 changes, -1 % iterations, 3 more succeed.
pub(crate) const KINK: f64 = 45.0;
/// So many more than the kinks it is compared with, too.
/// Of 126 cases, half: none changes; double: 1 changes, 2 more succeed.
pub(super) const EXCESS: f64 = 15.0;
/// No surface that deviates from a boundary normal by more than this many degrees meets it.
/// Of 126 cases, half: 3 change by up to 0.8 edges, 1 get another triangulation, +7 % iterations, 4 fail;
/// double: 0 change, -2 % iterations.
const DEVIATION: f64 = 60.0;

/// Whether a kink is wider than that of a coarse mesh, and than one that is expected; in degrees.
pub(crate) fn is_too_wide(kink: f64, expected: f64) -> bool {
    kink > KINK.max(expected + EXCESS)
}

/// Whether a side of a surface that was another one before has a crease against the outside. The normals have any length; without one there is
/// no side.
pub(crate) fn is_creased(now: &Vector3<f64>, before: &Vector3<f64>, outside: &Vector3<f64>) -> bool {
    let is_any = [now, outside].iter().all(|side| side.norm_squared() > 0.0);
    is_any && is_too_wide(degrees(now, outside), degrees(before, outside).min(KINK))
}

/// The angles at one boundary vertex, in degrees.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kink {
    /// Local number among the boundary vertices.
    pub b: usize,
    /// Between both sides of the surface.
    pub kink: f64,
    /// The same in the input.
    pub before: f64,
    /// Between a given boundary normal and the outside; 0 where none is given, or nothing is outside.
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
        let expected = self.asked.max(before.min(self.turn.max(KINK)));
        is_too_wide(self.kink, expected) || self.deviation > DEVIATION
    }
}

/// The kinks at all boundary vertices but those inside the region: there no side is another's outside.
///
/// Against the outside as it will be: what other components move is left out. `is_given` says where normals are given.
pub(crate) fn kinks(
    surface: &SurfaceState<'_>,
    rings: &Rings,
    input: &[Vector3<f64>],
    is_given: &[bool],
) -> Vec<Kink> {
    let outside = (0..rings.boundary()).map(|b| surface.final_outside(rings, input, b));
    let mut kinks = against(surface, rings, input, &outside.collect::<Vec<_>>());
    for kink in kinks.iter_mut().filter(|kink| !is_given[kink.b]) {
        kink.asked = 0.0;
    }
    kinks
}

/// The same against the outside as it is given, which is all that what is tried may depend on: so a component's surface is
/// the same whatever else moves.
pub(crate) fn kinks_as_given(surface: &SurfaceState<'_>, rings: &Rings, input: &[Vector3<f64>]) -> Vec<Kink> {
    let free = surface.region.free;
    let outside = (0..rings.boundary()).map(|b| average(input, free + b, rings.outside_triangles(b)));
    against(surface, rings, input, &outside.collect::<Vec<_>>())
}

fn against(
    surface: &SurfaceState<'_>,
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
    surface: &SurfaceState<'_>,
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

/// How many there are if the input has the kinks of its outside, whatever its interior.
pub(crate) fn creases_by_outside(kinks: &[Kink]) -> usize {
    select(kinks, |k| k.is_crease(k.turn)).len()
}

fn select(kinks: &[Kink], is_crease: impl Fn(&Kink) -> bool) -> Vec<Kink> {
    if kinks.iter().any(|k| k.is_reversed) {
        return Vec::new();
    }
    kinks.iter().copied().filter(is_crease).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_crease(kink: f64, before: f64, turn: f64, asked: f64, deviation: f64) -> bool {
        let of = Kink {
            b: 0,
            kink,
            before,
            asked,
            turn,
            deviation,
            is_reversed: false,
        };
        !creases(&[of]).is_empty()
    }

    #[test]
    fn a_crease_is_wide_by_itself_and_against_what_accounts_for_it() {
        assert!(!is_crease(45.0, 0.0, 0.0, 0.0, 45.0));
        assert!(is_crease(45.1, 0.0, 0.0, 0.0, 45.1));
        // The input's kink, on a jagged outside: 15 degrees more are too many.
        assert!(!is_crease(65.0, 50.0, 90.0, 0.0, 0.0));
        assert!(is_crease(65.1, 50.0, 90.0, 0.0, 0.0));
        // The outside does not turn: the input's kink is a coarse mesh's, or its interior's.
        assert!(!is_crease(60.0, 90.0, 20.0, 0.0, 50.0));
        assert!(is_crease(60.1, 90.0, 20.0, 0.0, 50.0));
        assert!(is_crease(50.0, 34.9, 20.0, 0.0, 50.0));
        // Given normals ask for it, and the surface has them.
        assert!(!is_crease(90.0, 0.0, 0.0, 90.0, 0.0));
        assert!(is_crease(90.0, 0.0, 0.0, 90.0, 60.1));
    }

    #[test]
    fn what_is_tried_does_not_depend_on_the_interior_of_the_input() {
        let of = |kink, before| Kink {
            b: 0,
            kink,
            before,
            asked: 0.0,
            turn: 40.0,
            deviation: 0.0,
            is_reversed: false,
        };
        for before in [0.0, 50.0, 180.0] {
            assert_eq!(creases_by_outside(&[of(50.0, before), of(55.1, before)]), 1);
        }
        assert_eq!(creases(&[of(50.0, 0.0), of(55.1, 0.0)]).len(), 2);
        assert_eq!(creases(&[of(50.0, 50.0), of(55.1, 50.0)]).len(), 0);
    }
}
