//! Intersections of the whole surface: looked for once, in all components together.

use super::component_solution::ComponentSolution;
use super::options::{Intersections, Options};
use super::outcome::Outcome;
use super::report::{ComponentReport, SelfIntersections};
use crate::intersections::of_some;
use crate::support::profile::clock;

/// What intersects, and whose it is.
pub(super) struct Crossings {
    pub(super) found: SelfIntersections,
    /// How many pairs concern each component.
    counts: Vec<usize>,
}

impl Crossings {
    /// Of the second positions; the first are those of the input. None if no component has come to its end, or if intersections
    /// are not to be looked for.
    pub(super) fn new(
        (before, after): (&[[f64; 3]], &[[f64; 3]]),
        triangles: &[[u32; 3]],
        options: &Options,
        components: &[ComponentSolution],
    ) -> Option<Self> {
        let _clock = clock("intersections");
        let has_ended = |c: &&ComponentSolution| {
            !matches!(c.report.outcome, Outcome::IterationLimit | Outcome::Cancelled)
        };
        let ended = || components.iter().filter(has_ended);
        if options.intersections == Intersections::Skip || ended().next().is_none() {
            return None;
        }
        let mut new: Vec<u32> = ended().flat_map(|c| c.triangles.iter().copied()).collect();
        new.sort_unstable();
        let pairs = of_some(after, triangles, &new, SelfIntersections::MOST);
        let in_input = match pairs.is_empty() {
            true => 0,
            false => of_some(before, triangles, &new, SelfIntersections::MOST).len(),
        };
        let counts = match pairs.is_empty() {
            true => Vec::new(),
            false => counts(&pairs, components),
        };
        Some(Self {
            found: SelfIntersections { pairs, in_input },
            counts,
        })
    }

    /// A component that meets its tolerance, and has no other flaw that a verdict is about, is no success where it intersects.
    pub(super) fn tell(&self, reports: &mut [ComponentReport]) {
        for (report, &pairs) in reports.iter_mut().zip(&self.counts) {
            let is_success = matches!(
                report.outcome,
                Outcome::Converged | Outcome::ConvergedLoosely { .. } | Outcome::NearestMember { .. }
            );
            if is_success && pairs > 0 {
                report.outcome = Outcome::SelfIntersecting { pairs };
            }
        }
    }
}

/// How many pairs concern each component.
fn counts(pairs: &[[u32; 2]], components: &[ComponentSolution]) -> Vec<usize> {
    let of_component = |(c, solution): (usize, &ComponentSolution)| {
        let triangles = solution.triangles.clone();
        triangles.into_iter().map(move |t| (t, c))
    };
    let mut owners: Vec<(u32, usize)> = components.iter().enumerate().flat_map(of_component).collect();
    owners.sort_unstable();
    let owner = |t: u32| {
        let at = owners.binary_search_by_key(&t, |owner| owner.0).ok()?;
        Some(owners[at].1)
    };
    let mut counts = vec![0; components.len()];
    for pair in pairs {
        let [a, b] = pair.map(owner);
        for c in a.into_iter().chain(b.filter(|_| a != b)) {
            counts[c] += 1;
        }
    }
    counts
}
