//! How much of the way to the surroundings' mean curvature along a loop can be trusted: each wave of the mismatch is drawn towards nothing
//! by the part that error makes of its energy.

use crate::discrete::loop_modes::LoopModes;
use crate::solve::g2::estimator::Estimated;
use crate::solve::g2::outside_curvature::{OutsideCurvature, total};

/// An error counts so many times in squares: it is known from few waves only. Errors with G2 over those without, of 80 holes and regions on exact
/// surfaces and 72 in scans, geometric means, and the worst in scans: .907, .982, 1.00. Half: .879, .970, 1.09; double: .940, .983, 1.00. Of four
/// other seeds the worst is 1.13, and at 5 it is 1.73.
const DOUBT: f64 = 7.0;
/// Unasked, curvature is continued where so much of the mismatch is told from the error.
/// Of the same cases: .899, .984; half: .863, .983; .9: .917, .984.
const CERTAIN: f64 = 0.5;
/// And the change of curvature times the length of the loop, an angle in radians, is as large: smaller ones move the surface by less than the
/// discretization does. Half, of the same cases: .899, .984, but the far tail of a bump on a coarse sphere counts as curvature, .056 of its
/// height are left in place of .021; double: .917, .984. At a quarter 16 wide bumps on exact surfaces are left at 1.15 of the best ball's
/// error in place of 1.22, by one on a cone.
const SEEN: f64 = 0.04;

/// What is left of a mismatch.
#[derive(Debug, Default)]
pub(crate) struct Trusted {
    /// The change of `H` along the loop that can be trusted,
    pub change: Vec<f64>,
    /// and how much that is of what the modes can tell of the mismatch, from 0 to 1.
    pub part: f64,
    /// A mismatch below this, root mean square, cannot be told from the error of the surroundings' `H`.
    pub uncertainty: f64,
}

impl Trusted {
    /// Of the surface's `H` before and that of the surroundings. Who gives a curvature means it.
    pub(in crate::solve) fn new(modes: &LoopModes, before: &[f64], outside: &OutsideCurvature) -> Self {
        let told = modes.parts(&mismatch(before, &outside.h));
        let is_estimated = outside.is_given.iter().map(|is_given| !is_given);
        let estimated = is_estimated.filter(|is| *is).count() as f64 / before.len() as f64;
        let doubt = |error: &f64| {
            if estimated > 0.0 {
                DOUBT * estimated * error
            } else {
                0.0
            }
        };
        let doubt: Vec<f64> = outside.error.iter().map(doubt).collect();
        let energies = LoopModes::energies(&told);
        // Both waves of a length are treated alike: it does not matter where the loop begins.
        let left = doubt.iter().zip(energies);
        let left = left.map(|(doubt, energy)| (1.0 - doubt / energy.max(f64::MIN_POSITIVE)).max(0.0));
        let parts: Vec<f64> = told.iter().zip(left).map(|(part, left)| left * part).collect();
        let [whole, taken] = [&told, &parts].map(|of| told.iter().zip(of).map(|(a, b)| a * b).sum::<f64>());
        Self {
            change: modes.sum(&parts),
            part: taken / whole.max(f64::MIN_POSITIVE),
            uncertainty: total(&doubt).sqrt(),
        }
    }
}

/// What estimates differ by from the surface's own `H`.
fn mismatch(before: &[f64], h: &Estimated) -> Vec<f64> {
    let known = h.iter().zip(before);
    known.map(|(h, before)| h.map_or(0.0, |h| h - before)).collect()
}

/// Whether a change is worth the way along a loop of this length.
fn is_worth(change: &[f64], length: f64) -> bool {
    let square = change.iter().map(|c| c * c).sum::<f64>() / change.len() as f64;
    square.sqrt() * length >= SEEN
}

/// Whether it could be if these estimates were certain.
pub(super) fn is_seen(modes: &LoopModes, before: &[f64], h: &Estimated, length: f64) -> bool {
    is_worth(&modes.sum(&modes.parts(&mismatch(before, h))), length)
}

impl Trusted {
    /// Whether most of the mismatch is told from the error, along a loop of this length, and it is worth the way.
    pub(in crate::solve) fn is_certain(&self, length: f64) -> bool {
        self.part >= CERTAIN && is_worth(&self.change, length)
    }

    /// Nothing is to be changed.
    pub(in crate::solve) fn leave(&mut self) {
        self.change.fill(0.0);
        self.part = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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

    /// Of this curvature, with so much error in each wave.
    fn outside(h: &[f64], error: f64) -> OutsideCurvature {
        OutsideCurvature {
            h: h.iter().map(|h| Some(*h)).collect(),
            error: (0..15)
                .map(|m| {
                    if m == 0 {
                        error * error
                    } else {
                        2.0 * error * error
                    }
                })
                .collect(),
            is_given: vec![false; N],
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
        let of = |error: f64| Trusted::new(&modes, &before, &outside(&wanted, error));
        let certain = of(1e-4);
        assert_above!(certain.part, 0.999);
        for (change, wave) in certain.change.iter().zip(wave(0.2)) {
            assert_near!(*change, wave, 1e-3);
        }
        assert_near!(of(0.01).part, 1.0 - DOUBT * 2e-4 / 0.02, 1e-3);
        assert_eq!(of(1.0).part, 0.0);
        assert_near!(of(0.1).uncertainty, 0.1 * (DOUBT * 15.0).sqrt(), 1e-12);
    }

    /// The error of one wave takes nothing of another one, and who gives a curvature means it.
    #[test]
    fn each_wave_has_its_own_error() {
        let (modes, before) = (circle(), vec![-1.0; N]);
        let wanted: Vec<f64> = wave(0.2).iter().map(|w| w - 0.9).collect();
        let mut uncertain = outside(&wanted, 0.0);
        uncertain.error[0] = 1.0;
        let parts = |of: &OutsideCurvature| modes.parts(&Trusted::new(&modes, &before, of).change);
        assert_near!(parts(&uncertain)[0], 0.0, 1e-12);
        assert_near!(parts(&uncertain)[5].abs(), 0.2 / 2f64.sqrt(), 1e-3);
        uncertain.is_given = vec![true; N];
        assert_near!(parts(&uncertain)[0], 0.1, 1e-12);
    }

    #[test]
    fn where_nothing_is_known_nothing_changes() {
        let (modes, before) = (circle(), vec![-1.0; N]);
        let mut nothing = outside(&before, 0.0);
        nothing.h = vec![None; N];
        let trusted = Trusted::new(&modes, &before, &nothing);
        assert_eq!(trusted.part, 0.0);
        assert_all!(trusted.change.iter(), |c| *c == 0.0);
    }
}
