//! A patch of a torus.

use super::arithmetic::between;
use super::planar::rectangle_chart;
use super::sampling::Sampling;
use super::shape::{Lifted, Shape};
use super::surface::Surface;
use super::torus::Torus;

/// A patch of the torus of these radii on its outer side, free where the angle about the axis and that in the meridian are less than
/// `half_angle` (radians, 0.1 to 2.5). Near the other side there are fewer rings outside than asked for, so that they do not meet.
pub fn torus_patch(
    major: f64,
    minor: f64,
    half_angle: f64,
    n: usize,
    sampling: Sampling,
    outside: usize,
) -> Shape {
    let torus = Torus::new(major, minor);
    let half = between(0.1, half_angle, 2.5);
    let top = torus.conformal_height(half);
    let whole = [std::f64::consts::PI, torus.conformal_height(std::f64::consts::PI)];
    let chart = rectangle_chart([half, top], whole, n, sampling, outside);
    Shape::lifted(chart, Some(Surface::Torus(torus)), |[u, w]| {
        let angles = [u, torus.meridian_angle(w)];
        let position = torus.point(angles);
        let corner = torus.point([half, half]);
        Lifted {
            position,
            normal: torus.normal(position),
            flat: [corner[0], u / half * corner[1], w / top * corner[2]],
        }
    })
}
