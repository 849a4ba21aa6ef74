//! The public entry: all holes of a mesh, one after the other.

use std::collections::HashSet;
use std::ops::ControlFlow;
use std::time::Instant;

use super::crossing::{Neighbours, Owned};
use super::loops::{BoundaryLoop, Links, LoopKind};
use super::outcome::{FillOutcome, LoopReport, OpenReason, renumber};
use super::parents::Parents;
use super::piece::{Piece, Task};
use super::surroundings::Surroundings;
use super::units::local_options;
use crate::error::Error;
use crate::fairing::{
    Intersections, Options, Progress, ProgressCallback, SelfIntersections, Workers, check_loops, in_given,
    joined_options,
};
use crate::mesh::{Joined, NONE};

/// Which loops are filled.
#[derive(Debug, Clone, PartialEq)]
pub enum Loops {
    /// All holes of at most this many edges; outer boundaries stay open.
    UpTo(usize),
    /// These, by their numbers in [`boundary_loops`](super::boundary_loops), outer boundaries included.
    Chosen(Vec<usize>),
}

/// What is asked. `FillOptions::default()` is right for most uses.
#[derive(Debug, Clone, PartialEq)]
pub struct FillOptions {
    /// Which loops. Default: all holes of whatever size.
    pub loops: Loops,
    /// How dense the new vertices are, Liepa's factor as in CGAL: at the default, the square root of 2, edges are as
    /// long as those of the mesh beside the boundary; at twice that, half as long. Between 0.1 and 10.
    pub density: f64,
    /// At most this many new vertices in all. Where they do not suffice, patches become coarser away from their boundaries.
    /// Smaller loops are served first. Default 200,000. No loop of n edges gets more than 1,000 + n² of them, times the
    /// square of a density above 1: a round hole takes a tenth.
    pub max_new_vertices: usize,
    /// Whether the patches are faired. Default: yes.
    pub fair: bool,
    /// For the fairing. Boundary normals are those of the mesh's vertices on the loops; no patch gets more than 64 iterations.
    /// Its `coincident` holds for the whole mesh: loops are those of the joined mesh, and new triangles name of each vertex the
    /// copy in the triangle beside them.
    pub fairing: Options,
}

/// See [`FillOptions::max_new_vertices`].
fn largest_patch(edges: usize, density: f64) -> usize {
    1_000 + (edges as f64 * density.max(1.0)).powi(2).round() as usize
}

impl FillOptions {
    /// Checks the ranges of all options, those of the fairing included.
    ///
    /// # Errors
    /// [`Error::BadOption`], which names the option.
    pub fn validate(&self) -> Result<(), Error> {
        check_density(self.density)?;
        self.fairing.validate()
    }
}

impl Default for FillOptions {
    fn default() -> Self {
        Self {
            loops: Loops::UpTo(usize::MAX),
            density: std::f64::consts::SQRT_2,
            max_new_vertices: 200_000,
            fair: true,
            fairing: Options::default(),
        }
    }
}

/// The filled mesh.
#[derive(Debug, Clone)]
pub struct Filled {
    /// The positions given, then the new ones.
    pub positions: Vec<[f64; 3]>,
    /// The triangles given, then the new ones.
    pub triangles: Vec<[u32; 3]>,
    /// Per new vertex where it comes from.
    pub parents: Vec<Parents>,
    /// Per loop of the mesh (or per loop chosen) what became of it.
    pub loops: Vec<LoopReport>,
}

/// Fills holes of a triangle mesh: triangulates, refines and fairs each. `positions` is #V by 3, `triangles` #T by 3,
/// counter-clockwise seen from the side that normals point to.
///
/// Original vertices and triangles keep their numbers and bits. A loop that cannot be filled, or not well, says so in its
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
    run(positions, triangles, options, None)
}

/// [`fill_holes`], which calls `progress` on the calling thread, with the fraction of all loops. `Break` stops the run: the
/// loops that are not done stay open.
///
/// ```
/// use std::ops::ControlFlow;
/// use fairmesh::{FillOptions, FillOutcome, OpenReason, fill_holes_with_progress};
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
    run(positions, triangles, options, Some(progress))
}

