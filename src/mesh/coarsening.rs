//! A coarse mesh of a region, made of its connectivity and lengths of its edges alone: no position is looked at, so that
//! the surface found on it does not depend on where the interior of the input lies.
//!
//! Free vertices are removed by half-edge collapses. Around the vertex the triangles are laid flat by their edge lengths (its
//! angles are scaled to a full turn), the new edges get their lengths there, and the vertex keeps its mean value
//! coordinates (M. Floater, "Mean value coordinates", CAGD 20, 2003) in the ring that it leaves. They bring it back.

use super::halfedge::{next, previous};
use super::region::{Region, Selection};
use super::rows::Rows;
use super::{EditableMesh, NONE, Rings};
use crate::error::Error;

/// A collapse leaves no triangle with less than this roundness: edges grow slowly away from the boundary, none of whose
/// vertices are removed.
const LEAST_ROUNDNESS: f64 = 0.4;
/// From pass to pass, longer edges are collapsed by this factor.
const GROWTH: f64 = 1.5;
/// An edge is turned where the cosines of the angles opposite to it have a sum below zero by this,
const DELAUNAY: f64 = 1e-6;
/// and the angles at its ends do not exceed this part of 180 degrees.
const CONVEX: f64 = 0.95;
/// Nor is any angle of a ring that is laid flat less than this, in radians.
const NARROWEST: f64 = 0.02;
/// Sweeps over the radii of circles.
const SWEEPS: usize = 4;
/// The first edges that are collapsed are at most this many mean ones long of the region,
const FIRST: f64 = 1.1;
/// and none is longer than this many of them.
const LONGEST: f64 = 1e6;

/// A vertex that was removed.
#[derive(Debug, Clone, Copy)]
struct Removed {
    /// Its number in the region.
    vertex: u32,
}

/// A coarse mesh, and the way back.
#[derive(Debug, Clone)]
pub(crate) struct Coarsening {
    mesh: EditableMesh,
    /// The vertices removed, in this order,
    removed: Vec<Removed>,
    /// and the rings that they left, with the coordinates in them.
    rings: Rows<(u32, f64)>,
    /// The coordinates of the vertices that are left in their rings.
    left: Rows<(u32, f64)>,
    /// Of the half-edges of the region.
    lengths: Vec<f64>,
    free: usize,
}

/// Removes free vertices of `region` until at most `target` are left, or none can go without thin triangles. `length` is that of
/// the edge between two neighbours, in any unit.
pub(crate) fn coarsen(region: &Region, target: usize, length: impl Fn(u32, u32) -> f64) -> Coarsening {
    let mesh = EditableMesh::new(region);
    let triangles = region.triangles().iter();
    let lengths = triangles.flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)].map(|(u, v)| length(u, v)));
    let lengths: Vec<f64> = lengths.collect();
    let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
    let mut work = Work {
        coarsening: Coarsening {
            mesh,
            removed: Vec::new(),
            rings: Rows::default(),
            left: Rows::default(),
            lengths,
            free: region.free,
        },
        disk: Disk::default(),
    };
    let mut left: Vec<u32> = (0..region.free as u32).collect();
    let mut limit = FIRST * mean;
    while left.len() > target && limit < LONGEST * mean {
        let most = left.len() - target;
        let mut gone = 0;
        left.retain(|&u| {
            let goes = gone < most && work.remove(u, limit);
            gone += usize::from(goes);
            !goes
        });
        work.flip_to_delaunay();
        limit *= GROWTH;
    }
    for &u in &left {
        work.keep_left(u);
    }
    work.coarsening
}

impl Coarsening {
    /// How many free vertices are left.
    pub(crate) fn free(&self) -> usize {
        self.free - self.removed.len()
    }

