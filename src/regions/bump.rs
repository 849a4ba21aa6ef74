//! The extent of a bump or a dent: the least region whose fair surface stays what it is when the region grows.
//!
//! Regions around the seed are faired, ever larger ones. As long as more of the bump comes into them, the fair surface lies ever deeper beneath
//! it; once all of it is in, the same volume spreads over ever more area. From there on the region grows while the fair surface agrees better
//! with that of the next larger region and with what surrounds it: until the bump's tails are in, and no further, as what is around is no
//! fair surface either. This is done twice: around the seed, and around what stands out then, for bumps that are not round or not
//! where the seed is. What is found grows on while surfaces agree better that continue curvature, too.

use std::f64::consts::PI;
use std::ops::RangeInclusive;

use super::geodesic;
use super::growth::{Candidate, Growth, are_rising};
use super::neighbours::Neighbours;
use super::nested::Nested;
use super::seed::Foot;
use super::spread;
use crate::fairing::Options;
use crate::support::error::Error;

// Figures of constants: what is left of bumps over what the best of six balls leaves, geometric means of 8 wide and 8 narrow ones on exact
// surfaces, of 24 with noise of .03 and .1 edges, and of 4 on scans: 1.12, 1.04, 1.45, .94, where one with noise and one on a scan's hair are not
// found. Those of other constants were measured where SIGNIFICANT was a tenth: 1.12, 1.04, 1.55, 1.15.

/// The smallest region's radius, in edges around the seed. Half: 1.18, 1.06, 1.29, 1.14, double: 1.20, 1.01, 1.30,
/// 1.86, and a wide one is not found either.
const FIRST: f64 = 2.5;
/// A region with less disagreement is looked for so many regions ahead, and the height falls over so many. Half: 1.12,
/// 1.04, 1.69, 1.78; double: 1.25, 1.04, 1.45, .92, and four more are not found.
const PATIENCE: usize = 2;
/// A bump whose fair surface is uncertain by this part of its height, or more, is none. At 0.35 six more are
/// not found; at 0.7 all are, but a sphere with noise of .02 edges has a dent.
const UNCERTAIN: f64 = 0.5;
/// What stands out by this part of the most is its core. Half: 1.12, 1.03, 1.48, 1.15; double: 1.04, 1.03, 1.52, 1.16.
const CORE: f64 = 0.15;
/// Around its core the same bump is no larger, in radii of the region around the seed: beyond is another one, with this one on it.
/// At 2: the same; at 6: 1.12, 1.04, 1.44, 1.15; without end a pimple on a nose takes the nose.
const SAME: f64 = 3.0;
/// A bump of about a given size is within this factor of it: two sizes whose ranges do not meet are two scales.
const SIZE: f64 = 1.5;
/// The fraction of the progress at which the region around the seed is known: both take about as long.
const ROUND: f64 = 0.5;

/// What was taken for a bump.
#[derive(Debug, Clone, PartialEq)]
pub struct Bump {
    /// How far its farthest corner is from the seed, along the surface.
    pub radius: f64,
    /// How many triangles it has.
    pub triangles: usize,
    /// How far the surface lies above the fair one at most, along the normal; a dent's is negative.
    pub height: f64,
    /// By how much the fair surface disagrees with that of a slightly larger region and with what surrounds it, over the root mean square of the
    /// height: near 0 the bump is told from all around it, from 0.5 on there is none.
    pub uncertainty: f64,
}

/// Finds the bump at a point of the surface, the smallest one or that of about this radius, and whether each triangle belongs to it.
///
/// # Errors
/// [`Error::NoBump`].
pub(super) fn find(
    mesh: &Neighbours<'_>,
    foot: &Foot,
    size: Option<f64>,
    tell: &mut dyn FnMut(f64),
) -> Result<(Bump, Vec<bool>), Error> {
    let none = Error::NoBump {
        why: "the surface beneath nowhere settles around it",
    };
    let from_seed = geodesic::distances(mesh, foot);
    let [least, largest] = size.map_or([0.0, f64::INFINITY], |size| [size / SIZE, size * SIZE]);
    let around = Nested::new(mesh, &from_seed, 0.0);
    let round = around.edge().and_then(|edge| {
        let within = least.max(FIRST * edge)..=largest;
        settled(&around, within, &mut |part| tell(ROUND * part))
    });
    let round = round.ok_or(none.clone())?;
    let (sources, radius) = core(mesh, &round);
    let from_core = geodesic::distances_from(mesh, &sources);
    // What stands out somewhere else is no bump at the place.
    let corners = mesh.triangles[foot.triangle as usize];
    if corners.iter().all(|&v| from_core[v as usize] > radius) {
        return Err(none);
    }
    let around_core = Nested::new(mesh, &from_core, radius);
    let same = SAME * (round.heights.area.iter().sum::<f64>() / PI).sqrt();
    let shaped = around_core.edge().and_then(|edge| {
        let mut tell = |part| tell(ROUND + (1.0 - ROUND) * part);
        settled(&around_core, radius + edge..=same, &mut tell)
    });
    let found = [(&around, largest, Some(round)), (&around_core, same, shaped)];
    let found = found
        .into_iter()
        .filter_map(|(around, largest, of)| Some((around, largest, of.filter(|of| of.is_settled)?)));
    let (around, largest, found) = found
        .min_by(|(.., a), (.., b)| a.uncertainty.total_cmp(&b.uncertainty))
        .ok_or(none)?;
    let found = with_curvature(around, found, largest);
    let mut is_in = vec![false; mesh.triangles.len()];
    found.triangles.iter().for_each(|&t| is_in[t as usize] = true);
    let corners = found.triangles.iter().flat_map(|&t| mesh.triangles[t as usize]);
    let bump = Bump {
        radius: corners.map(|v| from_seed[v as usize]).fold(0.0, f64::max),
        triangles: found.triangles.len(),
        height: found.heights.most(),
        uncertainty: found.uncertainty,
    };
    Ok((bump, is_in))
}

