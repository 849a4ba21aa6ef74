//! The colours that a file has per vertex or face.

use super::geometry::Kind;
use super::mesh_file::{MeshFile, Places};
use super::obj;

/// Colours, from 0 to 255 per channel.
pub struct Colours {
    pub kind: Kind,
    pub values: Vec<[f64; 3]>,
}

impl MeshFile {
    /// The colours of the vertices, or if these have none, of the faces: of PLY (red, green, blue), OBJ (behind the coordinates) and
    /// OFF (COFF).
    pub fn colours(&self) -> Option<Colours> {
        match &self.places {
            Places::Ply(_) => [Kind::Vertex, Kind::Face].into_iter().find_map(|kind| {
                let channels = ["red", "green", "blue"].map(|name| self.channel(kind, name));
                let [Some(red), Some(green), Some(blue)] = channels else {
                    return None;
                };
                let values = (0..red.len()).map(|i| [red[i], green[i], blue[i]]).collect();
                Some(Colours { kind, values })
            }),
            Places::Obj(places) => places.colours(&self.bytes).map(|values| Colours {
                kind: Kind::Vertex,
                values,
            }),
            Places::Off(places) => places.colours(&self.bytes).map(|values| Colours {
                kind: Kind::Vertex,
                values,
            }),
            Places::Stl(_) => None,
        }
    }

    /// One channel of a PLY file.
    fn channel(&self, kind: Kind, name: &str) -> Option<Vec<f64>> {
        let (places, bytes) = self.as_ply()?;
        let (mut values, is_float) = places.numbers(bytes, kind, name)?;
        if is_float {
            values.iter_mut().for_each(|value| *value *= obj::FULL);
        }
        Some(values)
    }
}
