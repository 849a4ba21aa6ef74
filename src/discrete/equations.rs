//! Both fairness equations over the region, evaluated at a surface.
//!
//! Outer fairness, one number per free vertex (paper (4), (6), (7)): `R1_i = (S H)_i = sum_j w_ij (H_i - H_j)`, plus the
//! right-hand side where there is one ([`super::target`]).
//! Inner fairness, a tangent vector per free vertex (paper 7.3): the part of `sum_j lambda_ij (q_j - q_i)` that is
//! orthogonal to the normal. (The paper prints the projection with a plus sign; it is a minus.)
//!
//! Fixed positions and normals enter through `H` at the boundary vertices, taken one-sidedly from the region with the
//! prescribed normal (paper 6.1, 6.2, 7.5).

use std::ops::Range;

use fairmesh_linear::parallel;
use nalgebra::Vector3;

use super::curvature::{Curvature, FLAP_WEIGHT, MoretonSequin, TILT_RIDGE, gradient_corrected};
use super::inner_fairness::FairnessWeights;
use super::laplace_beltrami::{area, cotangent, ring_weights};
use super::low_valence::spiral_sample;
use super::normals::{cross_product_normal, max_normal};
use super::ring_edges::RingEdge;
use super::simd::{Simd, Vec3, lane, minus, one, set_lane, vectorized};
use super::target::RightHandSide;
use super::valence_batches::{Chunk, LANES, ValenceBatches, flap_weight, gather, split_lengths};
use crate::mesh::{NONE, Rings};
use crate::support::profile::clock;

/// How `H` is taken at free vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FreeCurvature {
    /// Max's normals and the gradient-corrected fit.
    GradientCorrected,
    /// The paper's: cross-product normals, plain Moreton-Sequin, spiral samples at valence 3 and 4.
    Paper,
}

/// A boundary vertex with up to this many triangles takes the flaps in full.
/// Of 123 cases, half: 100 change by up to 0.4 edges, 17 get another triangulation;
/// double: 113 change by up to 2 edges, 15 get another triangulation, 2 fail, 3 more succeed.
const NARROW: usize = 2;

/// A boundary vertex takes this many samples at once.
const BOUNDARY_LANES: usize = 4;

/// What does not change from surface to surface.
#[derive(Debug)]
pub(crate) struct Equations<'a> {
    /// The rings of the region.
    pub rings: &'a Rings,
    /// The same, transposed.
    pub batches: &'a ValenceBatches,
    /// Unit normals at the boundary vertices.
    pub boundary_normals: &'a [Vector3<f64>],
    /// Boundary vertices with a closed ring whose normal is not prescribed ([`super::smooth_interior`]); may be empty for none.
    pub smooth_interior: &'a [bool],
    /// Inner fairness.
    pub weights: &'a FairnessWeights,
    /// Curvature at free vertices.
    pub curvature: FreeCurvature,
    /// What `Delta_B H` has to be; zero for the paper's (4).
    pub right_hand_side: RightHandSide,
}

/// Everything that is evaluated at a surface. Free vertices come first in `h`.
#[derive(Debug, Clone, Default)]
pub(crate) struct State {
    /// Normals of the ring: the direction of normal steps and of the tangential projection.
    pub normal: Vec<Vector3<f64>>,
    /// Normals with the fitted tilt taken away (the same as `normal` in the paper's discretization) at free, then the
    /// normals at boundary vertices.
    pub corrected: Vec<Vector3<f64>>,
    /// Mean curvature at free, then at boundary vertices.
    pub h: Vec<f64>,
    /// Gaussian curvature at free vertices.
    pub k: Vec<f64>,
    /// Area of the 1-disk, free vertices.
    pub area: Vec<f64>,
    /// `-dH_i/dt_i` at free vertices under a motion along the normal, as of the last [`Equations::evaluate_with_response`].
    pub response: Vec<f64>,
    /// Cotangent weights `w_ij` by slot.
    pub weight: Vec<[f64; LANES]>,
    /// Outer residual `R1`.
    pub outer: Vec<f64>,
    /// Inner residual, tangential.
    pub inner: Vec<Vector3<f64>>,
}

