//! Mean curvature at a vertex from samples of the surface around it (paper 6.1).
//!
//! A sample is given by its vector `e` from the vertex. Its normal curvature is that of the circle through both
//! points with the vertex's tangent plane, `kappa = 2 <e, n> / |e|^2` (paper (8)). By Euler's theorem
//! `kappa = x0 u^2 + x1 u v + x2 v^2` for the unit tangent direction `(u, v)`, and `H = (x0 + x2) / 2` (paper (10)).
//! All fits here use the equivalent basis `1, u^2 - v^2, 2 u v` of that quadratic form, in which the coefficient of
//! `1` is `H` itself.

use super::ring_edges::{RingEdge, inverse_square};
use super::simd::{Simd, Vec3, dot, minus, normalized, plus, scaled, tangent_basis, unrolled};

/// Ridge on the two anisotropic coefficients, relative to the sum of weights: keeps the fit defined where Lemma 1
/// says that it is not (all directions on two lines), without any switch.
/// Of 131 cases, half: 117 change by up to 5e-5 edges, 2 get another triangulation;
/// double: 117 change by up to 4e-4 edges, 1 get another triangulation.
pub(crate) const RIDGE: f64 = 1e-6;

/// Ridge on the tilt in the gradient-corrected fit, relative to the sum of weights.
/// Of 131 cases, half: 126 change by up to 2 edges, 2 get another triangulation, 1 fails;
/// double: 126 change by up to 2 edges, 3 get another triangulation, +3 % iterations, 1 fails, 1 more succeeds.
pub(crate) const TILT_RIDGE: f64 = 1e-3;

/// Weight of the flap vertices (across the ring's edges) beside the ring's own weight of 1.
/// Of 131 cases, half: 126 change by up to 3 edges, 10 get another triangulation, +4 % iterations, 2 fail;
/// double: 126 change by up to 3 edges, 9 get another triangulation, 1 fails, 1 more succeeds.
pub(crate) const FLAP_WEIGHT: f64 = 0.1;

/// Curvature, normal and quadratic form at one vertex.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Curvature<const L: usize> {
    /// Mean curvature.
    pub h: Simd<L>,
    /// Gaussian curvature.
    pub k: Simd<L>,
    /// The normal with the fitted tilt taken away.
    pub normal: Vec3<L>,
    /// `-dH/dt` under a motion of the vertex along `n`, every `|e|` held (paper 7.2); zero unless asked for.
    pub response: Simd<L>,
}

/// Accumulates a weighted least-squares fit with `N` basis functions; only the lower triangle of the normal
/// equations is kept (paper (11)).
#[derive(Debug, Clone, Copy)]
pub(crate) struct NormalEquations<const L: usize, const N: usize> {
    matrix: [[Simd<L>; N]; N],
    /// The right-hand side.
    pub right: [Simd<L>; N],
    /// The sum of weights.
    pub weight: Simd<L>,
}

impl<const L: usize, const N: usize> NormalEquations<L, N> {
    /// No samples.
    #[inline(always)]
    pub(crate) fn new() -> Self {
        Self {
            matrix: [[Simd::zero(); N]; N],
            right: [Simd::zero(); N],
            weight: Simd::zero(),
        }
    }

    /// One more sample with basis values `phi`, value `kappa` and a weight.
    #[inline(always)]
    pub(crate) fn add(&mut self, phi: &[Simd<L>; N], kappa: Simd<L>, weight: Simd<L>) {
        unrolled!(r in (0..N) => {
            let weighted = phi[r] * weight;
            unrolled!(c in (0..r + 1) => {
                self.matrix[r][c] += weighted * phi[c];
            });
            self.right[r] += weighted * kappa;
        });
        self.weight += weight;
    }

    /// The sample `a` with weight 1 and `b` with weight `weight` in one go: every sum is touched once for both.
    #[inline(always)]
    pub(crate) fn add_two(
        &mut self,
        a: &([Simd<L>; N], Simd<L>),
        b: &([Simd<L>; N], Simd<L>),
        weight: Simd<L>,
    ) {
        unrolled!(r in (0..N) => {
            let weighted = b.0[r] * weight;
            unrolled!(c in (0..r + 1) => {
                self.matrix[r][c] += a.0[r] * a.0[c] + weighted * b.0[c];
            });
            self.right[r] += a.0[r] * a.1 + weighted * b.1;
        });
        self.weight += weight + 1.0;
    }

