//! Profiles of the surfaces of revolution of harmonic and biharmonic mean curvature.
//!
//! On a surface of revolution `Delta_B u` is `(r u')' / r`, by the arc length `s` of the profile. With its direction
//! `(r', z') = (cos f, sin f)` and the outward normal `(sin f, -cos f)` the curvatures are `-f'` and `-sin f / r`, so that
//! `f' = -2 H - sin f / r`. By the conformal height `v`, `dv = ds / r`, these become
//! `dr = r cos f`, `dz = r sin f`, `df = -2 H r - sin f`, `ds = r`. `Delta_B H = phi` reads `dH = q`, `dq = r^2 phi`, and
//! `Delta_B phi = 0` that `phi = phi0 + p v`: polynomials in `r`, `cos f` and `sin f`, whose Taylor series are products of series
//! (Moore 1966). Without `phi`, `H = H0 + c v` with `c = q`.

use super::profile::Profile;
use std::error::Error;
use std::fmt;

/// Terms of a series. A step is so long that the last ones are no more than `ROUNDING`.
const TERMS: usize = 24;
const ROUNDING: f64 = 1e-17;
/// The surface comes no nearer to the axis than this, and is no longer.
const LEAST_RADIUS: f64 = 0.05;
const MOST_LENGTH: f64 = 100.0;
/// Points per unit of conformal height at which the profile is looked at for crossings, and the most of them.
const DENSITY: f64 = 100.0;
const MOST_POINTS: f64 = 4_000.0;
/// Points of a scan for the nearest point of the profile.
const SCAN: usize = 64;

/// Why there is no such surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ProfileError {
    /// A parameter is no finite number, or the length is not positive or more than 100.
    Parameters,
    /// The profile comes nearer to the axis than 0.05 at this arc length.
    Axis(f64),
    /// The profile crosses itself where the arc length has these values.
    Crossing([f64; 2]),
}

impl fmt::Display for ProfileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let outside = "counting the rings of fixed triangles outside";
        match self {
            Self::Parameters => write!(f, "give numbers, and a length above 0 and up to {MOST_LENGTH}"),
            Self::Axis(s) => write!(
                f,
                "at arc length {s:.3} ({outside}) the profile is nearer to the axis than {LEAST_RADIUS}"
            ),
            Self::Crossing([s, t]) => write!(
                f,
                "the profile crosses itself at arc lengths {s:.3} and {t:.3} ({outside})"
            ),
        }
    }
}

impl Error for ProfileError {}

/// The profile with `r = 1`, `z = 0`, direction `f0` (radians, 0 away from the axis) and mean curvature `H0` at arc length 0,
/// and `dH/ds = c / r`, up to a given arc length. A biharmonic one begins with `dH/ds = c`, and has `phi = Delta_B H` with
/// `phi0` at arc length 0 and `dphi/ds = p / r`.
#[derive(Debug, Clone, PartialEq)]
pub struct HarmonicProfile {
    /// `phi0` and `p`.
    laplacian: [f64; 2],
    length: f64,
    /// The conformal height of the upper end.
    top: f64,
    /// By height: those below 0 are valid downwards, the others upwards.
    series: Vec<Series>,
    /// Heights with r and z there, among which the nearest point is sought first.
    scan: Vec<(f64, [f64; 2])>,
}

/// Taylor coefficients by `v - at`, good for distances up to `reach`.
#[derive(Debug, Clone, PartialEq)]
struct Series {
    at: f64,
    reach: f64,
    r: [f64; TERMS],
    z: [f64; TERMS],
    f: [f64; TERMS],
    s: [f64; TERMS],
    h: [f64; TERMS],
    q: [f64; TERMS],
}

