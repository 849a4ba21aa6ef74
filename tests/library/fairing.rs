//! Solves through the public entry, errors against exact surfaces, distances, and bars to be met.

use std::ops::Sub;

use fairmesh::{BoundaryNormals, Options, Outcome, Selection, Solution, fair};
use fairmesh_shapes::{Sampling, Shape};
use nalgebra::Vector3;

/// The tolerance of tests about accuracy: the default leaves errors of its own size.
pub(crate) const TIGHT: f64 = 1e-10;

/// Irregular vertices.
pub(crate) fn irregular(seed: u64) -> Sampling {
    Sampling::Irregular { seed }
}

/// Options for one thread, because tests run side by side.
pub(crate) fn options(tolerance: f64) -> Options {
    Options {
        tolerance,
        threads: 1,
        ..Options::default()
    }
}

/// A wrong shape over the same boundary; what was fixed after the shape was made is where it was.
pub(crate) fn flat(shape: &Shape) -> Vec<[f64; 3]> {
    let mut flat = shape.flat();
    for (v, p) in flat.iter_mut().enumerate().filter(|(v, _)| !shape.free[*v]) {
        *p = shape.positions[v];
    }
    flat
}

/// The three ways to destroy the interior.
pub(crate) fn starts(shape: &Shape, seed: u64) -> [(&'static str, Vec<[f64; 3]>); 3] {
    [
        ("flat", flat(shape)),
        ("noise", shape.noise(seed, 0.5)),
        ("random", shape.random(seed)),
    ]
}

/// Fairs with the exact boundary normals.
pub(crate) fn solve(shape: &Shape, start: &[[f64; 3]], options: Options) -> Solution {
    solve_given(shape, start, &shape.boundary_normals(), options)
}

/// Fairs with these boundary normals.
pub(crate) fn solve_given(
    shape: &Shape,
    start: &[[f64; 3]],
    given: &[(u32, [f64; 3])],
    options: Options,
) -> Solution {
    let options = Options {
        boundary_normals: BoundaryNormals::Given(given.to_vec()),
        ..options
    };
    solve_as_asked(shape, start, options)
}

/// Fairs the shape as it is, or says why not.
pub(crate) fn attempt(shape: &Shape, options: Options) -> Result<Solution, fairmesh::Error> {
    fair(
        &shape.positions,
        &shape.triangles,
        Selection::Mask(&shape.free),
        &options,
    )
}

/// Fairs with the normals of the options.
pub(crate) fn solve_as_asked(shape: &Shape, start: &[[f64; 3]], options: Options) -> Solution {
    fair(start, &shape.triangles, Selection::Mask(&shape.free), &options).expect("a sound problem")
}

/// Distances of the free vertices to the exact surface, in diagonals; or what else is measured there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Errors {
    /// The largest.
    pub max: f64,
    /// Root mean square.
    pub rms: f64,
}

impl Errors {
    /// Of any figures. A figure that is no number makes both infinite.
    pub(crate) fn of(values: impl Iterator<Item = f64>) -> Self {
        let (mut max, mut squares, mut count) = (0.0f64, 0.0, 0usize);
        for v in values {
            let v = if v.is_nan() { f64::INFINITY } else { v.abs() };
            max = max.max(v);
            squares += v * v;
            count += 1;
        }
        Self {
            max,
            rms: (squares / count.max(1) as f64).sqrt(),
        }
    }
}

/// Errors of the positions.
pub(crate) fn errors(shape: &Shape, solution: &Solution) -> Errors {
    let surface = shape.surface.as_ref().expect("an exact surface");
    let free = shape.free_vertices().into_iter();
    let distance = |v: u32| surface.distance(solution.positions[v as usize]);
    Errors::of(free.map(|v| distance(v) / solution.report.diagonal))
}

/// Errors of the mean curvature, times the diagonal.
pub(crate) fn curvature_errors(shape: &Shape, solution: &Solution) -> Errors {
    let surface = shape.surface.as_ref().expect("an exact surface");
    let exact = |v: u32| surface.mean_curvature(solution.positions[v as usize]);
    Errors::of(
        solution
            .mean_curvature
            .iter()
            .map(|&(v, h)| (h - exact(v)) * solution.report.diagonal),
    )
}

/// The convergence order of errors that go with edge lengths `n^(-1/2)`, the mean over the refinements.
pub(crate) fn order(errors: &[f64], vertices: &[usize]) -> f64 {
    let last = errors.len() - 1;
    let refined = (vertices[last] as f64 / vertices[0] as f64).sqrt();
    (errors[0] / errors[last]).ln() / refined.ln()
}

/// The largest distance between vertices of the same number.
pub(crate) fn apart(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    assert_eq!(a.len(), b.len());
    Errors::of(a.iter().zip(b).map(|(a, b)| (vector(a) - vector(b)).norm())).max
}

