//! How textures lie on a PLY file's triangles.

use super::Ply;
use crate::formats::carry::Corners;
use crate::formats::geometry::{Geometry, Kind};

/// What programs call the texture coordinates of vertices.
const NAMES: [[&str; 2]; 4] = [
    ["texture_u", "texture_v"],
    ["u", "v"],
    ["s", "t"],
    ["texcoord_u", "texcoord_v"],
];

impl Ply {
    /// Per triangle the texture coordinates of its corners: those of the faces, or else of the vertices.
    pub fn texture_corners(&self, bytes: &[u8], geometry: &Geometry) -> Vec<Option<Corners>> {
        let of_faces = self.corners(bytes);
        if of_faces.iter().any(Option::is_some) {
            return of_faces;
        }
        let column = |name: &str| Some(self.numbers(bytes, Kind::Vertex, name)?.0);
        let found = NAMES.iter().find_map(|[u, v]| Some([column(u)?, column(v)?]));
        let corner = |[u, v]: &[Vec<f64>; 2], at: u32| [u[at as usize], v[at as usize]];
        let of = |t: &[u32; 3]| found.as_ref().map(|columns| t.map(|at| corner(columns, at)));
        geometry.triangles.iter().map(of).collect()
    }

    /// Per triangle which of the textures it has; the first one if the file does not say.
    pub fn texture_numbers(&self, bytes: &[u8], geometry: &Geometry) -> Vec<Option<u32>> {
        let numbers = self.numbers(bytes, Kind::Face, "texnumber");
        let of = |t: usize| match &numbers {
            None => Some(0),
            Some((values, _)) => {
                let value = values.get(geometry.polygon_of(t))?;
                (*value >= 0.0).then_some(*value as u32)
            }
        };
        (0..geometry.triangles.len()).map(of).collect()
    }
}
