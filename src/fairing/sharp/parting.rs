//! The problem parted along the creases that go on: each side is a problem of its own, with its own normals there.

use std::collections::{HashMap, HashSet};

use nalgebra::Vector3;

use super::branch::Branch;
use super::path::Path;
use crate::fairing::component_solution::ComponentSolution;
use crate::fairing::normals::BoundaryNormals;
use crate::fairing::options::Options;
use crate::fairing::prepared::Prepared;
use crate::fairing::sharp_edge::CreaseEnd;
use crate::mesh::parted::part;
use crate::mesh::selection::Selection;
use crate::support::entries::sort_by_number;
use crate::support::error::Error;

/// A crease and the vertices that are to lie on it.
pub(super) struct Followed {
    /// From end to end.
    pub(super) vertices: Vec<u32>,
    /// Per vertex.
    pub(super) points: Vec<CreasePoint>,
}

/// A point of a crease.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CreasePoint {
    pub(crate) place: Vector3<f64>,
    /// Unit normals left and right.
    pub(crate) normals: [Vector3<f64>; 2],
}

impl Followed {
    pub(super) fn new(branch: &Branch, path: Path) -> Self {
        let point = |&part: &f64| CreasePoint {
            place: branch.at(part),
            normals: branch.normals(part),
        };
        Self {
            points: path.parts.iter().map(point).collect(),
            vertices: path.vertices,
        }
    }
}

/// The mesh with copies of the vertices on creases.
pub(crate) struct PartedProblem {
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) is_free: Vec<bool>,
    pub(super) normals: Vec<(u32, [f64; 3])>,
    /// What the last vertices are copies of.
    copy_of: Vec<u32>,
    /// The vertices that were free, on the creases.
    pub(super) placed: Vec<(u32, [f64; 3])>,
}

impl PartedProblem {
    /// Of a mesh with these free vertices; `ends` are those at which something goes on, `near` are normals at the boundary beside them.
    pub(super) fn new(
        (positions, triangles): (&[[f64; 3]], &[[u32; 3]]),
        is_free: &[bool],
        creases: &[Followed],
        (ends, near): (&[&CreaseEnd], Vec<(u32, [f64; 3])>),
    ) -> Self {
        let inside = creases.iter().map(|crease| &crease.vertices);
        let chains = ends.iter().flat_map(|end| &end.chains);
        let steps = inside.chain(chains).flat_map(|chain| chain.windows(2));
        let cut: Vec<[u32; 2]> = steps.map(|step| [step[0], step[1]]).collect();
        let parted = part(positions.len(), triangles, &cut);
        let mut problem = Self {
            positions: positions.to_vec(),
            is_free: is_free.to_vec(),
            normals: normals(triangles, &parted.triangles, creases),
            triangles: parted.triangles,
            placed: placed(creases, is_free),
            copy_of: parted.copy_of,
        };
        let on_cut = cut.iter().flatten().copied().collect::<HashSet<u32>>();
        let beside = near.into_iter().filter(|(v, _)| !on_cut.contains(v));
        problem.normals.extend(beside);
        sort_by_number(&mut problem.normals);
        for &(v, at) in &problem.placed {
            problem.positions[v as usize] = at;
            problem.is_free[v as usize] = false;
        }
        let copies = problem.copy_of.iter().map(|&v| problem.positions[v as usize]);
        let copies: Vec<[f64; 3]> = copies.collect();
        problem.positions.extend(copies);
        problem.is_free.resize(problem.positions.len(), false);
        problem
    }

    /// Whether anything is left to be solved beside the creases.
    pub(super) fn has_free(&self) -> bool {
        self.is_free.contains(&true)
    }

    /// Its components.
    pub(crate) fn prepared(&self, options: &Options) -> Result<Vec<Prepared>, Error> {
        let mut normals = match &options.boundary_normals {
            BoundaryNormals::Given(list) => list.clone(),
            BoundaryNormals::Fitted | BoundaryNormals::Averaged => Vec::new(),
        };
        normals.extend(&self.normals);
        let options = Options {
            boundary_normals: BoundaryNormals::Given(normals),
            ..options.clone()
        };
        let prepared = Prepared::of_components(
            &self.positions,
            &self.triangles,
            Selection::Mask(&self.is_free),
            &options,
            options.asks_continuity(),
        );
        let original = |v: usize| self.original(v as u32) as usize;
        prepared.map_err(|error| error.renumbered(original, |t| t))
    }

    /// What was found, in the numbers of the mesh.
    pub(crate) fn restore(&self, solutions: &mut [ComponentSolution]) {
        let original = |v: u32| self.original(v);
        for solution in solutions.iter_mut() {
            solution.renumber(&original);
        }
        if let Some(first) = solutions.first_mut() {
            first.moved.extend(&self.placed);
        }
    }

    pub(super) fn original(&self, v: u32) -> u32 {
        let vertices = self.positions.len() - self.copy_of.len();
        let copy = (v as usize).checked_sub(vertices);
        copy.map_or(v, |copy| self.copy_of[copy])
    }
}

/// The free vertices of paths, on the creases.
fn placed(creases: &[Followed], is_free: &[bool]) -> Vec<(u32, [f64; 3])> {
    let mut placed = Vec::new();
    for crease in creases {
        for (&v, point) in crease.vertices.iter().zip(&crease.points) {
            if is_free[v as usize] {
                placed.push((v, point.place.into()));
            }
        }
    }
    sort_by_number(&mut placed);
    placed.dedup_by_key(|(v, _)| *v);
    placed
}

/// The normals of both sides at the copies of vertices on creases.
fn normals(whole: &[[u32; 3]], parted: &[[u32; 3]], creases: &[Followed]) -> Vec<(u32, [f64; 3])> {
    let mut steps = HashMap::new();
    for (crease, of) in creases.iter().enumerate() {
        for (k, step) in of.vertices.windows(2).enumerate() {
            steps.insert([step[0], step[1]], (crease, k, 0));
            steps.insert([step[1], step[0]], (crease, k, 1));
        }
    }
    let mut normals = Vec::new();
    for (tri, copies) in whole.iter().zip(parted) {
        for corner in 0..3 {
            let next = (corner + 1) % 3;
            let Some(&(crease, k, side)) = steps.get(&[tri[corner], tri[next]]) else {
                continue;
            };
            let at = |k: usize| creases[crease].points[k].normals[side].into();
            // The triangle runs along the path on its left, against it on its right.
            let (first, second) = if side == 0 { (k, k + 1) } else { (k + 1, k) };
            normals.push((copies[corner], at(first)));
            normals.push((copies[next], at(second)));
        }
    }
    sort_by_number(&mut normals);
    normals.dedup_by_key(|(v, _)| *v);
    normals
}
