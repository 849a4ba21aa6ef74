//! Boundary loops, hole filling, remeshing.

use core::mem::offset_of;
use std::sync::Arc;

use super::about::{default_fill_options, default_remesh_options};
use super::guard::{guarded, point};
use super::input::{MeshIn, SelectionIn};
use super::memory_bounds;
use super::options::{HostCallback, OptionsIn};
use super::outputs::*;
use super::results::Content;
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::Progress;
use fairmesh::{
    BoundaryLoop, FillOptions, LoopKind, Loops, RemeshOptions, boundary_loops, fill_holes_with_progress,
    remesh_region,
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
        let loops = boundary_loops(&positions, &triangles)?;
        publish(Arc::new(Content::Loops(loops)), result, &callback)
    })
}

/// Fills holes: triangulates, refines and fairs each. Vertices and triangles given keep their numbers and bits; new
/// ones follow. A loop that cannot be filled says so in its report and does not affect the others.
///
/// `fill` may be NULL: all holes, edges as long as those beside the boundaries. `options` may be NULL: the defaults of the fairing;
/// given normals are those of boundary vertices. `result` gets a handle; free it.
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
        let fill_view = if fill.is_null() {
            default_fill_options()
        } else {
            read_struct(fill, Argument(2))?
        };
        check_density(
            fill_view.density,
            Argument(2).field(offset_of!(fairmesh_fill_options, density)),
        )?;
        let named = indices_in(
            &fill_view.loops,
            1,
            Argument(2).field(offset_of!(fairmesh_fill_options, loops)),
        )?;
        aliases.input(
            fill,
            size_of::<fairmesh_fill_options>() * usize::from(!fill.is_null()),
        );
        aliases.input(named.data, named.bytes);
        let asked = OptionsIn::new(options, Argument(3), mesh.vertices(), &mut aliases)?;
        check_slot(result, Argument(4), &mut aliases)?;
        aliases.error(error, Argument(5))?;

        let normals = asked.normals.read(mesh.vertices())?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let mut numbers: Vec<usize> = try_with_capacity(named.count)?;
        numbers.extend((0..named.count).map(|k| named.index::<1>(k)[0] as usize));
        let most = count(fill_view.max_new_vertices);
        let callback = asked.callback.fresh();
        let (new_vertices, longest) = {
            let _reserve = memory_bounds::reserve(memory_bounds::of_whole_mesh(&mesh, 1))?;
            let loops = boundary_loops(&positions, &triangles)?;
            callback.memory()?;
            size_of_patches(&loops, &numbers, &fill_view)?
        };
        let new_vertices = new_vertices.min(most).saturating_add(1000);
        let bytes = memory_bounds::of_filling(&mesh, new_vertices, longest, asked.threads);
        let _reserve = memory_bounds::reserve(bytes)?;
        point();
        let filled = {
            let mut tell = |progress: &Progress| callback.tell(progress);
            let asked = FillOptions {
                loops: if named.count > 0 {
                    Loops::Chosen(numbers)
                } else {
                    Loops::UpTo(count(fill_view.max_edges))
                },
                density: fill_view.density,
                max_new_vertices: most,
                fair: fill_view.fair != 0,
                fairing: asked.options(normals),
            };
            fill_holes_with_progress(&positions, &triangles, &asked, &mut tell)?
        };
        callback.memory()?;
        let content = Content::Filled {
            filled,
            vertices: positions.len(),
            triangles: triangles.len(),
        };
        publish(Arc::new(content), result, &callback)
    })
}

fn count(n: u64) -> usize {
    usize::try_from(n).unwrap_or(usize::MAX)
}

/// About how many vertices the patches will have that are asked for, and how many edges the longest loop.
fn size_of_patches(
    loops: &[BoundaryLoop],
    named: &[usize],
    asked: &fairmesh_fill_options,
) -> CallResult<(usize, usize)> {
    if let Some(&missing) = named.iter().find(|&&l| l >= loops.len()) {
        let why = format_args!("loop {missing} is named, but there are only {}", loops.len());
        let failure = Failure::new(Status::SelectionOutOfRange, why);
        return Err(failure.at(fairmesh_element::Loop, missing));
    }
    let up_to = count(asked.max_edges);
    let chosen = |l: usize| match named.is_empty() {
        true => loops[l].kind == LoopKind::Hole && loops[l].vertices.len() <= up_to,
        false => named.contains(&l),
    };
    let edges = (0..loops.len())
        .filter(|&l| chosen(l))
        .map(|l| loops[l].vertices.len());
    // A disk of n edges has about n^2 / 11 vertices at the default density of the square root of 2.
    let area = |n: usize| (n * n) as f64 * (asked.density * asked.density).max(0.5) / 4.0;
    let new = edges.clone().map(area).sum::<f64>();
    Ok((new as usize, edges.max().unwrap_or(0)))
}

fn check_density(density: f64, place: FieldPath) -> CallResult {
    if (0.1..=10.0).contains(&density) {
        return Ok(());
    }
    Err(place.refuse(Status::BadOption, format_args!("has to be between 0.1 and 10")))
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
        let view = if options.is_null() {
            default_remesh_options()
        } else {
            read_struct(options, Argument(3))?
        };
        check_reserved(
            view.reserved,
            Argument(3).field(offset_of!(fairmesh_remesh_options, reserved)),
        )?;
        check_density(
            view.density,
            Argument(3).field(offset_of!(fairmesh_remesh_options, density)),
        )?;
        aliases.input(
            options,
            size_of::<fairmesh_remesh_options>() * usize::from(!options.is_null()),
        );
        check_slot(result, Argument(4), &mut aliases)?;
        aliases.error(error, Argument(5))?;
        let selected = selection.read(&mesh)?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let most = count(view.max_vertices);
        let _reserve = memory_bounds::reserve(memory_bounds::of_remeshing(&mesh, &selected, most)?)?;
        let callback = HostCallback::new(None, core::ptr::null_mut());
        point();
        let asked = RemeshOptions {
            density: view.density,
            max_vertices: most,
        };
        let remeshed = remesh_region(&positions, &triangles, selected.selection(), &asked)?;
        publish(Arc::new(Content::Remeshed(remeshed)), result, &callback)
    })
}
