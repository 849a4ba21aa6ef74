//! What is read out of results.

use super::guard::{guarded, point};
use super::handles;
use super::memory_bounds;
use super::memory_use::Bytes;
use super::outputs::*;
use super::report;
use super::results::{
    Content, attempt_of, component_of, continuity_of, crease_end_of, entry, not_available, sharp_edge_of,
};
use super::status::*;
use super::types::*;
use super::views::*;

/// The sizes of a result.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_info(
    result: *const fairmesh_result,
    info: *mut fairmesh_info,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, call| {
        put_record(info, Argument(2), call, || Ok(content.info))
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
    read_result(result, error, |content, call| {
        put_record(report, Argument(3), call, || {
            Ok(report::report(content.report(index)?))
        })
    })
}

/// One component of the region, by its number: they are sorted by their smallest free vertices, and the report with this `index`
/// has `component_count` of them.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_component(
    result: *const fairmesh_result,
    index: u64,
    number: u64,
    component: *mut fairmesh_component,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, call| {
        put_record(component, Argument(4), call, || {
            component_of(content.report(index)?, number)
        })
    })
}

/// One attempt at the surface of a component, by its number, in the order in which they were made: the component has `attempt_count`
/// of them. `index` and `component` are those of `fairmesh_result_component`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_attempt(
    result: *const fairmesh_result,
    index: u64,
    component: u64,
    number: u64,
    attempt: *mut fairmesh_attempt,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, call| {
        put_record(attempt, Argument(5), call, || {
            attempt_of(content.report(index)?, component, number)
        })
    })
}

/// How far the surface continues the curvature of its surroundings along one boundary loop of a component, by its number: the
/// component has `continuity_count` of them. `index` and `component` are those of `fairmesh_result_component`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_continuity(
    result: *const fairmesh_result,
    index: u64,
    component: u64,
    number: u64,
    continuity: *mut fairmesh_continuity,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, call| {
        put_record(continuity, Argument(5), call, || {
            continuity_of(content.report(index)?, component, number)
        })
    })
}

/// What became of one of the sharp edges that reach the boundary, by its number: the report with this `index` has
/// `sharp_edge_count` of them.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_sharp_edge(
    result: *const fairmesh_result,
    index: u64,
    number: u64,
    edge: *mut fairmesh_sharp_edge,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, call| {
        put_record(edge, Argument(4), call, || {
            sharp_edge_of(content.report(index)?, number)
        })
    })
}

/// Where a sharp edge arrives at the boundary, by the number of this end: the edge has `end_count` of them. `index` and `edge` are
/// those of `fairmesh_result_sharp_edge`.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_crease_end(
    result: *const fairmesh_result,
    index: u64,
    edge: u64,
    number: u64,
    end: *mut fairmesh_crease_end,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, call| {
        put_record(end, Argument(5), call, || {
            crease_end_of(content.report(index)?, edge, number)
        })
    })
}

/// One of the boundary loops.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_loop(
    result: *const fairmesh_result,
    index: u64,
    boundary_loop: *mut fairmesh_loop,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, call| {
        put_record(boundary_loop, Argument(3), call, || {
            entry(&content.loops, index, "boundary loop").copied()
        })
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
    read_result(result, error, |content, call| {
        put_record(report, Argument(3), call, || {
            entry(&content.fill_reports, index, "filled loop").copied()
        })
    })
}

/// One of the groups of loops that would be joined.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_suggestion(
    result: *const fairmesh_result,
    index: u64,
    suggestion: *mut fairmesh_join_suggestion,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, call| {
        put_record(suggestion, Argument(3), call, || {
            entry(&content.suggestions, index, "group of loops").copied()
        })
    })
}

/// What became of a bridge; its strip's report is that of `fairmesh_result_fill_report` with index 0.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_bridge(
    result: *const fairmesh_result,
    report: *mut fairmesh_bridge_report,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, call| {
        put_record(report, Argument(2), call, || {
            content.bridge.ok_or_else(|| not_available("bridge"))
        })
    })
}

/// A crease of a mesh that was rounded, by its number, and what became of it: `crease_count` of the info.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_crease(
    result: *const fairmesh_result,
    index: u64,
    crease: *mut fairmesh_crease,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, call| {
        put_record(crease, Argument(3), call, || {
            entry(&content.creases, index, "crease").copied()
        })
    })
}

/// What was taken for a bump, by its number: one for each step BUMP of `fairmesh_select_region`, in their order.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_bump(
    result: *const fairmesh_result,
    index: u64,
    bump: *mut fairmesh_bump,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, call| {
        put_record(bump, Argument(3), call, || {
            entry(&content.bumps, index, "bump").copied()
        })
    })
}

/// The positions of all vertices: `vertex_count` of the info.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_positions(
    result: *const fairmesh_result,
    out: *const fairmesh_points_out,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, call| {
        let out = Points::points_out(&call.read(out, Argument(2))?, Argument(2).start())?;
        let out = last(out, Argument(2), call)?;
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
    read_result(result, error, |content, call| {
        let view = call.read(out, Argument(2))?;
        let out = triangles_out(&view, Argument(2))?;
        call.output(out.memory(), Argument(2))?;
        call.end(Argument(3))?;
        let triangles = content.triangles.as_deref();
        let triangles = triangles.ok_or_else(|| not_available("triangles: they are those given"))?;
        let place = field!(Argument(2), fairmesh_indices_out.count);
        check_count(out.count, triangles.len(), place)?;
        triangles.iter().enumerate().for_each(|(k, t)| out.put(k, *t));
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
    read_result(result, error, |content, call| {
        let out = Numbers::scalars_out(&call.read(out, Argument(3))?, Argument(3).start())?;
        let out = last(out, Argument(3), call)?;
        let vertices = content.info.vertex_count as usize;
        put_scalars(&out, content.scalars(which)?, vertices, Argument(3))
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
    read_result(result, error, |content, call| {
        let out = Points::points_out(&call.read(out, Argument(3))?, Argument(3).start())?;
        let out = last(out, Argument(3), call)?;
        put_positions(&out, content.vectors(which)?, Argument(3))
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
    read_result(result, error, |content, call| {
        let out = list_out(out, capacity)?;
        check_pointer(size, Argument(6))?;
        call.output(out.memory(), Argument(4))?;
        call.output(Bytes::block(size, size_of::<usize>()), Argument(6))?;
        call.end(Argument(7))?;
        let list = content.list(which, index)?;
        let count = list.len();
        write(size, count);
        if out.data.is_null() {
            return Ok(());
        }
        if count > capacity {
            return Err(
                refuse!(Argument(5).itself() => BufferTooSmall, "there is room for {capacity}, but there are {count}"),
            );
        }
        list.iter().enumerate().for_each(|(k, i)| out.put(k, [*i]));
        Ok(())
    })
}

/// Frees a result. NULL is allowed.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_free(result: *mut fairmesh_result) -> fairmesh_status {
    guarded(core::ptr::null_mut(), |_| {
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
    body: impl FnOnce(&Content, &mut Call) -> CallResult,
) -> fairmesh_status {
    guarded(error, |call| {
        let content = handles::get::<_, Content>(result, Argument(1))?;
        let _reserve = memory_bounds::reserve(memory_bounds::STANDING)?;
        point();
        body(&content, call)
    })
}
