//! The two ends of a bridge: runs of boundary edges, found on their loops and widened.

use nalgebra::Vector3;

use super::loops::{BoundaryLoop, LoopKind};
use crate::mesh::coincident::Copies;
use crate::mesh::halfedge::next;
use crate::support::error::Error;

/// So many edges of the loop on either side of a chain are looked at where it is a part of a tooth.
/// Half or double, of 6 cases: none changes.
const BESIDE: usize = 3;

/// A run of a loop's edges, in the direction in which triangles that fill the loop run through it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Chain {
    /// The number of the loop.
    pub(super) of: usize,
    /// The vertices, one more than there are edges.
    pub(super) vertices: Vec<u32>,
    /// The mesh's half-edge at each edge; it runs the other way.
    pub(super) half_edges: Vec<u32>,
    /// Those at the edges before the first one, and behind the last one, the nearest first.
    pub(super) beside: [Vec<u32>; 2],
}

/// The mesh that chains are looked up in.
pub(super) struct Chains<'m> {
    pub(super) copies: &'m Copies,
    pub(super) positions: &'m [[f64; 3]],
    pub(super) loops: &'m [BoundaryLoop],
}

impl Chains<'_> {
    /// Both chains, widened to this length if one is given. They have no vertex in common.
    pub(super) fn resolved(&self, given: [&[u32]; 2], width: Option<f64>) -> Result<[Chain; 2], Error> {
        let chains = [
            self.resolve(0, given[0], width)?,
            self.resolve(1, given[1], width)?,
        ];
        let [first, second] = &chains;
        match first.vertices.iter().find(|v| second.vertices.contains(v)) {
            Some(&v) => Err(bad(0, v, "both chains have it")),
            None => Ok(chains),
        }
    }

    fn resolve(&self, chain: usize, given: &[u32], width: Option<f64>) -> Result<Chain, Error> {
        let Some(&first) = given.first() else {
            return Err(bad(chain, 0, "the chain names no vertex"));
        };
        let beyond = |v: &&u32| **v as usize >= self.positions.len();
        if let Some(&v) = given.iter().find(beyond) {
            return Err(bad(chain, v, "there is no such vertex"));
        }
        if given.len() == 1 && width.is_none() {
            return Err(bad(
                chain,
                first,
                "one vertex is no chain unless a width is given",
            ));
        }
        let of_mesh: Vec<u32> = given.iter().map(|&v| self.copies.smallest(v)).collect();
        let not_finite = |v: &&u32| self.positions[**v as usize].iter().any(|c| !c.is_finite());
        if let Some(&v) = of_mesh.iter().find(not_finite) {
            return Err(Error::NotFinite { vertex: v as usize });
        }
        // Which vertex breaks the longest run that is found.
        let (mut broken, mut longest) = (first, 0);
        for (of, boundary) in self.loops.iter().enumerate() {
            match run(&boundary.vertices, &of_mesh) {
                ChainOrder::Whole { start, edges } => {
                    let vertex = given[0];
                    match boundary.kind {
                        LoopKind::NonManifold { .. } => {
                            return Err(bad(chain, vertex, "its boundary runs into a non-manifold edge"));
                        }
                        LoopKind::Inconsistent { .. } => {
                            return Err(bad(
                                chain,
                                vertex,
                                "its boundary runs into triangles that face the wrong way",
                            ));
                        }
                        _ => {}
                    }
                    let span = match width {
                        Some(width) => self.widened(boundary, (start, edges), width),
                        None => (start, edges),
                    };
                    if span.1 + 2 > boundary.vertices.len() {
                        return Err(bad(
                            chain,
                            vertex,
                            "the chain is its whole boundary loop; join the loops",
                        ));
                    }
                    return Ok(Chain::new(of, boundary, span));
                }
                ChainOrder::Broken { after } if after >= longest => {
                    (broken, longest) = (given[after], after);
                }
                ChainOrder::Broken { .. } => {}
            }
        }
        let why = match longest {
            0 => "it is on no boundary loop",
            _ => "it is not the next one along a boundary loop",
        };
        Err(bad(chain, broken, why))
    }

    /// The run about the middle of another one that comes nearest to this length, and has an edge at least.
    fn widened(&self, boundary: &BoundaryLoop, (start, edges): (usize, usize), width: f64) -> (usize, usize) {
        let n = boundary.vertices.len();
        let at = |i: usize| Vector3::from(self.positions[boundary.vertices[i % n] as usize]);
        let length = |i: usize| (at(i + 1) - at(i)).norm();
        let middle = 0.5 * (start..start + edges).map(length).sum::<f64>();
        let (mut nearest, mut way) = (start, 0.0);
        for i in start..start + edges {
            if (way + length(i) - middle).abs() < (way - middle).abs() {
                (nearest, way) = (i + 1, way + length(i));
            } else {
                break;
            }
        }
        // How far from the middle a walk in either direction goes; it ends where it is nearest to half of the width.
        let mut reach = [middle - way, way - middle];
        let (mut first, mut last) = (nearest + n, nearest + n);
        let is_nearer = |now: f64, then: f64| (then - 0.5 * width).abs() < (now - 0.5 * width).abs();
        while last - first + 2 < n {
            let then = reach[0] + length(first - 1);
            if !is_nearer(reach[0], then) {
                break;
            }
            (reach[0], first) = (then, first - 1);
        }
        while last - first + 2 < n {
            let then = reach[1] + length(last);
            if !is_nearer(reach[1], then) {
                break;
            }
            (reach[1], last) = (then, last + 1);
        }
        if first == last {
            last += 1;
        }
        (first % n, last - first)
    }
}

