//! The paper's own scheme, whole: the default solver's yardstick.
//!
//! [`estimate`] and [`vertex`] are the two second-order problems of 7.1, one after the other in [`iteration`];
//! [`multigrid`] is Figure 6 around them, on the levels of [`crate::mesh::hierarchy`].

pub(crate) mod estimate;
pub(crate) mod iteration;
pub(crate) mod level_report;
pub(crate) mod local;
pub(crate) mod multigrid;
pub(crate) mod options;
pub(crate) mod prolongation;
pub(crate) mod vertex;

pub use level_report::LevelReport;
pub(crate) use multigrid::{PaperResult, solve};
pub use options::{Estimate, PaperOptions};
