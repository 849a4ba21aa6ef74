//! The surface outside of a region: who is whose neighbour, and mean curvatures and normals of vertices.

use std::borrow::Cow;

use nalgebra::Vector3;

use crate::discrete::boundary_samples::BoundarySamples;
use crate::discrete::mesh_curvature::closed_ring_curvature;
use crate::discrete::normals::normals_by_areas;
use crate::mesh::OutsideNeighbours;
use crate::mesh::outside_neighbours::outside_triangles;
use crate::solve::domain::Domain;
use crate::solve::g2::estimator::Around;

/// The surface outside.
pub(in crate::solve) struct Outside<'d> {
    pub domain: &'d Domain,
    pub(super) neighbours: OutsideNeighbours,
    /// Mean curvatures; not a number where there is no closed ring.
    pub(super) h: Vec<f64>,
    /// Normals of vertices, by the areas of their triangles.
    pub(super) normals: Vec<Vector3<f64>>,
}

impl<'d> Outside<'d> {
    /// Of a region. Triangles of another one say nothing of what it will be, though their corners may stand still.
    pub(in crate::solve) fn new(domain: &'d Domain) -> Self {
        let positions: Vec<[f64; 3]> = domain.input.iter().map(|p| (*p).into()).collect();
        let moves = |v: &u32| domain.region.moves_elsewhere.get(*v as usize) == Some(&true);
        let standing = || outside_triangles(&domain.region).filter(move |t| !t.iter().any(moves));
        Self {
            domain,
            neighbours: OutsideNeighbours::new(&domain.region),
            h: closed_ring_curvature(&positions, standing()),
            normals: normals_by_areas(&domain.input, standing()),
        }
    }

    /// What lies around the vertices of a loop within so many edges, of what is on its one side.
    pub(super) fn around<'a>(
        &'a self,
        (vertices, normals): (Vec<u32>, Vec<Vector3<f64>>),
        rings: usize,
        h: Cow<'a, [f64]>,
        is_there: impl Fn(u32) -> bool,
    ) -> Around<'a> {
        let neighbours = |v: u32| self.neighbours.of(v).iter().copied().filter(|j| is_there(*j));
        Around {
            samples: BoundarySamples::new(vertices.iter().copied(), rings, h.len(), neighbours),
            vertices,
            normals,
            x: &self.domain.input,
            h,
            moves: &self.domain.region.moves_elsewhere,
        }
    }
}
