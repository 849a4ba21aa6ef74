//! The library as its users see it: known answers, invariances, outcomes and refusals.
#![allow(clippy::print_stdout, reason = "the measured figures, for --nocapture")]

#[macro_use]
#[path = "../common/asserts.rs"]
mod asserts;

mod fairing;
#[path = "../common/tier.rs"]
mod tier;

mod accuracy;
mod answers;
mod boundary;
mod bridge;
mod coincident;
mod components;
mod continuity;
mod continuity_loops;
mod cube_regions;
mod defects;
mod density;
mod golden;
mod guides;
mod hole_retries;
mod holes;
mod independence;
mod interior;
mod intersections;
mod join;
mod live;
mod long;
mod marked_edges;
mod outcomes;
mod outer_boundaries;
mod paper;
mod pipes;
mod progress;
mod refill;
mod regions;
mod rim;
mod round;
mod round_ends;
mod search;
mod sharp;
mod solver;
mod soundness;
mod targets;
mod tetra;
mod threads;
