//! A cap of an ellipsoid.

use super::arithmetic::between;
use super::chart::Chart;
use super::ellipsoid::Ellipsoid;
use super::planar::disc_chart;
use super::sampling::Sampling;
use super::shape::{Lifted, Shape};
use super::sphere::stereographic;
use super::surface::Surface;

/// The image of a cap of the unit sphere about the north pole, free within `half_angle` degrees (1 to 150) of it, on the ellipsoid with
/// these semi-axes (each 0.1 to 10).
pub fn ellipsoid_cap(
    semi_axes: [f64; 3],
    half_angle: f64,
    n: usize,
    sampling: Sampling,
    outside: usize,
) -> Shape {
    let ellipsoid = Ellipsoid::new(semi_axes);
    let radius = (0.5 * between(1.0, half_angle, 150.0).to_radians()).tan();
    let chart: Chart<[f64; 2]> = disc_chart(radius, n, sampling, outside);
    let boundary = stereographic([radius, 0.0]);
    Shape::lifted(chart, Some(Surface::Ellipsoid(ellipsoid)), |p| {
        let position = ellipsoid.of_sphere(stereographic(p));
        let shrink = boundary[0] / radius;
        Lifted {
            position,
            normal: ellipsoid.normal(position),
            flat: ellipsoid.of_sphere([p[0] * shrink, p[1] * shrink, boundary[2]]),
        }
    })
}
