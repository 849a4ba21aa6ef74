//! OpenMesh 9 as far as fairmesh compares itself with its smoother: triangle meshes of floats or doubles, files, status,
//! normals, and `JacobiLaplaceSmootherT`. [`openmesh`] is the safe layer; [`ffi`] is what bindgen makes of the C shim.

/// The C shim, `shim/shim.h`.
#[allow(missing_docs, non_camel_case_types, non_upper_case_globals, reason = "made by bindgen")]
#[rustfmt::skip]
#[path = "bindings.rs"]
pub mod ffi;
pub mod openmesh;
