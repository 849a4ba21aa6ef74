//! Ends of creases that belong together.

use super::branch::Branch;

/// The angles at both ends of a crease differ by no more than this, degrees. Half: of 33 parts one fewer is good; double: of 33 parts and 165 regions
/// across edges of parts none changes.
pub(super) const UNLIKE: f64 = 45.0;

/// Ends that belong together, and the creases between them: one; three or more to a corner; or two each to two corners, and one from corner to
/// corner. None of an end alone.
#[derive(Debug, Clone)]
pub(super) struct Group {
    pub(super) ends: Vec<usize>,
    pub(super) branches: Vec<Branch>,
    /// In squares of radians.
    pub(super) cost: f64,
}