    /// The coarse region with the same outside, and the lengths of its triangles' edges, from each corner to the next; its `vertex_ids` are the numbers of the region that it was made from.
    /// `positions` are those of all vertices of that region, those of its outside and beyond it.
    ///
    /// # Errors
    /// None is expected: a coarse mesh is as sound as the mesh that it was made from.
    pub(crate) fn region(
        &self,
        region: &Region,
        positions: &[[f64; 3]],
    ) -> Result<(Region, Vec<[f64; 3]>), Error> {
        let (numbers, triangles): (Vec<usize>, Vec<[u32; 3]>) = self.mesh.triangles().unzip();
        let triangles = [&triangles[..], &region.beyond].concat();
        let mut is_free = vec![true; self.free];
        self.removed
            .iter()
            .for_each(|r| is_free[r.vertex as usize] = false);
        let free: Vec<u32> = (0..self.free as u32).filter(|&v| is_free[v as usize]).collect();
        let coarse = Region::new(positions, &triangles, Selection::Vertices(&free))?;
        let of_region = &coarse.half_edges.triangle_ids[..coarse.triangles().len()];
        let length = |&t: &u32| {
            let first = 3 * numbers[t as usize];
            // A region's triangle keeps the order of its corners.
            [
                self.lengths[first],
                self.lengths[first + 1],
                self.lengths[first + 2],
            ]
        };
        let lengths = of_region.iter().map(length).collect();
        Ok((coarse, lengths))
    }

    /// Per free vertex that is left, in the order of their numbers, its neighbours and its coordinates among them: how the vertices of
    /// the fine mesh are spread, seen on the coarse one.
    pub(crate) fn coordinates(&self) -> &Rows<(u32, f64)> {
        &self.left
    }

    /// The removed vertices, the last one first, each with the ring that it left and its coordinates there: they sum to one.
    pub(crate) fn returning(&self) -> impl Iterator<Item = (u32, &[(u32, f64)])> {
        let removed = self.removed.iter().enumerate().rev();
        removed.map(|(k, removed)| (removed.vertex, self.rings.row(k)))
    }
}

/// Coarsening under way.
struct Work {
    coarsening: Coarsening,
    disk: Disk,
}

/// The triangles around a vertex, laid flat around it.
#[derive(Debug, Default)]
struct Disk {
    /// The half-edges that leave the vertex.
    edges: Vec<u32>,
    /// Where they end.
    points: Vec<[f64; 2]>,
    /// Angles at the vertex, scaled.
    angles: Vec<f64>,
    /// Collapses along edges that are short enough: their least roundness and number.
    choices: Vec<(f64, usize)>,
}

impl Work {
    /// Removes `u` along the edge no longer than `limit` whose collapse leaves the roundest triangles. Returns whether there is one.
    fn remove(&mut self, u: u32, limit: f64) -> bool {
        let Coarsening {
            mesh, lengths, rings, ..
        } = &mut self.coarsening;
        let is_short = |h: u32| lengths[h as usize] <= limit;
        if !mesh.outgoing(u).any(is_short) || !self.disk.lay_flat(mesh, lengths, u) {
            return false;
        }
        let disk = &mut self.disk;
        disk.rank_choices(lengths, limit);
        let is_allowed = |j: usize| mesh.can_collapse(disk.edges[j]) && !disk.joins_fixed(mesh, j);
        let allowed = disk.choices.iter().find(|(_, j)| is_allowed(*j));
        let Some(&(_, j)) = allowed else {
            return false;
        };
        self.disk.coordinates(mesh, rings);
        self.coarsening.removed.push(Removed { vertex: u });
        self.set_lengths(j);
        self.coarsening.mesh.collapse(self.disk.edges[j]);
        true
    }

    /// Turns edges that are not Delaunay by their lengths, in one sweep.
    fn flip_to_delaunay(&mut self) {
        for h in 0..self.coarsening.lengths.len() as u32 {
            let o = self.coarsening.mesh.opposite(h);
            if h < o && o != NONE && self.coarsening.mesh.in_region(o) {
                self.flip_if_better(h, o);
            }
        }
    }

