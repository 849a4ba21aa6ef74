//! Mean curvature along boundary loops as the surface outside has it.
//!
//! Fits to positions are right to third order; traces of the curvatures of vertices err as those of the equation inside do, in the mean.
//! The most certain one is taken, and both together tell how far it can be relied on.

use super::problem::Domain;
use crate::discrete::boundary_samples::BoundarySamples;
use crate::discrete::mesh_curvature::closed_ring_curvature;
use crate::discrete::one_sided_curvature::OneSided;
use crate::discrete::trace::{Reach, Trace};
use crate::mesh::OutsideNeighbours;
use crate::mesh::outside_neighbours::outside_triangles;
use nalgebra::Vector3;

/// As many fits as this part of a loop has to have, to be compared with others.
pub(super) const MOST_FITS: f64 = 0.9;

/// Gaps of so many vertices between fits are bridged: some vertices of irregular meshes have too few samples.
const LONGEST_GAP: usize = 3;

/// `H` with its standard error at each vertex of a loop, where there are enough samples.
type Fitted = Vec<Option<[f64; 2]>>;

/// What is known of `H` outside a loop.
#[derive(Debug)]
pub(super) struct Surroundings {
    /// `H`, where anything is known.
    pub h: Vec<Option<f64>>,
    /// Its standard errors; 0 where it is given.
    pub error: Vec<f64>,
    /// The fit to positions less the trace.
    pub difference: Vec<f64>,
    /// Where it is given.
    pub is_given: Vec<bool>,
    /// How many edges the samples of the fit reach.
    pub rings: usize,
}

/// The surface outside.
pub(super) struct Outside<'d> {
    pub domain: &'d Domain,
    neighbours: OutsideNeighbours,
    /// Mean curvatures; not a number where there is no closed ring.
    h: Vec<f64>,
}

impl<'d> Outside<'d> {
    /// Of a region.
    pub(super) fn new(domain: &'d Domain) -> Self {
        let positions: Vec<[f64; 3]> = domain.input.iter().map(|p| (*p).into()).collect();
        Self {
            domain,
            neighbours: OutsideNeighbours::new(&domain.region),
            h: closed_ring_curvature(&positions, outside_triangles(&domain.region)),
        }
    }

    /// Of all fits along a loop the most certain one; `None` where neither is anything known nor given.
    pub(super) fn along(
        &self,
        vertices: &[u32],
        normals: &[Vector3<f64>],
        given: impl Fn(u32) -> Option<f64>,
    ) -> Option<Surroundings> {
        let of_kind = |kind: OneSided| {
            let fitted = self.fitted(vertices, normals, kind);
            Some((typical_error(&fitted)?, kind.rings(), fitted))
        };
        let certain = |a: &(f64, usize, Fitted), b: &(f64, usize, Fitted)| a.0.total_cmp(&b.0);
        let fit = OneSided::ALL.into_iter().filter_map(of_kind).min_by(certain);
        let trace = self.traced(vertices, normals);
        let difference = |k: usize| Some(fit.as_ref()?.2[k]?[0] - trace[k]?[0]);
        let differences: Vec<f64> = (0..vertices.len())
            .map(|k| difference(k).unwrap_or(0.0))
            .collect();
        let traced = typical_error(&trace).map(|error| (error, Reach::Wide.rings(), trace));
        let best = fit.into_iter().chain(traced).min_by(certain);
        if best.is_none() && vertices.iter().all(|&b| given(b).is_none()) {
            return None;
        }
        let (_, rings, mut fitted) = best.unwrap_or_else(|| (0.0, 0, vec![None; vertices.len()]));
        bridge_gaps(&mut fitted);
        let mut this = Surroundings {
            h: fitted.iter().map(|h| h.map(|h| h[0])).collect(),
            error: fitted.iter().map(|h| h.map_or(0.0, |h| h[1])).collect(),
            difference: differences,
            is_given: vec![false; vertices.len()],
            rings,
        };
        for (k, &b) in vertices.iter().enumerate() {
            if let Some(h) = given(b) {
                this.h[k] = Some(h);
                this.is_given[k] = true;
                (this.error[k], this.difference[k]) = (0.0, 0.0);
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
        let mut fitted = vec![
            None,
            of(1.0),
            None,
            None,
            None,
            of(3.0),
            None,
            None,
            None,
            None,
            of(1.0),
        ];
        bridge_gaps(&mut fitted);
        let h: Vec<_> = fitted.iter().map(|f| f.map(|f| f[0])).collect();
        let known = [1.0, 1.0, 1.5, 2.0, 2.5, 3.0].map(Some);
        assert_eq!(h[..6], known);
        assert!(h[6..10].iter().all(Option::is_none) && h[10] == Some(1.0));
        let mut one = vec![None, of(2.0), None];
        bridge_gaps(&mut one);
        assert!(one.iter().all(|f| *f == of(2.0)));
    }
}
