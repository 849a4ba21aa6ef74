//! Mesh files: what each format says, and how it is changed.

mod added;
pub mod carry;
mod change;
pub mod colours;
mod convert;
mod format;
mod geometry;
pub mod image;
mod labels;
mod mark;
mod mesh_file;
pub mod obj;
pub mod off;
pub mod packed;
pub mod patches;
pub mod pipe_args;
pub mod pipes;
pub mod ply;
pub mod references;
pub mod stl;
#[cfg(test)]
mod tests;
pub mod textures;
mod turned;

pub use added::{Added, Mark};
pub use format::Format;
pub use geometry::{Geometry, Kind};
pub use mesh_file::{MeshFile, Written, plain};
