//! A coarse mesh of a region, made of its connectivity and lengths of its edges alone: no position is looked at, so that
//! the surface found on it does not depend on where the interior of the input lies.
//!
//! Free vertices are removed by half-edge collapses. Around the vertex the triangles are laid flat by their edge lengths (its
//! angles grow by as much each, to a full turn), the new edges get their lengths there, and the vertex keeps its mean value
//! coordinates (M. Floater, "Mean value coordinates", CAGD 20, 2003) in the ring that it leaves. They bring it back.

use fairmesh_linear::interrupt::checkpoint;

use super::disk::{Disk, half_tangent, is_fit};
use super::editable::EditableMesh;
use super::halfedge::NONE;
use super::halfedge::{next, previous};
use super::region::RegionMesh;
use super::rows::Rows;
use super::selection::Selection;

/// From pass to pass, longer edges are collapsed by this factor.
/// Of 10 cases, half: 7 change, -54 % iterations, 7 fail; double: 7 change by up to 2 edges, -2 % iterations.
const GROWTH: f64 = 1.5;
/// An edge is turned where the cosines of the angles opposite to it have a sum below zero by this.
/// Half or double, of 10 cases: none changes.
const DELAUNAY: f64 = 1e-6;
/// Edges that are collapsed first are at most this long, in mean edges of the region.
/// Of 10 cases, half: 8 change by up to 2 edges, +5 % iterations; double: 10 change by up to 2 edges, +6 % iterations.
const FIRST: f64 = 1.1;
/// Edges longer than this, in mean edges of the region, are never collapsed.
/// Of 10 cases, half: none changes; double: only the progress changes.
const LONGEST: f64 = 1e6;

