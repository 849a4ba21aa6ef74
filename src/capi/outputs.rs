//! What several functions write, and how a result becomes a handle.

use std::sync::Arc;

use super::callback::HostCallback;
use super::guard::point;
use super::handles;
use super::input::MeshIn;
use super::memory_bounds;
use super::results::Content;
use super::status::{CallResult, fairmesh_error};
use super::types::{fairmesh_mesh, fairmesh_result};
use super::views::{AliasCheck, Argument, NumbersOut, check_slot, write};
use fairmesh::Coincident;

/// Makes a result, unless memory has run out.
pub(crate) fn publish(
    content: Arc<Content>,
    result: *mut *mut fairmesh_result,
    callback: &HostCallback,
) -> CallResult {
    let handle = handles::add::<fairmesh_result, _>(content);
    if let Err(failure) = callback.memory() {
        handles::remove(handle);
        return Err(failure);
    }
    write(result, handle);
    Ok(())
}

/// A result that is found by one look at a whole mesh, arguments 1 to 3 of a function.
pub(crate) fn of_whole_mesh(
    mesh: *const fairmesh_mesh,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
    find: impl FnOnce(&[[f64; 3]], &[[u32; 3]], Coincident) -> CallResult<Content>,
) -> CallResult {
    let mut aliases = AliasCheck::new();
    let mesh = MeshIn::new(mesh, Argument(1), &mut aliases)?;
    check_slot(result, Argument(2), &mut aliases)?;
    aliases.error(error, Argument(3))?;
    let positions = mesh.positions.read()?;
    let triangles = mesh.triangles.rows::<3>()?;
    let _reserve = memory_bounds::reserve(memory_bounds::of_whole_mesh(&mesh, 1))?;
    let callback = HostCallback::new(None, core::ptr::null_mut());
    point();
    let found = find(&positions, &triangles, mesh.coincident)?;
    publish(Arc::new(found), result, &callback)
}

pub(crate) fn put_positions(out: &NumbersOut<3>, positions: &[[f64; 3]], argument: Argument) -> CallResult {
    out.check_count(positions.len(), argument)?;
    out.check_range(positions.iter().copied().enumerate())?;
    positions.iter().enumerate().for_each(|(v, p)| out.set(v, *p));
    Ok(())
}

pub(crate) fn put_scalars(
    out: &NumbersOut<1>,
    values: &[(u32, f64)],
    vertices: usize,
    argument: Argument,
) -> CallResult {
    out.check_count(vertices, argument)?;
    out.check_range(values.iter().map(|(v, x)| (*v as usize, [*x])))?;
    (0..vertices).for_each(|v| out.set(v, [f64::NAN]));
    values.iter().for_each(|(v, x)| out.set(*v as usize, [*x]));
    Ok(())
}
