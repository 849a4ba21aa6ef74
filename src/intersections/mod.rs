//! Which triangles intersect: found by a tree of boxes without those parts of the surface that are height
//! fields, decided by exact signs of determinants.

mod groups;
mod height_field;
mod member;
mod neighbours;
mod search;
mod tree;
mod triangles;

pub(crate) use member::{Bounds, Member, bounds_of, member};
pub(crate) use search::{members_near, of_all, of_some, pairs, told_of_some};
pub(crate) use triangles::{facing, intersect};

#[cfg(test)]
mod tests;
