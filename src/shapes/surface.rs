//! The exact surfaces: distance and mean curvature.

use super::arithmetic::unit;
use super::ellipsoid::Ellipsoid;
use super::harmonic_profile::HarmonicProfile;
use super::profile::Profile;
use super::torus::Torus;
use super::unduloid::Unduloid;

/// An exact surface. Axes of revolution are the z axis.
///
/// The sign convention is that of the crate: with outward normals `H` is negative on a sphere.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Surface {
    /// The unit sphere about the origin.
    Sphere,
    /// The cylinder of radius 1.
    Cylinder,
    /// The catenoid of radius `cosh z`: a minimal surface.
    Catenoid,
    /// A surface of revolution of constant mean curvature.
    Unduloid(Unduloid),
    /// A surface of revolution of harmonic or biharmonic mean curvature.
    Revolution(HarmonicProfile),
    /// The ellipsoid about the origin.
    Ellipsoid(Ellipsoid),
    /// The torus about the z axis.
    Torus(Torus),
    /// Another surface moved and scaled.
    Placed {
        /// Where the surface went.
        by: Similarity,
        /// The surface before.
        surface: Box<Surface>,
    },
}

impl Surface {
    /// Distance of a point from the surface, in the units of the point, to rounding (1e-14).
    pub fn distance(&self, p: [f64; 3]) -> f64 {
        self.signed_distance(p).abs()
    }

    /// As [`Surface::distance`], positive on the side of the outward normals.
    ///
    /// The nearest point is sought in the plane through the axis; far from any but sphere and cylinder it is
    /// the nearest one along a coarse scan of the profile.
    pub fn signed_distance(&self, p: [f64; 3]) -> f64 {
        match self {
            Surface::Sphere => p[0].hypot(p[1]).hypot(p[2]) - 1.0,
            Surface::Cylinder => p[0].hypot(p[1]) - 1.0,
            Surface::Catenoid => closest(catenoid_profile, catenoid_starts(p), p).1,
            Surface::Unduloid(u) => closest(|t| u.profile(t), u.starts(p[2]), p).1,
            Surface::Revolution(h) => closest(|v| h.profile(v), vec![h.start(p)], p).1,
            Surface::Ellipsoid(e) => e.signed_distance(p),
            Surface::Torus(t) => t.signed_distance(p),
            Surface::Placed { by, surface } => by.scale * surface.signed_distance(by.undo(p)),
        }
    }

    /// Exact mean curvature `(k1 + k2) / 2` at the surface point nearest to `p`.
    pub fn mean_curvature(&self, p: [f64; 3]) -> f64 {
        match self {
            Surface::Sphere => -1.0,
            Surface::Cylinder => -0.5,
            Surface::Catenoid => 0.0,
            Surface::Unduloid(u) => u.mean_curvature(),
            Surface::Revolution(h) => h.mean_curvature(closest(|v| h.profile(v), vec![h.start(p)], p).0),
            Surface::Ellipsoid(e) => e.mean_curvature(e.nearest(p)),
            Surface::Torus(t) => t.mean_curvature(p),
            Surface::Placed { by, surface } => surface.mean_curvature(by.undo(p)) / by.scale,
        }
    }

    /// Exact outward unit normal at the surface point nearest to `p`; zero on the axis or at the centre.
    pub fn normal(&self, p: [f64; 3]) -> [f64; 3] {
        match self {
            Surface::Sphere => unit(p),
            Surface::Cylinder => unit([p[0], p[1], 0.0]),
            Surface::Catenoid => outward(
                p,
                catenoid_profile(closest(catenoid_profile, catenoid_starts(p), p).0).slope,
            ),
            Surface::Unduloid(u) => {
                outward(p, u.profile(closest(|t| u.profile(t), u.starts(p[2]), p).0).slope)
            }
            Surface::Revolution(h) => outward(
                p,
                h.profile(closest(|v| h.profile(v), vec![h.start(p)], p).0).slope,
            ),
            Surface::Ellipsoid(e) => e.normal(e.nearest(p)),
            Surface::Torus(t) => t.normal(p),
            Surface::Placed { by, surface } => by.turn(surface.normal(by.undo(p))),
        }
    }
}

/// Outward normal of a surface of revolution at the angle of `p`, from the slope (r', z') of its profile.
fn outward(p: [f64; 3], slope: [f64; 2]) -> [f64; 3] {
    let radial = unit([p[0], p[1], 0.0]);
    unit([radial[0] * slope[1], radial[1] * slope[1], -slope[0]])
}

