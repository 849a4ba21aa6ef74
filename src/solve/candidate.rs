//! What an attempt has led to, and how good it is.

use nalgebra::Vector3;

use super::quasi_newton::End;
use super::system::System;

/// A surface that one of the means has led to.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    /// The surface.
    pub x: Vec<Vector3<f64>>,
    /// How the iteration ended.
    pub end: End,
    /// Its step norm.
    pub step: f64,
    /// Its poor triangles.
    pub poor: Vec<u32>,
    /// Its mean curvature inside exceeds what the equation allows ([`super::curvature_bounds`]), or it stands off single
    /// boundary normals far more than off the others: a bump that the coarse equations admit.
    pub doubtful: bool,
    /// See [`Solved::even`](super::Solved::even).
    pub even: bool,
    /// All that is wrong are needles that the start has, too, and that no repair of the weights widens: they come from the
    /// connectivity, such as at the pole of a sphere with hundreds of meridians. Nothing else that is tried would.
    pub needled: bool,
}

impl Candidate {
    /// Converged, with sound triangles and no bump.
    pub(crate) fn is_sound(&self) -> bool {
        self.end == End::Converged && self.poor.is_empty() && !self.doubtful
    }

    /// The smaller the better.
    pub(crate) fn rank(&self) -> (bool, usize, bool) {
        (self.end != End::Converged, self.poor.len(), self.doubtful)
    }

    /// Whether nothing is wrong but so many needles, at most. The system was evaluated here last.
    pub(crate) fn has_only_needles(&self, system: &System<'_>, most: usize) -> bool {
        let is_flipped = || !system.poor(&self.x, 0.0).is_empty();
        self.end == End::Converged && !self.doubtful && self.poor.len() <= most && !is_flipped()
    }

    /// Whether nothing better is to be looked for.
    pub(crate) fn is_settled(&self) -> bool {
        self.is_sound() || self.end == End::Stopped || self.needled
    }
}
