//! The surface around a region, as creases are looked for in it.

use std::cell::RefCell;

use nalgebra::Vector3;

use crate::discrete::boundary_normals::angle;
use crate::mesh::edge_set::EdgeSet;
use crate::mesh::halfedge::NONE;
use crate::mesh::rows::Rows;

/// The triangles that have no free vertex.
pub(super) struct Outside<'a> {
    positions: &'a [[f64; 3]],
    triangles: &'a [[u32; 3]],
    /// The outside triangles at each vertex.
    at: Rows<u32>,
    /// The fixed vertices of triangles with a free one.
    pub(super) is_boundary: Vec<bool>,
    /// Those of the edges that are marked sharp, by [`creases`].
    marked: EdgeSet,
    marks: RefCell<Marks>,
}

impl<'a> Outside<'a> {
    /// Of a mesh whose triangles name vertices that exist.
    pub(super) fn new(
        positions: &'a [[f64; 3]],
        triangles: &'a [[u32; 3]],
        is_free: &[bool],
        marked: &[[u32; 2]],
    ) -> Self {
        let has_free = |tri: &[u32; 3]| tri.iter().any(|&v| is_free[v as usize]);
        let mut is_boundary = vec![false; positions.len()];
        for tri in triangles.iter().filter(|tri| has_free(tri)) {
            let fixed = tri.iter().filter(|v| !is_free[**v as usize]);
            fixed.for_each(|&v| is_boundary[v as usize] = true);
        }
        let outside = |tri: &[u32; 3]| !has_free(tri);
        Self::of((positions, triangles), is_boundary, marked, outside)
    }

    /// Of triangles that are all outside, with this boundary.
    pub(super) fn around(
        positions: &'a [[f64; 3]],
        triangles: &'a [[u32; 3]],
        is_boundary: Vec<bool>,
        marked: &[[u32; 2]],
    ) -> Self {
        Self::of((positions, triangles), is_boundary, marked, |_| true)
    }

    fn of(
        (positions, triangles): (&'a [[f64; 3]], &'a [[u32; 3]]),
        is_boundary: Vec<bool>,
        marked: &[[u32; 2]],
        is_outside: impl Fn(&[u32; 3]) -> bool,
    ) -> Self {
        let outside = (0..).zip(triangles).filter(|(_, tri)| is_outside(tri));
        let corners = outside.flat_map(|(t, tri)| tri.map(|v| (v, t)));
        Self {
            positions,
            triangles,
            at: Rows::collect(positions.len(), corners),
            marked: creases(marked, &is_boundary),
            is_boundary,
            marks: RefCell::default(),
        }
    }

    /// All boundary vertices, ascending.
    pub(super) fn boundary(&self) -> Vec<u32> {
        let is_boundary = |v: &u32| self.is_boundary[*v as usize];
        (0..self.is_boundary.len() as u32).filter(is_boundary).collect()
    }

    pub(super) fn position(&self, v: u32) -> Vector3<f64> {
        Vector3::from(self.positions[v as usize])
    }

