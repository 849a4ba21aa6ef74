//! What several functions write, and how a result becomes a handle.

use std::sync::Arc;

use super::callback::HostCallback;
use super::handles;
use super::results::Content;
use super::status::CallResult;
use super::types::fairmesh_result;
use super::views::{Argument, NumbersOut, write};

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
