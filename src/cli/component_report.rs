//! The components of the region in the report, where there are several.

use std::collections::BTreeMap;

use fairmesh::{ComponentReport, Outcome};

use crate::figures::significant;

/// At most so many lines: each component, or of more those without success.
const SHOWN: usize = 8;

/// How many there are, and how they ended: (name, text) of each line.
pub fn lines(components: &[ComponentReport]) -> Vec<(&'static str, String)> {
    if components.len() < 2 {
        return Vec::new();
    }
    let mut counts = BTreeMap::new();
    for outcome in components.iter().map(|c| c.outcome.entry()) {
        counts.entry(outcome.number()).or_insert((0, outcome.name())).0 += 1;
    }
    let counts: Vec<String> = counts
        .values()
        .map(|(count, name)| format!("{count} {}", name.replace('_', " ")))
        .collect();
    let mut lines = vec![(
        "components",
        format!("{}: {}", components.len(), counts.join(", ")),
    )];
    let is_few = components.len() <= SHOWN;
    let shown: Vec<_> = components
        .iter()
        .filter(|c| is_few || c.outcome != Outcome::Converged)
        .collect();
    lines.extend(shown.iter().take(SHOWN).map(|c| ("", line(c))));
    if shown.len() > SHOWN {
        lines.push(("", format!("and {} more", shown.len() - SHOWN)));
    }
    lines
}

fn line(of: &ComponentReport) -> String {
    format!(
        "vertex {} and {} more: {}, {} iterations, diagonal {}, smallest angle {} degrees",
        of.vertex,
        of.free_vertices - 1,
        of.outcome.name().replace('_', " "),
        of.iterations,
        significant(of.diagonal),
        significant(of.quality.worst_angle),
    )
}
