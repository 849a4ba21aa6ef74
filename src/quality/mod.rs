//! Is the result sound: triangles, normals, extent.

pub(crate) mod crease;
pub(crate) mod folds;

use fairmesh_linear::parallel;
use nalgebra::Vector3;

use crate::discrete::boundary_normals::{angle, average};
use crate::mesh::{RegionMesh, Rings};

/// An angle below this makes a triangle a needle, in degrees.
/// Of 128 cases, half: none changes; double: 1 changes, 1 get another triangulation.
pub(crate) const NEEDLE: f64 = 1.0;

/// A boundary deviation beyond this many degrees and this many times the rms is a bump. Rough scans reach 5 times.
/// Half or double, of 128 cases: none changes.
const DETACHED_DEGREES: f64 = 15.0;
/// See [`DETACHED_DEGREES`].
/// Of 45 cases, half: 0 change, 1 fails; double: none changes.
const DETACHED_RATIO: f64 = 8.0;

/// Figures of the faired region, all measured on the result. Triangles and vertices by the caller's numbers.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Quality {
    /// The smallest angle of the region's triangles, in degrees.
    pub worst_angle: f64,
    /// The triangle that has it.
    pub worst_triangle: usize,
    /// The largest angle, in degrees, between two triangles side by side of which one has a free vertex: inside, or at the rim.
    pub sharpest_edge: f64,
    /// The ends of their edge.
    pub sharpest_edge_vertices: [usize; 2],
    /// Triangles whose normal points away from the sum of their vertices' normals.
    pub flipped: Vec<u32>,
    /// Triangles with an angle below one degree.
    pub needles: Vec<u32>,
    /// The smallest and largest mean curvature at free vertices.
    pub h_inside: [f64; 2],
    /// The smallest and largest mean curvature at boundary vertices.
    pub h_boundary: [f64; 2],
    /// The largest angle, in degrees, between a prescribed boundary normal and the area-weighted mean normal of the
    /// region's triangles there. On a smooth surface it falls in proportion to the edge length.
    pub normal_deviation: f64,
    /// The boundary vertex that has it.
    pub normal_deviation_vertex: usize,
    /// The root mean square of those angles, in degrees.
    pub normal_deviation_rms: f64,
    /// The bending energy, the integral of `H^2` over the free vertices, each with a third of its 1-disk; without unit. Of the solver's
    /// surface, before it is rounded.
    pub bending_energy: f64,
    /// The largest kink, in degrees: the angle at a boundary vertex between the area-weighted mean normals of the region's
    /// triangles and of those outside; where nothing is outside, between the former and the boundary normal.
    pub boundary_kink: f64,
    /// The boundary vertex that has it; of a surface with a boundary crease, the worst one of the crease.
    pub boundary_kink_vertex: usize,
    /// The kink of the input at this vertex.
    pub boundary_kink_before: f64,
}

impl Quality {
    /// No folded triangle and no needle.
    pub fn is_sound(&self) -> bool {
        self.flipped.is_empty() && self.needles.is_empty()
    }

    /// The worse of these figures and those of a surface beside it, but for lists, sums and means.
    pub(crate) fn take_worse(&mut self, of: &Self) {
        if of.worst_angle < self.worst_angle {
            (self.worst_angle, self.worst_triangle) = (of.worst_angle, of.worst_triangle);
        }
        if of.sharpest_edge > self.sharpest_edge {
            self.sharpest_edge = of.sharpest_edge;
            self.sharpest_edge_vertices = of.sharpest_edge_vertices;
        }
        if of.normal_deviation > self.normal_deviation {
            self.normal_deviation = of.normal_deviation;
            self.normal_deviation_vertex = of.normal_deviation_vertex;
        }
        if of.boundary_kink > self.boundary_kink {
            self.boundary_kink = of.boundary_kink;
            self.boundary_kink_before = of.boundary_kink_before;
            self.boundary_kink_vertex = of.boundary_kink_vertex;
        }
        let wider = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        self.h_inside = wider(self.h_inside, of.h_inside);
        self.h_boundary = wider(self.h_boundary, of.h_boundary);
    }

    /// The folded triangles and the needles, ascending.
    pub(crate) fn poor(&self) -> Vec<u32> {
        let mut poor = [&self.flipped[..], &self.needles].concat();
        poor.sort_unstable();
        poor.dedup();
        poor
    }
}

