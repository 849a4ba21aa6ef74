//! One patch after the other, until one is sound: as asked, with gentler normals, not faired.

use super::crossing::Neighbours;
use super::options::OnFailure;
use super::outcome::{FillOutcome, OpenReason, has_no_area};
use super::patch::Patch;
use crate::fairing::{BoundaryCrease, ProgressCallback, SharpEdge};
use crate::holes::patch_surface::{PatchSurface, Task};

/// What patches are looked at for.
pub(super) struct Check<'c, 'm> {
    /// The patch's number among those asked for.
    pub(super) of: usize,
    /// What it may intersect; none if that is not asked for.
    pub(super) neighbours: Option<&'c mut Neighbours<'m>>,
    /// Whether the rim is sound with it.
    pub(super) has_sound_rim: &'c dyn Fn(&PatchSurface) -> bool,
}

impl Check<'_, '_> {
    /// The piece with its intersections.
    fn judged(&self, piece: PatchSurface) -> PatchSurface {
        match &self.neighbours {
            Some(neighbours) => neighbours.judged(self.of, piece),
            None => piece,
        }
    }
}

impl PatchSurface {
    /// Where a wide sharp edge stops, it is no success.
    fn judge_edges(&mut self) {
        if let Some(report) = &mut self.fairing
            && report.sharp_edges.iter().any(SharpEdge::stops_wide)
        {
            report.outcome.reserve_edge();
        }
    }

    /// The verdict of its report, but for the rim and intersections.
    fn is_good(&self) -> bool {
        self.outcome.is_success(self.fairing.as_ref()) && !has_no_area(self.triangles.len(), self.worst_angle)
    }
}

impl Task<'_> {
    /// The patch that is kept: that of the sides that creases divide the loop into, if it is sound and intersects nothing, or a smooth one.
    pub(super) fn settled(
        &self,
        (creases, length): (&[BoundaryCrease], f64),
        mut check: Check<'_, '_>,
        on_failure: OnFailure,
        tell: &mut ProgressCallback<'_>,
    ) -> PatchSurface {
        let divided = self
            .divided(creases, length, tell)
            .map(|piece| check.judged(piece));
        let is_kept = |piece: &PatchSurface| piece.is_good() && piece.crossings.is_empty();
        let Some(mut piece) = divided.filter(|piece| piece.is_open() || is_kept(piece)) else {
            return self.smooth((check, &self.told(creases, &[])), on_failure, tell);
        };
        piece.judge_edges();
        let is_good = piece.is_good() && (check.has_sound_rim)(&piece);
        match (&mut check.neighbours, on_failure) {
            _ if piece.is_open() => piece,
            (_, OnFailure::Open) if !is_good => PatchSurface::open(OpenReason::NotFair),
            (Some(neighbours), _) => neighbours.kept(check.of, piece),
            (None, _) => piece,
        }
    }

    /// The smooth patch that is kept.
    fn smooth(
        &self,
        (mut check, edges): (Check<'_, '_>, &[SharpEdge]),
        on_failure: OnFailure,
        tell: &mut ProgressCallback<'_>,
    ) -> PatchSurface {
        let mut piece = check.judged(self.run(tell));
        if piece.is_open() {
            return piece;
        }
        let mut avoiding = None;
        if !piece.is_sound() {
            avoiding = self.avoiding(&check);
            let judge = |piece| check.judged(piece);
            let gentler = avoiding
                .as_ref()
                .and_then(|coarse| self.gentler(coarse, &judge, tell));
            piece = gentler.unwrap_or(piece);
        }
        if let Some(report) = &mut piece.fairing {
            report.sharp_edges.extend_from_slice(edges);
        }
        piece.judge_edges();
        if on_failure == OnFailure::Flat && !piece.is_good() {
            piece = check.judged(self.flattened(piece));
        }
        // What is faired is replaced by what is not, which would be no success.
        let is_final = on_failure == OnFailure::Open && piece.outcome == FillOutcome::Faired;
        if let Some(neighbours) = check.neighbours.as_ref().filter(|_| !is_final) {
            piece = neighbours.avoided(check.of, self, piece, avoiding.as_ref(), on_failure);
        }
        if on_failure == OnFailure::Open {
            if !piece.is_good() || !(check.has_sound_rim)(&piece) {
                return PatchSurface::open(OpenReason::NotFair);
            }
            if !piece.crossings.is_empty() {
                return PatchSurface::open(OpenReason::Intersecting);
            }
        }
        match &mut check.neighbours {
            Some(neighbours) => neighbours.kept(check.of, piece),
            None => piece,
        }
    }

    /// The triangulation of least bends that intersects nothing, if there is one.
    fn avoiding(&self, check: &Check<'_, '_>) -> Option<Patch> {
        let around = self.surroundings;
        let vertices = &around.ids[..around.loop_vertices];
        let obstacles = check
            .neighbours
            .as_ref()
            .map(|near| near.obstacles(check.of, vertices));
        let barred = |t: [u32; 3]| obstacles.as_ref().is_some_and(|obstacles| obstacles.bar(t));
        let first = self.triangulate(false, None)?;
        match first.triangles.iter().any(|&t| barred(t)) {
            true => self.triangulate(false, Some(&barred)),
            false => Some(first),
        }
    }
}