    fn flip_if_better(&mut self, h: u32, o: u32) {
        let length = |h: u32| self.coarsening.lengths[h as usize];
        let [ab, bc, ca] = [length(h), length(next(h)), length(previous(h))];
        let [ad, db] = [length(next(o)), length(previous(o))];
        let cosine = |opposite: f64, p: f64, q: f64| {
            let cosine = (p * p + q * q - opposite * opposite) / (2.0 * p * q);
            cosine.clamp(-1.0, 1.0)
        };
        // The angles opposite to the edge exceed 180 degrees where their cosines have a negative sum.
        let is_delaunay = cosine(ab, bc, ca) + cosine(ab, ad, db) >= -DELAUNAY;
        if is_delaunay || !self.coarsening.mesh.can_flip(h) {
            return;
        }
        let at_a = cosine(bc, ab, ca).acos() + cosine(db, ab, ad).acos();
        let at_b = cosine(ca, ab, bc).acos() + cosine(ad, ab, db).acos();
        let is_convex = |a: f64| (NARROWEST..CONVEX * std::f64::consts::PI).contains(&a);
        if !is_convex(at_a) || !is_convex(at_b) {
            return;
        }
        let cd = (ca * ca + ad * ad - 2.0 * ca * ad * at_a.cos()).max(0.0).sqrt();
        self.coarsening.mesh.flip(h);
        for (h, l) in [(h, ad), (o, bc), (next(h), cd), (next(o), cd)] {
            self.coarsening.lengths[h as usize] = l;
        }
    }

    /// Keeps the coordinates of a vertex that stays; equal ones where its ring is too narrow.
    fn keep_left(&mut self, u: u32) {
        let Coarsening {
            mesh, lengths, left, ..
        } = &mut self.coarsening;
        if self.disk.lay_flat(mesh, lengths, u) {
            self.disk.coordinates(mesh, left);
        } else {
            let share = 1.0 / mesh.outgoing(u).count() as f64;
            mesh.outgoing(u).for_each(|h| left.push((mesh.target(h), share)));
            left.end_row();
        }
    }

    /// Gives the triangles that are left the lengths that they have once the vertex has moved to the end of edge `j`.
    fn set_lengths(&mut self, j: usize) {
        let Disk { edges, points, .. } = &self.disk;
        let lengths = &mut self.coarsening.lengths;
        let m = edges.len();
        let (after, before) = ((j + 1) % m, (j + m - 1) % m);
        let beside = [
            lengths[next(edges[j]) as usize],
            lengths[next(edges[before]) as usize],
        ];
        let to = |k: usize| match k {
            k if k == after => beside[0],
            k if k == before => beside[1],
            k => distance(points[j], points[k]),
        };
        for k in (0..m).filter(|&k| k != j && k != before) {
            lengths[edges[k] as usize] = to(k);
            lengths[previous(edges[k]) as usize] = to((k + 1) % m);
        }
    }
}

impl Disk {
    /// Lays the triangles around `u` flat; false where their lengths are those of no triangles.
    fn lay_flat(&mut self, mesh: &EditableMesh, lengths: &[f64], u: u32) -> bool {
        self.edges.clear();
        self.edges.extend(mesh.outgoing(u));
        self.angles.clear();
        let mut turn = 0.0;
        for &h in &self.edges {
            let [a, b, c] = [h, previous(h), next(h)].map(|h| lengths[h as usize]);
            let cosine = (a * a + b * b - c * c) / (2.0 * a * b);
            let angle = cosine.clamp(-1.0, 1.0).acos();
            turn += angle;
            self.angles.push(angle);
        }
        if turn.is_nan() || turn <= 0.0 {
            return false;
        }
        let scale = std::f64::consts::TAU / turn;
        self.points.clear();
        let mut at = 0.0f64;
        for (angle, &h) in self.angles.iter_mut().zip(&self.edges) {
            let (sin, cos) = at.sin_cos();
            let r = lengths[h as usize];
            self.points.push([r * cos, r * sin]);
            *angle *= scale;
            at += *angle;
        }
        // Else a mean value coordinate would not be positive, or not a number.
        let is_fit = |a: &f64| (NARROWEST..CONVEX * std::f64::consts::PI).contains(a);
        self.angles.iter().all(is_fit)
    }

    /// Mean value coordinates of the vertex in its ring, as another row.
    fn coordinates(&self, mesh: &EditableMesh, rows: &mut Rows<(u32, f64)>) {
        let m = self.edges.len();
        let half_tangent = |k: usize| (0.5 * self.angles[k]).tan();
        let weight = |k: usize| (half_tangent(k) + half_tangent((k + m - 1) % m)) / norm(self.points[k]);
        let sum: f64 = (0..m).map(weight).sum();
        for k in 0..m {
            rows.push((mesh.target(self.edges[k]), weight(k) / sum));
        }
        rows.end_row();
    }

