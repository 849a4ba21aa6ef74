//! Mean curvature along boundary loops as the surface outside has it, and how far it can be relied on.

use std::borrow::Cow;

use nalgebra::Vector3;

use crate::discrete::loop_modes::LoopModes;
use crate::solve::g2::estimator::{Estimated, Estimator};
use crate::solve::g2::outside::Outside;
use crate::solve::g2::virtual_loops::VirtualLoops;

/// Gaps of so many vertices between estimates are bridged: some vertices of irregular meshes have too few samples.
/// Half or double, of 14 cases: none changes.
const LONGEST_GAP: usize = 5;

/// What is known of `H` outside a loop.
#[derive(Debug)]
pub(in crate::solve) struct OutsideCurvature {
    /// `H`, where anything is known.
    pub h: Estimated,
    /// The energies of its error, of both waves of a length together: as [`LoopModes::energies`].
    pub error: Vec<f64>,
    /// Where it is given.
    pub is_given: Vec<bool>,
}

impl OutsideCurvature {
    /// By the estimator that errs least along virtual loops; `None` where neither is anything known nor given. Where none `is_seen`,
    /// estimates are compared with each other alone.
    pub(in crate::solve) fn new(
        outside: &Outside<'_>,
        vertices: &[u32],
        normals: &[Vector3<f64>],
        modes: &LoopModes,
        given: impl Fn(u32) -> Option<f64>,
        is_seen: impl Fn(&Estimated) -> bool,
    ) -> Option<Self> {
        let given: Estimated = vertices.iter().map(|&b| given(b)).collect();
        let is_given = given.iter().any(Option::is_some);
        let is_seen = |h: &Estimated| is_given || is_seen(h);
        let (mut h, error) = match estimated(outside, vertices, normals, modes, is_seen) {
            Some((_, error)) if is_given && total(&error).is_infinite() => nothing(vertices, modes),
            Some(best) => best,
            None if is_given => nothing(vertices, modes),
            None => return None,
        };
        bridge_gaps(&mut h);
        for (h, given) in h.iter_mut().zip(&given).filter(|(_, given)| given.is_some()) {
            *h = *given;
        }
        Some(Self {
            h,
            error,
            is_given: given.iter().map(Option::is_some).collect(),
        })
    }
}

/// Nothing is known, for certain.
fn nothing(vertices: &[u32], modes: &LoopModes) -> (Estimated, Vec<f64>) {
    (vec![None; vertices.len()], vec![0.0; modes.modes.len()])
}

/// The best estimates, and the energies of their error: without end where too little lies outside to tell.
fn estimated(
    outside: &Outside<'_>,
    vertices: &[u32],
    normals: &[Vector3<f64>],
    modes: &LoopModes,
    is_seen: impl Fn(&Estimated) -> bool,
) -> Option<(Estimated, Vec<f64>)> {
    let free = outside.domain.region.free as u32;
    let along: Vec<u32> = vertices.iter().map(|b| free + b).collect();
    let normals = vertices.iter().map(|b| normals[*b as usize]).collect();
    let h = Cow::Borrowed(&*outside.h);
    let around = outside.around((along.clone(), normals), Estimator::MOST_RINGS, h, |_| true);
    let all = Estimator::ALL.map(|estimator| (estimator, estimator.along(&around)));
    let known = all.into_iter().filter(|(_, h)| Estimator::is_known(h));
    let known: Vec<_> = known.collect();
    if !known.iter().any(|(_, h)| is_seen(h)) {
        let known: Vec<_> = known.into_iter().map(|(_, h)| h).collect();
        let scatter = scatter(&known, modes);
        return known.into_iter().next().map(|h| (h, scatter));
    }
    let virtual_loops = VirtualLoops::new(outside, &along, modes);
    let with_error = known.into_iter().map(|(estimator, h)| {
        let error = virtual_loops.error(estimator);
        (h, error.unwrap_or_else(|| vec![f64::INFINITY; modes.modes.len()]))
    });
    with_error.min_by(|a, b| total(&a.1).total_cmp(&total(&b.1)))
}

/// The energies of what estimates differ by from the first, at most.
fn scatter(known: &[Estimated], modes: &LoopModes) -> Vec<f64> {
    let mut most = vec![0.0f64; modes.modes.len()];
    for other in known.iter().skip(1) {
        let pairs = known[0].iter().zip(other);
        let difference: Vec<f64> = pairs
            .map(|(a, b)| a.zip(*b).map_or(0.0, |(a, b)| a - b))
            .collect();
        let energies = LoopModes::energies(&modes.parts(&difference));
        most.iter_mut()
            .zip(energies)
            .for_each(|(most, energy)| *most = most.max(energy));
    }
    most
}

/// The mean square of a function whose waves have these energies.
pub(super) fn total(energies: &[f64]) -> f64 {
    let waves = energies.iter().enumerate();
    // The energy of each pair of waves stands there twice.
    waves.map(|(m, e)| if m == 0 { *e } else { 0.5 * e }).sum()
}

/// Interpolates between the estimates beside short gaps.
fn bridge_gaps(fitted: &mut Estimated) {
    let n = fitted.len();
    let known: Vec<usize> = (0..n).filter(|&k| fitted[k].is_some()).collect();
    for (i, &a) in known.iter().enumerate() {
        let b = known[(i + 1) % known.len()];
        let gap = (b + n - a - 1) % n;
        let (Some(before), Some(after)) = (fitted[a], fitted[b]) else {
            continue;
        };
        for j in 1..=gap * usize::from(gap <= LONGEST_GAP) {
            let t = j as f64 / (gap + 1) as f64;
            fitted[(a + j) % n] = Some(before + t * (after - before));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_gaps_are_bridged_and_long_ones_are_not() {
        let mut fitted = vec![None, Some(1.0), None, None, None, Some(3.0)];
        fitted.extend([None; 6]);
        fitted.push(Some(1.0));
        bridge_gaps(&mut fitted);
        let known = [1.0, 1.0, 1.5, 2.0, 2.5, 3.0].map(Some);
        assert_eq!(fitted[..6], known);
        assert_all!(fitted[6..12].iter(), Option::is_none);
        assert_eq!(fitted[12], Some(1.0));
        let mut one = vec![None, Some(2.0), None];
        bridge_gaps(&mut one);
        assert_all!(one.iter(), |f| *f == Some(2.0));
    }
}
