//! Solvers: fairing in steps.

use std::sync::Arc;

use super::choices::count;
use super::guard::guarded;
use super::input::{CurvatureIn, LoopsIn, MeshIn, NormalsIn, SelectionIn};
use super::memory_bounds;
use super::option_structs::fairmesh_options;
use super::options::{OptionsIn, refused, target};
use super::outputs::*;
use super::report;
use super::results::{attempt_of, component_of, continuity_of};
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
        asked.check_fast(Argument(3))?;
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

/// Asks for other boundary normals from now on. The next run starts at the surface at hand, with the matrices at hand.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_set_boundary_normals(
    solver: *mut fairmesh_solver,
    normals: *const fairmesh_boundary_normals,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    with_solver(solver, error, |solver, call| {
        let (vertices, place) = (solver.vertices, Argument(2).start());
        let asked = NormalsIn::new(&call.read(normals, Argument(2))?, place, vertices, call)?;
        call.end(Argument(3))?;
        let asked = asked.read(vertices)?;
        solver.work(|solver, _| Ok(solver.set_boundary_normals(asked)?))
    })
}

/// Asks for another target from now on. The next run starts at the surface at hand, with the matrices at hand.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_set_target(
    solver: *mut fairmesh_solver,
    new_target: *const fairmesh_target,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    with_solver(solver, error, |solver, call| {
        let asked = target(&call.read(new_target, Argument(2))?, Argument(2).start())?;
        call.end(Argument(3))?;
        let refused = |error| {
            refused(error, Argument(2), |argument, _| {
                Some(field!(argument, fairmesh_target.constant))
            })
        };
        solver.work(|solver, _| solver.set_target(asked).map_err(refused))
    })
}

/// Asks for another continuity of curvature from now on, and for that of single boundary loops; `of_loops` may be NULL: all are alike. The
/// next run starts at the surface at hand, with the matrices at hand.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_set_continuity(
    solver: *mut fairmesh_solver,
    continuity: f64,
    of_loops: *const fairmesh_loop_continuity,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    with_solver(solver, error, |solver, call| {
        let of_loops = call.read_or_default(of_loops, Argument(3))?;
        let of_each = LoopsIn::new(&of_loops, Argument(3).start(), call)?;
        call.end(Argument(4))?;
        let of_each = of_each.read(solver.vertices)?;
        let refused = |error| refused(error, Argument(2), |argument, _| Some(argument.itself()));
        solver.work(|solver, _| solver.set_continuity(continuity, &of_each).map_err(refused))
    })
}

/// Asks for the continuation of another curvature from now on. The next run starts at the surface at hand, with the matrices at hand.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_set_boundary_curvature(
    solver: *mut fairmesh_solver,
    curvature: *const fairmesh_boundary_curvature,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    with_solver(solver, error, |solver, call| {
        let (vertices, place) = (solver.vertices, Argument(2).start());
        let asked = CurvatureIn::new(&call.read(curvature, Argument(2))?, place, vertices, call)?;
        call.end(Argument(3))?;
        let asked = asked.read(vertices)?;
        solver.work(|solver, _| Ok(solver.set_boundary_curvature(asked)?))
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

/// The mean curvature of the surface as it stands, one number per vertex; NaN where no vertex is free.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_mean_curvature(
    solver: *const fairmesh_solver,
    out: *const fairmesh_scalars_out,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    with_solver(solver, error, |solver, call| {
        let out = Numbers::scalars_out(&call.read(out, Argument(2))?, Argument(2).start())?;
        let out = last(out, Argument(2), call)?;
        let curvature = &solver.solver.solution().mean_curvature;
        put_scalars(&out, curvature, solver.vertices, Argument(2))
    })
}

/// The report of the last run; before the first one, of the input.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_report(
    solver: *const fairmesh_solver,
    report: *mut fairmesh_report,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    with_solver(solver, error, |solver, call| {
        let of = &solver.solver.solution().report;
        put_record(report, Argument(2), call, || Ok(report::report(of)))
    })
}

/// One component in that report, by its number: they are sorted by their smallest free vertices.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_component(
    solver: *const fairmesh_solver,
    number: u64,
    component: *mut fairmesh_component,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    with_solver(solver, error, |solver, call| {
        let of = &solver.solver.solution().report;
        put_record(component, Argument(3), call, || component_of(of, number))
    })
}

/// One attempt at the surface of a component in that report, by its number, in the order in which they were made.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_attempt(
    solver: *const fairmesh_solver,
    component: u64,
    number: u64,
    attempt: *mut fairmesh_attempt,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    with_solver(solver, error, |solver, call| {
        let of = &solver.solver.solution().report;
        put_record(attempt, Argument(4), call, || attempt_of(of, component, number))
    })
}

/// How far the surface continues the curvature of its surroundings along one boundary loop of a component in that report, by its
/// number.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_continuity(
    solver: *const fairmesh_solver,
    component: u64,
    number: u64,
    continuity: *mut fairmesh_continuity,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    with_solver(solver, error, |solver, call| {
        let of = &solver.solver.solution().report;
        put_record(continuity, Argument(4), call, || {
            continuity_of(of, component, number)
        })
    })
}

/// A copy of everything that is known of the surface as it stands: curvatures, lists, boundary normals. `result` gets a
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
