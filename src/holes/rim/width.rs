//! How much of the mesh the fits look at.
//!
//! The wider they are the less is left of the noise, and the less of the surface's own shape, too. What they are expected to miss it by
//! is told by the fits themselves, without knowing the noise: what is random by the points' distances from them, bias by what
//! polynomials of degree three find beside those of degree two. Noise that neighbours have in common, as in the steps of voxels,
//! shows in wide fits only, which then are the better ones all the same.

use super::band::Band;
use super::fit::Fit;

/// Radii that are tried, in edges.
const RADII: [f64; 8] = [2.5, 3.5, 5.0, 7.0, 10.0, 14.0, 20.0, 28.0];
/// The rings that the widest of them may reach: rings are nearer to each other than an edge is long.
pub(super) const REACH: usize = 42;
/// Vertices of the loops that they are tried at, at most.
const SAMPLES: usize = 256;
/// The sphere of a fit is no smaller than its window, on average.
const MOST_CURVED: f64 = 1.0;
/// From this radius on no noise grows any more: if the variance grows by more than this part, that is bias.
const SETTLED: f64 = 5.0;
const GROWTH: f64 = 1.1;

/// The radius of fits, and how far vertices are from them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Width {
    pub(super) radius: f64,
    /// Root mean square.
    pub(super) noise: f64,
}

/// The width at which fits at the loops are expected to be nearest to the surface; none if nothing can be fitted.
pub(super) fn width(band: &Band, edge: f64) -> Option<Width> {
    let on_loops = band.count(1);
    let stride = on_loops.div_ceil(SAMPLES).max(1);
    let samples: Vec<usize> = (0..on_loops).step_by(stride).collect();
    let mut best: Option<(f64, Width)> = None;
    let mut least = f64::INFINITY;
    for radius in RADII.map(|factor| factor * edge) {
        let fits: Vec<Fit> = band.fits(&samples, radius).into_iter().flatten().collect();
        if fits.is_empty() || 2 * fits.len() < samples.len() {
            continue;
        }
        let mean = |of: fn(&Fit) -> f64| fits.iter().map(of).sum::<f64>() / fits.len() as f64;
        if mean(|fit| fit.curvature.abs()) > MOST_CURVED {
            break;
        }
        let variance = mean(|fit| fit.variance);
        let expected = mean(|fit| fit.variance * fit.change[1]);
        let growth = (variance - GROWTH * least).max(0.0);
        let risk = mean(|fit| fit.variance * fit.leverage)
            + growth
            + (mean(|fit| fit.change[0]) - expected).max(0.0);
        if radius >= SETTLED * edge {
            least = least.min(variance);
        }
        let noise = variance.sqrt();
        // Infinite, if there were too few points for degree three somewhere.
        if risk < best.map_or(f64::INFINITY, |best| best.0) {
            best = Some((risk, Width { radius, noise }));
        }
    }
    best.map(|best| best.1)
}
