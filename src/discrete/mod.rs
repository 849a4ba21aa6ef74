//! Discrete operators on the region (paper sections 5, 6 and 7.3).
//!
//! Sign convention, here and everywhere: with outward normals the mean curvature `H` is negative on a sphere
//! (paper (8)), and `(S f)_i = sum_j w_ij (f_i - f_j)` is the negative of the Laplacian (paper (6), (7)).

pub(crate) mod boundary_normals;
pub(crate) mod boundary_samples;
pub(crate) mod curvature;
pub(crate) mod eight_ring_fit;
pub(crate) mod equations;
pub(crate) mod inner_fairness;
mod inner_residual;
pub(crate) mod laplace_beltrami;
pub(crate) mod laplacian_load;
pub(crate) mod loop_modes;
pub(crate) mod low_valence;
pub(crate) mod mesh_curvature;
pub(crate) mod normals;
pub(crate) mod one_sided_curvature;
pub(crate) mod outer_fairness;
pub(crate) mod outside_fit;
pub(crate) mod paper_curvature;
pub(crate) mod ring_edges;
pub(crate) mod simd;
mod single_ring;
pub(crate) mod smooth_interior;
pub(crate) mod target;
pub(crate) mod trace;
pub(crate) mod valence_batches;
