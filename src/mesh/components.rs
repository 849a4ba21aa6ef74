//! Which free vertices depend on each other. Those of different components are independent problems.
//!
//! Free neighbours belong together; so do all free vertices around a fixed one inside the region whose normal is not given,
//! because the surface's own normal and `H` there are taken from all sides, and around an island. Any other fixed vertex
//! separates.

use super::disjoint_sets::DisjointSets;
use super::rows::Rows;

/// The component of each free vertex.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Components {
    /// Per free vertex the number of its component; they are numbered by their smallest free vertices.
    pub number: Vec<u32>,
    /// How many there are.
    pub count: usize,
}

impl Components {
    /// Those of triangles in local numbers, the region's first, then those outside. `given` tells, by local number, which
    /// vertices have normals.
    pub(super) fn new(
        triangles: &[[u32; 3]],
        region_triangles: usize,
        (free, boundary): (usize, usize),
        given: impl Fn(u32) -> bool,
    ) -> Self {
        let (inside, outside) = triangles.split_at(region_triangles);
        let joins = joins(inside, outside, (free, boundary), given);
        let mut sets = DisjointSets::new(free + boundary);
        for tri in inside {
            for k in 0..3 {
                let (a, b) = (tri[k], tri[(k + 1) % 3]);
                if joins[a as usize] && joins[b as usize] {
                    sets.unite(a, b);
                }
            }
        }
        let (number, count) = sets.numbers(free);
        Self {
            number,
            count: count as usize,
        }
    }

    /// The smallest free vertex (local number) of a component without a fixed vertex, if there is one.
    pub(super) fn without_fixed(&self, triangles: &[[u32; 3]]) -> Option<usize> {
        let is_free = |v: u32| (v as usize) < self.number.len();
        let mut fixed = vec![false; self.count];
        for tri in triangles.iter().filter(|tri| !tri.iter().all(|&v| is_free(v))) {
            for &v in tri.iter().filter(|v| is_free(**v)) {
                fixed[self.number[v as usize] as usize] = true;
            }
        }
        self.number.iter().position(|&c| !fixed[c as usize])
    }
}

/// Whether all around a vertex of the region belongs together, by local number.
fn joins(
    inside: &[[u32; 3]],
    outside: &[[u32; 3]],
    (free, boundary): (usize, usize),
    given: impl Fn(u32) -> bool,
) -> Vec<bool> {
    let end = (free + boundary) as u32;
    let mut joins: Vec<bool> = (0..end).map(|v| (v as usize) < free || !given(v)).collect();
    for &v in outside.iter().flatten().filter(|v| **v < end) {
        joins[v as usize] = false;
    }
    // The two other corners of each triangle around those fixed vertices that are left.
    let is_candidate = |v: u32| v as usize >= free && joins[v as usize];
    let corners = inside
        .iter()
        .flat_map(|&[a, b, c]| [(a, [b, c]), (b, [c, a]), (c, [a, b])]);
    let around = corners.filter(|&(v, _)| is_candidate(v));
    let around = Rows::collect(boundary, around.map(|(v, pair)| (v - free as u32, pair)));
    for b in 0..boundary {
        joins[free + b] &= is_closed(around.row(b));
    }
    for tri in inside
        .iter()
        .filter(|tri| tri.iter().all(|&v| v as usize >= free))
    {
        tri.iter().for_each(|&v| joins[v as usize] = true);
    }
    joins
}

/// Whether triangles around a vertex, by their other two corners, close to a ring.
fn is_closed(around: &[[u32; 2]]) -> bool {
    let ends = |k: usize| {
        let mut ends: Vec<u32> = around.iter().map(|pair| pair[k]).collect();
        ends.sort_unstable();
        ends
    };
    ends(0) == ends(1)
}
