//! A bridge: a strip between two runs of boundary edges.
//!
//! Its sides are curves that leave the mesh tangentially. They are the rest of the boundary of one more patch, with given
//! normals; all else is done as for a hole.

use std::ops::ControlFlow;

use super::bridge_chains::Chains;
use super::bridge_strip::Strip;
use super::bridged::Bridged;
use super::fill::fill_within;
use super::fill_progress::FillProgress;
use super::links::Links;
use super::loops::{BoundaryLoop, LoopKind, boundary_loops_joined};
use super::options::{FillOptions, Join, Loops};
use super::outcome::{FillOutcome, LoopReport};
use super::parents::compose;
use super::rim::Rim;
use crate::fairing::{Outcome, Progress, ProgressCallback, Selection, fair_within, on_workers};
use crate::mesh::Joined;
use crate::support::error::Error;
use crate::support::options::options;

/// Once the mesh is read, the progress has three parts of equal length where the rest is filled: the strip, the rest, all that is new together.
const THIRD: f64 = 1.0 / 3.0;

options! {
    /// What is asked of [`bridge`].
    #[derive(Debug, Clone, PartialEq)]
    BridgeOptions {
        /// How long the chains shall be: each is made longer or shorter about its middle along its loop, to the vertices where that is met
        /// best. Default: they are as given.
        width: Option<f64> = None, real "length" in f64::MIN_POSITIVE..f64::INFINITY, "positive";
        /// Whether holes that the strip leaves beside it are filled, and all new vertices, the strip's included, faired together.
        /// Default: no.
        fill: bool = false, flag;
        /// The density, the number of new vertices, what becomes of failures, and the fairing. Its `loops`, `join`, `guides` and `rim` are
        /// not looked at.
        filling: FillOptions = FillOptions::default(), elsewhere;
    }
}

impl BridgeOptions {
    /// Checks the ranges of all options.
    ///
    /// # Errors
    /// [`Error::BadOption`], which names the option.
    pub fn validate(&self) -> Result<(), Error> {
        self.check_ranges()?;
        self.filling.validate()
    }
}

/// Connects two runs of boundary edges by a strip that is tangent to the mesh at both and faired. Each chain is given by its vertices, in
/// either order: at least two, or one if [`BridgeOptions::width`] is given. They may be on one loop or on two, and have no vertex in
/// common.
///
/// The sides of the strip are curves that leave the mesh tangentially at both ends, with normals that turn from those of the mesh at one end
/// to those at the other. On one loop the strip divides the hole; on two it joins the parts.
///
/// ```
/// use fairmesh::{BridgeOptions, FillOutcome, bridge};
/// // Two plates of three squares side by side, one edge apart.
/// let plate = |x: f64| (0..8).map(move |i| [x + f64::from(i % 2), f64::from(i / 2), 0.0]);
/// let positions: Vec<[f64; 3]> = plate(0.0).chain(plate(2.0)).collect();
/// let squares = |first: u32| (0..3).flat_map(move |j| {
///     let a = first + 2 * j;
///     [[a, a + 1, a + 3], [a, a + 3, a + 2]]
/// });
/// let triangles: Vec<[u32; 3]> = squares(0).chain(squares(8)).collect();
/// // The middle edge of either.
/// let bridged = bridge(&positions, &triangles, [&[3, 5], &[10, 12]], &BridgeOptions::default())?;
/// assert_eq!(bridged.strip.outcome, FillOutcome::Faired);
/// assert!(bridged.positions.iter().all(|p| p[2].abs() < 1e-12)); // still plane
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// A strip whose ends face opposite ways is not made: its report says [`OpenReason::OppositeSides`](super::OpenReason::OppositeSides).
///
/// # Errors
/// [`Error::BadChain`], which names the chain and a vertex, [`Error::BadOption`], also where the sides of the strip alone need more
/// vertices than may be made, [`Error::IndexOutOfRange`], [`Error::TooLarge`],
/// [`Error::NoNormal`] where the mesh's triangles at a chain have no area.
pub fn bridge(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    chains: [&[u32]; 2],
    options: &BridgeOptions,
) -> Result<Bridged, Error> {
    bridged(positions, triangles, chains, options, None)
}

