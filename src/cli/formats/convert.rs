//! A mesh in another format.

use super::format::Format;
use super::mesh_file::{MeshFile, plain};

impl MeshFile {
    /// The bytes in this format: those of the file, or in another one its vertices and faces and nothing else.
    pub fn in_format(&self, format: Format) -> Vec<u8> {
        match self.format() == format {
            true => self.bytes.clone(),
            false => plain(format, &self.geometry.positions, &self.geometry.polygons()),
        }
    }
}