impl State {
    /// Room for a region.
    pub(crate) fn new(batches: &ValenceBatches, boundary: usize) -> Self {
        let free = batches.free();
        Self {
            normal: vec![Vector3::zeros(); free],
            corrected: vec![Vector3::zeros(); free + boundary],
            h: vec![0.0; free + boundary],
            k: vec![0.0; free],
            area: vec![0.0; free],
            response: vec![0.0; free],
            weight: vec![[0.0; LANES]; batches.neighbour.len()],
            outer: vec![0.0; free],
            inner: vec![Vector3::zeros(); free],
        }
    }
}

/// Room for the batch of largest valence.
struct BatchWorkspace {
    ring: Vec<RingEdge<LANES>>,
    /// Flaps from the centre, with their weights.
    flaps: Vec<(Vec3<LANES>, Simd<LANES>)>,
    weight: Vec<Simd<LANES>>,
}

impl BatchWorkspace {
    fn new(m: usize) -> Self {
        let zero = Simd::zero();
        Self {
            ring: vec![RingEdge::zero(); m],
            flaps: vec![([zero; 3], zero); m],
            weight: vec![zero; m],
        }
    }
}

/// Where one chunk of free vertices puts its results.
struct ChunkOutput<'s> {
    normal: &'s mut [Vector3<f64>],
    corrected: &'s mut [Vector3<f64>],
    h: &'s mut [f64],
    k: &'s mut [f64],
    area: &'s mut [f64],
    response: &'s mut [f64],
    weight: &'s mut [[f64; LANES]],
    inner: &'s mut [Vector3<f64>],
}

