//! Analytic surfaces and the paper's inputs as triangle meshes, regular and irregular.
//!
//! Every generator is deterministic: the same arguments give the same bits. `n` is the approximate number
//! of free vertices (12 to 50 million), `outside` the number of rings of exact triangles around the free
//! region (at most 16); with 0 the fixed boundary is the boundary of the mesh. Arguments out of range are moved into it.
//!
//! Triangles run counter-clockwise seen from outside, normals point outward.

#[cfg(test)]
#[macro_use]
#[path = "../../tests/common/asserts.rs"]
mod asserts;

mod arithmetic;
mod blend;
mod blend_start;
mod chart;
mod conjugate_gradients;
mod creased;
mod ellipsoid;
mod ellipsoid_cap;
mod harmonic_profile;
mod irregular;
mod parts;
mod planar;
mod plate;
mod profile;
mod revolution;
mod rng;
mod sampling;
mod shape;
mod size;
mod sphere;
mod spoil;
mod surface;
mod tetra;
mod torus;
mod torus_patch;
mod unduloid;

pub use blend::{
    cylinder_blend, cylinder_blend_coarse, cylinder_blend_fine, cylinder_blend_of,
    cylinder_blend_refined_patch, cylinder_blend_with,
};
pub use blend_start::{BLEND_DISTANCE, BLEND_RADIUS};
pub use chart::OUTSIDE;
pub use creased::{Creased, creased};
pub use ellipsoid::Ellipsoid;
pub use ellipsoid_cap::ellipsoid_cap;
pub use harmonic_profile::{HarmonicProfile, ProfileError};
pub use parts::{in_parts, plate, sphere_in_pieces, sphere_without_band, tubes};
pub use revolution::{catenoid_band, cylinder_band, revolution_band, sphere_zone, unduloid_band};
pub use sampling::Sampling;
pub use shape::Shape;
pub use sphere::{saddle_graph, sphere_cap, sphere_with_hole};
pub use surface::{Similarity, Surface};
pub use tetra::{TETRA_RADIUS, tetra_thing, tetra_thing_coarse, tetra_thing_of, tetra_thing_with};
pub use torus::Torus;
pub use torus_patch::torus_patch;
pub use unduloid::Unduloid;
