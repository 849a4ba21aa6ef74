//! Rigid motions of fixed vertices, with others that follow in part.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use nalgebra::{Matrix3, Vector3};

use super::along_loop::fade;

/// A rotation about a point, then a translation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Motion {
    pub(super) rotation: Vector3<f64>,
    pub(super) centre: Vector3<f64>,
    pub(super) translation: Vector3<f64>,
}

impl Motion {
    /// A part of the motion: a vertex's new place, and how its normal turns. The identity keeps the bits.
    pub(super) fn part(&self, part: f64, p: Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let turn = rotation_by(&(self.rotation * part));
        let moved = if self.rotation == Vector3::zeros() {
            p
        } else {
            self.centre + turn * (p - self.centre)
        };
        (moved + self.translation * part, turn)
    }
}

/// The rotation about this axis by its length (Rodrigues).
fn rotation_by(rotation: &Vector3<f64>) -> Matrix3<f64> {
    let angle = rotation.norm();
    let Some(axis) = rotation.try_normalize(f64::MIN_POSITIVE) else {
        return Matrix3::identity();
    };
    let k = axis.cross_matrix();
    Matrix3::identity() + k * libm::sin(angle) + k * k * (1.0 - libm::cos(angle))
}

/// How much each vertex takes of a motion of `moved`: 1 of those, and less with the distance along the edges of the triangles; ascending.
pub(super) fn followers(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    moved: &[u32],
    falloff: f64,
) -> Vec<(u32, f64)> {
    let mut found: Vec<(u32, f64)> = if falloff == 0.0 {
        moved.iter().map(|&v| (v, 1.0)).collect()
    } else {
        let distances = distances(positions, triangles, moved, falloff);
        let parts = distances.iter().map(|&(v, d)| (v, fade(d / falloff)));
        parts.filter(|(_, part)| *part > 0.0).collect()
    };
    found.sort_unstable_by_key(|(v, _)| *v);
    found.dedup_by_key(|(v, _)| *v);
    found
}

/// The vertices within a distance, by Dijkstra's algorithm.
fn distances(positions: &[[f64; 3]], triangles: &[[u32; 3]], from: &[u32], within: f64) -> Vec<(u32, f64)> {
    let mut edges: Vec<(u32, u32)> = triangles
        .iter()
        .flat_map(|&[a, b, c]| [(a, b), (b, a), (b, c), (c, b), (c, a), (a, c)])
        .collect();
    edges.sort_unstable();
    edges.dedup();
    let mut nearest = vec![f64::INFINITY; positions.len()];
    // Bits of numbers that are not negative have their order.
    let mut queue: BinaryHeap<Reverse<(u64, u32)>> = BinaryHeap::new();
    for &v in from {
        nearest[v as usize] = 0.0;
        queue.push(Reverse((0_f64.to_bits(), v)));
    }
    let mut found = Vec::new();
    while let Some(Reverse((d, v))) = queue.pop() {
        let here = nearest[v as usize];
        if d != here.to_bits() {
            continue;
        }
        found.push((v, here));
        let first = edges.partition_point(|edge| edge.0 < v);
        for &(_, other) in edges[first..].iter().take_while(|edge| edge.0 == v) {
            let at = |v: u32| Vector3::from(positions[v as usize]);
            let there = here + (at(other) - at(v)).norm();
            if there < within && there < nearest[other as usize] {
                nearest[other as usize] = there;
                queue.push(Reverse((there.to_bits(), other)));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn followers_fade_with_the_distance_along_edges() {
        // A strip of two rows of unit squares.
        let positions: Vec<[f64; 3]> = (0..10)
            .map(|v| [f64::from(v / 2), f64::from(v % 2), 0.0])
            .collect();
        let triangles: Vec<[u32; 3]> = (0..4u32)
            .flat_map(|k| [[2 * k, 2 * k + 2, 2 * k + 1], [2 * k + 1, 2 * k + 2, 2 * k + 3]])
            .collect();
        assert_eq!(
            followers(&positions, &triangles, &[4, 2], 0.0),
            [(2, 1.0), (4, 1.0)]
        );
        let found = followers(&positions, &triangles, &[0], 4.0);
        let expected = [(0, 0.0), (1, 1.0), (2, 1.0), (4, 2.0), (6, 3.0), (5, 3.0)];
        for (v, d) in expected {
            let part = found.iter().find(|f| f.0 == v).unwrap().1;
            assert!((part - fade(d / 4.0)).abs() < 1e-15, "{v}");
        }
        assert_all!(found.iter(), |f| f.0 != 8);
    }

    #[test]
    fn a_quarter_turn_about_a_point_is_what_it_is() {
        let motion = Motion {
            rotation: Vector3::z() * std::f64::consts::PI,
            centre: Vector3::x(),
            translation: Vector3::z() * 2.0,
        };
        let (p, turn) = motion.part(0.5, Vector3::new(3.0, 0.0, 0.0));
        assert_below!((p - Vector3::new(1.0, 2.0, 1.0)).norm(), 1e-15);
        assert_below!((turn * Vector3::x() - Vector3::y()).norm(), 1e-15);
    }
}
