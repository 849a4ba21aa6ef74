//! New faces marked in a file.

use super::format::Format;
use super::mesh_file::{MeshFile, Places};
use super::patches::Patches;
use crate::failure::Failure;

impl MeshFile {
    /// The mesh as a file of this format in which new faces can be marked. In another format than its own only its vertices and faces are left.
    ///
    /// # Errors
    /// A format that has no marks; a property that is no number.
    pub fn markable(self, file: &str, format: Format, name: &str) -> Result<Self, Failure> {
        if !matches!(format, Format::Ply | Format::Obj) {
            return Err(Failure::new(format!(
                "{file}: --mark needs an output in PLY or OBJ; {} has no place for it",
                format.name()
            )));
        }
        let own = self.format() == format;
        let mesh = match own {
            true => self,
            false => Self::parse(file, format, self.in_format(format))?,
        };
        let Places::Ply(places) = &mesh.places else {
            return Ok(mesh);
        };
        if !places.can_mark(name) {
            return Err(Failure::new(format!(
                "{file}: the faces' property '{name}' is a list, which cannot mark them: --mark needs another name"
            )));
        }
        let mut patches = Patches::default();
        places.declare(&mesh.bytes, name, &mut patches);
        Self::parse(file, format, patches.apply(&mesh.bytes))
    }
}
