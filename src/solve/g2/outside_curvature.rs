//! Mean curvature along boundary loops as the surface outside has it.
//!
//! Fits to positions are right to third order; traces of the curvatures of vertices err as those of the equation inside do, in the mean.
//! The most certain one is taken, and both together tell how far it can be relied on.

use crate::discrete::boundary_samples::BoundarySamples;
use crate::discrete::loop_modes::LoopModes;
use crate::discrete::mesh_curvature::closed_ring_curvature;
use crate::discrete::one_sided_curvature::OneSided;
use crate::discrete::trace::{Reach, Trace};
use crate::mesh::OutsideNeighbours;
use crate::mesh::outside_neighbours::outside_triangles;
use crate::solve::domain::Domain;
use nalgebra::Vector3;

/// As many fits as this part of a loop has to have, to be compared with others.
/// Of 14 cases, half: none changes; double: 8 change by up to 1 edge, -40 % iterations.
pub(in crate::solve) const MOST_FITS: f64 = 0.9;

/// A difference of more than so many times the median is an outlier.
/// Of 14 cases, half: 8 change by up to 0.3 edges, +3 % iterations; double: 4 change by up to 0.1 edges, +4 % iterations.
const DISPUTED: f64 = 6.0;
/// Gaps of so many vertices between fits are bridged: some vertices of irregular meshes have too few samples.
/// Half or double, of 14 cases: none changes.
const LONGEST_GAP: usize = 5;

/// `H` with its standard error at each vertex of a loop, where there are enough samples.
type Fitted = Vec<Option<[f64; 2]>>;

/// What is known of `H` outside a loop.
#[derive(Debug)]
pub(in crate::solve) struct OutsideCurvature {
    /// `H`, where anything is known.
    pub h: Vec<Option<f64>>,
    /// Its noise; none where it is given.
    pub noise: Noise,
    /// The fit to positions less the trace,
    pub difference: Vec<f64>,
    /// and the noise of the trace: so much of the difference speaks of the trace alone.
    pub trace_noise: Noise,
    /// Where it is given.
    pub is_given: Vec<bool>,
}

impl OutsideCurvature {
    /// Wide samples are the most certain ones where there is noise; on smooth meshes narrow ones are.
    pub(in crate::solve) fn is_noisy(&self) -> bool {
        self.noise.rings >= self.trace_noise.rings
    }
}

/// The noise of fits along a loop.
#[derive(Debug, Default)]
pub(in crate::solve) struct Noise {
    /// Standard error at each vertex.
    pub error: Vec<f64>,
    /// How many edges the samples reach.
    pub rings: usize,
}

impl Noise {
    /// The variance that this means for one wave along the loop. Neighbours share most of their samples: noise is in waves longer than
    /// these reach.
    pub(in crate::solve) fn of_a_wave(&self, modes: &LoopModes) -> f64 {
        let shared = (2.0 * self.rings as f64 / self.error.len() as f64).min(1.0);
        shared * modes.product(&self.error, &self.error)
    }
}

/// The surface outside.
pub(in crate::solve) struct Outside<'d> {
    pub domain: &'d Domain,
    neighbours: OutsideNeighbours,
    /// Mean curvatures; not a number where there is no closed ring.
    h: Vec<f64>,
}

impl<'d> Outside<'d> {
    /// Of a region.
    pub(in crate::solve) fn new(domain: &'d Domain) -> Self {
        let positions: Vec<[f64; 3]> = domain.input.iter().map(|p| (*p).into()).collect();
        Self {
            domain,
            neighbours: OutsideNeighbours::new(&domain.region),
            h: closed_ring_curvature(&positions, outside_triangles(&domain.region)),
        }
    }

