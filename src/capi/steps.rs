//! Solvers: fairing in steps.

use core::mem::offset_of;
use std::sync::Arc;

use super::guard::{guarded, point};
use super::handles;
use super::input::{CurvatureIn, LoopsIn, MeshIn, NormalsIn, SelectionIn};
use super::memory_bounds;
use super::option_structs::fairmesh_options;
use super::options::{OptionsIn, refused, target};
use super::outputs::*;
use super::report;
use super::results::{Content, attempt_of, component_of, continuity_of};
use super::solvers::{Shared, Solver};
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::Session;

use fairmesh_status as Status;

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
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut aliases)?;
        let selection = SelectionIn::new(selection, Argument(2), &mesh, &mut aliases)?;
        let asked = OptionsIn::new(options, Argument(3), mesh.vertices(), &mut aliases)?;
        asked.check_fast(Argument(3))?;
        check_slot(solver, Argument(4), &mut aliases)?;
        aliases.error(error, Argument(5))?;

        let selected = selection.read(&mesh)?;
        let options = asked.read(mesh.vertices(), mesh.coincident)?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let need = memory_bounds::of_fairing(&mesh, &selected, &asked, true)?;
        let _reserve = memory_bounds::reserve(need)?;
        let standing = memory_bounds::reserve(memory_bounds::STANDING)?;
        let callback = asked.callback.fresh();
        point();
        let session = Session::new(&positions, &triangles, selected.selection(), &options)?;
        let made = Solver {
            session,
            callback,
            vertices: mesh.vertices(),
            need,
            _standing: standing,
        };
        let handle = handles::add::<fairmesh_solver, _>(Arc::new(Shared::new(made)));
        if let Err(failure) = callback.memory() {
            handles::remove(handle);
            return Err(failure);
        }
        write(solver, handle);
        Ok(())
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
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        if iterations == 0 {
            return Err(Argument(2)
                .itself()
                .refuse(Status::BadOption, format_args!("has to be at least 1")));
        }
        let report_out = StructOut::optional(report, Argument(3), &mut aliases)?;
        aliases.error(error, Argument(4))?;
        let iterations = usize::try_from(iterations).unwrap_or(usize::MAX);
        let told =
            shared.work(|session, tell| Ok(report::report(&session.run(iterations, Some(tell))?.report)))?;
        if let Some(out) = report_out {
            out.write(&told);
        }
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
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        check_pointer(normals, Argument(2))?;
        let mut solver = shared.take()?;
        aliases.input(normals, size_of::<fairmesh_boundary_normals>());
        let asked = NormalsIn::new(&read(normals), Argument(2).start(), solver.vertices, &mut aliases)?;
        aliases.error(error, Argument(3))?;
        let asked = asked.read(solver.vertices)?;
        let _reserve = memory_bounds::reserve(solver.need)?;
        let callback = solver.callback.fresh();
        point();
        solver.session.set_boundary_normals(asked)?;
        callback.memory()
    })
}

/// Asks for another target from now on. The next run starts at the surface at hand, with the matrices at hand.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_set_target(
    solver: *mut fairmesh_solver,
    new_target: *const fairmesh_target,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        check_pointer(new_target, Argument(2))?;
        let asked = target(&read(new_target), Argument(2).start())?;
        aliases.input(new_target, size_of::<fairmesh_target>());
        aliases.error(error, Argument(3))?;
        let mut solver = shared.take()?;
        let _reserve = memory_bounds::reserve(solver.need)?;
        let callback = solver.callback.fresh();
        point();
        let refused = |error| {
            refused(error, Argument(2), |argument, _| {
                Some(argument.field(offset_of!(fairmesh_target, constant), "constant"))
            })
        };
        solver.session.set_target(asked).map_err(refused)?;
        callback.memory()
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
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        let mut of_each = None;
        if !of_loops.is_null() {
            check_pointer(of_loops, Argument(3))?;
            aliases.input(of_loops, size_of::<fairmesh_loop_continuity>());
            of_each = Some(LoopsIn::new(&read(of_loops), Argument(3).start(), &mut aliases)?);
        }
        aliases.error(error, Argument(4))?;
        let mut solver = shared.take()?;
        let vertices = solver.vertices;
        let of_each = of_each.map_or(Ok(Vec::new()), |loops| loops.read(vertices))?;
        let _reserve = memory_bounds::reserve(solver.need)?;
        let callback = solver.callback.fresh();
        point();
        let refused = |error| refused(error, Argument(2), |argument, _| Some(argument.itself()));
        solver
            .session
            .set_continuity(continuity, &of_each)
            .map_err(refused)?;
        callback.memory()
    })
}

