//! Linear algebra that knows no mesh.

pub mod anderson;
pub mod cholesky;
mod elimination;
mod front;
pub mod interrupt;
pub mod ordering;
pub mod sparse;
mod supernodes;
pub mod symbolic;

pub use front::Real;