    /// Adds `ridge` times the sum of weights to the diagonal and factors it.
    #[inline(always)]
    pub(crate) fn cholesky(&self, ridge: &[f64; N]) -> [[Simd<L>; N]; N] {
        self.factor(&ridge.map(Simd::splat))
    }

    /// The same with a ridge for each lane: `M = L D L^T`, with `L` below the diagonal and `1 / D` on it. No pivot of a
    /// positive semidefinite matrix plus a diagonal one is less than its entry in the latter, and rounding may not
    /// make it so: the factor is there for any samples, as long as the ridge is positive beyond the constant function.
    #[inline(always)]
    #[expect(clippy::needless_range_loop, reason = "`c` is a column of one row and a row")]
    pub(crate) fn factor(&self, ridge: &[Simd<L>; N]) -> [[Simd<L>; N]; N] {
        let mut m = self.matrix;
        unrolled!(j in (0..N) => {
            let least = self.weight * ridge[j];
            let pivot = (m[j][j] + least).max(least).max(Simd::splat(f64::MIN_POSITIVE));
            m[j][j] = pivot.recip();
            // From the last row up: a row needs the entries of column j above it before they are scaled. Written out as
            // well, the two inner loops would be 81 bodies each, an eighth of the crate's code before optimization.
            for i in (j + 1..N).rev() {
                let scaled = m[i][j] * m[j][j];
                for c in j + 1..i + 1 {
                    m[i][c] = m[i][c] - scaled * m[c][j];
                }
                m[i][j] = scaled;
            }
        });
        m
    }

    /// The equations of all lanes' samples together.
    #[inline(always)]
    pub(crate) fn sum_of_lanes(&self) -> NormalEquations<1, N> {
        let mut sum = NormalEquations::new();
        unrolled!(r in (0..N) => {
            unrolled!(c in (0..r + 1) => {
                sum.matrix[r][c] = self.matrix[r][c].sum();
            });
            sum.right[r] = self.right[r].sum();
        });
        sum.weight = self.weight.sum();
        sum
    }

    /// The coefficients of the fit.
    #[inline(always)]
    pub(crate) fn solve(&self, ridge: &[f64; N]) -> [Simd<L>; N] {
        back_substitute(&self.cholesky(ridge), self.right)
    }

    /// `z^T M z` of the matrix without ridge.
    pub(crate) fn quadratic_form(&self, z: &[Simd<L>; N]) -> Simd<L> {
        let mut sum = Simd::zero();
        for r in 0..N {
            for c in 0..r {
                sum += z[r] * z[c] * self.matrix[r][c] * 2.0;
            }
            sum += z[r] * z[r] * self.matrix[r][r];
        }
        sum
    }
}

/// Solves `L D L^T y = right` for a factor of [`NormalEquations::factor`].
#[inline(always)]
pub(crate) fn back_substitute<const L: usize, const N: usize>(
    l: &[[Simd<L>; N]; N],
    right: [Simd<L>; N],
) -> [Simd<L>; N] {
    let mut y = right;
    for i in 0..N {
        for k in 0..i {
            y[i] = y[i] - l[i][k] * y[k];
        }
    }
    for i in (0..N).rev() {
        y[i] = y[i] * l[i][i];
        for k in i + 1..N {
            y[i] = y[i] - l[k][i] * y[k];
        }
    }
    y
}

/// The tangent frame at a vertex in which samples are measured.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TangentFrame<const L: usize> {
    n: Vec3<L>,
    b_x: Vec3<L>,
    b_y: Vec3<L>,
}

impl<const L: usize> TangentFrame<L> {
    /// The frame of a unit normal.
    #[inline(always)]
    pub(crate) fn new(n: Vec3<L>) -> Self {
        let (b_x, b_y) = tangent_basis(&n);
        Self { n, b_x, b_y }
    }

    /// Basis values `1, (u^2 - v^2)/d, 2uv/d, 2lu/d, 2lv/d` and the normal curvature `2w/d` of a sample, with
    /// `d = |e|^2`, the whole length and not the projected one.
    #[inline(always)]
    pub(crate) fn sample(&self, e: &Vec3<L>, l: Simd<L>) -> ([Simd<L>; 5], Simd<L>) {
        let ([one, a, b, c, d], kappa) = self.sample_at(e, inverse_square(dot(e, e)));
        ([one, a, b, l * c, l * d], kappa)
    }

