//! A sphere and a polynomial over it, fitted to some points.
//!
//! Heights are measured from a sphere whose curvature is the points' own mean curvature, so that even a fit to half a sphere
//! has no error but that of the noise; elsewhere it is as good as a polynomial of the same degree.

use nalgebra::{SMatrix, SVector, Vector3};

/// Coefficients of a polynomial of degree two and three.
const SECOND: usize = 6;
const THIRD: usize = 10;
/// Rounds in which normal and curvature settle.
/// Of 5 cases, half: 4 change by up to 0.1 edges, 1 get another triangulation; double: 4 change by up to 0.09 edges.
const ROUNDS: usize = 6;
/// They have settled when they change by less than this, in units of the window.
/// Half or double, of 5 cases: none changes.
const SETTLED: f64 = 1e-12;
/// The sphere is no smaller than the window by more than this.
/// Of 5 cases, half: 4 change, 3 get another triangulation; double: 1 changes by up to 0.08 edges.
const MOST_CURVED: f64 = 1.4;
/// What is added to the diagonal of the normal equations, over its trace.
/// Of 5 cases, half: 4 change by up to 8e-12 edges; double: 4 change by up to 2e-11 edges.
const RIDGE: f64 = 1e-12;
/// So many points for each coefficient, at least.
/// Of 5 cases, half: none changes; double: 1 changes, 1 get another triangulation, +4 % iterations.
const POINTS: usize = 2;

/// The points that a fit is made to.
pub(super) struct Window<'a> {
    /// The point at which the surface is wanted.
    pub(super) at: Vector3<f64>,
    /// Positions, and how much each of them counts.
    pub(super) points: &'a [(Vector3<f64>, f64)],
    /// No point is further away.
    pub(super) radius: f64,
    /// About the normal.
    pub(super) normal: Vector3<f64>,
}

/// The surface that was fitted, near one point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fit {
    pub(super) sheet: Sheet,
    /// How far above the point the surface is, along the normal.
    pub(super) height: f64,
    /// The variance of the points about the surface.
    pub(super) variance: f64,
    /// That of the height, if each point's is one.
    pub(super) leverage: f64,
    /// By how much a polynomial of degree three has another height, squared, and its expectation if each point's variance is one.
    pub(super) change: [f64; 2],
    /// Mean curvature times the radius of the window.
    pub(super) curvature: f64,
}

/// The surface to second order.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sheet {
    /// A point of it.
    pub(super) at: Vector3<f64>,
    /// The unit normal there.
    pub(super) normal: Vector3<f64>,
    tangents: [Vector3<f64>; 2],
    /// What half the second derivatives are.
    bends: [f64; 3],
}

impl Sheet {
    /// The same surface at another height.
    pub(super) fn through(self, at: Vector3<f64>) -> Self {
        Self { at, ..self }
    }

    /// The angle of a direction from the first tangent.
    pub(super) fn direction(&self, d: Vector3<f64>) -> f64 {
        libm::atan2(d.dot(&self.tangents[1]), d.dot(&self.tangents[0]))
    }

    /// A point of the surface, a step along the tangents from one near it.
    pub(super) fn near(&self, x: Vector3<f64>, step: [f64; 2]) -> Vector3<f64> {
        let d = x - self.at;
        let [u, v] = [0, 1].map(|i| d.dot(&self.tangents[i]) + step[i]);
        let [uu, uv, vv] = self.bends;
        let height = uu * u * u + uv * u * v + vv * v * v;
        self.at + self.tangents[0] * u + self.tangents[1] * v + self.normal * height
    }
}

struct Sphere {
    normal: Vector3<f64>,
    tangents: [Vector3<f64>; 2],
    /// Times the radius of the window.
    curvature: f64,
}

impl Sphere {
    fn new(normal: Vector3<f64>, curvature: f64) -> Self {
        // The axis that the normal is furthest from.
        let axis = Vector3::ith(normal.iamin(), 1.0);
        let first = normal.cross(&axis).normalize();
        Self {
            normal,
            tangents: [first, normal.cross(&first)],
            curvature,
        }
    }

    /// A point by its place on the sphere, in stereographic coordinates, and its height above it.
    fn place(&self, d: &Vector3<f64>) -> Option<([f64; 2], f64)> {
        let k = self.curvature;
        let z = d.dot(&self.normal);
        let away = (1.0 - 2.0 * k * z + k * k * d.norm_squared()).max(0.0).sqrt();
        let height = (2.0 * z - k * d.norm_squared()) / (1.0 + away);
        let before = away + 1.0 - k * z;
        let is_in_front = before > 0.5 * away;
        let [s, t] = &self.tangents;
        let uv = [2.0 * d.dot(s) / before, 2.0 * d.dot(t) / before];
        is_in_front.then_some((uv, height))
    }
}

