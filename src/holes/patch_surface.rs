//! One patch, for one loop or several: from the triangulation to the faired surface.
//!
//! The triangulation of a large hole is far from the surface that it becomes, and edges of the right length there would be
//! too long on it. So a coarse patch is faired first, loosely, and the fine one is refined on that.

use nalgebra::Vector3;

use crate::fairing::{
    BoundaryNormals, Options, Outcome, OutputPrecision, Progress, ProgressCallback, Report, Selection,
    Solution, fair_within,
};
use crate::holes::local_frame::{first_of_loops, in_units};
use crate::holes::outcome::{FillOutcome, FlatReason, OpenReason};
use crate::holes::parents::{Parents, parents};
use crate::holes::patch::Patch;
use crate::holes::refine::{Fineness, Refiner};
use crate::holes::rounding::Rounded;
use crate::holes::surroundings::{Surroundings, bounds};
use crate::holes::triangle_owner::Owned;
use crate::support::error::Error;

/// The fraction of the progress at which the coarse patch is faired: its share of the time, measured.
/// Half or double, of 41 cases: only the progress changes.
pub(super) const COARSE_SHARE: f64 = 0.1;
/// The fraction of the progress at which the patch is refined.
/// Half or double, of 40 cases: only the progress changes.
const REFINED: f64 = 0.4;
/// A patch may leave the boundary's bounding box by this much of its diagonal without being named.
/// Of 41 cases, half: 2 change, 1 get another triangulation; double: 4 change, -3 % iterations.
const ROOM: f64 = 0.25;
/// A patch whose smallest angle (degrees) is below this is refined and faired once more.
/// Of 40 cases, half: 1 changes, 1 get another triangulation; double: 4 change, 3 get another triangulation.
const ENOUGH: f64 = 15.0;

/// No fair surface was found.
pub(super) fn is_failed(report: &Report) -> bool {
    !report.outcome.is_tolerance_met()
}

/// A filled loop, or several joined, in numbers of its own: the boundary's vertices, then the new ones.
pub(super) struct PatchSurface {
    pub(super) outcome: FillOutcome,
    /// The mesh's numbers of the boundary's vertices.
    pub(super) boundary: Vec<u32>,
    /// New vertices, in the caller's units.
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) parents: Vec<Parents>,
    /// In the numbers of the mesh that was faired: `known` vertices and triangles, then the new ones.
    pub(super) fairing: Option<Report>,
    pub(super) known: Vec<u32>,
    pub(super) known_triangles: Vec<u32>,
    pub(super) worst_angle: f64,
    /// New vertices (from 0) that the loop's box does not hold.
    pub(super) outside: Vec<u32>,
    pub(super) coarsened: bool,
    /// See [`LoopReport::normals_reached`](crate::holes::LoopReport::normals_reached).
    pub(super) normals_reached: f64,
    /// Pairs of triangles that intersect, one of each the piece's own.
    pub(super) crossings: Vec<[Owned; 2]>,
}

impl PatchSurface {
    pub(super) fn open(reason: OpenReason) -> Self {
        Self {
            outcome: FillOutcome::LeftOpen(reason),
            boundary: Vec::new(),
            positions: Vec::new(),
            triangles: Vec::new(),
            parents: Vec::new(),
            fairing: None,
            known: Vec::new(),
            known_triangles: Vec::new(),
            worst_angle: 0.0,
            outside: Vec::new(),
            coarsened: false,
            normals_reached: 1.0,
            crossings: Vec::new(),
        }
    }

    pub(super) fn is_open(&self) -> bool {
        matches!(self.outcome, FillOutcome::LeftOpen(_))
    }

    /// Faired, with triangles that are sound and intersect nothing; or with nothing to be faired.
    pub(super) fn is_sound(&self) -> bool {
        let is_poor = |report: &Report| report.outcome.has_poor_triangles();
        self.is_fair() && self.crossings.is_empty() && !self.fairing.as_ref().is_some_and(is_poor)
    }

    /// Faired, or not asked to be.
    pub(super) fn is_fair(&self) -> bool {
        match &self.outcome {
            FillOutcome::LeastBending | FillOutcome::LeftOpen(_) => false,
            FillOutcome::Flat { reason } => reason.is_as_asked(),
            _ => true,
        }
    }

    /// Faired without reservation.
    fn is_clean(&self) -> bool {
        let fairing = self.fairing.as_ref();
        self.outcome == FillOutcome::Faired
            && fairing.is_some_and(|report| matches!(report.outcome, Outcome::Converged))
    }

