//! What users ask of a whole mesh: curvature, distance to another surface, intersections, orientation.

pub(crate) mod curvature;
pub(crate) mod distance;
pub(crate) mod orientation;
pub(crate) mod self_intersections;
