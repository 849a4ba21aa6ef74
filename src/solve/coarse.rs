//! The coarse level: the same problem with fewer free vertices, and the way back to the fine mesh.

use std::sync::Arc;

use nalgebra::Vector3;

use super::domain::Domain;
use super::problem::Problem;
use crate::discrete::inner_fairness::FairnessWeights;
use crate::mesh::circles::circles;
use crate::mesh::coarsening::{Coarsening, coarsen};
use crate::mesh::{NONE, RegionMesh};

/// Regions with fewer free vertices have no coarse level: they are one.
/// Of 125 cases, half: 4 change by up to 1 edge, +2 % iterations, 1 more succeeds; double: 9 change by up to 2 edges, -2 % iterations.
const SMALLEST_FINE: usize = 2000;
/// Free vertices of the fine mesh for each of the coarse one.
/// Half or double, of 10 cases: none changes.
const RATIO: usize = 16;
/// Free vertices of a coarse mesh at least: with fewer the shape is not resolved.
/// Of 10 cases, half: 9 change by up to 2 edges, +17 % iterations; double: 9 change by up to 2 edges, +12 % iterations.
const FEWEST: usize = 300;
/// Free vertices of a coarse mesh for each vertex of the boundary, none of which is left out.
/// Of 10 cases, half: 9 change by up to 2 edges, +14 % iterations; double: 9 change by up to 0.06 edges, +9 % iterations.
const PER_BOUNDARY_VERTEX: f64 = 1.5;
/// More than this many suffice for any shape that a start needs.
/// Half or double, of 10 cases: none changes.
const MOST: usize = 3000;
/// Edges of the input count as at least so long, in mean edges.
/// Half or double, of 10 cases: none changes.
const SHORTEST: f64 = 0.01;
/// Sweeps that spread the vertices of the fine mesh.
/// Of 9 cases, half: 9 change by up to 0.05 edges; double: 9 change by up to 0.03 edges.
const SWEEPS: usize = 6;
/// A mesh that keeps more than this part of its free vertices is no coarse one.
/// Of 10 cases, half: 1 changes by up to 1 edge, -9 % iterations; double: none changes.
const LARGEST_PART: f64 = 0.6;

/// A coarse mesh of a region with the same boundary, and the problem on it.
pub(crate) struct CoarseLevel {
    domain: Arc<Domain>,
    weights: Arc<FairnessWeights>,
    coarsening: Coarsening,
}

impl CoarseLevel {
    /// The coarse level of a problem; `None` where it is small itself, or cannot be made coarser.
    pub(crate) fn new(problem: &Problem<'_>) -> Option<Self> {
        let Domain {
            region, rings, input, ..
        } = &**problem.domain;
        if region.free < SMALLEST_FINE {
            return None;
        }
        let beside_boundary = (PER_BOUNDARY_VERTEX * region.boundary as f64) as usize;
        let target = (region.free / RATIO).clamp(FEWEST, MOST) + beside_boundary;
        // Uniform weights make all edges alike; others spread the vertices as in the input.
        let radius = problem.weights.slots.is_none().then(|| circles(rings));
        let shortest = SHORTEST * mean_edge(region, input);
        let coarsening = coarsen(region, target, |u, v| {
            let [u, v] = [u as usize, v as usize];
            match &radius {
                Some(radius) => radius[u] + radius[v],
                None => (input[u] - input[v]).norm().max(shortest),
            }
        });
        if coarsening.free() as f64 > LARGEST_PART * region.free as f64 {
            return None;
        }
        let positions: Vec<[f64; 3]> = input.iter().map(|p| (*p).into()).collect();
        let (mut coarse, lengths) = coarsening.region(region, &positions)?;
        let boundary = (region.free..)
            .zip(&coarse.vertex_ids[coarse.free..])
            .take(region.boundary);
        let has_same_boundary =
            coarse.boundary == region.boundary && boundary.into_iter().all(|(v, &id)| v == id as usize);
        if !has_same_boundary || coarse.components != region.components {
            return None;
        }
        if !region.moves_elsewhere.is_empty() {
            let moves = coarse
                .vertex_ids
                .iter()
                .map(|&v| region.moves_elsewhere[v as usize]);
            coarse.moves_elsewhere = moves.collect();
        }
        let input = coarse.vertex_ids.iter().map(|&v| input[v as usize]).collect();
        let domain = Domain::new(coarse, input).with_lengths(lengths);
        let weights = spread_alike(&domain, &coarsening, region.region_vertices());
        Some(Self {
            domain: Arc::new(domain),
            weights: Arc::new(weights),
            coarsening,
        })
    }

    /// The problem on the coarse mesh: that of the fine one but for the inner fairness.
    pub(crate) fn problem<'a>(&'a self, fine: &Problem<'a>) -> Problem<'a> {
        Problem {
            continuity: None,
            domain: &self.domain,
            weights: &self.weights,
            weigh: None,
            ..*fine
        }
    }

