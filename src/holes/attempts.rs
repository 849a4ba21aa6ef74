//! One patch after the other, until one is sound: as asked, with gentler normals, not faired.

use super::crossing::Neighbours;
use super::options::OnFailure;
use super::outcome::OpenReason;
use super::patch::Patch;
use crate::fairing::ProgressCallback;
use crate::holes::patch_surface::{PatchSurface, Task};

/// What patches are looked at for.
pub(super) struct Check<'c, 'm> {
    /// The patch's number among those asked for.
    pub(super) of: usize,
    /// What it may intersect; none if that is not asked for.
    pub(super) neighbours: Option<&'c mut Neighbours<'m>>,
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

impl Task<'_> {
    /// The patch that is kept.
    pub(super) fn settled(
        &self,
        mut check: Check<'_, '_>,
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
        if !piece.is_fair() {
            match on_failure {
                OnFailure::Open => return PatchSurface::open(OpenReason::NotFair),
                OnFailure::Flat => piece = check.judged(self.flattened(piece)),
                OnFailure::Linear => {}
            }
        }
        match &mut check.neighbours {
            Some(neighbours) => neighbours.settle(check.of, self, piece, avoiding.as_ref(), on_failure),
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
