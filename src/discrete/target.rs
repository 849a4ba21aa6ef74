//! The right-hand side of the outer fairness equation: `Delta_B H = rhs` (paper (4), and 7.5 for the other two).
//!
//! By (5) and `Delta_B f = 2 H n`, `Delta_B f` at a vertex is `-3 / (2 A) (S f)_i`, `A` the area of its 1-disk. So the
//! equation reads `R1_i = (S H)_i + (2 A / 3) rhs_i = 0`: a third of the disk belongs to the vertex, and `S` is made of
//! twice the weights of the Dirichlet form.

use super::simd::Simd;
use crate::support::table::table;

/// What the Laplacian of the mean curvature has to be: `Delta_B H = rhs` in the interior.
///
/// Signs: with outward normals `H` is negative on a sphere. Where the triangles run the other way round, normals and
/// `H` change sign. [`Target::Harmonic`] and [`Target::MinimalEnergy`] do not notice; the surface of
/// `Constant(c)` is then that of `Constant(-c)` before.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Target {
    /// `Delta_B H = 0` (paper (4)): reproduces spheres, cylinders and every surface of constant mean curvature.
    #[default]
    Harmonic,
    /// `Delta_B H = c`. The unit of `c` is 1 / length^3 in that of the positions; what counts is `|c| L^3`, `L` the
    /// region's diagonal: up to about 20 is moderate. A positive `c` pushes the surface out along its normals, as a load
    /// does a clamped plate; a negative one pulls it in.
    Constant(f64),
    /// `Delta_B H = -2 H (H^2 - K)`, the Euler-Lagrange equation of the total curvature (paper (1)): surfaces of
    /// minimal energy. Reproduces spheres and minimal surfaces, but not cylinders.
    MinimalEnergy,
}

table!(Target {
    0 "harmonic" Target::Harmonic => "zero: spheres, cylinders and all surfaces of constant mean curvature are kept", "";
    1 "constant" Target::Constant(_) =>
        "the constant, in 1 / length^3: a positive one pushes the surface out along its normals", "";
    2 "minimal_energy" Target::MinimalEnergy => "-2 H (H^2 - K): minimal total curvature", "";
});

impl Target {
    /// The right-hand side in a frame whose unit of length is `scale` of the input's: lengths are divided by it.
    pub(crate) fn right_hand_side(self, scale: f64) -> RightHandSide {
        let (constant, energy) = match self {
            Target::Harmonic => (0.0, 0.0),
            Target::Constant(c) => (c * scale * scale * scale, 0.0),
            Target::MinimalEnergy => (0.0, 1.0),
        };
        RightHandSide { constant, energy }
    }
}

/// `rhs = constant - 2 energy H (H^2 - K)`, the sum of both inhomogeneous right-hand sides; zero by default.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct RightHandSide {
    /// The constant, in 1 / length^3.
    pub constant: f64,
    /// Factor of the minimal-energy term, 1 for surfaces of minimal energy.
    pub energy: f64,
}

impl RightHandSide {
    /// Whether the equation is the homogeneous one.
    pub(crate) fn is_zero(&self) -> bool {
        self.constant == 0.0 && self.energy == 0.0
    }

    /// A part of it, as on the way from the harmonic surface.
    pub(crate) fn share(&self, part: f64) -> Self {
        Self {
            constant: self.constant * part,
            energy: self.energy * part,
        }
    }

    #[cfg(test)]
    /// `rhs` at a vertex with these mean and Gaussian curvatures.
    pub(crate) fn at(&self, h: f64, k: f64) -> f64 {
        self.at_lanes(Simd([h]), Simd([k])).0[0]
    }

    /// `(2 A / 3) rhs`, the summand of `R1` at a vertex with 1-disk of area `area`.
    pub(crate) fn load(&self, h: f64, k: f64, area: f64) -> f64 {
        self.load_lanes(Simd([h]), Simd([k]), Simd([area])).0[0]
    }

    #[inline(always)]
    fn at_lanes<const L: usize>(&self, h: Simd<L>, k: Simd<L>) -> Simd<L> {
        Simd::splat(self.constant) - h * (h * h - k) * (2.0 * self.energy)
    }

    /// [`Self::load`] of several vertices.
    #[inline(always)]
    pub(crate) fn load_lanes<const L: usize>(&self, h: Simd<L>, k: Simd<L>, area: Simd<L>) -> Simd<L> {
        self.at_lanes(h, k) * area * (2.0 / 3.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spheres_and_minimal_surfaces_have_no_minimal_energy_load_and_cylinders_do() {
        let energy = Target::MinimalEnergy.right_hand_side(1.0);
        assert_eq!(energy.at(-0.5, 0.25), 0.0);
        assert_eq!(energy.at(0.0, -3.0), 0.0);
        // Radius 1, outward normals: H = -1/2, K = 0.
        assert_eq!(energy.at(-0.5, 0.0), 0.25);
        assert_eq!(energy.load(-0.5, 0.0, 3.0), 0.5);
    }

    #[test]
    fn the_frame_takes_the_unit_away() {
        let at = |c: f64, scale: f64| Target::Constant(c).right_hand_side(scale);
        assert_eq!(at(8.0, 1.0), at(1.0, 2.0));
        assert_eq!(at(1.0, 1.0).share(0.25).at(3.0, -7.0), 0.25);
        assert!(at(0.0, 4.0).is_zero());
        assert!(Target::Harmonic.right_hand_side(2.0).is_zero());
    }
}
