//! Where points lie on triangles.

use std::ffi::c_void;

use super::callback::{HostCallback, cancelled, fairmesh_progress_fn};
use super::erase::missing;
use super::guard::guarded;
use super::input::{MeshIn, optional_list_in};
use super::memory_bounds;
use super::outputs::ResultOut;
use super::results::Content;
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::{Carried, Parents, carry_over_with_progress};

/// Finds per point the nearest one of some triangles of a mesh: to carry colours and the like over from triangles that were erased to the
/// vertices that took their place. The list CARRIED_TRIANGLES of the result has the triangles, the list PARENTS their corners, and the vectors
/// PARENT_WEIGHTS the weights of these; for a point that is not finite, and where no triangle is, UINT32_MAX, and weights of 0.
///
/// `among` are the triangles, by their numbers; it may be NULL: all of them. `progress` may be NULL; it gets `user_data`, and where it stops the
/// call the status is CANCELLED. `result` gets a handle, whose `new_vertex_count` is the number of points;
/// free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_carry_over(
    mesh: *const fairmesh_mesh,
    among: *const fairmesh_indices,
    points: *const fairmesh_points,
    progress: fairmesh_progress_fn,
    user_data: *mut c_void,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        let mesh = MeshIn::new(mesh, Argument(1), call)?;
        let among = optional_list_in(among, Argument(2), call)?;
        let points = Points::points_in(&call.read(points, Argument(3))?, Argument(3).start())?;
        call.input(points.array.memory());
        let result = ResultOut::last(result, Argument(6), call)?;
        let (positions, triangles) = mesh.read()?;
        let points = points.read()?;
        let listed = among.map_or(triangles.len(), |list| list.count);
        let bytes = memory_bounds::of_carrying(&mesh, listed, points.len());
        result.put(bytes, &HostCallback::new(progress, user_data), |tell| {
            let among = match among {
                Some(list) => list.list()?.into_owned(),
                None => (0..triangles.len() as u32).collect(),
            };
            let carried = carry_over_with_progress(&positions, &triangles, &among, &points, tell)
                .map_err(|error| missing(error, fairmesh_element::Triangle))?;
            Ok(content(&carried.ok_or_else(cancelled)?))
        })
    })
}

fn content(points: &[Option<Carried>]) -> Content {
    let sizes = fairmesh_info {
        new_vertex_count: points.len() as u64,
        ..fairmesh_info::default()
    };
    let nowhere = Carried {
        triangle: u32::MAX,
        parents: Parents {
            vertices: [u32::MAX; 3],
            weights: [0.0; 3],
        },
    };
    let places = || points.iter().map(|place| place.unwrap_or(nowhere));
    let triangles = places().map(|of| of.triangle).collect();
    let corners = places().flat_map(|of| of.parents.vertices).collect();
    let weights = places().map(|of| of.parents.weights).collect();
    Content {
        vectors: Some((fairmesh_vectors::ParentWeights, weights)),
        ..Content::new(fairmesh_result_kind::Carried, sizes)
            .one(fairmesh_list::CarriedTriangles, triangles)
            .one(fairmesh_list::Parents, corners)
    }
}