    /// The triangles at a vertex.
    pub(super) fn triangles_at(&self, v: u32) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.at
            .row(v as usize)
            .iter()
            .map(|&t| self.triangles[t as usize])
    }

    /// The vertices that edges lead to from `v`, ascending.
    pub(super) fn neighbours(&self, v: u32) -> Vec<u32> {
        let mut found: Vec<u32> = self.triangles_at(v).flatten().filter(|w| *w != v).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The angle in degrees between the triangles on both sides of an edge, above 0 on a ridge; 0 where there are not two.
    pub(super) fn bend(&self, a: u32, b: u32) -> f64 {
        let (Some(left), Some(right)) = (self.normal_left(a, b), self.normal_left(b, a)) else {
            return 0.0;
        };
        let edge = self.position(b) - self.position(a);
        let size = angle(&left, &right).to_degrees();
        size.copysign(left.cross(&right).dot(&edge))
    }

    /// Whether an edge is marked sharp.
    pub(super) fn is_marked(&self, a: u32, b: u32) -> bool {
        self.marked.has(a, b)
    }

    /// Whether an edge is marked sharp or bends by so much.
    pub(super) fn is_sharp(&self, a: u32, b: u32, least: f64) -> bool {
        self.is_marked(a, b) || self.bend(a, b).abs() >= least
    }

    /// The vertices to which the edges of the boundary lead from `v`, where these are two.
    pub(super) fn beside(&self, v: u32) -> Option<[u32; 2]> {
        let mut others = self.neighbours(v);
        others.retain(|&w| self.normal_left(v, w).is_some() != self.normal_left(w, v).is_some());
        others.try_into().ok()
    }

    /// The unit normal of the triangle that runs from `a` to `b`.
    fn normal_left(&self, a: u32, b: u32) -> Option<Vector3<f64>> {
        let runs = |tri: &[u32; 3]| (0..3).any(|k| [tri[k], tri[(k + 1) % 3]] == [a, b]);
        let [p, q, r] = self.triangles_at(a).find(runs)?.map(|v| self.position(v));
        (q - p).cross(&(r - p)).try_normalize(f64::MIN_POSITIVE)
    }

    /// What is within so many rings around a vertex; triangles without a place are none.
    pub(super) fn within(&self, v: u32, rings: usize) -> Near {
        let mut marks = self.marks.borrow_mut();
        let Marks { number, is_taken } = &mut *marks;
        number.resize(self.positions.len(), NONE);
        is_taken.resize(self.triangles.len(), false);
        let (mut vertices, mut ids) = (vec![v], Vec::new());
        number[v as usize] = 0;
        let is_placed = |&w: &u32| self.position(w).iter().all(|x| x.is_finite());
        let mut begin = 0;
        for _ in 0..rings {
            let end = vertices.len();
            for k in begin..end {
                for &t in self.at.row(vertices[k] as usize) {
                    let tri = self.triangles[t as usize];
                    if is_taken[t as usize] || !tri.iter().all(is_placed) {
                        continue;
                    }
                    is_taken[t as usize] = true;
                    ids.push(t);
                    let new = |w: &u32| std::mem::replace(&mut number[*w as usize], 0) == NONE;
                    vertices.extend(tri.into_iter().filter(new));
                }
            }
            begin = end;
        }
        vertices.sort_unstable();
        ids.sort_unstable();
        (0..).zip(&vertices).for_each(|(l, &w)| number[w as usize] = l);
        let local = |&t: &u32| self.triangles[t as usize].map(|w| number[w as usize]);
        let triangles = ids.iter().map(local).collect();
        vertices.iter().for_each(|&w| number[w as usize] = NONE);
        ids.iter().for_each(|&t| is_taken[t as usize] = false);
        Near { vertices, triangles }
    }
}

/// More edges of creases do not meet in a vertex. Half: a crease passes no vertex; without: a sphere all of whose edges are marked has dozens of ends.
const MOST_AT_CORNER: usize = 3;

/// Those of the marked edges that lead away from the boundary and are not all of a grid, as flat shading marks them.
fn creases(marked: &[[u32; 2]], is_boundary: &[bool]) -> EdgeSet {
    let mut creases = EdgeSet::new(marked);
    let ends = creases.ends();
    let count = |v: u32| ends.partition_point(|&w| w <= v) - ends.partition_point(|&w| w < v);
    let is_boundary = |v: &u32| is_boundary.get(*v as usize).is_some_and(|is| *is);
    let is_of_crease = |v: &u32| is_boundary(v) || count(*v) <= MOST_AT_CORNER;
    creases.retain(|edge| !edge.iter().all(is_boundary) && edge.iter().all(is_of_crease));
    creases
}

/// A part of the surroundings.
pub(super) struct Near {
    /// Ascending.
    pub(super) vertices: Vec<u32>,
    /// By places in that list.
    pub(super) triangles: Vec<[u32; 3]>,
}

/// What is gathered already, while it is.
#[derive(Default)]
struct Marks {
    /// Per vertex its place: [`NONE`] before and after.
    number: Vec<u32>,
    is_taken: Vec<bool>,
}