/// The vertices that stand out and hang together, and the radius of a disc as large as they.
fn core(mesh: &Neighbours<'_>, found: &Candidate) -> (Vec<u32>, f64) {
    let heights = &found.heights;
    let most = heights.most();
    let mut above = vec![0.0; mesh.positions.len()];
    for (v, height) in heights.vertices.iter().zip(&heights.above) {
        above[*v as usize] = height * most.signum();
    }
    let top = heights.vertices.iter().copied();
    let top = top.max_by(|v, w| above[*v as usize].total_cmp(&above[*w as usize]).then(w.cmp(v)));
    let none = vec![false; above.len()];
    let front = top.into_iter().collect();
    let stands_out = |_, w: u32| above[w as usize] > CORE * most.abs();
    let is_in = spread::flood(none, front, |v| mesh.around(v), stands_out);
    let with_area = heights.vertices.iter().zip(&heights.area);
    let area: f64 = with_area
        .filter(|(v, _)| is_in[**v as usize])
        .map(|(_, area)| area)
        .sum();
    let sources = (0..is_in.len() as u32).filter(|&v| is_in[v as usize]).collect();
    (sources, (area / PI).sqrt())
}

/// The least region within these radii whose surface stays what it is.
fn settled(around: &Nested<'_>, within: RangeInclusive<f64>, tell: &mut dyn FnMut(f64)) -> Option<Candidate> {
    let mut known: Vec<Candidate> = Vec::new();
    // Tangent planes alone: what is around is the bump's own flank at first.
    let mut growth = Growth::new(around, within, 0.0);
    // What the surface's end cuts off is not known: no region that meets it is more certain than the last one before.
    let mut least: Option<f64> = None;
    while let Some(mut next) = growth.next(tell) {
        if next.meets_an_end {
            if least.is_none() && are_rising(&known) {
                break;
            }
            let least = least.get_or_insert_with(|| known.last().map_or(0.0, |last| last.uncertainty));
            next.uncertainty = next.uncertainty.max(*least);
        }
        known.push(next);
        let whole = highest(&known).filter(|(_, falls)| *falls);
        if let Some((best, true)) = whole.map(|(k, _)| best(&known, k)) {
            let found = known.drain(..=best).next_back();
            // Noise and flanks have tops of their own.
            if found.as_ref().is_some_and(|found| found.uncertainty < UNCERTAIN) {
                return found;
            }
        }
    }
    // Without another one that is surely lower, the highest may be the bump's, if it is not the last.
    let (highest, falls) = highest(&known)?;
    let is_settled = falls || highest + 1 < known.len();
    let (best, _) = best(&known, highest);
    let best = Candidate {
        is_settled,
        ..known.swap_remove(best)
    };
    Some(best).filter(|best| best.uncertainty < UNCERTAIN)
}

/// From a region that has the bump on, the one whose surface changes least where it continues the curvature of what is around, if that is certain.
/// Where the surface beneath is no fair one, tangent planes alone miss it by ever more, and the bump's tails are not in yet when that begins
/// to show. On a flank curvature says nothing.
fn with_curvature(around: &Nested<'_>, found: Candidate, largest: f64) -> Candidate {
    let mut known: Vec<Candidate> = Vec::new();
    let mut growth = Growth::new(around, found.radius..=largest, Options::CONTINUITY_AUTO);
    while let Some(next) = growth.next(&mut |_| ()) {
        known.push(next);
        if best(&known, 0).1 {
            break;
        }
    }
    if known.is_empty() {
        return found;
    }
    let mut better = known.swap_remove(best(&known, 0).0);
    if found.meets_an_end {
        better.uncertainty = better.uncertainty.max(found.uncertainty);
    }
    match better.uncertainty < UNCERTAIN {
        true => better,
        false => found,
    }
}

/// The region from which on the height falls, and whether it surely does: a single one may be lower by noise at its boundary.
fn highest(known: &[Candidate]) -> Option<(usize, bool)> {
    let mut highest = 0;
    for (k, of) in known.iter().enumerate().skip(1) {
        if of.heights.rms > known[highest].heights.rms {
            highest = k;
        } else if k >= highest + PATIENCE && of.heights.are_below(&known[highest].heights) {
            return Some((highest, true));
        }
    }
    (!known.is_empty()).then_some((highest, false))
}

/// The region from there on with the least disagreement, with the one before and the one after it, and whether enough were looked at after it.
fn best(known: &[Candidate], from: usize) -> (usize, bool) {
    let square = |k: usize| known[k].disagreement.powi(2);
    // With one alone it may be small by chance.
    let both = |k: usize| square(k.saturating_sub(1)) + square(k);
    let mut best = from;
    for k in from + 1..known.len() {
        if both(k) < both(best) {
            best = k;
        } else if k > best + PATIENCE {
            return (best, true);
        }
    }
    (best, false)
}
