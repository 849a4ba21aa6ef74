//! How much of the way to the surroundings' mean curvature along a loop can be trusted.
//!
//! Three doubts stand against the mismatch that is to be closed. Around each vertex: what the modes cannot tell of the surroundings' own
//! curvature, as at creases, and a boundary whose normals are far worse than elsewhere. Wave by wave: how uncertain the fit to the
//! surroundings is, by its standard error and by how much it differs from curvatures as the equation has them, and how noisy
//! the surface's own curvature is, as the boundary's normals are. Where the doubt is as
//! large as the mismatch, nothing is left of it: what noise there is would be taken for a jump.

use crate::discrete::loop_modes::LoopModes;
use crate::solve::g2::outside_curvature::OutsideCurvature;

/// Where the surface's own curvature varies from vertex to vertex so many times as much, in squares, as in the mean of the loop, its
/// boundary normals are wrong.
/// Of 14 cases, half: 8 change by up to 0.008 edges; double: 3 change by up to 0.005 edges.
const OUTLYING: f64 = 2.0;
/// Noise of the boundary and its normals is so many times larger, in squares, in the waves of the modes than in the shorter ones.
/// Of 11 cases, half: 6 change by up to 0.3 edges, +4 % iterations; double: 5 change by up to 0.005 edges.
const LONG_WAVES: f64 = 6.0;
/// A doubt counts so many times in squares.
/// Of 14 cases, half: 9 change by up to 2 edges, -2 % iterations; double: 8 change by up to 0.8 edges, -2 % iterations.
const DOUBT_COUNTS: f64 = 8.0;

/// What is left of a mismatch.
#[derive(Debug, Default)]
pub(crate) struct Trusted {
    /// The change of `H` along the loop that can be trusted,
    pub change: Vec<f64>,
    /// and how much that is of what the modes can tell of the mismatch, from 0 to 1.
    pub part: f64,
    /// How uncertain the surroundings' `H` is, root mean square.
    pub uncertainty: f64,
}

impl Trusted {
    /// Of the surface's `H` before and what is wanted in its place; `offset` is how far each vertex lies to the side
    /// of a smooth curve.
    pub(in crate::solve) fn new(
        modes: &LoopModes,
        [before, wanted, offset]: [&[f64]; 3],
        fitted: &OutsideCurvature,
    ) -> Self {
        let mismatch = difference(wanted, before);
        let told = modes.projected(&mismatch);
        let mut rough = unexplained(modes, &less_smooth(modes, wanted), offset);
        for (rough, is_given) in rough.iter_mut().zip(&fitted.is_given) {
            if *is_given {
                *rough = 0.0;
            }
        }
        let own = unexplained(modes, &less_smooth(modes, before), offset);
        let trust = around_vertices(modes, &told, [&rough, &own]);
        let known = fitted.h.iter().map(|h| f64::from(u8::from(h.is_some())));
        let known = smoothed(modes, &known.collect::<Vec<_>>());
        let weighed: Vec<f64> = (0..mismatch.len())
            .map(|k| mismatch[k] * known[k] * trust[k])
            .collect();
        let differences = doubts_of_the_fit(modes, fitted);
        let noise = noise_of_a_wave(modes, &own, fitted);
        let change = modes.sum(&certain_waves(modes, &weighed, noise, &differences));
        let whole = modes.product(&told, &told).max(f64::MIN_POSITIVE);
        let error = modes.product(&fitted.noise.error, &fitted.noise.error);
        // The energy of each pair of waves stands there twice.
        let bias: f64 = differences.iter().enumerate().map(|(m, d)| d / waves(m)).sum();
        Self {
            part: (modes.product(&told, &change) / whole).clamp(0.0, 1.0),
            change,
            uncertainty: (modes.product(&rough, &rough) + error + bias).sqrt(),
        }
    }
}

/// The trust at each vertex, by what the modes cannot tell of the curvatures outside and inside around it.
fn around_vertices(modes: &LoopModes, told: &[f64], [rough, own]: [&[f64]; 2]) -> Vec<f64> {
    let usual = OUTLYING * modes.product(own, own);
    let around = |values: &[f64]| smoothed(modes, &values.iter().map(|v| v * v).collect::<Vec<_>>());
    let (told, rough, own) = (around(told), around(rough), around(own));
    (0..told.len())
        .map(|k| {
            let doubt = rough[k] + (own[k] - usual).max(0.0);
            told[k] / (told[k] + doubt).max(f64::MIN_POSITIVE)
        })
        .collect()
}

