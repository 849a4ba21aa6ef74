//! A loop divided along the creases that go on through it: each side is a loop of its own, around which the mesh is parted.

use std::collections::HashMap;

use nalgebra::Vector3;

use super::surroundings::Surroundings;
use crate::fairing::{BoundaryCrease, BoundaryNormals, Branch, CreaseEnd, Knot, Options};
use crate::mesh::NONE;
use crate::mesh::parted::{Parted, part};

/// Vertices of the loop that are on a crease have no more than so many others between them.
/// Without any, of 30 holes in parts 3 are no longer closed along their creases; with double 1.
const GAP: u32 = 1;

/// A vertex of a side: one of the loop, or behind these a new one on a crease.
#[derive(Debug, Clone, Copy)]
struct Corner {
    v: u32,
    /// On creases the normal of this side, and that of the other one.
    normals: Option<[Vector3<f64>; 2]>,
}

/// A new vertex on a crease.
#[derive(Debug, Clone, Copy)]
pub(super) struct CreaseVertex {
    pub(super) x: Vector3<f64>,
    /// Vertices of the loop at which its creases end, and their weights.
    pub(super) ends: [(u32, f64); 3],
}

/// One side.
pub(super) struct Side {
    pub(super) around: Surroundings,
    pub(super) options: Options,
    /// Per vertex of `around` its number in the whole, where new vertices on creases come after all.
    pub(super) whole: Vec<u32>,
}

/// The sides of a loop.
pub(super) struct DividedLoop {
    pub(super) sides: Vec<Side>,
    pub(super) new: Vec<CreaseVertex>,
    /// Which creases divide it, and the vertices along each.
    pub(super) followed: Vec<(usize, Vec<u32>)>,
}

/// The division of the only loop of these surroundings; none where no crease goes on. `length` is that of new edges over those around.
pub(super) fn divide(
    around: &Surroundings,
    options: &Options,
    creases: &[BoundaryCrease],
    length: f64,
) -> Option<DividedLoop> {
    let all = (0..around.loop_vertices as u32).map(|v| Corner { v, normals: None });
    let mut polygons: Vec<Vec<Corner>> = vec![all.collect()];
    let mut new = Vec::new();
    let mut followed = Vec::new();
    let mut rims = Vec::new();
    for (i, crease) in (0..)
        .zip(creases)
        .filter(|(_, crease)| !crease.branches.is_empty())
    {
        let has = |polygon: &[Corner], end: &CreaseEnd| polygon.iter().any(|c| c.v == end.vertex);
        let has_all = |polygon: &Vec<Corner>| crease.ends.iter().all(|end| has(polygon, end));
        // Creases that cross have no polygon in common.
        if !polygons.iter().any(has_all) {
            continue;
        }
        let before = new.len();
        let ways = ways(around, crease, length, &mut new);
        let Some(ways) = ways.filter(|ways| split(&mut polygons, ways).is_some()) else {
            new.truncate(before);
            continue;
        };
        let along = ways.iter().flat_map(|way| way.vertices.iter().map(|(v, _)| *v));
        followed.push((i, along.collect()));
        rims.extend(ways.iter().flat_map(Way::rim));
    }
    if followed.is_empty() {
        return None;
    }
    let of: Vec<&BoundaryCrease> = followed.iter().map(|(i, _)| &creases[*i]).collect();
    let chains = of.iter().flat_map(|crease| &crease.ends);
    let cut = chains.flat_map(|end| end.chain.windows(2).map(|step| [step[0], step[1]]));
    let cut: Vec<[u32; 2]> = cut.chain(rims).collect();
    let parted = part(around.x.len(), &around.triangles, &cut);
    let run = Division {
        around,
        parted: &parted,
        half_edges: half_edges(around),
        near: of.iter().flat_map(|crease| crease.near.iter().copied()).collect(),
        new: &new,
    };
    let sides = polygons.iter().map(|polygon| run.side(polygon, options));
    let sides = sides.collect::<Option<_>>()?;
    Some(DividedLoop { sides, new, followed })
}

/// A vertex on a crease, with the normals left and right.
type OnCrease = (u32, [Vector3<f64>; 2]);

/// The way along a branch.
struct Way {
    vertices: Vec<OnCrease>,
    /// Other vertices of the loop that are on the crease.
    beside: Vec<OnCrease>,
}

impl Way {
    fn first(&self) -> u32 {
        self.vertices[0].0
    }

    fn last(&self) -> u32 {
        self.vertices[self.vertices.len() - 1].0
    }

    /// The normals along a loop that runs along the whole crease.
    fn tell(&self, polygon: &mut [Corner]) {
        let count = polygon.len();
        let (Some(corner), Some(end)) = (place(polygon, self.last()), self.beside.last()) else {
            return;
        };
        let Some(end) = place(polygon, end.0) else { return };
        let is_forward = (corner + count - end) % count < (end + count - corner) % count;
        let all = [&self.vertices[..], &self.beside].concat();
        let all = if is_forward { forward(&all) } else { backward(&all) };
        for corner in polygon.iter_mut().filter(|corner| corner.normals.is_none()) {
            let told = all.iter().find(|told| told.v == corner.v);
            corner.normals = told.and_then(|told| told.normals);
        }
    }