    /// The larger the better.
    fn rank(&self) -> [bool; 3] {
        [self.is_clean(), self.is_fair(), !self.is_open()]
    }

    fn is_nearest_member(&self) -> bool {
        let fairing = self.fairing.as_ref();
        fairing.is_some_and(|report| matches!(report.outcome, Outcome::NearestMember { .. }))
    }

    /// Takes these copies for the boundary's vertices.
    pub(super) fn name_copies(&mut self, copies: &[u32]) {
        if self.boundary.is_empty() {
            return;
        }
        let mut of: Vec<(u32, u32)> = self
            .boundary
            .iter()
            .copied()
            .zip(copies.iter().copied())
            .collect();
        of.sort_unstable();
        for v in self.parents.iter_mut().flat_map(|parents| &mut parents.vertices) {
            if let Ok(i) = of.binary_search_by_key(v, |pair| pair.0) {
                *v = of[i].1;
            }
        }
        self.boundary.copy_from_slice(copies);
    }
}

/// How a patch is laid out before it is refined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Layout {
    /// Rows along a spine, between the ends of a tube.
    Swept,
    /// A triangulation without new vertices, faired loosely,
    First,
    /// and by another measure.
    Other,
}

/// What is to be done with a loop, or with several.
pub(super) struct Task<'a> {
    pub(super) surroundings: &'a Surroundings,
    /// Wanted edge length over that of the surroundings.
    pub(super) factor: f64,
    pub(super) most: usize,
    /// Why the triangulation stays as it is; none where it is faired.
    pub(super) unfaired: Option<FlatReason>,
    /// As [`local_options`](crate::holes::local_frame::local_options) gives them.
    pub(super) options: Options,
    /// What the mesh will be written in.
    pub(super) precision: OutputPrecision,
}

/// Tells between two parts of the work, and says whether that stops it.
fn is_stopped_at(tell: &mut ProgressCallback<'_>, fraction: f64) -> bool {
    tell(&Progress {
        fraction,
        iterations: 0,
        step: f64::NAN,
        phase: "triangulation",
    })
    .is_break()
}

