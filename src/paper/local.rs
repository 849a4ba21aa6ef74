//! Normals and curvature of single vertices, on meshes whose connectivity may change and where only a few vertices are
//! looked at. The same formulas as in [`crate::discrete::equations`], which evaluates all of them.

use nalgebra::Vector3;

use crate::discrete::boundary_normals::average;
use crate::discrete::curvature::moreton_sequin;
use crate::discrete::paper_curvature::{low_valence_pairs, samples};
use crate::discrete::simd::one;
use crate::mesh::Rings;

/// The triangles of the region around one vertex.
#[derive(Debug, Clone, Default)]
pub(crate) struct Fan {
    /// The neighbours, each once, counter-clockwise.
    pub ring: Vec<u32>,
    /// The triangles, counter-clockwise, by their other two corners.
    pub triangles: Vec<[u32; 2]>,
}

/// A region that tells the triangles around each of its vertices.
pub(crate) trait Fans {
    /// Whether a vertex is free; else it is fixed and has a prescribed normal.
    fn is_free(&self, v: u32) -> bool;
    /// The triangles around a free or boundary vertex.
    fn fan(&self, v: u32, fan: &mut Fan);
}

impl Fans for Rings {
    fn is_free(&self, v: u32) -> bool {
        (v as usize) < self.free()
    }

    fn fan(&self, v: u32, fan: &mut Fan) {
        fan.ring.clear();
        fan.triangles.clear();
        let free = self.free();
        if (v as usize) < free {
            let ring = self.ring(v as usize);
            fan.ring.extend_from_slice(ring);
            let m = ring.len();
            fan.triangles.extend((0..m).map(|k| [ring[k], ring[(k + 1) % m]]));
        } else {
            let b = v as usize - free;
            fan.ring.extend_from_slice(self.boundary_ring(b));
            fan.triangles.extend_from_slice(self.boundary_triangles(b));
        }
    }
}

impl Fan {
    /// The normalized sum of the cross products (6); `None` where the triangles have no area.
    pub(crate) fn normal(&self, x: &[Vector3<f64>], v: u32) -> Option<Vector3<f64>> {
        average(x, v as usize, &self.triangles)
    }

    /// `H` at `v`; the samples of 6.2 are added where the valence is low, and always at a boundary vertex (7.5).
    pub(crate) fn curvature(
        &self,
        x: &[Vector3<f64>],
        normal: &[Vector3<f64>],
        v: u32,
        is_free: bool,
    ) -> f64 {
        let (q, n) = (&x[v as usize], one(&normal[v as usize]));
        let (h, _) = if is_free {
            moreton_sequin(
                &n,
                samples(q, &self.ring, low_valence_pairs(&self.ring), x, normal),
            )
        } else {
            moreton_sequin(
                &n,
                samples(q, &self.ring, self.triangles.iter().copied(), x, normal),
            )
        };
        h.0[0]
    }
}

/// By how much the curvature of a vertex's neighbours answers to its normal steps.
#[derive(Debug, Default)]
pub(crate) struct Answer {
    own: Fan,
    other: Fan,
    kept: Vec<Vector3<f64>>,
}

/// A finite difference moves a vertex by this part of its shortest edge.
/// Of 3 cases, half: 3 change by up to 7e-12 edges; double: 3 change by up to 1e-11 edges.
const PROBE: f64 = 1e-4;

impl Answer {
    /// Per neighbour of free vertex `i` the derivative of its `H` by a step of `i` along its normal, handed to `visit`
    /// with the number of the neighbour within the ring. `h` is the curvature everywhere; `x` and `normal` are as
    /// before afterwards.
    pub(crate) fn of_neighbours(
        &mut self,
        fans: &impl Fans,
        i: u32,
        (x, normal, h): (&mut [Vector3<f64>], &mut [Vector3<f64>], &[f64]),
        mut visit: impl FnMut(usize, f64),
    ) {
        fans.fan(i, &mut self.own);
        let q = x[i as usize];
        let squares = self.own.ring.iter().map(|&j| (x[j as usize] - q).norm_squared());
        let step = PROBE * squares.fold(f64::INFINITY, f64::min).sqrt();
        x[i as usize] = q + normal[i as usize] * step;
        self.kept.clear();
        for &j in &self.own.ring {
            self.kept.push(normal[j as usize]);
            if fans.is_free(j) {
                fans.fan(j, &mut self.other);
                normal[j as usize] = self.other.normal(x, j).unwrap_or(normal[j as usize]);
            }
        }
        for (k, &j) in self.own.ring.iter().enumerate() {
            fans.fan(j, &mut self.other);
            let moved = self.other.curvature(x, normal, j, fans.is_free(j));
            visit(k, (moved - h[j as usize]) / step);
        }
        x[i as usize] = q;
        for (&j, &n) in self.own.ring.iter().zip(&self.kept) {
            normal[j as usize] = n;
        }
    }
}
