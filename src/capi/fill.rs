//! Boundary loops, hole filling, which loops to join, remeshing.

use super::callback::{HostCallback, cancelled};
use super::fill_options::{FillOptionsIn, read_remesh_options};
use super::guard::guarded;
use super::input::{MeshIn, SelectionIn};
use super::memory_bounds;
use super::option_structs::{fairmesh_fill_options, fairmesh_options, fairmesh_remesh_options};
use super::options::OptionsIn;
use super::outputs::*;
use super::patch_sizes::{self, PatchSizes};
use super::report;
use super::results::{Content, as_list};
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::{
    BoundaryLoop, FillOptions, Join, Options, RemeshOptions, Roughness, boundary_loops_joined,
    fill_holes_with_progress, remesh_region_with_progress, rim_roughness, suggest_joins,
};

/// Finds the boundary loops of a mesh: holes and outer boundaries. `result` gets a handle; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_boundary_loops(
    mesh: *const fairmesh_mesh,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        of_whole_mesh(mesh, result, call, |positions, triangles, coincident| {
            let loops = boundary_loops_joined(positions, triangles, coincident)?;
            Ok(of_loops(loops, &[]))
        })
    })
}

/// Finds the boundary loops of a mesh as `fairmesh_boundary_loops` does, and how rough their rims are, which takes longer: each
/// `fairmesh_loop` of the result has it, with what is advised for `relax_rim` and `relax_within` of the fill options. `result` gets a handle;
/// free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_rim_roughness(
    mesh: *const fairmesh_mesh,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        of_whole_mesh(mesh, result, call, |positions, triangles, coincident| {
            let bytes = memory_bounds::of_rims(positions.len(), triangles.len());
            let _reserve = memory_bounds::reserve(bytes)?;
            let loops = boundary_loops_joined(positions, triangles, coincident)?;
            Ok(of_loops(loops, &rim_roughness(positions, triangles, coincident)?))
        })
    })
}

/// How rough their rims are is told of each loop, or of none.
fn of_loops(loops: Vec<BoundaryLoop>, roughness: &[Option<Roughness>]) -> Content {
    let sizes = fairmesh_info {
        loop_count: loops.len() as u64,
        ..fairmesh_info::default()
    };
    let rough = |l: usize| roughness.get(l).and_then(Option::as_ref);
    let records = (0..loops.len()).map(|l| report::boundary_loop(&loops[l], rough(l)));
    let records = records.collect();
    let (vertices, touching) = loops.into_iter().map(|of| (of.vertices, of.touching)).unzip();
    Content {
        loops: records,
        ..Content::new(fairmesh_result_kind::Loops, sizes)
            .each(fairmesh_list::LoopVertices, "boundary loop", vertices)
            .each(fairmesh_list::LoopTouching, "boundary loop", touching)
    }
}

/// Fills holes: triangulates, refines and fairs each, or several together. Vertices and triangles given keep their numbers and bits, but for
/// vertices that `relax_rim` lets move; new ones follow. A loop that cannot be filled says so in its report and does not affect the others.
///
/// `fill` may be NULL: all holes, edges as long as those beside the boundaries. `options` may be NULL: the defaults of the fairing;
/// given normals and curvatures are those of boundary vertices. `result` gets a handle; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_fill_holes(
    mesh: *const fairmesh_mesh,
    fill: *const fairmesh_fill_options,
    options: *const fairmesh_options,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        let mesh = MeshIn::new(mesh, Argument(1), call)?;
        let fill = FillOptionsIn::new(fill, Argument(2), call)?;
        let asked = OptionsIn::new(options, Argument(3), &mesh, call)?;
        let result = ResultOut::last(result, Argument(4), call)?;
        let (positions, triangles) = mesh.read()?;
        let fill = fill.read(asked.read(&mesh)?)?;
        let sizes = sizes_of(&mesh, &positions, &triangles, &fill)?.limited(fill.max_new_vertices);
        let bytes = memory_bounds::of_filling(&mesh, &sizes, &asked, fill.rim.relax > 0);
        result.put(bytes, &asked.callback, |tell| {
            let of = fill_holes_with_progress(&positions, &triangles, &fill, tell)?;
            let (kind, given) = (fairmesh_result_kind::Filled, [positions.len(), triangles.len()]);
            let is_success = of.is_success();
            let mesh = Content::mesh(kind, of.positions, of.triangles, &of.parents, given);
            Ok(mesh.judged(is_success).with_patches(of.loops))
        })
    })
}

