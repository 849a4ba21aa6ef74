//! Which triangles intersect: found by a tree of boxes, decided by exact signs of determinants.

mod groups;
mod search;
mod triangles;

pub(crate) use search::{Bounds, Member, bounds_of, member, members_near, of_all, of_some, pairs};

#[cfg(test)]
mod tests;
