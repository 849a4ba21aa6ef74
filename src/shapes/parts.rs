//! Surfaces in several parts, to be joined: pieces of a shape, and tubes on axes.

use super::arithmetic::{between, cross, unit};
use super::planar::disc_chart;
use super::revolution::cylinder_band;
use super::sampling::Sampling;
use super::shape::{Lifted, Shape};
use std::collections::BTreeMap;

/// What of a shape lies within its parts: the triangles whose vertices are all of the same part. Triangles that hang by a vertex or
/// an edge alone are dropped, so that every boundary visits a vertex once. Nothing is free.
pub fn in_parts(shape: &Shape, part_of: impl Fn([f64; 3]) -> Option<usize>) -> Shape {
    let part: Vec<Option<usize>> = shape.positions.iter().map(|&p| part_of(p)).collect();
    let is_kept = |t: &&[u32; 3]| {
        let [a, b, c] = t.map(|v| part[v as usize]);
        a.is_some() && a == b && b == c
    };
    let mut triangles: Vec<[u32; 3]> = shape.triangles.iter().filter(is_kept).copied().collect();
    while drop_loose(&mut triangles) {}
    let mut used = vec![false; part.len()];
    triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
    let kept: Vec<usize> = (0..part.len()).filter(|&v| used[v]).collect();
    let mut number = vec![0; part.len()];
    for (new, &v) in (0..).zip(&kept) {
        number[v] = new;
    }
    triangles
        .iter_mut()
        .flatten()
        .for_each(|v| *v = number[*v as usize]);
    Shape {
        positions: kept.iter().map(|&v| shape.positions[v]).collect(),
        normals: kept.iter().map(|&v| shape.normals[v]).collect(),
        flattened: kept.iter().map(|&v| shape.positions[v]).collect(),
        free: vec![false; kept.len()],
        surface: shape.surface.clone(),
        triangles,
    }
}

/// Drops triangles with two edges or more on the boundary, and those at vertices of several fans; whether there were any.
fn drop_loose(triangles: &mut Vec<[u32; 3]>) -> bool {
    let mut beyond: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for (i, t) in triangles.iter().enumerate() {
        (0..3).for_each(|k| _ = beyond.insert((t[k], t[(k + 1) % 3]), i));
    }
    // A vertex in one fan has one boundary edge that leaves it, or none.
    let mut leaving: BTreeMap<u32, usize> = BTreeMap::new();
    for &(a, b) in beyond.keys().filter(|&&(a, b)| !beyond.contains_key(&(b, a))) {
        *leaving.entry(a).or_default() += 1;
        leaving.entry(b).or_default();
    }
    let is_open = |a: u32, b: u32| !beyond.contains_key(&(b, a));
    let is_loose = |t: &[u32; 3]| {
        let open = (0..3).filter(|&k| is_open(t[k], t[(k + 1) % 3])).count();
        open > 1 || t.iter().any(|v| leaving.get(v).is_some_and(|&count| count > 1))
    };
    let before = triangles.len();
    triangles.retain(|t| !is_loose(t));
    triangles.len() < before
}

/// The unit disc in the plane z = 0.
pub fn plate(n: usize, sampling: Sampling) -> Shape {
    Shape::lifted(disc_chart(1.0, n, sampling, 0), None, |p| Lifted {
        position: [p[0], p[1], 0.0],
        normal: [0.0, 0.0, 1.0],
        flat: [p[0], p[1], 0.0],
    })
}

/// The unit sphere in four parts of about the same size, between which there are gaps of this width in degrees (1 to 60).
/// About `n` vertices are on the whole sphere.
pub fn sphere_in_pieces(n: usize, sampling: Sampling, gap: f64) -> Shape {
    // The pole at which the whole sphere has its hole is where three parts meet.
    let low = (8.0f64 / 9.0).sqrt();
    let (sin, cos) = (std::f64::consts::TAU / 3.0).sin_cos();
    let centres = [
        [0.0, 0.0, 1.0],
        [low, 0.0, -1.0 / 3.0],
        [low * cos, low * sin, -1.0 / 3.0],
        [low * cos, -low * sin, -1.0 / 3.0],
    ];
    let half = (0.5 * between(1.0, gap, 60.0)).to_radians().sin();
    let apart = (8.0f64 / 3.0).sqrt();
    let sphere = super::sphere::sphere_with_hole(1.0, n, sampling, 0);
    in_parts(&sphere, |p| {
        let along = centres.map(|c| c[0] * p[0] + c[1] * p[1] + c[2] * p[2]);
        (0..4).find(|&i| (0..4).all(|j| j == i || along[i] - along[j] > half * apart))
    })
}

/// The unit sphere without a band of this width in degrees (1 to 120) about the plane x = 0.
pub fn sphere_without_band(n: usize, sampling: Sampling, width: f64) -> Shape {
    let half = (0.5 * between(1.0, width, 120.0)).to_radians().sin();
    in_parts(&super::sphere::sphere_with_hole(1.0, n, sampling, 0), |p| {
        (p[0].abs() > half).then_some(usize::from(p[0] > 0.0))
    })
}

/// Open tubes of radius 1 and length 2 that point away from the origin along these axes, their mouths at `distance` from it.
/// Each has about `n` vertices inside.
pub fn tubes(axes: &[[f64; 3]], distance: f64, n: usize, sampling: Sampling) -> Shape {
    let tube = cylinder_band(n, sampling, 0);
    let mut shape = Shape::empty();
    for axis in axes {
        let axis = unit(*axis);
        let least = (0..3).fold(0, |k, j| if axis[j].abs() < axis[k].abs() { j } else { k });
        let side = unit(cross(
            axis,
            std::array::from_fn(|k| f64::from(u8::from(k == least))),
        ));
        let other = cross(axis, side);
        let turned = |p: [f64; 3]| -> [f64; 3] {
            std::array::from_fn(|k| p[0] * side[k] + p[1] * other[k] + p[2] * axis[k])
        };
        let first = shape.positions.len() as u32;
        let moved = |p: &[f64; 3]| turned([p[0], p[1], p[2] + distance + 1.0]);
        shape.positions.extend(tube.positions.iter().map(moved));
        shape.normals.extend(tube.normals.iter().map(|&n| turned(n)));
        shape
            .triangles
            .extend(tube.triangles.iter().map(|t| t.map(|v| first + v)));
    }
    shape.free = vec![false; shape.positions.len()];
    shape.flattened = shape.positions.clone();
    shape
}