impl Series {
    /// Of the solution with the values `[r, z, f, s, H, q]` at height `at`.
    fn new([r, z, f, s, h, q]: [f64; 6], at: f64, [phi0, p]: [f64; 2]) -> Self {
        let start = |value: f64| {
            let mut terms = [0.0; TERMS];
            terms[0] = value;
            terms
        };
        let (mut r, mut z, mut f, mut s) = (start(r), start(z), start(f), start(s));
        let (mut cos, mut sin) = (start(f[0].cos()), start(f[0].sin()));
        let (mut h, mut q) = (start(h), start(q));
        let (mut square, mut turn) = ([0.0; TERMS], [0.0; TERMS]);
        let mut phi = start(phi0 + p * at);
        phi[1] = p;
        for k in 0..TERMS - 1 {
            turn[k] = -2.0 * product(&h, &r, k) - sin[k];
            let by = 1.0 / (k + 1) as f64;
            r[k + 1] = by * product(&r, &cos, k);
            z[k + 1] = by * product(&r, &sin, k);
            f[k + 1] = by * turn[k];
            s[k + 1] = by * r[k];
            square[k] = product(&r, &r, k);
            h[k + 1] = by * q[k];
            q[k + 1] = by * product(&square, &phi, k);
            cos[k + 1] = -by * product(&sin, &turn, k);
            sin[k + 1] = by * product(&cos, &turn, k);
        }
        // Two terms, because one may vanish.
        let reach_of = |k: usize| {
            let last = [&r, &z, &f, &s, &h, &q].map(|x| x[k].abs());
            let relative = last.into_iter().fold(f64::MIN_POSITIVE, f64::max) / r[0].max(1.0);
            (ROUNDING / relative).powf(1.0 / k as f64)
        };
        let reach = reach_of(TERMS - 1).min(reach_of(TERMS - 2)).min(1.0);
        Self {
            at,
            reach,
            r,
            z,
            f,
            s,
            h,
            q,
        }
    }

    /// `[r, z, f, s, H, q]` at height `v`.
    fn values(&self, v: f64) -> [f64; 6] {
        let d = v - self.at;
        [&self.r, &self.z, &self.f, &self.s, &self.h, &self.q]
            .map(|x| x.iter().rev().fold(0.0, |sum, a| sum * d + a))
    }
}

/// Coefficient `k` of the product of two series.
fn product(a: &[f64; TERMS], b: &[f64; TERMS], k: usize) -> f64 {
    (0..=k).map(|i| a[i] * b[k - i]).sum()
}

impl HarmonicProfile {
    /// The profile between arc lengths 0 and `length`.
    ///
    /// # Errors
    /// See [`ProfileError`].
    pub fn new(f0: f64, h0: f64, c: f64, length: f64) -> Result<Self, ProfileError> {
        Self::biharmonic(f0, h0, c, [0.0; 2], length)
    }

    /// The profile on which `phi = Delta_B H` is harmonic: `laplacian` is `phi0` and `p`.
    ///
    /// ```
    /// use fairmesh_shapes::HarmonicProfile;
    /// let profile = HarmonicProfile::biharmonic(1.2, -0.8, 0.5, [0.7, -0.4], 1.0)?;
    /// let [r, _, _, h] = profile.at(0.0);
    /// assert!(r == 1.0 && h == -0.8);
    /// # Ok::<(), fairmesh_shapes::ProfileError>(())
    /// ```
    ///
    /// # Errors
    /// See [`ProfileError`].
    pub fn biharmonic(
        f0: f64,
        h0: f64,
        c: f64,
        laplacian: [f64; 2],
        length: f64,
    ) -> Result<Self, ProfileError> {
        let [phi0, p] = laplacian;
        let finite = [f0, h0, c, phi0, p, length].iter().all(|x| x.is_finite());
        if !finite || length <= 0.0 || length > MOST_LENGTH {
            return Err(ProfileError::Parameters);
        }
        let mut profile = Self {
            laplacian,
            length,
            top: 0.0,
            series: vec![Series::new([1.0, 0.0, f0, 0.0, h0, c], 0.0, laplacian)],
            scan: Vec::new(),
        };
        while profile.values(profile.ends()[1])[3] < length {
            profile.grow(true)?;
        }
        profile.top = profile.height(length);
        profile.check([0.0, profile.top])?;
        profile.prepare_scan();
        Ok(profile)
    }

