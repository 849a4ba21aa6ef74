//! Surfaces over a disc: the spherical cap and a saddle.

use super::planar::disc_chart;
use super::sampling::Sampling;
use super::shape::{Lifted, Shape};
use super::surface::{Surface, unit};

/// The point of the unit sphere seen from the south pole at (x, y) in the equatorial plane.
pub(super) fn stereographic(p: [f64; 2]) -> [f64; 3] {
    let square = p[0] * p[0] + p[1] * p[1];
    [2.0 * p[0], 2.0 * p[1], 1.0 - square].map(|x| x / (1.0 + square))
}

/// Lift to the sphere; the flat shape is the disc in the plane of the circle `|p| = radius`.
pub(super) fn on_sphere(position: [f64; 3], p: [f64; 2], radius: f64) -> Lifted {
    let rim = stereographic([radius, 0.0]);
    let shrink = rim[0] / radius;
    Lifted {
        position,
        normal: position,
        flat: [p[0] * shrink, p[1] * shrink, rim[2]],
    }
}

/// A cap of the unit sphere about the north pole, free within `half_angle` degrees (1 to 150) of it.
/// The lattice is drawn in the stereographic plane, so triangles grow smaller towards the rim.
pub fn sphere_cap(half_angle: f64, n: usize, sampling: Sampling, outside: usize) -> Shape {
    let radius = (0.5 * half_angle.max(1.0).min(150.0).to_radians()).tan();
    let chart = disc_chart(radius, n, sampling, outside);
    Shape::lifted(chart, Some(Surface::Sphere), |p| {
        on_sphere(stereographic(p), p, radius)
    })
}

/// The graph of `0.8 (x^2 - y^2) + 0.5 y sin 3x`, free over the unit disc. Not a solution of the fairing
/// equation, so there is no exact surface to come back to: the rim and its normals are what matters.
pub fn saddle_graph(n: usize, sampling: Sampling, outside: usize) -> Shape {
    let height = |x: f64, y: f64| 0.8 * (x * x - y * y) + 0.5 * y * (3.0 * x).sin();
    Shape::lifted(disc_chart(1.0, n, sampling, outside), None, |p| {
        let [x, y] = p;
        let dx = 1.6 * x + 1.5 * y * (3.0 * x).cos();
        let dy = -1.6 * y + 0.5 * (3.0 * x).sin();
        let r = x.hypot(y).max(1e-9);
        Lifted {
            position: [x, y, height(x, y)],
            normal: unit([-dx, -dy, 1.0]),
            flat: [x, y, r.powi(4) * height(x / r, y / r)],
        }
    })
}
