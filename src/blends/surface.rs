//! The mesh given, in its own centre.

use nalgebra::Vector3;

use crate::holes::Links;
use crate::mesh::halfedge::{next, previous};
use crate::mesh::input::check_finite;
use crate::support::error::Error;

/// A mesh every edge of which has one triangle or two.
pub(super) struct Surface<'a> {
    pub(super) x: Vec<Vector3<f64>>,
    pub(super) links: Links<'a>,
    /// What was taken from the positions given.
    pub(super) centre: Vector3<f64>,
}

impl<'a> Surface<'a> {
    /// # Errors
    /// [`Error::NotFinite`], [`Error::NonManifoldEdge`], [`Error::InconsistentOrientation`], [`Error::RepeatedIndex`], and those of numbers that are too large.
    pub(super) fn new(positions: &[[f64; 3]], triangles: &'a [[u32; 3]]) -> Result<Self, Error> {
        let links = Links::new(positions.len(), triangles)?;
        check_finite(positions, triangles)?;
        links.check()?;
        let centre = centre(positions, triangles);
        Ok(Self {
            x: positions.iter().map(|&p| Vector3::from(p) - centre).collect(),
            links,
            centre,
        })
    }

    pub(super) fn origin(&self, h: u32) -> u32 {
        self.links.origin(h)
    }

    pub(super) fn target(&self, h: u32) -> u32 {
        self.links.origin(next(h))
    }

    /// The half-edge across, if there is one.
    pub(super) fn across(&self, h: u32) -> Option<u32> {
        self.links.across(h)
    }

    pub(super) fn half_edges(&self) -> u32 {
        self.links.opposite.len() as u32
    }

    /// From the vertex where a half-edge starts to that where it ends.
    pub(super) fn edge(&self, h: u32) -> Vector3<f64> {
        self.x[self.target(h) as usize] - self.x[self.origin(h) as usize]
    }

    /// How far from the centre its vertices are at most, along an axis.
    pub(super) fn extent(&self) -> f64 {
        let used = (0..self.half_edges()).map(|h| self.x[self.origin(h) as usize].amax());
        used.fold(0.0, f64::max)
    }

    /// How many edges of the boundary start at a vertex: none inside, and one where the surface hangs together there.
    pub(super) fn boundary_edges(&self, v: u32) -> usize {
        let around = self.links.outgoing.row(v as usize).iter();
        around.filter(|&&h| self.across(h).is_none()).count()
    }

    /// The angle of a triangle where a half-edge starts.
    pub(super) fn angle(&self, h: u32) -> f64 {
        between(&self.edge(h), &-self.edge(previous(h)))
    }
}

/// The angle between two vectors.
pub(super) fn between(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    libm::atan2(a.cross(b).norm(), a.dot(b))
}

/// The middle of the bounding box.
fn centre(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vector3<f64> {
    let all = || triangles.iter().flatten().map(|&v| positions[v as usize]);
    let of = |k: usize| {
        let low = all().map(|p| p[k]).fold(f64::INFINITY, f64::min);
        let high = all().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
        if low <= high { 0.5 * low + 0.5 * high } else { 0.0 }
    };
    Vector3::new(of(0), of(1), of(2))
}
