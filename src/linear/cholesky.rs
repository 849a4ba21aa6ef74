//! cholesky.