impl Task<'_> {
    pub(super) fn run(&self, tell: &mut ProgressCallback<'_>) -> PatchSurface {
        let mut best: Option<PatchSurface> = None;
        for &layout in self.layouts() {
            let piece = self.run_on(layout, tell);
            let is_over = matches!(piece.outcome, FillOutcome::LeftOpen(OpenReason::Cancelled));
            // A pipe that bends by another equation is rather what is meant than films with a thread between them.
            let is_enough = piece.is_clean() || layout == Layout::Swept && piece.is_nearest_member();
            if is_over || is_enough || self.unfaired.is_some() && !piece.is_open() {
                return piece;
            }
            if best.as_ref().is_none_or(|best| piece.rank() > best.rank()) {
                best = Some(piece);
            }
        }
        best.unwrap_or_else(|| PatchSurface::open(OpenReason::NoTriangulation))
    }

    fn run_on(&self, layout: Layout, tell: &mut ProgressCallback<'_>) -> PatchSurface {
        let Some((coarse, mut patch)) = self.laid_out(layout) else {
            return PatchSurface::open(OpenReason::NoTriangulation);
        };
        if let Some(reason) = self.unfaired.clone() {
            let coarsened = !self.refine(&mut patch);
            return self.piece(&coarse, patch, FillOutcome::Flat { reason }, None, coarsened);
        }
        if is_stopped_at(tell, 0.0) {
            return PatchSurface::open(OpenReason::Cancelled);
        }
        match (layout, self.is_joint()) {
            (Layout::Swept, _) => {}
            (_, true) => self.shape_joint(&mut patch, tell),
            (_, false) => self.shape(&mut patch, tell),
        }
        if is_stopped_at(tell, COARSE_SHARE) {
            return PatchSurface::open(OpenReason::Cancelled);
        }
        let coarsened = !self.refine_telling(&mut patch, &mut |fraction| {
            // Who stops it is seen to where the refinement ends.
            let _ = is_stopped_at(tell, COARSE_SHARE + (REFINED - COARSE_SHARE) * fraction);
        });
        if is_stopped_at(tell, REFINED) {
            return PatchSurface::open(OpenReason::Cancelled);
        }
        if patch.x.len() == patch.fixed {
            let reason = FlatReason::NoInnerVertex;
            return self.piece(&coarse, patch, FillOutcome::Flat { reason }, None, coarsened);
        }
        let mut last = |p: &Progress| {
            tell(&Progress {
                fraction: REFINED + (1.0 - REFINED) * p.fraction,
                ..*p
            })
        };
        let mut best = match self.faired(&patch, &self.options, &mut last) {
            Ok(solution) => (patch, solution),
            Err(error) => return self.flat(&coarse, FlatReason::Refused(self.in_mesh(error)), None),
        };
        let report = &best.1.report;
        let left = self.options.max_iterations.saturating_sub(report.iterations);
        let is_enough = report.quality.worst_angle >= ENOUGH;
        if !is_enough && report.outcome != Outcome::Cancelled && left > 0 {
            best = self.again(&best.0, &best.1, left, &mut last).unwrap_or(best);
        }
        self.judge(&coarse, best.0, best.1, coarsened)
    }

    /// Mends a faired patch where it lies now, and fairs it again in at most so many iterations; None if its worst angle is
    /// no better.
    fn again(
        &self,
        patch: &Patch,
        solution: &Solution,
        max_iterations: usize,
        tell: &mut ProgressCallback<'_>,
    ) -> Option<(Patch, Solution)> {
        let inner = self.inner(solution);
        if is_failed(&solution.report) || !self.outside(&inner).is_empty() {
            return None;
        }
        let mut patch = patch.clone();
        patch.x[patch.fixed..].copy_from_slice(&inner);
        let fineness = self.fineness(0.0);
        Refiner::new(&mut patch, fineness, &self.surroundings.taken).run_again();
        let options = Options {
            max_iterations,
            ..self.options.clone()
        };
        let again = self.faired(&patch, &options, tell).ok()?;
        let better = again.report.quality.worst_angle > solution.report.quality.worst_angle;
        (better && !is_failed(&again.report)).then_some((patch, again))
    }

    /// The triangulation, refined, in place of a surface that is no success; as it is where it is that already.
    pub(super) fn flattened(&self, piece: PatchSurface) -> PatchSurface {
        if matches!(piece.outcome, FillOutcome::Flat { .. }) {
            return piece;
        }
        match self.triangulate(false, None) {
            Some(coarse) => {
                let report = piece.fairing.map(|report| self.of_another_patch(report));
                let mut flat = self.flat(&coarse, FlatReason::Unsound, None);
                flat.fairing = report;
                flat
            }
            None => piece,
        }
    }

    /// Patches for a loop whose first one intersects something, none of them faired: that of the same triangulation, of the one
    /// that avoids what it may meet, and of another one; first refined, then without new vertices.
    pub(super) fn other_means<'t>(
        &'t self,
        first: &PatchSurface,
        avoiding: Option<&'t Patch>,
    ) -> impl Iterator<Item = PatchSurface> + use<'t> {
        let (reason, report) = match &first.outcome {
            FillOutcome::Flat { reason } => (reason.clone(), first.fairing.clone()),
            _ => (FlatReason::Intersecting, None),
        };
        let same = || self.triangulate(false, None);
        let other = || self.triangulate(true, None);
        let means = [true, false].into_iter().flat_map(move |is_refined| {
            let coarse = [same(), avoiding.cloned(), other()];
            coarse.into_iter().map(move |coarse| (coarse, is_refined))
        });
        means.filter_map(move |(coarse, is_refined)| {
            let coarse = coarse?;
            let mut patch = coarse.clone();
            let coarsened = is_refined && !self.refine(&mut patch);
            let reason = reason.clone();
            let mut piece = self.piece(&coarse, patch, FillOutcome::Flat { reason }, None, coarsened);
            piece.fairing.clone_from(&report);
            Some(piece)
        })
    }

    pub(super) fn is_joint(&self) -> bool {
        self.surroundings.loops().count() > 1
    }

    pub(super) fn fineness(&self, growth: f64) -> Fineness {
        Fineness {
            factor: self.factor,
            growth,
            most: self.most,
        }
    }

    /// The surroundings with the patch in them, faired.
    pub(super) fn faired(
        &self,
        patch: &Patch,
        options: &Options,
        tell: &mut ProgressCallback<'_>,
    ) -> Result<Solution, Error> {
        let around = self.surroundings;
        let (n, known) = (around.loop_vertices as u32, around.x.len() as u32);
        let all = around.x.iter().chain(&patch.x[patch.fixed..]);
        let positions: Vec<[f64; 3]> = all.map(|&p| p.into()).collect();
        let number = |v: u32| if v < n { v } else { known + (v - n) };
        let mut triangles = around.triangles.clone();
        triangles.extend(patch.triangles.iter().map(|t| t.map(number)));
        let free: Vec<u32> = (known..positions.len() as u32).collect();
        let selection = Selection::Vertices(&free);
        fair_within(&positions, &triangles, selection, options, tell)
    }

    /// The new vertices of a solution.
    pub(super) fn inner(&self, solution: &Solution) -> Vec<Vector3<f64>> {
        let new = &solution.positions[self.surroundings.x.len()..];
        new.iter().map(|&p| Vector3::from(p)).collect()
    }

    /// Which vertices the box of the loops, grown by [`ROOM`], does not hold.
    pub(super) fn outside(&self, inner: &[Vector3<f64>]) -> Vec<u32> {
        let (low, high) = bounds(&self.surroundings.x[..self.surroundings.loop_vertices]);
        let room = Vector3::repeat(ROOM * (high - low).norm());
        let (low, high) = (low - room, high + room);
        let is_inside = |p: &Vector3<f64>| (0..3).all(|k| p[k] >= low[k] && p[k] <= high[k]);
        (0..)
            .zip(inner)
            .filter(|(_, p)| !is_inside(p))
            .map(|(i, _)| i)
            .collect()
    }

    /// Keeps the faired patch, unless it is neither fair nor sound.
    pub(super) fn judge(
        &self,
        coarse: &Patch,
        mut patch: Patch,
        solution: Solution,
        coarsened: bool,
    ) -> PatchSurface {
        let inner = self.inner(&solution);
        let report = solution.report;
        let is_wild = !self.outside(&inner).is_empty() || !report.quality.flipped.is_empty();
        let outcome = FillOutcome::of_fairing(&report.outcome, is_wild);
        if let FillOutcome::Flat { reason } = outcome {
            return self.flat(coarse, reason, Some(report));
        }
        patch.x[patch.fixed..].copy_from_slice(&inner);
        self.piece(coarse, patch, outcome, Some(report), coarsened)
    }

    /// The triangulation, refined.
    fn flat(&self, coarse: &Patch, reason: FlatReason, report: Option<Report>) -> PatchSurface {
        let mut patch = coarse.clone();
        let coarsened = !self.refine(&mut patch);
        let firsts = first_of_loops(&patch, self.surroundings);
        let told = |report| in_units(self.of_another_patch(report), self.surroundings, &firsts);
        let fairing = report.map(told);
        PatchSurface {
            fairing,
            ..self.piece(coarse, patch, FillOutcome::Flat { reason }, None, coarsened)
        }
    }

    /// A report without the numbers that are those of another patch.
    fn of_another_patch(&self, mut report: Report) -> Report {
        report.quality.flipped.clear();
        report.quality.needles.clear();
        report.quality.worst_triangle = self.surroundings.triangles.len();
        report
    }

    fn piece(
        &self,
        coarse: &Patch,
        patch: Patch,
        outcome: FillOutcome,
        fairing: Option<Report>,
        coarsened: bool,
    ) -> PatchSurface {
        let around = self.surroundings;
        let rounded = Rounded::new(&patch, around, self.precision);
        let firsts = first_of_loops(&patch, around);
        let fairing = fairing.map(|mut report| {
            rounded.tell(&mut report, self.given_normals());
            in_units(report, around, &firsts)
        });
        let written = |p| self.precision.round(around.leave(p));
        PatchSurface {
            outcome,
            boundary: around.ids[..around.loop_vertices].to_vec(),
            positions: patch.x[patch.fixed..].iter().map(written).collect(),
            parents: parents(&patch, coarse, &around.ids),
            fairing,
            known: around.ids.clone(),
            known_triangles: around.triangle_ids.clone(),
            worst_angle: rounded.worst_angle(),
            outside: self.outside(&patch.x[patch.fixed..]),
            coarsened,
            normals_reached: 1.0,
            crossings: Vec::new(),
            triangles: patch.triangles,
        }
    }

    /// By vertex, ascending.
    pub(super) fn given_normals(&self) -> &[(u32, [f64; 3])] {
        match &self.options.boundary_normals {
            BoundaryNormals::Given(list) => list,
            _ => &[],
        }
    }

    /// An error with the mesh's numbers.
    fn in_mesh(&self, error: Error) -> Error {
        let around = self.surroundings;
        let number = |ids: &[u32], i: usize| ids.get(i).map_or(i, |&id| id as usize);
        error.renumbered(|v| number(&around.ids, v), |t| number(&around.triangle_ids, t))
    }
}
