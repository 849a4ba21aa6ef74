//! Paths of edges that can follow the creases inside a region.
//!
//! The region's own shape has no say. Its membrane, each vertex the mean of its neighbours, knows where the boundary is; a crease runs
//! above or below it, so that only the distance across the crease tells which vertices are near to it.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashSet};

use nalgebra::Vector3;

use super::branch::{Branch, Knot};
use super::group::Group;
use crate::mesh::NONE;
use crate::mesh::edge_set::EdgeSet;
use crate::mesh::membrane::membrane;
use crate::solve::Domain;

/// What an edge on the crease costs, in those that are one edge off it.
/// A path is looked for with each of these: with the first alone, of 297 regions across edges of parts eight fewer are good.
const ON_CREASE: [f64; 2] = [0.25, 4.0];
/// Edges of a path, spread along the crease, are no longer or shorter by this factor than those around: the boundary's on the average, and those where
/// the crease arrives.
const STRETCH: f64 = 2.5;

/// The membrane of a region, and which of its vertices paths have taken.
pub(super) struct Membrane<'a> {
    domain: &'a Domain,
    /// Of free and boundary vertices, and those around, as the caller places these.
    x: Vec<Vector3<f64>>,
    /// The mean length of the boundary's edges.
    edge: f64,
    /// The edges that the caller has marked, by the caller's numbers.
    marked: EdgeSet,
    taken: Vec<bool>,
}

/// The vertices that are to lie on a crease.
pub(super) struct Path {
    pub(super) vertices: Vec<u32>,
    /// The same in numbers of the region.
    own: Vec<u32>,
    /// Which part of the crease's length is before each.
    pub(super) parts: Vec<f64>,
}

/// What it costs to come to each vertex from the first, and over which.
struct Reach {
    cost: Vec<f64>,
    before: Vec<u32>,
}

impl<'a> Membrane<'a> {
    pub(super) fn new(domain: &'a Domain, positions: &[[f64; 3]], marked: &[[u32; 2]]) -> Option<Self> {
        let region = &domain.region;
        let mut x = region.positions(positions);
        membrane(&domain.rings, &mut x, |_| false)?;
        let edges = domain.rings.boundary_half_edges.iter().map(|&h| {
            let ends = [region.half_edges.origin(h), region.half_edges.target(h)];
            (x[ends[0] as usize] - x[ends[1] as usize]).norm()
        });
        Some(Self {
            edge: edges.sum::<f64>() / domain.rings.boundary_half_edges.len().max(1) as f64,
            marked: EdgeSet::new(marked),
            taken: vec![false; x.len()],
            domain,
            x,
        })
    }

    /// The paths of a group's creases beside which the fewest triangles fold; `None` where there is none for one of them.
    pub(super) fn paths(&mut self, group: &Group) -> Option<Vec<Path>> {
        let before = self.taken.clone();
        let mut tried = Vec::new();
        for on_crease in ON_CREASE {
            self.taken.clone_from(&before);
            let paths = self.paths_where(group, on_crease);
            tried.extend(paths.and_then(|paths| Some((self.folds(group, &paths)?, paths))));
        }
        self.taken = before;
        let (_, paths) = tried.into_iter().min_by_key(|(folds, _)| *folds)?;
        let taken = paths.iter().flat_map(|path| &path.own);
        taken.for_each(|&v| self.taken[v as usize] = true);
        Some(paths)
    }