/// A surface to be judged: positions of the region's vertices (free, boundary), unit normals and mean curvature there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SurfaceState<'a> {
    /// Connectivity.
    pub region: &'a RegionMesh,
    /// Positions.
    pub x: &'a [Vector3<f64>],
    /// Normals of the surface at free vertices.
    pub normals: &'a [Vector3<f64>],
    /// Prescribed normals at boundary vertices.
    pub boundary_normals: &'a [Vector3<f64>],
    /// Mean curvature, free then boundary; may be empty.
    pub h: &'a [f64],
}

/// The tangent of an angle in degrees.
fn tangent(degrees: f64) -> f64 {
    libm::tan(degrees.to_radians())
}

/// The worst angle of a triangle in degrees.
pub(crate) fn smallest_angle(p: &[Vector3<f64>; 3]) -> f64 {
    let edge = [0, 1, 2].map(|i| p[(i + 2) % 3] - p[(i + 1) % 3]);
    let length = edge.map(|e| e.norm_squared());
    // It is opposite to the shortest edge.
    let i = (0..3)
        .min_by(|&a, &b| length[a].total_cmp(&length[b]))
        .unwrap_or(0);
    let smallest = angle(&edge[(i + 2) % 3], &-edge[(i + 1) % 3]).to_degrees();
    if smallest.is_finite() { smallest } else { 0.0 }
}