    /// Continues the profile to these heights, for what lies around the surface.
    pub(super) fn extend(&mut self, [low, high]: [f64; 2]) -> Result<(), ProfileError> {
        while self.ends()[0] > low {
            self.grow(false)?;
        }
        while self.ends()[1] < high {
            self.grow(true)?;
        }
        self.prepare_scan();
        self.check([low, high])
    }

    fn prepare_scan(&mut self) {
        let [low, high] = self.ends();
        let height = |i: usize| low + (high - low) * i as f64 / SCAN as f64;
        self.scan = (0..=SCAN)
            .map(height)
            .map(|v| {
                let [r, z, ..] = self.values(v);
                (v, [r, z])
            })
            .collect();
    }

    /// The heights between which the series are good.
    fn ends(&self) -> [f64; 2] {
        let (first, last) = (&self.series[0], &self.series[self.series.len() - 1]);
        [first.at - first.reach, last.at + last.reach]
    }

    /// One more series at an end.
    fn grow(&mut self, up: bool) -> Result<(), ProfileError> {
        let at = self.ends()[usize::from(up)];
        let values = self.values(at);
        if values[0] < LEAST_RADIUS {
            return Err(ProfileError::Axis(values[3]));
        }
        let next = Series::new(values, at, self.laplacian);
        if up {
            self.series.push(next);
        } else {
            self.series.insert(0, next);
        }
        Ok(())
    }

    /// `[r, z, f, s, H, q]` at the conformal height `v`; what lies beyond the ends is moved to them.
    fn values(&self, v: f64) -> [f64; 6] {
        let [low, high] = self.ends();
        let v = v.clamp(low, high);
        let above = self.series.partition_point(|series| series.at <= v);
        let k = if v < 0.0 { above } else { above - 1 };
        self.series[k.min(self.series.len() - 1)].values(v)
    }

    /// The conformal height at an arc length of the surface, by Newton's method in a bracket.
    fn height(&self, s: f64) -> f64 {
        let [mut low, mut high] = [0.0, self.ends()[1]];
        let mut v = 0.5 * high;
        for _ in 0..100 {
            let [r, _, _, at, ..] = self.values(v);
            if at < s {
                low = v
            } else {
                high = v
            }
            let next = v + (s - at) / r;
            let next = if next > low && next < high {
                next
            } else {
                0.5 * (low + high)
            };
            if (next - v).abs() < 1e-15 * high {
                break;
            }
            v = next;
        }
        v
    }

    fn check(&self, [low, high]: [f64; 2]) -> Result<(), ProfileError> {
        let count = ((high - low) * DENSITY).clamp(8.0, MOST_POINTS) as usize;
        let points: Vec<_> = (0..=count)
            .map(|i| self.values(low + (high - low) * i as f64 / count as f64))
            .collect();
        if let Some(p) = points.iter().find(|p| p[0] < LEAST_RADIUS) {
            return Err(ProfileError::Axis(p[3]));
        }
        for (i, a) in points.windows(2).enumerate() {
            for b in points.windows(2).take(i.saturating_sub(1)) {
                if cross([&a[0], &a[1]], [&b[0], &b[1]]) {
                    return Err(ProfileError::Crossing([b[0][3], a[0][3]]));
                }
            }
        }
        Ok(())
    }

    /// The conformal heights of the two ends of the surface.
    pub(super) fn range(&self) -> [f64; 2] {
        [0.0, self.top]
    }

