//! The mesh around some loops, ring after ring, and what of it lies around one of its vertices.

use fairmesh_linear::parallel;
use nalgebra::Vector3;

use super::fit::{Fit, Window};
use crate::holes::links::Links;
use crate::holes::loops::BoundaryLoop;
use crate::mesh::NONE;
use crate::mesh::halfedge::{next, previous};
use crate::mesh::rows::Rows;

/// Vertices around some loops, in numbers of their own: those of the loops first, then ring after ring.
pub(super) struct Band {
    /// The mesh's numbers.
    pub(super) ids: Vec<u32>,
    pub(super) x: Vec<Vector3<f64>>,
    /// Where each ring begins, and where the last one ends.
    pub(super) rings: Vec<usize>,
    pub(super) neighbours: Rows<u32>,
    /// Area times normal of the triangles around, not of unit length.
    pub(super) normals: Vec<Vector3<f64>>,
    /// The triangles at the vertices of the first rings, which may move, and per such vertex their numbers.
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) stars: Rows<u32>,
}

/// What is gathered around one vertex.
#[derive(Default)]
pub(super) struct Scratch {
    seen: Vec<bool>,
    found: Vec<u32>,
    points: Vec<(Vector3<f64>, f64)>,
}

impl Band {
    /// So many rings, that of the loops included; the vertices of the first `moving` ones may move. `place` is as long as the mesh has vertices, all [`NONE`]; it is left so.
    pub(super) fn new(
        links: &Links<'_>,
        positions: &[[f64; 3]],
        loops: &[&BoundaryLoop],
        rings: usize,
        moving: usize,
        place: &mut [u32],
    ) -> Self {
        let mut ids: Vec<u32> = Vec::new();
        let mut starts = vec![0];
        let is_finite = |v: u32| positions[v as usize].iter().all(|c| c.is_finite());
        let mut add = |v: u32, ids: &mut Vec<u32>| {
            if place[v as usize] == NONE && is_finite(v) {
                place[v as usize] = ids.len() as u32;
                ids.push(v);
            }
        };
        for v in loops.iter().flat_map(|of| &of.vertices) {
            add(*v, &mut ids);
        }
        starts.push(ids.len());
        for ring in 1..rings {
            for i in starts[ring - 1]..starts[ring] {
                around(links, ids[i]).for_each(|w| add(w, &mut ids));
            }
            starts.push(ids.len());
        }
        let pairs: Vec<(u32, u32)> = (0..)
            .zip(&ids)
            .flat_map(|(i, &v)| {
                let mut near: Vec<u32> = around(links, v).map(|w| place[w as usize]).collect();
                near.sort_unstable();
                near.dedup();
                near.into_iter().filter(|&j| j != NONE).map(move |j| (i, j))
            })
            .collect();
        let at = |v: u32| Vector3::from(positions[v as usize]);
        let normal = |&v: &u32| {
            let cross = |&h: &u32| {
                let [a, b, c] = links.triangles[h as usize / 3].map(at);
                (b - a).cross(&(c - a))
            };
            let all = links.at(v).iter().map(cross);
            all.filter(|n| n.iter().all(|c| c.is_finite())).sum()
        };
        let moving = starts[moving.min(starts.len() - 1)];
        let mut all: Vec<u32> = ids[..moving]
            .iter()
            .flat_map(|&v| links.at(v).iter().map(|h| h / 3))
            .collect();
        all.sort_unstable();
        all.dedup();
        let local = |t: u32| links.triangles[t as usize].map(|v| place[v as usize]);
        let triangles: Vec<[u32; 3]> = all
            .into_iter()
            .map(local)
            .filter(|t| !t.contains(&NONE))
            .collect();
        let corners = (0..).zip(&triangles).flat_map(|(i, t)| t.map(|v| (v, i)));
        let stars = Rows::collect(moving, corners.filter(|&(v, _)| (v as usize) < moving));
        let band = Self {
            triangles,
            stars,
            x: ids.iter().map(|&v| at(v)).collect(),
            rings: starts,
            neighbours: Rows::collect(ids.len(), pairs.iter().copied()),
            normals: ids.iter().map(normal).collect(),
            ids,
        };
        band.ids.iter().for_each(|&v| place[v as usize] = NONE);
        band
    }

    /// How many vertices the first rings have.
    pub(super) fn count(&self, rings: usize) -> usize {
        self.rings[rings.min(self.rings.len() - 1)]
    }

    /// Which ring a vertex is in.
    pub(super) fn ring(&self, v: usize) -> usize {
        self.rings.partition_point(|&start| start <= v) - 1
    }

    /// The mean length of the edges of the first vertices.
    pub(super) fn mean_edge(&self, vertices: usize) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for v in 0..vertices {
            for &w in self.neighbours.row(v) {
                sum += (self.x[v] - self.x[w as usize]).norm();
                count += 1.0;
            }
        }
        if count > 0.0 { sum / count } else { 0.0 }
    }

    /// The surface fitted at some vertices to what is nearer than a radius and hangs together.
    pub(super) fn fits(&self, vertices: &[usize], radius: f64) -> Vec<Option<Fit>> {
        let scratch = || Scratch {
            seen: vec![false; self.ids.len()],
            ..Scratch::default()
        };
        parallel::map_with(scratch, vertices.chunks(16), |scratch, vertices| {
            let fits = vertices.iter().map(|&v| self.fit(v, radius, scratch));
            fits.collect::<Vec<_>>()
        })
        .concat()
    }

    fn fit(&self, v: usize, radius: f64, scratch: &mut Scratch) -> Option<Fit> {
        let Scratch { seen, found, points } = scratch;
        found.clear();
        points.clear();
        found.push(v as u32);
        seen[v] = true;
        let at = self.x[v];
        let mut normal = Vector3::zeros();
        let mut i = 0;
        while i < found.len() {
            let w = found[i] as usize;
            i += 1;
            let far = (self.x[w] - at).norm_squared() / (radius * radius);
            points.push((self.x[w], 1.0 - far * far));
            normal += self.normals[w] * (1.0 - far * far);
            for &u in self.neighbours.row(w) {
                if !seen[u as usize] && (self.x[u as usize] - at).norm() < radius {
                    seen[u as usize] = true;
                    found.push(u);
                }
            }
        }
        found.iter().for_each(|&w| seen[w as usize] = false);
        let normal = normal.try_normalize(0.0)?;
        Window {
            at,
            points,
            radius,
            normal,
        }
        .fit()
    }
}

/// The vertices beside a vertex, some of them twice.
fn around<'l>(links: &'l Links<'_>, v: u32) -> impl Iterator<Item = u32> + use<'l> {
    let ends = links.at(v).iter().flat_map(|&h| [next(h), previous(h)]);
    ends.map(|g| links.origin(g))
}
