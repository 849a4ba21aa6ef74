//! Patches for loops whose boundary normals ask too much. At a coarse or ragged rim no sound surface may have the normals that
//! are fitted to it. They are drawn towards those of the membrane over the loop, step by step: a membrane has its own
//! normals over any loop, so that the last step is nearly always possible.

use nalgebra::Vector3;

use crate::discrete::boundary_normals::slerp;
use crate::fairing::{BoundaryNormals, LooseReason, Options, Outcome, Progress, ProgressCallback};
use crate::holes::creases::normals;
use crate::holes::patch::Patch;
use crate::holes::patch_surface::{PatchSurface, Task};

/// How much of the way from the membrane's normals to those of the mesh is asked for, one after the other.
/// Of 5 cases, half: 4 change, -25 % iterations; double: 3 change, +3 % iterations.
const PARTS: [f64; 2] = [0.5, 0.0];
/// Iterations for each.
/// Of 5 cases, half: 3 change, +3 % iterations; double: 2 change, +66 % iterations.
const ITERATIONS: usize = 24;
/// Sweeps that make the refined triangulation a membrane near its boundary.
/// Of 5 cases, half: 3 change by up to 0.02 edges; double: 3 change by up to 0.002 edges.
const SWEEPS: usize = 60;

/// The membrane, and the normals between which the patch's lie.
struct MembraneNormals<'c> {
    coarse: &'c Patch,
    patch: Patch,
    coarsened: bool,
    /// The membrane's normals at the loops.
    own: Vec<Vector3<f64>>,
    /// The mesh's.
    mesh: Vec<Vector3<f64>>,
}

impl Task<'_> {
    /// The first patch from this triangulation that is sound.
    pub(super) fn gentler(
        &self,
        coarse: &Patch,
        judge: &impl Fn(PatchSurface) -> PatchSurface,
        tell: &mut ProgressCallback<'_>,
    ) -> Option<PatchSurface> {
        if self.unfaired.is_some() {
            return None;
        }
        let gentle = self.gentle(coarse)?;
        PARTS.into_iter().find_map(|part| {
            let piece = judge(self.with_part(&gentle, part, tell)?);
            piece.is_sound().then_some(piece)
        })
    }

    /// None where nothing can move.
    fn gentle<'c>(&self, coarse: &'c Patch) -> Option<MembraneNormals<'c>> {
        let mut patch = coarse.clone();
        let coarsened = !self.refine(&mut patch);
        if patch.x.len() == patch.fixed {
            return None;
        }
        relax(&mut patch);
        let around = self.surroundings;
        let mesh = normals(&around.x, &around.triangles, patch.fixed);
        let own = normals(&patch.x, &patch.triangles, patch.fixed);
        // Where one of them has none, the other one serves for both.
        let both = |(mesh, own): (Option<_>, Option<_>)| Some((mesh.or(own)?, own.or(mesh)?));
        let (mesh, own) = mesh.into_iter().zip(own).map(both).collect::<Option<_>>()?;
        Some(MembraneNormals {
            coarse,
            patch,
            coarsened,
            own,
            mesh,
        })
    }

    /// The patch with so much of the mesh's normals; those that are given hold in any case.
    fn with_part(
        &self,
        gentle: &MembraneNormals<'_>,
        part: f64,
        tell: &mut ProgressCallback<'_>,
    ) -> Option<PatchSurface> {
        let given = self.given_normals();
        let normal = |(v, (own, mesh)): (u32, (&Vector3<f64>, &Vector3<f64>))| {
            let given = given.binary_search_by_key(&v, |entry| entry.0).ok();
            let drawn = || if part > 0.0 { slerp(own, mesh, part) } else { *own }.into();
            (v, given.map_or_else(drawn, |at| self.given_normals()[at].1))
        };
        let turned = gentle.own.iter().zip(&gentle.mesh);
        let options = Options {
            boundary_normals: BoundaryNormals::Given((0..).zip(turned).map(normal).collect()),
            max_iterations: self.options.max_iterations.min(ITERATIONS),
            continuity: 0.0,
            ..self.options.clone()
        };
        let mut named = |progress: &Progress| {
            tell(&Progress {
                phase: "gentler normals",
                ..*progress
            })
        };
        let mut solution = self.faired(&gentle.patch, &options, &mut named).ok()?;
        if matches!(solution.report.outcome, Outcome::Converged) {
            solution.report.outcome = Outcome::ConvergedLoosely {
                reason: LooseReason::DrawnNormals,
            };
        }
        let piece = self.judge(gentle.coarse, gentle.patch.clone(), solution, gentle.coarsened);
        Some(PatchSurface {
            normals_reached: part,
            ..piece
        })
    }
}

/// Moves the inner vertices to the means of their neighbours, again and again.
fn relax(patch: &mut Patch) {
    let (mut outgoing, mut ring) = (Vec::new(), Vec::new());
    for _ in 0..SWEEPS {
        for v in patch.fixed..patch.x.len() {
            patch.ring(v as u32, &mut outgoing, &mut ring);
            let sum: Vector3<f64> = ring.iter().map(|&w| patch.x[w as usize]).sum();
            patch.x[v] = sum / ring.len() as f64;
        }
    }
}
