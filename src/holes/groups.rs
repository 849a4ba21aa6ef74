//! Which loops get a patch, and which of them one together.

use nalgebra::Vector3;

use super::connections::connections;
use super::joint::{Bends, bends, triangulate};
use super::links::Links;
use super::loop_set::LoopSet;
use super::loops::{BoundaryLoop, LoopKind};
use super::options::{FillOptions, Join, LoopFilter, Loops};
use super::surroundings::bounds;
use super::triangulate::Measure;
use crate::support::error::Error;
use crate::support::table::table;

/// Loops that a patch of their own closes with less turn (degrees) have no need of others.
/// Half or double, of 6 cases: none changes.
const FLAT: f64 = 20.0;
/// Loops further from each other than so many times the smaller one's diagonal are not joined.
/// Half or double, of 5 cases: none changes.
const FAR: f64 = 2.0;
/// A joint patch has to bend less by this part of what patches for each loop do.
/// Half or double, of 6 cases: none changes.
const GAIN: f64 = 0.1;
/// No group of more edges than this is looked for: the triangulations would take too long.
/// Half or double, of 6 cases: none changes.
const MOST_EDGES: usize = 20_000;

/// What lies between loops that are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum GapKind {
    /// Between parts of the mesh that do not hang together: the ends of tubes, two sheets.
    Gap,
    /// In the same part, which gets a handle: the two mouths of a hole through a thick plate, a ring that is cut out of a tube.
    Tunnel,
    /// Between a hole and parts that lie in it.
    Island,
}

table!(GapKind {
    0 "gap" GapKind::Gap => "a gap between parts", "";
    1 "tunnel" GapKind::Tunnel => "a tunnel: the part gets a handle", "";
    2 "island" GapKind::Island => "a hole with an island in it", "";
});

impl GapKind {
    fn of(loops: &[&BoundaryLoop]) -> Self {
        let mut components: Vec<usize> = loops.iter().map(|of| of.component).collect();
        components.sort_unstable();
        components.dedup();
        let has = |kind: LoopKind| loops.iter().any(|of| of.kind == kind);
        match components.len() < loops.len() {
            true => Self::Tunnel,
            false if has(LoopKind::Hole) && has(LoopKind::OuterBoundary) => Self::Island,
            false => Self::Gap,
        }
    }
}

/// Why loops are joined: bends are sums over all edges, those of the loops included, of length times angle (radians), of
/// triangulations without new vertices; edges inside count half.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JoinReason {
    /// What lies between them.
    pub kind: GapKind,
    /// Of one patch for all of the loops.
    pub joint_bend: f64,
    /// Of a patch for each.
    pub separate_bend: f64,
    /// The area of the joint patch.
    pub joint_area: f64,
    /// The area of the separate ones.
    pub separate_area: f64,
}

/// Loops that [`Join::Auto`] gives one patch.
#[derive(Debug, Clone, PartialEq)]
pub struct JoinSuggestion {
    /// The loops, by their numbers in [`boundary_loops`](super::boundary_loops), ascending.
    pub loops: Vec<usize>,
    /// Why.
    pub reason: JoinReason,
}

/// What one patch is for.
#[derive(Debug, Clone)]
pub(super) struct LoopGroup {
    /// Ascending.
    pub(super) loops: Vec<usize>,
    /// Filled whatever its size, even if it is an outer boundary.
    pub(super) is_named: bool,
    pub(super) reason: Option<JoinReason>,
}

impl LoopGroup {
    fn single(index: usize, is_named: bool) -> Self {
        Self {
            loops: vec![index],
            is_named,
            reason: None,
        }
    }
}

/// What is to be looked at, in the order of the first loops.
pub(super) fn choose(
    options: &FillOptions,
    positions: &[[f64; 3]],
    links: &Links<'_>,
    loops: &[BoundaryLoop],
) -> Result<Vec<LoopGroup>, Error> {
    let count = loops.len();
    let (chosen, is_named) = match &options.loops {
        Loops::UpTo(_) | Loops::Where(_) => ((0..count).collect(), false),
        Loops::Chosen(list) => {
            let mut list = list.clone();
            list.sort_unstable();
            list.dedup();
            (list, true)
        }
    };
    let mut groups: Vec<LoopGroup> = match &options.join {
        Join::None => Vec::new(),
        Join::Groups(groups) => {
            let groups = groups.iter().filter(|group| !group.is_empty());
            groups.map(|group| named(group)).collect()
        }
        Join::Auto => {
            let asked = asked_for(options, positions, loops);
            let among: Vec<usize> = chosen
                .iter()
                .copied()
                .filter(|&l| l < count && asked[l])
                .collect();
            let found = suggestions(positions, links, loops, &among);
            found.into_iter().map(LoopGroup::from).collect()
        }
    };
    let mut grouped: Vec<usize> = groups.iter().flat_map(|group| &group.loops).copied().collect();
    grouped.sort_unstable();
    if let Some(&index) = chosen.iter().chain(&grouped).find(|&&l| l >= count) {
        return Err(Error::SelectionOutOfRange { index, count });
    }
    let alone = chosen.iter().filter(|l| grouped.binary_search(l).is_err());
    groups.extend(alone.map(|&l| LoopGroup::single(l, is_named)));
    groups.sort_unstable_by_key(|group| group.loops[0]);
    Ok(groups)
}