    /// How many edges fold where the vertices of paths are on the creases, and the others the means of their neighbours.
    fn folds(&self, group: &Group, paths: &[Path]) -> Option<usize> {
        let region = &self.domain.region;
        let half_edges = &region.half_edges;
        let mut x = self.x.clone();
        let mut is_placed = vec![false; region.free];
        let mut cut = HashSet::new();
        for (branch, path) in group.branches.iter().zip(paths) {
            let steps = path.own.windows(2);
            cut.extend(steps.flat_map(|step| [[step[0], step[1]], [step[1], step[0]]]));
            let free = path
                .own
                .iter()
                .zip(&path.parts)
                .filter(|(v, _)| region.is_free(**v));
            for (&v, &part) in free {
                is_placed[v as usize] = true;
                x[v as usize] = branch.curve.at(part).at;
            }
        }
        membrane(&self.domain.rings, &mut x, |v| is_placed[v])?;
        let normal = |h: u32| {
            let [a, b, c] = half_edges.corners(h).map(|v| x[v as usize]);
            (b - a).cross(&(c - a))
        };
        let is_folded = |&h: &u32| {
            let opposite = half_edges.opposite[h as usize];
            let is_cut = cut.contains(&[half_edges.origin(h), half_edges.target(h)]);
            opposite != NONE && !is_cut && normal(h).dot(&normal(opposite)) < 0.0
        };
        let all = 0..3 * half_edges.region_triangles as u32;
        Some(all.filter(is_folded).count())
    }

    /// The paths where an edge on a crease costs so much.
    fn paths_where(&mut self, group: &Group, on_crease: f64) -> Option<Vec<Path>> {
        let costs: Vec<Vec<f64>> = group.branches.iter().map(|branch| self.costs(branch)).collect();
        let corners = self.corners(group, &costs, on_crease)?;
        let at = |knot: Knot| match knot {
            Knot::End(vertex) => self.local(vertex),
            Knot::Corner(corner) => Some(corners[corner]),
        };
        let knots = group
            .branches
            .iter()
            .map(|branch| Some([at(branch.from)?, at(branch.to)?]));
        let knots = knots.collect::<Option<Vec<[u32; 2]>>>()?;
        let mut paths = Vec::new();
        for ((branch, costs), [from, to]) in group.branches.iter().zip(&costs).zip(knots) {
            let path = self.path([from, to], branch, (costs, on_crease))?;
            let parts = self.parts(&path, branch)?;
            path.iter().for_each(|&v| self.taken[v as usize] = true);
            let ids = &self.domain.region.vertex_ids;
            paths.push(Path {
                vertices: path.iter().map(|&v| ids[v as usize]).collect(),
                own: path,
                parts,
            });
        }
        Some(paths)
    }

    /// The path of a crease: along fixed vertices that are on it from both ends, and cheaply between these.
    fn path(&self, [from, to]: [u32; 2], branch: &Branch, costs: (&[f64], f64)) -> Option<Vec<u32>> {
        let mut path = self.along_fixed(from, branch, 1.0);
        let mut end = self.along_fixed(to, branch, -1.0);
        end.reverse();
        let meets = (0..path.len()).find_map(|k| Some((k, end.iter().position(|v| *v == path[k])?)));
        if let Some((k, e)) = meets {
            path.truncate(k);
            end.drain(..e);
        } else {
            let from = path.pop()?;
            // Along fixed vertices both ends may leave the region.
            if [from, end[0]]
                .iter()
                .any(|&v| v as usize >= self.domain.region.region_vertices())
            {
                return None;
            }
            let reach = self.reach(from, end[0], costs, &self.on(branch));
            path.extend(self.shortened(reach.path(end[0])?));
            path.pop();
        }
        path.extend(end);
        Some(path)
    }

    /// From a vertex along the crease (1, or -1 against it) over fixed vertices that are on it.
    fn along_fixed(&self, from: u32, branch: &Branch, way: f64) -> Vec<u32> {
        let part = |v: u32| branch.part_of(&self.x[v as usize], self.edge);
        let mut path = vec![from];
        let mut at = part(from);
        while let Some(before) = at {
            let beside = self.neighbours(path[path.len() - 1]);
            let fixed = beside.filter(|w| !self.domain.region.is_free(*w) && !self.taken[*w as usize]);
            let beyond = fixed.filter_map(|w| Some((part(w).filter(|p| (p - before) * way > 0.0)?, w)));
            let next = beyond.min_by(|a, b| (a.0 * way).total_cmp(&(b.0 * way)));
            at = next.map(|(part, w)| {
                path.push(w);
                part
            });
        }
        path
    }