fn run<'a>(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    options: &'a FillOptions,
    progress: Option<&'a mut ProgressCallback<'a>>,
) -> Result<Filled, Error> {
    options.validate()?;
    let joined = Joined::new(positions, triangles, options.fairing.coincident)?;
    let fairing = joined_options(&joined.copies, &options.fairing);
    let links = Links::new(positions.len(), &joined.triangles)?;
    let loops = links.loops(positions);
    let (numbers, named) = choose(options, loops.len())?;
    let on_loops = numbers.iter().flat_map(|&l| loops[l].vertices.iter().copied());
    check_loops(&fairing.loop_continuity, on_loops)
        .map_err(|error| in_given(error, &joined.copies, &options.fairing))?;
    let mut order: Vec<usize> = (0..numbers.len()).collect();
    order.sort_by_key(|&i| loops[numbers[i]].vertices.len());
    let total: usize = numbers.iter().map(|&l| loops[l].vertices.len()).sum();
    let is_checked = options.fairing.intersections == Intersections::Check;
    let chosen = numbers.iter().map(|&l| &loops[l]);
    let workers = Workers::new(options.fairing.threads)?;
    let mut run = Run {
        positions,
        neighbours: is_checked
            .then(|| workers.install(|| Neighbours::new(positions, &joined.triangles, chosen))),
        workers: &workers,
        links: &links,
        place: vec![NONE; triangles.len()],
        made: HashSet::new(),
        left: options.max_new_vertices,
        options,
        fairing: &fairing,
        progress,
        named,
        done: 0.0,
        total: total as f64,
        cancelled: false,
    };
    let mut pieces: Vec<Option<(Piece, f64)>> = numbers.iter().map(|_| None).collect();
    for i in order {
        let clock = Instant::now();
        let boundary = &loops[numbers[i]];
        let mut piece = run.fill(i, boundary);
        if !joined.copies.is_empty() {
            piece.name_copies(&boundary.copies(triangles));
        }
        run.done += boundary.vertices.len() as f64;
        pieces[i] = Some((piece, clock.elapsed().as_secs_f64()));
    }
    let mut filled = Filled {
        positions: positions.to_vec(),
        triangles: triangles.to_vec(),
        parents: Vec::new(),
        loops: Vec::with_capacity(numbers.len()),
    };
    let mut pieces: Vec<(Piece, f64)> = pieces.into_iter().flatten().collect();
    tell_both(&mut pieces);
    let crossings = crossings(&pieces, triangles.len() as u32);
    for ((index, (piece, seconds)), pairs) in numbers.into_iter().zip(pieces).zip(crossings) {
        let edges = loops[index].vertices.len();
        filled.append(piece, index, edges, seconds);
        if let Some(report) = filled.loops.last_mut() {
            report.self_intersections = pairs;
        }
    }
    Ok(filled)
}

