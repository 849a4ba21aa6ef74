//! The default solver: a quasi-Newton iteration on both fairness equations together.
//!
//! [`initial`] makes a start from connectivity and boundary data alone, [`quasi_newton`] iterates to tolerance with a
//! frozen matrix ([`bilaplacian`]), and [`globalize`] is the order in which harder means are tried: repaired inner
//! fairness, plain curvature, pseudo-time, continuation in the boundary normals.

pub mod bilaplacian;
pub mod candidate;
pub mod continuation;
pub mod control;
pub mod curvature_bounds;
pub mod direction;
pub mod factor;
pub mod globalize;
pub mod initial;
pub mod loading;
pub mod pseudo_time;
pub mod quasi_newton;
pub mod system;
pub mod untangle;
pub mod weight_repair;

pub use control::Control;
pub use globalize::{Ending, Solved, solve};
pub use system::System;
