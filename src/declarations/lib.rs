//! What other languages repeat of the C interface, made of `src/capi` and of the library's tables.

pub mod numbers;
pub mod options;
pub mod python;
pub mod python_options;
pub mod python_records;
pub mod records;
pub mod source;
pub mod tables;
pub mod web;
