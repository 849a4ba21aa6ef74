//! The default solver: a quasi-Newton iteration on both fairness equations together.
//!
//! [`initial`] makes a start from connectivity and boundary data alone, [`quasi_newton`] iterates to tolerance with a
//! frozen matrix ([`bilaplacian`]), and [`globalize`] is the order in which harder means are tried: repaired inner
//! fairness, plain curvature, pseudo-time, continuation in the boundary normals.

pub(crate) mod bilaplacian;
pub(crate) mod candidate;
pub(crate) mod continuation;
pub(crate) mod control;
pub(crate) mod curvature_bounds;
pub(crate) mod direction;
pub(crate) mod factor;
pub(crate) mod globalize;
pub(crate) mod initial;
pub(crate) mod loading;
pub(crate) mod pseudo_time;
pub(crate) mod quasi_newton;
pub(crate) mod system;
pub(crate) mod untangle;
pub(crate) mod weight_repair;

pub(crate) use control::Control;
pub(crate) use globalize::{Ending, Solved, solve};
pub(crate) use system::System;
