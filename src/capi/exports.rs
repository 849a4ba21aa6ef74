//! The functions of the header.

use core::ffi::c_char;
use core::mem::offset_of;
use std::sync::Arc;

use super::guard::{guarded, point};
use super::input::{MeshIn, NormalsIn, OptionsIn, SelectionIn, default_options, target};
use super::need;
use super::report;
use super::results::Content;
use super::solvers::{Shared, Solver};
use super::status::*;
use super::types::*;
use super::views::*;
use super::{handles, input};
use crate::discrete::mesh_curvature::mean_curvature;
use crate::fairing::{Progress, Session, Solution, fair, with_threads};
use crate::holes::{FillOptions, LoopKind, Loops, RemeshOptions, border_loops, fill_holes, remesh_region};

use fairmesh_status as Status;

/// Major version of the interface: it changes when something does that programs rely on.
pub const FAIRMESH_VERSION_MAJOR: u32 = 0;
/// Minor version: it grows when something is added; while the major version is 0, also when something changes.
pub const FAIRMESH_VERSION_MINOR: u32 = 1;
/// Patch version.
pub const FAIRMESH_VERSION_PATCH: u32 = 0;

/// The version of the library that runs: 65536 major + 256 minor + patch. Compare it with `FAIRMESH_VERSION_MAJOR` and so on,
/// which are those of the header.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_version() -> u32 {
    FAIRMESH_VERSION_MAJOR << 16 | FAIRMESH_VERSION_MINOR << 8 | FAIRMESH_VERSION_PATCH
}

/// The same as text, such as "0.1.0". Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_version_string() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    VERSION.as_ptr().cast()
}

/// The name of a `fairmesh_status`, in English; of any number. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_status_name(status: i32) -> *const c_char {
    Status::name(status).as_ptr()
}

/// The name of a `fairmesh_outcome`, such as "converged"; of any number. Static; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_outcome_name(outcome: u32) -> *const c_char {
    report::outcome_name(outcome).as_ptr()
}

/// Fills options with the defaults. `struct_size` is `sizeof(fairmesh_options)`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_options_init(
    options: *mut fairmesh_options,
    struct_size: usize,
) -> fairmesh_status {
    guarded(core::ptr::null_mut(), || {
        init_struct(options, struct_size, &default_options())
    })
}

/// Fills options of hole filling with the defaults. `struct_size` is `sizeof(fairmesh_fill_options)`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_fill_options_init(
    options: *mut fairmesh_fill_options,
    struct_size: usize,
) -> fairmesh_status {
    guarded(core::ptr::null_mut(), || {
        init_struct(options, struct_size, &default_fill_options())
    })
}

/// Fills options of remeshing with the defaults. `struct_size` is `sizeof(fairmesh_remesh_options)`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_remesh_options_init(
    options: *mut fairmesh_remesh_options,
    struct_size: usize,
) -> fairmesh_status {
    guarded(core::ptr::null_mut(), || {
        init_struct(options, struct_size, &default_remesh_options())
    })
}

fn default_fill_options() -> fairmesh_fill_options {
    let options = FillOptions::default();
    fairmesh_fill_options {
        struct_size: size_of::<fairmesh_fill_options>() as u32,
        fair: u32::from(options.fair),
        max_edges: u64::MAX,
        loops: fairmesh_indices {
            data: core::ptr::null(),
            count: 0,
            stride: 0,
        },
        density: options.density,
        max_new_vertices: options.max_new_vertices as u64,
    }
}

fn default_remesh_options() -> fairmesh_remesh_options {
    let options = RemeshOptions::default();
    fairmesh_remesh_options {
        struct_size: size_of::<fairmesh_remesh_options>() as u32,
        reserved: 0,
        density: options.density,
        max_vertices: options.max_vertices as u64,
    }
}

