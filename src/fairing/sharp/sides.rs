//! The tangent planes on both sides of a crease.

use nalgebra::Vector3;

use super::along_chain::{AlongChain, Beside, FLAT, Frames, LONG};
use super::outside::Outside;
use crate::discrete::boundary_normals::{angle, average};
use crate::discrete::eight_ring_fit::EightRingSamples;
use crate::discrete::outside_fit::{BESIDE as RINGS, Fit, Samples, THIRD_BESIDE};
use crate::mesh::OutsideNeighbours;
use crate::mesh::outside_neighbours::RINGS_WIDE;
use crate::mesh::parted::part;

/// How far the neighbourhood reaches, in rings.
pub(super) const AROUND: usize = 2 * RINGS;
/// Normals at the boundary are fitted anew where the others would see both sides: within so many rings of the chain.
const NEAR: usize = 3;
/// A finer fit is off the coarse one by no more of its standard errors, which know little of its bias: with 6, of 30 rims of cones with edges of
/// .06 radii one surface is off by 4e-3 radii, in place of 2e-3.
const AGREES: f64 = 15.0;
/// Where the coarse fit is less certain than this (radians, one degree), there is noise, which a finer one follows.
const SMOOTH: f64 = 0.0175;
/// A plane through fewer vertices is none.
const FEWEST: usize = 4;
/// The tangent plane on one side.
pub(super) struct SideFit {
    pub(super) fit: Fit,
    /// It is known from the nearest triangles alone: a facet, maybe of a round side.
    pub(super) is_facet: bool,
}

/// A neighbourhood, parted along a chain of edges, in numbers of its own.
pub(super) struct Sides {
    /// The mesh's number of each vertex; copies have that of what they are copies of.
    ids: Vec<u32>,
    x: Vec<Vector3<f64>>,
    triangles: Vec<[u32; 3]>,
    neighbours: OutsideNeighbours,
}

impl Sides {
    /// The neighbourhood of the vertex where chains start, parted along them, and along the edges that bend by so much at their ends.
    pub(super) fn new(outside: &Outside<'_>, chains: &[Vec<u32>], least: f64) -> Self {
        let near = outside.within(chains[0][0], AROUND);
        let (mut ids, triangles) = (near.vertices, near.triangles);
        let local = |v: u32| ids.binary_search(&v).ok().map(|l| l as u32);
        let beyond = chains
            .iter()
            .flat_map(|chain| beyond(outside, chain, least, |v| local(v).is_some()));
        let steps = chains.iter().flat_map(|chain| chain.windows(2));
        let cut: Vec<[u32; 2]> = steps
            .map(|step| [step[0], step[1]])
            .chain(beyond)
            .filter_map(|step| Some([local(step[0])?, local(step[1])?]))
            .collect();
        let parted = part(ids.len(), &triangles, &cut);
        let copies: Vec<u32> = parted.copy_of.iter().map(|&v| ids[v as usize]).collect();
        ids.extend(copies);
        Self {
            neighbours: OutsideNeighbours::of_triangles(ids.len(), parted.triangles.iter().copied()),
            triangles: parted.triangles,
            x: ids.iter().map(|&v| outside.position(v)).collect(),
            ids,
        }
    }

    /// The fits at the first vertex of a chain, left and right of it; `None` where a side cannot be told, or with an error of more than `most`, radians.
    pub(super) fn fits(&self, chain: &[u32], most: f64) -> Option<[SideFit; 2]> {
        let sides = [1, 2].map(|turn| self.copies(chain, turn));
        if sides[0].first()? == sides[1].first()? {
            return None;
        }
        let fit = |side: &[u32]| self.fit_beside(side).filter(|side| side.fit.error <= most);
        Some([fit(&sides[0])?, fit(&sides[1])?])
    }

