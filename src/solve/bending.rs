//! A discrete bending energy with a barrier against slivers and folds.
//!
//! E = sum over edges `psi^2 |e|^2 / (|N_1| + |N_2|)` + mu sum over triangles `Q`: `psi` is twice the tangent of half the angle between the
//! triangles on both sides, infinite where they lie on each other, and `N` a vector across each, twice as long as its area (E. Grinspun et al.,
//! "Discrete shells", 2003). Along the boundary the prescribed normals stand for the triangles outside, mirrored. `Q` is the conformal
//! distortion of a triangle (K. Hormann, G. Greiner, "MIPS", 2000): 0 for one of the shape that connectivity gives it, and infinite for one
//! without area. Neither sum has a unit.

use fairmesh_linear::parallel;
use nalgebra::Vector3;

use super::domain::Domain;
use crate::mesh::halfedge::NONE;

/// The energy of a region between boundary data.
pub(crate) struct Bending<'a> {
    domain: &'a Domain,
    boundary_normals: &'a [Vector3<f64>],
    /// Of each triangle, opposite to each edge, the cotangent of the angle that it should have.
    cotangents: Vec<[f64; 3]>,
    /// The weight mu.
    distortion: f64,
}

/// A triangle: the vector across it and its length.
#[derive(Debug, Clone, Copy)]
struct Across {
    unit: Vector3<f64>,
    length: f64,
}

impl<'a> Bending<'a> {
    /// The energy between these boundary normals, with this weight of the distortion.
    pub(crate) fn new(domain: &'a Domain, boundary_normals: &'a [Vector3<f64>], distortion: f64) -> Self {
        let equilateral = [1.0 / 3f64.sqrt(); 3];
        let cotangents = match &domain.lengths {
            None => vec![equilateral; domain.region.triangles().len()],
            Some(lengths) => lengths.iter().map(cotangents).collect(),
        };
        Self {
            domain,
            boundary_normals,
            cotangents,
            distortion,
        }
    }

    /// The energy of the surface `x`, and its gradient at the free vertices.
    pub(crate) fn evaluate(&self, x: &[Vector3<f64>], gradient: &mut [[f64; 3]]) -> f64 {
        let across = self.across(x);
        let parts = parallel::map_each(across.len(), parallel::RUN, |t| {
            self.triangle(t as u32, x, &across)
        });
        gradient.fill([0.0; 3]);
        let mut energy = 0.0;
        for (triangle, (part, corners)) in self.domain.region.triangles().iter().zip(&parts) {
            energy += part;
            for (&v, corner) in triangle.iter().zip(corners) {
                if let Some(g) = gradient.get_mut(v as usize) {
                    (0..3).for_each(|c| g[c] += corner[c]);
                }
            }
        }
        energy
    }

    /// The first sum alone.
    pub(crate) fn bends(&self, x: &[Vector3<f64>]) -> f64 {
        let across = self.across(x);
        let parts = parallel::map_each(across.len(), parallel::RUN, |t| {
            let corners = self.domain.region.half_edges.triangles[t].map(|v| x[v as usize]);
            let halves = (0..3).filter_map(|k| {
                let edge = corners[(k + 1) % 3] - corners[k];
                let bend = self.bend((3 * t + k) as u32, &edge, &across[t], &across)?;
                Some(0.5 * bend.psi * bend.psi * edge.norm_squared() / bend.areas)
            });
            halves.sum::<f64>()
        });
        parts.iter().sum()
    }

    /// Across each triangle of the region.
    fn across(&self, x: &[Vector3<f64>]) -> Vec<Across> {
        let triangles = self.domain.region.triangles();
        parallel::map_each(triangles.len(), parallel::RUN, |t| {
            let [a, b, c] = triangles[t].map(|v| x[v as usize]);
            Across::new((b - a).cross(&(c - a)))
        })
    }

    /// What the triangle `t` has of the energy, with half of each of its edges, and its part of the gradient at its corners: also what
    /// its neighbours' halves gain by its corners.
    fn triangle(&self, t: u32, x: &[Vector3<f64>], across: &[Across]) -> (f64, [Vector3<f64>; 3]) {
        let corners = self.domain.region.half_edges.triangles[t as usize].map(|v| x[v as usize]);
        let own = across[t as usize];
        let (mut energy, mut gradient) = (0.0, [Vector3::zeros(); 3]);
        let cotangents = &self.cotangents[t as usize];
        let mut squares = 0.0;
        // What the energy answers to a larger area of this triangle, all else alike.
        let mut of_area = 0.0;
        for k in 0..3 {
            let (l, r) = (k, (k + 1) % 3);
            let edge = corners[r] - corners[l];
            let square = edge.norm_squared();
            squares += cotangents[k] * square;
            let bend = self.bend(3 * t + k as u32, &edge, &own, across);
            let Some(bend) = bend else { continue };
            // Half of the edge's energy is this triangle's, all of what its corner opposite does is its own.
            let weight = square / bend.areas;
            let part = bend.psi * bend.psi * weight;
            energy += 0.5 * part;
            of_area -= part / bend.areas;
            let along = (corners[(k + 2) % 3] - corners[l]).dot(&edge) / square;
            let turn = own.unit * (-2.0 * bend.psi * bend.slope * weight * square.sqrt() / own.length);
            gradient[(k + 2) % 3] += turn;
            gradient[l] -= turn * (1.0 - along);
            gradient[r] -= turn * along;
            let stretch = edge * (bend.psi * bend.psi / bend.areas);
            gradient[l] -= stretch;
            gradient[r] += stretch;
        }
        let distortion = squares / (2.0 * own.length);
        energy += self.distortion * (distortion - 1.0);
        of_area -= self.distortion * distortion / own.length;
        for k in 0..3 {
            let (l, r) = ((k + 1) % 3, (k + 2) % 3);
            let opposite = corners[r] - corners[l];
            gradient[k] += own.unit.cross(&opposite) * of_area;
            // The edges from this corner, each opposite to the third one.
            let to =
                |other: usize, c: f64| (corners[k] - corners[other]) * (self.distortion * c / own.length);
            gradient[k] += to(l, cotangents[k]) + to(r, cotangents[r]);
        }
        (energy, gradient)
    }

