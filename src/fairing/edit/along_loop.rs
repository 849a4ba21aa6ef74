//! By how much the normals along a boundary loop are turned, and how that is done.

use std::f64::consts::PI;

use nalgebra::Vector3;

/// The largest value of [`sideways`].
const LARGEST_SIDEWAYS: f64 = 1.299_038_105_676_658;

/// Both sides of the vertex alike, or with opposite signs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::fairing) enum Kind {
    Tilt,
    Twist,
}

/// From 1 at 0 to 0 at 1, level at both ends.
pub(super) fn fade(s: f64) -> f64 {
    if s < 1.0 {
        (1.0 + libm::cos(PI * s)) / 2.0
    } else {
        0.0
    }
}

/// From 0 at 0 to 0 at 1, with the largest value at a third; level at 1.
fn sideways(s: f64) -> f64 {
    if s < 1.0 {
        libm::sin(PI * s) * (1.0 + libm::cos(PI * s))
    } else {
        0.0
    }
}

/// What a vertex at the arc length `s` ahead of the one named, on a loop of length `around`, has of the angle. Two sides that meet add
/// up: as the falloff grows to the whole loop, a tilt becomes the same everywhere, and a twist a sine.
pub(in crate::fairing) fn part(kind: Kind, s: f64, around: f64, falloff: f64) -> f64 {
    let reach = if falloff == 0.0 {
        around
    } else {
        falloff.min(around)
    };
    let (ahead, behind) = (s / reach, (around - s) / reach);
    match kind {
        Kind::Tilt => fade(ahead) + fade(behind),
        Kind::Twist => {
            // Where the sides meet, less is left of the largest value.
            let meeting = (2.0 * reach / around - 1.0).max(0.0);
            let largest = LARGEST_SIDEWAYS + (1.0 - LARGEST_SIDEWAYS) * meeting;
            (sideways(ahead) - sideways(behind)) / largest
        }
    }
}

/// The arc lengths along a loop of points from the first of them on, and the length of the whole.
pub(in crate::fairing) fn arc_lengths(points: &[Vector3<f64>]) -> (Vec<f64>, f64) {
    let mut so_far = 0.0;
    let mut lengths = Vec::with_capacity(points.len());
    for (k, p) in points.iter().enumerate() {
        lengths.push(so_far);
        so_far += (points[(k + 1) % points.len()] - p).norm();
    }
    (lengths, so_far)
}

/// The direction of the curve through three points at the middle one: exact on circles, however they are spaced.
pub(in crate::fairing) fn tangent(
    before: Vector3<f64>,
    at: Vector3<f64>,
    after: Vector3<f64>,
) -> Option<Vector3<f64>> {
    let (back, ahead) = (at - before, after - at);
    let (a, b) = (back.norm(), ahead.norm());
    (back * (b / a) + ahead * (a / b)).try_normalize(f64::MIN_POSITIVE)
}

/// The normal `n`, turned by `angle` about the curve with this direction, which has the region on its left.
pub(in crate::fairing) fn turned(n: Vector3<f64>, along: Vector3<f64>, angle: f64) -> Vector3<f64> {
    let Some(m) = n.cross(&along).try_normalize(f64::MIN_POSITIVE) else {
        return n;
    };
    n * libm::cos(angle) - m * libm::sin(angle)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_effect_has_a_known_size_at_known_places() {
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-14, "{a} {b}");
        for falloff in [0.0, 6.0, 7.0] {
            (0..12).for_each(|k| near(part(Kind::Tilt, f64::from(k) / 2.0, 6.0, falloff), 1.0));
            for k in 0..12 {
                let s = f64::from(k) / 2.0;
                near(part(Kind::Twist, s, 6.0, falloff), libm::sin(PI * s / 3.0));
            }
        }
        for (s, tilt, twist) in [
            (0.0, 1.0, 0.0),
            (1.0, 0.75, 1.0),
            (1.5, 0.5, 1.0 / LARGEST_SIDEWAYS),
            (3.0, 0.0, 0.0),
            (4.0, 0.0, 0.0),
        ] {
            near(part(Kind::Tilt, s, 10.0, 3.0), tilt);
            near(part(Kind::Twist, s, 10.0, 3.0), twist);
            near(part(Kind::Tilt, 10.0 - s, 10.0, 3.0), tilt);
            near(part(Kind::Twist, 10.0 - s, 10.0, 3.0), -twist);
        }
    }

    #[test]
    fn tangents_are_those_of_circles_however_points_are_spaced() {
        let at = |phi: f64| Vector3::new(3.0 * libm::cos(phi), 3.0 * libm::sin(phi), 1.0);
        let t = tangent(at(0.1), at(0.4), at(1.7)).unwrap();
        assert_below!(
            (t - Vector3::new(-libm::sin(0.4), libm::cos(0.4), 0.0)).norm(),
            1e-15
        );
    }

    #[test]
    fn a_positive_angle_bulges_outward() {
        // The region lies to the left of the x axis, seen from above: y is the way into it.
        let n = turned(Vector3::z(), Vector3::x(), 0.3);
        assert_below!(
            (n - Vector3::new(0.0, -libm::sin(0.3), libm::cos(0.3))).norm(),
            1e-15
        );
    }
}
