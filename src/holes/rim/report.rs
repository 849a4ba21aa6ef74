//! What became of the rim of a patch.

/// Noise is everywhere along a loop: the median of its square is more than this part of the mean. Nostrils at the rim of a face had .13, noise
/// and voxels .97 to 1.02.
/// Of 4 cases, half: none changes; double: 1 changes.
pub(super) const EVEN: f64 = 0.5;

/// What became of the rim of a patch.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RimReport {
    /// How many vertices moved.
    pub moved: usize,
    /// How far, root mean square.
    pub rms: f64,
    /// How far the one that moved furthest did.
    pub largest: f64,
    /// The bound: no vertex moved further, but for rounding.
    pub within: f64,
    /// How many would have moved further.
    pub bounded: usize,
    /// How many triangles at vertices that moved are folded all the same, those of the patch at the loop counted.
    pub folded: usize,
    /// The distance of the mesh around from the surfaces fitted to it, root mean square.
    pub noise: f64,
    /// The median of the square of that along the loops over its mean: about 1 where it is everywhere. Well below 1 it is
    /// [likely](Self::is_even) that a feature of the surface was taken for noise.
    pub evenness: f64,
    /// These look at what is nearer than this. 0: nothing could be fitted, and no vertex moved.
    pub radius: f64,
    /// Pairs of the mesh's triangles, not of the patch, that intersect since vertices moved, the smaller number first, ascending. Not looked
    /// for if the fairing's [`Options::intersections`](crate::Options::intersections) says so.
    pub self_intersections: Vec<[u32; 2]>,
}

impl RimReport {
    /// Whether the noise is everywhere along the loops, or nothing was fitted.
    pub fn is_even(&self) -> bool {
        self.radius == 0.0 || self.evenness > EVEN
    }

    /// Whether nothing is amiss: no triangle is folded, and none intersects another.
    pub fn is_sound(&self) -> bool {
        self.folded == 0 && self.self_intersections.is_empty()
    }
}
