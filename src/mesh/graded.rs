//! A region's mesh made coarser and coarser away from its boundary: what falls off with the distance from there is as exact on
//! it as on the mesh itself, with few vertices.

use nalgebra::Vector3;

use super::circles::circles;
use super::coarsening::coarsen_graded;
use super::halfedge::NONE;
use super::region::RegionMesh;
use super::rings::Rings;
use super::rows::Rows;

/// Rows of vertices beside the boundary that are all kept.
/// Half or double, of 2 cases: 2 change by up to 8e-6 edges.
const KEPT: u32 = 2;
/// From row to row edges are collapsed that are longer by this, in mean edges.
/// Half or double, of 2 cases: 2 change by up to 8e-6 edges.
const GRADE: f64 = 0.1;
/// Edges of the first row that is not kept.
/// Of 2 cases, half: 2 change by up to 8e-6 edges; double: 2 change by up to 9e-6 edges.
const FIRST: f64 = 0.8;

/// A graded mesh. Its vertices have places: those of free vertices, then those of the region's boundary.
#[derive(Debug)]
pub(crate) struct GradedMesh {
    /// The free vertices that are left, ascending.
    pub vertices: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    /// The lengths of their edges by connectivity, from each corner to the next.
    lengths: Vec<[f64; 3]>,
    /// Free vertices that are not there, in the order in which they went,
    removed: Vec<u32>,
    /// and the rings that they left, with their coordinates in them.
    left_rings: Rows<(u32, f32)>,
    /// Per free place its neighbours, ascending,
    pub ring: Rows<u32>,
    /// and whether they are those in the region.
    pub is_whole: Vec<bool>,
    /// The free neighbours of each boundary vertex in the order of the region's ring: all are there.
    pub beside: Vec<Vec<u32>>,
}

impl GradedMesh {
    /// The graded mesh of a region, made of its connectivity alone.
    pub(crate) fn new(region: &RegionMesh, rings: &Rings) -> Self {
        let free = region.free;
        let radius = circles(rings);
        let length = |u: u32, v: u32| radius[u as usize] + radius[v as usize];
        let coarsening = coarsen_graded(region, length, &longest(rings));
        let (triangles, lengths): (Vec<[u32; 3]>, Vec<[f64; 3]>) = coarsening.triangles().unzip();
        let (mut removed, mut left_rings) = (Vec::new(), Rows::default());
        for (v, ring) in coarsening.going() {
            removed.push(v);
            ring.iter().for_each(|&(j, w)| left_rings.push((j, w as f32)));
            left_rings.end_row();
        }
        drop(coarsening);
        let mut place = vec![0; region.region_vertices()];
        removed.iter().for_each(|&v| place[v as usize] = NONE);
        let vertices: Vec<u32> = (0..free as u32).filter(|&v| place[v as usize] == 0).collect();
        let there = vertices.iter().copied().chain(free as u32..place.len() as u32);
        (0..).zip(there).for_each(|(s, v)| place[v as usize] = s);
        let place = |v: u32| place[v as usize];
        let triangles: Vec<[u32; 3]> = triangles.into_iter().map(|t| t.map(place)).collect();
        let ring = neighbours(vertices.len(), &triangles);
        let is_whole = vertices.iter().enumerate().map(|(s, &v)| {
            let (fine, own) = (rings.ring(v as usize), ring.row(s));
            fine.len() == own.len() && fine.iter().all(|&j| own.contains(&place(j)))
        });
        let beside = (0..rings.boundary()).map(|b| {
            let ring = rings.boundary_ring(b).iter();
            ring.filter(|&&j| region.is_free(j)).map(|&j| place(j)).collect()
        });
        Self {
            is_whole: is_whole.collect(),
            beside: beside.collect(),
            vertices,
            triangles,
            lengths,
            removed,
            left_rings,
            ring,
        }
    }

    /// How many free vertices are left.
    pub(crate) fn free(&self) -> usize {
        self.vertices.len()
    }

    /// The free neighbours of a free place.
    pub(crate) fn free_ring(&self, s: usize) -> impl Iterator<Item = u32> {
        let ring = self.ring.row(s).iter().copied();
        ring.filter(|&j| (j as usize) < self.free())
    }

    /// The place of a vertex of the region of so many `free` vertices that is there.
    pub(crate) fn place(&self, v: u32, free: usize) -> u32 {
        if (v as usize) < free {
            self.vertices.binary_search(&v).map_or(NONE, |s| s as u32)
        } else {
            v - free as u32 + self.free() as u32
        }
    }

    /// Cotangent weights, parallel to `ring`, at the region's surface `x` of so many `free` vertices; by connectivity without one.
    pub(crate) fn cotangent_weights(&self, free: usize, x: Option<&[Vector3<f64>]>) -> Vec<f64> {
        let mut weight = vec![0.0; self.ring.values().len()];
        let at = |s: u32| {
            let s = s as usize;
            self.vertices
                .get(s)
                .map_or(s + free - self.free(), |&v| v as usize)
        };
        for (t, lengths) in self.triangles.iter().zip(&self.lengths) {
            let squares: [f64; 3] = match x {
                Some(x) => std::array::from_fn(|k| (x[at(t[k])] - x[at(t[(k + 1) % 3])]).norm_squared()),
                None => lengths.map(|l| l * l),
            };
            let cotangents = half_cotangents(squares);
            for k in 0..3 {
                for (u, v) in [(t[k], t[(k + 1) % 3]), (t[(k + 1) % 3], t[k])] {
                    if (u as usize) < self.free()
                        && let Ok(c) = self.ring.row(u as usize).binary_search(&v)
                    {
                        weight[self.ring.range(u as usize).start + c] += 2.0 * cotangents[k];
                    }
                }
            }
        }
        weight
    }