enum ChainOrder {
    /// All vertices follow each other from this place on, along so many edges.
    Whole { start: usize, edges: usize },
    /// So many of them do.
    Broken { after: usize },
}

/// Where a loop has these vertices one after the other, in either direction.
fn run(boundary: &[u32], chain: &[u32]) -> ChainOrder {
    let n = boundary.len();
    let Some(first) = boundary.iter().position(|v| *v == chain[0]) else {
        return ChainOrder::Broken { after: 0 };
    };
    let agrees = |step: usize| {
        let along = (0..chain.len().min(n)).take_while(|&i| boundary[(first + i * step) % n] == chain[i]);
        along.count()
    };
    let (forwards, backwards) = (agrees(1), agrees(n - 1));
    let edges = chain.len() - 1;
    if forwards == chain.len() {
        ChainOrder::Whole { start: first, edges }
    } else if backwards == chain.len() {
        ChainOrder::Whole {
            start: (first + n - edges) % n,
            edges,
        }
    } else {
        ChainOrder::Broken {
            after: forwards.max(backwards),
        }
    }
}

impl Chain {
    fn new(of: usize, boundary: &BoundaryLoop, (start, edges): (usize, usize)) -> Self {
        let n = boundary.vertices.len();
        let half_edge = |i: usize| boundary.half_edges[i % n];
        let count = BESIDE.min((n - edges) / 2);
        Self {
            of,
            vertices: (start..=start + edges)
                .map(|i| boundary.vertices[i % n])
                .collect(),
            half_edges: (start..start + edges).map(half_edge).collect(),
            beside: [
                (1..=count).map(|k| half_edge(start + n - k)).collect(),
                (0..count).map(|k| half_edge(start + edges + k)).collect(),
            ],
        }
    }

    /// Per vertex the copy that the mesh as given has in the triangle beside it.
    pub(super) fn copies(&self, triangles: &[[u32; 3]]) -> Vec<u32> {
        let corner = |h: u32| triangles[h as usize / 3][h as usize % 3];
        let firsts = self.half_edges.iter().map(|&h| corner(next(h)));
        firsts.chain(self.half_edges.last().map(|&h| corner(h))).collect()
    }
}

fn bad(chain: usize, vertex: u32, why: &'static str) -> Error {
    let vertex = vertex as usize;
    Error::BadChain { chain, vertex, why }
}
