//! Linear algebra that knows no mesh.

#[cfg(test)]
#[macro_use]
#[path = "../../tests/common/asserts.rs"]
mod asserts;

pub mod anderson;
pub mod cholesky;
pub mod dispatch;
mod elimination;
mod front;
pub mod interrupt;
mod minimum_degree;
pub mod ordering;
pub mod parallel;
mod real;
pub mod sparse;
mod substitution;
mod supernodes;
pub mod symbolic;
mod tile;
mod traversal;

pub use real::Real;
