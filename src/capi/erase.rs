//! Triangles deleted, and components of a mesh.

use std::sync::Arc;

use super::callback::HostCallback;
use super::guard::{guarded, point};
use super::input::{IndicesIn, MeshIn};
use super::memory_bounds;
use super::outputs::{of_whole_mesh, publish};
use super::results::Content;
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::{Error, erase, triangle_components};

/// Deletes triangles, and what would hang loose where they were, so that new patches can take their place. The list KEPT_TRIANGLES of
/// the result is the mesh that is left, its vertices being those given, used or not; the list ERASED_LOOPS has the loops to be filled
/// there, or joined. `triangles` are the triangles to be deleted. `result` gets a handle; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_erase(
    mesh: *const fairmesh_mesh,
    triangles: *const fairmesh_indices,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut aliases)?;
        check_pointer(triangles, Argument(2))?;
        let erased = IndicesIn::optional(triangles, Argument(2), &mut aliases)?;
        check_slot(result, Argument(3), &mut aliases)?;
        aliases.error(error, Argument(4))?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let erased = erased.map(|list| list.read()).transpose()?;
        let erased = erased.as_deref().map_or(&[][..], <[[u32; 1]]>::as_flattened);
        let _reserve = memory_bounds::reserve(memory_bounds::of_erasing(&mesh))?;
        let callback = HostCallback::new(None, core::ptr::null_mut());
        point();
        let left = erase(&positions, &triangles, erased, mesh.coincident);
        let erased = left.map_err(|error| match error {
            Error::SelectionOutOfRange { index, .. } => {
                Failure::from(error).at(fairmesh_element::Triangle, index)
            }
            other => other.into(),
        })?;
        let vertices = positions.len();
        publish(Arc::new(Content::Erased { erased, vertices }), result, &callback)
    })
}

/// Finds the components of a mesh: triangles that hang together by edges. They count in the order of their first triangles; the list
/// TRIANGLE_COMPONENTS of the result says of each triangle which one it is of. `result` gets a handle; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_components(
    mesh: *const fairmesh_mesh,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        of_whole_mesh(mesh, result, error, |positions, triangles, coincident| {
            let vertices = positions.len();
            let of = triangle_components(positions, triangles, coincident)?;
            Ok(Content::Components { of, vertices })
        })
    })
}