    /// The surface `x` of the coarse mesh with unit normals `normal` (free, boundary), on the fine mesh.
    ///
    /// Vertices come back one by one, each where its ring's tangent planes want it: at the mean `p` of the ring by the coordinates
    /// that it had, less half the mean of `<p - q_j, n_j> n_j`, which is exact where the ring lies on a paraboloid around it.
    pub(crate) fn prolongate(
        &self,
        fine: &Problem<'_>,
        x: &[Vector3<f64>],
        normal: &[Vector3<f64>],
    ) -> Vec<Vector3<f64>> {
        let mut surface = fine.domain.surface().to_vec();
        let mut normals = vec![Vector3::zeros(); surface.len()];
        for (k, (p, n)) in x.iter().zip(normal).enumerate() {
            let v = self.domain.region.vertex_ids[k] as usize;
            normals[v] = *n;
            if v < fine.domain.region.free {
                surface[v] = *p;
            }
        }
        for (u, ring) in self.coarsening.returning() {
            let mean = |of: &dyn Fn(usize) -> Vector3<f64>| -> Vector3<f64> {
                ring.iter().map(|&(j, w)| of(j as usize) * w).sum()
            };
            let p = mean(&|j| surface[j]);
            let bend = mean(&|j| normals[j] * (p - surface[j]).dot(&normals[j]));
            let n = mean(&|j| normals[j]);
            surface[u as usize] = p - 0.5 * bend;
            normals[u as usize] = n.try_normalize(1e-9).unwrap_or(n);
        }
        spread(fine, &mut surface, &normals);
        surface
    }
}

/// Spreads the free vertices within the surface as inner fairness (7.3) wants them, as far as their neighbours are concerned: sweeps of
/// Gauss and Seidel over `sum_j lambda_ij (q_j - q_i)` without its normal part. `P` is made here, and would keep every thin triangle.
fn spread(problem: &Problem<'_>, x: &mut [Vector3<f64>], normals: &[Vector3<f64>]) {
    let Domain { rings, batches, .. } = &**problem.domain;
    for _ in 0..SWEEPS {
        for i in 0..rings.free() {
            let (first, lane) = batches.place(i);
            let (mut sum, mut total) = (Vector3::zeros(), 0.0);
            for (k, &j) in rings.ring(i).iter().enumerate() {
                let weight = problem.weights.at(first + k, lane);
                sum += (x[j as usize] - x[i]) * weight;
                total += weight;
            }
            let step = sum / total;
            x[i] += step - normals[i] * step.dot(&normals[i]);
        }
    }
}

/// Inner fairness that spreads the coarse vertices as the fine ones are. `vertices` are in the fine region.
fn spread_alike(domain: &Domain, coarsening: &Coarsening, vertices: usize) -> FairnessWeights {
    let region = &domain.region;
    let mut number = vec![NONE; vertices];
    for (k, &v) in region.vertex_ids[..region.region_vertices()].iter().enumerate() {
        number[v as usize] = k as u32;
    }
    // Rows are in the order of the fine numbers.
    let mut ascending = region.vertex_ids[..region.free].to_vec();
    ascending.sort_unstable();
    FairnessWeights::given(&domain.batches, |i| {
        let row = ascending.partition_point(|&v| v < region.vertex_ids[i]);
        let row = coarsening.coordinates().row(row).iter();
        row.map(|&(v, w)| (number[v as usize], w))
    })
}

/// The mean length of the edges of the region's triangles.
fn mean_edge(region: &RegionMesh, x: &[Vector3<f64>]) -> f64 {
    let edges = |t: &[u32; 3]| {
        (0..3)
            .map(|k| (x[t[k] as usize] - x[t[(k + 1) % 3] as usize]).norm())
            .sum::<f64>()
    };
    region.triangles().iter().map(edges).sum::<f64>() / (3 * region.triangles().len()) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrete::equations::FreeCurvature;
    use crate::discrete::target::RightHandSide;
    use crate::mesh::Selection;
    use fairmesh_shapes::{OUTSIDE, Sampling, sphere_cap};

    /// The largest distance from the unit sphere of what comes back from a coarse mesh on it.
    fn distance_from_sphere(free: usize) -> f64 {
        let shape = sphere_cap(60.0, free, Sampling::Irregular { seed: 2 }, OUTSIDE);
        let region =
            RegionMesh::new(&shape.positions, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
        let x = region.positions(&shape.positions);
        let domain = Arc::new(Domain::new(region, x));
        let problem = Problem {
            continuity: None,
            domain: &domain,
            boundary_normals: &domain.surface()[domain.region.free..],
            smooth_interior: &[],
            weights: &Arc::new(FairnessWeights::uniform()),
            weigh: None,
            curvature: FreeCurvature::GradientCorrected,
            right_hand_side: RightHandSide::default(),
        };
        let level = CoarseLevel::new(&problem).unwrap();
        // On the unit sphere positions are normals.
        let exact = level.domain.surface();
        let back = level.prolongate(&problem, exact, exact);
        back.iter().map(|p| (p.norm() - 1.0).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn a_sphere_comes_back_from_the_coarse_mesh() {
        let distances = [2500, 10_000].map(distance_from_sphere);
        assert!(distances[0] < 3e-3, "{distances:?}");
        assert!(distances[1] < 0.5 * distances[0], "{distances:?}");
    }
}
