//! The vertices along the creases through a hole: those that the loop has there already, and new ones.

use nalgebra::Vector3;

use super::surroundings::Surroundings;
use crate::fairing::{BoundaryCrease, Branch, CreaseEnd, Knot};

/// Vertices of the loop that are on a crease have no more than so many others between them.
/// Without any, of 30 holes in parts 3 are no longer closed along their creases; with double 1.
const GAP: u32 = 1;

/// A new vertex on a crease.
#[derive(Debug, Clone, Copy)]
pub(super) struct CreaseVertex {
    pub(super) x: Vector3<f64>,
    /// Vertices of the loop at which its creases end, and their weights.
    pub(super) ends: [(u32, f64); 3],
}

/// A vertex on a crease, with the normals left and right.
pub(super) type OnCrease = (u32, [Vector3<f64>; 2]);

/// The way along a branch.
pub(super) struct Way {
    pub(super) vertices: Vec<OnCrease>,
    /// Other vertices of the loop that are on the crease.
    pub(super) beside: Vec<OnCrease>,
}

impl Way {
    pub(super) fn first(&self) -> u32 {
        self.vertices[0].0
    }

    pub(super) fn last(&self) -> u32 {
        self.vertices[self.vertices.len() - 1].0
    }

    /// All pairs of vertices of the loop on the crease, of which some are edges.
    pub(super) fn rim(&self) -> Vec<[u32; 2]> {
        let ends = [self.first(), self.last()];
        let all: Vec<u32> = self.beside.iter().map(|(v, _)| *v).chain(ends).collect();
        let pairs = all
            .iter()
            .enumerate()
            .flat_map(|(i, &v)| all[..i].iter().map(move |&w| [v, w]));
        pairs.collect()
    }
}

/// The ways along the branches of a crease, with `new` vertices about as far apart as around, times `length`; those to a corner share it.
pub(super) fn ways(
    around: &Surroundings,
    crease: &BoundaryCrease,
    length: f64,
    new: &mut Vec<CreaseVertex>,
) -> Option<Vec<Way>> {
    let sizes = around.sizes().0;
    let size = |end: &CreaseEnd| sizes[end.vertex as usize];
    let size = crease.ends.iter().map(size).sum::<f64>() / crease.ends.len() as f64;
    let mut add = |x, ends| {
        new.push(CreaseVertex { x, ends });
        (around.loop_vertices + new.len() - 1) as u32
    };
    let corners = corners(around, crease, size, &mut add)?;
    let parents = |knot: Knot, weight: f64| match knot {
        Knot::End(vertex) => vec![(vertex, weight)],
        Knot::Corner(c) => corners[c].1.iter().map(|(v, own)| (*v, own * weight)).collect(),
    };
    let mut way = |branch: &Branch| {
        let at = |knot: Knot, part: f64| match knot {
            Knot::End(vertex) => farthest(on_crease(around, branch, (vertex, part), size), part),
            Knot::Corner(c) => vec![(corners[c].0, part)],
        };
        let (start, end) = (at(branch.from, 0.0), at(branch.to, 1.0));
        let [(first, from), (last, to)] = [start[0], end[0]];
        let steps = ((to - from) * branch.length() / (size * length)).round().max(1.0);
        let mut inner = |k: u32| {
            let part = from + (to - from) * f64::from(k) / steps;
            let of = [parents(branch.from, 1.0 - part), parents(branch.to, part)].concat();
            (add(branch.at(part), three(&of)), part)
        };
        let mut all = vec![(first, from)];
        if first != last {
            all.extend((1..steps as u32).map(&mut inner));
            all.push((last, to));
        }
        let is_taken = around.taken.contains(&(first.min(last), first.max(last)));
        let is_way = first == last || from < to && !(all.len() == 2 && is_taken);
        let with_normals = |(v, part): (u32, f64)| (v, branch.normals(part));
        let beside = start[1..].iter().chain(&end[1..]).copied();
        is_way.then(|| Way {
            vertices: all.into_iter().map(with_normals).collect(),
            beside: beside.map(with_normals).collect(),
        })
    };
    crease.branches.iter().map(&mut way).collect()
}

/// A corner, and the vertices of the loop whose creases lead there, by their shares.
type SharedCorner = (u32, Vec<(u32, f64)>);

/// Each corner of a crease. One that the loop has already is no new vertex; `None` where it is one of two.
fn corners(
    around: &Surroundings,
    crease: &BoundaryCrease,
    size: f64,
    add: &mut impl FnMut(Vector3<f64>, [(u32, f64); 3]) -> u32,
) -> Option<Vec<SharedCorner>> {
    let of = |c: usize| {
        crease
            .branches
            .iter()
            .filter_map(move |branch| match (branch.from, branch.to) {
                (Knot::End(vertex), Knot::Corner(to)) if to == c => Some((branch, vertex)),
                _ => None,
            })
    };
    let count = (0..).take_while(|c| of(*c).next().is_some()).count();
    let corner = |c: usize| {
        let ends: Vec<u32> = of(c).map(|(_, end)| end).collect();
        let shares: Vec<(u32, f64)> = ends.iter().map(|v| (*v, 1.0 / ends.len() as f64)).collect();
        let at = of(c).next()?.0.at(1.0);
        let near = |v: &u32| (around.x[*v as usize] - at).norm() < Branch::ON * size;
        match (0..around.loop_vertices as u32).find(near) {
            Some(v) => (count == 1).then_some((v, shares)),
            None => Some((add(at, three(&shares)), shares)),
        }
    };
    (0..count).map(corner).collect()
}

/// The three largest weights of vertices, of the sum 1.
fn three(of: &[(u32, f64)]) -> [(u32, f64); 3] {
    let mut sums: Vec<(u32, f64)> = Vec::new();
    for &(v, weight) in of {
        match sums.iter_mut().find(|sum| sum.0 == v) {
            Some(sum) => sum.1 += weight,
            None => sums.push((v, weight)),
        }
    }
    sums.sort_by(|a, b| b.1.total_cmp(&a.1));
    sums.resize(3, (of[0].0, 0.0));
    let sum: f64 = sums.iter().map(|(_, weight)| weight).sum();
    [0, 1, 2].map(|k| (sums[k].0, sums[k].1 / sum))
}

/// The vertices of the loop that are on a branch, one near the other from an end of it on, and which part of it is before them: where the
/// loop runs along the crease, it is there already.
fn on_crease(around: &Surroundings, branch: &Branch, end: (u32, f64), edge: f64) -> Vec<(u32, f64)> {
    let count = around.loop_vertices as u32;
    let mut all = vec![end];
    for step in [1, count - 1] {
        let mut last = 0;
        for k in 1..count {
            let v = (end.0 + k * step) % count;
            match branch.part_of(&around.x[v as usize], edge) {
                Some(part) => {
                    all.push((v, part));
                    last = k;
                }
                None if k - last > GAP => break,
                None => {}
            }
        }
    }
    all
}

/// First the one that is farthest from this part.
fn farthest(mut all: Vec<(u32, f64)>, from: f64) -> Vec<(u32, f64)> {
    all.sort_by(|a, b| (b.1 - from).abs().total_cmp(&(a.1 - from).abs()));
    all
}
