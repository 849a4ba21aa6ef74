//! What is read out of results.

use super::guard::{guarded, point};
use super::handles;
use super::memory_bounds;
use super::outputs::*;
use super::report;
use super::results::Content;
use super::status::*;
use super::types::*;
use super::views::*;

use fairmesh_status as Status;

/// The sizes of a result.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_info(
    result: *const fairmesh_result,
    info: *mut fairmesh_info,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, aliases| {
        let out = StructOut::new(info, Argument(2), aliases)?;
        aliases.error(error, Argument(3))?;
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
    read_result(result, error, |content, aliases| {
        let out = StructOut::new(report, Argument(3), aliases)?;
        aliases.error(error, Argument(4))?;
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
    read_result(result, error, |content, aliases| {
        let out = StructOut::new(level, Argument(3), aliases)?;
        aliases.error(error, Argument(4))?;
        out.write(&content.level(index)?);
        Ok(())
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
    read_result(result, error, |content, aliases| {
        let out = StructOut::new(component, Argument(4), aliases)?;
        aliases.error(error, Argument(5))?;
        out.write(&content.component(index, number)?);
        Ok(())
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
    read_result(result, error, |content, aliases| {
        let out = StructOut::new(attempt, Argument(5), aliases)?;
        aliases.error(error, Argument(6))?;
        out.write(&content.attempt(index, component, number)?);
        Ok(())
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
    read_result(result, error, |content, aliases| {
        let out = StructOut::new(continuity, Argument(5), aliases)?;
        aliases.error(error, Argument(6))?;
        out.write(&content.continuity(index, component, number)?);
        Ok(())
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
    read_result(result, error, |content, aliases| {
        let out = StructOut::new(boundary_loop, Argument(3), aliases)?;
        aliases.error(error, Argument(4))?;
        out.write(&content.boundary_loop(index)?);
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
    read_result(result, error, |content, aliases| {
        let out = StructOut::new(report, Argument(3), aliases)?;
        aliases.error(error, Argument(4))?;
        out.write(&content.filled_loop(index)?);
        Ok(())
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
    read_result(result, error, |content, aliases| {
        let out = StructOut::new(suggestion, Argument(3), aliases)?;
        aliases.error(error, Argument(4))?;
        out.write(&content.suggestion(index)?);
        Ok(())
    })
}

/// What became of a bridge; its strip's report is that of `fairmesh_result_fill_report` with index 0.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_result_bridge(
    result: *const fairmesh_result,
    report: *mut fairmesh_bridge_report,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    read_result(result, error, |content, aliases| {
        let out = StructOut::new(report, Argument(2), aliases)?;
        aliases.error(error, Argument(3))?;
        out.write(&content.bridge()?);
        Ok(())
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
    read_result(result, error, |content, aliases| {
        let out = StructOut::new(bump, Argument(3), aliases)?;
        aliases.error(error, Argument(4))?;
        out.write(&content.bump(index)?);
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
    read_result(result, error, |content, aliases| {
        let out = NumbersOut::points(out, Argument(2))?;
        aliases.output(out.array.data, out.array.bytes, Argument(2))?;
        aliases.error(error, Argument(3))?;
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
    read_result(result, error, |content, aliases| {
        let out = TrianglesOut::new(out, Argument(2))?;
        aliases.output(out.0.data, out.0.bytes, Argument(2))?;
        aliases.error(error, Argument(3))?;
        let triangles = content.triangles()?;
        check_count(
            out.0.count,
            triangles.len(),
            Argument(2).field(size_of::<usize>(), "count"),
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
    read_result(result, error, |content, aliases| {
        let out = NumbersOut::scalars(out, Argument(3))?;
        aliases.output(out.array.data, out.array.bytes, Argument(3))?;
        aliases.error(error, Argument(4))?;
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
    read_result(result, error, |content, aliases| {
        let out = NumbersOut::points(out, Argument(3))?;
        aliases.output(out.array.data, out.array.bytes, Argument(3))?;
        aliases.error(error, Argument(4))?;
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
    read_result(result, error, |content, aliases| {
        let out = list_out(out, capacity)?;
        check_pointer(size, Argument(6))?;
        aliases.output(out.data, out.bytes, Argument(4))?;
        aliases.output(size.cast(), size_of::<usize>(), Argument(6))?;
        aliases.error(error, Argument(7))?;
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
    body: impl FnOnce(&Content, &mut AliasCheck) -> CallResult,
) -> fairmesh_status {
    guarded(error, || {
        let content = handles::get::<_, Content>(result, Argument(1))?;
        let _reserve = memory_bounds::reserve(memory_bounds::STANDING)?;
        point();
        body(&content, &mut AliasCheck::new())
    })
}
