//! The same cases given to OpenMesh's smoother and to fairmesh, measured alike. Shared by `tests/comparison.rs` and
//! `examples/report`.

mod stationary;

use std::time::Instant;

use fairmesh::{BoundaryNormals, Options, Outcome, Selection, fair};
use fairmesh_shapes::*;
use openmesh_sys::openmesh::{Mesh, Smoothing};

pub use stationary::stationary;

/// After so many iterations the smoother's surface is looked at.
pub const ITERATIONS: [u32; 3] = [100, 1_000, 10_000];

/// A surface that is known, with its interior spoiled.
pub struct Case {
    /// Of which surface.
    pub surface: &'static str,
    /// How it is triangulated.
    pub triangulation: &'static str,
    /// The exact mesh.
    pub shape: Shape,
    /// A wrong interior over the same boundary: where both begin.
    pub start: Vec<[f64; 3]>,
}

/// The surfaces.
pub const SURFACES: [&str; 3] = ["sphere", "cylinder", "catenoid"];

/// Triangulations: names and what they are.
pub fn triangulations() -> [(&'static str, Sampling); 3] {
    [
        ("regular", Sampling::Regular),
        ("irregular", Sampling::Irregular { seed: 1 }),
        ("locally refined", Sampling::locally_refined()),
    ]
}

/// A case of about `n` free vertices, with rings of exact triangles around them.
pub fn case(surface: &'static str, (triangulation, sampling): (&'static str, Sampling), n: usize) -> Case {
    let shape = match surface {
        "sphere" => sphere_cap(60.0, n, sampling, OUTSIDE),
        "cylinder" => cylinder_band(n, sampling, OUTSIDE),
        _ => catenoid_band(n, sampling, OUTSIDE),
    };
    let start = shape.flat();
    Case {
        surface,
        triangulation,
        shape,
        start,
    }
}

/// What came out.
#[derive(Debug, Clone)]
pub struct Measured {
    /// Iterations of either kind.
    pub iterations: usize,
    /// Wall seconds on one thread, from arrays to arrays.
    pub seconds: f64,
    /// Largest distance of a free vertex to the exact surface, over the diagonal of the free part.
    pub max: f64,
    /// Root mean square of the same.
    pub rms: f64,
    /// Root mean square angle, in degrees, between exact normals at boundary vertices and the free triangles there.
    pub normals: f64,
    /// Whether it says that it is done.
    pub converged: bool,
    /// The surface.
    pub positions: Vec<[f64; 3]>,
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(s, n), v| (s + v * v, n + 1.0));
    (sum / f64::max(count, 1.0)).sqrt()
}

impl Case {
    /// Diagonal of the bounding box of the exact free vertices.
    fn diagonal(&self) -> f64 {
        let free = || {
            self.shape
                .free_vertices()
                .into_iter()
                .map(|v| self.shape.positions[v as usize])
        };
        let extent = |k: usize| {
            let [low, high] = free().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], p| {
                [l.min(p[k]), h.max(p[k])]
            });
            high - low
        };
        norm([0, 1, 2].map(extent))
    }

    /// How far the triangles with a free vertex turn from the exact normals at their fixed vertices.
    fn boundary_normals(&self, positions: &[[f64; 3]]) -> f64 {
        let shape = &self.shape;
        let free = |v: &u32| shape.free[*v as usize];
        let inside = shape.triangles.iter().filter(|t| t.iter().any(free));
        let angles = inside.flat_map(|t| {
            let [a, b, c] = t.map(|v| positions[v as usize]);
            let n = cross(difference(b, a), difference(c, a));
            let fixed = t.iter().filter(|v| !free(v));
            fixed.map(move |&v| {
                let exact = shape.normals[v as usize];
                norm(cross(n, exact)).atan2(dot(n, exact)).to_degrees()
            })
        });
        rms(angles)
    }

    /// Measures a surface.
    pub fn measure(
        &self,
        iterations: usize,
        seconds: f64,
        converged: bool,
        positions: Vec<[f64; 3]>,
    ) -> Measured {
        let surface = self.shape.surface.as_ref().expect("a surface that is known");
        let diagonal = self.diagonal();
        let free = self.shape.free_vertices();
        let off = || {
            free.iter()
                .map(|&v| surface.distance(positions[v as usize]) / diagonal)
        };
        Measured {
            iterations,
            seconds,
            // A NaN is infinitely far.
            max: off().fold(0.0, |worst, d| {
                if d <= worst {
                    worst
                } else if d.is_nan() {
                    f64::INFINITY
                } else {
                    d
                }
            }),
            rms: rms(off()),
            normals: self.boundary_normals(&positions),
            converged,
            positions,
        }
    }

    /// The exact mesh itself: its triangles turn from the exact normals too.
    pub fn exact(&self) -> Measured {
        self.measure(0, 0.0, true, self.shape.positions.clone())
    }

    /// OpenMesh's C1 smoother, after each of [`ITERATIONS`]; every run from the start, so that times are whole.
    pub fn smoother(&self) -> Vec<Measured> {
        ITERATIONS.iter().map(|&n| self.smoothed(n)).collect()
    }

    /// The smoother after `iterations`.
    pub fn smoothed(&self, iterations: u32) -> Measured {
        let clock = Instant::now();
        let mut mesh = Mesh::<f64>::new(&self.start, &self.shape.triangles).expect("a manifold");
        mesh.select(&self.shape.free);
        mesh.smooth(Smoothing::c1(iterations)).expect("enough memory");
        let positions = mesh.positions();
        let seconds = clock.elapsed().as_secs_f64();
        self.measure(iterations as usize, seconds, false, positions)
    }

    /// Where the smoother would end if it ran for ever.
    pub fn limit(&self) -> Measured {
        let clock = Instant::now();
        let positions = stationary(&self.start, &self.shape.triangles, &self.shape.free);
        self.measure(0, clock.elapsed().as_secs_f64(), true, positions)
    }

    /// fairmesh with its defaults on one thread. It sees what the smoother sees: no normals are given.
    pub fn ours(&self) -> Measured {
        self.faired(BoundaryNormals::Fitted)
    }

    /// fairmesh with the exact boundary normals.
    pub fn ours_with_normals(&self) -> Measured {
        self.faired(BoundaryNormals::Given(self.shape.boundary_normals()))
    }

    fn faired(&self, boundary_normals: BoundaryNormals) -> Measured {
        let clock = Instant::now();
        let options = Options {
            boundary_normals,
            threads: 1,
            ..Options::default()
        };
        let solution = fair(
            &self.start,
            &self.shape.triangles,
            Selection::Mask(&self.shape.free),
            &options,
        );
        let solution = solution.expect("a sound problem");
        let seconds = clock.elapsed().as_secs_f64();
        let converged = solution.report.outcome == Outcome::Converged;
        self.measure(solution.report.iterations, seconds, converged, solution.positions)
    }
}

/// The one that came closest, by the root mean square: the largest distance hardly falls, because fairing begins at the boundary.
pub fn best(runs: &[Measured]) -> &Measured {
    runs.iter()
        .min_by(|a, b| a.rms.total_cmp(&b.rms))
        .expect("at least one")
}
