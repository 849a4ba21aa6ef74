//! Surfaces over a disc: the spherical cap, most of a sphere, and a saddle.

use super::arithmetic::between;
use super::arithmetic::unit;
use super::chart::{Chart, cut, delaunay};
use super::planar::{disc_chart, margin};
use super::rng::Rng;
use super::sampling::{Domain, Sampling, lattice_count, sample};
use super::shape::{Lifted, Shape};
use super::surface::Surface;
use std::f64::consts::{PI, TAU};

/// The point of the unit sphere seen from the south pole at (x, y) in the equatorial plane.
pub(super) fn stereographic(p: [f64; 2]) -> [f64; 3] {
    let square = p[0] * p[0] + p[1] * p[1];
    [2.0 * p[0], 2.0 * p[1], 1.0 - square].map(|x| x / (1.0 + square))
}

/// Lift to the sphere; the flat shape is the disc in the plane of the circle `|p| = radius`.
pub(super) fn on_sphere(position: [f64; 3], p: [f64; 2], radius: f64) -> Lifted {
    let boundary = stereographic([radius, 0.0]);
    let shrink = boundary[0] / radius;
    Lifted {
        position,
        normal: position,
        flat: [p[0] * shrink, p[1] * shrink, boundary[2]],
    }
}

/// A cap of the unit sphere about the north pole, free within `half_angle` degrees (1 to 150) of it.
/// The lattice is drawn in the stereographic plane, so triangles grow smaller towards the boundary.
pub fn sphere_cap(half_angle: f64, n: usize, sampling: Sampling, outside: usize) -> Shape {
    let radius = (0.5 * between(1.0, half_angle, 150.0).to_radians()).tan();
    let chart = disc_chart(radius, n, sampling, outside);
    Shape::lifted(chart, Some(Surface::Sphere), |p| {
        on_sphere(stereographic(p), p, radius)
    })
}

/// The graph of `0.8 (x^2 - y^2) + 0.5 y sin 3x`, free over the unit disc. Not a solution of the fairing
/// equation, so there is no exact surface to come back to: the boundary and its normals are what matters.
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

/// The unit sphere but for a cap about the south pole of `hole_half_angle` degrees (at most 170, at least
/// two and a half edges): everything outside that hole is free, the rings of fixed triangles lie in the
/// hole. In a small hole there are fewer rings than asked for, so that it stays open.
///
/// The vertices are a Fibonacci lattice, so that triangles have the same size everywhere; Delaunay triangles
/// of the sphere are those of the stereographic plane, because circles stay circles.
pub fn sphere_with_hole(hole_half_angle: f64, n: usize, sampling: Sampling, outside: usize) -> Shape {
    let hole = between(1.0, hole_half_angle, 170.0).to_radians();
    let mut globe = Globe {
        hole,
        points: 0.0,
        h: 0.0,
        inmost: 0.0,
    };
    for _ in 0..3 {
        globe.points = lattice_count(n, sampling, &globe) * 2.0 / (1.0 + globe.hole.cos());
        globe.h = (2.0 * TAU * 2.0 / (3f64.sqrt() * globe.points)).sqrt();
        globe.hole = globe.hole.max(2.5 * globe.h);
    }
    let room = (globe.hole / globe.h - 0.5) / 1.7 - 1.0;
    let outside = outside.min(room.max(0.0) as usize);
    globe.inmost = (globe.hole - margin(outside) * globe.h).max(0.5 * globe.h);
    let points = sample(&globe, sampling);
    let radius = globe.radius();
    let plane: Vec<[f64; 2]> = points
        .iter()
        .map(|&p| globe.chart(p).map(|x| x * radius))
        .collect();
    let free: Vec<bool> = points.iter().map(|p| p[2] > -globe.hole.cos()).collect();
    let chart: Chart<[f64; 3]> = cut(&points, &delaunay(&plane), &free, outside);
    Shape::lifted(chart, Some(Surface::Sphere), |p| {
        on_sphere(p, globe.chart(p).map(|x| x * radius), radius)
    })
}

/// The sphere without a cap about the south pole.
struct Globe {
    /// Half angle of the hole, radians.
    hole: f64,
    /// Lattice points on the whole sphere.
    points: f64,
    h: f64,
    /// No point is nearer to the south pole than this angle.
    inmost: f64,
}

impl Globe {
    /// Of the free part in the stereographic plane.
    fn radius(&self) -> f64 {
        1.0 / (0.5 * self.hole).tan()
    }
}

impl Domain for Globe {
    type Point = [f64; 3];

    fn spacing(&self) -> f64 {
        self.h
    }

    fn lattice(&self, factor: f64) -> Vec<[f64; 3]> {
        let n = (self.points * factor * factor).round();
        // The golden angle, in turns.
        let turn = 0.5 * (3.0 - 5f64.sqrt());
        let place = |i: usize| {
            let i = i as f64;
            let z = 1.0 - (2.0 * i + 1.0) / n;
            let (sin, cos) = (TAU * (turn * i).fract()).sin_cos();
            let r = (1.0 - z * z).sqrt();
            unit([r * cos, r * sin, z])
        };
        (0..n as usize)
            .map(place)
            .filter(|p| p[2] > -self.inmost.cos())
            .collect()
    }

    fn embed(&self, p: [f64; 3]) -> [f64; 3] {
        p
    }

    fn shake(&self, p: [f64; 3], amount: f64, rng: &mut Rng) -> [f64; 3] {
        let q = unit(p.map(|x| x + rng.between(-amount, amount)));
        if q[2] > -self.inmost.cos() { q } else { p }
    }

    fn draw(&self, rng: &mut Rng) -> [f64; 3] {
        let (z, angle) = (rng.between(-self.inmost.cos(), 1.0), TAU * rng.unit());
        let r = (1.0 - z * z).max(0.0).sqrt();
        unit([r * angle.cos(), r * angle.sin(), z])
    }

    fn chart(&self, p: [f64; 3]) -> [f64; 2] {
        let scale = self.radius() * (1.0 + p[2]);
        [p[0] / scale, p[1] / scale]
    }

    fn density(&self, c: [f64; 2]) -> f64 {
        let (r, radius) = (c[0].hypot(c[1]), self.radius());
        let area = 2.0 * radius / (1.0 + (r * radius).powi(2));
        if r < 1.0 {
            area * area / (2.0 * PI * (1.0 + self.hole.cos()))
        } else {
            0.0
        }
    }
}