/// Fixes the free vertices that are chosen; returns them.
pub(crate) fn fix(shape: &mut Shape, chosen: impl Fn(usize, Vector3<f64>) -> bool) -> Vec<u32> {
    let fixed: Vec<u32> = shape
        .free_vertices()
        .into_iter()
        .filter(|&v| chosen(v as usize, vector(&shape.positions[v as usize])))
        .collect();
    fixed.iter().for_each(|&v| shape.free[v as usize] = false);
    fixed
}

/// As nalgebra's.
pub(crate) fn vector(p: &[f64; 3]) -> Vector3<f64> {
    Vector3::from(*p)
}

/// The angle between two vectors in degrees, exact for small ones too.
pub(crate) fn angle(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let (a, b) = (vector(a), vector(b));
    a.cross(&b).norm().atan2(a.dot(&b)).to_degrees()
}

/// The distance of a point to a triangle.
pub(crate) fn point_triangle_distance(p: Vector3<f64>, [a, b, c]: [Vector3<f64>; 3]) -> f64 {
    let n = (b - a).cross(&(c - a));
    let inside = |a: Vector3<f64>, b: Vector3<f64>| n.dot(&(b - a).cross(&(p - a))) >= 0.0;
    if n.norm_squared() > 0.0 && inside(a, b) && inside(b, c) && inside(c, a) {
        return n.dot(&(p - a)).abs() / n.norm();
    }
    let edges = [(a, b), (b, c), (c, a)];
    edges
        .into_iter()
        .map(|(a, b)| point_segment_distance(p, a, b))
        .fold(f64::INFINITY, f64::min)
}

fn point_segment_distance(p: Vector3<f64>, a: Vector3<f64>, b: Vector3<f64>) -> f64 {
    let e = b.sub(a);
    let t = (e.dot(&(p - a)) / e.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (p - (a + e * t)).norm()
}

/// The distances of points to the surface of a mesh, by trying every triangle whose bounding ball is near.
pub(crate) fn distances_to_mesh(
    points: &[[f64; 3]],
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
) -> Errors {
    let corners: Vec<[Vector3<f64>; 3]> = triangles
        .iter()
        .map(|t| t.map(|v| vector(&positions[v as usize])))
        .collect();
    let balls: Vec<(Vector3<f64>, f64)> = corners
        .iter()
        .map(|c| {
            let centre = (c[0] + c[1] + c[2]) / 3.0;
            (centre, c.iter().map(|p| (p - centre).norm()).fold(0.0, f64::max))
        })
        .collect();
    Errors::of(points.iter().map(|p| {
        let p = vector(p);
        let mut nearest = f64::INFINITY;
        for (triangle, (centre, radius)) in corners.iter().zip(&balls) {
            let reach = nearest + radius;
            if (p - centre).norm_squared() < reach * reach {
                nearest = nearest.min(point_triangle_distance(p, *triangle));
            }
        }
        nearest
    }))
}

/// A surface has been found.
#[track_caller]
pub(crate) fn assert_success(outcome: &Outcome) {
    assert!(outcome.is_success(), "{outcome:?}");
}

/// Figures to be met. All are measured and printed before the first miss fails the test.
#[derive(Debug, Default)]
pub(crate) struct Bars {
    missed: Vec<String>,
}

impl Bars {
    /// The figure is at most the bar (so that NaN misses it).
    pub(crate) fn at_most(&mut self, what: impl AsRef<str>, figure: f64, bar: f64) {
        self.check(what, figure <= bar, format!("{figure:.3e} > {bar:.1e}"));
    }

    /// The figure is at least the bar.
    pub(crate) fn at_least(&mut self, what: impl AsRef<str>, figure: f64, bar: f64) {
        self.check(what, figure >= bar, format!("{figure:.3e} < {bar:.1e}"));
    }

    /// The run has met its tolerance without reservation.
    pub(crate) fn converged(&mut self, what: impl AsRef<str>, solution: &Solution) {
        let outcome = &solution.report.outcome;
        self.check(what, *outcome == Outcome::Converged, outcome.name().to_owned());
    }

    /// The run has ended so, by the outcome's name: also where no surface is found, so that a cure is seen.
    pub(crate) fn ends(&mut self, what: impl AsRef<str>, solution: &Solution, outcome: &str) {
        let name = solution.report.outcome.name();
        self.check(what, name == outcome, format!("{name}, was {outcome}"));
    }

    /// Anything else.
    pub(crate) fn check(&mut self, what: impl AsRef<str>, met: bool, otherwise: String) {
        if !met {
            self.missed.push(format!("{}: {otherwise}", what.as_ref()));
        }
    }

    /// Fails with all that was missed.
    pub(crate) fn finish(self) {
        assert!(
            self.missed.is_empty(),
            "{} missed:\n{}",
            self.missed.len(),
            self.missed.join("\n")
        );
    }
}