    /// The vertices at the other ends of a vertex's edges, those of triangles outside, too.
    fn neighbours(&self, v: u32) -> impl Iterator<Item = u32> {
        let region = &self.domain.region;
        let outside = region.half_edges.triangles[region.half_edges.region_triangles..].iter();
        let around = outside.filter(move |tri| tri.contains(&v)).flatten();
        let inside = match (v as usize) < region.region_vertices() {
            true => self.domain.rings.neighbours(v as usize),
            false => &[],
        };
        around.chain(inside).copied().filter(move |w| *w != v)
    }

    /// Which parts of the crease's length are before the vertices of a path: evenly between those that are fixed; `None` where that stretches
    /// edges too much.
    fn parts(&self, path: &[u32], branch: &Branch) -> Option<Vec<f64>> {
        let last = path.len() - 1;
        let known = |k: usize| match k {
            0 => Some(0.0),
            _ if k == last => Some(1.0),
            _ if self.domain.region.is_free(path[k]) => None,
            _ => Some(branch.curve.nearest(&self.x[path[k] as usize]).0),
        };
        let around = branch.edges.iter().filter(|edge| **edge > 0.0);
        let [least, most] = [f64::min, f64::max].map(|of| around.clone().fold(self.edge, |a, b| of(a, *b)));
        let allowed = least / STRETCH..=most * STRETCH;
        let mut parts = vec![0.0];
        while parts.len() <= last {
            let from = parts.len() - 1;
            let (to, part) = (from + 1..=last).find_map(|k| Some((k, known(k)?)))?;
            let step = (part - parts[from]) / (to - from) as f64;
            let is_stretched = !allowed.contains(&(step * branch.curve.length));
            if is_stretched && path[from..=to].iter().any(|v| self.domain.region.is_free(*v)) {
                return None;
            }
            let first = parts[from];
            parts.extend((1..=to - from).map(|k| first + step * k as f64));
        }
        Some(parts)
    }

    /// The places of free and boundary vertices.
    fn own(&self) -> &[Vector3<f64>] {
        &self.x[..self.domain.region.region_vertices()]
    }

    /// Which fixed vertices are on a crease.
    fn on(&self, branch: &Branch) -> Vec<bool> {
        let near = |(v, x): (usize, &Vector3<f64>)| {
            !self.domain.region.is_free(v as u32) && branch.part_of(x, self.edge).is_some()
        };
        self.own().iter().enumerate().map(near).collect()
    }

    /// The fixed vertex at a point, if one is there.
    fn fixed_at(&self, at: &Vector3<f64>) -> Option<u32> {
        let region = &self.domain.region;
        let off = |v: &usize| (self.x[*v] - at).norm();
        let near = (region.free..region.region_vertices()).min_by(|v, w| off(v).total_cmp(&off(w)));
        near.filter(|v| off(v) < Branch::ON * self.edge).map(|v| v as u32)
    }

    /// The boundary vertex that the caller calls so.
    fn local(&self, id: u32) -> Option<u32> {
        let region = &self.domain.region;
        let boundary = region.free..region.region_vertices();
        let mut boundary = boundary.map(|v| v as u32);
        boundary.find(|&v| region.vertex_ids[v as usize] == id)
    }

    /// How far each vertex is off the crease, across it and in edges, squared.
    fn costs(&self, branch: &Branch) -> Vec<f64> {
        let across = branch.across();
        let off = |x: &Vector3<f64>| {
            let near = across
                .iter()
                .min_by(|a, b| (x - a.0).norm_squared().total_cmp(&(x - b.0).norm_squared()));
            near.map_or(0.0, |(at, across)| ((x - at).dot(across) / self.edge).powi(2))
        };
        self.own().iter().map(off).collect()
    }

