//! Linear algebra that knows no mesh.

pub mod anderson;
pub mod cholesky;
mod front;
pub mod ordering;
pub mod sparse;
pub mod symbolic;

pub use front::Real;