/// The energies of what the fit to the surroundings differs from curvatures as the equation has them, without what is noise of the latter.
fn doubts_of_the_fit(modes: &LoopModes, fitted: &OutsideCurvature) -> Vec<f64> {
    let of_trace = if fitted.is_noisy() {
        fitted.trace_noise.of_a_wave(modes)
    } else {
        0.0
    };
    let mut differences = LoopModes::energies(&modes.parts(&fitted.difference));
    for (m, difference) in differences.iter_mut().enumerate() {
        *difference = (*difference - waves(m) * of_trace).max(0.0);
    }
    differences
}

/// The noise of one wave of the mismatch: of the fit, and of the surface's own curvature, of which the modes
/// cannot tell `own`. Who gives a curvature means it.
fn noise_of_a_wave(modes: &LoopModes, own: &[f64], fitted: &OutsideCurvature) -> f64 {
    let is_fitted = fitted.is_given.iter().filter(|is_given| !**is_given);
    let of_surface = if fitted.is_noisy() {
        LONG_WAVES * modes.product(own, own) / own.len() as f64
    } else {
        0.0
    };
    fitted.noise.of_a_wave(modes) + of_surface * is_fitted.count() as f64 / own.len() as f64
}

/// The parts of the modes in a mismatch, less where they are uncertain. Both waves of a length are treated alike: it does not matter
/// where the loop begins.
fn certain_waves(modes: &LoopModes, mismatch: &[f64], noise: f64, differences: &[f64]) -> Vec<f64> {
    let mean = differences.iter().sum::<f64>() / differences.len() as f64;
    let mut parts = modes.parts(mismatch);
    let energies = LoopModes::energies(&parts);
    for (m, (part, energy)) in parts.iter_mut().zip(energies).enumerate() {
        let doubt = waves(m) * noise + differences[m] + mean;
        *part *= (1.0 - (DOUBT_COUNTS * doubt / energy.max(f64::MIN_POSITIVE)).powi(2)).max(0.0);
    }
    parts
}

/// Both waves of a length are one energy.
fn waves(m: usize) -> f64 {
    if m == 0 { 1.0 } else { 2.0 }
}

/// What is left of what the modes cannot tell where it is not in proportion to the offsets around: a boundary that zigzags on a surface
/// with a slope of `H` meets different values of it.
fn unexplained(modes: &LoopModes, rough: &[f64], offset: &[f64]) -> Vec<f64> {
    let products = |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a * b).collect() };
    let both = smoothed(modes, &products(rough, offset));
    let squares = smoothed(modes, &products(offset, offset));
    let slope = both
        .iter()
        .zip(squares)
        .map(|(b, s)| b / s.max(f64::MIN_POSITIVE));
    let explained: Vec<f64> = slope.zip(offset).map(|(slope, o)| slope * o).collect();
    difference(rough, &explained)
}

