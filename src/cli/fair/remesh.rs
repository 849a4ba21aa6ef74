//! `fairmesh fair --remesh`: the region is triangulated anew where it will lie.

use std::borrow::Cow;

use fairmesh::{
    BoundaryCurvature, BoundaryNormals, Coincident, FillOptions, Options, Outcome, RemeshOptions, Remeshed,
    Solution, refill_region, remesh_region,
};

use super::input::FairInput;
use crate::formats::{Geometry, Kind};
use crate::selected::Selected;

/// How well the surface is faired on which the new vertices are laid out.
pub const TOLERANCE: f64 = 1e-3;

/// The same region, triangulated anew where a rough solution lies.
pub fn remesh(
    input: &FairInput<'_>,
    rough: &Solution,
    coincident: Coincident,
    threads: usize,
) -> Result<FairInput<'static>, fairmesh::Error> {
    let refilled = match needs_hole(rough) {
        true => refill(input, coincident, threads)?,
        false => None,
    };
    let positions = if rough.report.least_bending {
        &input.geometry.positions
    } else {
        &rough.positions
    };
    let options = RemeshOptions {
        coincident,
        ..RemeshOptions::default()
    };
    let triangles = &input.geometry.triangles;
    let mesh = match refilled {
        Some(mesh) => mesh,
        None => remesh_region(positions, triangles, input.selected.selection(), &options)?,
    };
    Ok(in_new_numbers(input, mesh))
}

/// The input on a mesh with other triangles in the region.
fn in_new_numbers(input: &FairInput<'_>, mesh: Remeshed) -> FairInput<'static> {
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
    let edges = input.marked_edges.iter();
    let marked = edges.filter_map(|&[a, b]| Some([moved(a)?, moved(b)?]));
    let selected = Selected {
        kind: Kind::Vertex,
        elements: mesh.free,
    };
    FairInput {
        geometry: Cow::Owned(Geometry::of_triangles(mesh.positions, mesh.triangles)),
        selected,
        boundary_normals,
        boundary_curvature,
        loop_continuity: loop_continuity.collect(),
        marked_edges: marked.collect(),
        region: input.region.clone(),
    }
}

/// Whether the shape of the region has led to no surface that its triangles could be laid out on.
fn needs_hole(rough: &Solution) -> bool {
    let is_poor = matches!(rough.report.outcome, Outcome::ConvergedPoorTriangles { .. });
    rough.report.least_bending || is_poor
}

/// The region deleted and filled: its shape has led to no sound surface.
fn refill(
    input: &FairInput<'_>,
    coincident: Coincident,
    threads: usize,
) -> Result<Option<Remeshed>, fairmesh::Error> {
    let options = FillOptions {
        fairing: Options {
            boundary_normals: input.boundary_normals.clone(),
            tolerance: TOLERANCE,
            coincident,
            threads,
            ..Options::default()
        },
        ..FillOptions::default()
    };
    let geometry = &input.geometry;
    refill_region(
        &geometry.positions,
        &geometry.triangles,
        input.selected.selection(),
        &options,
    )
}
