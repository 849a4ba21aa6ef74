//! Curvature-continuous (G2) fairing.
//!
//! [`outside_curvature`] measures the mean curvature of the surroundings ([`outside`]) along boundary loops, by the [`estimator`] that errs
//! least along [`virtual_loops`]; [`shrinkage`] draws it towards the surface's own by that error, [`boundary_curvature`] makes conditions
//! of both; [`equations`] solves with these as further unknowns, and
//! [`continuation`] goes there from the tangent-continuous surface, as far as [`blend_search`] finds sound.

pub(crate) mod blend_search;
pub(crate) mod boundary_curvature;
pub(crate) mod continuation;
pub(crate) mod equations;
pub(crate) mod estimator;
pub(crate) mod outside;
pub(crate) mod outside_curvature;
pub(crate) mod shrinkage;
pub(crate) mod virtual_loops;
