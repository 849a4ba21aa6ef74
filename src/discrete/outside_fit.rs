//! The normal of a surface at the boundary of what is known of it: gradient-corrected fits, as in [`super::curvature`], to the
//! vertices on one side.

use nalgebra::Vector3;

use super::curvature::{FLAP_WEIGHT, NormalEquations, TILT_RIDGE, TangentFrame, back_substitute};
use super::simd::{Simd, Vec3, dot, lane, one};
use crate::mesh::OutsideNeighbours;

/// The repeated fit stops when the normal turns by less than this (radians).
/// Of 112 cases, half: 91 change by up to 0.2 edges; double: 93 change by up to 3e-5 edges.
const STANDS: f64 = 1e-13;
/// At most this many fits per vertex.
/// Of 112 cases, half: 10 change by up to 0.3 edges; double: 6 change by up to 0.2 edges.
const MAX_FITS: usize = 300;
/// With fewer outside neighbours than this, what lies behind them counts as much as they do.
/// Of 112 cases, half: 90 change by up to 0.9 edges, +2 % iterations, 1 more succeeds;
/// double: 105 change by up to 1 edge, 1 get another triangulation, 2 more succeed.
const SMALL_RING: usize = 4;

/// A fitted normal.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fit {
    /// Unit length.
    pub normal: Vector3<f64>,
    /// Standard error of the tilt, radians.
    pub error: f64,
}

/// Fits again and again from the tilted normal, at most so often: that takes the bias of the ridge away. `None` if the
/// normal is no number at last.
pub(super) fn repeated(
    start: Vector3<f64>,
    most: usize,
    fit_once: impl Fn(&Vector3<f64>) -> Fit,
) -> Option<Fit> {
    let mut current = Fit {
        normal: start,
        error: 0.0,
    };
    for _ in 0..most {
        let next = fit_once(&current.normal);
        let turn = (next.normal - current.normal).norm();
        current = next;
        if turn < STANDS {
            break;
        }
    }
    current.normal.iter().all(|c| c.is_finite()).then_some(current)
}

/// The root mean square length of some edge vectors.
pub(super) fn root_mean_square<'a>(edges: impl ExactSizeIterator<Item = &'a Vec3<1>>) -> f64 {
    let count = edges.len();
    let squares: f64 = edges.map(|e| dot(e, e).0[0]).sum();
    (squares / count as f64).sqrt()
}

/// How far a sample, basis values and curvature, is from the fit with these coefficients: squared.
pub(super) fn squared_residual<const N: usize>(
    (phi, kappa): &([Simd<1>; N], Simd<1>),
    coefficients: &[Simd<1>; N],
) -> f64 {
    let fitted: f64 = phi.iter().zip(coefficients).map(|(p, y)| p.0[0] * y.0[0]).sum();
    (kappa.0[0] - fitted).powi(2)
}

/// What lies around a boundary vertex outside, within `R` edges: edge vectors, ring by ring.
#[derive(Debug)]
pub(crate) struct Samples<const R: usize = 3> {
    edges: Vec<Vec3<1>>,
    /// How many lie within one, two, ... edges.
    ends: [usize; R],
    /// Root mean square length within the first ring.
    length: f64,
}

impl<const R: usize> Default for Samples<R> {
    fn default() -> Self {
        Self {
            edges: Vec::new(),
            ends: [0; R],
            length: 0.0,
        }
    }
}

impl<const R: usize> Samples<R> {
    /// Those of boundary vertex `v` (local number); `found` is scratch.
    pub(crate) fn gather(
        &mut self,
        outside: &OutsideNeighbours,
        x: &[Vector3<f64>],
        v: usize,
        found: &mut Vec<u32>,
    ) {
        self.ends = outside.rings(v as u32, found);
        self.edges.clear();
        self.edges
            .extend(found.iter().map(|&j| one(&(x[j as usize] - x[v]))));
        self.length = root_mean_square(self.edges[..self.ends[0]].iter());
    }

    /// The samples and their weights by ring. A vertex with one or two outside triangles only has to trust all rings.
    fn weighted(&self, weights: &[f64; R]) -> impl Iterator<Item = (&Vec3<1>, f64)> {
        let weights = if R < BESIDE && self.ends[0] < SMALL_RING {
            [1.0; R]
        } else {
            *weights
        };
        let ring = move |k: usize| self.ends.iter().filter(|end| k >= **end).count();
        let all = self
            .edges
            .iter()
            .enumerate()
            .map(move |(k, e)| (e, weights[ring(k)]));
        all.filter(|(_, weight)| *weight > 0.0)
    }
}

/// A fit of `N` unknowns: of second order with 5, of third with 9.
#[derive(Debug)]
pub(crate) struct Order<const N: usize, const R: usize = 3> {
    /// Weights of the rings outside.
    weights: [f64; R],
    /// Added to the diagonal of the normal equations, relative to the sum of weights.
    ridges: [f64; N],
    /// Fewer samples than this cannot judge the fit.
    fewest: usize,
}

/// Quadrics, as at free vertices: the tilt and the quadratic form of [`super::curvature`].
pub(crate) const SECOND: Order<5> = Order {
    weights: [1.0, FLAP_WEIGHT, 0.0],
    ridges: [0.0, 1e-6, 1e-6, TILT_RIDGE, TILT_RIDGE],
    fewest: 6,
};

/// The same with `w = u^3, u^2 v, u v^2, v^3`: from one side alone, what the quadric leaves out would else tilt it. Their ridge is that of
/// Bombieri's norm of a cubic, `a^2 + b^2/3 + c^2/3 + d^2`, which does not depend on where `u` points.
pub(crate) const THIRD: Order<9> = Order {
    weights: [1.0, 0.5, 0.1],
    ridges: [
        0.0,
        1e-6,
        1e-6,
        TILT_RIDGE,
        TILT_RIDGE,
        1e-4,
        1e-4 / 3.0,
        1e-4 / 3.0,
        1e-4,
    ],
    fewest: 14,
};

