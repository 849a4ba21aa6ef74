//! Virtual loops: the vertices so many edges outside of a loop, taken for a loop. What an estimate from further out differs by there from
//! the curvature of the surface between both should be nothing, and is its error, wave by wave.

use std::borrow::Cow;
use std::ops::RangeInclusive;

use crate::discrete::loop_modes::LoopModes;
use crate::discrete::trace::Reach;
use crate::solve::g2::estimator::{Around, Estimated, Estimator};
use crate::solve::g2::outside::Outside;

/// How many edges outside virtual loops lie. Errors with G2 over those without, of 80 holes and regions on exact surfaces and 72 in scans,
/// geometric means, and the worst in scans: .907, .982, 1.00. Up to 4 edges: .891, .943, 1.34; up to 6: .856, .985, 1.01.
const DISTANCES: RangeInclusive<u8> = 3..=8;
/// The curvature between is the trace of that within so many edges, as the surface's own is.
/// Of the same cases, 2: nothing is continued anywhere, as samples are too few; double: .912, .986, 1.07.
const NEAR: usize = 3;
/// Another one, of all vertices between, is less noisy and sees less of what one-sided traces err by. From so many edges on it has samples
/// enough. Of the same cases, 3: .884, .981, 1.00; double: there is none, .877, .983, 1.00.
const WIDE: u8 = 5;
/// There has to be something so many edges further out: on less no estimate is as good as at the loop. Without it bands with ten rings around
/// them have no certain curvature. Half, of the same cases: the same figures; double: .888, .982, 1.00.
const LEAST_BEYOND: u8 = 4;
/// A virtual loop has this part of the loop's vertices at least: else most of it is not there.
/// Half or double, of the same cases: the same figures.
const LEAST_VERTICES: f64 = 0.5;
/// How far vertices are that are not found.
const FAR: u8 = u8::MAX;

/// A virtual loop.
struct VirtualLoop<'a> {
    /// What lies further out.
    beyond: Around<'a>,
    modes: LoopModes,
    /// The curvature between loop and virtual loop, from samples near the latter,
    near: Estimated,
    /// and from all of them; empty where these are too few.
    wide: Estimated,
}

/// Those around a loop.
pub(super) struct VirtualLoops<'a>(Vec<VirtualLoop<'a>>);

impl<'a> VirtualLoops<'a> {
    /// Around a loop with these vertices (local numbers) and modes.
    pub(super) fn new(outside: &'a Outside<'_>, along: &[u32], modes: &LoopModes) -> Self {
        let most = usize::from(*DISTANCES.end()) + Estimator::MOST_RINGS;
        let distances = Distances::new(outside, along, most);
        let made = DISTANCES.map(|distance| VirtualLoop::new(outside, &distances, distance, modes));
        Self(made.flatten().collect())
    }

    /// The energies of an estimator's error, of both waves of a length together, as [`LoopModes::energies`]; `None` where too little is
    /// known to tell.
    pub(super) fn error(&self, estimator: Estimator) -> Option<Vec<f64>> {
        let (mut near, mut wide) = (Vec::new(), Vec::new());
        for of in &self.0 {
            let found = estimator.along(&of.beyond);
            near.extend(of.energies(&found, &of.near));
            wide.extend(of.energies(&found, &of.wide));
        }
        let near = mean(&near)?;
        let wide = mean(&wide).unwrap_or_else(|| near.clone());
        // The first has noise of its own, the second hides what all traces err by: neither alone keeps noisy catenoids as they are and closes the
        // jump of noisy ellipsoids.
        let both = near.iter().zip(&wide);
        Some(both.map(|(near, wide)| (near * near.min(*wide)).sqrt()).collect())
    }
}

/// Wave by wave.
fn mean(energies: &[Vec<f64>]) -> Option<Vec<f64>> {
    let waves = energies.first()?.len();
    let count = energies.len() as f64;
    let of_wave = |m: usize| energies.iter().map(|of| of[m]).sum::<f64>() / count;
    Some((0..waves).map(of_wave).collect())
}

