//! Where the surface folds: edges at which it bends by more than its own curvature accounts for.
//!
//! Where no normal curvature exceeds `kappa`, the normal of an inscribed triangle is off that of the surface at its corners by no more
//! than `kappa` times its circumradius (to first order), so that two triangles side by side meet at an angle of at most
//! `kappa (R_1 + R_2)`. A single vertex that stands off is seen by the fit around it as curvature as well, which may meet the
//! equations exactly; but not by those farther off. So `kappa` is the median of the larger principal curvatures around an edge.
//!
//! A vertex that stands off folds at more than one of its edges; a single one, which is not sharp, is at a corner of the boundary.
//! No edge is a fold that is hardly sharper than those of the surroundings, or than boundary normals that are turned against them ask for: beside
//! creases and noise no surface is without.

use fairmesh_linear::parallel;
use nalgebra::Vector3;

use super::SurfaceState;
use super::crease::EXCESS;
use crate::discrete::boundary_normals::{angle, average};
use crate::mesh::Rings;
use crate::mesh::halfedge::NONE;

/// An edge bends by no more than so many times what its curvature accounts for. Of 142 bands of stretched irregular triangles whose surface
/// is known, 4 have a vertex that stands off it by 30 and more times what is usual; edges there bend by 3 to 6.5 times as much, and
/// by less than 1.2 times on all others.
/// Of 2,031 regions of 94 public meshes and 286 bands, half: 11 and 2 more are refused; double: none fewer, and a band is a success that stands off
/// by 2e-3 of the diagonal, ten times the next.
const EXPLAINED: f64 = 2.0;
/// What bends more, in degrees, is a fold whatever its curvature: that is not resolved.
/// Half: 1 of the regions more is refused; double: 2 of the bands are successes with edges of 77 degrees where the surface has 25.
const SHARP: f64 = 75.0;

/// A fold is sharper than the surroundings by more than this factor: beside a spike of 60 degrees a region of four vertices bends by 66.
/// At 1 that region is refused; with 15 degrees more in its place, 3 of 70 bands are successes that stand off by a hundredth of the radius.
const SHARPER: f64 = 1.15;

/// A surface, and what is around it.
pub(crate) struct Folds<'a> {
    pub surface: &'a SurfaceState<'a>,
    /// Gaussian curvature at free vertices.
    pub k: &'a [f64],
    pub rings: &'a Rings,
    /// The positions of all local vertices, as they came.
    pub input: &'a [Vector3<f64>],
}

