//! The public entry: all holes of a mesh, one after the other.

use std::collections::HashSet;

use fairmesh_linear::interrupt::unless_stopped;

use super::attempts::Check;
use super::crossing::Neighbours;
use super::filled::Filled;
use super::groups::{JoinSuggestion, LoopGroup, asked_for, choose};
use super::guides::Guides;
use super::joint;
use super::links::Links;
use super::loops::BoundaryLoop;
use super::options::{FillOptions, Join, largest_patch};
use super::outcome::{FillOutcome, OpenReason};
use super::rim::Rims;
use super::surroundings::{LAYERS_OF_CREASES, LAYERS_OF_CURVATURE, Surroundings};
use crate::fairing::{
    BoundaryCrease, Intersections, Options, Progress, ProgressCallback, SelfIntersections, check_loops,
    in_given, joined_options, on_workers,
};
use crate::holes::fill_progress::{FillProgress, Tries};
use crate::holes::local_frame::local_options;
use crate::holes::patch_surface::{PatchSurface, Task};
use crate::holes::refusal::objection;
use crate::holes::triangle_owner::Owned;
use crate::mesh::{Joined, NONE};
use crate::support::error::Error;
use crate::support::stopwatch::Stopwatch;

/// Fills holes of a triangle mesh: triangulates, refines and fairs each. `positions` is #V by 3, `triangles` #T by 3,
/// counter-clockwise seen from the side that normals point to.
///
/// Original vertices and triangles keep their numbers, and their bits, but for vertices that are [allowed to
/// move](super::Rim::relax). A loop that cannot be filled, or not well, says so in its
/// report and does not affect the others.
///
/// ```
/// use fairmesh::{FillOptions, boundary_loops, fill_holes};
/// // An octahedron without one of its triangles.
/// let positions = [
///     [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0],
/// ];
/// let triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5]];
/// let filled = fill_holes(&positions, &triangles, &FillOptions::default())?;
/// assert!(boundary_loops(&filled.positions, &filled.triangles)?.is_empty());
/// assert_eq!(filled.positions[..6], positions);
/// assert_eq!(filled.triangles[..7], triangles);
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadOption`], [`Error::IndexOutOfRange`], [`Error::TooLarge`], [`Error::SelectionOutOfRange`] for a loop
/// that does not exist.
pub fn fill_holes(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    options: &FillOptions,
) -> Result<Filled, Error> {
    filled(positions, triangles, options, None)
}

/// [`fill_holes`], which calls `progress` on the calling thread, with the fraction of all loops. `Break` stops the run: the
/// loops that are not done stay open.
///
/// ```
/// use std::ops::ControlFlow;
///
/// use fairmesh::{FillOptions, FillOutcome, OpenReason, fill_holes_with_progress};
///
/// # let positions = [
/// #     [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0],
/// # ];
/// # let triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5]];
/// let mut stop = |_: &fairmesh::Progress| ControlFlow::Break(());
/// let filled = fill_holes_with_progress(&positions, &triangles, &FillOptions::default(), &mut stop)?;
/// assert_eq!(filled.loops[0].outcome, FillOutcome::LeftOpen(OpenReason::Cancelled));
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// Those of [`fill_holes`].
pub fn fill_holes_with_progress(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    options: &FillOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<Filled, Error> {
    filled(positions, triangles, options, Some(progress))
}

/// Which loops [`Join::Auto`](super::Join::Auto) would give one patch, by the options' `loops`, whatever their `join` is. None
/// that is alone is listed.
///
/// ```
/// use fairmesh::{FillOptions, suggest_joins};
/// // Two rings of a tube of six sides, with a gap between them.
/// let at = |i: u32, z: f64| {
///     let (sin, cos) = (f64::from(i) * std::f64::consts::FRAC_PI_3).sin_cos();
///     [cos, sin, z]
/// };
/// let positions: Vec<[f64; 3]> =
///     [0.0, 1.0, 2.0, 3.0].iter().flat_map(|&z| (0..6).map(move |i| at(i, z))).collect();
/// let ring = |first: u32| {
///     let side = move |i: u32| {
///         let [a, b] = [first + i, first + (i + 1) % 6];
///         [[a, b, b + 6], [a, b + 6, a + 6]]
///     };
///     (0..6).flat_map(side)
/// };
/// let triangles: Vec<[u32; 3]> = ring(0).chain(ring(12)).collect();
/// let found = suggest_joins(&positions, &triangles, &FillOptions::default())?;
/// assert_eq!(found.len(), 1);
/// assert_eq!(found[0].loops.len(), 2); // the middle ones of four
/// assert!(found[0].reason.joint_bend < 0.5 * found[0].reason.separate_bend);
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// Those of [`fill_holes`].
pub fn suggest_joins(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    options: &FillOptions,
) -> Result<Vec<JoinSuggestion>, Error> {
    options.validate()?;
    let joined = Joined::new(positions, triangles, options.fairing.coincident)?;
    let links = Links::new(positions.len(), &joined.triangles)?;
    let loops = links.loops(positions, options.fairing.coincident);
    let asked = FillOptions {
        join: Join::Auto,
        ..options.clone()
    };
    let groups = choose(&asked, positions, &links, &loops)?;
    let suggestion = |group: LoopGroup| {
        let loops = group.loops;
        group.reason.map(|reason| JoinSuggestion { loops, reason })
    };
    Ok(groups.into_iter().filter_map(suggestion).collect())
}

fn filled(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    options: &FillOptions,
    progress: Option<&mut ProgressCallback<'_>>,
) -> Result<Filled, Error> {
    options.validate()?;
    on_workers(options.fairing.threads, progress, |progress| {
        fill_within(positions, triangles, options, progress)
    })
}

/// [`fill_holes`] as a part of another run, on its threads, which tells of it and stops it. The options are valid.
pub(super) fn fill_within(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    options: &FillOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<Filled, Error> {
    let joined = Joined::new(positions, triangles, options.fairing.coincident)?;
    let fairing = joined_options(&joined.copies, &options.fairing);
    let links = Links::new(positions.len(), &joined.triangles)?;
    let loops = links.loops(positions, options.fairing.coincident);
    let groups = choose(options, positions, &links, &loops)?;
    let of_group = |i: usize| -> Vec<&BoundaryLoop> { groups[i].loops.iter().map(|&l| &loops[l]).collect() };
    let on_loops = (0..groups.len())
        .flat_map(of_group)
        .flat_map(|of| of.vertices.iter().copied());
    check_loops(&fairing.loop_continuity, on_loops)
        .map_err(|error| in_given(error, &joined.copies, &options.fairing))?;
    let guides = Guides {
        copies: &joined.copies,
        links: &links,
        positions,
        loops: &loops,
        groups: &groups,
    };
    let guides = guides.resolved(&options.guides)?;
    let edges = |i: usize| -> usize { of_group(i).iter().map(|of| of.vertices.len()).sum() };
    let mut order: Vec<usize> = (0..groups.len()).collect();
    order.sort_unstable_by_key(|&i| (edges(i), i));
    let is_checked = options.fairing.intersections == Intersections::Check;
    let asked = asked_for(options, positions, &loops);
    let objections: Vec<Option<OpenReason>> = (0..groups.len())
        .map(|i| objection(options, &asked, &groups[i], (&of_group(i), positions)))
        .collect();
    let is_filled = |i: usize| objections[i].is_none();
    // What stays open is no work, and has no surroundings.
    let chosen = (0..groups.len()).map(|i| if is_filled(i) { of_group(i) } else { Vec::new() });
    let work = |i: usize| if is_filled(i) { edges(i) } else { 0 };
    let mut rims = Rims::none(groups.len(), positions);
    if options.rim.relax > 0 {
        let filled: Vec<usize> = (0..groups.len()).filter(|&i| is_filled(i)).collect();
        rims.relax(options, &links, filled.iter().map(|&i| (i, of_group(i))));
    }
    let of_groups = FillProgress::new(triangles.len(), options.density, (0..groups.len()).map(work));
    let _ = progress(&of_groups.loops_known());
    let mut run = FillRun {
        positions: &rims.positions,
        rims: &rims,
        neighbours: is_checked
            .then(|| unless_stopped(|| Neighbours::new(&rims.positions, &joined.triangles, chosen)))
            .flatten(),
        links: &links,
        place: vec![NONE; triangles.len()],
        made: HashSet::new(),
        left: options.max_new_vertices,
        options,
        fairing: &fairing,
        guides,
        work: of_groups,
    };
    let mut pieces: Vec<Option<(PatchSurface, f64)>> = groups.iter().map(|_| None).collect();
    for i in order {
        let clock = Stopwatch::start();
        let boundary = of_group(i);
        let mut piece = match objections[i] {
            Some(reason) => PatchSurface::open(reason),
            None => unless_stopped(|| run.fill(i, &groups[i], &boundary, progress))
                .unwrap_or_else(|| PatchSurface::open(OpenReason::Cancelled)),
        };
        if !joined.copies.is_empty() {
            let copies: Vec<u32> = boundary.iter().flat_map(|of| of.copies(triangles)).collect();
            piece.name_copies(&copies);
        }
        run.work.end(work(i));
        pieces[i] = Some((piece, clock.seconds()));
    }
    let open = |i: &usize| {
        pieces[*i]
            .as_ref()
            .is_none_or(|(piece, _)| piece.triangles.is_empty())
    };
    let open: Vec<usize> = (0..groups.len()).filter(open).collect();
    let mut filled = Filled {
        positions: rims.written(positions, &open, &joined.copies),
        triangles: triangles.to_vec(),
        parents: Vec::new(),
        loops: Vec::with_capacity(groups.len()),
    };
    let mut pieces: Vec<(PatchSurface, f64)> = pieces.into_iter().flatten().collect();
    tell_both(&mut pieces);
    let crossings = crossings(&pieces, triangles.len() as u32);
    for ((i, (piece, seconds)), pairs) in pieces.into_iter().enumerate().zip(crossings) {
        filled.append(piece, &groups[i], edges(i), seconds);
        if let Some(report) = filled.loops.last_mut() {
            let triangles = report.triangles.start as usize..report.triangles.end as usize;
            let name = |v: u32| joined.copies.smallest(v);
            let turned = rims.turned(i, &filled.positions, &filled.triangles[triangles], name);
            report.rim = rims.report(i).filter(|_| open.binary_search(&i).is_err());
            report.rim.iter_mut().for_each(|rim| rim.folded += turned);
            report.self_intersections = pairs;
        }
    }
    Ok(filled)
}

/// Where a patch intersects one made earlier, that one says so, too.
fn tell_both(pieces: &mut [(PatchSurface, f64)]) {
    let mut earlier = Vec::new();
    for (i, (piece, _)) in pieces.iter().enumerate() {
        for pair in &piece.crossings {
            let others = pair.iter().filter_map(|owned| match owned {
                Owned::Patch { of, .. } if *of != i => Some((*of, *pair)),
                _ => None,
            });
            earlier.extend(others);
        }
    }
    for (of, pair) in earlier {
        let piece = &mut pieces[of].0;
        piece.outcome = FillOutcome::SelfIntersecting;
        if piece.crossings.len() < SelfIntersections::MOST {
            piece.crossings.push(pair);
        }
    }
}

/// Per piece its intersections, in the numbers of the filled mesh, which had `count` triangles.
pub(super) fn crossings(pieces: &[(PatchSurface, f64)], count: u32) -> Vec<Vec<[u32; 2]>> {
    let first: Vec<u32> = pieces
        .iter()
        .scan(count, |next, (piece, _)| {
            let first = *next;
            *next += piece.triangles.len() as u32;
            Some(first)
        })
        .collect();
    let number = |owned| match owned {
        Owned::Mesh(t) => t,
        Owned::Patch { of, triangle } => first[of] + triangle,
    };
    let numbered = |(piece, _): &(PatchSurface, f64)| {
        let ascending = |pair: [u32; 2]| [pair[0].min(pair[1]), pair[0].max(pair[1])];
        let mut pairs: Vec<[u32; 2]> = piece
            .crossings
            .iter()
            .map(|pair| ascending(pair.map(number)))
            .collect();
        pairs.sort_unstable();
        pairs
    };
    pieces.iter().map(numbered).collect()
}

struct FillRun<'m> {
    positions: &'m [[f64; 3]],
    rims: &'m Rims<'m>,
    /// What patches may intersect; none if they are not checked.
    neighbours: Option<Neighbours<'m>>,
    links: &'m Links<'m>,
    /// Scratch of [`Surroundings`].
    place: Vec<u32>,
    /// Edges between original vertices that earlier patches made.
    made: HashSet<(u32, u32)>,
    /// New vertices that may still be made.
    left: usize,
    options: &'m FillOptions,
    /// In the joined mesh's numbers.
    fairing: &'m Options,
    /// Per group its guides, by the places of their ends.
    guides: Vec<Vec<[u32; 2]>>,
    work: FillProgress,
}

impl FillRun<'_> {
    /// Fills the loops of a group, which is number `i` among those asked for.
    fn fill(
        &mut self,
        i: usize,
        group: &LoopGroup,
        loops: &[&BoundaryLoop],
        callback: &mut ProgressCallback<'_>,
    ) -> PatchSurface {
        let place = &mut self.place[..];
        let mut surroundings = match self.fairing.asks_continuity() {
            false => Surroundings::new(self.links, self.positions, loops, place),
            true => {
                Surroundings::with_layers(self.links, self.positions, loops, (LAYERS_OF_CURVATURE, place))
            }
        };
        surroundings.guides.clone_from(&self.guides[i]);
        if let Some(vertex) = surroundings.first_unusable() {
            return PatchSurface::open(OpenReason::NotFinite { vertex });
        }
        if loops.len() > 1
            && let Some([a, b]) = joint::opposed(&surroundings.loop_set())
        {
            let [a, b] = [a, b].map(|k| group.loops[k]);
            return PatchSurface::open(OpenReason::OppositeSides { a, b });
        }
        if loops.iter().any(|boundary| !boundary.touching.is_empty()) {
            self.add_made(&mut surroundings);
        }
        let edges = surroundings.loop_vertices;
        let (done, share) = self.work.share(edges);
        let mut tries = Tries::new();
        let mut tell = |progress: &Progress| {
            callback(&Progress {
                fraction: done + share * tries.reached(progress.fraction),
                ..*progress
            })
        };
        let (wide, creases) = self.creases(&surroundings, loops);
        surroundings = wide.unwrap_or(surroundings);
        let options = local_options(&surroundings, self.fairing);
        let mut options = self.rims.with_normals(i, &surroundings, options);
        if loops.len() == 1 {
            // They are followed already.
            options.sharp = 0.0;
            options.marked_edges.clear();
        }
        let task = Task {
            surroundings: &surroundings,
            factor: std::f64::consts::SQRT_2 / self.options.density,
            most: self.left.min(largest_patch(edges, self.options.density)),
            unfaired: self.options.unfaired(&surroundings),
            options,
            precision: self.options.fairing.output_precision,
        };
        let rims = self.rims;
        let has_sound_rim = |piece: &PatchSurface| {
            let x = piece.boundary.iter().map(|&v| rims.positions[v as usize]);
            let x: Vec<[f64; 3]> = x.chain(piece.positions.iter().copied()).collect();
            let name = |v: u32| piece.boundary.get(v as usize).copied().unwrap_or(NONE);
            let is_sound = rims.report(i).is_none_or(|rim| rim.is_sound());
            is_sound && rims.turned(i, &x, &piece.triangles, name) == 0
        };
        let check = Check {
            of: i,
            neighbours: self.neighbours.as_mut(),
            has_sound_rim: &has_sound_rim,
        };
        let length = 1.0 / self.options.density;
        let piece = task.settled((&creases, length), check, self.options.on_failure, &mut tell);
        self.left -= piece.positions.len();
        for t in &piece.triangles {
            for k in 0..3 {
                let ends = [t[k], t[(k + 1) % 3]].map(|v| v as usize);
                if ends.iter().all(|&v| v < edges) {
                    let [a, b] = ends.map(|v| surroundings.ids[v]);
                    self.made.insert(edge(a, b));
                }
            }
        }
        piece
    }

    /// The creases at a loop, if there are some, and the surroundings in which they were followed.
    fn creases(
        &mut self,
        around: &Surroundings,
        loops: &[&BoundaryLoop],
    ) -> (Option<Surroundings>, Vec<BoundaryCrease>) {
        let is_faired = loops.len() == 1 && self.options.unfaired(around).is_none();
        if !is_faired
            || !around.guides.is_empty()
            || !around.may_be_creased(&local_options(around, self.fairing))
        {
            return (None, Vec::new());
        }
        let layers = (LAYERS_OF_CREASES, &mut self.place[..]);
        let mut wide = Surroundings::with_layers(self.links, self.positions, loops, layers);
        wide.taken.clone_from(&around.taken);
        let creases = wide.creases(&local_options(&wide, self.fairing));
        let wide = (!creases.is_empty()).then_some(wide);
        (wide, creases)
    }

    /// Edges that patches on touching loops have made are taken, too.
    fn add_made(&self, surroundings: &mut Surroundings) {
        let boundary = surroundings.loop_vertices as u32;
        let touching = |v: &u32| self.made.iter().any(|e| e.0 == *v || e.1 == *v);
        let common: Vec<u32> = (0..boundary)
            .filter(|&i| touching(&surroundings.ids[i as usize]))
            .collect();
        for (k, &i) in common.iter().enumerate() {
            for &j in &common[k + 1..] {
                let (a, b) = (surroundings.ids[i as usize], surroundings.ids[j as usize]);
                if self.made.contains(&edge(a, b)) {
                    surroundings.taken.push((i, j));
                }
            }
        }
        surroundings.taken.sort_unstable();
        surroundings.taken.dedup();
    }
}

fn edge(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}
