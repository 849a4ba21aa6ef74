//! A joined mesh's options, errors and solution, from the caller's numbers and back.

use std::borrow::Cow;

use nalgebra::Vector3;

use super::boundary_curvature::BoundaryCurvature;
use super::normals::{BoundaryNormals, is_unit};
use super::options::Options;
use super::report::Solution;
use crate::mesh::coincident::Copies;
use crate::support::error::Error;

/// The mean of unit normals that is shorter than this is no direction: two of them are more than 120 degrees apart.
/// Of 1 case, half: none changes; double: 1 changes, -100 % iterations.
const SHORTEST_MEAN: f64 = 0.5;

/// The options for the joined mesh.
pub(crate) fn joined_options<'o>(copies: &Copies, options: &'o Options) -> Cow<'o, Options> {
    if copies.is_empty() {
        return Cow::Borrowed(options);
    }
    Cow::Owned(Options {
        boundary_normals: joined_normals(copies, &options.boundary_normals).into_owned(),
        boundary_curvature: joined_curvature(copies, &options.boundary_curvature).into_owned(),
        loop_continuity: joined_loops(copies, &options.loop_continuity),
        marked_edges: joined_edges(copies, &options.marked_edges),
        ..options.clone()
    })
}

/// The loops that the joined mesh has through these vertices.
pub(super) fn joined_loops(copies: &Copies, loops: &[(u32, f64)]) -> Vec<(u32, f64)> {
    loops
        .iter()
        .map(|&(v, blend)| (copies.smallest(v), blend))
        .collect()
}

/// The edges that the joined mesh has between these vertices.
fn joined_edges(copies: &Copies, edges: &[[u32; 2]]) -> Vec<[u32; 2]> {
    edges
        .iter()
        .map(|edge| edge.map(|v| copies.smallest(v)))
        .collect()
}

/// The boundary curvature for the joined mesh: the mean of what is given for the copies of a vertex.
pub(super) fn joined_curvature<'h>(
    copies: &Copies,
    curvature: &'h BoundaryCurvature,
) -> Cow<'h, BoundaryCurvature> {
    match curvature {
        BoundaryCurvature::Given(list) if !copies.is_empty() => {
            let mean = |of_copies: &[f64]| of_copies.iter().sum::<f64>() / of_copies.len() as f64;
            Cow::Owned(BoundaryCurvature::Given(of_copies(copies, list, mean)))
        }
        other => Cow::Borrowed(other),
    }
}

/// The boundary normals for the joined mesh.
pub(super) fn joined_normals<'n>(copies: &Copies, normals: &'n BoundaryNormals) -> Cow<'n, BoundaryNormals> {
    match normals {
        BoundaryNormals::Given(list) if !copies.is_empty() => {
            Cow::Owned(BoundaryNormals::Given(of_copies(copies, list, mean)))
        }
        other => Cow::Borrowed(other),
    }
}

/// What is given for vertices by the joined mesh's numbers: `mean` of what is given for the copies of each. Of the entries of one number the
/// last one holds.
fn of_copies<T: Copy>(copies: &Copies, list: &[(u32, T)], mean: impl Fn(&[T]) -> T) -> Vec<(u32, T)> {
    let mut entries: Vec<(u32, u32, T)> = list.iter().map(|&(v, n)| (copies.smallest(v), v, n)).collect();
    entries.sort_by_key(|entry| (entry.0, entry.1));
    let by_vertex = entries.chunk_by(|a, b| a.0 == b.0);
    by_vertex
        .map(|of_vertex| {
            let of_copies = of_vertex.chunk_by(|a, b| a.1 == b.1);
            let given: Vec<T> = of_copies
                .filter_map(|same| same.last())
                .map(|entry| entry.2)
                .collect();
            (of_vertex[0].0, mean(&given))
        })
        .collect()
}

/// Their direction; zero where they cancel. One that is no unit vector is the mean itself, and is refused.
fn mean(normals: &[[f64; 3]]) -> [f64; 3] {
    let first = normals[0];
    let odd = normals.iter().find(|n| !is_unit(&Vector3::from(**n)));
    if odd.is_some() || normals.iter().all(|n| *n == first) {
        return *odd.unwrap_or(&first);
    }
    let sum: Vector3<f64> = normals.iter().map(|n| Vector3::from(*n).normalize()).sum();
    if sum.norm() < SHORTEST_MEAN * normals.len() as f64 {
        return [0.0; 3];
    }
    sum.normalize().into()
}

/// An error about a normal or a loop names the copy that it was given for.
pub(crate) fn in_given(error: Error, copies: &Copies, options: &Options) -> Error {
    match (&error, &options.boundary_normals) {
        (Error::BadNormal { vertex }, BoundaryNormals::Given(list)) => {
            let is_copy = |v: u32| copies.smallest(v) as usize == *vertex;
            let of_vertex = || list.iter().filter(|(v, _)| is_copy(*v));
            let odd = of_vertex().find(|(_, n)| !is_unit(&Vector3::from(*n)));
            match odd.or_else(|| of_vertex().next()) {
                Some(&(v, _)) => Error::BadNormal { vertex: v as usize },
                None => error,
            }
        }
        (Error::NotOnLoop { vertex }, _) => {
            let mut list = options.loop_continuity.iter();
            match list.find(|(v, _)| copies.smallest(*v) as usize == *vertex) {
                Some(&(v, _)) => Error::NotOnLoop { vertex: v as usize },
                None => error,
            }
        }
        _ => error,
    }
}

/// Moves the copies of free vertices with them, and of those on sharp edges that have been placed; lists what vertices have for all of their copies.
pub(super) fn spread(solution: &mut Solution, given: &[[f64; 3]], copies: &Copies) {
    if copies.is_empty() {
        return;
    }
    let free = &solution.mean_curvature;
    for &(v, copy) in copies.pairs() {
        let has_moved = solution.positions[v as usize] != given[v as usize];
        if has_moved || free.binary_search_by_key(&v, |entry| entry.0).is_ok() {
            solution.positions[copy as usize] = solution.positions[v as usize];
        }
    }
    copies.repeat(&mut solution.boundary_normals);
    copies.repeat(&mut solution.mean_curvature);
    copies.repeat(&mut solution.gaussian_curvature);
}
