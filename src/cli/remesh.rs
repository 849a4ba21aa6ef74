//! `fairmesh fair --remesh`: the region is triangulated anew where it will lie.

use std::borrow::Cow;

use fairmesh::{BoundaryCurvature, BoundaryNormals, OutputPrecision, RemeshOptions, Solver, remesh_region};

use crate::fair::{FairArgs, FairInput, solve};
use crate::formats::{Geometry, Kind};
use crate::selection::Selected;

/// How well the surface is faired on which the new vertices are laid out.
const TOLERANCE: f64 = 1e-3;

/// The same region, triangulated anew.
pub fn remesh(
    args: &FairArgs,
    solver: Solver,
    input: &FairInput<'_>,
) -> Result<FairInput<'static>, fairmesh::Error> {
    let rough = solve(args, solver, input, Some(TOLERANCE), OutputPrecision::Double)?;
    let positions = if rough.report.linear_surface {
        &input.geometry.positions
    } else {
        &rough.positions
    };
    let mesh = remesh_region(
        positions,
        &input.geometry.triangles,
        input.selected.selection(),
        &RemeshOptions {
            coincident: args.mesh.coincident,
            ..RemeshOptions::default()
        },
    )?;
    let moved = |v: u32| mesh.kept_vertices.binary_search(&v).ok().map(|new| new as u32);
    let boundary_normals = match &input.boundary_normals {
        BoundaryNormals::Given(list) => {
            let kept = list.iter().filter_map(|&(v, n)| Some((moved(v)?, n)));
            BoundaryNormals::Given(kept.collect())
        }
        other => other.clone(),
    };
    let boundary_curvature = match &input.boundary_curvature {
        BoundaryCurvature::Given(list) => {
            let kept = list.iter().filter_map(|&(v, h)| Some((moved(v)?, h)));
            BoundaryCurvature::Given(kept.collect())
        }
        BoundaryCurvature::Estimated => BoundaryCurvature::Estimated,
    };
    // All of them are kept: others were refused before.
    let loops = input.loop_continuity.iter();
    let loop_continuity = loops.filter_map(|&(v, blend)| Some((moved(v)?, blend)));
    let selected = Selected {
        kind: Kind::Vertex,
        elements: mesh.free,
    };
    Ok(FairInput {
        geometry: Cow::Owned(Geometry::of_triangles(mesh.positions, mesh.triangles)),
        selected,
        boundary_normals,
        boundary_curvature,
        loop_continuity: loop_continuity.collect(),
    })
}
