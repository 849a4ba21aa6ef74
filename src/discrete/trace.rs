//! What a function of the vertices on one side of the boundary tends to at a boundary vertex.
//!
//! Mean curvatures at the vertices of a smooth surface err from vertex to vertex, and in the mean along a boundary by the same on both of
//! its sides: where traces of both agree, the surface's own curvatures do by more than either is known.

use nalgebra::{Cholesky, Const, SMatrix, SVector, Vector3};

use super::simd::tangents;

/// Unknowns of a quadric.
const N: usize = 6;
/// Weights of samples by the number of edges to the boundary vertex.
/// Of 14 cases, half: 8 change by up to 2e-5 edges; double: 8 change by up to 9e-6 edges.
const WEIGHTS: [f64; 4] = [1.0, 1.0, 0.5, 0.25];
/// The same where the samples are noisy.
/// Of 14 cases, half: 6 change by up to 5e-7 edges; double: 6 change by up to 2e-7 edges.
const WIDE_WEIGHTS: [f64; 7] = [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.5];
/// Fewer samples cannot judge the fit.
/// Of 14 cases, half: 1 changes by up to 1e-4 edges; double: 8 change by up to 1 edge, -14 % iterations.
const FEWEST: usize = 9;
/// Keeps fits to several rings defined, relative to the sum of weights.
/// Of 14 cases, half: 8 change by up to 3e-7 edges; double: 8 change by up to 5e-7 edges.
/// Of 14 cases, half: 8 change by up to 9e-6 edges, +1 % iterations; double: 8 change by up to 2e-5 edges, +1 % iterations.
pub(crate) const RIDGE: f64 = 1e-9;

/// How far samples reach.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reach {
    /// Three edges: waves along the boundary reach little further. Four where three are not enough.
    Near,
    /// Seven.
    Wide,
}

impl Reach {
    fn weights(self) -> &'static [f64] {
        match self {
            Self::Near => &WEIGHTS,
            Self::Wide => &WIDE_WEIGHTS,
        }
    }

    /// Samples lie within so many edges.
    pub(crate) fn rings(self) -> usize {
        self.weights().len()
    }
}

/// The quadric through samples, in the plane of a normal.
pub(crate) struct Trace {
    samples: Vec<(SVector<f64, N>, f64)>,
    factor: Cholesky<f64, Const<N>>,
}

impl Trace {
    /// That of samples `(edge, number of edges)`; `None` where they are too few.
    pub(crate) fn new(
        normal: &Vector3<f64>,
        reach: Reach,
        edges: impl Iterator<Item = (Vector3<f64>, u8)>,
    ) -> Option<Self> {
        Self::of_all(normal, reach, &edges.collect::<Vec<_>>())
    }

    /// The same, compiled once for all kinds of samples.
    #[inline(never)]
    fn of_all(normal: &Vector3<f64>, reach: Reach, edges: &[(Vector3<f64>, u8)]) -> Option<Self> {
        let count = edges.len();
        if count < FEWEST {
            return None;
        }
        let [a, b] = tangents(normal);
        let squares: f64 = edges.iter().map(|(e, _)| e.norm_squared()).sum();
        let unit = (count as f64 / squares.max(f64::MIN_POSITIVE)).sqrt();
        let weights = reach.weights();
        let sample = |&(e, ring): &(Vector3<f64>, u8)| {
            let (u, v) = (e.dot(&a) * unit, e.dot(&b) * unit);
            // Orthonormal in Bombieri's product: the ridge does not depend on where u points.
            let phi = SVector::from([1.0, u, v, u * u, 2f64.sqrt() * u * v, v * v]);
            (phi, weights[usize::from(ring).clamp(1, weights.len()) - 1])
        };
        let samples: Vec<_> = edges.iter().map(sample).collect();
        let mut matrix = SMatrix::<f64, N, N>::zeros();
        for (phi, weight) in &samples {
            add_outer(&mut matrix, phi, *weight);
        }
        for k in 1..N {
            matrix[(k, k)] += RIDGE * count as f64;
        }
        let factor = matrix.cholesky()?;
        Some(Self { samples, factor })
    }

    /// The weights with which values at the samples make the one at the boundary vertex.
    pub(crate) fn weights(&self) -> Vec<f64> {
        let z = self.influence();
        self.samples.iter().map(|(phi, w)| w * phi.dot(&z)).collect()
    }

    fn influence(&self) -> SVector<f64, N> {
        let mut first = SVector::<f64, N>::zeros();
        first[0] = 1.0;
        self.factor.solve(&first)
    }

    /// The value at the boundary vertex.
    pub(crate) fn value(&self, mut values: impl Iterator<Item = f64> + Clone) -> f64 {
        // From one of the values, so that constants are exact.
        let level = values.clone().next().unwrap_or(0.0);
        let z = self.influence();
        let mut sum = 0.0;
        for ((phi, weight), value) in self.samples.iter().zip(&mut values) {
            sum += weight * phi.dot(&z) * (value - level);
        }
        sum + level
    }
}

/// Adds the product of a vector with itself: only what is on and below the diagonal, which is all that a Cholesky factor reads.
pub(super) fn add_outer<const N: usize>(matrix: &mut SMatrix<f64, N, N>, phi: &SVector<f64, N>, weight: f64) {
    for j in 0..N {
        let scaled = weight * phi[j];
        for i in j..N {
            matrix[(i, j)] += scaled * phi[i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quadratic_functions_are_exact_and_errors_beside_the_boundary_hardly_matter() {
        let f = |u: f64, v: f64| 0.3 + 0.5 * u - 0.2 * v + u * v - 0.7 * v * v;
        let at = |k: u32| {
            let (ring, angle) = (1 + k / 8, 0.4 * f64::from(k % 8));
            let r = f64::from(ring);
            (Vector3::new(r * angle.cos(), r * angle.sin(), 0.1), ring as u8)
        };
        let trace = Trace::new(&Vector3::z(), Reach::Near, (0..32).map(at)).unwrap();
        let values = |error: f64| {
            let samples = (0..32).map(at).enumerate();
            samples
                .map(move |(k, (e, ring))| f(e.x, e.y) + if ring == 1 { [error, -error][k % 2] } else { 0.0 })
        };
        assert_near!(trace.value(values(0.0)), 0.3, 1e-7);
        let value = trace.value(values(0.1));
        assert_near!(value, 0.3, 0.01);
        let sum: f64 = trace.weights().iter().zip(values(0.1)).map(|(w, f)| w * f).sum();
        assert_near!(sum, value, 1e-12);
        assert!(Trace::new(&Vector3::z(), Reach::Near, (0..8).map(at)).is_none());
    }
}
