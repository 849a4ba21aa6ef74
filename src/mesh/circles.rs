//! Circles around the vertices of a region that touch their neighbours': lengths of edges by connectivity alone.

use super::Rings;

/// Sweeps over the radii, after those for equal ones.
/// Of 9 cases, half: 9 change by up to 0.3 edges, +4 % iterations; double: 9 change by up to 0.2 edges, +5 % iterations.
const SWEEPS: usize = 4;

/// Radii of circles around the vertices of a region that touch their neighbours', about: then all edges are as alike as they can
/// be on a flat surface, whatever the valences. Those of the boundary are 1. (C. Collins, K. Stephenson, "A circle packing
/// algorithm", Computational Geometry 25, 2003; a few sweeps, which settle neighbours among themselves. The sines of half the angles
/// take the angles' place: they need no more than roots.)
pub(crate) fn circles(rings: &Rings) -> Vec<f64> {
    let widest = (0..rings.free()).map(|i| rings.ring(i).len()).max();
    // By valence, the sine of half the angle between two neighbours where all of them are alike.
    let full: Vec<f64> = (0..=widest.unwrap_or(0))
        .map(|m| libm::sin(std::f64::consts::PI / m as f64))
        .collect();
    let mut radius = vec![1.0f64; rings.free() + rings.boundary()];
    for (i, r) in radius[..rings.free()].iter_mut().enumerate() {
        let full = full[rings.ring(i).len()];
        *r = (1.0 - full) / full;
    }
    for _ in 0..SWEEPS {
        for i in 0..rings.free() {
            let ring = rings.ring(i);
            let own = radius[i];
            // The sine of half the angle between two neighbours is the product of their parts.
            let part = |j: u32| (radius[j as usize] / (own + radius[j as usize])).sqrt();
            let mut before = part(ring[ring.len() - 1]);
            let mut sum = 0.0;
            for &j in ring {
                let this = part(j);
                sum += before * this;
                before = this;
            }
            let (now, full) = (sum / ring.len() as f64, full[ring.len()]);
            radius[i] = own * now / (1.0 - now) * (1.0 - full) / full;
        }
    }
    radius
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{RegionMesh, Selection};
    use fairmesh_shapes::{OUTSIDE, Sampling, cylinder_band};

    /// Six circles of radius 1 touch one of radius 1, and each other.
    #[test]
    fn circles_of_a_lattice_are_all_alike() {
        let shape = cylinder_band(600, Sampling::Regular, OUTSIDE);
        let selection = Selection::Mask(&shape.free);
        let region = RegionMesh::new(&shape.positions, &shape.triangles, selection).unwrap();
        assert_all!(circles(&Rings::new(&region)).iter(), |r| (r - 1.0).abs() < 1e-12);
    }
}
