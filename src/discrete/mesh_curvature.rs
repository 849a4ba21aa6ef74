//! Mean curvature at every vertex of a mesh, without a region: to look at a surface, or to show it.

use fairmesh_linear::interrupt::is_stopped;
use fairmesh_linear::parallel;
use nalgebra::Vector3;

use super::curvature::{FLAP_WEIGHT, NormalEquations, RIDGE, TILT_RIDGE, TangentFrame};
use super::outside_fit::root_mean_square;
use super::simd::{Simd, Vec3, cross, normalized, one, plus};
use super::single_ring::SingleRing;
use crate::mesh::input;
use crate::mesh::rows::Rows;
use crate::support::error::Error;

/// How often the fit at a boundary vertex is made.
/// Of 6 cases, half: 2 change by up to 7e-4 edges; double: 1 changes by up to 4e-6 edges.
const BOUNDARY_PASSES: usize = 5;

/// [`crate::mean_curvature`], on the threads of the pool that it is called in.
pub(crate) fn mean_curvature(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Vec<f64>, Error> {
    input::check(positions.len(), triangles)?;
    input::check_finite(positions, triangles)?;
    let fans = VertexTriangles::new(positions.len(), triangles.iter().copied());
    let runs = parallel::runs(positions.len(), 256);
    Ok(parallel::map(runs, |_, run| {
        let mut work = RingWorkspace::default();
        let value = |v| match is_stopped() {
            // Nobody looks at it any more.
            true => f64::NAN,
            false => fans.curvature(positions, v, &mut work),
        };
        run.map(value).collect::<Vec<_>>()
    })
    .concat())
}

/// Mean curvature at the vertices with a closed ring of these triangles; not a number elsewhere.
pub(crate) fn closed_ring_curvature(
    positions: &[[f64; 3]],
    triangles: impl Iterator<Item = [u32; 3]> + Clone,
) -> Vec<f64> {
    let fans = VertexTriangles::new(positions.len(), triangles);
    let mut work = RingWorkspace::default();
    let at = |v: usize| {
        let is_closed = !fans.of(v as u32).is_empty() && fans.walk(v as u32, &mut work.walked);
        if is_closed {
            fans.ring_curvature(positions, v, &mut work)
        } else {
            f64::NAN
        }
    };
    (0..positions.len()).map(at).collect()
}

/// Per vertex `v` its triangles `(v, a, b)` as `[a, b]`, by `a`.
struct VertexTriangles(Rows<[u32; 2]>);

/// Room for one ring.
#[derive(Default)]
struct RingWorkspace {
    ring: SingleRing,
    samples: Vec<(Vec3<1>, Simd<1>)>,
    walked: Vec<[u32; 2]>,
    near: Vec<u32>,
}

impl VertexTriangles {
    fn new(vertices: usize, triangles: impl Iterator<Item = [u32; 3]> + Clone) -> Self {
        let corners = triangles.flat_map(|[a, b, c]| [(a, [b, c]), (b, [c, a]), (c, [a, b])]);
        let mut fans = Rows::collect(vertices, corners);
        (0..vertices).for_each(|v| fans.row_mut(v).sort_unstable());
        Self(fans)
    }

    fn of(&self, v: u32) -> &[[u32; 2]] {
        self.0.row(v as usize)
    }

    /// The third vertex of the triangle with the directed edge from `v` to `a`.
    fn apex(&self, v: u32, a: u32) -> Option<u32> {
        let fan = self.of(v);
        let at = fan.partition_point(|e| e[0] < a);
        fan.get(at).filter(|e| e[0] == a).map(|e| e[1])
    }

    /// The triangles of `v` in order; whether they are one closed ring.
    fn walk(&self, v: u32, walked: &mut Vec<[u32; 2]>) -> bool {
        let fan = self.of(v);
        walked.clear();
        let mut at = fan.first().map_or(0, |e| e[0]);
        while walked.len() < fan.len() {
            let Some(b) = self.apex(v, at) else { break };
            walked.push([at, b]);
            at = b;
        }
        walked.len() == fan.len() && at == fan[0][0] && !repeats(fan)
    }

    fn curvature(&self, positions: &[[f64; 3]], v: usize, work: &mut RingWorkspace) -> f64 {
        if self.of(v as u32).is_empty() {
            return f64::NAN;
        }
        let q = Vector3::from(positions[v]);
        let from = |w: u32| one(&(Vector3::from(positions[w as usize]) - q));
        if !self.walk(v as u32, &mut work.walked) {
            return self.boundary_curvature(v as u32, from, work);
        }
        self.ring_curvature(positions, v, work)
    }

    /// That of the ring walked last, which is closed.
    fn ring_curvature(&self, positions: &[[f64; 3]], v: usize, work: &mut RingWorkspace) -> f64 {
        let q = Vector3::from(positions[v]);
        let from = |w: u32| one(&(Vector3::from(positions[w as usize]) - q));
        work.ring.fill(work.walked.iter().map(|&[a, b]| {
            let flap = self.apex(b, a).filter(|&f| f as usize != v);
            (from(a), flap.map(&from))
        }));
        work.ring.fit(TILT_RIDGE).h.0[0]
    }

    /// The same fit from one side, to the ring with weight 1 and to all of the second ring as to flaps: a vertex of two
    /// triangles has too few of them. Repeated, because the first normal is off by more than a closed ring's and the
    /// ridge holds back a part of what has to be taken out.
    fn boundary_curvature(&self, v: u32, from: impl Fn(u32) -> Vec3<1>, work: &mut RingWorkspace) -> f64 {
        let near = &mut work.near;
        near.clear();
        near.extend(self.of(v).iter().flatten());
        near.sort_unstable();
        near.dedup();
        let ring = near.len();
        for k in 0..ring {
            near.extend(self.of(near[k]).iter().flatten());
        }
        near[ring..].sort_unstable();
        let (first, second) = near.split_at(ring);
        let repeated = |k: usize| k > 0 && second[k - 1] == second[k];
        let beyond = (0..second.len()).filter(|&k| {
            let w = second[k];
            !repeated(k) && w != v && first.binary_search(&w).is_err()
        });
        let samples = &mut work.samples;
        samples.clear();
        samples.extend(first.iter().map(|&w| (from(w), Simd::splat(1.0))));
        samples.extend(beyond.map(|k| (from(second[k]), Simd::splat(FLAP_WEIGHT))));
        let mut sum = [Simd::zero(); 3];
        for &[a, b] in self.of(v) {
            sum = plus(&sum, &cross(&from(a), &from(b)));
        }
        let l = Simd::splat(root_mean_square(samples[..ring].iter().map(|(e, _)| e)));
        let (mut n, mut h) = (normalized(&sum), 0.0);
        for _ in 0..BOUNDARY_PASSES {
            let frame = TangentFrame::new(n);
            let mut fit = NormalEquations::<1, 5>::new();
            for (e, weight) in samples.iter() {
                let (phi, kappa) = frame.sample(e, l);
                fit.add(&phi, kappa, *weight);
            }
            let y = fit.solve(&[0.0, RIDGE, RIDGE, TILT_RIDGE, TILT_RIDGE]);
            let (g_x, g_y) = (l * y[3], l * y[4]);
            n = frame.tilted(g_x, g_y);
            h = (y[0] / (g_x * g_x + g_y * g_y + 1.0).sqrt()).0[0];
        }
        h
    }
}

/// Whether two triangles of a vertex begin with the same edge.
fn repeats(fan: &[[u32; 2]]) -> bool {
    fan.windows(2).any(|w| w[0][0] == w[1][0])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sheet `f(u, v)` over [-1, 1]^2 with `n` edges a side, the diagonals in turn this way and that.
    fn sheet(n: usize, f: impl Fn(f64, f64) -> [f64; 3]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let at = |k: usize| 2.0 * k as f64 / n as f64 - 1.0;
        let wiggle = |i: usize, j: usize| 0.3 / n as f64 * ((3 * i + 5 * j) as f64).sin();
        let grid = (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j)));
        let positions = grid.map(|(i, j)| f(at(i) + wiggle(i, j), at(j) + wiggle(j, i)));
        let mut triangles = Vec::new();
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let v = |i: usize, j: usize| (i * (n + 1) + j) as u32;
            let [a, b, c, d] = [v(i, j), v(i + 1, j), v(i + 1, j + 1), v(i, j + 1)];
            triangles.extend(if (i + j) % 2 == 0 {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, b, d], [b, c, d]]
            });
        }
        (positions.collect(), triangles)
    }

    /// Largest errors inside and on the boundary.
    fn errors(n: usize, f: impl Fn(f64, f64) -> [f64; 3], exact: f64) -> [f64; 2] {
        let (positions, triangles) = sheet(n, f);
        let h = mean_curvature(&positions, &triangles).unwrap();
        let mut worst = [0.0f64; 2];
        for (k, h) in h.into_iter().enumerate() {
            let inner = |x: usize| x > 0 && x < n;
            if !inner(k / (n + 1)) && !inner(k % (n + 1)) {
                // A corner with a single triangle.
                continue;
            }
            let side = usize::from(!(inner(k / (n + 1)) && inner(k % (n + 1))));
            worst[side] = worst[side].max((h - exact).abs());
        }
        worst
    }

    #[test]
    fn spheres_are_exact_inside_and_cylinders_converge() {
        let sphere = |u: f64, v: f64| {
            let z = (4.0 - u * u - v * v).sqrt();
            [u, v, z]
        };
        let cylinder = |u: f64, v: f64| [u.sin(), v, u.cos()];
        let [inside, boundary] = errors(12, sphere, -0.5);
        assert!(inside < 1e-12 && boundary < 1e-3, "{inside:e} {boundary:e}");
        let (coarse, fine) = (errors(12, cylinder, -0.5), errors(48, cylinder, -0.5));
        assert!(fine[0] < 2e-3 && fine[0] < 0.3 * coarse[0], "{coarse:?} {fine:?}");
        assert!(fine[1] < 0.05 && fine[1] < 0.5 * coarse[1], "{coarse:?} {fine:?}");
    }

    #[test]
    fn sign_and_scale() {
        let (positions, mut triangles) = sheet(6, |u, v| [u, v, 0.3 * u * u + 0.2 * v * v * v]);
        let h = mean_curvature(&positions, &triangles).unwrap();
        let large: Vec<[f64; 3]> = positions.iter().map(|p| p.map(|x| 1024.0 * x)).collect();
        let scaled = mean_curvature(&large, &triangles).unwrap();
        assert_all!(h.iter().zip(&scaled), |(a, b)| *a == 1024.0 * b);
        triangles.iter_mut().for_each(|t| t.swap(0, 1));
        let turned = mean_curvature(&positions, &triangles).unwrap();
        assert_all!(h.iter().zip(&turned), |(a, b)| (a + b).abs() < 1e-9);
    }

    #[test]
    fn odd_meshes() {
        assert!(mean_curvature(&[[0.0; 3]], &[]).unwrap()[0].is_nan());
        let one = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        // A lone triangle, a repeated one, three on an edge, one without area.
        for triangles in [
            vec![[0, 1, 2]],
            vec![[0, 1, 2], [0, 1, 2]],
            vec![[0, 1, 2], [0, 1, 3], [1, 0, 3]],
            vec![[0, 0, 1]],
        ] {
            mean_curvature(&one, &triangles).unwrap();
        }
        let missing = mean_curvature(&one, &[[0, 1, 2], [0, 1, 9]]).unwrap_err();
        assert_eq!(
            missing,
            Error::IndexOutOfRange {
                triangle: 1,
                index: 9,
                vertex_count: 4
            }
        );
        let nan = mean_curvature(&[[0.0; 3], [f64::NAN; 3], [1.0; 3]], &[[0, 1, 2]]).unwrap_err();
        assert_eq!(nan, Error::NotFinite { vertex: 1 });
    }
}
