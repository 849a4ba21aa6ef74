//! Normals and curvature of single vertices, on meshes whose connectivity may change and where only a few vertices are
//! looked at. The same formulas as in [`crate::discrete::equations`], which evaluates all of them.

use nalgebra::Vector3;

use crate::discrete::curvature::moreton_sequin;
use crate::discrete::low_valence::spiral_sample;
use crate::discrete::paper_curvature::LOW_VALENCE;
use crate::discrete::simd::{minus, one};
use crate::mesh::Rings;

/// The triangles of the region around one vertex.
#[derive(Debug, Clone, Default)]
pub(crate) struct Fan {
    /// The neighbours, each once, counter-clockwise.
    pub ring: Vec<u32>,
    /// The edges across, counter-clockwise: those between consecutive neighbours, one per triangle.
    pub edges: Vec<[u32; 2]>,
}

/// A region whose vertices are known by their surroundings.
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
        fan.edges.clear();
        let free = self.free();
        if (v as usize) < free {
            let ring = self.ring(v as usize);
            fan.ring.extend_from_slice(ring);
            let m = ring.len();
            fan.edges.extend((0..m).map(|k| [ring[k], ring[(k + 1) % m]]));
        } else {
            let b = v as usize - free;
            fan.ring.extend_from_slice(self.boundary_ring(b));
            fan.edges.extend_from_slice(self.boundary_triangles(b));
        }
    }
}

impl Fan {
    /// The normalized sum of the cross products (6); `None` where the triangles have no area.
    pub(crate) fn normal(&self, x: &[Vector3<f64>], v: u32) -> Option<Vector3<f64>> {
        let q = x[v as usize];
        let cross = |&[a, b]: &[u32; 2]| (x[a as usize] - q).cross(&(x[b as usize] - q));
        let sum: Vector3<f64> = self.edges.iter().map(cross).sum();
        sum.try_normalize(f64::MIN_POSITIVE)
    }

    /// `H` at `v`; the samples of 6.2 are added where the valence is low, and always at a boundary vertex (7.5).
    pub(crate) fn curvature(
        &self,
        x: &[Vector3<f64>],
        normal: &[Vector3<f64>],
        v: u32,
        is_free: bool,
    ) -> f64 {
        let q = one(&x[v as usize]);
        let at = |j: u32| minus(&one(&x[j as usize]), &q);
        let between = if is_free && self.ring.len() > LOW_VALENCE {
            &[][..]
        } else {
            &self.edges[..]
        };
        let between = between.iter().map(|&[a, b]| {
            let (n_a, n_b) = (one(&normal[a as usize]), one(&normal[b as usize]));
            spiral_sample(&at(a), &at(b), &n_a, &n_b)
        });
        let samples = self.ring.iter().map(|&j| at(j)).chain(between);
        moreton_sequin(&one(&normal[v as usize]), samples).0.0[0]
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
