//! The second of the two second-order problems (paper 7.1 (II)), vertex by vertex: to the place that inner fairness
//! asks for within the tangent plane (7.3), then along the normal until the curvature is the estimated one (7.2).

use nalgebra::Vector3;

use crate::discrete::curvature::moreton_sequin_with_response;
use crate::discrete::paper_curvature::{low_valence_pairs, samples};
use crate::discrete::simd::one;

/// No normal step is longer than this part of the shortest edge. Far from the solution the linearization of 7.2 knows no
/// bound; near it no step is that long.
/// Of 3 cases, half: 3 change by up to 6e-7 edges, +2 % iterations; double: 1 changes by up to 5e-8 edges.
const LONGEST_STEP: f64 = 0.5;

/// A vertex's ring and the weights of its inner fairness, of any common factor; no weights: all are one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ring<'a> {
    /// The neighbours, counter-clockwise.
    pub neighbour: &'a [u32],
    /// `lambda_ij`.
    pub lambda: &'a [f64],
}

/// What an update does to a vertex.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Update {
    /// The new position.
    pub position: Vector3<f64>,
    /// The normal (6), which no motion of the vertex itself changes.
    pub normal: Vector3<f64>,
    /// `s t`.
    pub normal_step: f64,
    /// `|q~ - q|`.
    pub tangential_step: f64,
}

impl Ring<'_> {
    fn weight(&self, k: usize) -> f64 {
        self.lambda.get(k).copied().unwrap_or(1.0)
    }

    /// `sum_j lambda_ij q_j` with weights of sum one.
    pub(crate) fn centre(&self, x: &[Vector3<f64>]) -> Vector3<f64> {
        let (mut sum, mut total) = (Vector3::zeros(), 0.0);
        for (k, &j) in self.neighbour.iter().enumerate() {
            sum += x[j as usize] * self.weight(k);
            total += self.weight(k);
        }
        sum / total
    }

    /// The normalized sum of the triangles' cross products (6); `None` where they have no area.
    pub(crate) fn normal(&self, x: &[Vector3<f64>], i: usize) -> Option<Vector3<f64>> {
        let ring = self.neighbour;
        let edge = |k: usize| x[ring[k] as usize] - x[i];
        let m = ring.len();
        let sum: Vector3<f64> = (0..m).map(|k| edge(k).cross(&edge((k + 1) % m))).sum();
        sum.try_normalize(f64::MIN_POSITIVE)
    }

    /// Where vertex `i` goes so that its curvature becomes `target`. `normal` holds unit normals of all region
    /// vertices; `s` damps the normal step.
    pub(crate) fn update(
        &self,
        i: usize,
        x: &[Vector3<f64>],
        normal: &[Vector3<f64>],
        target: f64,
        s: f64,
    ) -> Update {
        let n = self.normal(x, i).unwrap_or(normal[i]);
        let delta = self.centre(x) - x[i];
        // The paper prints a plus; only the difference lies in the tangent plane.
        let tangential = delta - n * delta.dot(&n);
        let foot = x[i] + tangential;
        let response = self.response(&foot, x, normal, &n);
        let t = (response.curvature - target) / response.slope;
        let t = t.min(response.bound).max(-response.bound);
        Update {
            position: foot + n * (s * t),
            normal: n,
            normal_step: s * t,
            tangential_step: tangential.norm(),
        }
    }

    /// `-dH/dt` of vertex `i` under a step along its normal, where it is.
    pub(crate) fn slope(&self, i: usize, x: &[Vector3<f64>], normal: &[Vector3<f64>]) -> f64 {
        self.response(&x[i], x, normal, &normal[i]).slope
    }

    /// Curvature at `foot` with the normal `n`, as a function of a step along it.
    fn response(
        &self,
        foot: &Vector3<f64>,
        x: &[Vector3<f64>],
        normal: &[Vector3<f64>],
        n: &Vector3<f64>,
    ) -> Response {
        let ring = self.neighbour;
        let samples = samples(foot, ring, low_valence_pairs(ring), x, normal);
        let (curvature, _, slope) = moreton_sequin_with_response(&one(n), samples);
        let (mut shortest, mut mean) = (f64::INFINITY, 0.0);
        for &j in ring {
            let square = (x[j as usize] - foot).norm_squared().max(f64::MIN_POSITIVE);
            shortest = shortest.min(square);
            mean += 2.0 / (square * ring.len() as f64);
        }
        Response {
            curvature: curvature.0[0],
            // Directions all to one side may turn the sign of the fitted answer; the mean of the samples' keeps it.
            slope: slope.0[0].max(SMALLEST_SLOPE * mean),
            bound: LONGEST_STEP * shortest.sqrt(),
        }
    }
}