/// Per loop whether it has the size and the place that are asked for, whatever its kind.
pub(super) fn asked_for(options: &FillOptions, positions: &[[f64; 3]], loops: &[BoundaryLoop]) -> Vec<bool> {
    match &options.loops {
        Loops::UpTo(most) => loops.iter().map(|of| of.vertices.len() <= *most).collect(),
        Loops::Chosen(_) => vec![true; loops.len()],
        Loops::Where(filter) => {
            let mut asked: Vec<bool> = loops.iter().map(|of| meets(filter, positions, of)).collect();
            let mut holes: Vec<usize> = (0..loops.len())
                .filter(|&l| loops[l].kind == LoopKind::Hole)
                .collect();
            holes.sort_unstable_by(|&a, &b| loops[b].length.total_cmp(&loops[a].length).then(a.cmp(&b)));
            holes
                .iter()
                .take(filter.except_longest)
                .for_each(|&l| asked[l] = false);
            asked
        }
    }
}

fn meets(filter: &LoopFilter, positions: &[[f64; 3]], of: &BoundaryLoop) -> bool {
    let is_below = |bound: Option<f64>, value: f64| bound.is_none_or(|bound| value <= bound);
    let (low, high) = box_of(positions, of);
    let mut vertices = of.vertices.iter().map(|&v| &positions[v as usize]);
    filter.max_edges.is_none_or(|most| of.vertices.len() <= most)
        && is_below(filter.max_length, of.length)
        && is_below(filter.max_area, of.area)
        && is_below(filter.max_diagonal, (high - low).norm())
        && filter
            .components
            .as_ref()
            .is_none_or(|list| list.contains(&of.component))
        && filter.within.is_none_or(|place| vertices.all(|p| place.holds(p)))
}

fn named(loops: &[usize]) -> LoopGroup {
    let mut loops = loops.to_vec();
    loops.sort_unstable();
    LoopGroup {
        loops,
        is_named: true,
        reason: None,
    }
}

impl From<JoinSuggestion> for LoopGroup {
    fn from(of: JoinSuggestion) -> Self {
        Self {
            loops: of.loops,
            is_named: true,
            reason: Some(of.reason),
        }
    }
}

/// Loops that hang together, in the order in which they do: the nearest first.
struct Cluster {
    loops: Vec<usize>,
    /// The best groups that they are divided into, with the bends of each.
    groups: Vec<(Vec<usize>, Bends)>,
    /// The bends of a patch for each loop.
    separate: f64,
}

impl Cluster {
    fn total(&self) -> f64 {
        self.groups.iter().map(|group| group.1.total).sum()
    }
}

/// Groups among these loops. The nearest are put together first, then clusters of them; each cluster gets one patch if that bends less
/// than the best patches of its two parts.
pub(super) fn suggestions(
    positions: &[[f64; 3]],
    links: &Links<'_>,
    loops: &[BoundaryLoop],
    among: &[usize],
) -> Vec<JoinSuggestion> {
    let usable = among.iter().copied().filter(|&l| is_usable(positions, &loops[l]));
    let mut single = Vec::new();
    for l in usable {
        if let Some(bends) = measured(positions, links, loops, &[l])
            && (loops[l].turn > FLAT || has_others_inside(positions, loops, among, l))
        {
            single.push((l, bends));
        }
    }
    let of: Vec<&BoundaryLoop> = single.iter().map(|&(l, _)| &loops[l]).collect();
    if of.len() < 2 {
        return Vec::new();
    }
    let set = LoopSet::new(links, positions, &of);
    let mut clusters: Vec<Option<Cluster>> = single
        .iter()
        .map(|&(l, bends)| {
            Some(Cluster {
                loops: vec![l],
                groups: vec![(vec![l], bends)],
                separate: bends.total,
            })
        })
        .collect();
    let mut place: Vec<usize> = (0..clusters.len()).collect();
    for connection in connections(&set) {
        let [a, b] = [connection.from, connection.to].map(|v| place[set.loop_of(v as usize)]);
        let (Some(first), Some(second)) = (clusters[a].take(), clusters[b].take()) else {
            continue;
        };
        place.iter_mut().filter(|at| **at == b).for_each(|at| *at = a);
        clusters[a] = Some(united(positions, links, loops, first, second));
    }
    let groups = clusters.into_iter().flatten().flat_map(|cluster| cluster.groups);
    let mut found: Vec<JoinSuggestion> = groups
        .filter(|(of, _)| of.len() > 1)
        .map(|(of, joint)| {
            let separate = single.iter().filter(|(l, _)| of.contains(l));
            let sum = |value: fn(&Bends) -> f64| separate.clone().map(|(_, bends)| value(bends)).sum();
            let between: Vec<&BoundaryLoop> = of.iter().map(|&l| &loops[l]).collect();
            let reason = JoinReason {
                kind: GapKind::of(&between),
                joint_bend: joint.total,
                separate_bend: sum(|bends| bends.total),
                joint_area: joint.area,
                separate_area: sum(|bends| bends.area),
            };
            JoinSuggestion { loops: of, reason }
        })
        .collect();
    found.sort_unstable_by_key(|of| of.loops[0]);
    found
}