/// Fits beside a crease reach so many rings: of a quarter of what is around a vertex.
pub(crate) const BESIDE: usize = 5;

/// The same to what lies beside a crease. On 20 rims of cylinders and cones with edges of .06 radii its normals are off by 2e-5 to 1.1e-4; with
/// equal weights by half as much again, fitted to heights by up to 1e-2.
pub(crate) const THIRD_BESIDE: Order<9, BESIDE> = Order {
    weights: [1.0, 1.0, 0.5, 0.1, 0.01],
    ridges: [0.0, 1e-9, 1e-9, 1e-6, 1e-6, 1e-7, 1e-7 / 3.0, 1e-7 / 3.0, 1e-7],
    fewest: 14,
};

impl<const N: usize, const R: usize> Order<N, R> {
    /// The fit, from about the right normal; `None` if the samples are too few.
    pub(crate) fn fit(&self, samples: &Samples<R>, start: Vector3<f64>) -> Option<Fit> {
        if samples.weighted(&self.weights).count() < self.fewest {
            return None;
        }
        repeated(start, MAX_FITS, |n| self.fit_once(samples, n))
    }

    fn fit_once(&self, samples: &Samples<R>, n: &Vector3<f64>) -> Fit {
        let frame = TangentFrame::new(one(n));
        let l = Simd([samples.length]);
        let mut normal_equations = NormalEquations::<1, N>::new();
        let mut squared = NormalEquations::<1, N>::new();
        let mut count = 0.0;
        for (e, weight) in samples.weighted(&self.weights) {
            let (phi, kappa) = basis(&frame, e, l);
            normal_equations.add(&phi, kappa, Simd([weight]));
            squared.add(&phi, kappa, Simd([weight * weight]));
            count += 1.0;
        }
        let factor = normal_equations.cholesky(&self.ridges);
        let y = back_substitute(&factor, normal_equations.right);
        let residual = |(e, weight): (&Vec3<1>, f64)| weight * squared_residual(&basis(&frame, e, l), &y);
        let sum: f64 = samples.weighted(&self.weights).map(residual).sum();
        let variance = sum / normal_equations.weight.0[0] * count / (count - N as f64).max(0.5);
        let tilt_variance: f64 = (3..5).map(|r| covariance(&factor, &squared, r)).sum();
        Fit {
            normal: lane(&frame.tilted(l * y[3], l * y[4]), 0),
            error: l.0[0] * (variance * tilt_variance).sqrt(),
        }
    }
}

/// The first `N` of the basis values of [`TangentFrame::sample`] and of the cubics `w / l`, as curvatures `2w/d`.
fn basis<const N: usize>(frame: &TangentFrame<1>, e: &Vec3<1>, l: Simd<1>) -> ([Simd<1>; N], Simd<1>) {
    let (five, kappa) = frame.sample(e, l);
    // 2u/d and 2v/d times l.
    let (c, d) = (five[3], five[4]);
    let square = dot(e, e) * (l * l).recip();
    let (u, v) = (c * square * 0.5, d * square * 0.5);
    let cubics = [c * u * u, c * u * v, d * u * v, d * v * v];
    let phi = std::array::from_fn(|k| if k < 5 { five[k] } else { cubics[k - 5] });
    (phi, kappa)
}

/// Diagonal entry `r` of `M^-1 (sum w^2 phi phi^T) M^-1`.
fn covariance<const N: usize>(factor: &[[Simd<1>; N]; N], squared: &NormalEquations<1, N>, r: usize) -> f64 {
    let mut unit = [Simd([0.0]); N];
    unit[r] = Simd([1.0]);
    let z = back_substitute(factor, unit);
    squared.quadratic_form(&z).0[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{RegionMesh, Selection};
    use fairmesh_shapes::{Sampling, catenoid_band, sphere_cap};

    /// The largest angle in degrees between a fit and the exact normals.
    fn worst<const N: usize>(order: &Order<N>, shape: &fairmesh_shapes::Shape) -> f64 {
        let region =
            RegionMesh::new(&shape.positions, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
        let x = region.positions(&shape.positions);
        let outside = OutsideNeighbours::new(&region);
        let (mut samples, mut found) = (Samples::default(), Vec::new());
        let error = |v: usize| {
            samples.gather(&outside, &x, v, &mut found);
            let exact = Vector3::from(shape.normals[region.vertex_ids[v] as usize]);
            let fit = order.fit(&samples, exact)?;
            Some(fit.normal.cross(&exact).norm().asin().to_degrees())
        };
        (region.free..region.region_vertices())
            .filter_map(error)
            .fold(0.0, f64::max)
    }

    #[test]
    fn both_orders_are_exact_on_spheres() {
        let shape = sphere_cap(60.0, 1000, Sampling::Irregular { seed: 7 }, 4);
        assert_below!(worst(&SECOND, &shape), 1e-9);
        assert_below!(worst(&THIRD, &shape), 1e-9);
    }

    #[test]
    fn each_order_gains_a_power_of_the_edge_length() {
        let [coarse, fine] = [1000, 16_000].map(|n| catenoid_band(n, Sampling::Regular, 4));
        let second = worst(&SECOND, &coarse) / worst(&SECOND, &fine);
        let third = worst(&THIRD, &coarse) / worst(&THIRD, &fine);
        // Edges of a quarter: 4^2 and 4^3.
        assert!((12.0..24.0).contains(&second), "{second}");
        assert!((48.0..120.0).contains(&third), "{third}");
    }
}