/// Where a patch intersects one made earlier, that one says so, too.
fn tell_both(pieces: &mut [(Piece, f64)]) {
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
fn crossings(pieces: &[(Piece, f64)], count: u32) -> Vec<Vec<[u32; 2]>> {
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
    let numbered = |(piece, _): &(Piece, f64)| {
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

pub(super) fn check_density(density: f64) -> Result<(), Error> {
    let allowed = (0.1..=10.0).contains(&density);
    Error::check_option("density", density, allowed, "between 0.1 and 10")
}

/// The loops to be looked at, ascending, and whether they were named.
fn choose(options: &FillOptions, count: usize) -> Result<(Vec<usize>, bool), Error> {
    match &options.loops {
        Loops::UpTo(_) => Ok(((0..count).collect(), false)),
        Loops::Chosen(list) => {
            if let Some(&index) = list.iter().find(|&&l| l >= count) {
                return Err(Error::SelectionOutOfRange { index, count });
            }
            let mut list = list.clone();
            list.sort_unstable();
            list.dedup();
            Ok((list, true))
        }
    }
}

struct Run<'m, 'o> {
    positions: &'m [[f64; 3]],
    /// What patches may intersect; none if they are not checked.
    neighbours: Option<Neighbours<'m>>,
    workers: &'m Workers,
    links: &'m Links<'m>,
    /// Scratch of [`Surroundings`].
    place: Vec<u32>,
    /// Edges between original vertices that earlier patches made.
    made: HashSet<(u32, u32)>,
    /// New vertices that may still be made.
    left: usize,
    options: &'o FillOptions,
    /// In the joined mesh's numbers.
    fairing: &'m Options,
    progress: Option<&'o mut ProgressCallback<'o>>,
    named: bool,
    /// Edges of loops done, and of all.
    done: f64,
    total: f64,
    cancelled: bool,
}

impl Run<'_, '_> {
    /// What speaks against filling a loop, known before the work.
    fn objection(&self, boundary: &BoundaryLoop) -> Option<OpenReason> {
        if let LoopKind::NonManifold { a, b } = boundary.kind {
            return Some(OpenReason::NonManifold { a, b });
        }
        if self.cancelled {
            return Some(OpenReason::Cancelled);
        }
        if let Loops::UpTo(most) = self.options.loops
            && boundary.vertices.len() > most
        {
            return Some(OpenReason::TooManyEdges);
        }
        (boundary.kind == LoopKind::OuterBoundary && !self.named).then_some(OpenReason::OuterBoundary)
    }

    /// Fills a loop, which is number `i` among those asked for.
    fn fill(&mut self, i: usize, boundary: &BoundaryLoop) -> Piece {
        if let Some(reason) = self.objection(boundary) {
            return Piece::open(reason);
        }
        let mut surroundings = Surroundings::new(self.links, self.positions, boundary, &mut self.place);
        if let Some(vertex) = surroundings.first_unusable() {
            return Piece::open(OpenReason::NotFinite { vertex });
        }
        if !boundary.touching.is_empty() {
            self.add_made(&mut surroundings);
        }
        let (done, total) = (
            self.done / self.total,
            boundary.vertices.len() as f64 / self.total,
        );
        let callback = &mut self.progress;
        let (mut cancelled, mut reached) = (false, 0.0_f64);
        let mut tell = |progress: &Progress| {
            // Who has asked to stop is not asked again.
            if cancelled {
                return ControlFlow::Break(());
            }
            let Some(callback) = callback else {
                return ControlFlow::Continue(());
            };
            // A patch may be faired more than once.
            reached = reached.max(progress.fraction);
            let answer = callback(&Progress {
                fraction: done + total * reached,
                ..*progress
            });
            cancelled |= answer.is_break();
            answer
        };
        let task = Task {
            surroundings: &surroundings,
            factor: std::f64::consts::SQRT_2 / self.options.density,
            most: self
                .left
                .min(largest_patch(boundary.vertices.len(), self.options.density)),
            fair: self.options.fair,
            options: local_options(&surroundings, self.fairing),
            precision: self.options.fairing.output_precision,
        };
        let mut piece = task.run(&mut tell);
        self.cancelled = cancelled;
        if cancelled {
            return Piece::open(OpenReason::Cancelled);
        }
        if let Some(neighbours) = &mut self.neighbours {
            piece = self.workers.install(|| neighbours.settle(i, &task, piece));
        }
        self.left -= piece.positions.len();
        let boundary_count = boundary.vertices.len() as u32;
        for t in &piece.triangles {
            for k in 0..3 {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                if a < boundary_count && b < boundary_count {
                    self.made
                        .insert(edge(boundary.vertices[a as usize], boundary.vertices[b as usize]));
                }
            }
        }
        piece
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

impl Filled {
    /// Appends a piece and its report.
    fn append(&mut self, piece: Piece, index: usize, edges: usize, seconds: f64) {
        let (vertex, triangle) = (self.positions.len() as u32, self.triangles.len() as u32);
        let boundary = piece.boundary.len() as u32;
        let number = |v: u32| {
            if v < boundary {
                piece.boundary[v as usize]
            } else {
                vertex + (v - boundary)
            }
        };
        self.positions.extend(&piece.positions);
        self.triangles
            .extend(piece.triangles.iter().map(|t| t.map(number)));
        self.parents.extend(&piece.parents);
        let mut fairing = piece.fairing;
        if let Some(report) = &mut fairing {
            let (known, known_triangles) = (&piece.known, &piece.known_triangles);
            renumber(
                report,
                |v| {
                    let known_count = known.len() as u32;
                    known
                        .get(v as usize)
                        .copied()
                        .unwrap_or_else(|| vertex + v - known_count)
                },
                |t| {
                    let known_count = known_triangles.len() as u32;
                    let known = known_triangles.get(t as usize).copied();
                    known.unwrap_or_else(|| triangle + t - known_count)
                },
            );
        }
        self.loops.push(LoopReport {
            index,
            edges,
            outcome: piece.outcome,
            vertices: vertex..self.positions.len() as u32,
            triangles: triangle..self.triangles.len() as u32,
            fairing,
            worst_angle: piece.worst_angle,
            outside: piece.outside.iter().map(|&i| vertex + i).collect(),
            coarsened: piece.coarsened,
            self_intersections: Vec::new(),
            seconds,
        });
    }
}
