//! Where a region begins: a vertex, or the point of the surface that is nearest to a point.

use nalgebra::Vector3;

use super::neighbours::Neighbours;
use crate::holes::nearest_on;
use crate::support::error::Error;

/// A place on a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Seed {
    /// A vertex.
    Vertex(u32),
    /// The point of the surface that is nearest to this one.
    Point([f64; 3]),
}

/// A point of the surface.
pub(super) struct Foot {
    /// A triangle that it lies in.
    pub(super) triangle: u32,
    /// It.
    pub(super) place: Vector3<f64>,
}

impl Seed {
    /// Finds the place.
    ///
    /// # Errors
    /// [`Error::SelectionOutOfRange`], [`Error::FreeVertexWithoutTriangle`] for a vertex, [`Error::BadOption`] for a point that is not
    /// finite.
    pub(super) fn foot(&self, mesh: &Neighbours<'_>) -> Result<Foot, Error> {
        match *self {
            Seed::Vertex(v) => {
                let (index, count) = (v as usize, mesh.positions.len());
                if index >= count {
                    return Err(Error::SelectionOutOfRange { index, count });
                }
                let alone = Error::FreeVertexWithoutTriangle { vertex: index };
                Ok(Foot {
                    triangle: *mesh.at(v).first().ok_or(alone)?,
                    place: mesh.place(v),
                })
            }
            Seed::Point(point) => {
                for x in point {
                    Error::check_option("point", x, x.is_finite(), "finite")?;
                }
                let [x, ..] = point;
                let range = "near a surface of at least one triangle";
                nearest(mesh, &Vector3::from(point)).ok_or(Error::BadOption {
                    name: "point",
                    value: x,
                    range,
                })
            }
        }
    }
}

/// The point of the surface that is nearest to another one, in the first triangle that has it; none where no distance is a number.
fn nearest(mesh: &Neighbours<'_>, point: &Vector3<f64>) -> Option<Foot> {
    let mut best = (f64::INFINITY, None);
    for (triangle, corners) in (0..).zip(mesh.triangles) {
        let x = corners.map(|v| mesh.place(v));
        let (_, weights) = nearest_on(&x, point);
        let place = x[0] * weights[0] + x[1] * weights[1] + x[2] * weights[2];
        let distance = (place - point).norm_squared();
        if distance < best.0 {
            best = (distance, Some(Foot { triangle, place }));
        }
    }
    best.1
}
