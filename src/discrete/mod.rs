//! Discrete operators on the region (paper sections 5, 6 and 7.3).
//!
//! Sign convention, here and everywhere: with outward normals the mean curvature `H` is negative on a sphere
//! (paper (8)), and `(S f)_i = sum_j w_ij (f_i - f_j)` is the negative of the Laplacian (paper (6), (7)).

pub mod boundary_normals;
pub mod curvature;
pub mod eight_ring_fit;
pub mod equations;
pub mod inner_fairness;
mod inner_residual;
pub mod laplace_beltrami;
pub mod low_valence;
pub mod mesh_curvature;
pub mod normals;
pub mod outer_fairness;
pub mod outside_fit;
pub mod paper_curvature;
pub mod ring_edges;
pub mod simd;
pub mod smooth_interior;
pub mod target;
pub mod valence_batches;
