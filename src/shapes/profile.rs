//! A generating curve of a surface of revolution.

/// A point (r, z) of a profile curve with first and second derivative by its parameter.
#[derive(Clone, Copy)]
pub(super) struct Profile {
    pub(super) at: [f64; 2],
    pub(super) slope: [f64; 2],
    pub(super) bend: [f64; 2],
}
