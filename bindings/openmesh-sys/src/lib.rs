//! OpenMesh 9 as far as fairmesh compares itself with its smoother: what bindgen makes of the C shim, `shim/shim.h`.
#![allow(missing_docs, non_camel_case_types, reason = "made by bindgen")]

#[rustfmt::skip]
mod bindings;
pub use bindings::*;
