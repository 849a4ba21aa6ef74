//! anderson.
