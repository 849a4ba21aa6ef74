//! What every room uses: errors, names and texts of enumerations, lists by number, clocks.

pub(crate) mod entries;
pub(crate) mod error;
pub(crate) mod options;
pub(crate) mod profile;
pub(crate) mod stopwatch;
pub(crate) mod table;