fn catenoid_profile(t: f64) -> Profile {
    let (sh, ch) = (t.sinh(), t.cosh());
    Profile {
        at: [ch, t],
        slope: [sh, 1.0],
        bend: [ch, 0.0],
    }
}

fn catenoid_starts(p: [f64; 3]) -> Vec<f64> {
    let far = p[0].hypot(p[1]).max(1.0).acosh() + 1e-3;
    let z = p[2].clamp(-far - 1.0, far + 1.0);
    (0..=16).map(|i| -far + far * i as f64 / 8.0).chain([z]).collect()
}

/// Parameter of the profile point nearest to `p` and the signed distance (outward positive).
///
/// Newton's method on half the squared distance from the best of the starts; a step that would lengthen
/// the distance is halved.
fn closest(profile: impl Fn(f64) -> Profile, starts: Vec<f64>, p: [f64; 3]) -> (f64, f64) {
    let q = [p[0].hypot(p[1]), p[2]];
    let gap = |c: &Profile| [q[0] - c.at[0], q[1] - c.at[1]];
    let square = |c: &Profile| gap(c)[0].powi(2) + gap(c)[1].powi(2);
    let scan = starts.into_iter().map(|t| (square(&profile(t)), t));
    let mut t = scan.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |best| best.1);
    let mut c = profile(t);
    for _ in 0..60 {
        let e = gap(&c);
        let slope = c.slope[0].powi(2) + c.slope[1].powi(2);
        let bend = slope - e[0] * c.bend[0] - e[1] * c.bend[1];
        let along = e[0] * c.slope[0] + e[1] * c.slope[1];
        let mut step = along / if bend > 0.1 * slope { bend } else { slope };
        let mut next = profile(t + step);
        while step.abs() > 1e-9 && square(&next) > square(&c) {
            step *= 0.5;
            next = profile(t + step);
        }
        t += step;
        c = next;
        if step.abs() <= 1e-12 {
            break;
        }
    }
    let e = gap(&c);
    (
        t,
        (e[0] * c.slope[1] - e[1] * c.slope[0]) / c.slope[0].hypot(c.slope[1]),
    )
}

/// A rotation followed by a scaling and a translation: `p -> scale * rotation * p + translation`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Similarity {
    /// Rows of an orthogonal matrix of determinant 1.
    pub rotation: [[f64; 3]; 3],
    /// A positive factor.
    pub scale: f64,
    /// Added last.
    pub translation: [f64; 3],
}

impl Similarity {
    /// Rotation by `angle` radians about `axis` (any length but zero), then scaling, then translation.
    pub fn new(axis: [f64; 3], angle: f64, scale: f64, translation: [f64; 3]) -> Self {
        let a = unit(axis);
        let (s, c) = angle.sin_cos();
        let cross = [[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]];
        let entry = |i: usize, j: usize| {
            let same = if i == j { c } else { 0.0 };
            same + s * cross[i][j] + (1.0 - c) * a[i] * a[j]
        };
        let rotation = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
        Similarity {
            rotation,
            scale,
            translation,
        }
    }

    /// The image of a point.
    pub fn apply(&self, p: [f64; 3]) -> [f64; 3] {
        let r = self.turn(p);
        std::array::from_fn(|i| self.scale * r[i] + self.translation[i])
    }

    /// The image of a direction: the rotation alone.
    pub fn turn(&self, n: [f64; 3]) -> [f64; 3] {
        self.rotation
            .map(|row| row[0] * n[0] + row[1] * n[1] + row[2] * n[2])
    }

    /// The point whose image is `p`.
    pub fn undo(&self, p: [f64; 3]) -> [f64; 3] {
        let q: [f64; 3] = std::array::from_fn(|i| (p[i] - self.translation[i]) / self.scale);
        let r = &self.rotation;
        std::array::from_fn(|i| r[0][i] * q[0] + r[1][i] * q[1] + r[2][i] * q[2])
    }
}

/// Mean curvature at `x` of the level set with these unit normals: `2 H` is minus their divergence, here in differences of fourth order.
#[cfg(test)]
pub(super) fn mean_curvature_by_differences(normal: impl Fn([f64; 3]) -> [f64; 3], x: [f64; 3]) -> f64 {
    let d = 1e-3;
    let rate = |i: usize| {
        let n = |t: f64| {
            let mut y = x;
            y[i] += t * d;
            normal(y)[i]
        };
        (8.0 * (n(1.0) - n(-1.0)) - n(2.0) + n(-2.0)) / (12.0 * d)
    };
    -0.5 * (rate(0) + rate(1) + rate(2))
}
