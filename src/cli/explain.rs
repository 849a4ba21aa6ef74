//! Refusals and outcomes in words, in the numbering of the user's file.

use std::path::Path;

use fairmesh::{Error, Outcome, Report};

use crate::failure::Failure;
use crate::formats::{Geometry, MeshFile};

/// The library's refusal with polygons instead of triangles, where it is, and what to do.
pub fn refusal(path: &Path, mesh: &MeshFile, error: &Error) -> Failure {
    let geometry = &mesh.geometry;
    let message = in_polygons(error, geometry).to_string();
    let place = vertex_of(error)
        .and_then(|v| Some((v, geometry.positions.get(v)?)))
        .map_or(String::new(), |(v, [x, y, z])| {
            format!(" (vertex {v} is at {x} {y} {z})")
        });
    let remedy = remedy(error).map_or(String::new(), |remedy| format!("; {remedy}"));
    Failure::new(format!("{}: {message}{place}{remedy}", path.display()))
}

/// Triangles of a file of polygons are numbered by polygon.
fn in_polygons(error: &Error, geometry: &Geometry) -> Error {
    let mut error = error.clone();
    match &mut error {
        Error::IndexOutOfRange { triangle, .. }
        | Error::RepeatedIndex { triangle, .. }
        | Error::NonManifoldEdge { triangle, .. } => *triangle = geometry.polygon_of(*triangle),
        Error::DuplicateTriangle { triangle, other }
        | Error::InconsistentOrientation { triangle, other, .. } => {
            *triangle = geometry.polygon_of(*triangle);
            *other = geometry.polygon_of(*other);
        }
        _ => {}
    }
    error
}

/// The vertex to look at.
fn vertex_of(error: &Error) -> Option<usize> {
    match *error {
        Error::NotFinite { vertex }
        | Error::RepeatedIndex { vertex, .. }
        | Error::NonManifoldVertex { vertex }
        | Error::FreeVertexOnBoundary { vertex }
        | Error::FreeVertexWithoutTriangle { vertex }
        | Error::NothingFixed { vertex }
        | Error::BadNormal { vertex }
        | Error::NoNormal { vertex } => Some(vertex),
        Error::NonManifoldEdge { a, .. } | Error::InconsistentOrientation { a, .. } => Some(a),
        _ => None,
    }
}

/// What to do, where the message does not say it itself.
fn remedy(error: &Error) -> Option<&'static str> {
    match error {
        Error::RepeatedIndex { .. } | Error::DuplicateTriangle { .. } => {
            Some("remove the degenerate faces first")
        }
        Error::NonManifoldEdge { .. } | Error::NonManifoldVertex { .. } => {
            Some("repair the mesh there or choose a region away from it")
        }
        Error::InconsistentOrientation { .. } => Some("re-orient all faces coherently first"),
        Error::NotFinite { .. } => Some("repair the vertex or choose a region away from it"),
        Error::FreeVertexWithoutTriangle { .. } => Some("leave it out of the selection"),
        Error::NothingFixed { .. } => Some("leave some of its vertices out of the selection"),
        Error::EmptyRegion => Some("select more faces: a vertex is free if all faces around it are selected"),
        _ => None,
    }
}

/// The outcome in one sentence.
pub fn outcome(report: &Report) -> String {
    match &report.outcome {
        Outcome::Converged => "converged: the surface is fair and sound".into(),
        Outcome::ConvergedPoorTriangles { triangles } => {
            format!(
                "converged, but {} triangles are flipped or have an angle below one degree",
                triangles.len()
            )
        }
        Outcome::ConvergedLoosely { reason } => format!("converged loosely: {}", reason.text()),
        Outcome::NormalsNotReachable { reached, vertices } => format!(
            "no surface with the boundary normals was found: {:.0} % of the way was reached, and the normals of {} \
             vertices stand farthest off",
            100.0 * reached,
            vertices.len()
        ),
        Outcome::TargetNotReachable { reached } => format!(
            "no surface with this --target was found, only one with {:.0} % of its right-hand side",
            100.0 * reached
        ),
        Outcome::NotConverged => "no sound surface was found".into(),
        Outcome::IterationLimit => "stopped at the iteration limit".into(),
        Outcome::Cancelled => "stopped on request".into(),
        other => other.name().replace('_', " "),
    }
}

/// What the user can do about the outcome; empty if there is nothing to do.
pub fn advice(report: &Report) -> &'static str {
    match &report.outcome {
        Outcome::Converged => "",
        Outcome::ConvergedPoorTriangles { .. } => {
            "look at these triangles; remeshing the region, or --inner-fairness uniform, usually cures them"
        }
        Outcome::ConvergedLoosely { .. } => {
            "the surface is usable; a better mesh of the region, or a larger --tolerance, usually cures it"
        }
        Outcome::NormalsNotReachable { .. } => {
            "check the normals of the vertices named (flipped? noise?); try --normals averaged or select more"
        }
        Outcome::TargetNotReachable { .. } => {
            "the file holds the linear surface; ask for a smaller constant, or a smaller region"
        }
        Outcome::NotConverged => {
            "the file holds the linear surface; select more, or remesh the region and try again"
        }
        Outcome::IterationLimit => {
            "run again with a larger --max-iterations (solver paper: --paper-max-updates), or fair the result once more"
        }
        _ => "the file holds the best surface so far",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::Format;

    #[test]
    fn refusals_name_faces_and_places() {
        let text = "OFF 6 2 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1.5 0\n4 0 1 4 3\n4 1 2 5 4\n";
        let mesh = MeshFile::parse("quads.off", Format::Off, text.as_bytes().to_vec()).unwrap();
        let told = |error: Error| {
            let told = refusal(Path::new("quads.off"), &mesh, &error).to_string();
            told.strip_prefix("quads.off: ").unwrap().to_owned()
        };
        assert_eq!(
            told(Error::RepeatedIndex {
                triangle: 3,
                vertex: 5
            }),
            "triangle 1 names vertex 5 twice (vertex 5 is at 2 1.5 0); remove the degenerate faces first"
        );
        assert!(
            told(Error::DuplicateTriangle {
                triangle: 2,
                other: 1
            })
            .starts_with("triangle 1 has the same")
        );
        let twisted = Error::InconsistentOrientation {
            a: 1,
            b: 4,
            triangle: 2,
            other: 0,
        };
        assert!(told(twisted).starts_with("triangles 0 and 1 run"));
        assert!(
            told(Error::NonManifoldEdge {
                a: 1,
                b: 4,
                triangle: 3
            })
            .contains("triangle 1 (vertex 1 is at 1 0 0)")
        );
        // A vertex that does not exist has no place.
        assert!(!told(Error::NotFinite { vertex: 6 }).contains(" is at "));
    }
}
