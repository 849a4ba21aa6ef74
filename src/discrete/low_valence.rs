//! The extra sample between two neighbours (paper 6.2, Figure 5): the centre of the area that any spiral
//! through both points, tangent to both normals' planes, must cross.

use super::simd::{Simd, Vec3, dot, minus, normalized, plus, scaled};

/// A point of the surface between `a` and `b` with unit normals `n_a`, `n_b` there.
///
/// The planar curve lies in the plane of the chord and `n_a + n_b`; each end's tangent and the chord define a
/// circle whose arc meets the chord's bisector at height `(|b - a| / 2) tan(angle / 2)`; the sample is the middle
/// of the two heights. `T` below is that `tan(angle / 2)`. The paper takes the tangent direction "with the smaller
/// angle" to the chord, which jumps when a normal turns past 90 degrees to it; `|c|` in the denominator is the
/// same choice without the jump.
#[inline(always)]
pub(crate) fn spiral_sample<const L: usize>(
    a: &Vec3<L>,
    b: &Vec3<L>,
    n_a: &Vec3<L>,
    n_b: &Vec3<L>,
) -> Vec3<L> {
    let chord = minus(b, a);
    let length = dot(&chord, &chord).sqrt().max(Simd::splat(f64::MIN_POSITIVE));
    let c = scaled(&chord, length.recip());
    let sum = plus(n_a, n_b);
    let up = normalized(&minus(&sum, &scaled(&c, dot(&sum, &c))));
    let t_a = half_angle_tangent(-dot(n_a, &c), dot(n_a, &up));
    let t_b = half_angle_tangent(dot(n_b, &c), dot(n_b, &up));
    let middle = scaled(&plus(a, b), Simd::splat(0.5));
    plus(&middle, &scaled(&up, length * 0.25 * (t_a + t_b)))
}

/// `tan(phi / 2)` of the angle with sine `s` and cosine `|c|`, up to a common factor of both.
#[inline(always)]
fn half_angle_tangent<const L: usize>(s: Simd<L>, c: Simd<L>) -> Simd<L> {
    s / ((s * s + c * c).sqrt() + c.abs()).max(Simd::splat(f64::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrete::simd::{lane, one};
    use nalgebra::Vector3;

    fn sample(a: Vector3<f64>, b: Vector3<f64>, n_a: Vector3<f64>, n_b: Vector3<f64>) -> Vector3<f64> {
        lane(&spiral_sample(&one(&a), &one(&b), &one(&n_a), &one(&n_b)), 0)
    }

    #[test]
    fn lies_on_the_sphere_through_both_ends() {
        let (a, b) = (Vector3::new(1.0, 0.0, 0.0), Vector3::new(0.36, 0.48, 0.8));
        let p = sample(a, b, a, b);
        assert_near!(p.norm(), 1.0, 1e-15);
        assert_below!((p - (a + b).normalize()).norm(), 1e-15);
        // The same circle seen from inside.
        assert_below!((sample(a, b, -a, -b) - p).norm(), 1e-15);
    }

    #[test]
    fn is_the_midpoint_of_a_flat_edge_and_of_an_antisymmetric_inflection() {
        let (a, b) = (Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0));
        let z = Vector3::z();
        assert_below!((sample(a, b, z, z) - Vector3::new(1.0, 0.0, 0.0)).norm(), 1e-15);
        let tilted = Vector3::new(0.3, 0.0, 1.0).normalize();
        assert_below!(
            (sample(a, b, tilted, tilted) - Vector3::new(1.0, 0.0, 0.0)).norm(),
            1e-15
        );
    }

    #[test]
    fn is_continuous_when_a_normal_turns_past_the_chord() {
        let (a, b) = (Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0));
        let at = |degrees: f64| {
            let phi = degrees.to_radians();
            sample(a, b, Vector3::new(-phi.sin(), 0.0, phi.cos()), Vector3::z())
        };
        let jump = (at(90.0 + 1e-6) - at(90.0 - 1e-6)).norm();
        assert!(jump < 1e-7, "jump of {jump}");
    }
}
