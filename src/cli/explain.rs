//! Refusals and outcomes in words, in the numbering of the user's file.

use std::fmt::Display;
use std::path::Path;

use fairmesh::{Coincident, Error, Outcome, Report, inconsistent_edges};

use crate::failure::{ExitCode, Failure};
use crate::figures::significant;
use crate::formats::{Geometry, MeshFile};

/// The library's refusal with polygons instead of triangles, where it is, and what to do.
pub fn refusal(path: &Path, mesh: &MeshFile, error: &Error) -> Failure {
    let geometry = &mesh.geometry;
    let message = match error {
        Error::BadOption { name, value, range } => {
            return Failure::new(format!(
                "--{} {value}: it must be {range}",
                name.replace('_', "-")
            ));
        }
        _ => in_polygons(error, geometry).to_string(),
    };
    let place = vertex_of(error)
        .and_then(|v| Some((v, geometry.positions.get(v)?)))
        .map_or(String::new(), |(v, [x, y, z])| {
            let [x, y, z] = [x, y, z].map(|c| coordinate(*c));
            format!(" (vertex {v} is at {x} {y} {z})")
        });
    let remedy = match error.entry().remedy() {
        remedy if matches!(error, Error::InconsistentOrientation { .. }) => {
            let of = inconsistent_edges(&geometry.positions, &geometry.triangles, Coincident::default());
            format!(
                "; {} edges of the mesh are like this; {remedy}, as --orient does",
                of.map_or(0, |edges| edges.len())
            )
        }
        "" => String::new(),
        remedy => format!("; {remedy}"),
    };
    with_code(format!("{}: {message}{place}{remedy}", path.display()), error)
}

/// A refusal where no file's numbers have a part in it.
pub fn plain_refusal(what: impl Display, error: &Error) -> Failure {
    with_code(format!("{what}: {error}"), error)
}

fn with_code(message: String, error: &Error) -> Failure {
    let failure = Failure::new(message);
    match error {
        Error::Threads { .. } => failure.with_code(ExitCode::Exhausted),
        _ => failure,
    }
}

/// As it is written by hand, without hundreds of zeros.
fn coordinate(value: f64) -> String {
    if value == 0.0 || (1e-4..1e16).contains(&value.abs()) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// Triangles of a file of polygons are numbered by polygon.
fn in_polygons(error: &Error, geometry: &Geometry) -> Error {
    let mut error = error.clone();
    match &mut error {
        Error::IndexOutOfRange { triangle, .. }
        | Error::RepeatedIndex { triangle, .. }
        | Error::NotOrientable { triangle }
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
        | Error::CoordinateTooLarge { vertex, .. }
        | Error::RepeatedIndex { vertex, .. }
        | Error::NonManifoldVertex { vertex }
        | Error::FreeVertexOnBoundary { vertex }
        | Error::FreeVertexWithoutTriangle { vertex }
        | Error::NothingFixed { vertex }
        | Error::BadNormal { vertex }
        | Error::NoNormal { vertex }
        | Error::NotOnLoop { vertex }
        | Error::ValenceTooLarge { vertex, .. } => Some(vertex),
        Error::NonManifoldEdge { a, .. } | Error::InconsistentOrientation { a, .. } => Some(a),
        _ => None,
    }
}

/// The outcome in one sentence.
pub fn outcome(report: &Report) -> String {
    let name = report.outcome.name().replace('_', " ");
    let text = report.outcome.text();
    let figures = match &report.outcome {
        Outcome::ConvergedPoorTriangles { triangles } | Outcome::PoorWhenRounded { triangles } => {
            format!(" ({} triangles)", triangles.len())
        }
        Outcome::SelfIntersecting { pairs } => format!(" ({pairs} pairs)"),
        Outcome::BoundaryCrease { vertices } => format!(
            " ({} vertices, up to {:.0} degrees; {:.0} in the input)",
            vertices.len(),
            report.quality.boundary_kink,
            report.quality.boundary_kink_before
        ),
        Outcome::TargetNotReachable { reached } => format!(" ({:.0} % of it)", 100.0 * reached),
        Outcome::NearestMember { weight } => member(*weight),
        _ => String::new(),
    };
    format!("{name}: {text}{figures}")
}

/// Which equation a surface solves in place of the harmonic one.
pub fn member(weight: f64) -> String {
    format!(
        " (Delta_B H = -2 w H (H^2 - K) with w = {}; w is 0 for harmonic, 1 for minimal energy)",
        significant(weight)
    )
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
            "triangle 1 names vertex 5 twice (vertex 5 is at 2 1.5 0); remove the degenerate triangles first"
        );
        assert_begins!(
            told(Error::DuplicateTriangle {
                triangle: 2,
                other: 1
            }),
            "triangle 1 has the same"
        );
        let twisted = Error::InconsistentOrientation {
            a: 1,
            b: 4,
            triangle: 2,
            other: 0,
        };
        assert_begins!(told(twisted), "triangles 0 and 1 run");
        assert_contains!(
            told(Error::NonManifoldEdge {
                a: 1,
                b: 4,
                triangle: 3
            }),
            "triangle 1 (vertex 1 is at 1 0 0)"
        );
        // A vertex that does not exist has no place.
        let told = told(Error::NotFinite { vertex: 6 });
        assert!(!told.contains(" is at "), "{told}");
    }
}