    /// The arc length of the profile.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Radius, height, direction and mean curvature at an arc length between 0 and [`HarmonicProfile::length`]:
    /// `[r, z, f, H]`.
    ///
    /// ```
    /// use fairmesh_shapes::HarmonicProfile;
    /// // A quarter of the unit circle from the equator on.
    /// let sphere = HarmonicProfile::new(90f64.to_radians(), -1.0, 0.0, 1.2)?;
    /// let [r, z, f, h] = sphere.at(1.0);
    /// assert!((r - 1f64.cos()).abs() < 1e-14 && (z - 1f64.sin()).abs() < 1e-14);
    /// assert!((f - 90f64.to_radians() - 1.0).abs() < 1e-14 && h == -1.0);
    /// # Ok::<(), fairmesh_shapes::ProfileError>(())
    /// ```
    pub fn at(&self, s: f64) -> [f64; 4] {
        let v = self.height(s.clamp(0.0, self.length));
        let [r, z, f, _, h, _] = self.values(v);
        [r, z, f, h]
    }

    /// `H` at a conformal height.
    pub(super) fn mean_curvature(&self, v: f64) -> f64 {
        self.values(v)[4]
    }

    /// The profile by conformal height.
    pub(super) fn profile(&self, v: f64) -> Profile {
        let [r, z, f, _, h, _] = self.values(v);
        let (sin, cos) = f.sin_cos();
        let turn = -2.0 * h * r - sin;
        Profile {
            at: [r, z],
            slope: [r * cos, r * sin],
            bend: [r * (cos * cos - sin * turn), r * (cos * sin + cos * turn)],
        }
    }

    /// Where the search for the point nearest to `p` begins.
    pub(super) fn start(&self, p: [f64; 3]) -> f64 {
        let q = [p[0].hypot(p[1]), p[2]];
        let square = |at: &[f64; 2]| (q[0] - at[0]).powi(2) + (q[1] - at[1]).powi(2);
        let nearest = self
            .scan
            .iter()
            .min_by(|a, b| square(&a.1).total_cmp(&square(&b.1)));
        nearest.map_or(0.0, |(v, _)| *v)
    }
}