/// A coarse mesh, and the way back.
#[derive(Debug, Clone)]
pub(crate) struct Coarsening {
    mesh: EditableMesh,
    /// The vertices removed, in this order,
    removed: Vec<u32>,
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
pub(crate) fn coarsen(region: &RegionMesh, target: usize, length: impl Fn(u32, u32) -> f64) -> Coarsening {
    let (mut work, mean) = Decimation::new(region, length);
    work.changed = (0..region.triangles().len() as u32).collect();
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

/// Removes free vertices of `region` along edges up to the length that each allows, in mean edges. Where that is 0 they stay, and no
/// edge of their triangles is turned.
pub(crate) fn coarsen_graded(
    region: &RegionMesh,
    length: impl Fn(u32, u32) -> f64,
    longest: &[f64],
) -> Coarsening {
    let (mut work, mean) = Decimation::new(region, length);
    work.stays = longest.iter().map(|&l| l == 0.0).collect();
    let most = longest.iter().copied().fold(0.0, f64::max);
    let mut left: Vec<u32> = (0..region.free as u32)
        .filter(|&u| longest[u as usize] > 0.0)
        .collect();
    let mut limit = FIRST * mean;
    loop {
        left.retain(|&u| !work.remove(u, limit.min(mean * longest[u as usize])));
        work.flip_to_delaunay();
        if limit > mean * most {
            return work.coarsening;
        }
        limit *= GROWTH;
    }
}

impl Coarsening {
    /// The triangles of the region with the lengths of their edges, from each corner to the next.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = ([u32; 3], [f64; 3])> {
        let all = self.mesh.triangles();
        let region = all.filter(|(t, _)| 3 * t < self.lengths.len());
        region.map(|(t, corners)| (corners, std::array::from_fn(|k| self.lengths[3 * t + k])))
    }

    /// The removed vertices, the first one first, each with the ring that it left and its coordinates there.
    pub(crate) fn going(&self) -> impl Iterator<Item = (u32, &[(u32, f64)])> {
        let removed = self.removed.iter().enumerate();
        removed.map(|(k, &vertex)| (vertex, self.rings.row(k)))
    }

    /// How many free vertices are left.
    pub(crate) fn free(&self) -> usize {
        self.free - self.removed.len()
    }

    /// The coarse region with the same outside, and the lengths of its triangles' edges, from each corner to the next; its `vertex_ids` are the numbers of the region that it was made from.
    /// `positions` are those of all vertices of that region, those of its outside and beyond it. `None` where a triangle of the outside
    /// would be one of the region: between fixed vertices of a closed curve along which the region is cut.
    pub(crate) fn region(
        &self,
        region: &RegionMesh,
        positions: &[[f64; 3]],
    ) -> Option<(RegionMesh, Vec<[f64; 3]>)> {
        let (numbers, triangles): (Vec<usize>, Vec<[u32; 3]>) = self.mesh.triangles().unzip();
        let triangles = [&triangles[..], &region.beyond].concat();
        let mut is_free = vec![true; self.free];
        self.removed.iter().for_each(|&v| is_free[v as usize] = false);
        let free: Vec<u32> = (0..self.free as u32).filter(|&v| is_free[v as usize]).collect();
        let coarse = RegionMesh::new(positions, &triangles, Selection::Vertices(&free)).ok()?;
        let of_region = &coarse.half_edges.triangle_ids[..coarse.triangles().len()];
        // A region's triangle keeps the order of its corners.
        let (lengths, _) = self.lengths.as_chunks();
        let of = |&t: &u32| lengths.get(*numbers.get(t as usize)?).copied();
        let lengths = of_region.iter().map(of).collect::<Option<_>>()?;
        Some((coarse, lengths))
    }

    /// Per free vertex that is left, in the order of their numbers, its neighbours and its coordinates among them: how the vertices of
    /// the fine mesh are spread, seen on the coarse one.
    pub(crate) fn coordinates(&self) -> &Rows<(u32, f64)> {
        &self.left
    }

    /// The removed vertices, the last one first, each with the ring that it left and its coordinates there: they sum to one.
    pub(crate) fn returning(&self) -> impl Iterator<Item = (u32, &[(u32, f64)])> {
        let removed = self.removed.iter().enumerate().rev();
        removed.map(|(k, &vertex)| (vertex, self.rings.row(k)))
    }
}

/// Coarsening under way.
struct Decimation {
    coarsening: Coarsening,
    disk: Disk,
    /// The triangles that were changed since edges were turned last, some of them more than once.
    changed: Vec<u32>,
    /// Per triangle of the region whether it is among them, while edges are turned.
    is_changed: Vec<bool>,
    /// Vertices whose triangles' edges are not turned; none beyond its end.
    stays: Vec<bool>,
}

impl Decimation {
    /// The region as it is, and the mean length of its triangles' edges.
    fn new(region: &RegionMesh, length: impl Fn(u32, u32) -> f64) -> (Self, f64) {
        let mesh = EditableMesh::new(region);
        let triangles = mesh.region_triangles().iter();
        let lengths = triangles.flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)].map(|(u, v)| length(u, v)));
        let lengths: Vec<f64> = lengths.collect();
        let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
        let coarsening = Coarsening {
            mesh,
            removed: Vec::with_capacity(region.free),
            rings: Rows::default(),
            left: Rows::default(),
            lengths,
            free: region.free,
        };
        let work = Self {
            coarsening,
            disk: Disk::default(),
            changed: Vec::new(),
            is_changed: vec![false; region.triangles().len()],
            stays: Vec::new(),
        };
        (work, mean)
    }

    /// Removes `u` along the edge no longer than `limit` whose collapse leaves the roundest triangles. Returns whether there is one.
    fn remove(&mut self, u: u32, limit: f64) -> bool {
        checkpoint();
        let (disk, coarsening) = (&mut self.disk, &mut self.coarsening);
        let mesh = &coarsening.mesh;
        if !disk.gather(mesh, &coarsening.lengths, u, limit) || !disk.lay_flat() {
            return false;
        }
        disk.rank_choices(limit);
        let is_allowed = |j: usize| {
            mesh.can_collapse_from(disk.edges[j], |w| disk.ring.contains(&w)) && !disk.joins_fixed(mesh, j)
        };
        let allowed = disk.choices.iter().find(|(_, j)| is_allowed(*j));
        let Some(&(_, j)) = allowed else {
            return false;
        };
        disk.coordinates(&mut coarsening.rings);
        coarsening.removed.push(u);
        self.set_lengths(j);
        self.coarsening.mesh.collapse(self.disk.edges[j]);
        true
    }

    /// Gives the triangles that are left the lengths that they have once the vertex has moved to the end of edge `j`.
    fn set_lengths(&mut self, j: usize) {
        let (disk, lengths) = (&self.disk, &mut self.coarsening.lengths);
        let m = disk.edges.len();
        let before = (j + m - 1) % m;
        // Beside that edge there is one already.
        let mut to = lengths[next(disk.edges[j]) as usize];
        for k in (j + 1..j + m - 1).map(|k| k % m) {
            let after = (k + 1) % m;
            let from = to;
            to = if after == before {
                lengths[next(disk.edges[before]) as usize]
            } else {
                disk.distance(j, after)
            };
            let h = disk.edges[k];
            lengths[h as usize] = from;
            lengths[previous(h) as usize] = to;
            self.changed.push(h / 3);
        }
    }

    /// Turns edges of changed triangles that are not Delaunay by their lengths, in one sweep.
    fn flip_to_delaunay(&mut self) {
        let mut changed = std::mem::take(&mut self.changed);
        changed.retain(|&t| {
            let is_first = !self.is_changed[t as usize];
            self.is_changed[t as usize] = true;
            is_first && self.coarsening.mesh.is_there(t)
        });
        for h in changed.iter().flat_map(|&t| 3 * t..3 * t + 3) {
            let o = self.coarsening.mesh.opposite(h);
            let is_inner = o != NONE && self.coarsening.mesh.in_region(o);
            // Of two changed triangles the first one has the edge.
            if is_inner && (h < o || !self.is_changed[o as usize / 3]) && self.flip_if_better(h, o) {
                self.changed.extend([h / 3, o / 3]);
            }
        }
        changed.iter().for_each(|&t| self.is_changed[t as usize] = false);
    }

    fn flip_if_better(&mut self, h: u32, o: u32) -> bool {
        let length = |h: u32| self.coarsening.lengths[h as usize];
        let mesh = &self.coarsening.mesh;
        let corners = [mesh.origin(h), mesh.target(h), mesh.apex(h), mesh.apex(o)];
        if corners.iter().any(|&v| self.stays.get(v as usize) == Some(&true)) {
            return false;
        }
        let [ab, bc, ca] = [length(h), length(next(h)), length(previous(h))];
        let [ad, db] = [length(next(o)), length(previous(o))];
        // The angles opposite to the edge exceed 180 degrees where their cosines have a negative sum.
        let (at_c, at_d) = (bc * ca, ad * db);
        let cosines = (bc * bc + ca * ca - ab * ab) * at_d + (ad * ad + db * db - ab * ab) * at_c;
        if cosines >= -2.0 * DELAUNAY * at_c * at_d || !self.coarsening.mesh.can_flip(h) {
            return false;
        }
        let both = |s: f64, t: f64| (s + t) / (1.0 - s * t);
        let at_a = both(half_tangent(ab, ca, bc), half_tangent(ab, ad, db));
        let at_b = both(half_tangent(ab, bc, ca), half_tangent(ab, db, ad));
        if !is_fit(at_a) || !is_fit(at_b) {
            return false;
        }
        let cosine = (1.0 - at_a * at_a) / (1.0 + at_a * at_a);
        let cd = (ca * ca + ad * ad - 2.0 * ca * ad * cosine).max(0.0).sqrt();
        self.coarsening.mesh.flip(h);
        for (h, l) in [(h, ad), (o, bc), (next(h), cd), (next(o), cd)] {
            self.coarsening.lengths[h as usize] = l;
        }
        true
    }

    /// Keeps the coordinates of a vertex that stays; equal ones where its ring is too narrow.
    fn keep_left(&mut self, u: u32) {
        let Coarsening {
            mesh, lengths, left, ..
        } = &mut self.coarsening;
        self.disk.gather(mesh, lengths, u, f64::INFINITY);
        if self.disk.lay_flat() {
            self.disk.coordinates(left);
        } else {
            self.disk.equal_coordinates(left);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Rings;
    use crate::mesh::circles::circles;
    use fairmesh_shapes::{OUTSIDE, Sampling, Shape, cylinder_band, sphere_cap};
    use nalgebra::Vector3;

    const IRREGULAR: Sampling = Sampling::Irregular { seed: 3 };

    fn region_of(shape: &Shape) -> (RegionMesh, Vec<Vector3<f64>>) {
        let selection = Selection::Mask(&shape.free);
        let region = RegionMesh::new(&shape.positions, &shape.triangles, selection).unwrap();
        let x = region.positions(&shape.positions);
        (region, x)
    }

    /// A flat disc: the cap seen from above, in which every edge keeps the length that it has there.
    fn flat_disc() -> (RegionMesh, Vec<Vector3<f64>>) {
        let (region, mut x) = region_of(&sphere_cap(60.0, 2000, IRREGULAR, OUTSIDE));
        x.iter_mut().for_each(|p| p.z = 0.0);
        (region, x)
    }

    fn length(x: &[Vector3<f64>]) -> impl Fn(u32, u32) -> f64 {
        |u, v| (x[u as usize] - x[v as usize]).norm()
    }

    fn coarse_region(
        coarsening: &Coarsening,
        region: &RegionMesh,
        x: &[Vector3<f64>],
    ) -> (RegionMesh, Vec<[f64; 3]>) {
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
            assert_at_most!(coarsening.free(), target);
            let (coarse, lengths) = coarse_region(&coarsening, &region, &x);
            coarse.validate().unwrap();
            assert_eq!(
                (coarse.free, coarse.boundary),
                (coarsening.free(), region.boundary)
            );
            assert_eq!((coarse.components, lengths.len()), (1, coarse.triangles().len()));
            let boundary: Vec<u32> = (region.free as u32..region.region_vertices() as u32).collect();
            assert_begins!(coarse.vertex_ids[coarse.free..], &boundary);
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
            assert_near!(ring.iter().map(|(_, w)| w).sum::<f64>(), 1.0, 1e-12);
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

    /// Where angles of a ring do not make a full turn, edges around it keep other lengths than they have when it is laid flat: there a
    /// triangle could get edges that no triangle has, and on its coarse mesh there was no linear surface.
    #[test]
    fn lengths_on_a_coarse_mesh_are_those_of_round_triangles() {
        let (region, x) = region_of(&sphere_cap(60.0, 3000, IRREGULAR, OUTSIDE));
        let uneven = |u: u32| 1.0 + f64::from(u % 7) / 4.0;
        let coarsening = coarsen(&region, 600, |u, v| uneven(u) + uneven(v));
        let (_, lengths) = coarse_region(&coarsening, &region, &x);
        for [a, b, c] in lengths {
            let area = ((a + b + c) * (b + c - a) * (c + a - b) * (a + b - c)).sqrt() / 4.0;
            let roundness = 4.0 * 3f64.sqrt() * area / (a * a + b * b + c * c);
            assert!(roundness > 0.3, "{roundness}: {a} {b} {c}");
        }
    }

    #[test]
    fn where_the_interior_lies_does_not_matter() {
        let shape = sphere_cap(60.0, 3000, IRREGULAR, OUTSIDE);
        let (region, _) = region_of(&shape);
        let moved = shape.random(5);
        let other = RegionMesh::new(&moved, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
        let of = |region: &RegionMesh| {
            let radius = circles(&Rings::new(region));
            let coarsening = coarsen(region, 500, |u, v| radius[u as usize] + radius[v as usize]);
            coarsening
                .returning()
                .map(|(u, ring)| (u, ring.to_vec()))
                .collect::<Vec<_>>()
        };
        assert_eq!(of(&region), of(&other));
    }
}
