//! `fairmesh fair --remesh`: the region is triangulated anew where it will lie.

use fairmesh::{RemeshOptions, Solver, remesh_region};

use crate::fair::{FairArgs, Region, solve};
use crate::formats::{Geometry, Kind};

/// How well the surface is faired on which the new vertices are laid out.
const TOLERANCE: f64 = 1e-3;

/// The new mesh and the region in it.
pub fn remesh(
    args: &FairArgs,
    solver: Solver,
    geometry: &Geometry,
    region: &Region,
) -> Result<(Geometry, Region), fairmesh::Error> {
    let rough = solve(args, solver, geometry, region, Some(TOLERANCE))?;
    let positions = if rough.report.linear_surface {
        &geometry.positions
    } else {
        &rough.positions
    };
    let options = RemeshOptions::default();
    let mesh = remesh_region(positions, &geometry.triangles, region.selection(), &options)?;
    let moved = |v: u32| mesh.kept_vertices.binary_search(&v).ok().map(|new| new as u32);
    let normals = region.normals.as_ref().map(|list| {
        let kept = list.iter().filter_map(|&(v, n)| Some((moved(v)?, n)));
        kept.collect()
    });
    let region = Region {
        kind: Kind::Vertex,
        elements: mesh.free,
        normals,
    };
    Ok((Geometry::of_triangles(mesh.positions, mesh.triangles), region))
}
