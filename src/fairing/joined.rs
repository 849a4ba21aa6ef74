//! A joined mesh's options, errors and solution, from the caller's numbers and back.

use std::borrow::Cow;

use nalgebra::Vector3;

use super::normals::{BoundaryNormals, is_unit};
use super::options::Options;
use super::report::Solution;
use crate::error::Error;
use crate::mesh::coincident::Copies;

/// The mean of unit normals that is shorter than this is no direction: two of them are more than 120 degrees apart.
const SHORTEST_MEAN: f64 = 0.5;

/// The options for the joined mesh.
pub(crate) fn joined_options<'o>(copies: &Copies, options: &'o Options) -> Cow<'o, Options> {
    match joined_normals(copies, &options.boundary_normals) {
        Cow::Borrowed(_) => Cow::Borrowed(options),
        Cow::Owned(boundary_normals) => Cow::Owned(Options {
            boundary_normals,
            ..options.clone()
        }),
    }
}

/// The boundary normals for the joined mesh.
pub(super) fn joined_normals<'n>(copies: &Copies, normals: &'n BoundaryNormals) -> Cow<'n, BoundaryNormals> {
    match normals {
        BoundaryNormals::Given(list) if !copies.is_empty() => {
            Cow::Owned(BoundaryNormals::Given(averaged(copies, list)))
        }
        other => Cow::Borrowed(other),
    }
}

/// The given normals by the joined mesh's numbers. Of the entries of one number the last one holds.
fn averaged(copies: &Copies, list: &[(u32, [f64; 3])]) -> Vec<(u32, [f64; 3])> {
    let mut entries: Vec<(u32, u32, [f64; 3])> =
        list.iter().map(|&(v, n)| (copies.smallest(v), v, n)).collect();
    entries.sort_by_key(|entry| (entry.0, entry.1));
    let by_vertex = entries.chunk_by(|a, b| a.0 == b.0);
    by_vertex
        .map(|of_vertex| {
            let of_copies = of_vertex.chunk_by(|a, b| a.1 == b.1);
            let normals: Vec<[f64; 3]> = of_copies
                .filter_map(|same| same.last())
                .map(|entry| entry.2)
                .collect();
            (of_vertex[0].0, mean(&normals))
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

/// An error about a normal names the copy that it was given for.
pub(super) fn in_given(error: Error, copies: &Copies, normals: &BoundaryNormals) -> Error {
    let (Error::BadNormal { vertex }, BoundaryNormals::Given(list)) = (&error, normals) else {
        return error;
    };
    let is_copy = |v: u32| copies.smallest(v) as usize == *vertex;
    let of_vertex = || list.iter().filter(|(v, _)| is_copy(*v));
    let odd = of_vertex().find(|(_, n)| !is_unit(&Vector3::from(*n)));
    match odd.or_else(|| of_vertex().next()) {
        Some(&(v, _)) => Error::BadNormal { vertex: v as usize },
        None => error,
    }
}

/// Moves the copies of free vertices with them, and lists what vertices have for all of their copies.
pub(super) fn spread(solution: &mut Solution, copies: &Copies) {
    if copies.is_empty() {
        return;
    }
    let free = &solution.mean_curvature;
    for &(v, copy) in copies.pairs() {
        if free.binary_search_by_key(&v, |entry| entry.0).is_ok() {
            solution.positions[copy as usize] = solution.positions[v as usize];
        }
    }
    copies.repeat(&mut solution.boundary_normals);
    copies.repeat(&mut solution.mean_curvature);
    copies.repeat(&mut solution.gaussian_curvature);
}
