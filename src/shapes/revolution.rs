//! Bands of surfaces of revolution about the z axis, in conformal coordinates: the angle u and a height v
//! with dv = ds / r, so that equilateral triangles of the chart stay equilateral.

use super::arithmetic::between;
use super::arithmetic::unit;
use super::chart::Chart;
use super::harmonic_profile::{HarmonicProfile, ProfileError};
use super::planar::band_chart;
use super::sampling::Sampling;
use super::shape::{Lifted, Shape};
use super::surface::Surface;
use super::unduloid::Unduloid;
use std::f64::consts::PI;

/// A point of a profile: r, z and its direction (dr, dz), dz > 0.
struct Meridian {
    r: f64,
    z: f64,
    slope: [f64; 2],
}

/// Lifts the band `low < v < high`; `flat_radius` gives the wrong radius at (v, z).
fn revolve(
    surface: Surface,
    range: [f64; 2],
    (n, sampling, outside): (usize, Sampling, usize),
    meridian: impl Fn(f64) -> Meridian,
    flat_radius: impl Fn(f64, &Meridian) -> f64,
) -> Shape {
    let chart = band_chart(range[0], range[1], n, sampling, outside);
    lift(chart, surface, meridian, |v, m| [flat_radius(v, m), m.z])
}

/// Lifts a chart; `flat` gives the wrong r and z at v.
fn lift(
    chart: Chart<[f64; 2]>,
    surface: Surface,
    meridian: impl Fn(f64) -> Meridian,
    flat: impl Fn(f64, &Meridian) -> [f64; 2],
) -> Shape {
    Shape::lifted(chart, Some(surface), |[u, v]| {
        let (sin, cos) = u.sin_cos();
        let m = meridian(v);
        let [f, flat_z] = flat(v, &m);
        Lifted {
            position: [m.r * cos, m.r * sin, m.z],
            normal: unit([m.slope[1] * cos, m.slope[1] * sin, -m.slope[0]]),
            flat: [f * cos, f * sin, flat_z],
        }
    })
}

/// Radius of the straight tube (a cone in general) through two meridian points.
fn straight(a: &Meridian, b: &Meridian) -> impl Fn(f64, &Meridian) -> f64 + use<> {
    let (r, z, slope) = (a.r, a.z, (b.r - a.r) / (b.z - a.z));
    move |_, m| r + slope * (m.z - z)
}

/// The cylinder of radius 1, free where |z| < 1.
pub fn cylinder_band(n: usize, sampling: Sampling, outside: usize) -> Shape {
    let meridian = |v| Meridian {
        r: 1.0,
        z: v,
        slope: [0.0, 1.0],
    };
    let pinched = |v: f64, _: &Meridian| 1.0 - 0.4 * (1.0 - v * v).max(0.0);
    revolve(
        Surface::Cylinder,
        [-1.0, 1.0],
        (n, sampling, outside),
        meridian,
        pinched,
    )
}

/// The catenoid `r = cosh z`, free where |z| < 0.9.
pub fn catenoid_band(n: usize, sampling: Sampling, outside: usize) -> Shape {
    let meridian = |v: f64| Meridian {
        r: v.cosh(),
        z: v,
        slope: [v.sinh(), 1.0],
    };
    let flat = straight(&meridian(-0.9), &meridian(0.9));
    revolve(
        Surface::Catenoid,
        [-0.9, 0.9],
        (n, sampling, outside),
        meridian,
        flat,
    )
}

/// The unit sphere between two latitudes in degrees (within -85 and 85, at least 5 apart).
pub fn sphere_zone(south: f64, north: f64, n: usize, sampling: Sampling, outside: usize) -> Shape {
    let south = between(-85.0, south, 80.0);
    let north = between(south + 5.0, north, 85.0);
    // Mercator: v = artanh(sin latitude).
    let range = [south, north].map(|l| l.to_radians().sin().atanh());
    let meridian = |v: f64| {
        let (r, z) = (1.0 / v.cosh(), v.tanh());
        Meridian { r, z, slope: [-z, r] }
    };
    let flat = straight(&meridian(range[0]), &meridian(range[1]));
    revolve(Surface::Sphere, range, (n, sampling, outside), meridian, flat)
}

/// Nearly half a wave (0.45) of the unduloid between the radii `neck` and `bulge`, centred on the neck.
/// For the ranges of the radii see [`Unduloid::new`].
pub fn unduloid_band(neck: f64, bulge: f64, n: usize, sampling: Sampling, outside: usize) -> Shape {
    let u = Unduloid::new(neck, bulge);
    let end = u.conformal_height(0.45 * PI);
    let meridian = |v: f64| {
        let p = u.profile(u.theta(v));
        Meridian {
            r: p.at[0],
            z: p.at[1],
            slope: p.slope,
        }
    };
    let flat = straight(&meridian(-end), &meridian(end));
    revolve(
        Surface::Unduloid(u.clone()),
        [-end, end],
        (n, sampling, outside),
        meridian,
        flat,
    )
}

/// The surface of revolution of harmonic mean curvature with this profile: an exact solution of `Delta_B H = 0` whose `H` is
/// not constant; with a biharmonic profile, of `Delta_B^2 H = 0`.
///
/// # Errors
/// The rings outside come too near to the axis, or cross the profile.
pub fn revolution_band(
    profile: &HarmonicProfile,
    n: usize,
    sampling: Sampling,
    outside: usize,
) -> Result<Shape, ProfileError> {
    let [low, high] = profile.range();
    let chart = band_chart(low, high, n, sampling, outside);
    let mut whole = profile.clone();
    let around = |[low, high]: [f64; 2], p: &[f64; 2]| [low.min(p[1]), high.max(p[1])];
    whole.extend(chart.points.iter().fold([low, high], around))?;
    let meridian = |v: f64| {
        let p = whole.profile(v);
        Meridian {
            r: p.at[0],
            z: p.at[1],
            slope: p.slope,
        }
    };
    let [a, b] = [low, high].map(&meridian);
    let flat = |v: f64, _: &Meridian| {
        let part = (v - low) / (high - low);
        [a.r + part * (b.r - a.r), a.z + part * (b.z - a.z)]
    };
    Ok(lift(chart, Surface::Revolution(whole.clone()), meridian, flat))
}
