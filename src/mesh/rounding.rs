//! Whether what single precision has rounded away matters: far from the origin, its steps tilt small triangles.

use nalgebra::Vector3;

/// Rounding that may turn edges by more than this (radians) spoils fits to three rings.
/// Half or double, of 13 cases: none changes.
const LARGEST_TURN: f64 = 1e-4;
/// Half the distance of single precision numbers from 1 to 2.
const HALF_STEP: f64 = 0.5 * f32::EPSILON as f64;

/// Whether these triangles' vertices all have single precision coordinates, so that each is off by up to half of its last
/// digit, and that is much against the mean edge. Coordinates that are double precision are taken as exact.
pub(super) fn single_precision_matters(
    positions: &[[f64; 3]],
    triangles: impl Iterator<Item = [u32; 3]>,
) -> bool {
    let (mut largest, mut length, mut edges) = (0.0_f64, 0.0, 0.0);
    for triangle in triangles {
        let x = triangle.map(|v| positions[v as usize]);
        if x.iter().flatten().any(|&c| f64::from(c as f32) != c) {
            return false;
        }
        largest = x.iter().flatten().fold(largest, |most, c| most.max(c.abs()));
        for k in 0..3 {
            length += (Vector3::from(x[k]) - Vector3::from(x[(k + 1) % 3])).norm();
            edges += 1.0;
        }
    }
    largest * HALF_STEP * edges > LARGEST_TURN * length
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle with edges of about 0.01 at `x`.
    fn triangle(x: f64, kept: impl Fn(f64) -> f64) -> Vec<[f64; 3]> {
        [[0.0, 0.0], [0.01, 0.0], [0.005, 0.01]]
            .map(|[u, v]| [kept(x + u), kept(v), 0.0])
            .to_vec()
    }

    #[test]
    fn single_precision_matters_far_away_only_and_double_nowhere() {
        let matters = |positions: &[[f64; 3]]| single_precision_matters(positions, [[0, 1, 2]].into_iter());
        let single = |c: f64| f64::from(c as f32);
        assert!(!matters(&triangle(1.0, single)));
        assert!(matters(&triangle(1_000.0, single)));
        assert!(!matters(&triangle(1_000.0, |c| c)));
    }
}
