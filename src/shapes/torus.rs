//! The torus, and a patch on its outer side: none of the surfaces that the equations keep.

use super::arithmetic::between;
use super::arithmetic::unit;

/// The torus about the z axis: a circle of the minor radius whose centre goes round on one of the major radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torus {
    major: f64,
    minor: f64,
}

impl Torus {
    /// The one with these radii; the minor one is kept between 1/20 and 19/20 of the major one.
    pub fn new(major: f64, minor: f64) -> Self {
        let major = if major.is_finite() && major > 0.0 {
            major
        } else {
            1.0
        };
        Self {
            major,
            minor: between(0.05 * major, minor, 0.95 * major),
        }
    }

    /// The geometric mean of the greatest and the least distance from the axis.
    fn mean_radius(&self) -> f64 {
        (self.major * self.major - self.minor * self.minor).sqrt()
    }

    /// `w(t)` with `dw = minor dt / (distance from the axis)`, `t` the angle in the meridian from the equator on: with the angle about the
    /// axis, conformal coordinates.
    pub(super) fn conformal_height(&self, t: f64) -> f64 {
        let (c, m) = (
            self.minor / self.mean_radius(),
            self.mean_radius() / (self.major + self.minor),
        );
        2.0 * c * (m * (0.5 * t).tan()).atan()
    }

    /// The angle in the meridian at a conformal height.
    pub(super) fn meridian_angle(&self, w: f64) -> f64 {
        let (c, m) = (
            self.minor / self.mean_radius(),
            self.mean_radius() / (self.major + self.minor),
        );
        2.0 * ((0.5 * w / c).tan() / m).atan()
    }

    /// Distance and direction in the meridian plane from the circle of centres: `(distance, [outwards, upwards])`.
    fn around_centre(&self, p: [f64; 3]) -> (f64, [f64; 2]) {
        let d = [p[0].hypot(p[1]) - self.major, p[2]];
        let distance = d[0].hypot(d[1]);
        (distance, d.map(|x| x / distance.max(f64::MIN_POSITIVE)))
    }

    /// Distance of a point, positive outside.
    pub(super) fn signed_distance(&self, p: [f64; 3]) -> f64 {
        self.around_centre(p).0 - self.minor
    }

    /// Mean curvature at the point nearest to `p`.
    pub(super) fn mean_curvature(&self, p: [f64; 3]) -> f64 {
        let (_, [outwards, _]) = self.around_centre(p);
        -0.5 * (1.0 / self.minor + outwards / (self.major + self.minor * outwards))
    }

    /// Outward unit normal at the point nearest to `p`.
    pub(super) fn normal(&self, p: [f64; 3]) -> [f64; 3] {
        let (_, [outwards, upwards]) = self.around_centre(p);
        let radial = unit([p[0], p[1], 0.0]);
        [radial[0] * outwards, radial[1] * outwards, upwards]
    }

    /// The point at an angle about the axis and one in the meridian.
    pub(super) fn point(&self, [u, t]: [f64; 2]) -> [f64; 3] {
        let r = self.major + self.minor * t.cos();
        [r * u.cos(), r * u.sin(), self.minor * t.sin()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::mean_curvature_by_differences;

    #[test]
    fn the_chart_is_conformal_and_comes_back() {
        let torus = Torus::new(1.0, 0.4);
        for t in [-2.5, -1.0, 0.0, 0.3, 2.0] {
            let w = torus.conformal_height(t);
            assert_near!(torus.meridian_angle(w), t, 1e-14);
            let d = 1e-4;
            let slope = (torus.conformal_height(t + d) - torus.conformal_height(t - d)) / (2.0 * d);
            assert_near!(slope, 0.4 / (1.0 + 0.4 * t.cos()), 1e-8);
        }
    }

    #[test]
    fn mean_curvature_is_that_of_the_level_set() {
        let torus = Torus::new(1.0, 0.4);
        for angles in [[0.3, 0.2], [1.0, -2.0], [-2.0, 1.4]] {
            let x = torus.point(angles);
            let h = torus.mean_curvature(x);
            let of_level_set = mean_curvature_by_differences(|y| torus.normal(y), x);
            assert!((h - of_level_set).abs() < 1e-9, "{h} {of_level_set}");
            assert_below!(torus.signed_distance(x).abs(), 1e-15);
        }
    }
}