/// Moves the free vertices of a mesh until the surface solves Delta_B H = 0, or what the options' target asks, between the
/// fixed vertices, with tangent continuity there.
///
/// `selection` may be NULL: all vertices that are not on the border of the mesh are free. `options` may be NULL: the
/// defaults. `positions_out` gets all vertices, as many as the mesh has; it may be the mesh's own positions (same address,
/// stride and scalar), then only free vertices are written. `report` may be NULL. `result`, which may be NULL, gets a handle with
/// everything else that was found; free it. `positions_out` may be NULL.
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
        let mut spans = Spans::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut spans)?;
        let selection = SelectionIn::new(selection, Argument(2), &mesh, &mut spans)?;
        let asked = OptionsIn::new(options, Argument(3), mesh.vertices(), &mut spans)?;
        let out = match positions_out.is_null() {
            true => None,
            false => {
                let out = NumbersOut::points(positions_out, Argument(4))?;
                out.check_count(mesh.vertices(), Argument(4))?;
                spans.input(positions_out, size_of::<fairmesh_points_out>());
                Some(out)
            }
        };
        let in_place = out.as_ref().is_some_and(|out| out.same_as(&mesh.positions));
        if let (Some(out), false) = (&out, in_place) {
            spans.output(out.array.data, out.array.bytes, Argument(4))?;
        }
        let report_out = StructOut::optional(report, Argument(5), &mut spans)?;
        if !result.is_null() {
            check_slot(result, Argument(6), &mut spans)?;
        }
        spans.error(error, Argument(7))?;

        let selected = selection.read(&mesh)?;
        let normals = asked.normals.read(mesh.vertices())?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let _reserve = need::reserve(need::of_fairing(&mesh, &selected, asked.threads)?)?;
        let teller = asked.teller.fresh();
        point();
        let solution = {
            let mut tell = |progress: &Progress| teller.tell(progress);
            let options = asked.options(&normals, Some(&mut tell));
            fair(&positions, &triangles, selected.selection(), options)?
        };
        drop((positions, triangles));
        teller.memory()?;
        if let Some(out) = &out {
            out.check_range(solution.positions.iter().copied().enumerate())?;
        }
        let content = Arc::new(Content::Faired(solution));
        if !result.is_null() {
            publish(content.clone(), result, &teller)?;
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
        let mut spans = Spans::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut spans)?;
        let out = NumbersOut::scalars(out, Argument(2))?;
        out.check_count(mesh.vertices(), Argument(2))?;
        spans.output(out.array.data, out.array.bytes, Argument(2))?;
        spans.error(error, Argument(3))?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let _reserve = need::reserve(need::of_whole_mesh(&mesh, 0))?;
        let teller = input::Teller::new(None, core::ptr::null_mut());
        point();
        // Not on the global pool, whose threads would outlive the library.
        let curvature = with_threads(0, |pool| pool.install(|| mean_curvature(&positions, &triangles)))??;
        teller.memory()?;
        out.check_range(curvature.iter().map(|h| [*h]).enumerate())?;
        curvature.iter().enumerate().for_each(|(v, h)| out.set(v, [*h]));
        Ok(())
    })
}

/// Makes a solver, which fairs in steps: run some iterations, look, change the normals or the target, go on. Arguments as in
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
        let mut spans = Spans::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut spans)?;
        let selection = SelectionIn::new(selection, Argument(2), &mesh, &mut spans)?;
        let asked = OptionsIn::new(options, Argument(3), mesh.vertices(), &mut spans)?;
        if asked.solver != crate::fairing::Solver::Fast {
            let place = Argument(3).field(offset_of!(fairmesh_options, solver));
            return Err(place.refuse(
                Status::BadOption,
                format_args!("only the fast solver runs in steps"),
            ));
        }
        check_slot(solver, Argument(4), &mut spans)?;
        spans.error(error, Argument(5))?;

        let selected = selection.read(&mesh)?;
        let normals = asked.normals.read(mesh.vertices())?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let need = need::of_fairing(&mesh, &selected, asked.threads)?;
        let _reserve = need::reserve(need)?;
        let standing = need::reserve(need::STANDING)?;
        let teller = asked.teller.fresh();
        point();
        let session = Session::new(
            &positions,
            &triangles,
            selected.selection(),
            &asked.options(&normals, None),
        )?;
        let made = Solver {
            session,
            teller,
            vertices: mesh.vertices(),
            need,
            _standing: standing,
        };
        let handle = handles::add::<fairmesh_solver, _>(Arc::new(Shared::new(made)));
        if let Err(failure) = teller.memory() {
            handles::remove(handle);
            return Err(failure);
        }
        write(solver, handle);
        Ok(())
    })
}

