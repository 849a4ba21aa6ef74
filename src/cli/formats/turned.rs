//! A mesh file with some of its faces turned around.

use super::mesh_file::{MeshFile, Places};
use super::obj;
use super::patches::Patches;
use crate::failure::Failure;

impl MeshFile {
    /// The file with the corners of some of its polygons in reverse order, and what belongs to these corners; of STL the facets' normals are turned,
    /// too. All else stays, vertices with their numbers, too.
    ///
    /// # Errors
    /// None that reading the file did not have.
    pub fn with_turned(&self, name: &str, is_turned: &[bool]) -> Result<Self, Failure> {
        let mut patches = Patches::default();
        match &self.places {
            Places::Ply(places) => places.turn(&self.bytes, is_turned, &mut patches),
            Places::Obj(_) => obj::turn(&self.bytes, is_turned, &mut patches),
            Places::Off(places) => places.turn(&self.bytes, is_turned, &mut patches),
            Places::Stl(places) => places.turn(&self.bytes, is_turned, &mut patches),
        }
        let mut turned = Self::parse(name, self.format(), patches.apply(&self.bytes))?;
        // Vertices of STL are numbered as they come.
        if matches!(self.places, Places::Stl(_)) {
            turned.geometry = self.geometry.clone();
            let triangles = turned.geometry.triangles.iter_mut().zip(is_turned);
            triangles
                .filter(|(_, is_turned)| **is_turned)
                .for_each(|(t, _)| t.swap(1, 2));
        }
        Ok(turned)
    }
}