    /// Of all fits along a loop the most certain one; `None` where neither is anything known nor given.
    pub(in crate::solve) fn along(
        &self,
        vertices: &[u32],
        normals: &[Vector3<f64>],
        given: impl Fn(u32) -> Option<f64>,
    ) -> Option<OutsideCurvature> {
        let of_kind = |kind: OneSided| Estimate::new(kind.rings(), self.fitted(vertices, normals, kind));
        let fits = OneSided::ALL.into_iter().filter_map(of_kind);
        let mut fit = fits.min_by(Estimate::more_certain);
        let mut trace = Estimate::new(Reach::Wide.rings(), self.traced(vertices, normals));
        let mut differences = vec![0.0; vertices.len()];
        let mut trace_noise = Noise {
            error: vec![0.0; vertices.len()],
            rings: Reach::Wide.rings(),
        };
        if let (Some(fit), Some(trace)) = (&mut fit, &mut trace) {
            leave_disputed(fit, trace);
            for (k, (a, b)) in fit.at.iter().zip(&trace.at).enumerate() {
                if let (Some([fitted, _]), Some([traced, error])) = (a, b) {
                    differences[k] = fitted - traced;
                    trace_noise.error[k] = *error;
                }
            }
        }
        let best = fit.into_iter().chain(trace).min_by(Estimate::more_certain);
        if best.is_none() && vertices.iter().all(|&b| given(b).is_none()) {
            return None;
        }
        let mut best = best.unwrap_or_else(|| Estimate {
            error: 0.0,
            rings: 0,
            at: vec![None; vertices.len()],
        });
        bridge_gaps(&mut best.at);
        let mut this = OutsideCurvature {
            h: best.at.iter().map(|h| h.map(|h| h[0])).collect(),
            noise: Noise {
                error: best.at.iter().map(|h| h.map_or(0.0, |h| h[1])).collect(),
                rings: best.rings,
            },
            difference: differences,
            trace_noise,
            is_given: vec![false; vertices.len()],
        };
        for (k, &b) in vertices.iter().enumerate() {
            if let Some(h) = given(b) {
                this.h[k] = Some(h);
                this.is_given[k] = true;
                (this.noise.error[k], this.difference[k], this.trace_noise.error[k]) = (0.0, 0.0, 0.0);
            }
        }
        Some(this)
    }

    /// By fits to positions.
    fn fitted(&self, vertices: &[u32], normals: &[Vector3<f64>], kind: OneSided) -> Fitted {
        let (x, free) = (&self.domain.input, self.domain.region.free);
        let mut edges = Vec::new();
        self.at_each(vertices, kind.rings(), |b, around, reach| {
            edges.clear();
            edges.extend(around.iter().map(|&j| x[j as usize] - x[free + b]));
            let found = kind.fit(&normals[b], &edges, reach)?;
            Some([found.h, found.error])
        })
    }

    /// By the trace of the curvatures of vertices.
    fn traced(&self, vertices: &[u32], normals: &[Vector3<f64>]) -> Fitted {
        let (x, free) = (&self.domain.input, self.domain.region.free);
        self.at_each(vertices, Reach::Wide.rings(), |b, around, reach| {
            let samples = around.iter().zip(reach);
            let known = samples.filter(|(j, _)| self.h[**j as usize].is_finite());
            let edges = known
                .clone()
                .map(|(&j, &reach)| (x[j as usize] - x[free + b], reach));
            let trace = Trace::new(&normals[b], Reach::Wide, edges)?;
            let found = trace.value(known.map(|(&j, _)| self.h[j as usize]));
            found.iter().all(|h| h.is_finite()).then_some(found)
        })
    }

    /// Calls for each vertex of a loop with the vertices within so many edges outside, and how many edges away they are. Where some of them
    /// move, nothing is known.
    fn at_each(
        &self,
        vertices: &[u32],
        rings: usize,
        mut fit: impl FnMut(usize, &[u32], &[u8]) -> Option<[f64; 2]>,
    ) -> Fitted {
        let region = &self.domain.region;
        let centres = vertices.iter().map(|b| region.free as u32 + b);
        let count = self.domain.input.len();
        let samples = BoundarySamples::new(centres, rings, count, |v| self.neighbours.of(v));
        let moves = |j: &u32| {
            region
                .moves_elsewhere
                .get(*j as usize)
                .is_some_and(|moves| *moves)
        };
        let loop_vertices = vertices.iter().enumerate();
        loop_vertices
            .map(|(k, &b)| {
                let (around, reach) = samples.of(k);
                let stands = !around.iter().any(moves);
                stands.then(|| fit(b as usize, around, reach)).flatten()
            })
            .collect()
    }
}

/// Estimates of `H` along a loop.
struct Estimate {
    /// Median of the standard errors.
    error: f64,
    /// How many edges the samples reach.
    rings: usize,
    at: Fitted,
}