    /// The same for `l = 1` and known `1/d`.
    #[inline(always)]
    fn sample_at(&self, e: &Vec3<L>, inverse_square: Simd<L>) -> ([Simd<L>; 5], Simd<L>) {
        let (u, v, w) = (dot(e, &self.b_x), dot(e, &self.b_y), dot(e, &self.n));
        let twice = inverse_square * 2.0;
        let (c, d) = (twice * u, twice * v);
        ([Simd::splat(1.0), (c * u - d * v) * 0.5, c * v, c, d], twice * w)
    }

    /// The normal `n - g_x b_x - g_y b_y`, normalized.
    #[inline(always)]
    pub(crate) fn tilted(&self, g_x: Simd<L>, g_y: Simd<L>) -> Vec3<L> {
        normalized(&minus(
            &self.n,
            &plus(&scaled(&self.b_x, g_x), &scaled(&self.b_y, g_y)),
        ))
    }
}

/// Gradient-corrected Moreton-Sequin fit at a vertex with a closed ring and the approximate normal `n`.
///
/// The normal of a one-ring is wrong by `O(h)` on irregular meshes, and a normal tilted by `g` changes every `kappa`
/// by `2 <g, e> / |e|^2`: an `O(1)` error. Two more unknowns `g` take that tilt out; their ridge is relative to the
/// mean square length of the ring. `ring` has weight 1; `flaps` are further samples with their weights (0 for none).
/// `tilt_ridge` is [`TILT_RIDGE`]; with a far larger one it is plain Moreton-Sequin.
#[inline(always)]
pub(crate) fn gradient_corrected<const L: usize, const RESPONSE: bool>(
    n: &Vec3<L>,
    ring: &[RingEdge<L>],
    flaps: &[(Vec3<L>, Simd<L>)],
    tilt_ridge: f64,
) -> Curvature<L> {
    let frame = TangentFrame::new(*n);
    let mut fit = NormalEquations::<L, 5>::new();
    let mut moved = [Simd::zero(); 5];
    let mut square = Simd::zero();
    for (edge, (flap, weight)) in ring.iter().zip(flaps) {
        square += edge.square;
        let near = frame.sample_at(&edge.edge, edge.inverse_square);
        let inverse_square = inverse_square(dot(flap, flap));
        let far = frame.sample_at(flap, inverse_square);
        fit.add_two(&near, &far, *weight);
        if RESPONSE {
            add_scaled(&mut moved, &near.0, edge.inverse_square * 2.0);
            add_scaled(&mut moved, &far.0, *weight * inverse_square * 2.0);
        }
    }
    let ridge = inverse_square(square) * (tilt_ridge * ring.len() as f64);
    let constant = Simd::splat(RIDGE);
    let factor = fit.factor(&[Simd::zero(), constant, constant, ridge, ridge]);
    let [h, y_1, y_2, g_x, g_y] = back_substitute(&factor, fit.right);
    let tilt = (g_x * g_x + g_y * g_y + 1.0).sqrt().recip();
    Curvature {
        response: if RESPONSE {
            back_substitute(&factor, moved)[0] * tilt
        } else {
            Simd::zero()
        },
        h: h * tilt,
        k: (h * h - y_1 * y_1 - y_2 * y_2) * tilt * tilt,
        normal: frame.tilted(g_x, g_y),
    }
}

#[inline(always)]
fn add_scaled<const L: usize>(sum: &mut [Simd<L>; 5], phi: &[Simd<L>; 5], by: Simd<L>) {
    for (sum, phi) in sum.iter_mut().zip(phi) {
        *sum += *phi * by;
    }
}

/// Moreton-Sequin at a vertex whose normal is known (paper 6.1): a boundary vertex with its prescribed normal, or
/// any vertex in the paper's own scheme. All samples have weight 1; those of 6.2 are among them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MoretonSequin<const L: usize> {
    frame: TangentFrame<L>,
    fit: NormalEquations<L, 3>,
}

impl<const L: usize> MoretonSequin<L> {
    /// No samples yet around the unit normal `n`.
    #[inline(always)]
    pub(crate) fn new(n: Vec3<L>) -> Self {
        Self {
            frame: TangentFrame::new(n),
            fit: NormalEquations::new(),
        }
    }