    /// How the surface bends at the half-edge `h`, along `edge`, of the triangle `own`.
    fn bend(&self, h: u32, edge: &Vector3<f64>, own: &Across, across: &[Across]) -> Option<Bend> {
        let half_edges = &self.domain.region.half_edges;
        let o = half_edges.opposite[h as usize];
        if o != NONE && half_edges.in_region(o) {
            let other = across[o as usize / 3];
            let half = half_tangent(edge, &own.unit, &other.unit);
            return Some(Bend {
                psi: 2.0 * half,
                slope: 1.0 + half * half,
                areas: own.length + other.length,
            });
        }
        let free = self.domain.region.free;
        let [a, b] =
            [half_edges.origin(h), half_edges.target(h)].map(|v| self.boundary_normals[v as usize - free]);
        let direction = edge.try_normalize(0.0)?;
        let sum = a + b;
        let normal = (sum - direction * sum.dot(&direction)).try_normalize(1e-9)?;
        let half = half_tangent(edge, &own.unit, &normal);
        // Mirrored, the surface bends by twice as much; half of that edge is this side's.
        Some(Bend {
            psi: 4.0 * half,
            slope: 1.0 + half * half,
            areas: 2.0 * own.length,
        })
    }
}

/// How a surface bends at an edge.
struct Bend {
    /// Twice the tangent of half the angle between the triangles on both sides,
    psi: f64,
    /// and its derivative by that angle.
    slope: f64,
    /// Twice the area of both.
    areas: f64,
}

impl Across {
    fn new(vector: Vector3<f64>) -> Self {
        let length = vector.norm().max(f64::MIN_POSITIVE);
        Self {
            unit: vector / length,
            length,
        }
    }
}

/// The tangent of half the angle by which one unit vector is turned from another one, positive counter-clockwise seen against `axis`.
fn half_tangent(axis: &Vector3<f64>, from: &Vector3<f64>, to: &Vector3<f64>) -> f64 {
    let sine = from.cross(to).dot(axis) / axis.norm();
    sine / (1.0 + from.dot(to)).max(f64::EPSILON)
}

/// The cotangents of a triangle's angles, each of that opposite to the edge of this length.
fn cotangents(lengths: &[f64; 3]) -> [f64; 3] {
    let [a, b, c] = lengths.map(|l| l * l);
    // Heron's formula: 16 times the squared area.
    let sixteen = 2.0 * (a * b + b * c + c * a) - (a * a + b * b + c * c);
    if sixteen <= 0.0 {
        return [1.0 / 3f64.sqrt(); 3];
    }
    let area = sixteen.sqrt();
    [(b + c - a) / area, (c + a - b) / area, (a + b - c) / area]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{RegionMesh, Selection};
    use fairmesh_shapes::{OUTSIDE, Sampling, sphere_cap};

    fn cap() -> Domain {
        let shape = sphere_cap(60.0, 200, Sampling::Irregular { seed: 3 }, OUTSIDE);
        let region =
            RegionMesh::new(&shape.positions, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
        let x = region.positions(&shape.positions);
        Domain::new(region, x)
    }

    #[test]
    fn the_gradient_is_that_of_the_energy() {
        let domain = cap();
        let normals = domain.surface()[domain.region.free..].to_vec();
        let bending = Bending::new(&domain, &normals, 8e-3);
        let mut x = domain.surface().to_vec();
        for (k, x) in x[..domain.region.free].iter_mut().enumerate() {
            let k = k as f64;
            *x += 0.02 * Vector3::new(libm::sin(3.0 * k), libm::sin(5.0 * k), libm::sin(7.0 * k));
        }
        let mut gradient = vec![[0.0; 3]; domain.region.free];
        bending.evaluate(&x, &mut gradient);
        let mut unused = gradient.clone();
        for v in [0, 17, 150] {
            for c in 0..3 {
                let mut energy = |step: f64| {
                    let mut x = x.clone();
                    x[v][c] += step;
                    bending.evaluate(&x, &mut unused)
                };
                let difference = (energy(1e-6) - energy(-1e-6)) / 2e-6;
                let told = gradient[v][c];
                assert!(
                    (difference - told).abs() < 1e-6 * (1.0 + told.abs()),
                    "{v}, {c}: {difference}, {told}"
                );
            }
        }
    }
}