/// The fitted answer of `H` to a normal step is at least this part of the samples' mean one.
/// Half or double, of 3 cases: none changes.
const SMALLEST_SLOPE: f64 = 0.25;

/// `H` around a point of a vertex's normal: `curvature - slope t`.
struct Response {
    curvature: f64,
    slope: f64,
    /// The largest `|t|`.
    bound: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A vertex at the pole of a sphere of radius 2, its ring on the sphere, regular or not.
    fn pole(m: usize, wobble: f64) -> (Vec<Vector3<f64>>, Vec<Vector3<f64>>, Vec<u32>) {
        let mut x = vec![Vector3::new(0.0, 0.0, 2.0)];
        for k in 0..m {
            let phi = std::f64::consts::TAU * (k as f64 + wobble * (k as f64).sin()) / m as f64;
            x.push(Vector3::new(
                0.3 * phi.cos(),
                0.3 * phi.sin(),
                (4.0f64 - 0.09).sqrt(),
            ));
        }
        let normal = x.iter().map(|p| p / 2.0).collect();
        (x, normal, (1..=m as u32).collect())
    }

    #[test]
    fn a_vertex_on_a_sphere_with_the_sphere_s_curvature_stays() {
        for m in [3, 4, 5, 7] {
            let (x, normal, ring) = pole(m, 0.0);
            let ring = Ring {
                neighbour: &ring,
                lambda: &[],
            };
            let update = ring.update(0, &x, &normal, -0.5, 0.9);
            assert!((update.position - x[0]).norm() < 1e-14, "valence {m}: {update:?}");
        }
    }

    #[test]
    fn the_undamped_step_meets_the_curvature_up_to_the_linearization() {
        for m in [3, 4, 6] {
            let (mut x, normal, ring) = pole(m, 0.0);
            let ring = Ring {
                neighbour: &ring,
                lambda: &[],
            };
            let mut off = 0.01;
            for _ in 0..3 {
                let update = ring.update(0, &x, &normal, -0.45, 1.0);
                x[0] = update.position;
                let n = ring.normal(&x, 0).unwrap();
                let gap = (ring.response(&x[0], &x, &normal, &n).curvature + 0.45).abs();
                assert!(gap < 0.1 * off, "valence {m}: {gap}");
                off = gap.max(1e-13);
            }
        }
    }

    #[test]
    fn the_tangential_step_ends_over_the_centre_of_the_ring() {
        let (mut x, normal, ring) = pole(5, 0.3);
        let lambda = [1.0, 2.0, 0.5, 1.0, 3.0];
        x[0] += Vector3::new(0.05, -0.02, 0.0);
        let ring = Ring {
            neighbour: &ring,
            lambda: &lambda,
        };
        let update = ring.update(0, &x, &normal, -0.5, 0.9);
        let gap = ring.centre(&x) - update.position;
        assert_below!(gap.cross(&update.normal).norm(), 1e-15);
        assert_near!(
            update.tangential_step,
            (ring.centre(&x) - x[0]).cross(&update.normal).norm(),
            1e-15
        );
    }

    #[test]
    fn a_collapsed_ring_moves_nothing_out_of_the_numbers() {
        let x = vec![Vector3::zeros(); 5];
        let normal = vec![Vector3::z(); 5];
        let ring = Ring {
            neighbour: &[1, 2, 3, 4],
            lambda: &[],
        };
        assert_below!(ring.update(0, &x, &normal, 1.0, 0.9).position.norm(), 1e-100);
    }
}
