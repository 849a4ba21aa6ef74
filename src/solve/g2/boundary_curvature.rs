//! What mean curvature the surface shall have along a boundary loop: that of the surroundings, as far as they can be trusted.
//!
//! At the boundary positions and normals fix two of the three entries of the second fundamental form; the mean curvature `H*` of the
//! surroundings fixes the third. The surface's own is the trace of the curvatures at its vertices, which are smooth, other than positions.

use std::sync::Arc;

use nalgebra::Vector3;

use crate::discrete::boundary_samples::BoundarySamples;
use crate::discrete::loop_modes::LoopModes;
use crate::discrete::trace::{Reach, Trace};
use crate::mesh::boundary_loops::boundary_loops;
use crate::solve::domain::Domain;
use crate::solve::g2::estimator::{Estimated, MOST_ESTIMATES};
use crate::solve::g2::outside::Outside;
use crate::solve::g2::outside_curvature::OutsideCurvature;
use crate::solve::g2::shrinkage::{Trusted, is_seen};

/// The most modes of a loop.
/// Of 14 cases, half: 1 changes by up to 2 edges, -15 % iterations; double: none changes.
const MOST_MODES: usize = 32;
/// A mode for so many vertices at most: the waves of shorter ones are not resolved. Loops with fewer vertices stay as they are.
/// Of 14 cases, half: 10 change by up to 0.8 edges, +24 % iterations; double: 8 change by up to 2 edges, -15 % iterations.
const LEAST_VERTICES_PER_MODE: usize = 8;
/// The trace inside takes samples within this many edges.
/// Of 14 cases, half: 7 change by up to 0.4 edges, +3 % iterations; double: 8 change by up to 1 edge, -9 % iterations.
const NEAR: usize = 3;
/// The trace is an extrapolation, and takes samples from further away, where the absolute values of its weights have a sum above this.
/// Of 14 cases, half: 8 change by up to 1 edge, -14 % iterations; double: 8 change by up to 0.8 edges, -2 % iterations.
const STEADY: f64 = 5.0;

/// How much of the way to the curvature of the surroundings is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Blend {
    /// All of it, along loops where the curvature is certain; else nothing.
    Auto,
    /// From 0, tangent planes alone, to 1.
    Part(f64),
}

impl Blend {
    /// At most.
    pub(in crate::solve) fn part(self) -> f64 {
        match self {
            Self::Auto => 1.0,
            Self::Part(part) => part,
        }
    }
}

impl Default for Blend {
    fn default() -> Self {
        Self::Part(0.0)
    }
}

/// Continuity of the curvature, as it is asked for.
#[derive(Debug, Clone, Default)]
pub(crate) struct AskedContinuity {
    /// How much of the way.
    pub blend: Blend,
    /// What is asked of single loops in its place, by boundary vertex, with the place in what was handed over; empty: nothing.
    pub of_loops: Vec<Option<(usize, Blend)>>,
    /// `H` where it is given, by boundary vertex; empty: nowhere.
    pub given: Vec<Option<f64>>,
    /// Where the normal or the place is not that of the surroundings, by boundary vertex.
    pub is_given: Vec<bool>,
}

impl AskedContinuity {
    /// What is asked of the loop of these boundary vertices. Of several numbers for it the last one holds.
    pub(in crate::solve) fn of_loop(&self, vertices: &[u32]) -> Blend {
        let own = vertices
            .iter()
            .filter_map(|&b| self.of_loops.get(b as usize).copied().flatten());
        let blend = own
            .max_by_key(|(place, _)| *place)
            .map_or(self.blend, |(_, blend)| blend);
        // Who gives normals or places alone does not mean the shape of the surroundings.
        let is_given = || vertices.iter().any(|&b| self.is_given[b as usize]);
        let has_curvature = || vertices.iter().any(|&b| self.given_at(b).is_some());
        match blend {
            Blend::Auto if is_given() && !has_curvature() => Blend::Part(0.0),
            asked => asked,
        }
    }

    /// `H` where it is given.
    fn given_at(&self, boundary: u32) -> Option<f64> {
        self.given.get(boundary as usize).copied().flatten()
    }
}

