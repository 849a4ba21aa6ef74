//! Free vertices in batches of [`LANES`] with equal valence, so that one formula runs on a whole batch at once.
//!
//! No batch reaches over a chunk of [`CHUNK`] consecutive vertices: chunks are the unit of work that is handed to threads,
//! and the same whatever their number.

use std::ops::Range;

use nalgebra::Vector3;

use super::simd::{Simd, Vec3};
use crate::mesh::rows::Rows;
use crate::mesh::{NONE, Rings};

/// Vertices per batch: one 256-bit register. With two of them the sums of a fit would not stay in registers.
pub(crate) const LANES: usize = 4;

/// Vertices per chunk.
/// Of 128 cases, half: only the progress changes; double: none changes.
pub(crate) const CHUNK: usize = 2048;

/// Free vertices `vertices` and the batches that hold them.
#[derive(Debug, Clone)]
pub(crate) struct Chunk {
    /// A run of free vertices.
    pub vertices: Range<usize>,
    /// Their batches.
    pub batches: Range<usize>,
    /// The slots of those batches.
    pub slots: Range<usize>,
}

/// The rings of all free vertices, transposed: slot `k` of a batch holds the `k`-th neighbour of each of its vertices.
#[derive(Debug, Clone)]
pub(crate) struct ValenceBatches {
    /// The chunks, in the order of their vertices.
    pub chunks: Vec<Chunk>,
    /// Per batch its vertices; a batch that is not full repeats its last vertex.
    pub vertex: Vec<[u32; LANES]>,
    /// Per batch its first slot, and the end.
    pub start: Vec<usize>,
    /// Per slot the neighbours.
    pub neighbour: Vec<[u32; LANES]>,
    /// Per slot the flaps across the edges from neighbour `k` to `k + 1`; the neighbour itself where there is none.
    pub flap: Vec<[u32; LANES]>,
    /// Per batch the edges without a flap: they lie on the boundary of the region, between fixed vertices.
    pub boundary: Rows<BoundaryEdge>,
    /// Per free vertex its first slot and its lane.
    place: Vec<(u32, u32)>,
    /// The largest valence.
    pub largest_valence: usize,
}

/// An edge between two consecutive neighbours of a vertex that has no flap.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BoundaryEdge {
    /// The place of its first end in the ring.
    pub slot: u32,
    /// The lane of the vertex in whose ring it is.
    pub lane: u32,
    /// Its ends, both fixed.
    pub ends: [u32; 2],
}

impl ValenceBatches {
    /// Sorts the rings of the free vertices into batches.
    pub(crate) fn new(rings: &Rings) -> Self {
        let free = rings.free();
        let valence = |i: u32| rings.ring(i as usize).len();
        let mut batches = Self {
            chunks: Vec::with_capacity(free.div_ceil(CHUNK)),
            vertex: Vec::new(),
            start: vec![0],
            neighbour: Vec::new(),
            flap: Vec::new(),
            boundary: Rows::default(),
            place: vec![(0, 0); free],
            largest_valence: (0..free as u32).map(valence).max().unwrap_or(0),
        };
        let mut sorted: Vec<u32> = Vec::with_capacity(CHUNK);
        for first in (0..free).step_by(CHUNK) {
            let vertices = first..(first + CHUNK).min(free);
            let (batch, slot) = (batches.vertex.len(), batches.neighbour.len());
            sorted.clear();
            sorted.extend(vertices.clone().map(|i| i as u32));
            sorted.sort_unstable_by_key(|&i| (valence(i), i));
            for class in sorted.chunk_by(|&a, &b| valence(a) == valence(b)) {
                for members in class.chunks(LANES) {
                    batches.push(rings, members);
                }
            }
            batches.chunks.push(Chunk {
                vertices,
                batches: batch..batches.vertex.len(),
                slots: slot..batches.neighbour.len(),
            });
        }
        batches
    }

    fn push(&mut self, rings: &Rings, members: &[u32]) {
        let vertex: [u32; LANES] = std::array::from_fn(|l| members[l.min(members.len() - 1)]);
        let first = self.neighbour.len();
        for (l, &i) in members.iter().enumerate() {
            self.place[i as usize] = (first as u32, l as u32);
        }
        let ring = |i: u32| rings.ring(i as usize);
        let flaps = |i: u32| &rings.flap[rings.neighbour.range(i as usize)];
        let valence = ring(vertex[0]).len();
        for k in 0..valence {
            self.neighbour.push(vertex.map(|i| ring(i)[k]));
            self.flap.push(vertex.map(|i| match flaps(i)[k] {
                NONE => ring(i)[k],
                flap => flap,
            }));
        }
        for (lane, &i) in members.iter().enumerate() {
            for k in (0..valence).filter(|&k| flaps(i)[k] == NONE) {
                self.boundary.push(BoundaryEdge {
                    slot: k as u32,
                    lane: lane as u32,
                    ends: [ring(i)[k], ring(i)[(k + 1) % valence]],
                });
            }
        }
        self.boundary.end_row();
        self.vertex.push(vertex);
        self.start.push(self.neighbour.len());
    }

    /// How many free vertices there are.
    pub(crate) fn free(&self) -> usize {
        self.place.len()
    }

    /// The first slot and the lane of a free vertex.
    #[inline]
    pub(crate) fn place(&self, i: usize) -> (usize, usize) {
        let (first, lane) = self.place[i];
        (first as usize, lane as usize)
    }

    /// The slots of a free vertex's ring, and its lane.
    pub(crate) fn ring_slots(&self, i: usize) -> (Range<usize>, usize) {
        let (first, lane) = self.place(i);
        let batch = self.start.partition_point(|&s| s <= first) - 1;
        (self.slots(batch), lane)
    }

    /// The slots of a batch.
    pub(crate) fn slots(&self, batch: usize) -> Range<usize> {
        self.start[batch]..self.start[batch + 1]
    }
}

/// The positions of one slot.
#[inline(always)]
pub(crate) fn gather(x: &[Vector3<f64>], vertex: &[u32; LANES]) -> Vec3<LANES> {
    let mut r = [Simd::zero(); 3];
    for (l, &i) in vertex.iter().enumerate() {
        let p = &x[i as usize];
        r[0].0[l] = p.x;
        r[1].0[l] = p.y;
        r[2].0[l] = p.z;
    }
    r
}

/// The numbers of one slot.
#[inline(always)]
pub(crate) fn gather_scalar(x: &[f64], vertex: &[u32; LANES]) -> Simd<LANES> {
    let mut r = Simd::zero();
    for (l, &i) in vertex.iter().enumerate() {
        r.0[l] = x[i as usize];
    }
    r
}

/// `weight` where a slot has a flap, else 0.
#[inline(always)]
pub(crate) fn flap_weight(flap: &[u32; LANES], neighbour: &[u32; LANES], weight: f64) -> Simd<LANES> {
    let mut weights = Simd::splat(weight);
    for l in 0..LANES {
        weights.0[l] = if flap[l] == neighbour[l] { 0.0 } else { weight };
    }
    weights
}

/// Cuts a slice into consecutive pieces of the given lengths.
pub(crate) fn split_lengths<T>(mut slice: &mut [T], lengths: impl Iterator<Item = usize>) -> Vec<&mut [T]> {
    let mut pieces = Vec::with_capacity(lengths.size_hint().0);
    for length in lengths {
        let (head, tail) = slice.split_at_mut(length);
        pieces.push(head);
        slice = tail;
    }
    pieces
}
