//! The normal at the boundary of a surface whose coordinates were rounded: where that turns single edges by far more than the
//! surface turns, only many samples tell the tangent plane.
//!
//! The quadric of [`super::curvature`] in the least squares of heights, which all are wrong by the same, and not of
//! curvatures, for which near vertices would count most; its constant is the vertex's own error. `d = |e|^2` keeps spheres
//! exact, as there.

use nalgebra::Vector3;

use super::curvature::{NormalEquations, TangentFrame, back_substitute};
use super::outside_fit::{Fit, repeated, root_mean_square, squared_residual};
use super::simd::{Simd, Vec3, dot, lane, one};
use crate::mesh::outside_neighbours::{Marks, OutsideNeighbours, RINGS_WIDE};

/// Unknowns: those of [`TangentFrame::sample`] and the constant.
const UNKNOWNS: usize = 6;
/// Keeps the fit defined where the samples do not determine it.
/// Half or double, of 2 cases: none changes.
const RIDGES: [f64; UNKNOWNS] = [0.0, 1e-10, 1e-10, 1e-10, 1e-10, 1e-10];
/// Fewer samples cannot judge the fit.
/// Half or double, of 2 cases: none changes.
const FEWEST: usize = 20;
/// At most this many fits per vertex.
/// Half or double, of 2 cases: none changes.
const MAX_FITS: usize = 20;

/// Samples of many rings outside: edge vectors.
#[derive(Debug, Default)]
pub(crate) struct EightRingSamples {
    edges: Vec<Vec3<1>>,
    /// Their root mean square length.
    length: f64,
    found: Vec<u32>,
    marks: Marks,
}

impl EightRingSamples {
    /// Those of boundary vertex `v` (local number).
    pub(crate) fn gather(&mut self, outside: &OutsideNeighbours, x: &[Vector3<f64>], v: usize) {
        self.gather_within(RINGS_WIDE, outside, x, v);
    }

    /// Those within so many rings.
    pub(crate) fn gather_within(
        &mut self,
        rings: usize,
        outside: &OutsideNeighbours,
        x: &[Vector3<f64>],
        v: usize,
    ) {
        outside.disc(v as u32, rings, &mut self.found, &mut self.marks);
        self.edges.clear();
        self.edges
            .extend(self.found.iter().map(|&j| one(&(x[j as usize] - x[v]))));
        self.length = root_mean_square(self.edges.iter());
    }

    /// The fit, from about the right normal; `None` if the samples are too few.
    pub(crate) fn fit(&self, start: Vector3<f64>) -> Option<Fit> {
        if self.edges.len() < FEWEST {
            return None;
        }
        repeated(start, MAX_FITS, |n| self.fit_once(n))
    }

    fn fit_once(&self, n: &Vector3<f64>) -> Fit {
        let frame = TangentFrame::new(one(n));
        let l = Simd([self.length]);
        let mut equations = NormalEquations::<1, UNKNOWNS>::new();
        for e in &self.edges {
            let (phi, kappa, weight) = sample(&frame, e, l);
            equations.add(&phi, kappa, weight);
        }
        let factor = equations.cholesky(&RIDGES);
        let y = back_substitute(&factor, equations.right);
        let residual = |e: &Vec3<1>| {
            let (phi, kappa, weight) = sample(&frame, e, l);
            weight.0[0] * squared_residual(&(phi, kappa), &y)
        };
        let sum: f64 = self.edges.iter().map(residual).sum();
        let variance = sum / (self.edges.len() - UNKNOWNS) as f64;
        let inverse = |r: usize| {
            let mut unit = [Simd([0.0]); UNKNOWNS];
            unit[r] = Simd([1.0]);
            back_substitute(&factor, unit)[r].0[0]
        };
        Fit {
            normal: lane(&frame.tilted(l * y[3], l * y[4]), 0),
            error: l.0[0] * (variance * (inverse(3) + inverse(4))).sqrt(),
        }
    }
}

/// Basis values, the normal curvature `2w/d` and the weight that makes its residual one of the height `w`.
fn sample(frame: &TangentFrame<1>, e: &Vec3<1>, l: Simd<1>) -> ([Simd<1>; UNKNOWNS], Simd<1>, Simd<1>) {
    let ([one, a, b, u, v], kappa) = frame.sample(e, l);
    let square = dot(e, e) * (l * l).recip();
    ([one, a, b, u, v, square.recip()], kappa, square * square)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrete::outside_fit::{SECOND, Samples};
    use crate::mesh::{RegionMesh, Selection};
    use fairmesh_shapes::{Sampling, Shape, sphere_cap};

    /// The largest angles between the exact normals and the fit to eight rings, and that to three.
    fn worst(shape: &Shape, positions: &[[f64; 3]]) -> [f64; 2] {
        let region = RegionMesh::new(positions, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
        let x = region.positions(positions);
        let outside = OutsideNeighbours::new(&region);
        let (mut eight, mut three, mut found) = (EightRingSamples::default(), Samples::default(), Vec::new());
        let mut worst = [0.0_f64; 2];
        for v in region.free..region.region_vertices() {
            let exact = Vector3::from(shape.normals[region.vertex_ids[v] as usize]);
            eight.gather(&outside, &x, v);
            three.gather(&outside, &x, v, &mut found);
            let fits = [eight.fit(exact).unwrap(), SECOND.fit(&three, exact).unwrap()];
            for (worst, fit) in worst.iter_mut().zip(fits) {
                *worst = worst.max(fit.normal.cross(&exact).norm());
            }
        }
        worst
    }

    #[test]
    fn spheres_are_exact_and_rounding_is_averaged_away() {
        let shape = sphere_cap(60.0, 4_000, Sampling::Irregular { seed: 7 }, 10);
        assert_below!(worst(&shape, &shape.positions)[0], 1e-9);
        let rounded = |c: f64| f64::from((c + 1_000.0) as f32);
        let far: Vec<_> = shape.positions.iter().map(|p| p.map(rounded)).collect();
        let [eight, three] = worst(&shape, &far);
        assert!(eight < 0.1 * three, "{eight} {three}");
    }
}
