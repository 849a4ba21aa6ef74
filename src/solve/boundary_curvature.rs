//! What mean curvature the surface shall have along a boundary loop: that of the surroundings, as far as they can be trusted.
//!
//! At the boundary positions and normals fix two of the three entries of the second fundamental form; the mean curvature `H*` of the
//! surroundings fixes the third. It is fitted to one side with the prescribed normal, and compared with the same fit inside.

use std::sync::Arc;

use nalgebra::Vector3;

use super::problem::Domain;
use crate::discrete::boundary_samples::BoundarySamples;
use crate::discrete::loop_modes::LoopModes;
use crate::discrete::one_sided_curvature::OneSided;
use crate::mesh::OutsideNeighbours;
use crate::mesh::boundary_loops::boundary_loops;

/// The fit inside, that tells how the curvature answers to motions.
pub(super) const INSIDE: OneSided = OneSided::Third;
/// The most modes of a loop.
const MOST_MODES: usize = 32;
/// Loops with fewer vertices stay as they are.
const FEWEST_VERTICES: usize = 8;
/// As many fits as this part of a loop has to have, to be compared with others.
const MOST_FITS: f64 = 0.9;
/// An error counts so many times in squares against the mismatch that is to be closed,
const ERROR_COUNTS: f64 = 4.0;
/// and so what the modes cannot tell of it.
const ROUGHNESS_COUNTS: f64 = 1.0;

/// Continuity of the curvature, as it is asked for.
#[derive(Debug, Clone, Default)]
pub(crate) struct AskedContinuity {
    /// From 0, tangent planes alone, to 1.
    pub blend: f64,
    /// `H` where it is given, by boundary vertex; empty: nowhere.
    pub given: Vec<Option<f64>>,
}

/// What holds along a loop.
#[derive(Debug)]
pub(crate) struct LoopCondition {
    /// Boundary vertices in their order.
    pub vertices: Vec<u32>,
    /// The lowest modes.
    pub modes: LoopModes,
    /// Samples inside, of the fit that tells how the curvature answers.
    pub samples: BoundarySamples,
    /// Where there is something outside.
    pub has_surroundings: Vec<bool>,
    /// `H` of the surroundings; the surface's own where there is none.
    pub surroundings: Vec<f64>,
    /// How far it is trusted, from 0 to 1.
    pub trust: Vec<f64>,
    /// How uncertain it is, root mean square.
    pub uncertainty: f64,
    /// `H` of the tangent-continuous surface, as its equation has it.
    pub before: Vec<f64>,
    /// What `H` shall be.
    pub target: Vec<f64>,
}

impl LoopCondition {
    /// Takes a part of the way from the tangent-continuous surface to the surroundings.
    pub(super) fn aim(&mut self, part: f64) {
        for (k, target) in self.target.iter_mut().enumerate() {
            *target = self.before[k] + part * self.trust[k] * (self.surroundings[k] - self.before[k]);
        }
    }

    /// The jump of `H` of a surface, root mean square and largest, by fits of one side each: what the equation has at the boundary is
    /// smooth only beside it.
    pub(super) fn jump(&self, domain: &Domain, x: &[Vector3<f64>], normals: &[Vector3<f64>]) -> [f64; 2] {
        let inside = Side::new(&self.vertices, domain, x, normals, (INSIDE, &self.samples));
        let pairs = inside
            .h
            .iter()
            .zip(&self.surroundings)
            .zip(&self.has_surroundings);
        let jumps: Vec<f64> = pairs
            .map(|((h, outside), is_there)| h.filter(|_| *is_there).map_or(0.0, |h| h[0] - outside))
            .collect();
        let largest = jumps.iter().fold(0.0f64, |m, j| m.max(j.abs()));
        [self.modes.product(&jumps, &jumps).sqrt(), largest]
    }

    /// The mean of the trust along the loop.
    pub(super) fn mean_trust(&self) -> f64 {
        self.modes.product(&self.trust, &vec![1.0; self.trust.len()])
    }
}

/// `H` of a loop on one side, with its standard error.
struct Side {
    h: Vec<Option<[f64; 2]>>,
}

impl Side {
    fn new(
        vertices: &[u32],
        domain: &Domain,
        x: &[Vector3<f64>],
        normals: &[Vector3<f64>],
        (fit, samples): (OneSided, &BoundarySamples),
    ) -> Self {
        let (free, moves) = (domain.region.free, &domain.region.moves_elsewhere);
        let (mut edges, mut response) = (Vec::new(), Vec::new());
        let at = |(k, &b): (usize, &u32)| {
            let (around, reach) = samples.of(k);
            if !moves.is_empty() && around.iter().any(|&j| moves[j as usize]) {
                return None;
            }
            let b = b as usize;
            samples.edges(k, x, &x[free + b], &mut edges);
            let found = fit.fit(&normals[b], &edges, reach, &mut response)?;
            Some([found.h, found.error])
        };
        Self {
            h: vertices.iter().enumerate().map(at).collect(),
        }
    }

    /// The median of the standard errors, where there are enough fits.
    fn error(&self) -> Option<f64> {
        let mut errors: Vec<f64> = self.h.iter().flatten().map(|[_, error]| *error).collect();
        if (errors.len() as f64) < MOST_FITS * self.h.len() as f64 || errors.is_empty() {
            return None;
        }
        let middle = errors.len() / 2;
        Some(*errors.select_nth_unstable_by(middle, f64::total_cmp).1)
    }
}

