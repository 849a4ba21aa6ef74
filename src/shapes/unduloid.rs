//! The unduloid (Delaunay 1841): the profile of constant mean curvature.
//!
//! With `2 H = 2 / (neck + bulge)` (without sign), `B = (bulge - neck) / (bulge + neck)` and the arc length
//! `s` from the neck, `theta = 2 H s` (Kenmotsu 1980):
//! `r^2 = (1 + B^2 - 2 B cos theta) / (2 H)^2`, `dz/ds = (1 - B cos theta) / (2 H r)`.

use super::arithmetic::between;
use super::profile::Profile;
use std::f64::consts::{PI, TAU};

const PANELS: usize = 64;
const NODES: usize = 12;

/// A surface of revolution of constant mean curvature about the z axis, its neck at z = 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Unduloid {
    neck: f64,
    bulge: f64,
    gauss: [[f64; 2]; NODES],
    /// z and the conformal height v at theta = 2 pi j / PANELS, one period.
    table: Vec<[f64; 2]>,
}

impl Unduloid {
    /// The unduloid of smallest radius `neck` and largest radius `bulge`; the neck is kept between
    /// 1/20 and 19/20 of the bulge, where the profile is good to 1e-13.
    pub fn new(neck: f64, bulge: f64) -> Self {
        let bulge = if bulge.is_finite() && bulge > 0.0 {
            bulge
        } else {
            1.0
        };
        let neck = between(0.05 * bulge, neck, 0.95 * bulge);
        let mut u = Unduloid {
            neck,
            bulge,
            gauss: gauss_legendre(),
            table: vec![[0.0; 2]],
        };
        for j in 0..PANELS {
            let (low, high) = (panel_start(j), panel_start(j + 1));
            let d = u.integral(low, high);
            let last = u.table[j];
            u.table.push([last[0] + d[0], last[1] + d[1]]);
        }
        u
    }

    /// The smallest radius.
    pub fn neck(&self) -> f64 {
        self.neck
    }

    /// The largest radius.
    pub fn bulge(&self) -> f64 {
        self.bulge
    }

    /// The constant mean curvature, `-1 / (neck + bulge)`.
    pub fn mean_curvature(&self) -> f64 {
        -1.0 / (self.neck + self.bulge)
    }

    /// The length of one wave along the axis.
    pub fn period(&self) -> f64 {
        self.table[PANELS][0]
    }

    fn curvature2(&self) -> f64 {
        2.0 / (self.neck + self.bulge)
    }

    fn eccentricity(&self) -> f64 {
        (self.bulge - self.neck) / (self.bulge + self.neck)
    }

    fn radius(&self, theta: f64) -> f64 {
        // neck^2 + 4 B sin^2(theta/2) / (2 H)^2, without the cancellation at the neck
        let swell = 4.0 * self.eccentricity() * (0.5 * theta).sin().powi(2);
        (self.neck.powi(2) + swell / self.curvature2().powi(2)).sqrt()
    }

    /// dz/dtheta and dv/dtheta, where dv = ds / r makes (angle, v) conformal.
    fn rates(&self, theta: f64) -> [f64; 2] {
        let (k, r) = (self.curvature2(), self.radius(theta));
        [
            (1.0 - self.eccentricity() * theta.cos()) / (k * k * r),
            1.0 / (k * r),
        ]
    }

    fn integral(&self, low: f64, high: f64) -> [f64; 2] {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let mut sum = [0.0; 2];
        for [x, w] in self.gauss {
            let f = self.rates(middle + half * x);
            sum = [sum[0] + half * w * f[0], sum[1] + half * w * f[1]];
        }
        sum
    }

    /// z and v at theta.
    fn heights(&self, theta: f64) -> [f64; 2] {
        let wave = (theta / TAU).floor();
        let rest = theta - wave * TAU;
        let j = ((rest / TAU * PANELS as f64) as usize).min(PANELS - 1);
        let (d, last) = (self.integral(panel_start(j), rest), self.table[PANELS]);
        std::array::from_fn(|i| wave * last[i] + self.table[j][i] + d[i])
    }