impl Estimate {
    /// `None` where there are too few.
    fn new(rings: usize, at: Fitted) -> Option<Self> {
        let error = typical_error(&at)?;
        Some(Self { error, rings, at })
    }

    fn more_certain(&self, other: &Self) -> std::cmp::Ordering {
        self.error.total_cmp(&other.error)
    }
}

/// Where two estimates differ by far more than elsewhere one has met a poor ring: the one that is less certain than usual is left out.
fn leave_disputed(fit: &mut Estimate, trace: &mut Estimate) {
    let pairs = fit.at.iter().zip(&trace.at);
    let difference =
        |(a, b): (&Option<[f64; 2]>, &Option<[f64; 2]>)| Some((a.as_ref()?[0] - b.as_ref()?[0]).abs());
    let differences: Vec<Option<f64>> = pairs.map(difference).collect();
    let mut sizes: Vec<f64> = differences.iter().copied().flatten().collect();
    if sizes.is_empty() {
        return;
    }
    let middle = sizes.len() / 2;
    let most = DISPUTED * *sizes.select_nth_unstable_by(middle, f64::total_cmp).1;
    let is_disputed = |k: &usize| differences[*k].is_some_and(|d| d > most);
    for k in (0..differences.len()).filter(is_disputed) {
        let doubts = [&fit, &trace].map(|e| e.at[k].map_or(0.0, |h| h[1] / e.error.max(f64::MIN_POSITIVE)));
        let least = doubts[0].min(doubts[1]);
        for (estimate, doubt) in [&mut *fit, &mut *trace].into_iter().zip(doubts) {
            if doubt > least || doubt > DISPUTED {
                estimate.at[k] = None;
            }
        }
    }
}

/// Interpolates between the fits beside short gaps.
fn bridge_gaps(fitted: &mut Fitted) {
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
            fitted[(a + j) % n] = Some([0, 1].map(|c| before[c] + t * (after[c] - before[c])));
        }
    }
}

/// The median of the standard errors, where there are enough fits.
fn typical_error(fitted: &Fitted) -> Option<f64> {
    let mut errors: Vec<f64> = fitted.iter().flatten().map(|[_, error]| *error).collect();
    if (errors.len() as f64) < MOST_FITS * fitted.len() as f64 || errors.is_empty() {
        return None;
    }
    let middle = errors.len() / 2;
    Some(*errors.select_nth_unstable_by(middle, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_gaps_are_bridged_and_long_ones_are_not() {
        let of = |h: f64| Some([h, 0.1]);
        let mut fitted = vec![None, of(1.0), None, None, None, of(3.0)];
        fitted.extend([None; 6]);
        fitted.push(of(1.0));
        bridge_gaps(&mut fitted);
        let h: Vec<_> = fitted.iter().map(|f| f.map(|f| f[0])).collect();
        let known = [1.0, 1.0, 1.5, 2.0, 2.5, 3.0].map(Some);
        assert_eq!(h[..6], known);
        assert_all!(h[6..12].iter(), Option::is_none);
        assert_eq!(h[12], Some(1.0));
        let mut one = vec![None, of(2.0), None];
        bridge_gaps(&mut one);
        assert_all!(one.iter(), |f| *f == of(2.0));
    }

    /// A spike in one of two estimates is taken from that one, and from both where neither is certain.
    #[test]
    fn a_spike_is_left_out() {
        let spiked = |error: f64, other: f64| {
            let of = |h: f64, error: f64| Some([h, error]);
            let mut fit: Fitted = (0..20).map(|k| of(1.0 + 0.01 * f64::from(k % 3), 0.1)).collect();
            let mut trace: Fitted = vec![of(1.03, 0.1); 20];
            fit[7] = of(1.5, error);
            trace[7] = of(1.03, other);
            let [mut fit, mut trace] = [fit, trace].map(|at| Estimate::new(4, at).unwrap());
            leave_disputed(&mut fit, &mut trace);
            [fit, trace].map(|e| (0..20).filter(|&k| e.at[k].is_none()).collect::<Vec<_>>())
        };
        assert_eq!(spiked(0.4, 0.1), [vec![7], vec![]]);
        assert_eq!(spiked(0.1, 0.2), [vec![], vec![7]]);
        assert_eq!(spiked(0.8, 0.9), [vec![7], vec![7]]);
    }
}