    /// Normals at the boundary vertices near to the first one of the chains that are not on them.
    pub(super) fn boundary_normals(
        &self,
        outside: &Outside<'_>,
        chains: &[Vec<u32>],
    ) -> Vec<(u32, [f64; 3])> {
        let mut near = outside.within(chains[0][0], NEAR).vertices;
        let is_on = |v: &u32| chains.iter().any(|chain| chain.contains(v));
        near.retain(|v| outside.is_boundary[*v as usize] && !is_on(v));
        let normal = |v: u32| {
            let local = self.ids.iter().position(|id| *id == v)?;
            Some((v, self.fit(local as u32)?.fit.normal.into()))
        };
        near.into_iter().filter_map(normal).collect()
    }

    /// The copies of a chain's vertices on one side of it, as far as there are triangles: those that run along it, or turned by two, against it.
    fn copies(&self, chain: &[u32], turn: usize) -> Vec<u32> {
        let is = |v: u32, id: u32| self.ids[v as usize] == id;
        let mut copies = Vec::new();
        for step in chain.windows(2) {
            let beside = self.triangles.iter().find_map(|tri| {
                let k = (0..3).find(|&k| is(tri[k], step[0]) && is(tri[(k + turn) % 3], step[1]))?;
                Some([tri[k], tri[(k + turn) % 3]])
            });
            let Some([from, to]) = beside else { break };
            if copies.is_empty() {
                copies.push(from);
            }
            // Triangles that have but a vertex in common are no side.
            if copies[copies.len() - 1] != from {
                break;
            }
            copies.push(to);
        }
        copies
    }

    /// The tangent plane at the first of the copies of a chain's vertices: the fit to what is around, or where the triangles along the chain are certain,
    /// one that agrees with them, or theirs.
    fn fit_beside(&self, copies: &[u32]) -> Option<SideFit> {
        let around = self.fit(copies[0]);
        let along = self.along(copies).filter(|along| along.fit.error < SMOOTH);
        let Some(along) = along else {
            return around;
        };
        let is_better = |side: &SideFit| {
            let off = angle(&side.fit.normal, &along.fit.normal);
            side.fit.error < SMOOTH && off <= along.spread.max(FLAT) + side.fit.error
        };
        around.filter(is_better).or(Some(SideFit {
            fit: along.fit,
            is_facet: true,
        }))
    }

    /// The normal of the triangles at the copies of a chain's vertices.
    fn along(&self, copies: &[u32]) -> Option<AlongChain> {
        let copies = &copies[..copies.len().min(LONG + 1)];
        let points: Vec<Vector3<f64>> = copies.iter().map(|&v| self.x[v as usize]).collect();
        let frames = Frames::along(&points)?;
        let beside = |tri: &[u32; 3]| {
            let on: Vec<usize> = tri
                .iter()
                .filter_map(|v| copies.iter().position(|c| c == v))
                .collect();
            let frame = match on[..] {
                [k] => 2 * k,
                [j, k] => j + k,
                _ => return None,
            };
            let [p, q, r] = tri.map(|v| self.x[v as usize]);
            let touched: Vector3<f64> = on.iter().map(|&k| points[k]).sum();
            Some(Beside {
                frame,
                normal: (q - p).cross(&(r - p)).try_normalize(f64::MIN_POSITIVE)?,
                offset: (p + q + r) / 3.0 - touched / on.len() as f64,
            })
        };
        frames.normal(&self.triangles.iter().filter_map(beside).collect::<Vec<_>>())
    }

    /// The plane of all triangles around, if they have one, as those of parts, whose next edge may be near; else the fit to heights, which noise
    /// does not lead astray, or that to curvatures, if it is more certain and agrees with it. Where that is uncertain, as beside another edge, the
    /// plane of the nearest triangles: not else, as it may be a facet of a round side.
    fn fit(&self, v: u32) -> Option<SideFit> {
        let start = average(&self.x, v as usize, &self.fan(v))?;
        let [plane, narrow] = self.planes(v, start);
        let fit = plane.or_else(|| self.fit_to_rings(v, start, narrow.is_some()));
        match fit {
            Some(fit) => Some(SideFit { fit, is_facet: false }),
            None => narrow.map(|fit| SideFit { fit, is_facet: true }),
        }
    }