/// The conditions along all loops of the tangent-continuous surface `x` with mean curvatures `h` where there is something to continue.
pub(super) fn loop_conditions(
    domain: &Arc<Domain>,
    normals: &[Vector3<f64>],
    (x, h): (&[Vector3<f64>], &[f64]),
    asked: &AskedContinuity,
) -> Vec<LoopCondition> {
    let outside = OutsideNeighbours::new(&domain.region);
    let loops = boundary_loops(&domain.region, &domain.rings);
    let long = loops.into_iter().filter(|along| along.len() >= FEWEST_VERTICES);
    long.filter_map(|along| loop_condition(along, domain, &outside, normals, (x, h), asked))
        .collect()
}

fn loop_condition(
    vertices: Vec<u32>,
    domain: &Domain,
    outside: &OutsideNeighbours,
    normals: &[Vector3<f64>],
    (x, h): (&[Vector3<f64>], &[f64]),
    asked: &AskedContinuity,
) -> Option<LoopCondition> {
    let free = domain.region.free as u32;
    let centres = || vertices.iter().map(|b| free + b);
    let count = domain.input.len();
    let fitted = OneSided::ALL.into_iter().filter_map(|fit| {
        let samples = BoundarySamples::new(centres(), fit.rings(), count, |v| outside.of(v));
        let side = Side::new(&vertices, domain, &domain.input, normals, (fit, &samples));
        Some((side.error()?, fit, side))
    });
    let best = fitted.min_by(|a, b| a.0.total_cmp(&b.0));
    let given = |b: u32| asked.given.get(b as usize).copied().flatten();
    let mut surroundings = match best {
        Some((_, _, side)) => side.h,
        None if vertices.iter().any(|&b| given(b).is_some()) => vec![None; vertices.len()],
        None => return None,
    };
    for (h, &b) in surroundings.iter_mut().zip(&vertices) {
        *h = given(b).map(|h| [h, 0.0]).or(*h);
    }
    let polygon: Vec<_> = centres().map(|v| x[v as usize]).collect();
    let most = (vertices.len() / (2 * INSIDE.rings())).clamp(1, MOST_MODES);
    let modes = LoopModes::new(&polygon, most - (most + 1) % 2);
    let before: Vec<f64> = centres().map(|v| h[v as usize]).collect();
    let (trust, uncertainty) = trust(&before, &surroundings, &modes);
    let known = surroundings.iter().zip(&before);
    Some(LoopCondition {
        samples: BoundarySamples::new(centres(), INSIDE.rings(), x.len(), |v| {
            domain.rings.neighbours(v as usize)
        }),
        has_surroundings: surroundings.iter().map(Option::is_some).collect(),
        surroundings: known.map(|(h, before)| h.map_or(*before, |h| h[0])).collect(),
        target: before.clone(),
        vertices,
        modes,
        trust,
        uncertainty,
        before,
    })
}

/// How far the surroundings are to be trusted: by the mismatch that is to be closed, against the standard error of the fit and what
/// the modes cannot tell of the surroundings' own curvature, all around each vertex; and that doubt, root mean square along the loop.
fn trust(before: &[f64], surroundings: &[Option<[f64; 2]>], modes: &LoopModes) -> (Vec<f64>, f64) {
    let there = |missing: &dyn Fn(f64) -> f64, value: &dyn Fn(f64, [f64; 2]) -> f64| -> Vec<f64> {
        let vertices = surroundings.iter().zip(before);
        vertices
            .map(|(h, before)| h.map_or(missing(*before), |h| value(*before, h)))
            .collect()
    };
    let around = (before.len() / modes.modes.len()).max(1);
    let square = |values: Vec<f64>| averaged(&averaged(&values, around), around);
    let less_smooth = |values: &[f64]| -> Vec<f64> {
        let smooth = modes.projected(values);
        values.iter().zip(smooth).map(|(v, s)| (v - s).powi(2)).collect()
    };
    let mismatch = there(&|_| 0.0, &|before, [h, _]| h - before);
    let curvature = there(&|before| before, &|_, [h, _]| h);
    let error = square(there(&|_| 0.0, &|_, [_, error]| error * error));
    let rough = square(less_smooth(&curvature));
    let wanted = square(modes.projected(&mismatch).iter().map(|s| s * s).collect());
    let known = square(there(&|_| 0.0, &|_, _| 1.0));
    let trust = (0..before.len()).map(|k| {
        let doubt = ERROR_COUNTS * error[k] + ROUGHNESS_COUNTS * rough[k];
        known[k] * wanted[k] / (wanted[k] + doubt).max(f64::MIN_POSITIVE)
    });
    let sum: f64 = error.iter().chain(&rough).sum();
    (trust.collect(), (sum / before.len() as f64).sqrt())
}

/// The mean over so many neighbours along the loop to both sides.
fn averaged(values: &[f64], around: usize) -> Vec<f64> {
    let n = values.len();
    let around = around.min((n - 1) / 2);
    let mean = |k: usize| {
        let window = (0..=2 * around).map(|j| values[(k + n + j - around) % n]);
        window.sum::<f64>() / (2 * around + 1) as f64
    };
    (0..n).map(mean).collect()
}
