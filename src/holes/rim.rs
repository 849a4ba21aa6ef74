//! Rims that are noise: the vertices of a loop, and of some rings around it, moved before it is filled.

mod band;
mod fit;
pub(super) mod options;
mod relax;
pub(super) mod report;
mod rims;
mod roughness;
mod untangle;
mod width;

pub use options::Rim;
pub use report::RimReport;
pub(super) use rims::Rims;
pub use roughness::{Roughness, rim_roughness};
