//! Triangles where they lie, for a tree that finds the nearest one to a point.

use nalgebra::Vector3;
use rstar::{AABB, PointDistance, RTreeObject};

use crate::holes::parents::nearest_on;

/// A triangle where it lies.
pub(crate) struct Placed {
    pub(crate) number: u32,
    pub(crate) x: [Vector3<f64>; 3],
}

impl Placed {
    /// A triangle of a mesh, if its corners are finite.
    pub(crate) fn of(positions: &[[f64; 3]], triangles: &[[u32; 3]], number: u32) -> Option<Self> {
        let x = triangles[number as usize].map(|v| Vector3::from(positions[v as usize]));
        let is_finite = x.iter().all(|p| p.iter().all(|c| c.is_finite()));
        is_finite.then_some(Self { number, x })
    }
}

impl RTreeObject for Placed {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        let [a, b, c] = &self.x;
        AABB::from_corners(a.inf(b).inf(c).into(), a.sup(b).sup(c).into())
    }
}

impl PointDistance for Placed {
    fn distance_2(&self, point: &[f64; 3]) -> f64 {
        nearest_on(&self.x, &Vector3::from(*point)).0
    }
}
