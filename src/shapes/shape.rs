//! A mesh on an exact surface, and the wrong starts made from it.

use super::chart::Chart;
use super::rng::Rng;
use super::surface::{Similarity, Surface};

/// A triangle mesh whose free part is to be faired.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// Vertices on the exact surface; for the cylinder blend, which has none, a smooth start.
    pub positions: Vec<[f64; 3]>,
    /// Counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Which vertices may move.
    pub free: Vec<bool>,
    /// Exact outward unit normals; zero at the free vertices of the cylinder blend.
    pub normals: Vec<[f64; 3]>,
    /// The exact surface, where there is one.
    pub surface: Option<Surface>,
    /// Positions for [`Shape::flat`].
    pub(super) flattened: Vec<[f64; 3]>,
}

/// What a generator says about a point of its chart.
pub(super) struct Lifted {
    pub(super) position: [f64; 3],
    pub(super) normal: [f64; 3],
    /// Where the point goes in a wrong shape with the same boundary.
    pub(super) flat: [f64; 3],
}

impl Shape {
    /// Nothing, to be added to.
    pub(crate) fn empty() -> Self {
        Self {
            positions: Vec::new(),
            triangles: Vec::new(),
            free: Vec::new(),
            normals: Vec::new(),
            surface: None,
            flattened: Vec::new(),
        }
    }

    pub(super) fn lifted<P: Copy>(
        chart: Chart<P>,
        surface: Option<Surface>,
        lift: impl Fn(P) -> Lifted,
    ) -> Shape {
        let Chart {
            points,
            triangles,
            free,
        } = chart;
        let mut shape = Shape {
            positions: Vec::with_capacity(points.len()),
            normals: Vec::with_capacity(points.len()),
            flattened: Vec::with_capacity(points.len()),
            triangles,
            free,
            surface,
        };
        for (i, p) in points.into_iter().enumerate() {
            let l = lift(p);
            shape.positions.push(l.position);
            shape.normals.push(l.normal);
            shape
                .flattened
                .push(if shape.free[i] { l.flat } else { l.position });
        }
        shape
    }

    /// Indices of the free vertices, increasing.
    pub fn free_vertices(&self) -> Vec<u32> {
        (0..self.free.len() as u32)
            .filter(|&v| self.free[v as usize])
            .collect()
    }

    /// Fixed vertices that share a triangle with a free one, increasing, with their exact normals.
    pub fn boundary_normals(&self) -> Vec<(u32, [f64; 3])> {
        let near = self.near_free();
        let boundary = |&v: &u32| near[v as usize] && !self.free[v as usize];
        (0..self.free.len() as u32)
            .filter(boundary)
            .map(|v| (v, self.normals[v as usize]))
            .collect()
    }

    /// Vertices of the triangles that have a free vertex.
    fn near_free(&self) -> Vec<bool> {
        let mut near = vec![false; self.free.len()];
        for t in self
            .triangles
            .iter()
            .filter(|t| t.iter().any(|&v| self.free[v as usize]))
        {
            t.iter().for_each(|&v| near[v as usize] = true);
        }
        near
    }

    /// Positions with the free part replaced by a wrong shape over the same boundary: a spherical part by a flat
    /// disc, any other surface of revolution by a straight tube, a cylinder by one that is
    /// pinched by 40 %, the saddle by a flatter one. The cylinder blend keeps its start.
    pub fn flat(&self) -> Vec<[f64; 3]> {
        self.flattened.clone()
    }

    /// Positions with Gaussian noise on every coordinate of the free vertices; `amplitude` is its deviation
    /// in mean edge lengths.
    pub fn noise(&self, seed: u64, amplitude: f64) -> Vec<[f64; 3]> {
        let (mut rng, deviation) = (Rng::new(seed), amplitude * self.mean_edge());
        self.moved(|p| p.map(|x| x + deviation * rng.gauss()))
    }

    /// Positions with the free vertices where `place` puts them, one after the other.
    fn moved(&self, mut place: impl FnMut(&[f64; 3]) -> [f64; 3]) -> Vec<[f64; 3]> {
        let vertices = self.positions.iter().zip(&self.free);
        vertices
            .map(|(p, &free)| if free { place(p) } else { *p })
            .collect()
    }

    /// Positions with every free vertex anywhere in the bounding box of the free region and its boundary.
    pub fn random(&self, seed: u64) -> Vec<[f64; 3]> {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for (p, _) in self
            .positions
            .iter()
            .zip(self.near_free())
            .filter(|(_, near)| *near)
        {
            low = std::array::from_fn(|i| low[i].min(p[i]));
            high = std::array::from_fn(|i| high[i].max(p[i]));
        }
        let mut rng = Rng::new(seed);
        self.moved(|_| std::array::from_fn(|i| rng.between(low[i], high[i])))
    }

    /// The same mesh with vertices and triangles in random order and every triangle beginning at a random
    /// corner. Also returns the new number of every old vertex.
    pub fn renumbered(&self, seed: u64) -> (Shape, Vec<u32>) {
        let mut rng = Rng::new(seed);
        let new = rng.permutation(self.free.len());
        let order = rng.permutation(self.triangles.len());
        let mut shape = self.clone();
        for (old, &v) in new.iter().enumerate() {
            let v = v as usize;
            shape.positions[v] = self.positions[old];
            shape.normals[v] = self.normals[old];
            shape.free[v] = self.free[old];
            shape.flattened[v] = self.flattened[old];
        }
        for (old, &t) in order.iter().enumerate() {
            let mut corners = self.triangles[old].map(|v| new[v as usize]);
            corners.rotate_left((3.0 * rng.unit()) as usize);
            shape.triangles[t as usize] = corners;
        }
        (shape, new)
    }

    /// The shape rotated, scaled and moved, its exact surface with it.
    pub fn transformed(&self, by: &Similarity) -> Shape {
        let placed = |s: &Surface| Surface::Placed {
            by: *by,
            surface: Box::new(s.clone()),
        };
        Shape {
            positions: self.positions.iter().map(|&p| by.apply(p)).collect(),
            flattened: self.flattened.iter().map(|&p| by.apply(p)).collect(),
            normals: self.normals.iter().map(|&n| by.turn(n)).collect(),
            surface: self.surface.as_ref().map(placed),
            triangles: self.triangles.clone(),
            free: self.free.clone(),
        }
    }

    /// Mean edge length over the triangles' sides (an edge inside the mesh counts twice).
    pub fn mean_edge(&self) -> f64 {
        let mut sum = 0.0;
        for t in &self.triangles {
            let p = t.map(|v| self.positions[v as usize]);
            for k in 0..3 {
                let (a, b) = (p[k], p[(k + 1) % 3]);
                sum += (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2]);
            }
        }
        sum / (3 * self.triangles.len()).max(1) as f64
    }

    /// Smallest and largest valence among the free vertices, which are all interior; (0, 0) without any.
    pub fn valence_range(&self) -> (usize, usize) {
        let mut valence = vec![0usize; self.free.len()];
        self.triangles
            .iter()
            .flatten()
            .for_each(|&v| valence[v as usize] += 1);
        let of_free = || {
            valence
                .iter()
                .zip(&self.free)
                .filter(|(_, free)| **free)
                .map(|(k, _)| *k)
        };
        (of_free().min().unwrap_or(0), of_free().max().unwrap_or(0))
    }

    /// Number of free vertices.
    pub fn free_count(&self) -> usize {
        self.free.iter().filter(|f| **f).count()
    }
}
