//! symbolic.
