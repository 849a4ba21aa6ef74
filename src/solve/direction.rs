//! The directions that large normal steps go along.
//!
//! A step of many edge lengths along each vertex's own normal tears the ring of a vertex whose normal differs from its
//! neighbours': the surface between them turns by more than a triangle bears, although the step itself is smooth. Along
//! averaged normals a rough spot moves as a whole, and the steps that follow smooth it. Steps that are
//! shorter than the edges take the normals as they are.

use fairmesh_linear::parallel;
use nalgebra::Vector3;

use crate::discrete::valence_batches::CHUNK;
use crate::mesh::Rings;
use crate::support::profile::clock;

/// At most this many averagings: a few edges around.
/// Of 125 cases, half: 6 change by up to 4e-6 edges, 1 get another triangulation, 1 more succeeds;
/// double: 4 change by up to 3e-8 edges, 1 get another triangulation, 1 fails.
const MOST_ROUNDS: usize = 20;
/// What is shorter than this is nothing: normals that cancel.
/// Half or double, of 74 cases: none changes.
const LEAST: f64 = 1e-9;

/// The averagings for a largest step of this length on a surface with 1-disks of this mean area: one per edge length.
pub(crate) fn rounds(largest: f64, disk: f64) -> usize {
    // Of six equilateral triangles.
    let edge = (disk / (1.5 * 3f64.sqrt())).sqrt();
    let lengths = largest / edge;
    if lengths.is_finite() {
        lengths.min(MOST_ROUNDS as f64) as usize
    } else {
        0
    }
}

/// Averages the unit normals of the free vertices this many times over their closed rings, in which boundary vertices have
/// the prescribed normals. Unit vectors; the vertex's own normal where nothing is left.
pub(crate) fn averaged(
    rings: &Rings,
    normal: &[Vector3<f64>],
    boundary_normals: &[Vector3<f64>],
    rounds: usize,
) -> Vec<Vector3<f64>> {
    let _clock = clock("averaged directions");
    // With a fourth number a vector is one register.
    let padded = |n: &Vector3<f64>| [n.x, n.y, n.z, 0.0];
    let mut field: Vec<[f64; 4]> = normal.iter().chain(boundary_normals).map(padded).collect();
    let mut next = field.clone();
    for _ in 0..rounds {
        let free = next[..normal.len()].chunks_mut(CHUNK);
        parallel::for_each(free, |chunk, next| average(rings, &field, chunk * CHUNK, next));
        std::mem::swap(&mut field, &mut next);
    }
    parallel::map_each(normal.len(), CHUNK, |i| {
        let [x, y, z, _] = field[i];
        Vector3::new(x, y, z).try_normalize(LEAST).unwrap_or(normal[i])
    })
}

/// The means of the closed rings from vertex `first` on.
fn average(rings: &Rings, field: &[[f64; 4]], first: usize, means: &mut [[f64; 4]]) {
    for (i, mean) in (first..).zip(means) {
        let ring = rings.ring(i);
        let mut sum = field[i];
        for &j in ring {
            for (sum, x) in sum.iter_mut().zip(&field[j as usize]) {
                *sum += x;
            }
        }
        let count = (ring.len() + 1) as f64;
        *mean = sum.map(|x| x / count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::rows::Rows;

    /// A free vertex with a wrong normal among six boundary vertices.
    fn star() -> Rings {
        Rings {
            neighbour: Rows::collect(1, (1..7).map(|j| (0, j))),
            ..Rings::default()
        }
    }

    #[test]
    fn one_round_is_the_mean_over_the_closed_ring() {
        let boundary = [Vector3::z(); 6];
        let d = averaged(&star(), &[Vector3::x()], &boundary, 1);
        assert_below!((d[0] - Vector3::new(1.0, 0.0, 6.0).normalize()).norm(), 1e-15);
        assert_eq!(averaged(&star(), &[Vector3::x()], &boundary, 0), [Vector3::x()]);
    }

    #[test]
    fn equal_normals_stay_and_opposite_ones_keep_their_own() {
        let tilted = Vector3::new(0.48, 0.6, 0.64);
        let d = averaged(&star(), &[tilted], &[tilted; 6], 10);
        assert_below!((d[0] - tilted).norm(), 1e-15);
        let mut boundary = [Vector3::z(); 6];
        boundary[3..].fill(-Vector3::z());
        boundary[0] = -Vector3::x();
        boundary[3] = Vector3::zeros();
        assert_eq!(averaged(&star(), &[Vector3::x()], &boundary, 1), [Vector3::x()]);
    }

    #[test]
    fn short_steps_and_broken_ones_take_the_normals_as_they_are() {
        let disk = 1.5 * 3f64.sqrt();
        assert_eq!(rounds(0.99, disk), 0);
        assert_eq!(rounds(2.5, disk), 2);
        assert_eq!(rounds(1e9, disk), MOST_ROUNDS);
        assert_eq!(rounds(f64::NAN, disk), 0);
        assert_eq!(rounds(1.0, 0.0), 0);
    }
}
