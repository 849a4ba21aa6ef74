//! Curvature-continuous (G2) fairing.
//!
//! [`outside_curvature`] measures the mean curvature of the surroundings along boundary loops, [`shrinkage`] draws it towards the surface's
//! own by its uncertainty, [`boundary_curvature`] makes conditions of both; [`equations`] solves with these as further unknowns, and
//! [`continuation`] goes there from the tangent-continuous surface, as far as [`blend_search`] finds sound.

pub(crate) mod blend_search;
pub(crate) mod boundary_curvature;
pub(crate) mod continuation;
pub(crate) mod equations;
pub(crate) mod outside_curvature;
pub(crate) mod shrinkage;