/// Runs at most `iterations` nonlinear iterations (at least one), and tells how it stands: the outcome ITERATION_LIMIT or
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
        let mut spans = Spans::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        if iterations == 0 {
            return Err(Argument(2)
                .itself()
                .refuse(Status::BadOption, format_args!("has to be at least 1")));
        }
        let report_out = StructOut::optional(report, Argument(3), &mut spans)?;
        spans.error(error, Argument(4))?;
        let mut solver = shared.take()?;
        let _reserve = need::reserve(solver.need)?;
        let teller = solver.teller.fresh();
        point();
        let mut tell = |progress: &Progress| teller.tell(progress);
        let iterations = usize::try_from(iterations).unwrap_or(usize::MAX);
        let told = report::report(&solver.session.run(iterations, Some(&mut tell))?.report);
        teller.memory()?;
        if let Some(out) = report_out {
            out.write(&told);
        }
        Ok(())
    })
}

/// Asks for other border normals from now on. The next run starts at the surface at hand, with the matrices at hand.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_set_normals(
    solver: *mut fairmesh_solver,
    normals: *const fairmesh_normals,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut spans = Spans::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        check_pointer(normals, Argument(2))?;
        let mut solver = shared.take()?;
        spans.input(normals, size_of::<fairmesh_normals>());
        let asked = NormalsIn::new(&read(normals), Argument(2).field(0), solver.vertices, &mut spans)?;
        spans.error(error, Argument(3))?;
        let asked = asked.read(solver.vertices)?;
        let _reserve = need::reserve(solver.need)?;
        let teller = solver.teller.fresh();
        point();
        solver.session.set_border_normals(asked.normals())?;
        teller.memory()
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
        let mut spans = Spans::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        check_pointer(new_target, Argument(2))?;
        let asked = target(&read(new_target), Argument(2).field(0))?;
        spans.input(new_target, size_of::<fairmesh_target>());
        spans.error(error, Argument(3))?;
        let mut solver = shared.take()?;
        let _reserve = need::reserve(solver.need)?;
        let teller = solver.teller.fresh();
        point();
        solver.session.set_target(asked)?;
        teller.memory()
    })
}

/// All positions as they stand: of the last iteration run; before the first one, the input's.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_positions(
    solver: *const fairmesh_solver,
    out: *const fairmesh_points_out,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut spans = Spans::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        let out = NumbersOut::points(out, Argument(2))?;
        spans.output(out.array.data, out.array.bytes, Argument(2))?;
        spans.error(error, Argument(3))?;
        let solver = shared.take()?;
        point();
        put_positions(&out, &solver.session.solution().positions, Argument(2))
    })
}

/// The mean curvature of the surface as it stands, one number per vertex; NaN where no vertex is free.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_mean_curvature(
    solver: *const fairmesh_solver,
    out: *const fairmesh_scalars_out,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut spans = Spans::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        let out = NumbersOut::scalars(out, Argument(2))?;
        spans.output(out.array.data, out.array.bytes, Argument(2))?;
        spans.error(error, Argument(3))?;
        let solver = shared.take()?;
        point();
        put_scalars(
            &out,
            &solver.session.solution().mean_curvature,
            solver.vertices,
            Argument(2),
        )
    })
}

/// The report of the last run; before the first one, of the input.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_report(
    solver: *const fairmesh_solver,
    report: *mut fairmesh_report,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut spans = Spans::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        let out = StructOut::new(report, Argument(2), &mut spans)?;
        spans.error(error, Argument(3))?;
        let solver = shared.take()?;
        point();
        out.write(&report::report(&solver.session.solution().report));
        Ok(())
    })
}

/// A copy of everything that is known of the surface as it stands: curvatures, lists, border normals. `result` gets a
/// handle of its own; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_solver_result(
    solver: *const fairmesh_solver,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut spans = Spans::new();
        let shared = handles::get::<_, Shared>(solver, Argument(1))?;
        check_slot(result, Argument(2), &mut spans)?;
        spans.error(error, Argument(3))?;
        let solver = shared.take()?;
        let _reserve = need::reserve(solver.need)?;
        let teller = solver.teller.fresh();
        point();
        let content = Content::Faired(solver.session.solution().clone());
        publish(Arc::new(content), result, &teller)
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

/// Makes a result, unless memory has run out.
fn publish(content: Arc<Content>, result: *mut *mut fairmesh_result, teller: &input::Teller) -> Outcome {
    let handle = handles::add::<fairmesh_result, _>(content);
    if let Err(failure) = teller.memory() {
        handles::remove(handle);
        return Err(failure);
    }
    write(result, handle);
    Ok(())
}