/// The bends of a patch for some loops.
fn measured(
    positions: &[[f64; 3]],
    links: &Links<'_>,
    loops: &[BoundaryLoop],
    list: &[usize],
) -> Option<Bends> {
    let of: Vec<&BoundaryLoop> = list.iter().map(|&l| &loops[l]).collect();
    let edges: usize = of.iter().map(|boundary| boundary.vertices.len()).sum();
    if edges > MOST_EDGES {
        return None;
    }
    let mut set = LoopSet::new(links, positions, &of);
    if list.len() == 1 {
        // What a lid would bend by, also where the mesh leaves no room for one.
        set.taken.clear();
    }
    let triangles = triangulate(&set, Measure::TotalBend, None)?;
    Some(bends(&set, triangles))
}

fn united(
    positions: &[[f64; 3]],
    links: &Links<'_>,
    loops: &[BoundaryLoop],
    first: Cluster,
    second: Cluster,
) -> Cluster {
    let mut all = [&first.loops[..], &second.loops].concat();
    all.sort_unstable();
    let apart = first.total() + second.total();
    let joint = are_near(positions, loops, &first.loops, &second.loops)
        .then(|| measured(positions, links, loops, &all))
        .flatten();
    let separate = first.separate + second.separate;
    let groups = match joint {
        Some(joint) if joint.total < apart.min((1.0 - GAIN) * separate) => vec![(all.clone(), joint)],
        _ => first.groups.into_iter().chain(second.groups).collect(),
    };
    Cluster {
        loops: all,
        groups,
        separate,
    }
}

fn box_of(positions: &[[f64; 3]], boundary: &BoundaryLoop) -> (Vector3<f64>, Vector3<f64>) {
    let x: Vec<Vector3<f64>> = boundary
        .vertices
        .iter()
        .map(|&v| Vector3::from(positions[v as usize]))
        .collect();
    bounds(&x)
}

fn is_usable(positions: &[[f64; 3]], boundary: &BoundaryLoop) -> bool {
    let is_finite = |&v: &u32| positions[v as usize].iter().all(|c| c.is_finite());
    boundary.kind.bad_edge().is_none()
        && boundary.touching.is_empty()
        && boundary.vertices.iter().all(is_finite)
}

/// Whether another loop's box lies in that of a loop.
fn has_others_inside(positions: &[[f64; 3]], loops: &[BoundaryLoop], among: &[usize], of: usize) -> bool {
    let (low, high) = box_of(positions, &loops[of]);
    let room = Vector3::repeat(GAIN * (high - low).norm());
    let (low, high) = (low - room, high + room);
    among.iter().filter(|&&l| l != of).any(|&l| {
        let (least, most) = box_of(positions, &loops[l]);
        (0..3).all(|k| least[k] >= low[k] && most[k] <= high[k])
    })
}

/// Whether the boxes of a loop of each are near enough.
fn are_near(positions: &[[f64; 3]], loops: &[BoundaryLoop], first: &[usize], second: &[usize]) -> bool {
    let is_near = |a: usize, b: usize| {
        let [a, b] = [a, b].map(|l| box_of(positions, &loops[l]));
        let apart = |k: usize| (a.0[k] - b.1[k]).max(b.0[k] - a.1[k]).max(0.0);
        let distance = Vector3::new(apart(0), apart(1), apart(2)).norm();
        let diagonal = (a.1 - a.0).norm().min((b.1 - b.0).norm());
        distance <= FAR * diagonal
    };
    let mut pairs = first.iter().flat_map(|&i| second.iter().map(move |&j| (i, j)));
    pairs.any(|(i, j)| is_near(i, j))
}