    /// All pairs of vertices of the loop on the crease, of which some are edges.
    fn rim(&self) -> Vec<[u32; 2]> {
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
fn ways(
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

/// Divides polygons along the ways of a crease: in two by each, or in as many as lead to new corners. `None` where these ways would cross.
fn split(polygons: &mut Vec<Vec<Corner>>, ways: &[Way]) -> Option<()> {
    let is_new = |way: &Way| {
        polygons
            .iter()
            .all(|polygon| place(polygon, way.last()).is_none())
    };
    if ways.iter().any(is_new) {
        // Ways from corner to corner begin in none.
        let begins = |polygon: &Vec<Corner>| {
            ways.iter()
                .filter(|way| place(polygon, way.first()).is_some())
                .count()
        };
        let most = polygons.iter().map(begins).max()?;
        let at = polygons.iter().position(|polygon| begins(polygon) == most)?;
        let parts = around_corners(&polygons[at], ways)?;
        polygons.swap_remove(at);
        polygons.extend(parts);
        return Some(());
    }
    for way in ways {
        if way.vertices.len() == 1 {
            polygons.iter_mut().for_each(|polygon| way.tell(polygon));
            continue;
        }
        let has = |polygon: &Vec<Corner>| Some([place(polygon, way.first())?, place(polygon, way.last())?]);
        let Some((at, [a, b])) = (0..).zip(polygons.iter()).find_map(|(i, p)| Some((i, has(p)?))) else {
            continue;
        };
        let polygon = polygons.swap_remove(at);
        let (left, right) = (forward(&way.vertices), backward(&way.vertices));
        polygons.push(between(&polygon, [a, b], right, &backward(&way.beside)));
        polygons.push(between(&polygon, [b, a], left, &forward(&way.beside)));
    }
    Some(())
}

fn place(polygon: &[Corner], v: u32) -> Option<usize> {
    polygon.iter().position(|corner| corner.v == v)
}

/// The parts of a polygon between every two of the ways to corners.
fn around_corners(polygon: &[Corner], ways: &[Way]) -> Option<Vec<Vec<Corner>>> {
    let of = |way| Some((place(polygon, Way::first(way))?, way));
    let mut order: Vec<(usize, &Way)> = ways.iter().filter_map(of).collect();
    order.sort_by_key(|(at, _)| *at);
    let mut between_corners = 0;
    let parts = (0..order.len()).map(|k| {
        let ((a, first), (b, second)) = (order[k], order[(k + 1) % order.len()]);
        // To the corner, from it to the other one, and back from there.
        let mut way = forward(&second.vertices);
        if second.last() != first.last() {
            way.extend(&joining(ways, [second.last(), first.last()])?[1..]);
            between_corners += 1;
        }
        way.extend(&backward(&first.vertices)[1..]);
        let beside = [forward(&second.beside), backward(&first.beside)].concat();
        Some(between(polygon, [a, b], way, &beside))
    });
    let parts = parts.collect::<Option<Vec<_>>>()?;
    // Around the tree the way between two corners is walked twice, once each way.
    (between_corners <= 2).then_some(parts)
}

/// The way from one corner to another.
fn joining(ways: &[Way], [from, to]: [u32; 2]) -> Option<Vec<Corner>> {
    ways.iter().find_map(|way| match [way.first(), way.last()] {
        ends if ends == [from, to] => Some(forward(&way.vertices)),
        ends if ends == [to, from] => Some(backward(&way.vertices)),
        _ => None,
    })
}

/// Vertices on a crease, as what is left of it has them.
fn forward(way: &[OnCrease]) -> Vec<Corner> {
    let corner = |&(v, [left, right]): &OnCrease| Corner {
        v,
        normals: Some([left, right]),
    };
    way.iter().map(corner).collect()
}

/// The way back, as what is right of it has it.
fn backward(way: &[OnCrease]) -> Vec<Corner> {
    let corner = |&(v, [left, right]): &OnCrease| Corner {
        v,
        normals: Some([right, left]),
    };
    way.iter().rev().map(corner).collect()
}

/// The polygon from one place to another, and then back along a way that begins and ends there. What is beside it has its normals.
fn between(polygon: &[Corner], [a, b]: [usize; 2], way: Vec<Corner>, beside: &[Corner]) -> Vec<Corner> {
    let count = polygon.len();
    let inner = (1..(b + count - a) % count).map(|k| {
        let corner = polygon[(a + k) % count];
        let on_crease = beside.iter().find(|c| c.v == corner.v);
        on_crease.copied().unwrap_or(corner)
    });
    let back = way[..way.len() - 1].iter().copied();
    way.last().copied().into_iter().chain(inner).chain(back).collect()
}

/// What the sides are made of.
struct Division<'a> {
    around: &'a Surroundings,
    parted: &'a Parted,
    /// The triangles of edges between vertices of the loop, and the corners where these begin.
    half_edges: HashMap<[u32; 2], (usize, usize)>,
    near: HashMap<u32, [f64; 3]>,
    new: &'a [CreaseVertex],
}

fn half_edges(around: &Surroundings) -> HashMap<[u32; 2], (usize, usize)> {
    let all = (0..).zip(&around.triangles);
    let edges = all.flat_map(|(t, tri)| (0..3).map(move |k| ([tri[k], tri[(k + 1) % 3]], (t, k))));
    let is_of_loop = |v: &u32| (*v as usize) < around.loop_vertices;
    edges.filter(|(ends, _)| ends.iter().all(is_of_loop)).collect()
}

impl Division<'_> {
    /// The loop of a side; `None` where an edge of it has no triangle.
    fn side(&self, polygon: &[Corner], options: &Options) -> Option<Side> {
        let (around, count) = (self.around, polygon.len());
        let known = around.x.len() as u32;
        let crease_vertex = |v: u32| v.checked_sub(around.loop_vertices as u32);
        // Of each vertex of the loop its number in the parted mesh.
        let mut parted = vec![NONE; count];
        let mut open = Vec::new();
        let mut normals = Vec::with_capacity(count);
        for k in 0..count {
            let [from, to] = [polygon[k], polygon[(k + 1) % count]];
            let own = self.loop_edge(from, to);
            if own {
                [parted[k], parted[(k + 1) % count]] = self.outside(from.v, to.v)?;
                normals.push(around.normals[from.v as usize]);
            } else {
                open.push([k, (k + 1) % count].map(|k| k as u32));
                let of = |c: Corner| c.normals.map_or_else(Vector3::zeros, |[own, _]| own);
                let sum = of(from) + of(to);
                normals.push(sum.try_normalize(1e-9).unwrap_or_default());
            }
        }
        let mut number: HashMap<u32, u32> = (0..)
            .zip(&parted)
            .filter(|(_, v)| **v != NONE)
            .map(|(k, v)| (*v, k))
            .collect();
        let original = |v: u32| {
            v.checked_sub(known)
                .map_or(v, |copy| self.parted.copy_of[copy as usize])
        };
        let mut whole: Vec<u32> = polygon
            .iter()
            .map(|c| crease_vertex(c.v).map_or(c.v, |new| known + new))
            .collect();
        let triangles = self.parted.triangles.iter().map(|tri| {
            tri.map(|v| {
                *number.entry(v).or_insert_with(|| {
                    whole.push(original(v));
                    whole.len() as u32 - 1
                })
            })
        });
        let triangles: Vec<[u32; 3]> = triangles.collect();
        let x = |v: &u32| {
            v.checked_sub(known)
                .map_or_else(|| around.x[*v as usize], |new| self.new[new as usize].x)
        };
        let around = around.with_loop(
            (whole.clone(), whole.iter().map(x).collect()),
            triangles,
            normals,
            (self.taken(polygon), open),
        );
        Some(Side {
            options: self.options(polygon, options),
            around,
            whole,
        })
    }

    /// Whether an edge is one of the loop whose triangle is on this side.
    fn loop_edge(&self, from: Corner, to: Corner) -> bool {
        if self.around.after(from.v) != Some(to.v) {
            return false;
        }
        let triangle = self.around.normals[from.v as usize];
        let on_crease = from.normals.zip(to.normals);
        on_crease.is_none_or(|(from, to)| triangle.dot(&(from[0] + to[0])) > triangle.dot(&(from[1] + to[1])))
    }

    /// The corners in the parted mesh of the triangle outside an edge of the loop.
    fn outside(&self, from: u32, to: u32) -> Option<[u32; 2]> {
        let &(t, k) = self.half_edges.get(&[to, from])?;
        let parted = self.parted.triangles[t];
        Some([parted[(k + 1) % 3], parted[k]])
    }

    /// Pairs of the side's vertices that the mesh has an edge between.
    fn taken(&self, polygon: &[Corner]) -> Vec<(u32, u32)> {
        let place: HashMap<u32, u32> = (0..).zip(polygon).map(|(k, c)| (c.v, k)).collect();
        let pair = |&(a, b): &(u32, u32)| {
            let (a, b) = (*place.get(&a)?, *place.get(&b)?);
            Some((a.min(b), a.max(b)))
        };
        let mut taken: Vec<(u32, u32)> = self.around.taken.iter().filter_map(pair).collect();
        taken.sort_unstable();
        taken
    }

    /// With the normals along creases, and beside their ends.
    fn options(&self, polygon: &[Corner], options: &Options) -> Options {
        let given = match &options.boundary_normals {
            BoundaryNormals::Given(list) => &list[..],
            BoundaryNormals::Fitted | BoundaryNormals::Averaged => &[],
        };
        let own = |(k, corner): (u32, &Corner)| {
            let at = given.binary_search_by_key(&corner.v, |entry| entry.0);
            let given = at.ok().map(|at| given[at].1);
            let normal = corner.normals.map(|[own, _]| own.into()).or(given);
            Some((k, normal.or_else(|| self.near.get(&corner.v).copied())?))
        };
        Options {
            boundary_normals: BoundaryNormals::Given((0..).zip(polygon).filter_map(own).collect()),
            ..options.clone()
        }
    }
}
