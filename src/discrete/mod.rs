//! Discrete operators on the region (paper sections 5, 6, 7.3).
