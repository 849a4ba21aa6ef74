//! The search on the coarse mesh, whose surface is where the fine one begins.

use nalgebra::Vector3;

use super::result::SolveStatus;

/// What the coarse mesh has led to.
#[derive(Debug)]
pub(super) enum CoarseResult {
    /// There is none.
    NoCoarseMesh,
    /// A surface.
    Found {
        /// On the fine mesh.
        x: Vec<Vector3<f64>>,
        /// The member of the family that it is: 0 for what is asked.
        member: f64,
        /// Found along the normals alone.
        along_normals: bool,
    },
    /// None that is sound.
    Missed {
        /// For this reason.
        status: SolveStatus,
        /// What there is in its place, on the fine mesh.
        x: Option<Vec<Vector3<f64>>>,
    },
}