/// Asks for the continuation of another curvature from now on. The next run starts at the surface at hand, with the matrices at hand.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_set_boundary_curvature(
    solver: *mut fairmesh_solver,
    curvature: *const fairmesh_boundary_curvature,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        check_pointer(curvature, Argument(2))?;
        let mut solver = shared.take()?;
        aliases.input(curvature, size_of::<fairmesh_boundary_curvature>());
        let place = Argument(2).start();
        let asked = CurvatureIn::new(&read(curvature), place, solver.vertices, &mut aliases)?;
        aliases.error(error, Argument(3))?;
        let asked = asked.read(solver.vertices)?;
        let _reserve = memory_bounds::reserve(solver.need)?;
        let callback = solver.callback.fresh();
        point();
        solver.session.set_boundary_curvature(asked)?;
        callback.memory()
    })
}

/// Tells something of a solver as it stands: `open` checks where it goes, `put` writes it there.
fn with_solver<Out>(
    solver: *const fairmesh_solver,
    error: *mut fairmesh_error,
    open: impl FnOnce(&mut AliasCheck) -> CallResult<Out>,
    put: impl FnOnce(Out, &Solver) -> CallResult,
) -> fairmesh_status {
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        let out = open(&mut aliases)?;
        aliases.error(error, Argument(3))?;
        let solver = shared.take()?;
        point();
        put(out, &solver)
    })
}

/// All positions as they stand: of the last iteration or frame; before the first one, the input's.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_positions(
    solver: *const fairmesh_solver,
    out: *const fairmesh_points_out,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    let open = |aliases: &mut AliasCheck| {
        let out = NumbersOut::points(out, Argument(2))?;
        aliases.output(out.array.data, out.array.bytes, Argument(2))?;
        Ok(out)
    };
    with_solver(solver, error, open, |out, solver| {
        put_positions(&out, solver.session.positions(), Argument(2))
    })
}

/// The mean curvature of the surface as it stands, one number per vertex; NaN where no vertex is free.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_mean_curvature(
    solver: *const fairmesh_solver,
    out: *const fairmesh_scalars_out,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    let open = |aliases: &mut AliasCheck| {
        let out = NumbersOut::scalars(out, Argument(2))?;
        aliases.output(out.array.data, out.array.bytes, Argument(2))?;
        Ok(out)
    };
    with_solver(solver, error, open, |out, solver| {
        let curvature = &solver.session.solution().mean_curvature;
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
    let open = |aliases: &mut AliasCheck| StructOut::new(report, Argument(2), aliases);
    with_solver(solver, error, open, |out, solver| {
        out.write(&report::report(&solver.session.solution().report));
        Ok(())
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
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        let out = StructOut::new(component, Argument(3), &mut aliases)?;
        aliases.error(error, Argument(4))?;
        let solver = shared.take()?;
        point();
        out.write(&component_of(&solver.session.solution().report, number)?);
        Ok(())
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
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        let out = StructOut::new(attempt, Argument(4), &mut aliases)?;
        aliases.error(error, Argument(5))?;
        let solver = shared.take()?;
        point();
        let report = &solver.session.solution().report;
        out.write(&attempt_of(report, component, number)?);
        Ok(())
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
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        let out = StructOut::new(continuity, Argument(4), &mut aliases)?;
        aliases.error(error, Argument(5))?;
        let solver = shared.take()?;
        point();
        let report = &solver.session.solution().report;
        out.write(&continuity_of(report, component, number)?);
        Ok(())
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
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        check_slot(result, Argument(2), &mut aliases)?;
        aliases.error(error, Argument(3))?;
        let solver = shared.take()?;
        let _reserve = memory_bounds::reserve(solver.need)?;
        let callback = solver.callback.fresh();
        point();
        let content = Content::Faired(solver.session.solution().clone());
        publish(Arc::new(content), result, &callback)
    })
}

/// Frees a solver. NULL is allowed. BUSY while it is in use, also from its own callback; nothing is freed then.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_free(solver: *mut fairmesh_solver) -> fairmesh_status {
    guarded(core::ptr::null_mut(), || {
        if solver.is_null() {
            return Ok(());
        }
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        if shared.is_busy() {
            return Err(Failure::new(Status::Busy, format_args!("the solver is in use")));
        }
        handles::remove(solver);
        Ok(())
    })
}
