//! How large the patches will be that are asked for, about: what memory is set aside by.

use std::f64::consts::PI;

use super::status::*;
use fairmesh::{BoundaryLoop, FillOptions, Join, LoopKind, Loops};

use fairmesh_status as Status;

/// What filling some loops takes.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct PatchSizes {
    /// New vertices of all patches.
    pub(crate) vertices: usize,
    /// Edges of the largest patch's boundary.
    pub(crate) longest: usize,
    /// Loops that bridges are looked for between.
    pub(crate) joined: usize,
}

impl PatchSizes {
    /// With so many new vertices at most, and some to spare.
    pub(crate) fn limited(self, most: usize) -> Self {
        Self {
            vertices: self.vertices.min(most).saturating_add(1000),
            ..self
        }
    }
}

/// Of the loops that are asked for. Fails where one is named that does not exist.
pub(crate) fn sizes(
    positions: &[[f64; 3]],
    loops: &[BoundaryLoop],
    asked: &FillOptions,
) -> CallResult<PatchSizes> {
    let groups = match &asked.join {
        Join::Groups(groups) => &groups[..],
        _ => &[],
    };
    let listed = match &asked.loops {
        Loops::Chosen(named) => &named[..],
        _ => &[],
    };
    let named = || listed.iter().chain(groups.iter().flatten());
    if let Some(&missing) = named().find(|&&l| l >= loops.len()) {
        let why = format_args!("loop {missing} is named, but there are only {}", loops.len());
        let failure = Failure::new(Status::SelectionOutOfRange, why);
        return Err(failure.at(fairmesh_element::Loop, missing));
    }
    let joins_itself = asked.join == Join::Auto;
    let mut is_grouped = vec![false; loops.len()];
    groups.iter().flatten().for_each(|&l| is_grouped[l] = true);
    let mut is_listed = vec![false; loops.len()];
    listed.iter().for_each(|&l| is_listed[l] = true);
    let is_alone = |l: usize| {
        let is_asked = match &asked.loops {
            Loops::UpTo(most) => loops[l].vertices.len() <= *most,
            Loops::Chosen(_) => return is_listed[l] && !is_grouped[l],
            Loops::Where(_) => true,
        };
        is_asked && !is_grouped[l] && (joins_itself || loops[l].kind == LoopKind::Hole)
    };
    let edges = |l: usize| loops[l].vertices.len();
    let density = (asked.density * asked.density).max(0.5);
    // No disk of edges of one length has more vertices than the flat round one, whose boundary of n edges has an area of n^2 / (4 pi)
    // with a vertex for each 3^.5 / 2 (isoperimetric inequality): n^2 / 10.9 at the default density of the square root of 2. Half as
    // many again for lengths that differ. A patch for several loops that are found to be near each other, none further than two
    // diagonals of the smaller one, has less than n^2.
    let share = if joins_itself {
        0.5
    } else {
        0.75 / (2.0 * PI * 3.0_f64.sqrt())
    };
    let alone = (0..loops.len()).filter(|&l| is_alone(l));
    let mut new: f64 = alone
        .clone()
        .map(|l| (edges(l) * edges(l)) as f64 * density * share)
        .sum();
    let mut of = PatchSizes {
        vertices: 0,
        longest: alone.clone().map(edges).max().unwrap_or(0),
        joined: groups.iter().map(Vec::len).max().unwrap_or(0),
    };
    if joins_itself {
        of.longest = alone.clone().map(edges).sum();
        of.joined = alone.count();
    }
    for group in groups {
        let count: usize = group.iter().map(|&l| edges(l)).sum();
        let length: f64 = group.iter().map(|&l| loops[l].length).sum();
        // No larger than a patch may be, nor than one all around the loops, of edges as long as theirs.
        let most = 1000.0 + (count * count) as f64 * density.max(1.0);
        let around = 2.5 * (diagonal(positions, loops, group) * count as f64 / length).powi(2) * density;
        new += if around.is_finite() {
            around.min(most)
        } else {
            most
        };
        of.longest = of.longest.max(count);
    }
    of.vertices = new as usize;
    Ok(of)
}

/// Of the bounding box of some loops.
fn diagonal(positions: &[[f64; 3]], loops: &[BoundaryLoop], group: &[usize]) -> f64 {
    let vertices = || group.iter().flat_map(|&l| &loops[l].vertices);
    let side = |k: usize| {
        let along = || vertices().map(|&v| positions[v as usize][k]);
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    };
    (side(0).powi(2) + side(1).powi(2) + side(2).powi(2)).sqrt()
}
