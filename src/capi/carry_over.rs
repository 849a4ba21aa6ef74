//! Where points lie on triangles.

use core::mem::size_of;
use std::sync::Arc;

use super::callback::HostCallback;
use super::erase::missing;
use super::guard::{guarded, point};
use super::input::{IndicesIn, MeshIn};
use super::memory_bounds;
use super::outputs::publish;
use super::results::Content;
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::carry_over;

/// Finds per point the nearest one of some triangles of a mesh: to carry colours and the like over from triangles that were erased to the
/// vertices that took their place. The list CARRIED_TRIANGLES of the result has the triangles, the list PARENTS their corners, and the vectors
/// PARENT_WEIGHTS the weights of these; for a point that is not finite, and where no triangle is, UINT32_MAX, and weights of 0.
///
/// `among` are the triangles, by their numbers; it may be NULL: all of them. `result` gets a handle, whose `new_vertex_count` is the number of points;
/// free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_carry_over(
    mesh: *const fairmesh_mesh,
    among: *const fairmesh_indices,
    points: *const fairmesh_points,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut aliases)?;
        let among = IndicesIn::optional(among, Argument(2), &mut aliases)?;
        check_pointer(points, Argument(3))?;
        aliases.input(points, size_of::<fairmesh_points>());
        let points = PointsIn::new(&read(points), Argument(3).start())?;
        aliases.input(points.array.data, points.array.bytes);
        check_slot(result, Argument(4), &mut aliases)?;
        aliases.error(error, Argument(5))?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let points = points.read()?;
        let listed = among.as_ref().map_or(triangles.len(), IndicesIn::count);
        let bytes = memory_bounds::of_carrying(&mesh, listed, points.len());
        let _reserve = memory_bounds::reserve(bytes)?;
        let callback = HostCallback::new(None, core::ptr::null_mut());
        point();
        let among = match among {
            Some(list) => list.read()?.as_flattened().to_vec(),
            None => (0..triangles.len() as u32).collect(),
        };
        let carried = carry_over(&positions, &triangles, &among, &points)
            .map_err(|error| missing(error, fairmesh_element::Triangle))?;
        publish(Arc::new(Content::Carried(carried)), result, &callback)
    })
}
