//! How vertices are distributed within the surface (paper 7.3).
//!
//! The inner fairness condition is that `Delta(q_i) = sum_j lambda_ij (q_j - q_i)` has no tangential part. Weights are
//! kept unnormalized: scaling a row changes neither the condition nor, up to the row's own scale, the iteration.

use nalgebra::Vector3;

use super::laplace_beltrami::cotangent;
use super::valence_batches::{LANES, ValenceBatches};
use crate::mesh::Rings;
use fairmesh_linear::sparse::SymmetricPattern;

/// A cotangent of the input mesh is clamped to this range, so that the weights are convex and the scalar Laplacian
/// positive definite for any input.
/// Of 9 cases, half: 9 change by up to 2 edges, -11 % iterations, 1 fails; double: 9 change by up to 3 edges, -8 % iterations.
pub(crate) const COTANGENT_RANGE: [f64; 2] = [0.05, 8.0];

/// Mean-value weights of repairs stay within this factor of one.
/// Of 41 cases, half: 8 change by up to 3 edges, -5 % iterations; double: 3 change by up to 3 edges, -4 % iterations.
const LARGEST_RATIO: f64 = 20.0;

/// Those that were asked for are left alone as long as they stay within this one.
/// Of 2 cases, half: 1 changes by up to 0.3 edges, -23 % iterations; double: 1 changes by up to 3 edges, -42 % iterations.
const LARGEST_ASKED_RATIO: f64 = 1e3;

/// Weights `lambda_ij` of all free vertices, slot by slot as in [`ValenceBatches`].
#[derive(Debug, Clone)]
pub(crate) struct FairnessWeights {
    /// Per slot the weights; `None`: all are one.
    pub slots: Option<Vec<[f64; LANES]>>,
    /// Free vertices with an input triangle too thin for its cotangents or mean values: those are clamped.
    pub clamped: usize,
}

impl FairnessWeights {
    /// Equal weights: a regular distribution.
    pub(crate) fn uniform() -> Self {
        Self {
            slots: None,
            clamped: 0,
        }
    }

    /// `cot alpha_j + cot beta_j` of the input mesh: the result is discretely conformal to it.
    pub(crate) fn conformal(batches: &ValenceBatches, input: &[Vector3<f64>]) -> Self {
        Self::of_input(batches, |weights, i| weights.set_conformal(batches, input, i))
    }

    /// Mean-value weights of the input mesh, as by [`Self::set_mean_value`]: positive without clamping, and where the ring
    /// is plane they reproduce its centre, so that a plane input mesh keeps its vertices.
    pub(crate) fn convex(batches: &ValenceBatches, input: &[Vector3<f64>]) -> Self {
        Self::of_input(batches, |weights, i| {
            weights.set_bounded_mean_value(batches, input, i, LARGEST_ASKED_RATIO)
        })
    }

    /// Mean-value weights of a surface, as by [`Self::set_mean_value`].
    pub(crate) fn mean_value(batches: &ValenceBatches, surface: &[Vector3<f64>]) -> Self {
        Self::of_input(batches, |weights, i| {
            weights.set_mean_value(batches, surface, i);
            false
        })
    }

    /// The weights that `of(i)` gives for the neighbours of each free vertex `i`, by their numbers, positive and with any sum.
    pub(crate) fn given<I: Iterator<Item = (u32, f64)>>(
        batches: &ValenceBatches,
        of: impl Fn(usize) -> I,
    ) -> Self {
        Self::of_input(batches, |weights, i| {
            let (slots, lane) = batches.ring_slots(i);
            let ring = &batches.neighbour[slots.clone()];
            let weights = &mut weights.slots(batches)[slots];
            let valence = ring.len() as f64;
            for (j, w) in of(i) {
                if let Some(k) = ring.iter().position(|n| n[lane] == j) {
                    weights[k][lane] = w * valence;
                }
            }
            false
        })
    }

