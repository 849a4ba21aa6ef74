//! Linear algebra that knows no mesh.

pub mod anderson;
pub mod cholesky;
pub mod ordering;
pub mod sparse;
pub mod symbolic;
