//! Parameter domains: the disc and the periodic band.

use super::chart::MOST_OUTSIDE;
use super::chart::{Chart, cut, delaunay, delaunay_periodic};
use super::rng::Rng;
use super::sampling::{Domain, Sampling, lattice_count, sample};
use std::f64::consts::{PI, TAU};

/// Width of the margin that is triangulated around the free part, in spacings: room for the rings and
/// for the bad triangles at the hull.
pub(super) fn margin(outside: usize) -> f64 {
    1.5 * outside.min(MOST_OUTSIDE) as f64 + 5.0
}

/// A disc of the given radius about the origin, triangulated.
pub(super) fn disc_chart(radius: f64, n: usize, sampling: Sampling, outside: usize) -> Chart<[f64; 2]> {
    let disc = Disc::new(radius, n, sampling, outside);
    let points = sample(&disc, sampling);
    let free: Vec<bool> = points.iter().map(|p| p[0].hypot(p[1]) < radius).collect();
    cut(&points, &delaunay(&points), &free, outside)
}

/// A disc about `centre` whose triangulation has rays from the origin, at these angles in degrees, among its edges.
pub(super) fn disc_chart_along(
    rays: &[f64],
    (centre, radius): ([f64; 2], f64),
    n: usize,
    sampling: Sampling,
    outside: usize,
) -> Chart<[f64; 2]> {
    let disc = Disc::new(radius, n, sampling, outside);
    let directions: Vec<[f64; 2]> = rays
        .iter()
        .map(|ray| [ray.to_radians().cos(), ray.to_radians().sin()])
        .collect();
    let sampled = sample(&disc, sampling);
    let mut points: Vec<[f64; 2]> = sampled
        .iter()
        .map(|p| [p[0] + centre[0], p[1] + centre[1]])
        .collect();
    // No vertex is within the circle over an edge of a ray, which is so an edge of the triangulation.
    points.retain(|p| directions.iter().all(|d| from_ray(*p, *d) > 0.51 * disc.h));
    points.push([0.0, 0.0]);
    let steps = ((disc.reach + centre[0].hypot(centre[1])) / disc.h) as usize;
    for d in &directions {
        let along = (1..=steps).map(|k| d.map(|x| x * k as f64 * disc.h));
        points.extend(along.filter(|p| (p[0] - centre[0]).hypot(p[1] - centre[1]) < disc.reach));
    }
    let free: Vec<bool> = points
        .iter()
        .map(|p| (p[0] - centre[0]).hypot(p[1] - centre[1]) < radius)
        .collect();
    cut(&points, &delaunay(&points), &free, outside)
}

/// The distance from the ray in this direction from the origin.
fn from_ray(p: [f64; 2], d: [f64; 2]) -> f64 {
    let along = (p[0] * d[0] + p[1] * d[1]).max(0.0);
    (p[0] - along * d[0]).hypot(p[1] - along * d[1])
}

/// The rectangle with these half sides about the origin, triangulated; the rings outside stay within the half sides of `whole`.
pub(super) fn rectangle_chart(
    half: [f64; 2],
    whole: [f64; 2],
    n: usize,
    sampling: Sampling,
    outside: usize,
) -> Chart<[f64; 2]> {
    let radius = half[0].hypot(half[1]);
    let mut disc = Disc {
        radius,
        rectangle: Some(half),
        h: 0.0,
        reach: 0.0,
    };
    let count = lattice_count(n, sampling, &disc);
    disc.h = (8.0 * half[0] * half[1] / (3f64.sqrt() * count)).sqrt();
    let room = (whole[0] - half[0]).min(whole[1] - half[1]) / disc.h;
    let outside = outside.min((room / 1.7 - 1.0).max(0.0) as usize);
    disc.reach = radius + margin(outside) * disc.h;
    let mut points = sample(&disc, sampling);
    points.retain(|p| p[0].abs() < whole[0] && p[1].abs() < whole[1]);
    let free: Vec<bool> = points
        .iter()
        .map(|p| p[0].abs() < half[0] && p[1].abs() < half[1])
        .collect();
    cut(&points, &delaunay(&points), &free, outside)
}

struct Disc {
    radius: f64,
    /// Half sides of the free part, where that is a rectangle in the disc.
    rectangle: Option<[f64; 2]>,
    h: f64,
    reach: f64,
}

impl Disc {
    /// About the origin, of this radius, with room for the triangles outside.
    fn new(radius: f64, n: usize, sampling: Sampling, outside: usize) -> Self {
        let mut disc = Self {
            radius,
            rectangle: None,
            h: 0.0,
            reach: 0.0,
        };
        let count = lattice_count(n, sampling, &disc);
        disc.h = (TAU * radius * radius / (3f64.sqrt() * count)).sqrt();
        disc.reach = radius + margin(outside) * disc.h;
        disc
    }
}

impl Domain for Disc {
    type Point = [f64; 2];

    fn spacing(&self) -> f64 {
        self.h
    }