    /// Weights that `set` gives vertex by vertex; it returns whether it had to clamp.
    fn of_input(batches: &ValenceBatches, set: impl Fn(&mut Self, usize) -> bool) -> Self {
        let mut weights = Self::uniform();
        for i in 0..batches.free() {
            let was_clamped = set(&mut weights, i);
            weights.clamped += usize::from(was_clamped);
        }
        weights
    }

    /// Gives one vertex the clamped cotangent weights of the input mesh. Returns whether an angle was too close to 0
    /// or 180 degrees.
    pub(crate) fn set_conformal(
        &mut self,
        batches: &ValenceBatches,
        input: &[Vector3<f64>],
        i: usize,
    ) -> bool {
        let (slots, lane) = batches.ring_slots(i);
        let weights = &mut self.slots(batches)[slots.clone()];
        let ring = |k: usize| &input[batches.neighbour[slots.start + k][lane] as usize];
        clamped_cotangents(&input[i], weights.len(), ring, |k, w| weights[k][lane] = w)
    }

    /// Gives one vertex the mean-value weights of the input mesh, `(tan(a/2) + tan(b/2)) / |q_j - q_i|` with the angles `a`,
    /// `b` beside the edge, scaled to the sum of uniform ones: convex for any ring. M. S. Floater, "Mean value
    /// coordinates", CAGD 20 (2003).
    pub(crate) fn set_mean_value(&mut self, batches: &ValenceBatches, input: &[Vector3<f64>], i: usize) {
        self.set_bounded_mean_value(batches, input, i, LARGEST_RATIO);
    }

    /// The same within a factor `bound` of one. Returns whether a weight was outside, or no number: those take the
    /// nearer end, or one.
    fn set_bounded_mean_value(
        &mut self,
        batches: &ValenceBatches,
        input: &[Vector3<f64>],
        i: usize,
        bound: f64,
    ) -> bool {
        let (slots, lane) = batches.ring_slots(i);
        let weights = &mut self.slots(batches)[slots.clone()];
        let valence = weights.len();
        let edge = |k: usize| input[batches.neighbour[slots.start + k % valence][lane] as usize] - input[i];
        let half_tangent = |k: usize| {
            let (a, b) = (edge(k), edge(k + 1));
            let (sine, cosine) = (a.cross(&b).norm(), a.dot(&b));
            let whole = (sine * sine + cosine * cosine).sqrt();
            (sine / (whole + cosine).max(whole * bound.recip())).clamp(0.0, bound)
        };
        let mean = (0..valence).map(|k| edge(k).norm()).sum::<f64>() / valence as f64;
        let (mut sum, mut clamped) = (0.0, false);
        for (k, weight) in weights.iter_mut().enumerate() {
            let w = (half_tangent(k + valence - 1) + half_tangent(k)) * mean / edge(k).norm();
            let inside = if w.is_finite() {
                w.clamp(bound.recip(), bound)
            } else {
                1.0
            };
            clamped |= inside != w;
            weight[lane] = inside;
            sum += inside;
        }
        for w in weights {
            w[lane] *= valence as f64 / sum;
        }
        clamped
    }

    /// The weights of all slots, to be changed: there are none while all are one.
    fn slots(&mut self, batches: &ValenceBatches) -> &mut [[f64; LANES]] {
        self.slots
            .get_or_insert_with(|| vec![[1.0; LANES]; batches.neighbour.len()])
    }

    /// The weight in one slot.
    pub(crate) fn at(&self, slot: usize, lane: usize) -> f64 {
        self.slots.as_ref().map_or(1.0, |s| s[slot][lane])
    }
}

