//! Ways to tell the mean curvature at the boundary of what is known of a surface, from there.

use std::borrow::Cow;

use fairmesh_linear::parallel;
use nalgebra::Vector3;

use crate::discrete::boundary_samples::BoundarySamples;
use crate::discrete::one_sided_curvature::OneSided;
use crate::discrete::trace::{Reach, Trace};

/// `H` at each vertex of a loop, where there are samples enough.
pub(super) type Estimated = Vec<Option<f64>>;

/// As many estimates as this part of a loop has to have, to be relied on. Errors with G2 over those without, of 80 holes and regions on exact
/// surfaces and 72 in scans, geometric means: .907, .982; half: .893, 1.000; .99: .994, .981.
pub(super) const MOST_ESTIMATES: f64 = 0.9;
/// Fits that a thread makes at once: no result depends on it.
const PIECE: usize = 16;

/// One of them.
#[derive(Debug, Clone, Copy)]
pub(super) enum Estimator {
    /// A fit to positions, right to third order.
    Fit(OneSided),
    /// The trace of the curvatures of vertices, which errs as that of the equation inside does, in the mean.
    Trace(Reach),
}

impl Estimator {
    /// All that are compared. The trace is that of the surface inside: a wider one agrees along virtual loops with traces from the other side, which
    /// err as it does, and is taken where it is wrong. With it the worst of the cases of six seeds in scans is 2.20, in place of 1.13.
    pub(super) const ALL: [Self; 4] = [
        Self::Fit(OneSided::Fourth),
        Self::Fit(OneSided::Third),
        Self::Fit(OneSided::Wide),
        Self::Trace(Reach::Near),
    ];
    /// None takes samples from further away, in edges.
    pub(super) const MOST_RINGS: usize = 8;

    /// Whether there are enough of them.
    pub(super) fn is_known(estimated: &Estimated) -> bool {
        let known = estimated.iter().flatten().count();
        known as f64 >= (MOST_ESTIMATES * estimated.len() as f64).max(1.0)
    }

    /// Samples lie within so many edges.
    fn rings(self) -> usize {
        match self {
            Self::Fit(kind) => kind.rings(),
            Self::Trace(reach) => reach.rings(),
        }
    }

    /// `H` at each vertex of a loop, where there are samples enough that stand still.
    pub(super) fn along(self, around: &Around<'_>) -> Estimated {
        parallel::map_each(around.vertices.len(), PIECE, |k| self.at(k, around))
    }

    fn at(self, k: usize, around: &Around<'_>) -> Option<f64> {
        let (vertices, reach) = around.samples.of(k);
        let count = reach.partition_point(|r| usize::from(*r) <= self.rings());
        let (vertices, reach) = (&vertices[..count], &reach[..count]);
        if vertices.iter().any(|j| around.moves(*j)) {
            return None;
        }
        let centre = around.x[around.vertices[k] as usize];
        let edge = |j: u32| around.x[j as usize] - centre;
        let normal = &around.normals[k];
        let h = match self {
            Self::Fit(kind) => {
                let edges: Vec<_> = vertices.iter().map(|j| edge(*j)).collect();
                kind.fit(normal, &edges, reach)?
            }
            Self::Trace(wide) => {
                let value = |j: u32| around.h[j as usize];
                let known = vertices.iter().zip(reach).filter(|(j, _)| value(**j).is_finite());
                let edges = known.clone().map(|(j, ring)| (edge(*j), *ring));
                Trace::new(normal, wide, edges)?.value(known.map(|(j, _)| value(*j)))
            }
        };
        Some(h).filter(|h| h.is_finite())
    }
}

/// A loop and what lies on one side of it.
pub(super) struct Around<'a> {
    /// The vertices of the loop, by local number,
    pub vertices: Vec<u32>,
    /// and their normals.
    pub normals: Vec<Vector3<f64>>,
    /// What lies around each.
    pub samples: BoundarySamples,
    /// Positions,
    pub x: &'a [Vector3<f64>],
    /// and mean curvatures of vertices; not a number where they are not known.
    pub h: Cow<'a, [f64]>,
    /// Which vertices move; empty: none.
    pub moves: &'a [bool],
}

impl Around<'_> {
    fn moves(&self, vertex: u32) -> bool {
        self.moves.get(vertex as usize).is_some_and(|moves| *moves)
    }
}
