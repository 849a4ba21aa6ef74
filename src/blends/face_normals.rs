//! Normals of faces, as smooth as the surfaces that their triangles approximate.

use nalgebra::Vector3;

use super::crease_graph::CreaseGraph;
use super::surface::{Surface, between};
use crate::holes::Parents;
use crate::mesh::halfedge;

/// Bends below this (radians) are none: a plane's normal is exact.
/// Half: of 13 solids cut from each other one keeps two creases sharp; double: all stay sound.
const FLAT: f64 = 1e-6;

pub(super) struct FaceNormals<'a> {
    pub(super) surface: &'a Surface<'a>,
    pub(super) graph: &'a CreaseGraph,
}

impl FaceNormals<'_> {
    /// The unit normal of a face at a place between vertices, if there is one.
    pub(super) fn between(&self, place: &Parents, face: u32) -> Option<Vector3<f64>> {
        let all = place.vertices.into_iter().zip(place.weights);
        let sum: Vector3<f64> = all
            .filter(|(_, w)| *w > 0.0)
            .map(|(v, w)| self.at(v, face) * w)
            .sum();
        sum.try_normalize(0.0)
    }

    /// The mean curvature of a face at a place between vertices, as its normals tell it: H = -1/2 div n, negative on a sphere with outward normals.
    pub(super) fn curvature(&self, place: &Parents, face: u32) -> f64 {
        let all = place.vertices.into_iter().zip(place.weights);
        all.filter(|(_, w)| *w > 0.0)
            .map(|(v, w)| w * self.curvature_at(v, face))
            .sum()
    }

    /// The mean over the triangles of a face at one of its vertices, of normals that are linear in each: no triangle is too thin for their integrals.
    fn curvature_at(&self, v: u32, face: u32) -> f64 {
        let (mut divergence, mut area) = (0.0, 0.0);
        let around = self.surface.links.outgoing.row(v as usize);
        for &h in around
            .iter()
            .filter(|&&h| self.graph.faces[h as usize / 3] == face)
        {
            let up = self.graph.normals[h as usize / 3];
            let edges = [h, halfedge::next(h), halfedge::previous(h)];
            for g in edges {
                // The corner across from the edge.
                let normal = self.at(self.surface.origin(halfedge::previous(g)), face);
                divergence += 0.5 * normal.dot(&up.cross(&self.surface.edge(g)));
            }
            area += 0.5
                * self
                    .surface
                    .edge(edges[0])
                    .cross(&self.surface.edge(edges[1]))
                    .norm();
        }
        if area > 0.0 { -0.5 * divergence / area } else { 0.0 }
    }

    /// The normal of a face at one of its vertices. Inside a face triangles count by their angles, as it does not matter then how a
    /// plane is divided. On its boundary their angles tell nothing of the surface: edges count by how much they bend.
    fn at(&self, v: u32, face: u32) -> Vector3<f64> {
        let (mut by_angle, mut by_bend) = (Vector3::zeros(), Vector3::zeros());
        let (mut is_inside, mut bent) = (true, 0.0);
        for &h in self.surface.links.outgoing.row(v as usize) {
            let normal = self.graph.normals[h as usize / 3];
            if self.graph.faces[h as usize / 3] != face {
                is_inside = false;
                continue;
            }
            by_angle += normal * self.surface.angle(h);
            let Some(o) = self.surface.across(h) else {
                is_inside = false;
                continue;
            };
            if self.graph.faces[o as usize / 3] == face {
                let other = self.graph.normals[o as usize / 3];
                let bend = between(&normal, &other);
                by_bend += (normal + other) * bend;
                bent += bend;
            }
        }
        if is_inside || bent < FLAT {
            by_angle
        } else {
            by_bend
        }
        .try_normalize(0.0)
        .unwrap_or_default()
    }
}
