//! The ellipsoid, and a cap of it: none of the surfaces that the equations keep.

use super::arithmetic::unit;
use super::arithmetic::{between, length};

/// The ellipsoid about the origin with its axes along those of the coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipsoid {
    semi_axes: [f64; 3],
}

impl Ellipsoid {
    /// The one with these semi-axes, each from 0.1 to 10.
    pub fn new(semi_axes: [f64; 3]) -> Self {
        Self {
            semi_axes: semi_axes.map(|a| between(0.1, a, 10.0)),
        }
    }

    /// The point where the unit sphere's goes.
    pub(super) fn of_sphere(&self, p: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| self.semi_axes[i] * p[i])
    }

    /// Half the gradient of `sum (x_i / a_i)^2`.
    fn gradient(&self, x: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| x[i] / self.semi_axes[i].powi(2))
    }

    /// Outward unit normal at a point of it.
    pub(super) fn normal(&self, x: [f64; 3]) -> [f64; 3] {
        unit(self.gradient(x))
    }

    /// Mean curvature at a point of it.
    pub(super) fn mean_curvature(&self, x: [f64; 3]) -> f64 {
        let squares = self.semi_axes.map(|a| a * a);
        let sum = x.map(|x| x * x).iter().sum::<f64>() - squares.iter().sum::<f64>();
        sum / (2.0 * squares.iter().product::<f64>() * length(self.gradient(x)).powi(3))
    }

    /// The point of it nearest to `p`: `x_i = a_i^2 p_i / (a_i^2 + t)`, where `sum (x_i / a_i)^2 - 1` falls with `t`.
    pub(super) fn nearest(&self, p: [f64; 3]) -> [f64; 3] {
        let squares = self.semi_axes.map(|a| a * a);
        let at = |t: f64| std::array::from_fn::<f64, 3, _>(|i| squares[i] * p[i] / (squares[i] + t));
        let excess = |x: [f64; 3]| (0..3).map(|i| x[i] * x[i] / squares[i]).sum::<f64>() - 1.0;
        let shortest = self.semi_axes.iter().copied().fold(f64::INFINITY, f64::min);
        let longest = self.semi_axes.iter().copied().fold(0.0, f64::max);
        let mut bracket = [-shortest * shortest, longest * length(p)];
        let mut t = 0.0;
        for _ in 0..200 {
            let x = at(t);
            let value = excess(x);
            bracket[usize::from(value < 0.0)] = t;
            let slope: f64 = (0..3)
                .map(|i| -2.0 * x[i] * x[i] / squares[i] / (squares[i] + t))
                .sum();
            let newton = t - value / slope;
            let next = if newton > bracket[0] && newton < bracket[1] {
                newton
            } else {
                0.5 * (bracket[0] + bracket[1])
            };
            if (next - t).abs() <= 1e-16 * longest * longest {
                break;
            }
            t = next;
        }
        at(t)
    }

    /// Distance of a point, positive outside.
    pub(super) fn signed_distance(&self, p: [f64; 3]) -> f64 {
        let x = self.nearest(p);
        let n = self.normal(x);
        (0..3).map(|i| (p[i] - x[i]) * n[i]).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::mean_curvature_by_differences;

    const AXES: [f64; 3] = [1.0, 0.8, 0.6];

    #[test]
    fn the_nearest_point_is_found_from_both_sides() {
        let ellipsoid = Ellipsoid::new(AXES);
        for at in [
            [0.1, 0.2, 1.0],
            [0.7, -0.5, 0.3],
            [0.9, 0.1, -0.2],
            [0.0, 0.0, 1.0],
        ] {
            let x = ellipsoid.of_sphere(unit(at));
            let n = ellipsoid.normal(x);
            for height in [-0.2, -1e-9, 0.0, 1e-3, 5.0] {
                let p = std::array::from_fn(|i| x[i] + height * n[i]);
                assert!(
                    (ellipsoid.signed_distance(p) - height).abs() < 1e-13,
                    "{at:?} {height}"
                );
                assert_below!(
                    length(std::array::from_fn(|i| ellipsoid.nearest(p)[i] - x[i])),
                    1e-7
                );
            }
        }
    }

    #[test]
    fn mean_curvature_is_that_of_the_level_set() {
        let ellipsoid = Ellipsoid::new(AXES);
        for at in [[0.1, 0.2, 1.0], [0.7, -0.5, 0.3], [0.0, 0.0, 1.0]] {
            let x = ellipsoid.of_sphere(unit(at));
            let h = ellipsoid.mean_curvature(x);
            let of_level_set = mean_curvature_by_differences(|y| ellipsoid.normal(y), x);
            assert!((h - of_level_set).abs() < 1e-9, "{h} {of_level_set}");
        }
        let sphere = Ellipsoid::new([2.0; 3]);
        assert_near!(sphere.mean_curvature([0.0, 2.0, 0.0]), -0.5, 1e-15);
    }
}
