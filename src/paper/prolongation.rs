//! From one level to the next (paper 7.4): every vertex split brings a vertex back in three steps.

use nalgebra::Vector3;

use super::local::{Fan, Fans};
use super::vertex::Ring;
use crate::discrete::inner_fairness::clamped_cotangents;
use crate::discrete::laplace_beltrami::cotangent;
use crate::mesh::{EditableMesh, ProgressiveMesh};

/// Sweeps over a disk that solve `Delta q = 0` there (step two), at most.
const FLAT_SWEEPS: usize = 20;
/// Sweeps of the construction algorithm over a disk (step three), at most.
const FAIR_SWEEPS: usize = 10;
/// Both end when no vertex moves further than this part of the disk's mean edge.
const STANDS: f64 = 1e-3;

impl Fans for EditableMesh {
    fn is_free(&self, v: u32) -> bool {
        EditableMesh::is_free(self, v)
    }

    fn fan(&self, v: u32, fan: &mut Fan) {
        fan.ring.clear();
        fan.edges.clear();
        for h in self.outgoing_in_region(v) {
            let (a, b) = (self.target(h), self.apex(h));
            // An open fan has a neighbour more than triangles; where it has a gap, too.
            if fan.ring.last() != Some(&a) {
                fan.ring.push(a);
            }
            fan.ring.push(b);
            fan.edges.push([a, b]);
        }
        if fan.ring.len() > fan.edges.len() && fan.ring.first() == fan.ring.last() {
            fan.ring.pop();
        }
    }
}

/// The surface on its way up, by the numbers of the given mesh; vertices that are not there yet have no meaning.
pub(crate) struct Prolongation<'a> {
    /// The given mesh, where conformal weights come from; `None` for uniform ones.
    pub original: Option<&'a [Vector3<f64>]>,
    /// Positions.
    pub x: Vec<Vector3<f64>>,
    /// Unit normals.
    pub normal: Vec<Vector3<f64>>,
    /// `s` of the normal steps.
    pub damping: f64,
    patch: Patch,
    h: Vec<f64>,
}

/// The 1-disk of the new vertex and what is around it.
#[derive(Debug, Default)]
struct Patch {
    /// The free vertices of the disk, then the other vertices beside them.
    vertex: Vec<u32>,
    /// How many are of the disk.
    disk: usize,
    fan: Vec<Fan>,
    /// `lambda` of the disk's vertices; empty where all are one.
    lambda: Vec<Vec<f64>>,
    /// Estimated curvature of the disk's vertices.
    target: Vec<f64>,
}

impl<'a> Prolongation<'a> {
    /// `x` and `normal` are by the numbers of the given mesh; the normals of boundary vertices must be there.
    pub(crate) fn new(
        original: Option<&'a [Vector3<f64>]>,
        x: Vec<Vector3<f64>>,
        normal: Vec<Vector3<f64>>,
        damping: f64,
    ) -> Self {
        Self {
            original,
            h: vec![0.0; x.len()],
            x,
            normal,
            damping,
            patch: Patch::default(),
        }
    }

    /// Brings back the next vertex; false when all are there. With `placed_only` it is put where inner fairness wants it,
    /// and no more: for a run that was stopped.
    pub(crate) fn refine(&mut self, progressive: &mut ProgressiveMesh, placed_only: bool) -> bool {
        let Some(split) = progressive.refine() else {
            return false;
        };
        let (u, mesh) = (split.vertex, progressive.mesh());
        self.normal[u as usize] = self.normal[split.parent as usize];
        self.gather(mesh, u);
        self.x[u as usize] = self.patch.ring(0).centre(&self.x);
        if !placed_only {
            let edges = self.patch.fan[0]
                .ring
                .iter()
                .map(|&j| (self.x[j as usize] - self.x[u as usize]).norm());
            let stands = STANDS * edges.sum::<f64>() / self.patch.fan[0].ring.len() as f64;
            self.flatten(stands);
            self.fair(mesh, stands);
        }
        self.normals(mesh);
        true
    }