fn put_positions(out: &NumbersOut<3>, positions: &[[f64; 3]], argument: Argument) -> Outcome {
    out.check_count(positions.len(), argument)?;
    out.check_range(positions.iter().copied().enumerate())?;
    positions.iter().enumerate().for_each(|(v, p)| out.set(v, *p));
    Ok(())
}

fn put_scalars(out: &NumbersOut<1>, values: &[(u32, f64)], vertices: usize, argument: Argument) -> Outcome {
    out.check_count(vertices, argument)?;
    out.check_range(values.iter().map(|(v, x)| (*v as usize, [*x])))?;
    (0..vertices).for_each(|v| out.set(v, [f64::NAN]));
    values.iter().for_each(|(v, x)| out.set(*v as usize, [*x]));
    Ok(())
}

/// Finds the border loops of a mesh: holes and outer borders. `result` gets a handle; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_border_loops(
    mesh: *const fairmesh_mesh,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut spans = Spans::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut spans)?;
        check_slot(result, Argument(2), &mut spans)?;
        spans.error(error, Argument(3))?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let _reserve = need::reserve(need::of_whole_mesh(&mesh, 1))?;
        let teller = input::Teller::new(None, core::ptr::null_mut());
        point();
        let loops = border_loops(&positions, &triangles)?;
        publish(Arc::new(Content::Loops(loops)), result, &teller)
    })
}

/// Fills holes: triangulates, refines and fairs each. Vertices and triangles given keep their numbers and bits; new
/// ones follow. A loop that cannot be filled says so in its report and does not affect the others.
///
/// `fill` may be NULL: all holes, edges as long as those beside the rims. `options` may be NULL: the defaults of the fairing;
/// given normals are those of rim vertices. `result` gets a handle; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_fill_holes(
    mesh: *const fairmesh_mesh,
    fill: *const fairmesh_fill_options,
    options: *const fairmesh_options,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut spans = Spans::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut spans)?;
        let fill_view = if fill.is_null() {
            default_fill_options()
        } else {
            read_struct(fill, Argument(2))?
        };
        check_density(
            fill_view.density,
            Argument(2).field(offset_of!(fairmesh_fill_options, density)),
        )?;
        let named = indices_in(
            &fill_view.loops,
            1,
            Argument(2).field(offset_of!(fairmesh_fill_options, loops)),
        )?;
        spans.input(
            fill,
            size_of::<fairmesh_fill_options>() * usize::from(!fill.is_null()),
        );
        spans.input(named.data, named.bytes);
        let asked = OptionsIn::new(options, Argument(3), mesh.vertices(), &mut spans)?;
        check_slot(result, Argument(4), &mut spans)?;
        spans.error(error, Argument(5))?;

        let normals = asked.normals.read(mesh.vertices())?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let mut numbers: Vec<usize> = room(named.count)?;
        numbers.extend((0..named.count).map(|k| named.index::<1>(k)[0] as usize));
        let count = |n: u64| usize::try_from(n).unwrap_or(usize::MAX);
        let most = count(fill_view.max_new_vertices);
        let teller = asked.teller.fresh();
        // How large the patches will be is known by the loops.
        let (new_vertices, longest) = {
            let _reserve = need::reserve(need::of_whole_mesh(&mesh, 1))?;
            let loops = border_loops(&positions, &triangles)?;
            teller.memory()?;
            if let Some(&missing) = numbers.iter().find(|&&l| l >= loops.len()) {
                let why = format_args!("loop {missing} is named, but there are only {}", loops.len());
                let failure = Failure::new(Status::SelectionOutOfRange, why);
                return Err(failure.at(fairmesh_element::Loop, missing));
            }
            let up_to = count(fill_view.max_edges);
            let chosen = |l: usize| match numbers.is_empty() {
                true => loops[l].kind == LoopKind::Hole && loops[l].vertices.len() <= up_to,
                false => numbers.contains(&l),
            };
            let edges = (0..loops.len())
                .filter(|&l| chosen(l))
                .map(|l| loops[l].vertices.len());
            // A disk of n edges has about n^2 / 11 vertices at the default density of the square root of 2.
            let area = |n: usize| (n * n) as f64 * (fill_view.density * fill_view.density).max(0.5) / 4.0;
            let new = edges.clone().map(area).sum::<f64>();
            ((new as usize).min(most), edges.max().unwrap_or(0))
        };
        let bytes = need::of_filling(&mesh, new_vertices.saturating_add(1000), longest, asked.threads);
        let _reserve = need::reserve(bytes)?;
        point();
        let filled = {
            let mut tell = |progress: &Progress| teller.tell(progress);
            let asked = FillOptions {
                loops: if named.count > 0 {
                    Loops::Chosen(&numbers)
                } else {
                    Loops::UpTo(count(fill_view.max_edges))
                },
                density: fill_view.density,
                max_new_vertices: most,
                fair: fill_view.fair != 0,
                fairing: asked.options(&normals, Some(&mut tell)),
            };
            fill_holes(&positions, &triangles, asked)?
        };
        teller.memory()?;
        let content = Content::Filled {
            filled,
            vertices: positions.len(),
            triangles: triangles.len(),
        };
        publish(Arc::new(content), result, &teller)
    })
}

