//! Analytic surfaces and the paper's inputs as triangle meshes, regular and irregular.
//!
//! Every generator is deterministic: the same arguments give the same bits. `n` is the approximate number
//! of free vertices (at least 12), `outside` the number of rings of exact triangles around the free region;
//! with 0 the fixed rim is the border of the mesh. Arguments out of range are moved into it.
//!
//! Triangles run counter-clockwise seen from outside, normals point outward.

mod blend;
mod blend_start;
mod chart;
mod planar;
mod revolution;
mod rng;
mod sampling;
mod shape;
mod sphere;
mod surface;
mod unduloid;

pub use blend::{
    BLEND_DISTANCE, BLEND_RADIUS, cylinder_blend, cylinder_blend_coarse, cylinder_blend_fine,
    cylinder_blend_refined_patch, cylinder_blend_with,
};
pub use revolution::{catenoid_band, cylinder_band, sphere_zone, unduloid_band};
pub use sampling::Sampling;
pub use shape::Shape;
pub use sphere::{saddle_graph, sphere_cap};
pub use surface::{Similarity, Surface};
pub use unduloid::Unduloid;

/// Rings of fixed triangles around the free region unless there is a reason for another number.
pub const OUTSIDE: usize = 4;
