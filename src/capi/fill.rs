//! Boundary loops, hole filling, remeshing.

use std::sync::Arc;

use super::callback::HostCallback;
use super::fill_options::{FillOptionsIn, read_remesh_options};
use super::guard::{guarded, point};
use super::input::{MeshIn, SelectionIn};
use super::memory_bounds;
use super::options::OptionsIn;
use super::outputs::*;
use super::results::Content;
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::Progress;
use fairmesh::{
    BoundaryLoop, FillOptions, LoopKind, Loops, RemeshOptions, boundary_loops_joined,
    fill_holes_with_progress, remesh_region,
};

use fairmesh_status as Status;

/// Finds the boundary loops of a mesh: holes and outer boundaries. `result` gets a handle; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_boundary_loops(
    mesh: *const fairmesh_mesh,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut aliases)?;
        check_slot(result, Argument(2), &mut aliases)?;
        aliases.error(error, Argument(3))?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let _reserve = memory_bounds::reserve(memory_bounds::of_whole_mesh(&mesh, 1))?;
        let callback = HostCallback::new(None, core::ptr::null_mut());
        point();
        let loops = boundary_loops_joined(&positions, &triangles, mesh.coincident)?;
        publish(Arc::new(Content::Loops(loops)), result, &callback)
    })
}

/// Fills holes: triangulates, refines and fairs each. Vertices and triangles given keep their numbers and bits; new
/// ones follow. A loop that cannot be filled says so in its report and does not affect the others.
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
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut aliases)?;
        let fill = FillOptionsIn::new(fill, Argument(2), &mut aliases)?;
        let asked = OptionsIn::new(options, Argument(3), mesh.vertices(), &mut aliases)?;
        check_slot(result, Argument(4), &mut aliases)?;
        aliases.error(error, Argument(5))?;

        let options = asked.read(mesh.vertices(), mesh.coincident)?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let fill = fill.read(options)?;
        let callback = asked.callback.fresh();
        let (new_vertices, longest) = {
            let _reserve = memory_bounds::reserve(memory_bounds::of_whole_mesh(&mesh, 1))?;
            let loops = boundary_loops_joined(&positions, &triangles, mesh.coincident)?;
            callback.memory()?;
            size_of_patches(&loops, &fill)?
        };
        let new_vertices = new_vertices.min(fill.max_new_vertices).saturating_add(1000);
        let bytes = memory_bounds::of_filling(&mesh, new_vertices, longest, &asked);
        let _reserve = memory_bounds::reserve(bytes)?;
        point();
        let mut tell = |progress: &Progress| callback.tell(progress);
        let filled = fill_holes_with_progress(&positions, &triangles, &fill, &mut tell)?;
        callback.memory()?;
        let content = Content::Filled {
            filled,
            vertices: positions.len(),
            triangles: triangles.len(),
        };
        publish(Arc::new(content), result, &callback)
    })
}

/// About how many vertices the patches will have that are asked for, and how many edges the longest loop.
fn size_of_patches(loops: &[BoundaryLoop], asked: &FillOptions) -> CallResult<(usize, usize)> {
    if let Loops::Chosen(named) = &asked.loops
        && let Some(&missing) = named.iter().find(|&&l| l >= loops.len())
    {
        let why = format_args!("loop {missing} is named, but there are only {}", loops.len());
        let failure = Failure::new(Status::SelectionOutOfRange, why);
        return Err(failure.at(fairmesh_element::Loop, missing));
    }
    let chosen = |l: usize| match &asked.loops {
        Loops::UpTo(most) => loops[l].kind == LoopKind::Hole && loops[l].vertices.len() <= *most,
        Loops::Chosen(named) => named.contains(&l),
        Loops::Where(_) => loops[l].kind == LoopKind::Hole,
    };
    let edges = (0..loops.len())
        .filter(|&l| chosen(l))
        .map(|l| loops[l].vertices.len());
    // A disk of n edges has about n^2 / 11 vertices at the default density of the square root of 2.
    let area = |n: usize| (n * n) as f64 * (asked.density * asked.density).max(0.5) / 4.0;
    let new = edges.clone().map(area).sum::<f64>();
    Ok((new as usize, edges.max().unwrap_or(0)))
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
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut aliases)?;
        let selection = SelectionIn::new(selection, Argument(2), &mesh, &mut aliases)?;
        let asked = read_remesh_options(options, Argument(3), &mut aliases)?;
        check_slot(result, Argument(4), &mut aliases)?;
        aliases.error(error, Argument(5))?;
        let selected = selection.read(&mesh)?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let _reserve =
            memory_bounds::reserve(memory_bounds::of_remeshing(&mesh, &selected, asked.max_vertices)?)?;
        let callback = HostCallback::new(None, core::ptr::null_mut());
        point();
        let asked = RemeshOptions {
            coincident: mesh.coincident,
            ..asked
        };
        let remeshed = remesh_region(&positions, &triangles, selected.selection(), &asked)?;
        publish(Arc::new(Content::Remeshed(remeshed)), result, &callback)
    })
}