    /// One more sample; weight 0 for lanes that have none.
    #[inline(always)]
    pub(crate) fn add(&mut self, e: &Vec3<L>, weight: Simd<L>) {
        let ([one, a, b, ..], kappa) = self.frame.sample_at(e, inverse_square(dot(e, e)));
        self.fit.add(&[one, a, b], kappa, weight);
    }

    /// `(H, K)`.
    #[inline(always)]
    pub(crate) fn curvature(&self) -> (Simd<L>, Simd<L>) {
        let y = self.fit.solve(&[0.0, RIDGE, RIDGE]);
        (y[0], y[0] * y[0] - y[1] * y[1] - y[2] * y[2])
    }

    /// `H` of one vertex whose samples are spread over the lanes.
    #[inline(always)]
    pub(crate) fn over_lanes(&self) -> f64 {
        self.fit.sum_of_lanes().solve(&[0.0, RIDGE, RIDGE])[0].0[0]
    }
}

/// [`MoretonSequin`] of some samples: `(H, K)`.
#[inline(always)]
pub(crate) fn moreton_sequin<const L: usize>(
    n: &Vec3<L>,
    samples: impl Iterator<Item = Vec3<L>>,
) -> (Simd<L>, Simd<L>) {
    let mut fit = MoretonSequin::new(*n);
    for e in samples {
        fit.add(&e, Simd::splat(1.0));
    }
    fit.curvature()
}

