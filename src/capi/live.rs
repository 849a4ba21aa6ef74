//! Solvers for interactive hosts: edits of the boundary, and the surface frame by frame.

use super::edits::{self, budget, fairmesh_budget, fairmesh_bulge_range, fairmesh_edit, fairmesh_frame};
use super::outputs::put_record;
use super::report;
use super::solvers::with_solver;
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
    with_solver(solver, error, |solver, call| {
        let edits = edits::edits(edits, edit_count, solver.vertices, call)?;
        solver.work(|solver, _| Ok(solver.edit(&edits)?))
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
    with_solver(solver, error, |solver, call| {
        let limit = budget(limit, Argument(2), call)?;
        put_record(frame, Argument(3), call, || {
            let told = solver.work(|solver, _| Ok(solver.update(&limit)?))?;
            Ok(fairmesh_frame {
                struct_size: size_of::<fairmesh_frame>() as u32,
                is_settled: told.is_settled.into(),
                evaluations: told.evaluations as u64,
                step: told.step,
            })
        })
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
    with_solver(solver, error, |solver, call| {
        let out = StructOut::optional(report, Argument(2), call)?;
        call.end(Argument(3))?;
        let told = solver.work(|solver, tell| Ok(report::report(&solver.finish(Some(tell))?.report)))?;
        out.iter().for_each(|out| out.write(&told));
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
    with_solver(solver, error, |solver, call| {
        put_record(range, Argument(2), call, || {
            let [low, high] = solver.work(|solver, tell| Ok(solver.bulge_range(Some(tell))?))?;
            Ok(fairmesh_bulge_range {
                struct_size: size_of::<fairmesh_bulge_range>() as u32,
                reserved: 0,
                low,
                high,
            })
        })
    })
}
