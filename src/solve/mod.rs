//! The default solver: a quasi-Newton iteration on both fairness equations together.
//!
//! [`initial`] makes a start from connectivity and boundary data alone, [`quasi_newton`] iterates to tolerance with a
//! frozen matrix ([`bilaplacian`]); [`attempt`] is the table of what is tried in which order, and [`ladder`] goes through it.

pub(crate) mod attempt;
mod bending;
pub(crate) mod bilaplacian;
pub(crate) mod candidate;
pub(crate) mod coarse;
mod coarse_result;
pub(crate) mod control;
pub(crate) mod curvature_bounds;
mod descent;
pub(crate) mod direction;
pub(crate) mod domain;
pub(crate) mod factor;
pub(crate) mod family;
pub(crate) mod formulation;
pub(crate) mod g2;
pub(crate) mod graded_plate;
pub(crate) mod initial;
pub(crate) mod iterate_options;
mod iteration_round;
pub(crate) mod ladder;
pub(crate) mod limited_step;
pub(crate) mod live;
pub(crate) mod normal_matrix;
pub(crate) mod plate;
pub(crate) mod problem;
pub(crate) mod procedure;
pub(crate) mod quasi_newton;
mod regain;
pub(crate) mod result;
mod rivals;
mod soft_mode;
pub(crate) mod step;
pub(crate) mod system;
pub(crate) mod target_continuation;
pub(crate) mod transition;
pub(crate) mod untangle;
pub(crate) mod weight_repair;

pub(crate) use control::Control;
pub(crate) use domain::Domain;
pub(crate) use g2::boundary_curvature::{AskedContinuity, Blend};
pub(crate) use g2::continuation::PHASE as CONTINUATION;
pub(crate) use ladder::Ladder;
pub(crate) use problem::Problem;
pub(crate) use result::{LoopContinuity, SolveResult, SolveStatus, Trial, TrialEnd};
pub(crate) use system::System;
