//! One call: fairing, and the mean curvature and the self-intersections of a whole mesh.

use std::ffi::c_void;
use std::sync::Arc;

use super::callback::{HostCallback, cancelled, fairmesh_progress_fn};
use super::guard::guarded;
use super::input::{MeshIn, SelectionIn, optional_list_in};
use super::memory_bounds;
use super::option_structs::fairmesh_options;
use super::options::OptionsIn;
use super::outputs::*;
use super::report;
use super::results::Content;
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::{OutputPrecision, Progress, fair_with_progress};
use fairmesh::{mean_curvature_joined, self_intersections_with_progress};

/// Moves the free vertices of a mesh until the surface solves Delta_B H = 0, or what the options' target asks, between the
/// fixed vertices, with tangent continuity there.
///
/// `selection` may be NULL: all vertices that are not on the boundary of the mesh are free. `options` may be NULL: the
/// defaults. `positions_out` gets all vertices, as many as the mesh has; it may be the mesh's own positions (same address,
/// stride and scalar), then only free vertices are written. `report` may be NULL. `result`, which may be NULL, gets a handle with
/// everything else that was found; free it. `positions_out` may be NULL; where it has floats, the output precision is single.
///
/// The outcome in the report says how it ended; the positions are usable in every case.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_fair(
    mesh: *const fairmesh_mesh,
    selection: *const fairmesh_selection,
    options: *const fairmesh_options,
    positions_out: *const fairmesh_points_out,
    report: *mut fairmesh_report,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        let mesh = MeshIn::new(mesh, Argument(1), call)?;
        let selection = SelectionIn::new(selection, Argument(2), &mesh, call)?;
        let asked = OptionsIn::new(options, Argument(3), &mesh, call)?;
        let out = PositionsOut::new(positions_out, Argument(4), &mesh, call)?;
        let report_out = StructOut::optional(report, Argument(5), call)?;
        if !result.is_null() {
            check_slot(result, Argument(6), call)?;
        }
        call.end(Argument(7))?;

        let selected = selection.read(&mesh)?;
        let mut options = asked.read(&mesh)?;
        if out.as_ref().is_some_and(|out| !out.points.double) {
            options.output_precision = OutputPrecision::Single;
        }
        let bytes = memory_bounds::of_fairing(&mesh, &selected, &asked, false)?;
        with_memory(bytes, &asked.callback, |watch| {
            let mut tell = |progress: &Progress| watch.tell(progress);
            let (positions, triangles) = mesh.read()?;
            let selection = selected.selection();
            let solution = fair_with_progress(&positions, &triangles, selection, &options, &mut tell)?;
            drop((positions, triangles));
            watch.memory()?;
            if let Some(out) = &out {
                out.points
                    .check_range(solution.positions.iter().copied().enumerate())?;
            }
            let content = Arc::new(Content::from(solution));
            if !result.is_null() {
                publish(content.clone(), result, watch)?;
            }
            if let Some(out) = &out {
                out.write(content.positions()?, content.scalars(0)?);
            }
            if let Some(out) = report_out {
                out.write(&report::report(content.report(0)?));
            }
            Ok(())
        })
    })
}

/// Where the positions go.
struct PositionsOut {
    points: Points,
    /// Over those that were read: only free vertices are written.
    in_place: bool,
}

impl PositionsOut {
    fn new(
        out: *const fairmesh_points_out,
        argument: Argument,
        mesh: &MeshIn,
        call: &mut Call,
    ) -> CallResult<Option<Self>> {
        if out.is_null() {
            return Ok(None);
        }
        let points = Points::points_out(&call.read(out, argument)?, argument.start())?;
        points.check_count(mesh.vertices(), argument)?;
        let in_place = points.same_as(&mesh.positions);
        if !in_place {
            call.output(points.array.memory(), argument)?;
        }
        Ok(Some(Self { points, in_place }))
    }

    fn write(&self, positions: &[[f64; 3]], free: &[(u32, f64)]) {
        let put = |v: usize| self.points.set(v, positions[v]);
        if self.in_place {
            free.iter().for_each(|(v, _)| put(*v as usize));
        } else {
            (0..positions.len()).for_each(put);
        }
    }
}

/// Mean curvature at every vertex of a mesh, in 1 / length; negative on a sphere with outward normals. `out` gets as many numbers
/// as there are vertices, NaN at vertices without triangles. The mesh need not be a manifold.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_mean_curvature(
    mesh: *const fairmesh_mesh,
    out: *const fairmesh_scalars_out,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        let mesh = MeshIn::new(mesh, Argument(1), call)?;
        let out = Numbers::scalars_out(&call.read(out, Argument(2))?, Argument(2).start())?;
        out.check_count(mesh.vertices(), Argument(2))?;
        let out = last(out, Argument(2), call)?;
        let (positions, triangles) = mesh.read()?;
        let bytes = memory_bounds::of_whole_mesh(&mesh, 0);
        with_memory(bytes, &HostCallback::none(), |watch| {
            let curvature = mean_curvature_joined(&positions, &triangles, mesh.coincident)?;
            watch.memory()?;
            out.check_range(curvature.iter().map(|h| [*h]).enumerate())?;
            curvature.iter().enumerate().for_each(|(v, h)| out.set(v, [*h]));
            Ok(())
        })
    })
}

/// Pairs of triangles of a mesh that intersect: that have more in common than a vertex of both or an edge of both, where
/// vertices at the same position are one; also if they only touch. Exact for the positions given. Triangles without area take
/// no part. The mesh need not be a manifold.
///
/// `among` may be NULL: all pairs. Otherwise triangles, and only pairs with at least one of them. `progress` may be NULL; it gets `user_data`,
/// and where it stops the call the status is CANCELLED. `result` gets a handle, whose list INTERSECTIONS has two entries for each pair, the
/// smaller number first, ascending; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_self_intersections(
    mesh: *const fairmesh_mesh,
    among: *const fairmesh_indices,
    progress: fairmesh_progress_fn,
    user_data: *mut c_void,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        let mesh = MeshIn::new(mesh, Argument(1), call)?;
        let among = optional_list_in(among, Argument(2), call)?;
        let result = ResultOut::last(result, Argument(5), call)?;
        let (positions, triangles) = mesh.read()?;
        let among = among.map(|list| list.list()).transpose()?;
        let bytes = memory_bounds::of_whole_mesh(&mesh, 0);
        result.put(bytes, &HostCallback::new(progress, user_data), |tell| {
            let pairs = self_intersections_with_progress(&positions, &triangles, among.as_deref(), tell)?;
            let pairs = pairs.ok_or_else(cancelled)?.into_flattened();
            let content = Content::new(fairmesh_result_kind::Intersections, fairmesh_info::default());
            Ok(content.one(fairmesh_list::Intersections, pairs))
        })
    })
}
