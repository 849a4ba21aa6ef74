//! Triangles of a result, and how much it bends between them.

use nalgebra::Vector3;

use super::surface::between;
use crate::holes::Links;
use crate::mesh::halfedge::{next, previous};
use crate::support::error::Error;

pub(super) struct Facets<'a> {
    pub(super) links: Links<'a>,
    positions: &'a [[f64; 3]],
}

impl<'a> Facets<'a> {
    /// # Errors
    /// Those of [`Links::new`].
    pub(super) fn new(positions: &'a [[f64; 3]], triangles: &'a [[u32; 3]]) -> Result<Self, Error> {
        let links = Links::new(positions.len(), triangles)?;
        Ok(Self { links, positions })
    }

    pub(super) fn at(&self, v: u32) -> Vector3<f64> {
        self.positions[v as usize].into()
    }

    /// From the vertex where a half-edge starts to that where it ends.
    pub(super) fn edge(&self, h: u32) -> Vector3<f64> {
        self.at(self.links.origin(next(h))) - self.at(self.links.origin(h))
    }

    /// Cross product of two sides of the triangle of a half-edge.
    pub(super) fn cross(&self, h: u32) -> Vector3<f64> {
        self.edge(h).cross(&-self.edge(previous(h)))
    }

    /// By how many degrees the surface bends at an edge with two triangles.
    pub(super) fn bend(&self, h: u32) -> Option<f64> {
        let o = self.links.across(h)?;
        Some(between(&self.cross(h), &self.cross(o)).to_degrees())
    }
}