    /// theta at the conformal height v, to about 1e-12 (the point is on the surface all the same).
    pub(super) fn theta(&self, v: f64) -> f64 {
        let last = self.table[PANELS][1];
        let wave = (v / last).floor();
        let rest = v - wave * last;
        let j = self.table.partition_point(|e| e[1] <= rest).clamp(1, PANELS) - 1;
        let low = panel_start(j);
        let mut theta = low + (rest - self.table[j][1]) / self.rates(low)[1];
        for _ in 0..3 {
            let v = self.table[j][1] + self.integral(low, theta)[1];
            theta += (rest - v) / self.rates(theta)[1];
        }
        theta + wave * TAU
    }

    /// The conformal height of a point of the profile.
    pub(super) fn conformal_height(&self, theta: f64) -> f64 {
        self.heights(theta)[1]
    }

    /// The profile by theta.
    pub(super) fn profile(&self, theta: f64) -> Profile {
        let (k, b, r) = (self.curvature2(), self.eccentricity(), self.radius(theta));
        let (sin, cos) = theta.sin_cos();
        // By arc length first.
        let dr = b * sin / (k * r);
        let dz = (1.0 - b * cos) / (k * r);
        let ddr = (b * cos - dr * dr) / r;
        let ddz = -dr * ddr / dz;
        Profile {
            at: [r, self.heights(theta)[0]],
            slope: [dr / k, dz / k],
            bend: [ddr / (k * k), ddz / (k * k)],
        }
    }

    /// Parameters of a scan for the point nearest to a point of height z: one wave about it.
    pub(super) fn starts(&self, z: f64) -> Vec<f64> {
        let about = TAU * z / self.period();
        (-16..=16).map(|i| about + PI * f64::from(i) / 16.0).collect()
    }
}

fn panel_start(j: usize) -> f64 {
    TAU * j as f64 / PANELS as f64
}

/// Nodes and weights of Gauss-Legendre quadrature on (-1, 1), by Newton's method.
fn gauss_legendre() -> [[f64; 2]; NODES] {
    let legendre = |x: f64| {
        let (mut p, mut q) = (1.0, 0.0);
        for k in 0..NODES {
            let k = k as f64;
            (p, q) = (((2.0 * k + 1.0) * x * p - k * q) / (k + 1.0), p);
        }
        (p, NODES as f64 * (x * p - q) / (x * x - 1.0))
    };
    std::array::from_fn(|i| {
        let mut x = (PI * (i as f64 + 0.75) / (NODES as f64 + 0.5)).cos();
        for _ in 0..8 {
            let (p, d) = legendre(x);
            x -= p / d;
        }
        let d = legendre(x).1;
        [x, 2.0 / ((1.0 - x * x) * d * d)]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quadrature_is_exact_for_polynomials() {
        let g = gauss_legendre();
        for degree in (0..2 * NODES as i32).step_by(2) {
            let sum: f64 = g.iter().map(|[x, w]| w * x.powi(degree)).sum();
            assert!(
                (sum - 2.0 / f64::from(degree + 1)).abs() < 1e-14,
                "{degree}: {sum}"
            );
        }
    }

    /// The first integral of Delaunay's profiles, `r dz/ds - H r^2 = const`, and |profile'| = 1 by s.
    #[test]
    fn first_integral_and_arc_length() {
        for (neck, bulge) in [(0.05, 1.0), (0.6, 1.0), (0.9, 1.3)] {
            let u = Unduloid::new(neck, bulge);
            let h = -u.mean_curvature();
            for i in -50..50 {
                let p = u.profile(0.11 * f64::from(i));
                let speed = p.slope[0].hypot(p.slope[1]) * 2.0 * h;
                assert!((speed - 1.0).abs() < 1e-12, "{speed}");
                let c = p.at[0] * p.slope[1] * 2.0 * h - h * p.at[0].powi(2);
                assert!((c - h * neck * bulge).abs() < 1e-13, "{c}");
            }
        }
    }

    /// z against composite Simpson with two step widths' worth of points.
    #[test]
    fn height_against_simpson() {
        let u = Unduloid::new(0.05, 1.0);
        let (m, end) = (200_000, 2.3);
        let f = |i: usize| u.rates(end * i as f64 / m as f64)[0];
        let mut sum = f(0) + f(m);
        for i in 1..m {
            sum += f(i) * if i % 2 == 1 { 4.0 } else { 2.0 };
        }
        let z = sum * end / (3 * m) as f64;
        assert!((u.heights(end)[0] - z).abs() < 1e-13, "{} {z}", u.heights(end)[0]);
    }
}
