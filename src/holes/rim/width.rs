//! How much of the mesh the fits look at.
//!
//! The wider they are the less is left of the noise, and the less of the surface's own shape, too. What they are expected to miss it by
//! is told by the fits themselves, without knowing the noise: what is random by the points' distances from them, bias by what
//! polynomials of degree three find beside those of degree two.

use super::band::Band;
use super::fit::Fit;

/// Radii that are tried, in edges.
/// Of 5 cases, half: none changes; double: 1 changes, 1 get another triangulation, +4 % iterations.
const RADII: [f64; 9] = [2.5, 3.5, 5.0, 7.0, 10.0, 14.0, 17.0, 20.0, 28.0];
/// The rings that the widest of them may reach: rings are nearer to each other than an edge is long.
/// Half or double, of 5 cases: none changes.
pub(super) const REACH: usize = 42;
/// Vertices or edges of the loops that are looked at, at most.
/// Half or double, of 5 cases: none changes.
pub(super) const SAMPLES: usize = 256;
/// Noise below this, in edges, is none: it has not folded anything.
/// Half or double, of 3 cases: none changes.
pub(super) const CLEAN: f64 = 0.02;
/// The sphere of a fit is hardly smaller than its window, on average.
/// Of 5 cases, half: 4 change by up to 0.9 edges, 2 get another triangulation, +9 % iterations;
/// double: 4 change by up to 0.5 edges, 2 get another triangulation, +4 % iterations.
const MOST_CURVED: f64 = 1.2;
/// The radius, in edges, from which on noise looks the same at all of them.
/// Half or double, of 5 cases: none changes.
const SETTLED: f64 = 5.0;
/// Growth of the variance over that at the settled radius which is bias and no noise.
/// Of 5 cases, half: 1 changes, 1 get another triangulation; double: none changes.
const GROWTH: f64 = 1.5;

/// The radius of fits, and how far vertices are from them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Width {
    pub(super) radius: f64,
    /// Root mean square.
    pub(super) noise: f64,
    /// The median of its square along the loops over the mean: about 1 where it is everywhere, near 0 where it is a feature of the
    /// surface here or there.
    pub(super) evenness: f64,
}

/// The width at which fits at the loops are expected to be nearest to the surface; none if nothing can be fitted.
pub(super) fn width(band: &Band, edge: f64) -> Option<Width> {
    let on_loops = band.count(1);
    let stride = on_loops.div_ceil(SAMPLES).max(1);
    let samples: Vec<usize> = (0..on_loops).step_by(stride).collect();
    let tried: Vec<Tried> = RADII
        .iter()
        .filter_map(|factor| Tried::new(band, &samples, factor * edge))
        .take_while(|tried| tried.curvature < MOST_CURVED)
        .collect();
    let mut best: Option<(f64, Width)> = None;
    let mut least = f64::INFINITY;
    for tried in &tried {
        let growth = (tried.variance - GROWTH * least).max(0.0);
        let bias = (tried.change - tried.expected).max(0.0);
        let risk = tried.random + bias + growth;
        if tried.radius >= SETTLED * edge {
            least = least.min(tried.variance);
        }
        if risk < best.map_or(f64::INFINITY, |best| best.0) {
            let (radius, noise) = (tried.radius, tried.variance.sqrt());
            let width = Width {
                radius,
                noise,
                evenness: tried.median / tried.variance.max(f64::MIN_POSITIVE),
            };
            best = Some((risk, width));
        }
    }
    best.map(|best| best.1)
}

/// What fits of a radius come to, on average.
struct Tried {
    radius: f64,
    /// Times the radius.
    curvature: f64,
    /// Of the points, and what that makes of the fits' heights.
    variance: f64,
    /// The median of that.
    median: f64,
    random: f64,
    /// The squared difference of polynomials of degree three and two, and what the variance makes of it.
    change: f64,
    expected: f64,
}

impl Tried {
    /// None if there are too few points in most places, or for degree three in one.
    fn new(band: &Band, samples: &[usize], radius: f64) -> Option<Self> {
        let fits: Vec<Fit> = band.fits(samples, radius).into_iter().flatten().collect();
        let mean = |of: fn(&Fit) -> f64| fits.iter().map(of).sum::<f64>() / fits.len() as f64;
        let mut variances: Vec<f64> = fits.iter().map(|fit| fit.variance).collect();
        variances.sort_unstable_by(|&a, &b| a.total_cmp(&b));
        let tried = Self {
            median: variances.get(variances.len() / 2).copied().unwrap_or(0.0),
            radius,
            curvature: mean(|fit| fit.curvature.abs()),
            variance: mean(|fit| fit.variance),
            random: mean(|fit| fit.variance * fit.leverage),
            change: mean(|fit| fit.change[0]),
            expected: mean(|fit| fit.variance * fit.change[1]),
        };
        (2 * fits.len() >= samples.len() && tried.change.is_finite()).then_some(tried)
    }
}
