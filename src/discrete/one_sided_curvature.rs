//! Mean curvature at a boundary vertex, from what lies on one side of the boundary alone, with the prescribed normal.
//!
//! A fit as in [`super::curvature`] to more samples and of higher order. On both sides of a smooth surface it is wrong by the same
//! power of the edge length, and exact on spheres.

use nalgebra::{SMatrix, SVector, Vector3};

use super::simd::tangents;
use super::trace::{RIDGE, add_outer};

/// Which samples a fit takes, and what it fits to them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum OneSided {
    /// Normal curvatures within three edges, to third order.
    Third,
    /// Normal curvatures within four edges, to fourth order, with the tilt of the normal as an unknown: the prescribed one is never quite right.
    Fourth,
    /// Heights within eight edges, to third order, with such a tilt and an error of the vertex's own: for noise.
    Wide,
}

impl OneSided {
    /// Samples lie within so many edges.
    pub(crate) fn rings(self) -> usize {
        match self {
            Self::Third => 3,
            Self::Fourth => 4,
            Self::Wide => 8,
        }
    }

    /// The mean curvature; `None` where there are too few samples. `reach[j]` is the number of edges to sample `j`.
    pub(crate) fn fit(self, normal: &Vector3<f64>, samples: &[Vector3<f64>], reach: &[u8]) -> Option<f64> {
        let samples = (samples, reach);
        match self {
            Self::Third => {
                let weight = |_: f64, reach: u8| [1.0, 0.5, 0.1][usize::from(reach.clamp(1, 3)) - 1];
                fit::<7>(normal, samples, weight, third_order)
            }
            Self::Fourth => {
                let weight = |_: f64, reach: u8| [1.0, 1.0, 0.5, 0.25][usize::from(reach.clamp(1, 4)) - 1];
                fit::<14>(normal, samples, weight, fourth_order_tilted)
            }
            Self::Wide => fit::<10>(normal, samples, |d, _| d * d, third_order_tilted),
        }
    }
}

/// So many samples for each unknown can judge a fit.
/// Of 14 cases, half: none changes; double: 6 change by up to 0.5 edges, +1 % iterations.
const SAMPLES_PER_UNKNOWN: f64 = 1.4;

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

/// The same with the quartics, and a tilt.
fn fourth_order_tilted([u, v, d]: [f64; 3]) -> SVector<f64, 14> {
    let third = third_order([u, v, d]);
    let quartic = 2.0 / d;
    let others = [
        quartic * u * u * u * u,
        2.0 * quartic * u * u * u * v,
        6f64.sqrt() * quartic * u * u * v * v,
        2.0 * quartic * u * v * v * v,
        quartic * v * v * v * v,
        2.0 * u / d,
        2.0 * v / d,
    ];
    SVector::from_fn(|k, _| if k < 7 { third[k] } else { others[k - 7] })
}

/// Third order, a tilt, and a constant height.
fn third_order_tilted([u, v, d]: [f64; 3]) -> SVector<f64, 10> {
    let third = third_order([u, v, d]);
    let others = [2.0 * u / d, 2.0 * v / d, 1.0 / d];
    SVector::from_fn(|k, _| if k < 7 { third[k] } else { others[k - 7] })
}

/// The weighted least squares fit.
fn fit<const N: usize>(
    normal: &Vector3<f64>,
    (samples, reach): (&[Vector3<f64>], &[u8]),
    weight: impl Fn(f64, u8) -> f64,
    basis: impl Fn([f64; 3]) -> SVector<f64, N>,
) -> Option<f64> {
    if (samples.len() as f64) < SAMPLES_PER_UNKNOWN * N as f64 {
        return None;
    }
    let [a, b] = tangents(normal);
    let mean = samples.iter().map(|e| e.norm_squared()).sum::<f64>() / samples.len() as f64;
    let unit = mean.sqrt().max(f64::MIN_POSITIVE).recip();
    let sample = |(e, reach): (&Vector3<f64>, &u8)| {
        let e = e * unit;
        let d = e.norm_squared().max(f64::MIN_POSITIVE);
        let phi = basis([e.dot(&a), e.dot(&b), d]);
        (phi, 2.0 * e.dot(normal) / d, weight(d, *reach))
    };
    let mut matrix = SMatrix::<f64, N, N>::zeros();
    let mut right = SVector::<f64, N>::zeros();
    let mut total = 0.0;
    for (phi, kappa, w) in samples.iter().zip(reach).map(sample) {
        add_outer(&mut matrix, &phi, w);
        right += phi * (w * kappa);
        total += w;
    }
    for k in 1..N {
        matrix[(k, k)] += RIDGE * total;
    }
    let factor = matrix.cholesky()?;
    let y = factor.solve(&right);
    Some(y[0] * unit).filter(|h| h.is_finite())
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

    const ALL: [OneSided; 3] = [OneSided::Fourth, OneSided::Third, OneSided::Wide];

    fn fitted(kind: OneSided, normal: &Vector3<f64>, (samples, reach): &(Vec<Vector3<f64>>, Vec<u8>)) -> f64 {
        let within = reach.iter().filter(|r| usize::from(**r) <= kind.rings()).count();
        kind.fit(normal, &samples[..within], &reach[..within]).unwrap()
    }

    #[test]
    fn spheres_are_exact() {
        for kind in ALL {
            let h = fitted(
                kind,
                &Vector3::z(),
                &side(|u, v| (4.0 - u * u - v * v).sqrt() - 2.0, 0.1),
            );
            assert_near!(h, -0.5, 1e-9);
        }
    }

    /// The error falls with the second and the third power of the edge length.
    #[test]
    fn orders() {
        let f =
            |u: f64, v: f64| 0.4 * u * u - 0.1 * v * v + 0.3 * u * u * v - 0.2 * v.powi(4) + 0.3 * v.powi(5);
        // Small against the bends, large against the ridge.
        for (kind, order, size) in [
            (OneSided::Third, 2, 0.02),
            (OneSided::Fourth, 3, 0.02),
            (OneSided::Wide, 2, 0.005),
        ] {
            let error = |h: f64| (fitted(kind, &Vector3::z(), &side(f, h)) - 0.3).abs();
            let ratio = error(size) / error(0.5 * size);
            assert!(ratio > 0.8 * f64::from(1 << order), "{kind:?}: {ratio}");
        }
    }

    /// A wrong normal is taken out.
    #[test]
    fn tilts_do_not_matter() {
        let samples = side(|u, v| 0.4 * u * u - 0.1 * v * v, 0.01);
        let tilt = Vector3::new(0.02, -0.01, 1.0).normalize();
        for kind in [OneSided::Fourth, OneSided::Wide] {
            assert_near!(fitted(kind, &tilt, &samples), 0.3, 1e-3);
        }
    }
}
