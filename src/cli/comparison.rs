//! What a command changed in a mesh, as picture and report.

mod changes;
mod flags;
mod histogram;
mod markup;
mod page;
mod sheet;
pub mod story;
mod surface;

pub use flags::PictureArgs;
pub use page::Story;
pub use surface::MeshSide;