impl SurfaceState<'_> {
    fn normal(&self, v: u32) -> Vector3<f64> {
        let v = v as usize;
        if v < self.region.free {
            self.normals[v]
        } else {
            self.boundary_normals[v - self.region.free]
        }
    }

    /// Whether a region triangle is folded, and the tangent of its smallest angle. `None` where it has not moved: those of fixed
    /// vertices alone are as they came.
    fn judged(&self, corners: &[u32; 3]) -> Option<(bool, f64)> {
        if !corners.iter().any(|&v| self.region.is_free(v)) {
            return None;
        }
        let [a, b, c] = corners.map(|v| self.x[v as usize]);
        let cross = (b - a).cross(&(c - a));
        let sum: Vector3<f64> = corners.iter().map(|&v| self.normal(v)).sum();
        // What is not a number counts as folded.
        let side = cross.dot(&sum);
        let folded = side < 0.0 || side.is_nan();
        // The smallest angle is opposite to the shortest edge; the law of cosines does not cancel there.
        let squares = [a - b, b - c, c - a].map(|edge| edge.norm_squared());
        let shortest = squares[0].min(squares[1]).min(squares[2]);
        let tangent = 2.0 * cross.norm() / (squares[0] + squares[1] + squares[2] - 2.0 * shortest);
        Some((folded, if tangent.is_finite() { tangent } else { 0.0 }))
    }

    /// All figures.
    pub(crate) fn quality(&self) -> Quality {
        let free = self.region.free;
        let mut quality = Quality::default();
        let (mut worst, needle) = (f64::INFINITY, tangent(NEEDLE));
        for (corners, &id) in self
            .region
            .triangles()
            .iter()
            .zip(&self.region.half_edges.triangle_ids)
        {
            let Some((folded, tangent)) = self.judged(corners) else {
                continue;
            };
            if tangent < worst {
                worst = tangent;
                quality.worst_triangle = id as usize;
            }
            if folded {
                quality.flipped.push(id);
            }
            if tangent < needle {
                quality.needles.push(id);
            }
        }
        quality.worst_angle = libm::atan(worst).to_degrees();
        if self.h.len() == self.x.len() {
            quality.h_inside = range(&self.h[..free]);
            quality.h_boundary = range(&self.h[free..]);
        }
        let mut squares = 0.0;
        for (b, degrees) in self.normal_deviations().into_iter().enumerate() {
            squares += degrees * degrees;
            if degrees > quality.normal_deviation {
                quality.normal_deviation = degrees;
                quality.normal_deviation_vertex = self.region.vertex_ids[free + b] as usize;
            }
        }
        quality.normal_deviation_rms = (squares / self.region.boundary.max(1) as f64).sqrt();
        quality
    }

    /// Region triangles (local numbers) that are folded or have an angle below `degrees`.
    pub(crate) fn poor(&self, degrees: f64) -> Vec<u32> {
        let least = tangent(degrees);
        let is_poor = |corners| {
            let judged = self.judged(corners);
            judged.is_some_and(|(folded, tangent)| folded || tangent < least)
        };
        let triangles = self.region.triangles();
        parallel::map(parallel::runs(triangles.len(), parallel::RUN), |_, run| {
            let poor = run.filter(|&t| is_poor(&triangles[t]));
            poor.map(|t| t as u32).collect::<Vec<_>>()
        })
        .concat()
    }

    /// Whether single boundary vertices deviate from their normals far more than the rest.
    pub(crate) fn is_detached_from_normals(&self) -> bool {
        let deviations = self.normal_deviations();
        let mean = deviations.iter().map(|d| d * d).sum::<f64>() / deviations.len().max(1) as f64;
        let worst = deviations.iter().copied().fold(0.0, f64::max);
        worst > DETACHED_DEGREES && worst > DETACHED_RATIO * mean.sqrt()
    }

    /// Boundary vertices (the caller's numbers) whose normal points against the triangles outside, as they came in `input`,
    /// or against those of the region on this surface; and of two neighbours on the boundary with opposite normals the one
    /// that stands farther off this surface. Any of them is probably flipped: the equations alone do not tell (paper
    /// 6.1).
    pub(crate) fn suspicious_normals(&self, rings: &Rings, input: &[Vector3<f64>]) -> Vec<u32> {
        let (free, normals) = (self.region.free, self.boundary_normals);
        let deviations = self.normal_deviations();
        let mut marked: Vec<bool> = (0..self.region.boundary)
            .map(|b| {
                let outside = self.final_outside(rings, input, b);
                outside.is_some_and(|o| o.dot(&normals[b]) < 0.0) || deviations[b] > 90.0
            })
            .collect();
        for &h in &rings.boundary_half_edges {
            let a = self.region.half_edges.origin(h) as usize - free;
            let b = self.region.half_edges.target(h) as usize - free;
            if normals[a].dot(&normals[b]) < 0.0 {
                marked[if deviations[a] > deviations[b] { a } else { b }] = true;
            }
        }
        let ids = &self.region.vertex_ids[free..];
        (0..self.region.boundary)
            .filter(|&b| marked[b])
            .map(|b| ids[b])
            .collect()
    }

    /// The mean normal of the outside at a boundary vertex, as far as it stays where it is.
    pub(crate) fn final_outside(
        &self,
        rings: &Rings,
        input: &[Vector3<f64>],
        b: usize,
    ) -> Option<Vector3<f64>> {
        let (v, moves) = (self.region.free + b, &self.region.moves_elsewhere);
        let outside = rings.outside_triangles(b);
        if moves.is_empty() {
            return average(input, v, outside);
        }
        let stays = |t: &&[u32; 2]| !t.iter().any(|&j| moves[j as usize]);
        let staying: Vec<[u32; 2]> = outside.iter().filter(stays).copied().collect();
        average(input, v, &staying)
    }

    /// Per boundary vertex the angle in degrees between its prescribed normal and the sum of its region triangles' cross
    /// products.
    pub(crate) fn normal_deviations(&self) -> Vec<f64> {
        let free = self.region.free;
        let half_edges = &self.region.half_edges;
        let mut sums = vec![Vector3::zeros(); self.region.boundary];
        let triangles = half_edges.triangles[..half_edges.region_triangles].iter();
        for corners in triangles.filter(|corners| corners.iter().any(|&v| v as usize >= free)) {
            let p = corners.map(|v| self.x[v as usize]);
            let cross = (p[1] - p[0]).cross(&(p[2] - p[0]));
            for &v in corners {
                if v as usize >= free {
                    sums[v as usize - free] += cross;
                }
            }
        }
        sums.iter()
            .zip(self.boundary_normals)
            .map(|(s, n)| angle(s, n).to_degrees())
            .collect()
    }
}

fn range(values: &[f64]) -> [f64; 2] {
    values
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &v| {
            [low.min(v), high.max(v)]
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smallest_angle_of_known_triangles() {
        let p = |x: f64, y: f64| Vector3::new(x, y, 0.0);
        assert_near!(smallest_angle(&[p(0., 0.), p(1., 0.), p(0., 1.)]), 45.0, 1e-12);
        assert_near!(
            smallest_angle(&[p(0., 0.), p(1., 0.), p(0.5, 0.75f64.sqrt())]),
            60.0,
            1e-12
        );
        assert_below!(smallest_angle(&[p(0., 0.), p(1., 0.), p(2., 0.)]), 1e-12);
        assert_eq!(smallest_angle(&[p(f64::NAN, 0.), p(1., 0.), p(2., 0.)]), 0.0);
    }
}
