//! Regions of a mesh chosen by place, distance or shape: for hosts that have no brush.

mod bump;
mod fair_region;
mod geodesic;
mod growth;
mod neighbours;
mod nested;
mod robust;
mod seed;
mod spread;
mod steps;

pub use bump::Bump;
pub use seed::Seed;
pub use steps::{Combine, Region, RegionStep, SelectedRegion, select_region, select_region_with_progress};