/// Hands `cot alpha_j + cot beta_j`, clamped, to `set` for each of the `valence` neighbours of a closed ring. Returns
/// whether an angle was too close to 0 or 180 degrees, where the nearer end of [`COTANGENT_RANGE`] is taken.
pub(crate) fn clamped_cotangents<'x>(
    q: &Vector3<f64>,
    valence: usize,
    ring: impl Fn(usize) -> &'x Vector3<f64>,
    mut set: impl FnMut(usize, f64),
) -> bool {
    let mut clamped = false;
    let mut clamp = |c: f64| {
        let inside = c.clamp(COTANGENT_RANGE[0], COTANGENT_RANGE[1]);
        clamped |= c.is_nan() || c.abs() >= 1e6;
        if c.is_nan() { COTANGENT_RANGE[0] } else { inside }
    };
    for k in 0..valence {
        let (before, here, after) = (
            ring((k + valence - 1) % valence),
            ring(k),
            ring((k + 1) % valence),
        );
        set(
            k,
            clamp(cotangent(before, q, here)) + clamp(cotangent(after, here, q)),
        );
    }
    clamped
}

/// The scalar Laplacian `G` of the weights on the pattern of the free one-ring graph: `(G f)_i = sum_j m_ij (f_i -
/// f_j)` with `m_ij` the mean of `lambda_ij` and `lambda_ji`, fixed `f_j` being zero. Symmetric positive definite.
pub(crate) fn laplacian(
    pattern: &SymmetricPattern,
    rings: &Rings,
    batches: &ValenceBatches,
    weights: &FairnessWeights,
) -> Vec<f64> {
    let free = pattern.order();
    let mut values = vec![0.0; pattern.column.len()];
    let mut diagonal = vec![0.0; free];
    for i in 0..free {
        let (first, lane) = batches.place(i);
        for (k, s) in rings.neighbour.range(i).enumerate() {
            let j = rings.neighbour.values()[s] as usize;
            let own = weights.at(first + k, lane);
            if j >= free {
                diagonal[i] += own;
            } else if j < i {
                let (first, lane) = batches.place(j);
                let twin = rings.twin[s] as usize - rings.neighbour.range(j).start;
                let mean = 0.5 * (own + weights.at(first + twin, lane));
                diagonal[i] += mean;
                diagonal[j] += mean;
                if let Ok(c) = pattern.row(i).binary_search(&(j as u32)) {
                    values[pattern.start[i] + c] = -mean;
                }
            }
        }
    }
    for i in 0..free {
        values[pattern.start[i + 1] - 1] = diagonal[i];
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{RegionMesh, Selection};
    use fairmesh_shapes::{Sampling, sphere_cap};

    #[test]
    fn convex_weights_are_positive_and_reproduce_a_plane() {
        let shape = sphere_cap(60.0, 1000, Sampling::Irregular { seed: 7 }, 4);
        let region =
            RegionMesh::new(&shape.positions, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
        let rings = Rings::new(&region);
        let batches = ValenceBatches::new(&rings);
        let mut x = region.positions(&shape.positions);
        x.iter_mut().for_each(|p| p.z = 0.0);
        let weights = FairnessWeights::convex(&batches, &x);
        assert_eq!(weights.clamped, 0);
        for i in 0..region.free {
            let (first, lane) = batches.place(i);
            let mut sum = Vector3::zeros();
            for (k, &j) in rings.ring(i).iter().enumerate() {
                let w = weights.at(first + k, lane);
                assert_above!(w, 0.0);
                sum += (x[j as usize] - x[i]) * w;
            }
            assert!(sum.norm() < 1e-14, "vertex {i}: {}", sum.norm());
        }
    }

    #[test]
    fn convex_weights_of_unusable_triangles_are_bounded_and_counted() {
        let shape = sphere_cap(60.0, 200, Sampling::Irregular { seed: 7 }, 4);
        let region =
            RegionMesh::new(&shape.positions, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
        let rings = Rings::new(&region);
        let batches = ValenceBatches::new(&rings);
        let mut x = region.positions(&shape.positions);
        // All edges of a ring without length.
        let ring = rings.ring(0).to_vec();
        ring.iter().for_each(|&j| x[j as usize] = x[0]);
        let weights = FairnessWeights::convex(&batches, &x);
        assert_above!(weights.clamped, 0);
        let all = weights.slots.iter().flatten().flatten();
        assert_all!(all, |w| *w > 0.0 && w.is_finite());
    }
}
