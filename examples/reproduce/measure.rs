//! Distances, angles, orders, and the linear surface that the paper compares with.

use std::fs;
use std::io;
use std::ops::ControlFlow;

use fairmesh::{BoundaryNormals, InnerFairness, Options, Selection, fair_with_progress};
use nalgebra::Vector3;

use crate::tool::Case;

/// The solution of the linear problem with G1 boundary data (paper (3), 7.4), which the solver starts from: a run that is
/// stopped at its first iteration.
pub fn linear_surface(case: &Case, inner: InnerFairness) -> io::Result<Vec<[f64; 3]>> {
    let given = given_normals(case)?;
    let mut stop = |progress: &fairmesh::Progress| match progress.iterations {
        0 => ControlFlow::Continue(()),
        _ => ControlFlow::Break(()),
    };
    let options = Options {
        boundary_normals: BoundaryNormals::Given(given),
        inner_fairness: inner,
        ..Options::default()
    };
    let solution = fair_with_progress(
        &case.positions,
        &case.triangles,
        Selection::Vertices(&case.free),
        &options,
        &mut stop,
    );
    Ok(solution.map_err(io::Error::other)?.positions)
}

fn given_normals(case: &Case) -> io::Result<Vec<(u32, [f64; 3])>> {
    let path = case
        .normals_file
        .as_ref()
        .ok_or_else(|| io::Error::other("no normals"))?;
    let text = fs::read_to_string(path)?;
    let line = |line: &str| {
        let words: Vec<f64> = line.split_whitespace().filter_map(|w| w.parse().ok()).collect();
        (words.len() == 4).then(|| (words[0] as u32, [words[1], words[2], words[3]]))
    };
    Ok(text.lines().filter_map(line).collect())
}

/// The diagonal of the bounding box.
pub fn diagonal(positions: &[[f64; 3]]) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for p in positions {
        (0..3).for_each(|k| {
            low[k] = low[k].min(p[k]);
            high[k] = high[k].max(p[k]);
        });
    }
    (0..3).map(|k| (high[k] - low[k]).powi(2)).sum::<f64>().sqrt()
}

/// Largest and root mean square of some distances.
#[derive(Debug, Clone, Copy)]
pub struct Distance {
    pub max: f64,
    pub rms: f64,
}

impl Distance {
    /// Of these numbers.
    pub fn of(all: impl Iterator<Item = f64>) -> Distance {
        let (mut max, mut squares, mut count) = (0.0f64, 0.0, 0usize);
        for d in all {
            max = if d.is_nan() { d } else { max.max(d) };
            squares += d * d;
            count += 1;
        }
        Distance {
            max,
            rms: (squares / count.max(1) as f64).sqrt(),
        }
    }
}

/// The distances of points to the surface of a mesh, over the mesh's diagonal.
pub fn to_mesh(points: &[[f64; 3]], positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Distance {
    let corners: Vec<[Vector3<f64>; 3]> = triangles
        .iter()
        .map(|t| t.map(|v| Vector3::from(positions[v as usize])))
        .collect();
    let balls: Vec<(Vector3<f64>, f64)> = corners
        .iter()
        .map(|c| {
            let centre = (c[0] + c[1] + c[2]) / 3.0;
            (centre, c.iter().map(|p| (p - centre).norm()).fold(0.0, f64::max))
        })
        .collect();
    let scale = diagonal(positions);
    Distance::of(points.iter().map(|p| {
        let p = Vector3::from(*p);
        let mut nearest = f64::INFINITY;
        for (triangle, (centre, radius)) in corners.iter().zip(&balls) {
            let reach = nearest + radius;
            if (p - centre).norm_squared() < reach * reach {
                nearest = nearest.min(to_triangle(p, *triangle));
            }
        }
        nearest / scale
    }))
}

fn to_triangle(p: Vector3<f64>, [a, b, c]: [Vector3<f64>; 3]) -> f64 {
    let n = (b - a).cross(&(c - a));
    let inside = |a: Vector3<f64>, b: Vector3<f64>| n.dot(&(b - a).cross(&(p - a))) >= 0.0;
    if n.norm_squared() > 0.0 && inside(a, b) && inside(b, c) && inside(c, a) {
        return n.dot(&(p - a)).abs() / n.norm();
    }
    [(a, b), (b, c), (c, a)]
        .into_iter()
        .map(|(a, b)| {
            let e = b - a;
            let t = (e.dot(&(p - a)) / e.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            (p - (a + e * t)).norm()
        })
        .fold(f64::INFINITY, f64::min)
}

/// The distances of vertices of the same number, over the diagonal.
pub fn apart(a: &[[f64; 3]], b: &[[f64; 3]]) -> Distance {
    let scale = diagonal(a);
    let distance = |(a, b): (&[f64; 3], &[f64; 3])| (Vector3::from(*a) - Vector3::from(*b)).norm() / scale;
    Distance::of(a.iter().zip(b).map(distance))
}

/// The change of the triangles' angles from one surface to another, in degrees.
pub fn distortion(case: &Case, positions: &[[f64; 3]]) -> Distance {
    let angles = |positions: &[[f64; 3]], t: &[u32; 3]| {
        let p = t.map(|v| Vector3::from(positions[v as usize]));
        [0, 1, 2].map(|k| {
            let (a, b) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            a.cross(&b).norm().atan2(a.dot(&b)).to_degrees()
        })
    };
    Distance::of(case.triangles.iter().flat_map(|t| {
        let (before, after) = (angles(&case.positions, t), angles(positions, t));
        [0, 1, 2].map(|k| (after[k] - before[k]).abs())
    }))
}

/// The order of errors that go with edge lengths `n^(-1/2)`.
pub fn order(errors: &[f64], vertices: &[usize]) -> f64 {
    let last = errors.len() - 1;
    let refined = (vertices[last] as f64 / vertices[0] as f64).sqrt();
    (errors[0] / errors[last]).ln() / refined.ln()
}
