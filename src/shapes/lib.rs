//! Analytic surfaces and the paper's inputs as triangle meshes, regular and irregular.
//!
//! Every generator is deterministic: the same arguments give the same bits. `n` is the approximate number
//! of free vertices (12 to 50 million), `outside` the number of rings of exact triangles around the free
//! region (at most 16); with 0 the fixed boundary is the boundary of the mesh. Arguments out of range are moved into it.
//!
//! Triangles run counter-clockwise seen from outside, normals point outward.

mod blend;
mod blend_start;
mod chart;
mod conjugate_gradients;
mod ellipsoid;
mod harmonic_profile;
mod irregular;
mod parts;
mod planar;
mod plate;
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
mod unduloid;

pub use blend::{
    BLEND_DISTANCE, BLEND_RADIUS, cylinder_blend, cylinder_blend_coarse, cylinder_blend_fine,
    cylinder_blend_of, cylinder_blend_refined_patch, cylinder_blend_with,
};
pub use ellipsoid::{Ellipsoid, ellipsoid_cap};
pub use harmonic_profile::{HarmonicProfile, ProfileError};
pub use parts::{in_parts, plate, sphere_in_pieces, sphere_without_band, tubes};
pub use revolution::{catenoid_band, cylinder_band, revolution_band, sphere_zone, unduloid_band};
pub use sampling::Sampling;
pub use shape::Shape;
pub use sphere::{saddle_graph, sphere_cap, sphere_with_hole};
pub use surface::{Similarity, Surface};
pub use tetra::{TETRA_RADIUS, tetra_thing, tetra_thing_coarse, tetra_thing_of, tetra_thing_with};
pub use torus::{Torus, torus_patch};
pub use unduloid::Unduloid;

/// Rings of fixed triangles around the free region unless there is a reason for another number.
pub const OUTSIDE: usize = 4;

/// The most rings of fixed triangles a generator makes.
const MOST_OUTSIDE: usize = 16;

/// `x` moved into [low, high]; a NaN becomes `low`.
fn between(low: f64, x: f64, high: f64) -> f64 {
    if x > low {
        if x < high { x } else { high }
    } else {
        low
    }
}

/// The length of a vector.
fn length(p: [f64; 3]) -> f64 {
    p[0].hypot(p[1]).hypot(p[2])
}