/// [`bridge`], which calls `progress` on the calling thread. `Break` stops the run: what is not done is left open.
///
/// # Errors
/// Those of [`bridge`].
pub fn bridge_with_progress(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    chains: [&[u32]; 2],
    options: &BridgeOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<Bridged, Error> {
    bridged(positions, triangles, chains, options, Some(progress))
}

fn bridged(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    chains: [&[u32]; 2],
    options: &BridgeOptions,
    progress: Option<&mut ProgressCallback<'_>>,
) -> Result<Bridged, Error> {
    options.validate()?;
    on_workers(options.filling.fairing.threads, progress, |progress| {
        run(positions, triangles, chains, options, progress)
    })
}

fn run(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    chains: [&[u32]; 2],
    options: &BridgeOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<Bridged, Error> {
    let filling = &options.filling;
    let joined = Joined::new(positions, triangles, filling.fairing.coincident)?;
    let links = Links::new(positions.len(), &joined.triangles)?;
    let loops = links.loops(positions, filling.fairing.coincident);
    let lookup = Chains {
        copies: &joined.copies,
        positions,
        loops: &loops,
    };
    let ends = lookup.resolved(chains, options.width)?;
    let strip = Strip::new(&links, positions, &ends, filling)?;
    let edges = strip.boundary_edges();
    let work = FillProgress::new(triangles.len(), filling.density, std::iter::once(edges));
    let _ = progress(&work.loops_known());
    let (read, left) = work.share(edges);
    let mut progress = part(progress, read, left);
    let share = if options.fill { THIRD } else { 1.0 };
    let mut bridged = {
        let mut tell = part(&mut progress, 0.0, share);
        strip.make(&joined, triangles, filling, &mut tell)?
    };
    let is_there = !matches!(bridged.strip.outcome, FillOutcome::LeftOpen(_));
    if options.fill && is_there {
        bridged.fill_rest(positions.len() as u32, &strip, filling, &mut progress)?;
    }
    Ok(bridged)
}

/// A part of the whole run's progress.
fn part<'p, 'c>(
    progress: &'p mut ProgressCallback<'c>,
    from: f64,
    share: f64,
) -> impl FnMut(&Progress) -> ControlFlow<()> + Send + use<'p, 'c> {
    move |of: &Progress| {
        progress(&Progress {
            fraction: from + share * of.fraction,
            ..*of
        })
    }
}

impl Bridged {
    /// Fills the holes that the strip leaves beside it, and fairs all that is new together.
    fn fill_rest(
        &mut self,
        old: u32,
        strip: &Strip<'_>,
        filling: &FillOptions,
        progress: &mut ProgressCallback<'_>,
    ) -> Result<(), Error> {
        let coincident = filling.fairing.coincident;
        let loops = boundary_loops_joined(&self.positions, &self.triangles, coincident)?;
        let is_beside =
            |of: &BoundaryLoop| of.kind == LoopKind::Hole && of.vertices.iter().any(|v| *v >= old);
        let beside: Vec<usize> = (0..loops.len()).filter(|&l| is_beside(&loops[l])).collect();
        if beside.is_empty() {
            return Ok(());
        }
        let options = FillOptions {
            loops: Loops::Chosen(beside),
            join: Join::None,
            guides: Vec::new(),
            max_new_vertices: filling.max_new_vertices.saturating_sub(self.parents.len()),
            fairing: strip.with_normals(&filling.fairing),
            rim: Rim::default(),
            ..filling.clone()
        };
        let filled = {
            let mut tell = part(progress, THIRD, THIRD);
            fill_within(&self.positions, &self.triangles, &options, &mut tell)?
        };
        let first = self.parents.len();
        self.parents.extend(&filled.parents);
        compose(&mut self.parents, old as usize, first);
        (self.positions, self.triangles) = (filled.positions, filled.triangles);
        self.rest = filled.loops;
        let is_open = |of: &LoopReport| matches!(of.outcome, FillOutcome::LeftOpen(_));
        if !filling.fair || self.rest.iter().all(is_open) {
            return Ok(());
        }
        let mut is_free = vec![false; self.positions.len()];
        is_free[old as usize..].fill(true);
        for of in boundary_loops_joined(&self.positions, &self.triangles, coincident)? {
            of.vertices.iter().for_each(|&v| is_free[v as usize] = false);
        }
        let free: Vec<u32> = (old..is_free.len() as u32)
            .filter(|&v| is_free[v as usize])
            .collect();
        let options = strip.with_normals(&filling.fairing);
        let mut tell = part(progress, 2.0 * THIRD, THIRD);
        let selection = Selection::Vertices(&free);
        match fair_within(&self.positions, &self.triangles, selection, &options, &mut tell) {
            Ok(solution) => {
                if solution.report.outcome == Outcome::Converged {
                    self.positions = solution.positions;
                }
                self.whole = Some(solution.report);
                Ok(())
            }
            // What is around is defective somewhere; the strip and the patches have reports of their own.
            Err(_) => Ok(()),
        }
    }
}