fn powers([u, v]: [f64; 2]) -> SVector<f64, THIRD> {
    SVector::from([
        1.0,
        u,
        v,
        u * u,
        u * v,
        v * v,
        u * u * u,
        u * u * v,
        u * v * v,
        v * v * v,
    ])
}

/// The coefficients, and what the points' heights count in the first of them: the inverse's first column.
fn solve<const N: usize>(
    rows: &[(SVector<f64, THIRD>, f64, f64)],
) -> Option<(SVector<f64, N>, SVector<f64, N>)> {
    let (mut matrix, mut right) = (SMatrix::<f64, N, N>::zeros(), SVector::<f64, N>::zeros());
    for (powers, height, weight) in rows {
        for j in 0..N {
            for i in 0..N {
                matrix[(i, j)] += weight * powers[j] * powers[i];
            }
            right[j] += weight * height * powers[j];
        }
    }
    let ridge = RIDGE * matrix.trace();
    (0..N).for_each(|i| matrix[(i, i)] += ridge);
    let factor = matrix.cholesky()?;
    let mut first = SVector::<f64, N>::zeros();
    first[0] = 1.0;
    Some((factor.solve(&right), factor.solve(&first)))
}

impl Window<'_> {
    /// None if there are too few points, or the normal is no help.
    pub(super) fn fit(&self) -> Option<Fit> {
        if self.points.len() < POINTS * SECOND {
            return None;
        }
        let mut sphere = Sphere::new(self.normal, 0.0);
        let mut rows = Vec::with_capacity(self.points.len());
        let mut last = None;
        for _ in 0..ROUNDS {
            self.rows(&sphere, &mut rows);
            if rows.len() < POINTS * SECOND {
                return None;
            }
            let (c, first) = solve::<SECOND>(&rows)?;
            last = Some((c, first));
            let turned = sphere.normal - sphere.tangents[0] * c[1] - sphere.tangents[1] * c[2];
            let bent = sphere.curvature + c[3] + c[5];
            let change = c[1].abs().max(c[2].abs()).max((c[3] + c[5]).abs());
            if change < SETTLED {
                break;
            }
            sphere = Sphere::new(turned.try_normalize(0.0)?, bent.clamp(-MOST_CURVED, MOST_CURVED));
        }
        self.rows(&sphere, &mut rows);
        let (c, first) = solve::<SECOND>(&rows).or(last)?;
        Some(self.measured(&sphere, &rows, &c, &first))
    }

    fn rows(&self, sphere: &Sphere, rows: &mut Vec<(SVector<f64, THIRD>, f64, f64)>) {
        rows.clear();
        rows.extend(self.points.iter().filter_map(|(x, weight)| {
            let (uv, height) = sphere.place(&((x - self.at) / self.radius))?;
            Some((powers(uv), height, *weight))
        }));
    }

    fn measured(
        &self,
        sphere: &Sphere,
        rows: &[(SVector<f64, THIRD>, f64, f64)],
        c: &SVector<f64, SECOND>,
        first: &SVector<f64, SECOND>,
    ) -> Fit {
        let third = (rows.len() >= POINTS * THIRD)
            .then(|| solve::<THIRD>(rows))
            .flatten();
        let (mut squares, mut weights, mut leverage, mut expected) = (0.0, 0.0, 0.0, 0.0);
        for (powers, height, weight) in rows {
            let second = powers.fixed_rows::<SECOND>(0);
            squares += weight * (height - second.dot(c)).powi(2);
            weights += weight;
            let counts = weight * second.dot(first);
            leverage += counts * counts;
            if let Some((_, first)) = &third {
                expected += (weight * powers.dot(first) - counts).powi(2);
            }
        }
        let count = rows.len() as f64;
        let variance = squares / weights * count / (count - SECOND as f64);
        let sheet = Sheet {
            at: self.at + sphere.normal * (c[0] * self.radius),
            normal: sphere.normal,
            tangents: sphere.tangents,
            bends: [0.5 * sphere.curvature + c[3], c[4], 0.5 * sphere.curvature + c[5]]
                .map(|c| c / self.radius),
        };
        let unit = self.radius * self.radius;
        let change = third.map_or([f64::INFINITY, 1.0], |(of, _)| {
            [(of[0] - c[0]).powi(2) * unit, expected]
        });
        Fit {
            sheet,
            height: c[0] * self.radius,
            variance: variance * unit,
            leverage,
            change,
            curvature: sphere.curvature,
        }
    }
}