/// What the modes cannot tell.
fn less_smooth(modes: &LoopModes, values: &[f64]) -> Vec<f64> {
    difference(values, &modes.projected(values))
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// Twice the mean over as many neighbours along the loop to both sides as there are for each mode.
fn smoothed(modes: &LoopModes, values: &[f64]) -> Vec<f64> {
    let around = (values.len() / modes.modes.len()).max(1);
    averaged(&averaged(values, around), around)
}

fn averaged(values: &[f64], around: usize) -> Vec<f64> {
    let n = values.len();
    let around = around.min((n - 1) / 2);
    let mean = |k: usize| {
        let window = (0..=2 * around).map(|j| values[(k + n + j - around) % n]);
        window.sum::<f64>() / (2 * around + 1) as f64
    };
    (0..n).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::g2::outside_curvature::Noise;
    use nalgebra::Vector3;
    use std::f64::consts::TAU;

    const N: usize = 120;

    fn circle() -> LoopModes {
        let at = |k: usize| TAU * k as f64 / N as f64;
        let polygon: Vec<_> = (0..N)
            .map(|k| Vector3::new(at(k).cos(), at(k).sin(), 0.0))
            .collect();
        LoopModes::new(&polygon, 15)
    }

    fn fitted(h: &[f64], error: f64) -> OutsideCurvature {
        OutsideCurvature {
            h: h.iter().map(|h| Some(*h)).collect(),
            noise: Noise {
                error: vec![error; N],
                rings: 4,
            },
            difference: vec![0.0; N],
            trace_noise: none(),
            is_given: vec![false; N],
        }
    }

    fn none() -> Noise {
        Noise {
            error: vec![0.0; N],
            rings: 7,
        }
    }

    fn wave(size: f64) -> Vec<f64> {
        (0..N)
            .map(|k| size * (3.0 * TAU * k as f64 / N as f64).cos())
            .collect()
    }

    #[test]
    fn what_is_certain_is_closed_and_what_is_not_is_left() {
        let (modes, before) = (circle(), vec![-1.0; N]);
        let wanted: Vec<f64> = wave(0.2).iter().map(|w| w - 1.0).collect();
        let of = |error: f64| Trusted::new(&modes, [&before, &wanted, &[0.0; N]], &fitted(&wanted, error));
        let certain = of(1e-4);
        assert_above!(certain.part, 0.99);
        let left = difference(&certain.change, &wave(0.2));
        assert_below!(modes.product(&left, &left).sqrt(), 1e-3);
        assert_contains!(0.2..0.95, &of(0.1).part);
        assert_eq!(of(1.0).part, 0.0);
        assert_near!(of(0.1).uncertainty, 0.1, 1e-3);
    }

    /// The curvatures that the equation has there are another measure of the same: what differs cannot be told.
    #[test]
    fn a_difference_between_two_measures_is_a_doubt_of_its_wave() {
        let (modes, before) = (circle(), vec![-1.0; N]);
        let wanted: Vec<f64> = wave(0.2).iter().map(|w| w - 0.9).collect();
        let mut both = fitted(&wanted, 0.0);
        both.difference = vec![0.1; N];
        let left = Trusted::new(&modes, [&before, &wanted, &[0.0; N]], &both).change;
        let parts = modes.parts(&left);
        assert_below!(parts[0].abs(), 1e-12);
        assert_above!(modes.product(&left, &wave(0.2)), 0.01);
    }

    /// Around a crease the trust is less, far from it as without it.
    #[test]
    fn a_crease_counts_where_it_is() {
        let (modes, before) = (circle(), vec![-1.0; N]);
        let mut wanted = vec![-0.8; N];
        (0..6).for_each(|k| wanted[k] += if k % 2 == 0 { 3.0 } else { -3.0 });
        let change = Trusted::new(&modes, [&before, &wanted, &[0.0; N]], &fitted(&wanted, 0.0)).change;
        assert!(change[3] < 0.5 * change[60] && change[60] > 0.1, "{change:?}");
        let mut given = fitted(&wanted, 0.0);
        given.is_given = vec![true; N];
        assert_above!(
            Trusted::new(&modes, [&before, &wanted, &[0.0; N]], &given).part,
            0.99
        );
    }

    /// A boundary that zigzags on a surface with a slope of `H`.
    #[test]
    fn offsets_of_a_boundary_are_no_roughness() {
        let (modes, before) = (circle(), vec![-1.0; N]);
        let offset: Vec<f64> = (0..N).map(|k| 0.1 * ((5 * k) as f64).sin()).collect();
        let wanted: Vec<f64> = offset.iter().map(|o| -0.9 + 2.0 * o).collect();
        let part =
            |offset: &[f64]| Trusted::new(&modes, [&before, &wanted, offset], &fitted(&wanted, 0.0)).part;
        assert_above!(part(&offset), 0.98);
        assert_below!(part(&[0.0; N]), 0.5);
    }

    #[test]
    fn where_nothing_is_known_nothing_changes() {
        let (modes, before) = (circle(), vec![-1.0; N]);
        let mut fitted = fitted(&before, 0.0);
        fitted.h = vec![None; N];
        let trusted = Trusted::new(&modes, [&before, &before, &[0.0; N]], &fitted);
        assert_eq!(trusted.part, 0.0);
        assert_all!(trusted.change.iter(), |c| *c == 0.0);
    }
}