    fn lattice(&self, factor: f64) -> Vec<[f64; 2]> {
        let (hx, hy) = (self.h / factor, self.h / factor * 0.75f64.sqrt());
        let (m, rows) = ((self.reach / hx) as i64 + 2, (self.reach / hy) as i64 + 2);
        let mut points = Vec::new();
        for j in -rows..=rows {
            for i in -m..=m {
                // Off centre, so that the boundary meets the lattice in no special way.
                let x = (i as f64 + 0.5 * (j & 1) as f64 + 0.31) * hx;
                let y = (j as f64 + 0.17) * hy;
                if x.hypot(y) < self.reach {
                    points.push([x, y]);
                }
            }
        }
        points
    }

    fn embed(&self, p: [f64; 2]) -> [f64; 3] {
        [p[0], p[1], 0.0]
    }

    fn shake(&self, p: [f64; 2], amount: f64, rng: &mut Rng) -> [f64; 2] {
        p.map(|x| x + rng.between(-amount, amount))
    }

    fn draw(&self, rng: &mut Rng) -> [f64; 2] {
        let (r, angle) = (self.reach * rng.unit().sqrt(), TAU * rng.unit());
        [r * angle.cos(), r * angle.sin()]
    }

    fn chart(&self, p: [f64; 2]) -> [f64; 2] {
        p.map(|x| x / self.radius)
    }

    fn density(&self, c: [f64; 2]) -> f64 {
        let (within, area) = match self.rectangle {
            None => (c[0].hypot(c[1]) < 1.0, PI),
            Some(half) => {
                let [a, b] = half.map(|side| side / self.radius);
                (c[0].abs() < a && c[1].abs() < b, 4.0 * a * b)
            }
        };
        if within { 1.0 / area } else { 0.0 }
    }
}

/// The band `low < v < high`, `u` periodic with 2 pi, triangulated.
pub(super) fn band_chart(
    low: f64,
    high: f64,
    n: usize,
    sampling: Sampling,
    outside: usize,
) -> Chart<[f64; 2]> {
    let mut band = Band {
        low,
        high,
        columns: 8.0,
        rows: 2.0,
        beyond: 0.0,
    };
    let count = lattice_count(n, sampling, &band);
    let h = (TAU * (high - low) * 2.0 / (3f64.sqrt() * count)).sqrt();
    band.columns = (TAU / h).round().max(8.0);
    // The rows on the boundaries themselves are fixed; shaken, half of them fall inside.
    let boundaries = if matches!(sampling, Sampling::Irregular { .. }) {
        0.0
    } else {
        1.0
    };
    band.rows = ((count / band.columns).round() + boundaries).max(2.0);
    band.beyond = margin(outside).ceil();
    let points = sample(&band, sampling);
    let rounding = 1e-9 * (high - low) / band.rows;
    let free: Vec<bool> = points
        .iter()
        .map(|p| p[1] > low + rounding && p[1] < high - rounding)
        .collect();
    let overlap = (10.0 * TAU / band.columns).min(TAU);
    cut(&points, &delaunay_periodic(&points, TAU, overlap), &free, outside)
}

struct Band {
    low: f64,
    high: f64,
    columns: f64,
    rows: f64,
    /// Rows beyond each boundary.
    beyond: f64,
}

impl Band {
    fn step(&self) -> f64 {
        (self.high - self.low) / self.rows
    }
}

impl Domain for Band {
    type Point = [f64; 2];

    fn spacing(&self) -> f64 {
        TAU / self.columns
    }

    fn lattice(&self, factor: f64) -> Vec<[f64; 2]> {
        let columns = (self.columns * factor).round() as i64;
        let (rows, beyond) = (
            (self.rows * factor).round() as i64,
            (self.beyond * factor).ceil() as i64,
        );
        let mut points = Vec::new();
        for j in -beyond..=rows + beyond {
            let v = self.low + (self.high - self.low) * j as f64 / rows as f64;
            for i in 0..columns {
                points.push([(i as f64 + 0.25 + 0.5 * (j & 1) as f64) * TAU / columns as f64, v]);
            }
        }
        points
    }

    fn embed(&self, p: [f64; 2]) -> [f64; 3] {
        [p[0].cos(), p[0].sin(), p[1]]
    }

    fn shake(&self, p: [f64; 2], amount: f64, rng: &mut Rng) -> [f64; 2] {
        let u = (p[0] + rng.between(-amount, amount)).rem_euclid(TAU);
        [if u < TAU { u } else { 0.0 }, p[1] + rng.between(-amount, amount)]
    }

    fn draw(&self, rng: &mut Rng) -> [f64; 2] {
        let reach = self.beyond * self.step();
        [
            rng.between(0.0, TAU),
            rng.between(self.low - reach, self.high + reach),
        ]
    }

    fn chart(&self, p: [f64; 2]) -> [f64; 2] {
        [
            p[0] / PI - 1.0,
            (2.0 * p[1] - self.low - self.high) / (self.high - self.low),
        ]
    }

    fn density(&self, c: [f64; 2]) -> f64 {
        if c[0].abs() < 1.0 && c[1].abs() < 1.0 {
            0.25
        } else {
            0.0
        }
    }
}
