//! From the host's arrays to a problem in the region's own frame.

use std::sync::Arc;

use nalgebra::Vector3;

use super::continuity::{asked_continuity, check_loops, on_loops};
use super::normalization::Normalization;
use super::normals::{GivenNormals, boundary_normals};
use super::options::{Discretization, InnerFairness, Options, SolverKind};
use crate::discrete::equations::FreeCurvature;
use crate::discrete::inner_fairness::FairnessWeights;
use crate::discrete::target::RightHandSide;
use crate::mesh::RegionMesh;
use crate::mesh::numbering::Numbering;
use crate::mesh::selection::Selection;
use crate::solve::problem::Weigh;
use crate::solve::{AskedContinuity, Domain, Problem};
use crate::support::error::Error;
use crate::support::profile::clock;

/// What both solvers begin with: one component of what is to be faired.
pub(super) struct Prepared {
    pub(super) domain: Arc<Domain>,
    pub(super) normalization: Normalization,
    /// Prescribed normals.
    boundary_normals: Vec<Vector3<f64>>,
    /// Which boundary vertices have theirs from the caller.
    pub(super) has_given_normal: Vec<bool>,
    /// Where the surface passes smoothly instead; empty: nowhere.
    smooth_interior: Vec<bool>,
    pub(super) weights: Arc<FairnessWeights>,
    weigh: Option<Weigh>,
    curvature: FreeCurvature,
    right_hand_side: RightHandSide,
    continuity: Option<Arc<AskedContinuity>>,
}

/// The region of each component, cut where given normals ask for it; `is_wide`: with surroundings wide enough to tell their curvature.
pub(super) fn regions(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    given: &GivenNormals,
    (solver, is_wide): (&SolverKind, bool),
) -> Result<Vec<RegionMesh>, Error> {
    let numbering = match solver {
        SolverKind::Fast => Numbering::BreadthFirst,
        // Its sweeps go through the vertices in the caller's order.
        SolverKind::Paper(_) => Numbering::AsGiven,
    };
    let _clock = clock("region");
    RegionMesh::of_components(
        positions,
        triangles,
        selection,
        &|v| given.has(v),
        (numbering, is_wide),
    )
}

impl Prepared {
    /// All components, by their smallest free vertices. Checks everything that can be wrong with the mesh, the selection and
    /// the normals.
    pub(super) fn of_components(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        selection: Selection<'_>,
        options: &Options,
        is_wide: bool,
    ) -> Result<Vec<Self>, Error> {
        let given = GivenNormals::new(&options.boundary_normals);
        let regions = regions(
            positions,
            triangles,
            selection,
            &given,
            (&options.solver, is_wide),
        )?;
        let prepared = regions
            .into_iter()
            .map(|region| Self::new(positions, region, &given, options));
        let prepared = prepared.collect::<Result<Vec<Self>, _>>()?;
        let vertices = prepared.iter().flat_map(|p| on_loops(&p.domain));
        check_loops(&options.loop_continuity, vertices)?;
        Ok(prepared)
    }

    /// What is asked of the curvature along the boundary loops, in its own unit, of which some vertices are not where the surroundings end.
    pub(super) fn asked_continuity(
        &self,
        options: &Options,
        is_moved: impl Fn(usize) -> bool,
    ) -> Option<Arc<AskedContinuity>> {
        let (region, scale) = (&self.domain.region, self.normalization.scale);
        let has_normal = self.has_given_normal.iter().enumerate();
        let is_given: Vec<bool> = has_normal.map(|(b, has)| *has || is_moved(b)).collect();
        asked_continuity(region, options, scale, &is_given).map(Arc::new)
    }

    fn new(
        positions: &[[f64; 3]],
        region: RegionMesh,
        given: &GivenNormals,
        options: &Options,
    ) -> Result<Self, Error> {
        let mut x = region.positions(positions);
        let normalization = Normalization::new(&region, &x);
        normalization.enter(&mut x);
        let domain = {
            let _clock = clock("rings, valence batches");
            Domain::new(region, x)
        };
        let asked = &options.boundary_normals;
        let _clock = clock("boundary normals");
        let (boundary_normals, smooth_interior) =
            boundary_normals(&domain, asked, given, options.interior_normals)?;
        let weigh: Option<Weigh> = match options.inner_fairness {
            InnerFairness::Uniform => None,
            InnerFairness::Conformal => Some(FairnessWeights::conformal),
            InnerFairness::Convex => Some(FairnessWeights::convex),
        };
        let weights = match weigh {
            None => FairnessWeights::uniform(),
            Some(weigh) => weigh(&domain.batches, &domain.input),
        };
        let mut this = Self {
            has_given_normal: given.at_boundary(&domain.region),
            right_hand_side: options.target.right_hand_side(normalization.scale),
            continuity: None,
            domain: Arc::new(domain),
            normalization,
            boundary_normals,
            smooth_interior,
            weights: Arc::new(weights),
            weigh,
            curvature: curvature(options),
        };
        this.continuity = this.asked_continuity(options, |_| false);
        Ok(this)
    }

    /// How many vertices of the component are free.
    pub(super) fn free(&self) -> usize {
        self.domain.region.free
    }

    /// That not even a linear surface exists.
    pub(super) fn nothing_fixed(&self) -> Error {
        Error::NothingFixed {
            vertex: self.domain.region.first_free(),
        }
    }

    /// What is to be solved.
    pub(super) fn problem(&self) -> Problem<'_> {
        Problem {
            domain: &self.domain,
            boundary_normals: &self.boundary_normals,
            smooth_interior: &self.smooth_interior,
            weights: &self.weights,
            weigh: self.weigh,
            curvature: self.curvature,
            right_hand_side: self.right_hand_side,
            continuity: self.continuity.as_ref(),
        }
    }
}

fn curvature(options: &Options) -> FreeCurvature {
    match (&options.solver, options.discretization) {
        (SolverKind::Paper(_), _) | (_, Discretization::Paper) => FreeCurvature::Paper,
        (SolverKind::Fast, Discretization::SecondOrder) => FreeCurvature::GradientCorrected,
    }
}