impl Equations<'_> {
    /// Number of free vertices.
    pub(crate) fn free(&self) -> usize {
        self.batches.free()
    }

    /// Evaluates everything at the surface `x` (free, then boundary vertices).
    pub(crate) fn evaluate(&self, x: &[Vector3<f64>], state: &mut State) {
        self.evaluate_as::<false>(x, state);
    }

    /// The same, and how `H` answers to normal motions.
    pub(crate) fn evaluate_with_response(&self, x: &[Vector3<f64>], state: &mut State) {
        self.evaluate_as::<true>(x, state);
    }

    fn evaluate_as<const RESPONSE: bool>(&self, x: &[Vector3<f64>], state: &mut State) {
        let _clock = clock("evaluations");
        self.free_vertices::<RESPONSE>(x, state);
        self.boundary_normals_at(x, state);
        let paper = self.curvature == FreeCurvature::Paper;
        if paper {
            self.paper_curvature::<RESPONSE>(x, state);
        }
        let free = self.free();
        let (_, boundary) = state.h.split_at_mut(free);
        let corrected = &state.corrected;
        parallel::for_each(boundary.chunks_mut(64), |piece, h| {
            for (b, h) in (64 * piece..).zip(h) {
                if paper || !self.is_smooth_interior(b) {
                    *h = self.boundary_curvature(x, corrected, b);
                }
            }
        });
        self.outer_residual(state);
    }

    /// Normals, weights, area, inner residual and (but for the paper's discretization) curvature of free vertices.
    fn free_vertices<const RESPONSE: bool>(&self, x: &[Vector3<f64>], state: &mut State) {
        let batches = self.batches;
        let chunks = &batches.chunks;
        let lengths = || chunks.iter().map(|c| c.vertices.len());
        let mut weight = split_lengths(&mut state.weight, chunks.iter().map(|c| c.slots.len())).into_iter();
        let mut normal = split_lengths(&mut state.normal, lengths()).into_iter();
        let mut corrected = split_lengths(&mut state.corrected, lengths()).into_iter();
        let mut h = split_lengths(&mut state.h, lengths()).into_iter();
        let mut k = split_lengths(&mut state.k, lengths()).into_iter();
        let mut area = split_lengths(&mut state.area, lengths()).into_iter();
        let mut response = split_lengths(&mut state.response, lengths()).into_iter();
        let inner = split_lengths(&mut state.inner, lengths()).into_iter();
        let outputs = inner.filter_map(|inner| {
            Some(ChunkOutput {
                normal: normal.next()?,
                corrected: corrected.next()?,
                h: h.next()?,
                k: k.next()?,
                area: area.next()?,
                response: response.next()?,
                weight: weight.next()?,
                inner,
            })
        });
        parallel::for_each(outputs.zip(chunks), |_, (mut output, chunk)| {
            vectorized(
                #[inline(always)]
                || self.free_chunk::<RESPONSE>(x, chunk, &mut output),
            );
        });
    }

    /// One chunk of [`Self::free_vertices`], without the choice of instructions.
    #[inline(always)]
    fn free_chunk<const RESPONSE: bool>(
        &self,
        x: &[Vector3<f64>],
        chunk: &Chunk,
        output: &mut ChunkOutput<'_>,
    ) {
        let mut work = BatchWorkspace::new(self.batches.largest_valence);
        for batch in chunk.batches.clone() {
            self.free_batch::<RESPONSE>(x, batch, chunk, &mut work, output);
        }
    }

    #[inline(always)]
    fn free_batch<const RESPONSE: bool>(
        &self,
        x: &[Vector3<f64>],
        batch: usize,
        chunk: &Chunk,
        work: &mut BatchWorkspace,
        out: &mut ChunkOutput<'_>,
    ) {
        let batches = self.batches;
        let slots = batches.slots(batch);
        let m = slots.len();
        let (ring, weight) = (&mut work.ring[..m], &mut work.weight[..m]);
        let vertex = &batches.vertex[batch];
        let q = self.gather_ring(x, batch, ring);
        let area = ring_weights(ring, weight);
        for (to, from) in out.weight[slots.start - chunk.slots.start..]
            .iter_mut()
            .zip(weight.iter())
        {
            *to = from.0;
        }
        let (n, c) = self.free_curvature::<RESPONSE>(x, batch, &q, ring, &mut work.flaps[..m]);
        let inner = self.inner_residual(slots, ring, &n);
        // Backwards: a batch that is not full repeats its last vertex, and only the first of these lanes has its weights.
        for (l, &i) in vertex.iter().enumerate().rev() {
            let i = i as usize - chunk.vertices.start;
            out.normal[i] = lane(&n, l);
            out.corrected[i] = lane(&c.normal, l);
            out.inner[i] = lane(&inner, l);
            out.h[i] = c.h.0[l];
            out.k[i] = c.k.0[l];
            if RESPONSE {
                out.response[i] = c.response.0[l];
            }
            out.area[i] = area.0[l];
        }
    }

    /// Normals and curvatures of a batch. The paper's curvatures need the neighbours' normals: they are zero here.
    #[inline(always)]
    fn free_curvature<const RESPONSE: bool>(
        &self,
        x: &[Vector3<f64>],
        batch: usize,
        q: &Vec3<LANES>,
        ring: &[RingEdge<LANES>],
        flaps: &mut [(Vec3<LANES>, Simd<LANES>)],
    ) -> (Vec3<LANES>, Curvature<LANES>) {
        if self.curvature != FreeCurvature::GradientCorrected {
            let (normal, zero) = (cross_product_normal(ring), Simd::zero());
            let nothing = Curvature {
                h: zero,
                k: zero,
                normal,
                response: zero,
            };
            return (normal, nothing);
        }
        let n = max_normal(ring);
        self.gather_flaps(x, self.batches.slots(batch), q, flaps);
        self.gather_boundary(x, batch, flaps);
        let curvature = gradient_corrected::<LANES, RESPONSE>(&n, ring, flaps, TILT_RIDGE);
        (n, curvature)
    }

    #[inline(always)]
    fn gather_flaps(
        &self,
        x: &[Vector3<f64>],
        slots: Range<usize>,
        q: &Vec3<LANES>,
        flaps: &mut [(Vec3<LANES>, Simd<LANES>)],
    ) {
        let ids = self.batches.flap[slots.clone()]
            .iter()
            .zip(&self.batches.neighbour[slots]);
        for (to, (flap, neighbour)) in flaps.iter_mut().zip(ids) {
            *to = (gather(x, flap), flap_weight(flap, neighbour, FLAP_WEIGHT));
        }
        // Apart from the loads, so that it is done in vectors.
        for to in flaps {
            to.0 = minus(&to.0, q);
        }
    }

    /// Where an edge between two neighbours lies on the boundary there is no flap; the surface between its ends is known from their positions
    /// and normals (6.2) and takes the flap's place. Without it a vertex in a notch has too few samples.
    #[inline(always)]
    fn gather_boundary(&self, x: &[Vector3<f64>], batch: usize, flaps: &mut [(Vec3<LANES>, Simd<LANES>)]) {
        let batches = self.batches;
        let free = self.free();
        for edge in batches.boundary.row(batch) {
            let lane = edge.lane as usize;
            let q = &x[batches.vertex[batch][lane] as usize];
            let [a, b] = edge.ends.map(|j| one(&(x[j as usize] - q)));
            let [n_a, n_b] = edge.ends.map(|j| one(&self.boundary_normals[j as usize - free]));
            let (sample, weight) = &mut flaps[edge.slot as usize];
            let between = spiral_sample(&a, &b, &n_a, &n_b);
            set_lane(sample, lane, &super::simd::lane(&between, 0));
            weight.0[lane] = 1.0;
        }
    }

    /// `H` at boundary vertex `b`, one-sided with its normal in `corrected`: Moreton-Sequin over its neighbours in the region,
    /// a spiral sample between the other corners of every triangle, and the flap across their edge: with [`FLAP_WEIGHT`] as
    /// elsewhere, in full where one or two triangles span too few directions. Without them the fit of a narrow fan can turn the sign of the boundary's
    /// response, and even a sphere is then an unstable solution of the equations.
    /// The paper has no flaps there (7.5), and its discretization none either.
    pub(crate) fn boundary_curvature(&self, x: &[Vector3<f64>], corrected: &[Vector3<f64>], b: usize) -> f64 {
        vectorized(
            #[inline(always)]
            || self.boundary_fit(x, corrected, b),
        )
    }

    /// The same without the choice of instructions. The samples are spread over the lanes.
    #[inline(always)]
    fn boundary_fit(&self, x: &[Vector3<f64>], corrected: &[Vector3<f64>], b: usize) -> f64 {
        let rings = self.rings;
        let free = self.free();
        let nothing: Vec3<BOUNDARY_LANES> = [Simd::zero(); 3];
        let normal = &corrected[free + b];
        let q = &x[free + b];
        let mut n = nothing;
        (0..BOUNDARY_LANES).for_each(|l| set_lane(&mut n, l, normal));
        let mut fit = MoretonSequin::new(n);
        add_vertices(&mut fit, x, q, rings.boundary_ring(b), 1.0);
        for part in rings.boundary_triangles(b).chunks(BOUNDARY_LANES) {
            let (mut ends, mut normals, mut weight) = ([nothing; 2], [nothing; 2], Simd::zero());
            for (l, edge) in part.iter().enumerate() {
                for (k, &j) in edge.iter().enumerate() {
                    set_lane(&mut ends[k], l, &(x[j as usize] - q));
                    set_lane(&mut normals[k], l, &corrected[j as usize]);
                }
                weight.0[l] = 1.0;
            }
            fit.add(
                &spiral_sample(&ends[0], &ends[1], &normals[0], &normals[1]),
                weight,
            );
        }
        if self.curvature == FreeCurvature::Paper {
            return fit.over_lanes();
        }
        let flaps = &rings.boundary_flap[rings.boundary_triangle.range(b)];
        let flap_weight = if flaps.len() <= NARROW { 1.0 } else { FLAP_WEIGHT };
        add_vertices(&mut fit, x, q, flaps, flap_weight);
        fit.over_lanes()
    }

    /// Area of the one-sided disk at boundary vertex `b`.
    pub(crate) fn boundary_area(&self, x: &[Vector3<f64>], b: usize) -> f64 {
        let q = &x[self.free() + b];
        self.rings
            .boundary_triangles(b)
            .iter()
            .map(|&[a, c]| area(q, &x[a as usize], &x[c as usize]))
            .sum()
    }

    /// Calls `add(j, w)` for every one-sided contribution `w` to the cotangent weight `w_bj` of boundary vertex `b`.
    pub(crate) fn boundary_weights(&self, x: &[Vector3<f64>], b: usize, mut add: impl FnMut(u32, f64)) {
        let q = &x[self.free() + b];
        for &[a, c] in self.rings.boundary_triangles(b) {
            let (p_a, p_c) = (&x[a as usize], &x[c as usize]);
            add(a, cotangent(p_c, p_a, q));
            add(c, cotangent(p_a, q, p_c));
        }
    }
}