    /// What a quantity per free vertex of the region sums up to at those that are left, when each that goes gives its own to its ring.
    pub(crate) fn gather(&self, mut of: Vec<f64>) -> Vec<f64> {
        for (k, &v) in self.removed.iter().enumerate() {
            let own = of[v as usize];
            for &(j, w) in self.left_rings.row(k) {
                if let Some(sum) = of.get_mut(j as usize) {
                    *sum += own * f64::from(w);
                }
            }
        }
        self.vertices.iter().map(|&v| of[v as usize]).collect()
    }
}

/// Half the cotangents of a triangle's angles opposite to its edges, by their squared lengths; bounded where it is a line.
fn half_cotangents(squares: [f64; 3]) -> [f64; 3] {
    const FLATTEST: f64 = 1e-12;
    let [a, b, c] = squares;
    let sum = a + b + c;
    let sixteen_areas = 2.0 * (a * b + b * c + c * a) - (a * a + b * b + c * c);
    let four_areas = sixteen_areas
        .max(FLATTEST * sum * sum)
        .max(f64::MIN_POSITIVE)
        .sqrt();
    squares.map(|s| 0.5 * (sum - 2.0 * s) / four_areas)
}

/// Per free vertex the longest edge along which it may go, in mean edges; 0: it stays.
fn longest(rings: &Rings) -> Vec<f64> {
    let of = |row: u32| {
        if row <= KEPT {
            0.0
        } else {
            FIRST + GRADE * f64::from(row - KEPT)
        }
    };
    distances(rings).into_iter().map(of).collect()
}

/// How many edges each free vertex is away from the boundary; 0 where no path leads there.
fn distances(rings: &Rings) -> Vec<u32> {
    let mut distance = vec![0; rings.free()];
    let mut found: Vec<u32> = Vec::new();
    for &j in rings.boundary_neighbour.values() {
        if let Some(d @ 0) = distance.get_mut(j as usize) {
            *d = 1;
            found.push(j);
        }
    }
    let mut k = 0;
    while let Some(&i) = found.get(k) {
        let next = distance[i as usize] + 1;
        for &j in rings.ring(i as usize) {
            if let Some(d @ 0) = distance.get_mut(j as usize) {
                *d = next;
                found.push(j);
            }
        }
        k += 1;
    }
    distance
}

/// Per free place its neighbours, ascending.
fn neighbours(free: usize, triangles: &[[u32; 3]]) -> Rows<u32> {
    let edges = triangles.iter();
    let edges = edges.flat_map(|&[a, b, c]| [(a, b), (b, a), (b, c), (c, b), (c, a), (a, c)]);
    let mut pairs: Vec<(u32, u32)> = edges.filter(|(a, _)| (*a as usize) < free).collect();
    pairs.sort_unstable();
    pairs.dedup();
    Rows::collect(free, pairs.into_iter())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Selection;
    use fairmesh_shapes::{OUTSIDE, Sampling, Shape, cylinder_band, sphere_cap};

    fn graded(shape: &Shape) -> (RegionMesh, Rings, GradedMesh) {
        let region =
            RegionMesh::new(&shape.positions, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
        let rings = Rings::new(&region);
        let mesh = GradedMesh::new(&region, &rings);
        (region, rings, mesh)
    }

    fn cap(free: usize) -> Shape {
        sphere_cap(60.0, free, Sampling::Irregular { seed: 3 }, OUTSIDE)
    }

    #[test]
    fn it_is_fine_at_the_boundary_and_coarse_inside() {
        let (region, rings, mesh) = graded(&cap(20_000));
        assert!(5 * mesh.free() < region.free, "{}", mesh.free());
        let distance = distances(&rings);
        let is_left = |v: usize| mesh.vertices.binary_search(&(v as u32)).is_ok();
        for v in (0..region.free).filter(|&v| distance[v] <= KEPT) {
            assert!(is_left(v), "{v}");
            let s = mesh.place(v as u32, region.free) as usize;
            assert!(mesh.is_whole[s] || distance[v] == KEPT, "{v}: {}", distance[v]);
        }
        assert_all!(mesh.beside.iter().flatten(), |&s| s != NONE);
    }

    #[test]
    fn nothing_is_lost_on_the_way() {
        let (region, _, mesh) = graded(&cylinder_band(5000, Sampling::Regular, OUTSIDE));
        let sums = mesh.gather(vec![1.0; region.free]);
        assert_below!(sums.len(), region.free);
        assert_near!(sums.iter().sum::<f64>() / region.free as f64, 1.0, 1e-6);
    }

    /// Linear functions are harmonic by cotangent weights on a flat mesh, whichever vertices are left.
    #[test]
    fn weights_of_a_flat_mesh_keep_linear_functions() {
        let shape = cap(5000);
        let (region, _, mesh) = graded(&shape);
        let mut x = region.positions(&shape.positions);
        x.iter_mut().for_each(|p| p.z = 0.0);
        let weight = mesh.cotangent_weights(region.free, Some(&x));
        let place = |s: u32| {
            let s = s as usize;
            x[mesh
                .vertices
                .get(s)
                .map_or(s + region.free - mesh.free(), |&v| v as usize)]
        };
        for s in 0..mesh.free() {
            let row = mesh.ring.row(s).iter().zip(&weight[mesh.ring.range(s)]);
            let sum: Vector3<f64> = row.map(|(&j, &w)| (place(s as u32) - place(j)) * w).sum();
            assert!(sum.norm() < 1e-9, "{s} {sum}");
        }
    }
}