/// Finds the loops that `FAIRMESH_JOIN_KIND_AUTO` would give one patch, of those that `fill` asks for, whatever its `join` is. `result` gets
/// a handle with `loop_count` groups, see `fairmesh_result_suggestion` and the list JOINED_LOOPS; free it. `fill` may be NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_suggest_joins(
    mesh: *const fairmesh_mesh,
    fill: *const fairmesh_fill_options,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        let mesh = MeshIn::new(mesh, Argument(1), call)?;
        let fill = FillOptionsIn::new(fill, Argument(2), call)?;
        let result = ResultOut::last(result, Argument(3), call)?;
        let (positions, triangles) = mesh.read()?;
        let fill = FillOptions {
            join: Join::Auto,
            ..fill.read(Options {
                coincident: mesh.coincident,
                ..Options::default()
            })?
        };
        let sizes = sizes_of(&mesh, &positions, &triangles, &fill)?;
        let bytes = memory_bounds::of_joining(&mesh, &sizes);
        result.put(bytes, &HostCallback::none(), |_| {
            let joins = suggest_joins(&positions, &triangles, &fill)?;
            let sizes = fairmesh_info {
                loop_count: joins.len() as u64,
                ..fairmesh_info::default()
            };
            let loops = joins.iter().map(|of| as_list(&of.loops)).collect();
            Ok(Content {
                suggestions: joins.iter().map(report::suggestion).collect(),
                ..Content::new(fairmesh_result_kind::Joins, sizes).each(
                    fairmesh_list::JoinedLoops,
                    "group of loops",
                    loops,
                )
            })
        })
    })
}

/// How large the patches will be.
pub(crate) fn sizes_of(
    mesh: &MeshIn,
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    asked: &FillOptions,
) -> CallResult<PatchSizes> {
    let look = memory_bounds::of_whole_mesh(mesh, 1);
    with_memory(look, &HostCallback::none(), |_| {
        let loops = boundary_loops_joined(positions, triangles, mesh.coincident)?;
        patch_sizes::sizes(positions, &loops, asked)
    })
}

/// Triangulates a region anew, by edge lengths as beside it, without moving the surface. To fair the new mesh, take the list
/// FREE_VERTICES of the result as selection. `selection` and `options` may be NULL. `result` gets a handle; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_remesh(
    mesh: *const fairmesh_mesh,
    selection: *const fairmesh_selection,
    options: *const fairmesh_remesh_options,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        let mesh = MeshIn::new(mesh, Argument(1), call)?;
        let selection = SelectionIn::new(selection, Argument(2), &mesh, call)?;
        let (asked, callback) = read_remesh_options(options, Argument(3), call)?;
        let asked = RemeshOptions {
            coincident: mesh.coincident,
            ..asked
        };
        let result = ResultOut::last(result, Argument(4), call)?;
        let selected = selection.read(&mesh)?;
        let (positions, triangles) = mesh.read()?;
        let bytes = memory_bounds::of_remeshing(&mesh, &selected, asked.max_vertices)?;
        result.put(bytes, &callback, |tell| {
            let made =
                remesh_region_with_progress(&positions, &triangles, selected.selection(), &asked, tell)?;
            Ok(made.ok_or_else(cancelled)?.into())
        })
    })
}
