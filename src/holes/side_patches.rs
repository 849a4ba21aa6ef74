//! The patch of a loop that creases divide: those of its sides, together.

use super::crease_ways::CreaseVertex;
use super::divided::{DividedLoop, Side, divide};
use super::outcome::{FillOutcome, FlatReason, OpenReason, renumber};
use super::parents::{Parents, compose};
use crate::fairing::{BoundaryCrease, CreaseEnd, Progress, ProgressCallback, SharpEdge, SharpFate};
use crate::holes::patch_surface::{PatchSurface, Task};

impl Task<'_> {
    /// The patch of the sides; `None` where no crease goes on, or a side has no sound one. `length` is that of new edges over those around.
    pub(super) fn divided(
        &self,
        creases: &[BoundaryCrease],
        length: f64,
        tell: &mut ProgressCallback<'_>,
    ) -> Option<PatchSurface> {
        let divided = divide(self.surroundings, &self.options, creases, length)?;
        let count = divided.sides.len() as f64;
        let mut left = self.most.checked_sub(divided.new.len())?;
        let mut pieces = Vec::new();
        for (k, side) in (0..).zip(&divided.sides) {
            let mut tell = |progress: &Progress| {
                tell(&Progress {
                    fraction: (f64::from(k) + progress.fraction) / count,
                    ..*progress
                })
            };
            let task = Task {
                surroundings: &side.around,
                options: side.options.clone(),
                unfaired: None,
                most: left,
                ..*self
            };
            let piece = task.run(&mut tell);
            if piece.outcome == FillOutcome::LeftOpen(OpenReason::Cancelled) {
                return Some(piece);
            }
            if piece.is_open() || !piece.is_sound() {
                return None;
            }
            left = left.saturating_sub(piece.positions.len());
            pieces.push(piece);
        }
        let mut piece = self.together(&divided, pieces);
        let told = self.told(creases, &divided.followed);
        if let Some(report) = &mut piece.fairing {
            report.sharp_edges = told;
        }
        Some(piece)
    }

    /// The curvature in the unit of the mesh.
    fn in_units(&self, end: &CreaseEnd) -> CreaseEnd {
        CreaseEnd {
            curvature: end.curvature.map(|k| k / self.surroundings.scale()),
            curvature_error: end.curvature_error / self.surroundings.scale(),
            ..end.clone()
        }
    }

    /// What became of creases, in the numbers of a report: vertices of the surroundings, then new ones.
    pub(super) fn told(&self, creases: &[BoundaryCrease], followed: &[(usize, Vec<u32>)]) -> Vec<SharpEdge> {
        let known = (self.surroundings.x.len() - self.surroundings.loop_vertices) as u32;
        let loop_vertices = self.surroundings.loop_vertices as u32;
        let number = |v: &u32| if *v < loop_vertices { *v } else { *v + known };
        let told = |(i, crease): (usize, &BoundaryCrease)| {
            let vertices = followed.iter().find(|(f, _)| *f == i).map(|(_, v)| v);
            SharpEdge {
                ends: crease.ends.iter().map(|end| self.in_units(end)).collect(),
                fate: SharpFate::of(crease.branches.len(), vertices.is_some()),
                vertices: vertices
                    .map(|v| v.iter().map(number).collect())
                    .unwrap_or_default(),
            }
        };
        creases.iter().enumerate().map(told).collect()
    }

    fn together(&self, divided: &DividedLoop, pieces: Vec<PatchSurface>) -> PatchSurface {
        let around = self.surroundings;
        let numbers = Numbers {
            loop_vertices: around.loop_vertices as u32,
            known: around.x.len() as u32,
            known_triangles: around.triangles.len() as u32,
        };
        let written = |vertex: &CreaseVertex| self.precision.round(around.leave(&vertex.x));
        let mut whole = PatchSurface {
            outcome: FillOutcome::Flat {
                reason: FlatReason::NoInnerVertex,
            },
            boundary: around.ids[..around.loop_vertices].to_vec(),
            positions: divided.new.iter().map(written).collect(),
            parents: divided.new.iter().map(CreaseVertex::parents).collect(),
            known: around.ids.clone(),
            known_triangles: around.triangle_ids.clone(),
            worst_angle: f64::INFINITY,
            ..PatchSurface::open(OpenReason::NoTriangulation)
        };
        let mut boundary = 0;
        for (side, piece) in divided.sides.iter().zip(pieces) {
            let own = piece.boundary.len();
            whole.include(side, piece, &numbers, [boundary, own]);
            boundary += own;
        }
        compose(&mut whole.parents, around.loop_vertices, divided.new.len());
        for v in whole.parents.iter_mut().flat_map(|of| &mut of.vertices) {
            *v = around.ids[*v as usize];
        }
        whole
    }
}

/// Where new vertices and triangles begin.
struct Numbers {
    loop_vertices: u32,
    known: u32,
    known_triangles: u32,
}

impl Numbers {
    /// The number in the patch of a vertex of the loop, or a new one, of the surroundings.
    fn in_patch(&self, v: u32) -> u32 {
        let new = v.checked_sub(self.known);
        new.map_or(v, |new| self.loop_vertices + new)
    }
}

impl CreaseVertex {
    fn parents(&self) -> Parents {
        Parents {
            vertices: self.ends.map(|end| end.0),
            weights: self.ends.map(|end| end.1),
        }
    }
}

impl PatchSurface {
    /// Adds the patch of a side; `boundary` counts the boundary vertices so far, and its own.
    fn include(&mut self, side: &Side, piece: PatchSurface, numbers: &Numbers, boundary: [usize; 2]) {
        let (first, first_triangle) = (self.positions.len() as u32, self.triangles.len() as u32);
        let (own_boundary, own_known) = (piece.boundary.len() as u32, side.whole.len() as u32);
        let of_patch = |v: u32| match v.checked_sub(own_boundary) {
            Some(inner) => numbers.loop_vertices + first + inner,
            None => numbers.in_patch(side.whole[v as usize]),
        };
        self.triangles
            .extend(piece.triangles.iter().map(|tri| tri.map(of_patch)));
        self.positions.extend(piece.positions);
        self.parents.extend(piece.parents.iter().map(|of| Parents {
            vertices: of.vertices.map(|v| numbers.in_patch(v)),
            ..*of
        }));
        if let Some(mut report) = piece.fairing {
            let vertex = |v: u32| match v.checked_sub(own_known) {
                Some(inner) => numbers.known + first + inner,
                None => side.whole[v as usize],
            };
            let triangle = |t: u32| match t.checked_sub(numbers.known_triangles) {
                Some(new) => numbers.known_triangles + first_triangle + new,
                None => t,
            };
            renumber(&mut report, vertex, triangle);
            match &mut self.fairing {
                Some(whole) => whole.include(report, boundary),
                None => self.fairing = Some(report),
            }
            self.outcome = FillOutcome::Faired;
        }
        self.worst_angle = self.worst_angle.min(piece.worst_angle);
        self.outside.extend(piece.outside.iter().map(|v| first + v));
        self.coarsened |= piece.coarsened;
    }
}
