//! Mean curvature at a boundary vertex, from what lies on one side of the boundary alone, with the prescribed normal.
//!
//! A fit as in [`super::curvature`] to more samples and of higher order. On both sides of a smooth surface it is wrong by the same
//! power of the edge length, and exact on spheres.

use nalgebra::{SMatrix, SVector, Vector3};

/// Which samples a fit takes, and what it fits to them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum OneSided {
    /// Normal curvatures within three edges, to third order.
    Third,
    /// Normal curvatures within four edges, to fourth order.
    Fourth,
    /// The same with the tilt of the normal as an unknown: where the prescribed one is wrong.
    Tilted,
    /// Heights within eight edges, to third order, with an error of the vertex's own: for noise.
    Wide,
}

impl OneSided {
    /// All of them.
    pub(crate) const ALL: [Self; 4] = [Self::Fourth, Self::Tilted, Self::Third, Self::Wide];

    /// Samples lie within so many edges.
    pub(crate) fn rings(self) -> usize {
        match self {
            Self::Third => 3,
            Self::Fourth | Self::Tilted => 4,
            Self::Wide => 8,
        }
    }

    /// The mean curvature, with a weight per sample; `None` where there are too few. `reach[j]` is the number of edges to sample `j`.
    pub(crate) fn fit(
        self,
        normal: &Vector3<f64>,
        samples: &[Vector3<f64>],
        reach: &[u8],
        response: &mut Vec<f64>,
    ) -> Option<OneSidedCurvature> {
        match self {
            Self::Third => {
                let weight = |_: f64, reach: u8| [1.0, 0.5, 0.1][usize::from(reach.clamp(1, 3)) - 1];
                fit::<7>(normal, (samples, reach), weight, third_order, response)
            }
            Self::Fourth => fit::<12>(
                normal,
                (samples, reach),
                fourth_order_weight,
                fourth_order,
                response,
            ),
            Self::Tilted => fit::<14>(normal, (samples, reach), fourth_order_weight, tilted, response),
            Self::Wide => fit::<8>(normal, (samples, reach), |d, _| d * d, own_error, response),
        }
    }
}

/// What a fit has found.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OneSidedCurvature {
    /// Mean curvature.
    pub h: f64,
    /// Its standard error.
    pub error: f64,
}

/// So many samples for each unknown can judge a fit.
const SAMPLES_PER_UNKNOWN: f64 = 1.4;
/// Keeps the fit defined, relative to the sum of weights.
const RIDGE: f64 = 1e-9;

/// `1, (u^2 - v^2)/d, 2uv/d` and the cubics, as normal curvatures `2w/d`, of a sample in units of the samples' length. The monomials are
/// orthonormal in Bombieri's product, so that the ridge does not depend on where `u` points.
fn third_order([u, v, d]: [f64; 3]) -> SVector<f64, 7> {
    let cubic = 2.0 / d;
    SVector::from([
        1.0,
        (u * u - v * v) / d,
        2.0 * u * v / d,
        cubic * u * u * u,
        3f64.sqrt() * cubic * u * u * v,
        3f64.sqrt() * cubic * u * v * v,
        cubic * v * v * v,
    ])
}

/// The same with the quartics.
fn fourth_order([u, v, d]: [f64; 3]) -> SVector<f64, 12> {
    let third = third_order([u, v, d]);
    let quartic = 2.0 / d;
    let quartics = [
        quartic * u * u * u * u,
        2.0 * quartic * u * u * u * v,
        6f64.sqrt() * quartic * u * u * v * v,
        2.0 * quartic * u * v * v * v,
        quartic * v * v * v * v,
    ];
    SVector::from_fn(|k, _| if k < 7 { third[k] } else { quartics[k - 7] })
}

/// The weight of a sample by how many edges it is away.
fn fourth_order_weight(_: f64, reach: u8) -> f64 {
    [1.0, 1.0, 0.5, 0.25][usize::from(reach.clamp(1, 4)) - 1]
}

/// Fourth order, and a tilt.
fn tilted([u, v, d]: [f64; 3]) -> SVector<f64, 14> {
    let fourth = fourth_order([u, v, d]);
    SVector::from_fn(|k, _| match k {
        12 => 2.0 * u / d,
        13 => 2.0 * v / d,
        _ => fourth[k],
    })
}

/// Third order, and a constant height.
fn own_error([u, v, d]: [f64; 3]) -> SVector<f64, 8> {
    let third = third_order([u, v, d]);
    SVector::from_fn(|k, _| if k < 7 { third[k] } else { 1.0 / d })
}