    /// The fit to many rings; `None` also where a plane of the nearest triangles is more certain.
    fn fit_to_rings(&self, v: u32, start: Vector3<f64>, has_plane: bool) -> Option<Fit> {
        let mut heights = EightRingSamples::default();
        // Noise and thin sectors need more vertices.
        let coarse = [RINGS, RINGS_WIDE].into_iter().filter_map(|rings| {
            heights.gather_within(rings, &self.neighbours, &self.x, v as usize);
            heights.fit(start)
        });
        let coarse = coarse.reduce(|a, b| if b.error < a.error { b } else { a });
        let coarse = coarse.filter(|fit| !has_plane || fit.error < SMOOTH)?;
        if coarse.error >= SMOOTH {
            return Some(coarse);
        }
        let mut samples = Samples::<RINGS>::default();
        samples.gather(&self.neighbours, &self.x, v as usize, &mut Vec::new());
        let agrees = |fine: &Fit| angle(&fine.normal, &coarse.normal) <= AGREES * coarse.error;
        let fine = THIRD_BESIDE.fit(&samples, coarse.normal).filter(agrees);
        fine.filter(|fine| fine.error < coarse.error).or(Some(coarse))
    }

    /// The plane at a vertex, where it goes through all vertices of two rings, and where it goes through those of one and enough others.
    fn planes(&self, v: u32, normal: Vector3<f64>) -> [Option<Fit>; 2] {
        let mut near = Vec::new();
        let ends: [usize; 2] = self.neighbours.rings(v, &mut near);
        let slope = |w: &u32| {
            let e = self.x[*w as usize] - self.x[v as usize];
            e.dot(&normal).abs() / e.norm()
        };
        let within = |end: usize| {
            let error = near[..end].iter().map(slope).fold(0.0, f64::max);
            let on_plane = near.iter().filter(|w| slope(w) < FLAT).count();
            (on_plane >= FEWEST && error < FLAT).then_some(Fit { normal, error })
        };
        [within(ends[1]), within(ends[0])]
    }

    /// The triangles at a vertex by their other corners.
    fn fan(&self, v: u32) -> Vec<[u32; 2]> {
        let corners = |tri: &[u32; 3]| {
            let k = (0..3).find(|&k| tri[k] == v)?;
            Some([tri[(k + 1) % 3], tri[(k + 2) % 3]])
        };
        self.triangles.iter().filter_map(corners).collect()
    }
}

/// The edges that bend by so much and are reached over such edges from the last vertex of a chain; and those from its first one along the
/// boundary, where it goes on.
fn beyond(outside: &Outside<'_>, chain: &[u32], least: f64, is_near: impl Fn(u32) -> bool) -> Vec<[u32; 2]> {
    let creased = |at: u32, done: &[u32]| -> Vec<u32> {
        let is_new = |w: &u32| is_near(*w) && !chain.contains(w) && !done.contains(w);
        let bends = |w: &u32| outside.is_sharp(at, *w, least);
        let others = outside.neighbours(at).into_iter();
        others.filter(|w| is_new(w) && bends(w)).collect()
    };
    let along = creased(chain[0], &[]).into_iter();
    let along = along.filter(|w| outside.is_boundary[*w as usize]);
    let mut edges: Vec<[u32; 2]> = along.map(|w| [chain[0], w]).collect();
    let mut reached = vec![chain[chain.len() - 1]];
    let mut next = 0;
    while next < reached.len() {
        let at = reached[next];
        // The others are known from their other ends.
        for w in creased(at, &reached[..next]) {
            edges.push([at, w]);
            if !reached.contains(&w) {
                reached.push(w);
            }
        }
        next += 1;
    }
    edges
}
