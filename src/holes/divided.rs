//! A loop divided along the creases that go on through it: each side is a loop of its own, around which the mesh is parted.

use std::collections::HashMap;

use nalgebra::Vector3;

use super::crease_ways::{CreaseVertex, OnCrease, Way, ways};
use super::surroundings::Surroundings;
use crate::fairing::{BoundaryCrease, BoundaryNormals, CreaseEnd, Options};
use crate::mesh::NONE;
use crate::mesh::parted::{Parted, part};

/// A vertex of a side: one of the loop, or behind these a new one on a crease.
#[derive(Debug, Clone, Copy)]
struct Corner {
    v: u32,
    /// On creases the normal of this side, and that of the other one.
    normals: Option<[Vector3<f64>; 2]>,
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
    let cut = chains.flat_map(|end| {
        end.chains
            .iter()
            .flat_map(|chain| chain.windows(2))
            .map(|step| [step[0], step[1]])
    });
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
            polygons.iter_mut().for_each(|polygon| tell(way, polygon));
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

/// The normals along a loop that runs along the whole crease.
fn tell(way: &Way, polygon: &mut [Corner]) {
    let count = polygon.len();
    let (Some(corner), Some(end)) = (place(polygon, way.last()), way.beside.last()) else {
        return;
    };
    let Some(end) = place(polygon, end.0) else { return };
    let is_forward = (corner + count - end) % count < (end + count - corner) % count;
    let all = [&way.vertices[..], &way.beside].concat();
    let all = if is_forward { forward(&all) } else { backward(&all) };
    for corner in polygon.iter_mut().filter(|corner| corner.normals.is_none()) {
        let told = all.iter().find(|told| told.v == corner.v);
        corner.normals = told.and_then(|told| told.normals);
    }
}

fn place(polygon: &[Corner], v: u32) -> Option<usize> {
    polygon.iter().position(|corner| corner.v == v)
}

/// The parts of a polygon between every two of the ways to corners.
fn around_corners(polygon: &[Corner], ways: &[Way]) -> Option<Vec<Vec<Corner>>> {
    let of = |way| Some((place(polygon, Way::first(way))?, way));
    let mut order: Vec<(usize, &Way)> = ways.iter().filter_map(of).collect();
    order.sort_unstable_by_key(|(at, _)| *at);
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