impl<'a> VirtualLoop<'a> {
    /// So many edges outside; `None` where most of it is not there.
    fn new(
        outside: &'a Outside<'_>,
        distances: &Distances,
        distance: u8,
        of_loop: &LoopModes,
    ) -> Option<Self> {
        let vertices = distances.at(distance);
        let least = LEAST_VERTICES * of_loop.angle.len() as f64;
        let beyond = distances.at(distance + LEAST_BEYOND);
        if (vertices.len().min(beyond.len()) as f64) < least {
            return None;
        }
        let modes = distances.modes(&vertices, of_loop);
        let normals = vertices.iter().map(|v| outside.normals[*v as usize]).collect();
        let along = (vertices, normals);
        let far = |v: u32| distances.edges[v as usize];
        let between = |rings: usize, reach: Reach| {
            let around = outside.around(along.clone(), rings, Cow::Borrowed(&outside.h), |v| {
                far(v) < distance
            });
            Estimator::Trace(reach).along(&around)
        };
        let near = between(NEAR, Reach::Near);
        let wide = if distance < WIDE {
            Vec::new()
        } else {
            between(usize::from(distance), Reach::Wide)
        };
        // What is told at the virtual loop itself is not known further out.
        let known = (0..).zip(&outside.h);
        let h = known
            .map(|(v, h)| if far(v) > distance { *h } else { f64::NAN })
            .collect();
        let is_beyond = |v: u32| (distance..FAR).contains(&far(v));
        let beyond = outside.around(along, Estimator::MOST_RINGS, Cow::Owned(h), is_beyond);
        Some(Self {
            beyond,
            modes,
            near,
            wide,
        })
    }

    /// Of the difference between two estimates, where both are there nearly everywhere.
    fn energies(&self, found: &Estimated, truth: &Estimated) -> Option<Vec<f64>> {
        let difference = |(a, b): (&Option<f64>, &Option<f64>)| Some((*a)? - (*b)?);
        let differences: Estimated = found.iter().zip(truth).map(difference).collect();
        if !Estimator::is_known(&differences) {
            return None;
        }
        let differences: Vec<f64> = differences.iter().map(|d| d.unwrap_or(0.0)).collect();
        Some(LoopModes::energies(&self.modes.parts(&differences)))
    }
}

/// How many edges each vertex lies outside of a loop, and at which angle of it.
struct Distances {
    /// [`FAR`] where it is not found.
    edges: Vec<u8>,
    /// The place in the loop of the nearest of its vertices.
    nearest: Vec<u32>,
    /// The vertices that are found, one distance after the other.
    found: Vec<u32>,
}

impl Distances {
    /// From the loop of these vertices (local numbers), no further than so many edges.
    fn new(outside: &Outside<'_>, along: &[u32], most: usize) -> Self {
        let count = outside.h.len();
        let mut this = Self {
            edges: vec![FAR; count],
            nearest: vec![0; count],
            found: along.to_vec(),
        };
        for (k, &v) in (0..).zip(along) {
            (this.edges[v as usize], this.nearest[v as usize]) = (0, k);
        }
        let mut begin = 0;
        for distance in 1..=most as u8 {
            let end = this.found.len();
            for i in begin..end {
                for &j in outside.neighbours.of(this.found[i]) {
                    if this.edges[j as usize] == FAR {
                        this.edges[j as usize] = distance;
                        this.found.push(j);
                    }
                }
            }
            for i in end..this.found.len() {
                let v = this.found[i];
                this.nearest[v as usize] = this.nearest_of(v, outside, along);
            }
            begin = end;
        }
        this
    }

    /// The nearest of those that are nearest to the neighbours before.
    fn nearest_of(&self, v: u32, outside: &Outside<'_>, along: &[u32]) -> u32 {
        let x = &outside.domain.input;
        let neighbours = outside.neighbours.of(v).iter();
        let before = neighbours.filter(|j| self.edges[**j as usize] < self.edges[v as usize]);
        let places = before.map(|j| self.nearest[*j as usize]);
        let far = |k: &u32| (x[along[*k as usize] as usize] - x[v as usize]).norm_squared();
        places.min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0)
    }

    /// The vertices so many edges away.
    fn at(&self, distance: u8) -> Vec<u32> {
        let found = self.found.iter().copied();
        found.filter(|v| self.edges[*v as usize] == distance).collect()
    }

    /// The modes of the loop at these vertices.
    fn modes(&self, vertices: &[u32], of_loop: &LoopModes) -> LoopModes {
        let angle = |v: &u32| of_loop.angle[self.nearest[*v as usize] as usize];
        of_loop.beside(vertices.iter().map(angle).collect())
    }
}