fn check_density(density: f64, place: Place) -> Outcome {
    if (0.1..=10.0).contains(&density) {
        return Ok(());
    }
    Err(place.refuse(Status::BadOption, format_args!("has to be between 0.1 and 10")))
}

/// Triangulates a region anew, by edge lengths as beside it, without moving the surface. To fair the new mesh, take the list
/// FREE_VERTICES of the result as selection. `selection` and `options` may be NULL. `result` gets a handle; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_remesh(
    mesh: *const fairmesh_mesh,
    selection: *const fairmesh_selection,
    options: *const fairmesh_remesh_options,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut spans = Spans::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut spans)?;
        let selection = SelectionIn::new(selection, Argument(2), &mesh, &mut spans)?;
        let view = if options.is_null() {
            default_remesh_options()
        } else {
            read_struct(options, Argument(3))?
        };
        check_reserved(
            view.reserved,
            Argument(3).field(offset_of!(fairmesh_remesh_options, reserved)),
        )?;
        check_density(
            view.density,
            Argument(3).field(offset_of!(fairmesh_remesh_options, density)),
        )?;
        spans.input(
            options,
            size_of::<fairmesh_remesh_options>() * usize::from(!options.is_null()),
        );
        check_slot(result, Argument(4), &mut spans)?;
        spans.error(error, Argument(5))?;
        let selected = selection.read(&mesh)?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let most = usize::try_from(view.max_vertices).unwrap_or(usize::MAX);
        let _reserve = need::reserve(need::of_remeshing(&mesh, &selected, most))?;
        let teller = input::Teller::new(None, core::ptr::null_mut());
        point();
        let asked = RemeshOptions {
            density: view.density,
            max_vertices: most,
        };
        let remeshed = remesh_region(&positions, &triangles, selected.selection(), &asked)?;
        publish(Arc::new(Content::Remeshed(remeshed)), result, &teller)
    })
}

/// The sizes of a result.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_info(
    result: *const fairmesh_result,
    info: *mut fairmesh_info,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, spans| {
        let out = StructOut::new(info, Argument(2), spans)?;
        spans.error(error, Argument(3))?;
        out.write(&content.info());
        Ok(())
    })
}

/// The report of the fairing: of a faired mesh with `index` 0, of a filled one that of the loop with this number in the result.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_report(
    result: *const fairmesh_result,
    index: u64,
    report: *mut fairmesh_report,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, spans| {
        let out = StructOut::new(report, Argument(3), spans)?;
        spans.error(error, Argument(4))?;
        out.write(&report::report(content.report(index)?));
        Ok(())
    })
}

/// A level of the paper's scheme, from the base (0) to the mesh given.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_level(
    result: *const fairmesh_result,
    index: u64,
    level: *mut fairmesh_level,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, spans| {
        let out = StructOut::new(level, Argument(3), spans)?;
        spans.error(error, Argument(4))?;
        out.write(&content.level(index)?);
        Ok(())
    })
}

/// One of the border loops.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_loop(
    result: *const fairmesh_result,
    index: u64,
    border_loop: *mut fairmesh_loop,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, spans| {
        let out = StructOut::new(border_loop, Argument(3), spans)?;
        spans.error(error, Argument(4))?;
        out.write(&content.border_loop(index)?);
        Ok(())
    })
}

