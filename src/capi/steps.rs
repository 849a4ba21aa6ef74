//! Solvers: fairing in steps.

use std::sync::Arc;

use super::choices::{choice, count};
use super::guard::guarded;
use super::input::{MeshIn, SelectionIn};
use super::memory_bounds;
use super::option_structs::fairmesh_options;
use super::options::{OptionsIn, place_of, refused};
use super::outputs::*;
use super::report;
use super::settings::{Change, Setting};
use super::solvers::{HeldSolver, Shared, free, with_solver};
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::Solver;

/// Makes a solver, which fairs in steps: run some iterations, look, change the normals, the continuity or the target, go on. Arguments as in
/// `fairmesh_fair`; everything is copied except for the callback, which `fairmesh_solver_run` calls. Runs without changes
/// find what `fairmesh_fair` finds, to the last bit. `solver` gets a handle; free it by `fairmesh_solver_free`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_new(
    mesh: *const fairmesh_mesh,
    selection: *const fairmesh_selection,
    options: *const fairmesh_options,
    solver: *mut *mut fairmesh_solver,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        let mesh = MeshIn::new(mesh, Argument(1), call)?;
        let selection = SelectionIn::new(selection, Argument(2), &mesh, call)?;
        let asked = OptionsIn::new(options, Argument(3), &mesh, call)?;
        check_slot(solver, Argument(4), call)?;
        call.end(Argument(5))?;

        let selected = selection.read(&mesh)?;
        let options = asked.read(&mesh)?;
        let (positions, triangles) = mesh.read()?;
        let need = memory_bounds::of_fairing(&mesh, &selected, &asked, true)?;
        with_memory(need, &asked.callback, |watch| {
            let made = HeldSolver {
                solver: Solver::new(&positions, &triangles, selected.selection(), &options)?,
                callback: *watch,
                vertices: mesh.vertices(),
                need,
                _standing: memory_bounds::reserve(memory_bounds::STANDING)?,
            };
            publish(Arc::new(Shared::new(made)), solver, watch)
        })
    })
}

/// Runs at most `iterations` nonlinear iterations of each component (at least one), and tells how it stands: the outcome ITERATION_LIMIT or
/// CANCELLED says that a further run goes on from here; after any other one the end is reached, and a further run
/// does nothing until something is changed. `report` may be NULL. On OUT_OF_MEMORY the solver has stopped early; it can go on.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_run(
    solver: *mut fairmesh_solver,
    iterations: u64,
    report: *mut fairmesh_report,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    with_solver(solver, error, |solver, call| {
        if iterations == 0 {
            return Err(refuse!(Argument(2).itself() => BadOption, "has to be at least 1"));
        }
        let out = StructOut::optional(report, Argument(3), call)?;
        call.end(Argument(4))?;
        let told = solver
            .work(|solver, tell| Ok(report::report(&solver.run(count(iterations), Some(tell))?.report)))?;
        out.iter().for_each(|out| out.write(&told));
        Ok(())
    })
}

/// Asks for another value of one option from now on: `setting` is a `fairmesh_setting`, and nothing else of `options` is looked at. NULL: the
/// default. The next run starts at the surface at hand, with the matrices at hand.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_set(
    solver: *mut fairmesh_solver,
    setting: u32,
    options: *const fairmesh_options,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    with_solver(solver, error, |solver, call| {
        let setting = choice(setting, Argument(2).itself())?;
        let view = call.read_options(options, Argument(3), fairmesh_options::standard)?;
        let asked = Setting::new(setting, &view, solver.vertices, call)?;
        call.end(Argument(4))?;
        let asked = asked.read(&view, solver.vertices)?;
        solver.work(|solver, _| {
            match asked {
                Change::Normals(normals) => solver.set_boundary_normals(normals),
                Change::Continuity(continuity, of_loops) => solver.set_continuity(continuity, &of_loops),
                Change::Curvature(curvature) => solver.set_boundary_curvature(curvature),
                Change::Target(target) => solver.set_target(target),
            }
            .map_err(|error| refused(error, Argument(3), place_of))
        })
    })
}

/// All positions as they stand: of the last iteration or frame; before the first one, the input's.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_positions(
    solver: *const fairmesh_solver,
    out: *const fairmesh_points_out,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    with_solver(solver, error, |solver, call| {
        let out = Points::points_out(&call.read(out, Argument(2))?, Argument(2).start())?;
        let out = last(out, Argument(2), call)?;
        put_positions(&out, solver.solver.positions(), Argument(2))
    })
}

/// A copy of everything that is known of the surface as it stands: its report, curvatures, lists, boundary normals. Before the first run the
/// report is of the input. `result` gets a
/// handle of its own; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_result(
    solver: *const fairmesh_solver,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    with_solver(solver, error, |solver, call| {
        let result = ResultOut::last(result, Argument(2), call)?;
        result.put(solver.need, &solver.callback, |_| {
            Ok(solver.solver.solution().clone().into())
        })
    })
}

/// Frees a solver. NULL is allowed. BUSY while it is in use, also from its own callback; nothing is freed then. In a forked process the solvers of
/// its parent are BAD_HANDLE to all functions, this one too.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_free(solver: *mut fairmesh_solver) -> fairmesh_status {
    guarded(core::ptr::null_mut(), |_| match solver.is_null() {
        true => Ok(()),
        false => free(solver),
    })
}
