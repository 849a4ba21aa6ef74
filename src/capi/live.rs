//! Solvers for interactive hosts: edits of the boundary, and the surface frame by frame.

use super::edits::{EditsIn, budget, fairmesh_budget, fairmesh_bulge_range, fairmesh_edit, fairmesh_frame};
use super::guard::{guarded, point};
use super::handles;
use super::memory_bounds;
use super::report;
use super::solvers::Shared;
use super::status::*;
use super::types::*;
use super::views::*;

/// Asks for these changes of the boundary: of its normals, and of where fixed vertices are. `edits` are `edit_count` edits, one after the
/// other in memory; NULL only if there are none. They take the place of the edits before and are all relative to what was asked when
/// the solver was made and by the other calls since; no edits: nothing is changed of that. The next update or run starts at the
/// surface at hand, with the matrices at hand.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_edit(
    solver: *mut fairmesh_solver,
    edits: *const fairmesh_edit,
    edit_count: usize,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        let checked = EditsIn::new(edits, edit_count, Argument(2), |aliases| {
            aliases.error(error, Argument(4))
        })?;
        let mut solver = shared.take()?;
        let edits = checked.read(solver.vertices)?;
        let _reserve = memory_bounds::reserve(solver.need)?;
        let callback = solver.callback.fresh();
        point();
        solver.session.edit(&edits)?;
        callback.memory()
    })
}

/// One frame: goes on until the surface is settled to the tolerance of `limit` or that is used up, and tells how it stands; whether the
/// surface is sound is not looked at. `limit` may be NULL: no limit. With a limit of evaluations alone, the same calls
/// find the same bits. `fairmesh_solver_positions` has the surface. The callback is not called.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_update(
    solver: *mut fairmesh_solver,
    limit: *const fairmesh_budget,
    frame: *mut fairmesh_frame,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        let limit = budget(limit, Argument(2), &mut aliases)?;
        let out = StructOut::new(frame, Argument(3), &mut aliases)?;
        aliases.error(error, Argument(4))?;
        let told = shared.work(|session, _| Ok(session.update(&limit)?))?;
        out.write(&fairmesh_frame {
            struct_size: size_of::<fairmesh_frame>() as u32,
            is_settled: told.is_settled.into(),
            evaluations: told.evaluations as u64,
            step: told.step,
        });
        Ok(())
    })
}

/// The converged surface with its report, checked, as a run to the end: within the tolerance that of `fairmesh_fair` with what is asked
/// and edited. `report` may be NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_finish(
    solver: *mut fairmesh_solver,
    report: *mut fairmesh_report,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        let report_out = StructOut::optional(report, Argument(2), &mut aliases)?;
        aliases.error(error, Argument(3))?;
        let told = shared.work(|session, tell| Ok(report::report(&session.finish(Some(tell))?.report)))?;
        if let Some(out) = report_out {
            out.write(&told);
        }
        Ok(())
    })
}

/// Between which amounts of a bulge, beside the other edits in force, sound surfaces are found: by steps outward from 0. It costs some
/// tens of frames; the surface at hand stays.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_bulge_range(
    solver: *mut fairmesh_solver,
    range: *mut fairmesh_bulge_range,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        let out = StructOut::new(range, Argument(2), &mut aliases)?;
        aliases.error(error, Argument(3))?;
        let [low, high] = shared.work(|session, tell| Ok(session.bulge_range(Some(tell))?))?;
        out.write(&fairmesh_bulge_range {
            struct_size: size_of::<fairmesh_bulge_range>() as u32,
            reserved: 0,
            low,
            high,
        });
        Ok(())
    })
}