/// What holds along a loop.
#[derive(Debug)]
pub(crate) struct LoopCondition {
    /// Boundary vertices in their order.
    pub vertices: Vec<u32>,
    /// How much of the way to the curvature of the surroundings is asked for.
    pub asked: Blend,
    /// Where no earlier loop has the same vertex: loops may touch.
    pub owns: Vec<bool>,
    /// The lowest modes.
    pub modes: LoopModes,
    /// Samples of the trace inside.
    inside: BoundarySamples,
    /// Where there is something outside.
    pub has_surroundings: Vec<bool>,
    /// `H` of the surroundings; the surface's own where there is none.
    pub surroundings: Vec<f64>,
    /// How much of the way there can be trusted.
    pub trusted: Trusted,
    /// `H` of the tangent-continuous surface, as its equation has it.
    pub before: Vec<f64>,
    /// What `H` shall be.
    pub target: Vec<f64>,
}

impl LoopCondition {
    /// Takes a part of the way from the tangent-continuous surface to the surroundings.
    pub(in crate::solve) fn aim(&mut self, part: f64) {
        for (k, target) in self.target.iter_mut().enumerate() {
            *target = self.before[k] + part * self.trusted.change[k];
        }
    }

    /// The free vertices around vertex `k` of the loop, and with which weights values there make the one that they tend to at it; where
    /// there are too few around, its own.
    pub(in crate::solve) fn trace(
        &self,
        k: usize,
        free: usize,
        x: &[Vector3<f64>],
        normals: &[Vector3<f64>],
    ) -> Vec<(u32, f64)> {
        let b = self.vertices[k] as usize;
        trace_inside(self.inside.of(k), b, free, x, normals).unwrap_or_else(|| vec![((free + b) as u32, 1.0)])
    }

    /// Boundary vertices with the value of a mode there.
    pub(in crate::solve) fn mode(&self, m: usize) -> impl Iterator<Item = (usize, f64)> {
        let values = self.vertices.iter().zip(&self.modes.modes[m]);
        let owned = values.zip(&self.owns).filter(|(_, owns)| **owns);
        owned.map(|((&b, value), _)| (b as usize, *value))
    }

    /// `H` of the surface along the loop.
    pub(in crate::solve) fn curvature_inside(
        &self,
        free: usize,
        (x, h): (&[Vector3<f64>], &[f64]),
        normals: &[Vector3<f64>],
    ) -> Vec<f64> {
        let at = |k: usize| {
            let weights = self.trace(k, free, x, normals);
            weights.iter().map(|&(j, w)| w * h[j as usize]).sum()
        };
        (0..self.vertices.len()).map(at).collect()
    }

    /// The jump between the surface's `H` along the loop and that of the surroundings, root mean square and largest.
    pub(in crate::solve) fn jump(&self, inside: &[f64]) -> [f64; 2] {
        let pairs = inside.iter().zip(&self.surroundings).zip(&self.has_surroundings);
        let jumps: Vec<f64> = pairs
            .map(|((h, outside), is_there)| if *is_there { h - outside } else { 0.0 })
            .collect();
        let largest = jumps.iter().fold(0.0f64, |m, j| m.max(j.abs()));
        [self.modes.product(&jumps, &jumps).sqrt(), largest]
    }
}

/// See [`LoopCondition::trace`]; of these samples, at boundary vertex `b`.
#[inline(never)]
fn trace_inside(
    (vertices, reach): (&[u32], &[u8]),
    b: usize,
    free: usize,
    x: &[Vector3<f64>],
    normals: &[Vector3<f64>],
) -> Option<Vec<(u32, f64)>> {
    let inside = vertices.iter().zip(reach).filter(|(j, _)| (**j as usize) < free);
    let edges = inside
        .clone()
        .map(|(&j, &reach)| (x[j as usize] - x[free + b], reach));
    let trace = Trace::new(&normals[b], Reach::Near, edges)?;
    Some(inside.zip(trace.weights()).map(|((&j, _), w)| (j, w)).collect())
}

/// Within how many edges samples make a trace that does not extrapolate.
fn steady_rings(
    (vertices, reach): (&[u32], &[u8]),
    b: usize,
    free: usize,
    x: &[Vector3<f64>],
    normals: &[Vector3<f64>],
) -> usize {
    let mut best = (f64::INFINITY, NEAR);
    for rings in NEAR..=Reach::Near.rings() {
        let count = reach.partition_point(|r| usize::from(*r) <= rings);
        let weights = trace_inside((&vertices[..count], &reach[..count]), b, free, x, normals);
        let size = weights.map_or(f64::INFINITY, |w| w.iter().map(|(_, w)| w.abs()).sum());
        if size < best.0 {
            best = (size, rings);
        }
        if size <= STEADY {
            break;
        }
    }
    best.1
}