impl Folds<'_> {
    /// A half-edge of each edge that is a fold, ascending.
    pub(crate) fn found(&self) -> Vec<u32> {
        let count = 3 * self.surface.region.half_edges.region_triangles;
        // Of the least angle of a fold; most edges bend less.
        let usual = libm::cos(EXCESS.to_radians());
        let mut found = parallel::map(parallel::runs(count, parallel::RUN), |_, run| {
            let run = run.map(|h| h as u32);
            run.filter(|&h| self.may_fold(h, usual)).collect::<Vec<_>>()
        })
        .concat();
        if !found.is_empty() {
            let least = (SHARPER * self.sharpest_outside()).max(self.asked() + EXCESS);
            found.retain(|&h| self.bend(h) > least);
            let mut ends: Vec<u32> = found.iter().flat_map(|&h| self.free_ends(h)).collect();
            ends.sort_unstable();
            let is_shared = |v| ends.partition_point(|&e| e <= v) - ends.partition_point(|&e| e < v) > 1;
            found.retain(|&h| self.bend(h) > SHARP || self.free_ends(h).any(is_shared));
        }
        found
    }

    /// The half-edge of the edge that bends most, and by how many degrees; none if the region has no edge inside or at its rim.
    pub(crate) fn sharpest(&self) -> Option<(u32, f64)> {
        let count = 3 * self.surface.region.half_edges.region_triangles;
        let sharper = |a: (u32, f64), b: (u32, f64)| if b.1 < a.1 { b } else { a };
        let found = parallel::map(parallel::runs(count, parallel::RUN), |_, run| {
            let edges = run.map(|h| h as u32).filter(|&h| self.is_first_of_moving(h));
            edges.map(|h| (h, self.cosine(h))).reduce(sharper)
        });
        let (h, _) = found.into_iter().flatten().reduce(sharper)?;
        Some((h, self.bend(h)))
    }

    /// Whether it stands for an edge beside a free vertex. Of two half-edges in the region the first one does; one outside is behind all of
    /// them.
    fn is_first_of_moving(&self, h: u32) -> bool {
        let o = self.opposite(h);
        o != NONE && o >= h && (self.moves(h) || self.moves(o))
    }

    /// The cosine of the angle at an edge; 1 if a triangle has no area.
    fn cosine(&self, h: u32) -> f64 {
        let [a, b] = [h, self.opposite(h)].map(|h| across(&self.corners(h)));
        let cosine = a.dot(&b) / (a.norm_squared() * b.norm_squared()).sqrt();
        if cosine.is_nan() { 1.0 } else { cosine }
    }

    fn free_ends(&self, h: u32) -> impl Iterator<Item = u32> {
        let region = self.surface.region;
        let ends = [region.half_edges.origin(h), region.half_edges.target(h)];
        ends.into_iter().filter(|&v| region.is_free(v))
    }

    /// Whether the half-edge is of an edge that curvature does not account for. `usual` is the cosine of the angle up to which none is.
    fn may_fold(&self, h: u32, usual: f64) -> bool {
        if !self.is_first_of_moving(h) || self.cosine(h) >= usual {
            return false;
        }
        let (o, bend) = (self.opposite(h), self.bend(h));
        !self.is_at_fixed_inside(h, o)
            && (bend > SHARP || self.free_ends(h).next().is_some() && bend > EXPLAINED * self.explained(h, o))
    }

    fn opposite(&self, h: u32) -> u32 {
        self.surface.region.half_edges.opposite[h as usize]
    }

    /// The angle between the triangles on both sides, in degrees.
    fn bend(&self, h: u32) -> f64 {
        let [a, b] = [h, self.opposite(h)].map(|h| across(&self.corners(h)));
        degrees(&a, &b)
    }

    /// The largest angle between a boundary normal and the surroundings, in degrees: the surface is asked to bend there.
    fn asked(&self) -> f64 {
        let free = self.surface.region.free;
        let asked = (0..)
            .zip(self.surface.boundary_normals)
            .filter_map(|(b, normal)| {
                let outside = average(self.input, free + b, self.rings.outside_triangles(b))?;
                Some(degrees(normal, &outside))
            });
        asked.fold(0.0, f64::max)
    }

    /// Whether one of both triangles has a fixed vertex inside the region: there every bend may be asked for.
    fn is_at_fixed_inside(&self, h: u32, o: u32) -> bool {
        let region = self.surface.region;
        let corners = [h, o].map(|h| region.half_edges.corners(h));
        let closed =
            |v: usize| v >= region.free && v < region.region_vertices() && self.rings.closed[v - region.free];
        corners.iter().flatten().any(|&v| closed(v as usize))
    }

    /// The sharpest edge between triangles of the outside ring, as they came, in degrees.
    fn sharpest_outside(&self) -> f64 {
        let half_edges = &self.surface.region.half_edges;
        let outside = 3 * half_edges.region_triangles as u32..half_edges.opposite.len() as u32;
        let edges = outside.filter(|&h| self.opposite(h) != NONE && self.opposite(h) > h);
        edges.map(|h| self.bend(h)).fold(0.0, f64::max)
    }

    /// Whether the half-edge is in a triangle with a free vertex.
    fn moves(&self, h: u32) -> bool {
        let region = self.surface.region;
        region.half_edges.triangles[h as usize / 3]
            .iter()
            .any(|&v| region.is_free(v))
    }

    fn corners(&self, h: u32) -> [Vector3<f64>; 3] {
        let x = self.surface.x;
        let at = |v: u32| *x.get(v as usize).unwrap_or(&self.input[v as usize]);
        self.surface.region.half_edges.corners(h).map(at)
    }

    /// The angle that curvature accounts for, in degrees.
    fn explained(&self, h: u32, o: u32) -> f64 {
        let half_edges = &self.surface.region.half_edges;
        let ends = [half_edges.origin(h), half_edges.target(h)];
        let kappa = ends
            .map(|v| self.median_curvature(v))
            .into_iter()
            .fold(0.0, f64::max);
        let radii: f64 = [h, o].map(|h| circumradius(&self.corners(h))).iter().sum();
        (kappa * radii).to_degrees()
    }

    /// The median of the larger principal curvatures, in absolute value, at the vertices within two edges; of those on the boundary the mean
    /// curvature stands for it.
    fn median_curvature(&self, v: u32) -> f64 {
        let mut around = vec![v];
        for _ in 0..2 {
            let next: Vec<u32> = around
                .iter()
                .flat_map(|&u| self.rings.neighbours(u as usize).iter().copied())
                .collect();
            around.extend(next);
            around.sort_unstable();
            around.dedup();
        }
        let larger = |&u: &u32| {
            let h = self.surface.h[u as usize];
            let difference = self
                .k
                .get(u as usize)
                .map_or(0.0, |k| (h * h - k).max(0.0).sqrt());
            h.abs() + difference
        };
        let mut kappa: Vec<f64> = around.iter().map(larger).collect();
        kappa.sort_unstable_by(f64::total_cmp);
        kappa.get(kappa.len() / 2).copied().unwrap_or(0.0)
    }
}

/// The vector across a triangle, twice as long as its area.
fn across([a, b, c]: &[Vector3<f64>; 3]) -> Vector3<f64> {
    (b - a).cross(&(c - a))
}

/// The angle between two vectors; 0 if one has no length.
fn degrees(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    let degrees = angle(a, b).to_degrees();
    if degrees.is_finite() { degrees } else { 0.0 }
}

/// The radius of the circle through the corners of a triangle; infinite where it has no area.
fn circumradius([a, b, c]: &[Vector3<f64>; 3]) -> f64 {
    let sides = (b - a).norm() * (c - b).norm() * (a - c).norm();
    sides / (2.0 * across(&[*a, *b, *c]).norm())
}