/// Do two segments of the half-plane (r, z) cross?
fn cross(a: [&[f64; 6]; 2], b: [&[f64; 6]; 2]) -> bool {
    let side = |p: &[f64; 6], q: &[f64; 6], x: &[f64; 6]| {
        (q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0]) > 0.0
    };
    side(a[0], a[1], b[0]) != side(a[0], a[1], b[1]) && side(b[0], b[1], a[0]) != side(b[0], b[1], a[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn spheres_cylinders_and_catenoids_are_members() {
        let cylinder = HarmonicProfile::new(FRAC_PI_2, -0.5, 0.0, 50.0).unwrap();
        let catenoid = HarmonicProfile::new(FRAC_PI_2, 0.0, 0.0, 20.0).unwrap();
        let sphere = HarmonicProfile::new(FRAC_PI_2, -1.0, 0.0, 1.4).unwrap();
        for i in 0..=100 {
            let part = f64::from(i) / 100.0;
            let [r, z, f, _] = cylinder.at(50.0 * part);
            assert_near!(r, 1.0, 1e-13);
            assert_near!(z, 50.0 * part, 1e-12);
            assert_near!(f, FRAC_PI_2, 1e-13);
            // r = cosh z, s = sinh z.
            let s = 20.0 * part;
            let [r, z, ..] = catenoid.at(s);
            assert!(
                (r - 1f64.hypot(s)).abs() < 1e-12 && (z - s.asinh()).abs() < 1e-12,
                "{r} {z}"
            );
            let s = 1.4 * part;
            let [r, z, ..] = sphere.at(s);
            assert_near!(r, s.cos(), 1e-14);
            assert_near!(z, s.sin(), 1e-14);
        }
    }

    /// The equations by `s`, in fourth-order differences, and the flux `r dH/ds`.
    #[test]
    fn the_equations_hold() {
        for (f0, h0, c, length) in [
            (1.2, -0.8, 0.5, 1.5),
            (2.0, 0.3, -0.6, 1.0),
            (PI - 0.4, -1.5, 1.0, 0.6),
        ] {
            let profile = HarmonicProfile::new(f0, h0, c, length).unwrap();
            let d = 1e-3;
            for i in 1..10 {
                let s = 2.0 * d + (length - 4.0 * d) * f64::from(i) / 10.0;
                let [r, _, f, h] = profile.at(s);
                let by_s = |k: usize| {
                    let at = |j: f64| profile.at(s + j * d)[k];
                    (8.0 * (at(1.0) - at(-1.0)) - at(2.0) + at(-2.0)) / (12.0 * d)
                };
                assert_near!(by_s(0), f.cos(), 1e-10);
                assert_near!(by_s(1), f.sin(), 1e-10);
                assert_below!((by_s(2) + 2.0 * h + f.sin() / r).abs(), 1e-10);
                assert_near!(r * by_s(3), c, 1e-10);
            }
        }
    }

    /// `Delta_B H` by its definition, `(r H')' / r`, and its own flux `r dphi/ds`, in fourth-order differences.
    #[test]
    fn the_laplacian_of_a_biharmonic_profile_is_harmonic() {
        for (laplacian, length) in [([0.7, -0.4], 1.2), ([-2.0, 0.0], 1.0), ([0.5, 3.0], 0.8)] {
            let profile = HarmonicProfile::biharmonic(1.2, -0.8, 0.5, laplacian, length).unwrap();
            let d = 2e-3;
            let difference = |at: &dyn Fn(f64) -> f64, s: f64| {
                (8.0 * (at(s + d) - at(s - d)) - at(s + 2.0 * d) + at(s - 2.0 * d)) / (12.0 * d)
            };
            let r = |s: f64| profile.at(s)[0];
            let flux = |s: f64| r(s) * difference(&|s| profile.at(s)[3], s);
            let phi = |s: f64| difference(&flux, s) / r(s);
            for i in 1..10 {
                let s = 6.0 * d + (length - 12.0 * d) * f64::from(i) / 10.0;
                let v = profile.height(s);
                assert!(
                    (phi(s) - laplacian[0] - laplacian[1] * v).abs() < 1e-7,
                    "{}",
                    phi(s)
                );
                let turn = difference(&|s| profile.at(s)[2], s);
                let [r, _, f, h] = profile.at(s);
                assert_below!((turn + 2.0 * h + f.sin() / r).abs(), 1e-9);
            }
        }
    }

    /// What was continued downwards and begins there comes back to where it began.
    #[test]
    fn upwards_and_downwards_agree() {
        let mut profile = HarmonicProfile::new(1.2, -0.8, 0.5, 1.0).unwrap();
        profile.extend([-0.9, 1.5]).unwrap();
        let [r, z, f, s, h0, c] = profile.values(-0.8);
        // The same surface in units of its own first radius.
        let again = HarmonicProfile::new(f, h0 * r, c * r, (0.5 - s) / r).unwrap();
        for i in 0..=20 {
            let at = (0.5 - s) * f64::from(i) / 20.0;
            let [r_2, z_2, f_2, h_2] = again.at(at / r);
            let v = -0.8 + again.height(at / r);
            let [r_1, z_1, f_1, ..] = profile.values(v);
            assert_near!(r * r_2, r_1, 1e-14);
            assert_near!(r * z_2, z_1 - z, 1e-14);
            assert_near!(f_2, f_1, 1e-14);
            assert_near!(h_2 / r, profile.mean_curvature(v), 1e-14);
        }
    }

    #[test]
    fn what_is_no_surface_is_refused() {
        assert_eq!(
            HarmonicProfile::new(1.0, f64::NAN, 0.0, 1.0),
            Err(ProfileError::Parameters)
        );
        assert_eq!(
            HarmonicProfile::new(1.0, 0.0, 0.0, 0.0),
            Err(ProfileError::Parameters)
        );
        // A sphere ends at its pole.
        let pole = HarmonicProfile::new(FRAC_PI_2, -1.0, 0.0, 2.0);
        assert_matches!(pole, Err(ProfileError::Axis(s)) if (1.5..1.6).contains(s));
        // A nodoid crosses itself.
        let nodoid = HarmonicProfile::new(FRAC_PI_2, 2.0, 0.0, 6.0);
        assert_matches!(nodoid, Err(ProfileError::Crossing(_)));
    }
}
