//! Faces that do not face the same way: told, and turned.

use std::path::Path;

use fairmesh::{Coincident, inconsistent_edges, triangles_to_turn};
use serde_json::{Value, json};

use crate::explain;
use crate::failure::Failure;
use crate::formats::{Geometry, MeshFile};
use crate::surface::MeshArgs;

/// What there is to say of the faces' orientation.
pub struct Orientation {
    /// A line, or nothing.
    pub text: String,
    pub json: Value,
}

/// The mesh with faces turned around, if that is asked for, and how many.
pub fn oriented(name: &Path, mesh: MeshFile, args: &MeshArgs) -> Result<(MeshFile, usize), Failure> {
    if !args.orient {
        return Ok((mesh, 0));
    }
    let geometry = &mesh.geometry;
    let turned = triangles_to_turn(&geometry.positions, &geometry.triangles, args.coincident)
        .map_err(|error| explain::refusal(name, &mesh, &error))?;
    let mut is_turned = vec![false; geometry.triangles.len()];
    turned.iter().for_each(|&t| is_turned[t as usize] = true);
    let mut polygons = vec![false; geometry.polygon_count];
    turned
        .iter()
        .for_each(|&t| polygons[geometry.polygon_of(t as usize)] = true);
    let is_torn = |t: &usize| polygons[geometry.polygon_of(*t)] != is_turned[*t];
    if let Some(t) = (0..is_turned.len()).find(is_torn) {
        return Err(Failure::new(format!(
            "{}: face {} would have to be turned in part: it is folded onto another one; remove or repair it",
            name.display(),
            geometry.polygon_of(t)
        )));
    }
    let count = polygons.iter().filter(|&&is_turned| is_turned).count();
    match count {
        0 => Ok((mesh, 0)),
        _ => Ok((mesh.with_turned(&name.display().to_string(), &polygons)?, count)),
    }
}

/// How many faces were turned, as a line.
pub fn turned(count: usize) -> String {
    match count {
        0 => String::new(),
        1 => "1 face was turned around\n".to_owned(),
        n => format!("{n} faces were turned around\n"),
    }
}

/// How many faces were turned, and what is still inconsistent.
pub fn told(geometry: &Geometry, turned: usize, coincident: Coincident) -> Orientation {
    // What can be wrong was told by what came before.
    let edges = inconsistent_edges(&geometry.positions, &geometry.triangles, coincident).unwrap_or_default();
    let mut text = self::turned(turned);
    let mut example = Value::Null;
    if let Some(edge) = edges.first() {
        let [a, b] = edge.vertices;
        let [f, g] = edge.triangles.map(|t| geometry.polygon_of(t as usize));
        let count = edges.len();
        text += &format!(
            "faces are oriented inconsistently, at {count} {}, as faces {f} and {g} at edge ({a}, {b}): --orient turns as few as possible\n",
            if count == 1 { "edge" } else { "edges" }
        );
        example = json!({ "edge": edge.vertices, "faces": [f, g] });
    }
    Orientation {
        text,
        json: json!({ "turned_faces": turned, "inconsistent_edges": edges.len(), "example": example }),
    }
}