    /// The vertices to which the creases come cheapest that have a corner in common, corner by corner: a fixed one where one is in the corner.
    fn corners(&self, group: &Group, costs: &[Vec<f64>], on_crease: f64) -> Option<Vec<u32>> {
        let mut corners = Vec::new();
        loop {
            let knot = Knot::Corner(corners.len());
            let mut sum = vec![0.0; self.domain.region.free];
            let mut met = None;
            for (branch, costs) in group.branches.iter().zip(costs) {
                let (Knot::End(vertex), true) = (branch.from, branch.to == knot) else {
                    continue;
                };
                let reach = self.reach(self.local(vertex)?, NONE, (costs, on_crease), &self.on(branch));
                let corner = branch.curve.at(1.0).at;
                let way = |v: usize| reach.cost[v] + (self.x[v] - corner).norm() / self.edge;
                sum.iter_mut().enumerate().for_each(|(v, sum)| *sum += way(v));
                met = Some(corner);
            }
            let Some(at) = met else {
                return Some(corners);
            };
            if let Some(fixed) = self.fixed_at(&at) {
                corners.push(fixed);
                continue;
            }
            let best = (0..sum.len()).min_by(|&a, &b| sum[a].total_cmp(&sum[b]))?;
            if !sum[best].is_finite() {
                return None;
            }
            corners.push(best as u32);
        }
    }

    /// Dijkstra's shortest paths from a vertex over those that are free or on the crease, and not taken, until `to` is reached.
    fn reach(&self, from: u32, to: u32, (off, on_crease): (&[f64], f64), on: &[bool]) -> Reach {
        let mut reach = Reach {
            cost: vec![f64::INFINITY; self.x.len()],
            before: vec![NONE; self.x.len()],
        };
        reach.cost[from as usize] = 0.0;
        let ids = &self.domain.region.vertex_ids;
        // The bits of numbers that are not negative are ordered as they are.
        let mut open = BinaryHeap::from([Reverse((0u64, from))]);
        while let Some(Reverse((bits, v))) = open.pop() {
            if v == to {
                break;
            }
            if f64::from_bits(bits) > reach.cost[v as usize] {
                continue;
            }
            for &w in self.domain.rings.neighbours(v as usize) {
                let is_open = (self.domain.region.is_free(w) || on[w as usize]) && !self.taken[w as usize];
                if w != to && !is_open {
                    continue;
                }
                let length = (self.x[w as usize] - self.x[v as usize]).norm() / self.edge;
                let mean = 0.5 * (off[v as usize] + off[w as usize]);
                let is_crease =
                    on[v as usize] && on[w as usize] || self.marked.has(ids[v as usize], ids[w as usize]);
                let cost = reach.cost[v as usize]
                    + if is_crease {
                        0.0
                    } else {
                        length * (on_crease + mean)
                    };
                if cost < reach.cost[w as usize] {
                    reach.cost[w as usize] = cost;
                    reach.before[w as usize] = v;
                    open.push(Reverse((cost.to_bits(), w)));
                }
            }
        }
        reach
    }

    /// Without detours: no two vertices that are not neighbours along the path are neighbours.
    fn shortened(&self, path: Vec<u32>) -> Vec<u32> {
        let mut short = vec![path[0]];
        let mut at = 0;
        while at + 1 < path.len() {
            let beside = self.domain.rings.neighbours(path[at] as usize);
            let last = (at + 1..path.len()).rev().find(|&k| beside.contains(&path[k]));
            at = last.unwrap_or(at + 1);
            short.push(path[at]);
        }
        short
    }
}

impl Reach {
    /// The way to a vertex, from the first on.
    fn path(&self, to: u32) -> Option<Vec<u32>> {
        let mut path = vec![to];
        let mut at = to;
        while self.before[at as usize] != NONE {
            at = self.before[at as usize];
            path.push(at);
        }
        path.reverse();
        (path.len() > 1).then_some(path)
    }
}
