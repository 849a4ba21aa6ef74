//! Fill holes, remove bumps, blend and join on triangle meshes, exactly smooth: intrinsic G1 fairing.
//!
//! Given a triangle mesh, a set of free vertices and unit normals at the fixed vertices that bound
//! them, fairmesh moves the free vertices until the surface solves `Delta_B H = 0`, so that the shape
//! depends on the boundary alone and not on the triangulation.
//!
//! R. Schneider, L. Kobbelt, "Geometric fairing of irregular meshes for free-form surface design",
//! CAGD 18 (2001); "the paper" throughout.
//!
//! Sign convention: with outward normals the mean curvature `H` is negative on a sphere (paper (8)).

// The same bits on every system: clippy.toml has the list.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

#[cfg(test)]
#[macro_use]
#[path = "../tests/common/asserts.rs"]
mod asserts;

mod blends;
mod discrete;
mod fairing;
mod holes;
mod intersections;
mod measure;
mod mesh;
mod paper;
mod quality;
mod regions;
mod solve;
mod support;

pub use blends::{
    CreaseChain, Creases, Narrowing, RoundOptions, Rounded, SharpCorner, blend_vertices, find_creases, round,
    round_with_progress,
};
pub use fairing::{
    Attempt, AttemptEnd, BoundaryCurvature, BoundaryNormals, Budget, Coincident, ComponentReport, CreaseEnd,
    CurvatureContinuity, Discretization, Edit, Frame, InnerFairness, InteriorNormals, Intersections,
    LooseReason, Options, Outcome, OutputPrecision, Progress, ProgressCallback, Report, Seconds, Selection,
    SelfIntersections, SharpEdge, SharpFate, Solution, Solver, SolverKind, Target, crease_ends, fair,
    fair_with_progress,
};
pub use holes::{
    BoundaryLoop, BridgeOptions, Bridged, Cap, Carried, Erased, FillOptions, FillOutcome, Filled, FlatReason,
    GapKind, Join, JoinReason, JoinSuggestion, LoopFilter, LoopKind, LoopReport, Loops, OnFailure,
    OpenReason, Parents, Place, RemeshOptions, Remeshed, Rim, RimReport, Roughness, TrimLimits, Trimmed,
    boundary_loops, boundary_loops_joined, bridge, bridge_with_progress, carry_over,
    carry_over_with_progress, erase, erase_and_clean, fill_holes, fill_holes_with_progress, refill_region,
    refill_region_with_progress, remesh_region, remesh_region_with_progress, rim_roughness, suggest_joins,
    triangle_components, trim_boundary,
};
pub use measure::curvature::{mean_curvature, mean_curvature_joined};
pub use measure::distance::{DistanceTo, SurfaceDistance};
pub use measure::orientation::{InconsistentEdge, inconsistent_edges, triangles_to_turn};
pub use measure::self_intersections::{self_intersections, self_intersections_with_progress};
pub use paper::{Estimate, LevelReport, PaperOptions};
pub use quality::Quality;
pub use regions::{
    Bump, Combine, Region, RegionStep, Seed, SelectedRegion, select_region, select_region_with_progress,
};
pub use support::error::Error;
pub use support::options::{OptionDefault, OptionEntry, OptionKind};
#[cfg(feature = "profile")]
pub use support::profile::take_profile;
pub use support::table::Entry;

/// The example of README.md, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