/// Adds vertices to the fit at `q`, all with the same weight; [`NONE`] is no vertex.
#[inline(always)]
fn add_vertices(
    fit: &mut MoretonSequin<BOUNDARY_LANES>,
    x: &[Vector3<f64>],
    q: &Vector3<f64>,
    vertices: &[u32],
    weight: f64,
) {
    for part in vertices.chunks(BOUNDARY_LANES) {
        let (mut e, mut weights): (Vec3<BOUNDARY_LANES>, _) = ([Simd::zero(); 3], Simd::zero());
        for (l, &j) in part.iter().enumerate().filter(|vertex| *vertex.1 != NONE) {
            set_lane(&mut e, l, &(x[j as usize] - q));
            weights.0[l] = weight;
        }
        fit.add(&e, weights);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{RegionMesh, Selection};
    use fairmesh_shapes::{Sampling, sphere_cap};

    #[test]
    fn wide_and_baseline_instructions_agree_bit_by_bit() {
        let shape = sphere_cap(60.0, 1000, Sampling::Irregular { seed: 7 }, 4);
        let region =
            RegionMesh::new(&shape.positions, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
        let x = region.positions(&shape.noise(3, 0.2));
        let rings = Rings::new(&region);
        let batches = ValenceBatches::new(&rings);
        let boundary_normals: Vec<_> = x[region.free..region.region_vertices()]
            .iter()
            .map(|p| p.normalize())
            .collect();
        for curvature in [FreeCurvature::GradientCorrected, FreeCurvature::Paper] {
            let equations = Equations {
                rings: &rings,
                batches: &batches,
                boundary_normals: &boundary_normals,
                weights: &FairnessWeights::conformal(&batches, &x),
                smooth_interior: &[],
                curvature,
                right_hand_side: RightHandSide::default(),
            };
            let [mut wide, mut plain] = [(); 2].map(|()| State::new(&batches, region.boundary));
            equations.free_vertices::<true>(&x, &mut wide);
            let mut output = ChunkOutput {
                normal: &mut plain.normal,
                corrected: &mut plain.corrected,
                h: &mut plain.h,
                k: &mut plain.k,
                area: &mut plain.area,
                response: &mut plain.response,
                weight: &mut plain.weight,
                inner: &mut plain.inner,
            };
            assert_eq!(batches.chunks.len(), 1);
            equations.free_chunk::<true>(&x, &batches.chunks[0], &mut output);
            assert_eq!(wide.normal, plain.normal);
            assert_eq!(wide.corrected, plain.corrected);
            assert_eq!(wide.inner, plain.inner);
            assert_eq!(wide.h, plain.h);
            assert_eq!(wide.k, plain.k);
            assert_eq!(wide.area, plain.area);
            assert_eq!(wide.response, plain.response);
            assert_eq!(wide.weight, plain.weight);
            let mut tangential = State::new(&batches, region.boundary);
            equations.evaluate_inner(&x, &mut tangential);
            assert_eq!(tangential.normal, wide.normal);
            assert_eq!(tangential.inner, wide.inner);
            equations.boundary_normals_at(&x, &mut wide);
            for b in 0..region.boundary {
                let plain = equations.boundary_fit(&x, &wide.corrected, b);
                assert_eq!(
                    equations.boundary_curvature(&x, &wide.corrected, b).to_bits(),
                    plain.to_bits()
                );
            }
        }
    }

    #[test]
    fn a_batch_that_is_not_full_keeps_the_weights_of_its_last_vertex() {
        let shape = sphere_cap(60.0, 60, Sampling::Irregular { seed: 7 }, 0);
        let region =
            RegionMesh::new(&shape.positions, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
        let x = region.positions(&shape.noise(3, 0.2));
        let rings = Rings::new(&region);
        let batches = ValenceBatches::new(&rings);
        let weights = FairnessWeights::conformal(&batches, &x);
        let equations = Equations {
            rings: &rings,
            batches: &batches,
            boundary_normals: &vec![Vector3::z(); region.boundary],
            smooth_interior: &[],
            weights: &weights,
            curvature: FreeCurvature::Paper,
            right_hand_side: RightHandSide::default(),
        };
        let mut state = State::new(&batches, region.boundary);
        equations.evaluate(&x, &mut state);
        for i in 0..region.free {
            let (first, lane) = batches.place(i);
            let ring = rings.ring(i).iter().enumerate();
            let sum: Vector3<f64> = ring
                .map(|(k, &j)| (x[j as usize] - x[i]) * weights.at(first + k, lane))
                .sum();
            let n = state.normal[i];
            assert!(
                (sum - n * sum.dot(&n) - state.inner[i]).norm() < 1e-13,
                "vertex {i}"
            );
        }
    }
}