    /// Collects the disk of `u` and its surroundings.
    fn gather(&mut self, mesh: &EditableMesh, u: u32) {
        let patch = &mut self.patch;
        patch.vertex.clear();
        patch.vertex.push(u);
        patch.add_fan(mesh, 0);
        for k in 0..patch.fan[0].ring.len() {
            let v = patch.fan[0].ring[k];
            if mesh.is_free(v) {
                patch.vertex.push(v);
            }
        }
        patch.disk = patch.vertex.len();
        for k in 1..patch.disk {
            patch.add_fan(mesh, k);
        }
        for k in 0..patch.disk {
            for n in 0..patch.fan[k].ring.len() {
                let v = patch.fan[k].ring[n];
                if !patch.vertex.contains(&v) {
                    patch.vertex.push(v);
                }
            }
        }
        for k in patch.disk..patch.vertex.len() {
            patch.add_fan(mesh, k);
        }
        patch
            .lambda
            .resize_with(patch.disk.max(patch.lambda.len()), Vec::new);
        if let Some(original) = self.original {
            for k in 0..patch.disk {
                let (q, ring, lambda) = (
                    &original[patch.vertex[k] as usize],
                    &patch.fan[k].ring,
                    &mut patch.lambda[k],
                );
                lambda.clear();
                lambda.resize(ring.len(), 0.0);
                clamped_cotangents(
                    q,
                    ring.len(),
                    |k| &original[ring[k] as usize],
                    |k, w| lambda[k] = w,
                );
            }
        }
    }

    /// Step two: `Delta q_l = 0` for the whole disk.
    fn flatten(&mut self, stands: f64) {
        for _ in 0..FLAT_SWEEPS {
            let mut largest = 0.0f64;
            for k in 0..self.patch.disk {
                let v = self.patch.vertex[k] as usize;
                let centre = self.patch.ring(k).centre(&self.x);
                largest = largest.max((centre - self.x[v]).norm());
                self.x[v] = centre;
            }
            if largest <= stands {
                break;
            }
        }
    }

    /// Step three: `Delta_B H_l = 0` for the whole disk, by the construction algorithm on the disk alone.
    fn fair(&mut self, mesh: &EditableMesh, stands: f64) {
        for _ in 0..FAIR_SWEEPS {
            self.normals(mesh);
            for (fan, &v) in self.patch.fan.iter().zip(&self.patch.vertex) {
                self.h[v as usize] = fan.curvature(&self.x, &self.normal, v, mesh.is_free(v));
            }
            self.estimate();
            let mut largest = 0.0f64;
            for k in 0..self.patch.disk {
                let v = self.patch.vertex[k] as usize;
                let ring = self.patch.ring(k);
                let update = ring.update(v, &self.x, &self.normal, self.patch.target[k], self.damping);
                largest = largest.max((update.position - self.x[v]).norm());
                self.x[v] = update.position;
                self.normal[v] = update.normal;
            }
            if largest <= stands {
                break;
            }
        }
    }

    /// The newest normals of all free vertices of the patch.
    fn normals(&mut self, mesh: &EditableMesh) {
        // There may be more fans than vertices: room for larger patches.
        for (fan, &v) in self.patch.fan.iter().zip(&self.patch.vertex) {
            if mesh.is_free(v) {
                self.normal[v as usize] = fan.normal(&self.x, v).unwrap_or(self.normal[v as usize]);
            }
        }
    }

    /// One Gauss-Seidel iteration of `S H = 0` over the disk (7.1).
    fn estimate(&mut self) {
        self.patch.target.clear();
        for k in 0..self.patch.disk {
            let v = self.patch.vertex[k] as usize;
            let fan = &self.patch.fan[k];
            let m = fan.ring.len();
            let place = |n: usize| &self.x[fan.ring[n % m] as usize];
            let (mut sum, mut total, mut absolute) = (0.0, 0.0, 0.0);
            for (n, &j) in fan.ring.iter().enumerate() {
                let (before, here, after) = (place(n + m - 1), place(n), place(n + 1));
                let w = cotangent(before, &self.x[v], here) + cotangent(after, here, &self.x[v]);
                sum += w * self.h[j as usize];
                total += w;
                absolute += w.abs();
            }
            if total > super::estimate::SMALLEST_DIAGONAL * absolute {
                self.h[v] = sum / total;
            }
            self.patch.target.push(self.h[v]);
        }
    }
}

impl Patch {
    fn add_fan(&mut self, mesh: &EditableMesh, k: usize) {
        if self.fan.len() <= k {
            self.fan.push(Fan::default());
        }
        mesh.fan(self.vertex[k], &mut self.fan[k]);
    }

    fn ring(&self, k: usize) -> Ring<'_> {
        Ring {
            neighbour: &self.fan[k].ring,
            lambda: self.lambda.get(k).map_or(&[], Vec::as_slice),
        }
    }
}