/// The weighted least squares fit; `response[j]` becomes the derivative of `H` by the motion of sample `j` along the normal.
fn fit<const N: usize>(
    normal: &Vector3<f64>,
    (samples, reach): (&[Vector3<f64>], &[u8]),
    weight: impl Fn(f64, u8) -> f64,
    basis: impl Fn([f64; 3]) -> SVector<f64, N>,
    response: &mut Vec<f64>,
) -> Option<OneSidedCurvature> {
    if (samples.len() as f64) < SAMPLES_PER_UNKNOWN * N as f64 {
        return None;
    }
    let [a, b] = tangents(normal);
    let mean = samples.iter().map(|e| e.norm_squared()).sum::<f64>() / samples.len() as f64;
    let unit = mean.sqrt().max(f64::MIN_POSITIVE).recip();
    let place = |e: &Vector3<f64>| {
        let e = e * unit;
        let d = e.norm_squared().max(f64::MIN_POSITIVE);
        ([e.dot(&a), e.dot(&b), d], 2.0 * e.dot(normal) / d)
    };
    let mut matrix = SMatrix::<f64, N, N>::zeros();
    let mut squared = SMatrix::<f64, N, N>::zeros();
    let mut right = SVector::<f64, N>::zeros();
    let mut total = 0.0;
    for (e, &reach) in samples.iter().zip(reach) {
        let (at, kappa) = place(e);
        let (phi, w) = (basis(at), weight(at[2], reach));
        let outer = phi * phi.transpose();
        matrix += outer * w;
        squared += outer * (w * w);
        right += phi * (w * kappa);
        total += w;
    }
    for k in 1..N {
        matrix[(k, k)] += RIDGE * total;
    }
    let factor = matrix.cholesky()?;
    let y = factor.solve(&right);
    let z = factor.solve(&SVector::<f64, N>::from_fn(|k, _| if k == 0 { 1.0 } else { 0.0 }));
    response.clear();
    let mut residual = 0.0;
    for (e, &reach) in samples.iter().zip(reach) {
        let (at, kappa) = place(e);
        let (phi, w) = (basis(at), weight(at[2], reach));
        residual += w * (kappa - phi.dot(&y)).powi(2);
        response.push(w * phi.dot(&z) * 2.0 / at[2] * unit * unit);
    }
    let freedom = samples.len() as f64 / (samples.len() - N) as f64;
    let variance = residual / total * freedom * (z.transpose() * squared * z)[0];
    Some(OneSidedCurvature {
        h: y[0] * unit,
        error: variance.max(0.0).sqrt() * unit,
    })
    .filter(|fit| fit.h.is_finite() && fit.error.is_finite())
}

/// Two unit vectors that are orthogonal to the normal and to each other.
fn tangents(n: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let along = if n.x.abs() < 0.6 {
        Vector3::x()
    } else {
        Vector3::y()
    };
    let a = n.cross(&along).normalize();
    [a, n.cross(&a)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples on one side of the origin on a graph, and how many edges away they are.
    fn side(f: impl Fn(f64, f64) -> f64, h: f64) -> (Vec<Vector3<f64>>, Vec<u8>) {
        let mut samples = Vec::new();
        let mut reach = Vec::new();
        for ring in 1..=8u8 {
            for k in 0..=3 * ring {
                let angle = std::f64::consts::PI * f64::from(k) / f64::from(3 * ring);
                let r = h * f64::from(ring) * (1.0 + 0.05 * (7.0 * angle).sin());
                let (u, v) = (r * angle.cos(), r * angle.sin());
                samples.push(Vector3::new(u, v, f(u, v)));
                reach.push(ring);
            }
        }
        (samples, reach)
    }

    fn fitted(kind: OneSided, f: impl Fn(f64, f64) -> f64, h: f64) -> OneSidedCurvature {
        let (samples, reach) = side(f, h);
        let within = reach.iter().filter(|r| usize::from(**r) <= kind.rings()).count();
        kind.fit(
            &Vector3::z(),
            &samples[..within],
            &reach[..within],
            &mut Vec::new(),
        )
        .unwrap()
    }

    #[test]
    fn spheres_are_exact() {
        for kind in OneSided::ALL {
            let fit = fitted(kind, |u, v| (4.0 - u * u - v * v).sqrt() - 2.0, 0.1);
            assert!((fit.h + 0.5).abs() < 1e-9 && fit.error < 1e-8, "{kind:?} {fit:?}");
        }
    }

    /// The error falls with the second and the third power of the edge length.
    #[test]
    fn orders() {
        let f =
            |u: f64, v: f64| 0.4 * u * u - 0.1 * v * v + 0.3 * u * u * v - 0.2 * v.powi(4) + 0.3 * v.powi(5);
        for (kind, order) in [
            (OneSided::Third, 2),
            (OneSided::Fourth, 3),
            (OneSided::Tilted, 3),
            (OneSided::Wide, 2),
        ] {
            let error = |h: f64| (fitted(kind, f, h).h - 0.3).abs();
            let ratio = error(0.004) / error(0.002);
            assert!(ratio > 0.8 * f64::from(1 << order), "{kind:?}: {ratio}");
        }
    }

    #[test]
    fn the_response_is_the_derivative() {
        let f = |u: f64, v: f64| 0.4 * u * u - 0.1 * v * v + 0.3 * u * u * v;
        let (mut samples, reach) = side(f, 0.1);
        let within = reach.iter().filter(|r| **r <= 4).count();
        let mut response = Vec::new();
        let mut h = |samples: &[Vector3<f64>]| {
            let fit =
                OneSided::Fourth.fit(&Vector3::z(), &samples[..within], &reach[..within], &mut response);
            (fit.unwrap().h, response.clone())
        };
        let (before, expected) = h(&samples);
        let d = 1e-7;
        samples[5].z += d;
        let (after, _) = h(&samples);
        // The length of the sample changes as well.
        assert!(((after - before) / d - expected[5]).abs() < 0.05 * expected[5].abs());
    }
}
