//! From one level to the next (paper 7.4): every vertex split brings a vertex back in three steps.

use nalgebra::Vector3;

use super::local::{Fan, Fans};
use super::vertex::Ring;
use crate::discrete::inner_fairness::clamped_cotangents;
use crate::discrete::laplace_beltrami::cotangent;
use crate::mesh::{EditableMesh, ProgressiveMesh};

/// Sweeps over a disk that solve `Delta q = 0` there (step two), at most.
/// Half or double, of 1 case: none changes.
const FLAT_SWEEPS: usize = 20;
/// Sweeps of the construction algorithm over a disk (step three), at most.
/// Of 1 case, half: 1 changes by up to 2e-7 edges; double: 1 changes by up to 7e-9 edges.
const FAIR_SWEEPS: usize = 10;
/// Both end when no vertex moves further than this part of the disk's mean edge.
/// Of 1 case, half: 1 changes by up to 7e-9 edges; double: 1 changes by up to 9e-9 edges.
const STANDS: f64 = 1e-3;

impl Fans for EditableMesh {
    fn is_free(&self, v: u32) -> bool {
        EditableMesh::is_free(self, v)
    }

    fn fan(&self, v: u32, fan: &mut Fan) {
        fan.ring.clear();
        fan.triangles.clear();
        for h in self.outgoing_in_region(v) {
            let (a, b) = (self.target(h), self.apex(h));
            // An open fan has a neighbour more than triangles; where it has a gap, too.
            if fan.ring.last() != Some(&a) {
                fan.ring.push(a);
            }
            fan.ring.push(b);
            fan.triangles.push([a, b]);
        }
        if fan.ring.len() > fan.triangles.len() && fan.ring.first() == fan.ring.last() {
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
    disk: Disk,
    h: Vec<f64>,
}

/// The 1-disk of the new vertex and what is around it.
#[derive(Debug, Default)]
struct Disk {
    /// The free vertices of the disk, then the other vertices beside them.
    vertex: Vec<u32>,
    /// How many are of the disk.
    size: usize,
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
            disk: Disk::default(),
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
        self.x[u as usize] = self.disk.ring(0).centre(&self.x);
        if !placed_only {
            let edges = self.disk.fan[0]
                .ring
                .iter()
                .map(|&j| (self.x[j as usize] - self.x[u as usize]).norm());
            let stands = STANDS * edges.sum::<f64>() / self.disk.fan[0].ring.len() as f64;
            self.flatten(stands);
            self.fair(mesh, stands);
        }
        self.normals(mesh);
        true
    }

    /// Collects the disk of `u` and its surroundings.
    fn gather(&mut self, mesh: &EditableMesh, u: u32) {
        let disk = &mut self.disk;
        disk.vertex.clear();
        disk.vertex.push(u);
        disk.add_fan(mesh, 0);
        for k in 0..disk.fan[0].ring.len() {
            let v = disk.fan[0].ring[k];
            if mesh.is_free(v) {
                disk.vertex.push(v);
            }
        }
        disk.size = disk.vertex.len();
        for k in 1..disk.size {
            disk.add_fan(mesh, k);
        }
        for k in 0..disk.size {
            for n in 0..disk.fan[k].ring.len() {
                let v = disk.fan[k].ring[n];
                if !disk.vertex.contains(&v) {
                    disk.vertex.push(v);
                }
            }
        }
        for k in disk.size..disk.vertex.len() {
            disk.add_fan(mesh, k);
        }
        disk.lambda
            .resize_with(disk.size.max(disk.lambda.len()), Vec::new);
        if let Some(original) = self.original {
            for k in 0..disk.size {
                let (q, ring, lambda) = (
                    &original[disk.vertex[k] as usize],
                    &disk.fan[k].ring,
                    &mut disk.lambda[k],
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
            for k in 0..self.disk.size {
                let v = self.disk.vertex[k] as usize;
                let centre = self.disk.ring(k).centre(&self.x);
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
            for (fan, &v) in self.disk.fan.iter().zip(&self.disk.vertex) {
                self.h[v as usize] = fan.curvature(&self.x, &self.normal, v, mesh.is_free(v));
            }
            self.estimate();
            let mut largest = 0.0f64;
            for k in 0..self.disk.size {
                let v = self.disk.vertex[k] as usize;
                let ring = self.disk.ring(k);
                let update = ring.update(v, &self.x, &self.normal, self.disk.target[k], self.damping);
                largest = largest.max((update.position - self.x[v]).norm());
                self.x[v] = update.position;
                self.normal[v] = update.normal;
            }
            if largest <= stands {
                break;
            }
        }
    }

    /// The newest normals of all free vertices of the disk and beside it.
    fn normals(&mut self, mesh: &EditableMesh) {
        // There may be more fans than vertices: room for larger patches.
        for (fan, &v) in self.disk.fan.iter().zip(&self.disk.vertex) {
            if mesh.is_free(v) {
                self.normal[v as usize] = fan.normal(&self.x, v).unwrap_or(self.normal[v as usize]);
            }
        }
    }

    /// One Gauss-Seidel iteration of `S H = 0` over the disk (7.1).
    fn estimate(&mut self) {
        self.disk.target.clear();
        for k in 0..self.disk.size {
            let v = self.disk.vertex[k] as usize;
            let fan = &self.disk.fan[k];
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
            self.disk.target.push(self.h[v]);
        }
    }
}

impl Disk {
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