    /// The collapses along edges up to `limit` that leave round triangles, the best first.
    fn rank_choices(&mut self, lengths: &[f64], limit: f64) {
        self.choices.clear();
        for (j, &h) in self.edges.iter().enumerate() {
            if lengths[h as usize] <= limit {
                let roundness = self.least_roundness(j);
                if roundness >= LEAST_ROUNDNESS {
                    self.choices.push((roundness, j));
                }
            }
        }
        self.choices
            .sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    }

    /// Whether the collapse along edge `j` makes an edge between two fixed vertices: that could cut the region apart.
    fn joins_fixed(&self, mesh: &EditableMesh, j: usize) -> bool {
        let m = self.edges.len();
        let is_fixed = |k: usize| !mesh.is_free(mesh.target(self.edges[k]));
        let is_beside = |k: usize| k == j || k == (j + 1) % m || j == (k + 1) % m;
        is_fixed(j) && (0..m).any(|k| !is_beside(k) && is_fixed(k))
    }

    /// Of the triangles that are left when the vertex moves to the end of edge `j`.
    fn least_roundness(&self, j: usize) -> f64 {
        let m = self.points.len();
        let mut least = f64::INFINITY;
        for k in 0..m {
            let next = (k + 1) % m;
            if k != j && next != j {
                least = least.min(roundness([self.points[j], self.points[k], self.points[next]]));
                if least < LEAST_ROUNDNESS {
                    return least;
                }
            }
        }
        least
    }
}

fn norm(a: [f64; 2]) -> f64 {
    (a[0] * a[0] + a[1] * a[1]).sqrt()
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    norm([b[0] - a[0], b[1] - a[1]])
}