/// The same, and `-dH/dt` under a motion of the vertex along `n`, samples and every `|e|` held (paper 7.2).
#[inline(always)]
pub(crate) fn moreton_sequin_with_response<const L: usize>(
    n: &Vec3<L>,
    samples: impl Iterator<Item = Vec3<L>>,
) -> (Simd<L>, Simd<L>, Simd<L>) {
    let frame = TangentFrame::new(*n);
    let mut fit = NormalEquations::<L, 3>::new();
    let mut moved = [Simd::zero(); 3];
    for e in samples {
        let inverse_square = inverse_square(dot(&e, &e));
        let ([one, a, b, ..], kappa) = frame.sample_at(&e, inverse_square);
        fit.add(&[one, a, b], kappa, Simd::splat(1.0));
        for (sum, phi) in moved.iter_mut().zip([one, a, b]) {
            *sum += phi * inverse_square * 2.0;
        }
    }
    let factor = fit.cholesky(&[0.0, RIDGE, RIDGE]);
    let y = back_substitute(&factor, fit.right);
    let gauss = y[0] * y[0] - y[1] * y[1] - y[2] * y[2];
    (y[0], gauss, back_substitute(&factor, moved)[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrete::normals::max_normal;
    use crate::discrete::ring_edges::ring_of;
    use crate::discrete::simd::{lane, one};
    use nalgebra::Vector3;

    /// So large that the tilt stays zero: plain Moreton-Sequin, first order on irregular meshes.
    const NO_TILT: f64 = 1e6;

    const RING: [(f64, f64); 6] = [
        (0.1, 1.0),
        (0.9, 0.6),
        (2.2, 1.2),
        (3.0, 0.7),
        (4.1, 1.1),
        (5.5, 0.8),
    ];

    /// Ring and flaps on a graph `z = f(x, y)` around the origin, shrunk by `h`.
    fn graph(f: impl Fn(f64, f64) -> f64, h: f64) -> (Vec<Vec3<1>>, Vec<Vec3<1>>) {
        let point = |phi: f64, r: f64| {
            let (x, y) = (h * r * phi.cos(), h * r * phi.sin());
            one(&Vector3::new(x, y, f(x, y)))
        };
        let ring = RING.iter().map(|&(phi, r)| point(phi, r)).collect();
        let flaps = (0..RING.len()).map(|k| {
            let ((a, r), (b, s)) = (RING[k], RING[(k + 1) % RING.len()]);
            let b = if b < a { b + std::f64::consts::TAU } else { b };
            point((a + b) / 2.0, 0.9 * (r + s))
        });
        (ring, flaps.collect())
    }

    fn fit_with(n: &Vec3<1>, ring: &[Vec3<1>], flaps: &[Vec3<1>], tilt_ridge: f64) -> Curvature<1> {
        let flaps: Vec<_> = flaps.iter().map(|f| (*f, Simd::splat(FLAP_WEIGHT))).collect();
        gradient_corrected::<1, false>(n, &ring_of(ring.iter().copied()), &flaps, tilt_ridge)
    }

    fn fit(ring: &[Vec3<1>], flaps: &[Vec3<1>], tilt_ridge: f64) -> Curvature<1> {
        fit_with(
            &max_normal(&ring_of(ring.iter().copied())),
            ring,
            flaps,
            tilt_ridge,
        )
    }

    #[test]
    fn exact_and_negative_on_a_sphere_with_outward_normals() {
        let sphere = |x: f64, y: f64| (4.0 - x * x - y * y).sqrt() - 2.0;
        let (ring, flaps) = graph(sphere, 0.7);
        for mu in [TILT_RIDGE, NO_TILT] {
            let c = fit(&ring, &flaps, mu);
            assert_near!(c.h.0[0], -0.5, 1e-14);
            assert_near!(c.k.0[0], 0.25, 1e-14);
            assert_below!((lane(&c.normal, 0) - Vector3::z()).norm(), 1e-14);
        }
    }

    #[test]
    fn gradient_corrected_error_falls_with_h_where_plain_stays() {
        // Mean curvature at the origin: (f_xx + f_yy) / 2 = 0.2; cubic terms make ring normals wrong by O(h^2).
        let f = |x: f64, y: f64| 0.5 * x * x - 0.3 * y * y + 0.4 * x * x * x - 0.7 * x * y * y + 0.3 * x * y;
        let error = |h: f64, mu: f64| {
            let (ring, flaps) = graph(f, h);
            (fit(&ring, &flaps, mu).h.0[0] - 0.2).abs()
        };
        assert!(error(1e-3, NO_TILT) > 1e-3, "plain: {}", error(1e-3, NO_TILT));
        let (coarse, fine) = (error(1e-2, TILT_RIDGE), error(1e-3, TILT_RIDGE));
        assert!(fine < 5e-4 && fine < 0.2 * coarse, "{coarse} {fine}");
    }

    #[test]
    fn moreton_sequin_recovers_an_exact_quadratic_form() {
        // Points whose circles have curvature 1 + 0.5 cos 2 phi.
        let samples = RING.map(|(phi, r)| {
            let kappa = 1.0 + 0.5 * (2.0 * phi).cos();
            let angle = kappa * r;
            let (t, z) = (angle.sin() / kappa, (1.0 - angle.cos()) / kappa);
            one(&Vector3::new(t * phi.cos(), t * phi.sin(), z))
        });
        let n = one(&Vector3::z());
        let (h, _) = moreton_sequin(&n, samples.into_iter());
        // The projected direction is used with the whole length, so this is exact only in the limit of small r.
        assert_near!(h.0[0], 1.0, 0.05);
    }

    #[test]
    fn h_changes_sign_with_the_normal() {
        let (ring, flaps) = graph(|x, y| x * x + 0.2 * y * y + 0.1 * x * y, 0.3);
        let up = fit(&ring, &flaps, TILT_RIDGE).h.0[0];
        let n = max_normal(&ring_of(ring.iter().copied())).map(|x| -x);
        let down = fit_with(&n, &ring, &flaps, TILT_RIDGE).h.0[0];
        assert_below!((up + down).abs(), 1e-12 * up.abs());
    }

    #[test]
    fn continuous_along_a_path_that_drags_a_neighbour_across_its_ring() {
        let (mut ring, flaps) = graph(|x, y| 0.5 * x * x - 0.3 * y * y + 0.2 * x * y, 0.5);
        ring.truncate(4);
        let steps = 2000;
        let mut last = None;
        for s in 0..=steps {
            let phi = 0.1 + 2.8 * s as f64 / steps as f64;
            ring[0] = one(&Vector3::new(0.3 * phi.cos(), 0.3 * phi.sin(), 0.05));
            let n = one(&Vector3::z());
            let h = fit_with(&n, &ring, &flaps, TILT_RIDGE).h.0[0];
            if let Some(before) = last {
                let jump: f64 = h - before;
                assert!(jump.abs() < 0.05, "jump of {jump} at step {s}");
            }
            last = Some(h);
        }
    }
}
