//! The same case given to OpenMesh's smoother and to fairmesh, measured alike.

use std::time::Instant;

use fairmesh::{Options, Outcome, Selection, fair};
use fairmesh_shapes::*;
use nalgebra::Vector3;

use crate::smoother::Smoother;
use crate::stationary::stationary;

/// After so many iterations the smoother's surface is looked at.
pub const ITERATIONS: [u32; 3] = [100, 1_000, 10_000];
/// The surfaces.
pub const SURFACES: [&str; 3] = ["sphere", "cylinder", "catenoid"];

/// A surface that is known, with its interior spoiled.
pub struct Case {
    pub surface: &'static str,
    pub triangulation: &'static str,
    /// The exact mesh.
    shape: Shape,
    /// A wrong interior over the same boundary: where both begin.
    start: Vec<[f64; 3]>,
}

/// What came out.
pub struct Measured {
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
}

/// The triangulations of a surface with about `n` free vertices, with rings of exact triangles around them.
pub fn cases(surface: &'static str, n: usize) -> [Case; 3] {
    let samplings = [
        ("regular", Sampling::Regular),
        ("irregular", Sampling::Irregular { seed: 1 }),
        ("locally refined", Sampling::locally_refined()),
    ];
    samplings.map(|(triangulation, sampling)| {
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
    })
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(s, n), v| (s + v * v, n + 1.0));
    (sum / f64::max(count, 1.0)).sqrt()
}

impl Case {
    /// Diagonal of the bounding box of the exact free vertices.
    fn diagonal(&self) -> f64 {
        let free = self.shape.free_vertices();
        let positions = free
            .iter()
            .map(|&v| Vector3::from(self.shape.positions[v as usize]));
        let empty = [f64::INFINITY, f64::NEG_INFINITY].map(Vector3::repeat);
        let [low, high] = positions.fold(empty, |[low, high], p| [low.inf(&p), high.sup(&p)]);
        (high - low).norm()
    }

    /// How far the triangles with a free vertex turn from the exact normals at their fixed vertices.
    fn boundary_normals(&self, positions: &[[f64; 3]]) -> f64 {
        let shape = &self.shape;
        let free = |v: &u32| shape.free[*v as usize];
        let inside = shape.triangles.iter().filter(|t| t.iter().any(free));
        rms(inside.flat_map(|t| {
            let [a, b, c] = t.map(|v| Vector3::from(positions[v as usize]));
            let n = (b - a).cross(&(c - a));
            let exact = |&v: &u32| Vector3::from(shape.normals[v as usize]);
            let fixed = t.iter().filter(|v| !free(v));
            fixed.map(move |v| n.angle(&exact(v)).to_degrees())
        }))
    }

    fn measure(&self, clock: Instant, converged: bool, positions: &[[f64; 3]]) -> Measured {
        let seconds = clock.elapsed().as_secs_f64();
        let surface = self.shape.surface.as_ref().expect("a surface that is known");
        let (diagonal, free) = (self.diagonal(), self.shape.free_vertices());
        let distance = |&v: &u32| surface.distance(positions[v as usize]) / diagonal;
        // A NaN is infinitely far.
        let larger = |worst: f64, d: f64| if d.is_nan() { f64::INFINITY } else { worst.max(d) };
        Measured {
            seconds,
            max: free.iter().map(distance).fold(0.0, larger),
            rms: rms(free.iter().map(distance)),
            normals: self.boundary_normals(positions),
            converged,
        }
    }

    /// The exact mesh itself: its triangles turn from the exact normals too.
    pub fn exact(&self) -> Measured {
        self.measure(Instant::now(), true, &self.shape.positions)
    }

    /// OpenMesh's C1 smoother, after so many iterations from the start.
    pub fn smoothed(&self, iterations: u32) -> Measured {
        let clock = Instant::now();
        let mut mesh =
            Smoother::new(&self.start, &self.shape.triangles, &self.shape.free).expect("a manifold");
        mesh.smooth(iterations);
        self.measure(clock, false, &mesh.positions())
    }

    /// Where the smoother would end if it ran for ever.
    pub fn limit(&self) -> Measured {
        let clock = Instant::now();
        let positions = stationary(&self.start, &self.shape.triangles, &self.shape.free);
        self.measure(clock, true, &positions)
    }

    /// fairmesh with its defaults on one thread. It sees what the smoother sees: no normals are given.
    pub fn ours(&self) -> Measured {
        let clock = Instant::now();
        let options = Options {
            threads: 1,
            ..Options::default()
        };
        let free = Selection::Mask(&self.shape.free);
        let solution = fair(&self.start, &self.shape.triangles, free, &options).expect("a sound problem");
        let converged = solution.report.outcome == Outcome::Converged;
        self.measure(clock, converged, &solution.positions)
    }
}