/// `4 sqrt(3)` times the area over the sum of the squared edges: 1 for an equilateral triangle, at most 0 for one that is not
/// counter-clockwise.
fn roundness([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let (ab, ac) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let bc = [c[0] - b[0], c[1] - b[1]];
    let square = |e: [f64; 2]| e[0] * e[0] + e[1] * e[1];
    let sum = square(ab) + square(ac) + square(bc);
    2.0 * 3f64.sqrt() * (ab[0] * ac[1] - ab[1] * ac[0]) / sum
}

/// Radii of circles around the vertices of a region that touch their neighbours', about: then all edges are as alike as they can
/// be on a flat surface, whatever the valences. Those of the boundary are 1. (C. Collins, K. Stephenson, "A circle packing
/// algorithm", Computational Geometry 25, 2003; a few sweeps, which settle neighbours among themselves.)
pub(crate) fn circles(rings: &Rings) -> Vec<f64> {
    let mut radius = vec![1.0f64; rings.free() + rings.boundary()];
    for _ in 0..SWEEPS {
        for i in 0..rings.free() {
            let ring = rings.ring(i);
            let own = radius[i];
            let part = |j: u32| -> f64 { radius[j as usize] / (own + radius[j as usize]) };
            let m = ring.len();
            let half_angles = (0..m).map(|k| (part(ring[k]) * part(ring[(k + 1) % m])).sqrt().asin());
            let share = half_angles.sum::<f64>() / m as f64;
            let (now, full) = (share.sin(), (std::f64::consts::PI / m as f64).sin());
            radius[i] = own * now / (1.0 - now) * (1.0 - full) / full;
        }
    }
    radius
}

#[cfg(test)]
mod tests {
    use super::*;
    use fairmesh_shapes::{OUTSIDE, Sampling, Shape, cylinder_band, sphere_cap};
    use nalgebra::Vector3;

    const IRREGULAR: Sampling = Sampling::Irregular { seed: 3 };

    fn region_of(shape: &Shape) -> (Region, Vec<Vector3<f64>>) {
        let selection = Selection::Mask(&shape.free);
        let region = Region::new(&shape.positions, &shape.triangles, selection).unwrap();
        let x = region.positions(&shape.positions);
        (region, x)
    }

    /// A flat disc: the cap seen from above, in which every edge keeps the length that it has there.
    fn flat_disc() -> (Region, Vec<Vector3<f64>>) {
        let (region, mut x) = region_of(&sphere_cap(60.0, 2000, IRREGULAR, OUTSIDE));
        x.iter_mut().for_each(|p| p.z = 0.0);
        (region, x)
    }

    fn length(x: &[Vector3<f64>]) -> impl Fn(u32, u32) -> f64 {
        |u, v| (x[u as usize] - x[v as usize]).norm()
    }

    fn coarse_region(
        coarsening: &Coarsening,
        region: &Region,
        x: &[Vector3<f64>],
    ) -> (Region, Vec<[f64; 3]>) {
        let positions: Vec<[f64; 3]> = x.iter().map(|p| (*p).into()).collect();
        coarsening.region(region, &positions).unwrap()
    }

    #[test]
    fn a_coarse_mesh_is_sound_and_has_the_same_boundary() {
        for shape in [
            sphere_cap(130.0, 4000, IRREGULAR, OUTSIDE),
            cylinder_band(4000, Sampling::Regular, OUTSIDE),
        ] {
            let (region, x) = region_of(&shape);
            let radius = circles(&Rings::new(&region));
            let length = |u: u32, v: u32| radius[u as usize] + radius[v as usize];
            let target = 2 * region.boundary + 300;
            let coarsening = coarsen(&region, target, length);
            assert!(coarsening.free() <= target);
            let (coarse, lengths) = coarse_region(&coarsening, &region, &x);
            coarse.validate().unwrap();
            assert_eq!(
                (coarse.free, coarse.boundary),
                (coarsening.free(), region.boundary)
            );
            assert_eq!((coarse.components, lengths.len()), (1, coarse.triangles().len()));
            let boundary: Vec<u32> = (region.free as u32..region.region_vertices() as u32).collect();
            assert!(coarse.vertex_ids[coarse.free..].starts_with(&boundary));
        }
    }

    /// By lengths of a flat mesh coordinates are exact: every vertex comes back to where it was.
    #[test]
    fn on_a_flat_mesh_vertices_come_back_to_their_places() {
        let (region, x) = flat_disc();
        let coarsening = coarsen(&region, 300, length(&x));
        assert!(coarsening.free() < 700, "{}", coarsening.free());
        let mut back = x.clone();
        for (u, ring) in coarsening.returning() {
            assert!((ring.iter().map(|(_, w)| w).sum::<f64>() - 1.0).abs() < 1e-12);
            back[u as usize] = ring.iter().map(|&(j, w)| back[j as usize] * w).sum();
        }
        for (p, q) in back.iter().zip(&x) {
            assert!((p - q).norm() < 1e-9, "{p} {q}");
        }
    }

    /// Nor does turning edges or collapsing them change lengths there.
    #[test]
    fn on_a_flat_mesh_lengths_are_distances() {
        let (region, x) = flat_disc();
        let coarsening = coarsen(&region, 300, length(&x));
        let (coarse, lengths) = coarse_region(&coarsening, &region, &x);
        let place = |v: u32| x[coarse.vertex_ids[v as usize] as usize];
        for (t, l) in coarse.triangles().iter().zip(&lengths) {
            for k in 0..3 {
                let distance = (place(t[k]) - place(t[(k + 1) % 3])).norm();
                assert!((distance - l[k]).abs() < 1e-9, "{t:?}");
            }
        }
    }

    #[test]
    fn where_the_interior_lies_does_not_matter() {
        let shape = sphere_cap(60.0, 3000, IRREGULAR, OUTSIDE);
        let (region, _) = region_of(&shape);
        let moved = shape.random(5);
        let other = Region::new(&moved, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
        let of = |region: &Region| {
            let radius = circles(&Rings::new(region));
            let coarsening = coarsen(region, 500, |u, v| radius[u as usize] + radius[v as usize]);
            coarsening
                .returning()
                .map(|(u, ring)| (u, ring.to_vec()))
                .collect::<Vec<_>>()
        };
        assert_eq!(of(&region), of(&other));
    }

    /// Six circles of radius 1 touch one of radius 1, and each other.
    #[test]
    fn circles_of_a_lattice_are_all_alike() {
        let (region, _) = region_of(&cylinder_band(600, Sampling::Regular, OUTSIDE));
        assert!(
            circles(&Rings::new(&region))
                .iter()
                .all(|r| (r - 1.0).abs() < 1e-12)
        );
    }
}