/// The conditions along all loops of the tangent-continuous surface `x` with mean curvatures `h` where there is something to continue.
pub(in crate::solve) fn loop_conditions(
    domain: &Arc<Domain>,
    normals: &[Vector3<f64>],
    surface: (&[Vector3<f64>], &[f64]),
    asked: &AskedContinuity,
) -> Vec<LoopCondition> {
    let outside = Outside::new(domain);
    let loops = boundary_loops(&domain.region, &domain.rings);
    let long = loops
        .into_iter()
        .filter(|along| along.len() >= LEAST_VERTICES_PER_MODE);
    // Where tangent planes alone are asked for, Delta_B H is 0.
    let continued = long.filter(|along| asked.of_loop(along).part() > 0.0);
    let conditions = continued.filter_map(|along| loop_condition(along, &outside, normals, surface, asked));
    let mut conditions: Vec<LoopCondition> = conditions.collect();
    let mut is_taken = vec![false; domain.region.boundary];
    for condition in &mut conditions {
        for (owns, &b) in condition.owns.iter_mut().zip(&condition.vertices) {
            *owns = !std::mem::replace(&mut is_taken[b as usize], true);
        }
    }
    conditions
}

fn loop_condition(
    vertices: Vec<u32>,
    outside: &Outside<'_>,
    normals: &[Vector3<f64>],
    (x, h): (&[Vector3<f64>], &[f64]),
    asked: &AskedContinuity,
) -> Option<LoopCondition> {
    let domain = outside.domain;
    let free = domain.region.free;
    let centres = || vertices.iter().map(|b| free as u32 + b);
    let inside = BoundarySamples::new(centres(), Reach::Near.rings(), x.len(), |v| {
        domain.rings.neighbours(v as usize).iter().copied()
    });
    let rings = |k: usize| steady_rings(inside.of(k), vertices[k] as usize, free, x, normals);
    let inside = inside.within(rings);
    let is_there =
        |(k, b): (usize, &u32)| trace_inside(inside.of(k), *b as usize, free, x, normals).is_some();
    let there = vertices.iter().enumerate().filter(|at| is_there(*at)).count();
    if (there as f64) < MOST_ESTIMATES * vertices.len() as f64 {
        return None;
    }
    let polygon: Vec<_> = centres().map(|v| x[v as usize]).collect();
    let most = (vertices.len() / LEAST_VERTICES_PER_MODE).clamp(1, MOST_MODES);
    let modes = LoopModes::new(&polygon, most - (most + 1) % 2);
    let mut this = LoopCondition {
        asked: asked.of_loop(&vertices),
        inside,
        has_surroundings: Vec::new(),
        surroundings: Vec::new(),
        target: Vec::new(),
        trusted: Trusted::default(),
        before: Vec::new(),
        vertices,
        owns: vec![true; modes.modes.first().map_or(0, Vec::len)],
        modes,
    };
    this.before = this.curvature_inside(free, (x, h), normals);
    this.target.clone_from(&this.before);
    let is_auto = this.asked == Blend::Auto;
    let length = length(&polygon);
    let is_seen = |h: &Estimated| !is_auto || is_seen(&this.modes, &this.before, h, length);
    let given = |b: u32| asked.given_at(b);
    let surroundings = OutsideCurvature::new(outside, &this.vertices, normals, &this.modes, given, is_seen)?;
    this.has_surroundings = surroundings.h.iter().map(|h| h.is_some()).collect();
    let known = surroundings.h.iter().zip(&this.before);
    this.surroundings = known.map(|(h, before)| h.unwrap_or(*before)).collect();
    this.trusted = Trusted::new(&this.modes, &this.before, &surroundings);
    if is_auto && !this.trusted.is_certain(length) {
        this.trusted.leave();
    }
    Some(this)
}

/// Of a closed polygon.
fn length(polygon: &[Vector3<f64>]) -> f64 {
    let before = polygon.iter().cycle().skip(polygon.len() - 1);
    polygon.iter().zip(before).map(|(a, b)| (a - b).norm()).sum()
}
