//! How the solution of the whole is made of the components'.

use super::component_solution::ComponentSolution;
use super::options::Options;
use super::outcome::Outcome;
use super::report::{ComponentReport, Report, Seconds, Solution};
use super::whole_intersections::Crossings;
use crate::paper::LevelReport;
use crate::quality::Quality;
use crate::support::entries::sort_by_number;
use crate::support::profile;
use crate::support::stopwatch::Stopwatch;

/// The solution of all components together, of which there is at least one. `given` are the positions before.
pub(super) fn whole(
    given: &[[f64; 3]],
    triangles: &[[u32; 3]],
    options: &Options,
    components: &[ComponentSolution],
) -> Solution {
    let clock = Stopwatch::start();
    let _clock = profile::clock("solution");
    let mut positions = given.to_vec();
    for &(v, p) in components.iter().flat_map(|c| &c.moved) {
        positions[v as usize] = p;
    }
    let mut boundary_normals = joined(components, |c| &c.boundary_normals);
    sort_by_number(&mut boundary_normals);
    boundary_normals.dedup();
    let crossings = Crossings::new((given, &positions), triangles, options, components);
    let mut report = report(options, components, crossings);
    report.seconds.quality += clock.seconds();
    report.seconds.total += clock.seconds();
    Solution {
        positions,
        boundary_normals,
        mean_curvature: by_vertex(components, |c| &c.mean_curvature),
        gaussian_curvature: by_vertex(components, |c| &c.gaussian_curvature),
        report,
    }
}

fn joined<T: Clone>(
    components: &[ComponentSolution],
    list: impl Fn(&ComponentSolution) -> &Vec<T>,
) -> Vec<T> {
    components.iter().flat_map(|c| list(c).iter().cloned()).collect()
}

fn ascending(components: &[ComponentSolution], list: impl Fn(&ComponentSolution) -> &Vec<u32>) -> Vec<u32> {
    let mut all = joined(components, list);
    all.sort_unstable();
    all.dedup();
    all
}

fn by_vertex(
    components: &[ComponentSolution],
    list: impl Fn(&ComponentSolution) -> &Vec<(u32, f64)>,
) -> Vec<(u32, f64)> {
    let mut all = joined(components, list);
    sort_by_number(&mut all);
    all
}

/// The largest; not a number if any is none.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    let larger = |a: f64, b: f64| if a.is_nan() || a > b { a } else { b };
    values.reduce(larger).unwrap_or(f64::NAN)
}

fn report(options: &Options, components: &[ComponentSolution], crossings: Option<Crossings>) -> Report {
    let mut told: Vec<ComponentReport> = components.iter().map(|c| c.report.clone()).collect();
    if let Some(crossings) = &crossings {
        crossings.tell(&mut told);
    }
    let self_intersections = crossings.map(|c| c.found);
    let reports = || told.iter();
    let outcomes: Vec<&Outcome> = reports().map(|r| &r.outcome).collect();
    let mut outcome = Outcome::of_all(&outcomes);
    if let (Outcome::SelfIntersecting { pairs }, Some(found)) = (&mut outcome, &self_intersections) {
        *pairs = found.pairs.len();
    }
    Report {
        target: options.target,
        outcome,
        iterations: reports().map(|r| r.iterations).max().unwrap_or(0),
        defect: largest(reports().map(|r| r.defect)),
        step: largest(reports().map(|r| r.step)),
        seconds: seconds(components),
        quality: quality(components),
        levels: levels(components),
        free_vertices: reports().map(|r| r.free_vertices).sum(),
        diagonal: largest(reports().map(|r| r.diagonal)),
        least_bending: reports().any(|r| r.least_bending),
        suspicious_normals: ascending(components, |c| &c.suspicious_normals),
        fallback_weights: components.iter().map(|c| c.fallback_weights).sum(),
        self_intersections,
        sharp_edges: Vec::new(),
        components: told.clone(),
    }
}

fn seconds(components: &[ComponentSolution]) -> Seconds {
    let mut all = Seconds::default();
    for of in components.iter().map(|c| &c.seconds) {
        all.setup += of.setup;
        all.start += of.start;
        all.iterate += of.iterate;
        all.quality += of.quality;
    }
    all.total = all.setup + all.start + all.iterate + all.quality;
    all
}

fn quality(components: &[ComponentSolution]) -> Quality {
    let mut all = components[0].report.quality.clone();
    for of in components[1..].iter().map(|c| &c.report.quality) {
        all.take_worse(of);
    }
    if components.len() > 1 {
        all.flipped = ascending(components, |c| &c.report.quality.flipped);
        all.needles = ascending(components, |c| &c.report.quality.needles);
        let square =
            |c: &ComponentSolution| c.boundary as f64 * c.report.quality.normal_deviation_rms.powi(2);
        let count: usize = components.iter().map(|c| c.boundary).sum();
        let squares: f64 = components.iter().map(square).sum();
        all.bending_energy = components.iter().map(|c| c.report.quality.bending_energy).sum();
        all.normal_deviation_rms = (squares / count.max(1) as f64).sqrt();
    }
    all
}

impl Report {
    /// The report of this surface and another one beside it, of which each has so many boundary vertices.
    pub(crate) fn include(&mut self, other: Self, boundary: [usize; 2]) {
        self.outcome = Outcome::of_all(&[&self.outcome, &other.outcome]);
        self.iterations = self.iterations.max(other.iterations);
        self.defect = largest([self.defect, other.defect].into_iter());
        self.step = largest([self.step, other.step].into_iter());
        self.seconds.setup += other.seconds.setup;
        self.seconds.start += other.seconds.start;
        self.seconds.iterate += other.seconds.iterate;
        self.seconds.quality += other.seconds.quality;
        self.seconds.total += other.seconds.total;
        self.free_vertices += other.free_vertices;
        self.diagonal = self.diagonal.max(other.diagonal);
        self.least_bending |= other.least_bending;
        self.suspicious_normals.extend(other.suspicious_normals);
        self.fallback_weights += other.fallback_weights;
        self.components.extend(other.components);
        let (own, of) = (&mut self.quality, &other.quality);
        let [n, m] = boundary.map(|count| count as f64);
        let square = n * own.normal_deviation_rms.powi(2) + m * of.normal_deviation_rms.powi(2);
        own.normal_deviation_rms = (square / (n + m).max(1.0)).sqrt();
        own.bending_energy += of.bending_energy;
        own.flipped.extend(&of.flipped);
        own.needles.extend(&of.needles);
        own.take_worse(of);
    }
}

/// Level by level from the given mesh down; components with fewer levels have no part in the coarsest ones.
fn levels(components: &[ComponentSolution]) -> Vec<LevelReport> {
    let mut all: Vec<LevelReport> = Vec::new();
    for of in components.iter().map(|c| c.levels.iter().rev()) {
        for (k, level) in of.enumerate() {
            let Some(sum) = all.get_mut(k) else {
                all.push(*level);
                continue;
            };
            sum.vertices += level.vertices;
            sum.triangles += level.triangles;
            sum.updates += level.updates;
            sum.defect = largest([sum.defect, level.defect].into_iter());
        }
    }
    all.reverse();
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_a_number_is_the_largest() {
        let of = |values: &[f64]| largest(values.iter().copied());
        assert_eq!(of(&[1.0, 3.0, 2.0]), 3.0);
        for at in 0..3 {
            let mut values = [1.0, 3.0, 2.0];
            values[at] = f64::NAN;
            assert!(of(&values).is_nan());
        }
    }
}
