//! What every exported function runs in: no panic gets out, memory that runs out is told, the error detail is written last.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::memory;
use super::status::{CallResult, Failure, fairmesh_error, fairmesh_status};
use super::views::{Call, aligned};

/// Runs an exported function.
pub(crate) fn guarded(
    error: *mut fairmesh_error,
    body: impl FnOnce(&mut Call) -> CallResult,
) -> fairmesh_status {
    let mut body = Some(body);
    run(error, &mut |call| body.take().map_or(Ok(()), |body| body(call)))
}

/// The same, compiled once for all of them.
fn run(error: *mut fairmesh_error, body: &mut dyn FnMut(&mut Call) -> CallResult) -> fairmesh_status {
    // Without it there is no place to say more than the status.
    if !aligned(error, align_of::<fairmesh_error>()) {
        return fairmesh_status::Misaligned;
    }
    let failures = memory::failures();
    let mut call = Call::new(error);
    let mut result = caught(|| body(&mut call)).unwrap_or_else(Err);
    if let Err(failure) = &result
        && failure.status == fairmesh_status::Threads
        && memory::failures() != failures
    {
        result = Err(Failure::out_of_memory());
    }
    if result.is_err() && call.error_is_read() {
        return fairmesh_status::Aliasing;
    }
    let said = match &result {
        Ok(()) => Failure::new(fairmesh_status::Ok, format_args!("")),
        Err(failure) => *failure,
    };
    if !error.is_null() && !said.silent {
        super::views::write(error, said.detail());
    }
    said.status
}

/// Where a test lets a call panic: after its handle was taken, before its work.
pub(crate) fn point() {
    #[cfg(feature = "hooks")]
    super::hooks::panic_if_asked();
}

/// What a panic says.
pub(crate) fn words(payload: &(dyn Any + Send)) -> &str {
    payload
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| payload.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("a panic without words")
}

/// Catches a panic, and what dropping its payload may cause.
fn caught<T>(work: impl FnOnce() -> T) -> Result<T, Failure> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|payload| {
        let failure = Failure::new(
            fairmesh_status::Internal,
            format_args!("a bug of fairmesh, please report it: {}", words(&*payload)),
        );
        let _ = catch_unwind(AssertUnwindSafe(|| drop(payload)));
        failure
    })
}
