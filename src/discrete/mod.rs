//! Discrete operators on the region (paper sections 5, 6 and 7.3).
//!
//! Sign convention, here and everywhere: with outward normals the mean curvature `H` is negative on a sphere
//! (paper (8)), and `(S f)_i = sum_j w_ij (f_i - f_j)` is the negative of the Laplacian (paper (6), (7)).

pub mod border_normals;
pub mod curvature;
pub mod equations;
pub mod groups;
pub mod inner_fairness;
mod inner_residual;
pub mod lanes;
pub mod laplace_beltrami;
pub mod low_valence;
pub mod mesh_curvature;
pub mod normals;
pub mod outer_fairness;
pub mod outside_fit;
pub mod paper_curvature;
pub mod passing;
pub mod spokes;
pub mod target;
pub mod wide_fit;
