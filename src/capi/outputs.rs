//! How a call works with memory set aside, and writes what it has found.

use std::sync::Arc;

use super::callback::HostCallback;
use super::guard::point;
use super::handles;
use super::input::MeshIn;
use super::memory_bounds;
use super::results::Content;
use super::status::CallResult;
use super::structs::Versioned;
use super::types::{fairmesh_mesh, fairmesh_result};
use super::views::{Argument, Call, Numbers, Points, StructOut, check_slot, write};
use fairmesh::{Coincident, ProgressCallback};

/// Works with so much memory set aside. That it has run out is told before all else.
pub(crate) fn with_memory<T>(
    bytes: u64,
    callback: &HostCallback,
    work: impl FnOnce(&HostCallback) -> CallResult<T>,
) -> CallResult<T> {
    let _reserve = memory_bounds::reserve(bytes)?;
    let watch = callback.fresh();
    point();
    let made = work(&watch);
    watch.memory()?;
    made
}

/// Makes a handle, unless memory has run out.
pub(crate) fn publish<H, T: Send + Sync + 'static>(
    thing: Arc<T>,
    slot: *mut *mut H,
    watch: &HostCallback,
) -> CallResult {
    let handle = handles::add(thing);
    if let Err(failure) = watch.memory() {
        handles::remove(handle);
        return Err(failure);
    }
    write(slot, handle);
    Ok(())
}

/// Where the handle of a result goes.
pub(crate) struct ResultOut(*mut *mut fairmesh_result);

impl ResultOut {
    /// The last argument but the error detail.
    pub(crate) fn last(
        slot: *mut *mut fairmesh_result,
        argument: Argument,
        call: &mut Call,
    ) -> CallResult<Self> {
        check_slot(slot, argument, call)?;
        call.end(argument.next())?;
        Ok(Self(slot))
    }

    /// Makes a result of what is found with so much memory set aside.
    pub(crate) fn put(
        &self,
        bytes: u64,
        callback: &HostCallback,
        find: impl FnOnce(&mut ProgressCallback<'_>) -> CallResult<Content>,
    ) -> CallResult {
        with_memory(bytes, callback, |watch| {
            let found = find(&mut |progress| watch.tell(progress));
            watch.memory()?;
            publish(Arc::new(found?), self.0, watch)
        })
    }
}

/// A result that is found by one look at a whole mesh, arguments 1 to 3 of a function.
pub(crate) fn of_whole_mesh(
    mesh: *const fairmesh_mesh,
    result: *mut *mut fairmesh_result,
    call: &mut Call,
    find: impl FnOnce(&[[f64; 3]], &[[u32; 3]], Coincident) -> CallResult<Content>,
) -> CallResult {
    let mesh = MeshIn::new(mesh, Argument(1), call)?;
    let result = ResultOut::last(result, Argument(2), call)?;
    let (positions, triangles) = mesh.read()?;
    let bytes = memory_bounds::of_whole_mesh(&mesh, 1);
    result.put(bytes, &HostCallback::none(), |_| {
        find(&positions, &triangles, mesh.coincident)
    })
}

/// Writes a struct of any version, the last argument but the error detail.
pub(crate) fn put_record<T: Versioned>(
    record: *mut T,
    argument: Argument,
    call: &mut Call,
    find: impl FnOnce() -> CallResult<T>,
) -> CallResult {
    let out = StructOut::new(record, argument, call)?;
    call.end(argument.next())?;
    out.write(&find()?);
    Ok(())
}

/// Numbers to be written, the last argument but the error detail.
pub(crate) fn last<const N: usize>(
    out: Numbers<N>,
    argument: Argument,
    call: &mut Call,
) -> CallResult<Numbers<N>> {
    call.output(out.array.memory(), argument)?;
    call.end(argument.next())?;
    Ok(out)
}

pub(crate) fn put_positions(out: &Points, positions: &[[f64; 3]], argument: Argument) -> CallResult {
    out.check_count(positions.len(), argument)?;
    out.check_range(positions.iter().copied().enumerate())?;
    positions.iter().enumerate().for_each(|(v, p)| out.set(v, *p));
    Ok(())
}

pub(crate) fn put_scalars(
    out: &Numbers<1>,
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
