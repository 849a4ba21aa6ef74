//! The default solver.
