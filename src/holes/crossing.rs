//! Patches that intersect themselves or the mesh: found, and tried again by other means.

use nalgebra::Vector3;
use rstar::primitives::Rectangle;
use rstar::{AABB, Envelope, RTree};

use super::loops::BoundaryLoop;
use super::options::OnFailure;
use super::outcome::FillOutcome;
use super::patch::Patch;
use super::surroundings::bounds;
use crate::fairing::SelfIntersections;
use crate::holes::patch_surface::{PatchSurface, Task};
use crate::holes::triangle_owner::Owned;
use crate::intersections::{Bounds, Member, bounds_of, member, members_near, pairs};

/// Part of a loop's diagonal around its box in which the mesh is looked at once for all loops.
/// Half or double, of 43 cases: none changes.
const NEAR: f64 = 0.5;

/// The mesh near the loops, and the patches made so far.
pub(super) struct Neighbours<'m> {
    pub(super) positions: &'m [[f64; 3]],
    triangles: &'m [[u32; 3]],
    /// Where `tree` has all of the mesh.
    known: Vec<Option<Bounds>>,
    tree: RTree<Member>,
    /// Triangles of patches; as members of a search they are numbered after those of the mesh.
    made: Vec<Owned>,
    /// The patches, and their boxes.
    patches: Vec<(Bounds, Vec<Member>)>,
}

/// The box around the loops of a patch with room around it.
fn room(positions: &[[f64; 3]], loops: &[&BoundaryLoop]) -> Option<Bounds> {
    let vertices = loops.iter().flat_map(|boundary| &boundary.vertices);
    let x: Vec<_> = vertices.map(|&v| Vector3::from(positions[v as usize])).collect();
    let (low, high) = bounds(&x);
    let more = Vector3::repeat(NEAR * (high - low).norm());
    let (low, high) = (low - more, high + more);
    let is_finite = low.iter().chain(&high).all(|x| x.is_finite());
    is_finite.then(|| AABB::from_corners(low.into(), high.into()))
}

impl<'m> Neighbours<'m> {
    pub(super) fn new<'l>(
        positions: &'m [[f64; 3]],
        triangles: &'m [[u32; 3]],
        groups: impl Iterator<Item = Vec<&'l BoundaryLoop>>,
    ) -> Self {
        let known: Vec<Option<Bounds>> = groups.map(|loops| room(positions, &loops)).collect();
        let rooms = RTree::bulk_load(
            known
                .iter()
                .flatten()
                .map(|&room| Rectangle::from(room))
                .collect(),
        );
        let near = members_near(positions, triangles, |b| {
            rooms.locate_in_envelope_intersecting(b).next().is_some()
        });
        Self {
            positions,
            triangles,
            known,
            tree: RTree::bulk_load(near),
            made: Vec::new(),
            patches: Vec::new(),
        }
    }

    /// A patch whose intersections are known, or one made by other means if this one has some and that one has none.
    pub(super) fn avoided(
        &self,
        of: usize,
        task: &Task<'_>,
        mut best: PatchSurface,
        avoiding: Option<&Patch>,
        on_failure: OnFailure,
    ) -> PatchSurface {
        if !best.crossings.is_empty() {
            for other in task.other_means(&best, avoiding) {
                let other = self.judged(of, other);
                if other.crossings.is_empty() {
                    best = other;
                    break;
                }
                if on_failure == OnFailure::Flat && other.crossings.len() < best.crossings.len() {
                    best = other;
                }
            }
        }
        best
    }

    /// The patch, which is there for later ones, and says whether it intersects something.
    pub(super) fn kept(&mut self, of: usize, mut piece: PatchSurface) -> PatchSurface {
        self.keep(of, &piece);
        if !piece.crossings.is_empty() {
            piece.outcome = FillOutcome::SelfIntersecting;
        }
        piece
    }

    /// What later patches may intersect.
    fn keep(&mut self, of: usize, piece: &PatchSurface) {
        let mut members = self.members(piece);
        for member in &mut members {
            let triangle = member.number;
            member.number = (self.triangles.len() + self.made.len()) as u32;
            member.is_asked = false;
            self.made.push(Owned::Patch { of, triangle });
        }
        self.patches.push((bounds_of(&members), members));
    }

    /// The triangles of a patch where they will be, by their numbers in the patch.
    fn members(&self, piece: &PatchSurface) -> Vec<Member> {
        let boundary = piece.boundary.iter().map(|&v| self.positions[v as usize]);
        let positions: Vec<[f64; 3]> = boundary.chain(piece.positions.iter().copied()).collect();
        (0..piece.triangles.len() as u32)
            .filter_map(|t| member(&positions, &piece.triangles, t, true))
            .collect()
    }

    /// The piece with its intersections.
    pub(super) fn judged(&self, of: usize, mut piece: PatchSurface) -> PatchSurface {
        let mut members = self.members(&piece);
        let bounds = bounds_of(&members);
        let first = (self.triangles.len() + self.made.len()) as u32;
        members.iter_mut().for_each(|member| member.number += first);
        members.extend(self.meeting(of, &bounds));
        let owned = |t: u32| match (t.checked_sub(first), t.checked_sub(self.triangles.len() as u32)) {
            (Some(triangle), _) => Owned::Patch { of, triangle },
            (None, Some(k)) => self.made[k as usize],
            (None, None) => Owned::Mesh(t),
        };
        let found = pairs(members, SelfIntersections::MOST);
        piece.crossings = found.into_iter().map(|pair| pair.map(owned)).collect();
        piece
    }

    /// What of the mesh and of the other patches meets a box.
    pub(super) fn meeting(&self, of: usize, bounds: &Bounds) -> Vec<Member> {
        let mut met: Vec<Member> = match self.known[of].filter(|known| known.contains_envelope(bounds)) {
            Some(_) => self
                .tree
                .locate_in_envelope_intersecting(bounds)
                .cloned()
                .collect(),
            None => members_near(self.positions, self.triangles, |b| bounds.intersects(b)),
        };
        let patches = self.patches.iter().filter(|(b, _)| bounds.intersects(b));
        let made = patches.flat_map(|(_, members)| members);
        met.extend(made.filter(|member| bounds.intersects(&member.bounds())).cloned());
        met
    }
}