/// What became of a loop that was to be filled.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_fill_report(
    result: *const fairmesh_result,
    index: u64,
    report: *mut fairmesh_fill_report,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, spans| {
        let out = StructOut::new(report, Argument(3), spans)?;
        spans.error(error, Argument(4))?;
        out.write(&content.filled_loop(index)?);
        Ok(())
    })
}

/// The positions of all vertices: `vertex_count` of the info.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_positions(
    result: *const fairmesh_result,
    out: *const fairmesh_points_out,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, spans| {
        let out = NumbersOut::points(out, Argument(2))?;
        spans.output(out.array.data, out.array.bytes, Argument(2))?;
        spans.error(error, Argument(3))?;
        put_positions(&out, content.positions()?, Argument(2))
    })
}

/// All triangles of a filled or remeshed mesh: `triangle_count` of the info.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_triangles(
    result: *const fairmesh_result,
    out: *const fairmesh_indices_out,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, spans| {
        let out = TrianglesOut::new(out, Argument(2))?;
        spans.output(out.0.data, out.0.bytes, Argument(2))?;
        spans.error(error, Argument(3))?;
        let triangles = content.triangles()?;
        check_count(
            out.0.count,
            triangles.len(),
            Argument(2).field(size_of::<usize>()),
        )?;
        triangles.iter().enumerate().for_each(|(k, t)| out.set(k, *t));
        Ok(())
    })
}

/// Numbers per vertex, `which` being a `fairmesh_scalars`: `vertex_count` of the info.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_scalars(
    result: *const fairmesh_result,
    which: u32,
    out: *const fairmesh_scalars_out,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, spans| {
        let out = NumbersOut::scalars(out, Argument(3))?;
        spans.output(out.array.data, out.array.bytes, Argument(3))?;
        spans.error(error, Argument(4))?;
        let (values, vertices) = content.scalars(which)?;
        put_scalars(&out, values, vertices, Argument(3))
    })
}

/// Vectors, `which` being a `fairmesh_vectors`: as many as the list that they belong to has vertices.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_vectors(
    result: *const fairmesh_result,
    which: u32,
    out: *const fairmesh_points_out,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, spans| {
        let out = NumbersOut::points(out, Argument(3))?;
        spans.output(out.array.data, out.array.bytes, Argument(3))?;
        spans.error(error, Argument(4))?;
        let (count, vector) = content.vectors(which)?;
        out.check_count(count, Argument(3))?;
        (0..count).for_each(|k| out.set(k, vector(k)));
        Ok(())
    })
}

/// A list of indices, `which` being a `fairmesh_list`, of the report or loop with this index (0 where there is one). `size` gets
/// its size. With `out` NULL and `capacity` 0 that is all; otherwise BUFFER_TOO_SMALL if it does not fit into `capacity`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_list(
    result: *const fairmesh_result,
    which: u32,
    index: u64,
    out: *mut u32,
    capacity: usize,
    size: *mut usize,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, spans| {
        let out = list_out(out, capacity)?;
        check_pointer(size, Argument(6))?;
        spans.output(out.data, out.bytes, Argument(4))?;
        spans.output(size.cast(), size_of::<usize>(), Argument(6))?;
        spans.error(error, Argument(7))?;
        let (count, entry) = content.list(which, index)?;
        if !out.data.is_null() && count > capacity {
            write(size, count);
            let why = format_args!("there is room for {capacity}, but there are {count}");
            return Err(Argument(5).itself().refuse(Status::BufferTooSmall, why));
        }
        if !out.data.is_null() {
            (0..count).for_each(|k| put_index(&out, k, entry(k)));
        }
        write(size, count);
        Ok(())
    })
}

/// Frees a result. NULL is allowed.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_free(result: *mut fairmesh_result) -> fairmesh_status {
    guarded(core::ptr::null_mut(), || {
        if !result.is_null() {
            handles::get::<_, Content>(result, Argument(1))?;
            handles::remove(result);
        }
        Ok(())
    })
}

/// Runs what reads a result.
fn read_result(
    result: *const fairmesh_result,
    error: *mut fairmesh_error,
    body: impl FnOnce(&Content, &mut Spans) -> Outcome,
) -> fairmesh_status {
    guarded(error, || {
        let content = handles::get::<_, Content>(result, Argument(1))?;
        let _reserve = need::reserve(need::STANDING)?;
        point();
        body(&content, &mut Spans::new())
    })
}
