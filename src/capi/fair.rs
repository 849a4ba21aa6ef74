//! One call: fairing, and the mean curvature and the self-intersections of a whole mesh.

use std::sync::Arc;

use super::callback::HostCallback;
use super::guard::{guarded, point};
use super::input::{IndicesIn, MeshIn, SelectionIn};
use super::memory_bounds;
use super::option_structs::fairmesh_options;
use super::options::OptionsIn;
use super::outputs::*;
use super::report;
use super::results::Content;
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::{OutputPrecision, Progress, Solution, fair_with_progress};
use fairmesh::{mean_curvature_joined, self_intersections};

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
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut aliases)?;
        let selection = SelectionIn::new(selection, Argument(2), &mesh, &mut aliases)?;
        let asked = OptionsIn::new(options, Argument(3), mesh.vertices(), &mut aliases)?;
        let out = match positions_out.is_null() {
            true => None,
            false => {
                let out = NumbersOut::points(positions_out, Argument(4))?;
                out.check_count(mesh.vertices(), Argument(4))?;
                aliases.input(positions_out, size_of::<fairmesh_points_out>());
                Some(out)
            }
        };
        let in_place = out.as_ref().is_some_and(|out| out.same_as(&mesh.positions));
        if let (Some(out), false) = (&out, in_place) {
            aliases.output(out.array.data, out.array.bytes, Argument(4))?;
        }
        let report_out = StructOut::optional(report, Argument(5), &mut aliases)?;
        if !result.is_null() {
            check_slot(result, Argument(6), &mut aliases)?;
        }
        aliases.error(error, Argument(7))?;

        let selected = selection.read(&mesh)?;
        let mut options = asked.read(mesh.vertices(), mesh.coincident)?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let _reserve = memory_bounds::reserve(memory_bounds::of_fairing(&mesh, &selected, &asked, false)?)?;
        let callback = asked.callback.fresh();
        point();
        let solution = {
            let mut tell = |progress: &Progress| callback.tell(progress);
            if out.as_ref().is_some_and(NumbersOut::is_single) {
                options.output_precision = OutputPrecision::Single;
            }
            fair_with_progress(&positions, &triangles, selected.selection(), &options, &mut tell)?
        };
        drop((positions, triangles));
        callback.memory()?;
        if let Some(out) = &out {
            out.check_range(solution.positions.iter().copied().enumerate())?;
        }
        let content = Arc::new(Content::Faired(solution));
        if !result.is_null() {
            publish(content.clone(), result, &callback)?;
        }
        if let (Some(out), Content::Faired(solution)) = (&out, &*content) {
            write_positions(out, solution, in_place);
        }
        let told = report::report(content.report(0)?);
        if let Some(out) = report_out {
            out.write(&told);
        }
        Ok(())
    })
}

fn write_positions(out: &NumbersOut<3>, solution: &Solution, only_free: bool) {
    if only_free {
        for &(v, _) in &solution.mean_curvature {
            out.set(v as usize, solution.positions[v as usize]);
        }
    } else {
        for (v, p) in solution.positions.iter().enumerate() {
            out.set(v, *p);
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
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut aliases)?;
        let out = NumbersOut::scalars(out, Argument(2))?;
        out.check_count(mesh.vertices(), Argument(2))?;
        aliases.output(out.array.data, out.array.bytes, Argument(2))?;
        aliases.error(error, Argument(3))?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let _reserve = memory_bounds::reserve(memory_bounds::of_whole_mesh(&mesh, 0))?;
        let callback = HostCallback::new(None, core::ptr::null_mut());
        point();
        let curvature = mean_curvature_joined(&positions, &triangles, mesh.coincident)?;
        callback.memory()?;
        out.check_range(curvature.iter().map(|h| [*h]).enumerate())?;
        curvature.iter().enumerate().for_each(|(v, h)| out.set(v, [*h]));
        Ok(())
    })
}

/// Pairs of triangles of a mesh that intersect: that have more in common than a vertex of both or an edge of both, where
/// vertices at the same position are one; also if they only touch. Exact for the positions given. Triangles without area take
/// no part. The mesh need not be a manifold.
///
/// `among` may be NULL: all pairs. Otherwise triangles, and only pairs with at least one of them. `result` gets a handle, whose
/// list INTERSECTIONS has two entries for each pair, the smaller number first, ascending; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_self_intersections(
    mesh: *const fairmesh_mesh,
    among: *const fairmesh_indices,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut aliases)?;
        let among = IndicesIn::optional(among, Argument(2), &mut aliases)?;
        check_slot(result, Argument(3), &mut aliases)?;
        aliases.error(error, Argument(4))?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let asked = among.map(|list| list.read()).transpose()?;
        let _reserve = memory_bounds::reserve(memory_bounds::of_whole_mesh(&mesh, 0))?;
        let callback = HostCallback::new(None, core::ptr::null_mut());
        point();
        let asked = asked.as_deref().map(<[[u32; 1]]>::as_flattened);
        let pairs = self_intersections(&positions, &triangles, asked)?;
        publish(Arc::new(Content::Intersections(pairs)), result, &callback)
    })
}
