//! A mesh with a bridge, and what is told of it.

use super::outcome::LoopReport;
use super::parents::Parents;
use crate::fairing::Report;

/// A mesh with a bridge.
#[derive(Debug, Clone)]
pub struct Bridged {
    /// The positions given, then the new ones.
    pub positions: Vec<[f64; 3]>,
    /// The triangles given, then the new ones.
    pub triangles: Vec<[u32; 3]>,
    /// Per new vertex where it comes from.
    pub parents: Vec<Parents>,
    /// The vertices of the chains that the strip begins and ends at, in the direction in which its triangles run through them.
    pub chains: [Vec<u32>; 2],
    /// The new vertices on the strip's two sides: from the last vertex of the first chain to the first one of the second, and from
    /// the last one of the second back to the first. Empty if there is no strip.
    pub sides: [Vec<u32>; 2],
    /// By how much the strip is twisted from one chain to the other, in degrees between -180 and 180.
    pub twist: f64,
    /// What became of the strip; its `edges` are those of the whole boundary, its `vertices` those on the sides, too.
    pub strip: LoopReport,
    /// What became of the holes beside it, if they were to be filled. Their numbers are those of the boundary loops of the mesh with
    /// the strip.
    pub rest: Vec<LoopReport>,
    /// The fairing of all new vertices together, if holes were filled. Unless its outcome is [`Outcome::Converged`](crate::Outcome::Converged), the strip and the patches
    /// are left as they were made.
    pub whole: Option<Report>,
}

impl Bridged {
    /// Whether there is nothing to be said of the result: all that is new converged together, or strip and patches did by themselves, as far as
    /// they were to be faired; and no hole that was to be filled is open. The same in every host.
    pub fn is_success(&self) -> bool {
        let is_filled = |of: &LoopReport| !of.is_open() && !of.has_no_area();
        let is_good = |of: &LoopReport| is_filled(of) && of.is_success();
        let mut patches = std::iter::once(&self.strip).chain(&self.rest);
        match &self.whole {
            Some(report) => report.outcome.is_success() && patches.all(is_filled),
            None => patches.all(is_good),
        }
    }
}
