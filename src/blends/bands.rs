//! Bands around creases, cut out of the mesh: a region to be faired.

use nalgebra::Vector3;

use super::crease_graph::Chain;
use super::cut::Cut;
use super::face_normals::FaceNormals;
use super::rounded::{CreaseChain, Rounded};
use super::surface::Surface;
use crate::fairing::{BoundaryNormals, Coincident, Options, Report, Selection, fair};
use crate::holes::{Parents, RemeshOptions, Remeshed, compose, remesh_to_lengths};
use crate::mesh::NONE;
use crate::support::error::Error;

/// The mesh with bands that are cut out.
pub(super) struct Bands {
    positions: Vec<[f64; 3]>,
    /// Of which vertices of the mesh given each one consists.
    parents: Vec<Parents>,
    /// Those of faces that stay, in the order of what they are parts of, then the bands'.
    triangles: Vec<[u32; 3]>,
    /// The triangles given that those of faces are parts of.
    sources: Vec<u32>,
    free: Vec<u32>,
    /// Normals along the rails.
    normals: Vec<(u32, [f64; 3])>,
    /// Per vertex how long edges are to be there.
    lengths: Vec<f64>,
    angle: f64,
    chains: Vec<CreaseChain>,
}

impl Bands {
    pub(super) fn new(cut: &Cut<'_>, normals: &FaceNormals<'_>) -> Self {
        let sheet = &cut.sheet;
        let count = sheet.x.len();
        let is_free = |v: &u32| cut.value[*v as usize] < 0.0;
        let there = (0..sheet.triangles.len()).filter(|&t| sheet.is_there(t as u32));
        let (band, mut faces): (Vec<usize>, Vec<usize>) = there.partition(|&t| cut.is_band[t]);
        faces.sort_by_key(|&t| sheet.source[t]);
        let of_band = || band.iter().flat_map(|&t| sheet.triangles[t]);
        let mut is_in_band = vec![false; count];
        of_band().for_each(|v| is_in_band[v as usize] = true);
        // Per vertex of a rail the face that it bounds.
        let mut face = vec![NONE; count];
        for &t in &faces {
            let of = normals.graph.faces[sheet.source[t] as usize];
            let on_rail = sheet.triangles[t].into_iter().filter(|&v| is_in_band[v as usize]);
            on_rail.for_each(|v| face[v as usize] = of);
        }
        let all = 0..count as u32;
        let on_rails = all.clone().filter(|&v| face[v as usize] != NONE);
        let normal = |v: u32| {
            (
                v,
                normals
                    .between(&sheet.parents[v as usize], face[v as usize])
                    .into(),
            )
        };
        Self {
            positions: sheet.x.iter().map(|&p| p.into()).collect(),
            parents: sheet.parents.clone(),
            triangles: faces.iter().chain(&band).map(|&t| sheet.triangles[t]).collect(),
            sources: faces.iter().map(|&t| sheet.source[t]).collect(),
            free: all
                .clone()
                .filter(|v| is_in_band[*v as usize] && is_free(v))
                .collect(),
            normals: on_rails.map(normal).collect(),
            lengths: all.map(|v| cut.wanted(v).unwrap_or(0.0)).collect(),
            angle: normals.graph.least,
            chains: normals
                .graph
                .chains
                .iter()
                .map(|chain| told(chain, normals.surface))
                .collect(),
        }
    }

    /// Triangulates the bands anew and fairs them.
    ///
    /// # Errors
    /// Those of [`fair`].
    pub(super) fn fair(
        self,
        given: &[[f64; 3]],
        centre: &Vector3<f64>,
        options: &Options,
    ) -> Result<Rounded, Error> {
        let remeshing = RemeshOptions {
            coincident: Coincident::Separate,
            ..RemeshOptions::default()
        };
        let selection = Selection::Vertices(&self.free);
        let length = |v: u32| self.lengths[v as usize];
        let mesh = remesh_to_lengths(&self.positions, &self.triangles, selection, &remeshing, &length)?;
        let moved = |v: u32| mesh.kept_vertices.binary_search(&v).ok().map(|new| new as u32);
        let normals = self.normals.iter().filter_map(|&(v, n)| Some((moved(v)?, n)));
        let fairing = Options {
            boundary_normals: BoundaryNormals::Given(normals.collect()),
            coincident: Coincident::Separate,
            sharp: 0.0,
            ..options.clone()
        };
        let solution = fair(
            &mesh.positions,
            &mesh.triangles,
            Selection::Vertices(&mesh.free),
            &fairing,
        )?;
        Ok(self.assemble(given, centre, mesh, (&solution.positions, solution.report)))
    }

    /// The result without vertices that no triangle has any more; those given that stay have their own bits.
    fn assemble(
        self,
        given: &[[f64; 3]],
        centre: &Vector3<f64>,
        mesh: Remeshed,
        (moved, report): (&[[f64; 3]], Report),
    ) -> Rounded {
        let old = given.len();
        let mut is_free = vec![false; moved.len()];
        mesh.free.iter().for_each(|&v| is_free[v as usize] = true);
        let mut is_used = vec![false; moved.len()];
        let corners = mesh.triangles.iter().flatten();
        corners.for_each(|&v| is_used[v as usize] = true);
        let before = |v: usize| mesh.kept_vertices.get(v).map_or(usize::MAX, |&u| u as usize);
        // Of what the cut has made, then of what is new in the bands.
        let mut parents = self.parents[old..].to_vec();
        let made = parents.len();
        parents.extend(&mesh.parents);
        compose(&mut parents, old, made);
        let mut number = vec![NONE; moved.len()];
        let mut out = Rounded {
            positions: Vec::new(),
            triangles: Vec::new(),
            kept_vertices: Vec::new(),
            kept_triangles: self.sources,
            parents: Vec::new(),
            free: Vec::new(),
            angle: self.angle,
            chains: self.chains,
            report,
        };
        let stays = |v: &usize| before(*v) < old && !is_free[*v];
        let used = || (0..moved.len()).filter(|&v| is_used[v]);
        for v in used().filter(stays) {
            number[v] = out.positions.len() as u32;
            out.positions.push(given[before(v)]);
            out.kept_vertices.push(before(v) as u32);
        }
        for v in used().filter(|v| !stays(v)) {
            number[v] = out.positions.len() as u32;
            out.positions.push((Vector3::from(moved[v]) + centre).into());
            out.parents.push(match before(v) {
                usize::MAX => parents[made + v - mesh.kept_vertices.len()],
                u => self.parents[u],
            });
        }
        let renumbered = |v: &u32| number[*v as usize];
        out.triangles = mesh
            .triangles
            .iter()
            .map(|t| [0, 1, 2].map(|k| renumbered(&t[k])))
            .collect();
        out.free = mesh.free.iter().map(renumbered).collect();
        out.free.sort_unstable();
        out
    }
}

fn told(chain: &Chain, surface: &Surface<'_>) -> CreaseChain {
    let first = chain.half_edges.iter().take(1).map(|&h| surface.origin(h));
    CreaseChain {
        vertices: first
            .chain(chain.half_edges.iter().map(|&h| surface.target(h)))
            .collect(),
        bend: chain.bend,
        is_rounded: chain.is_chosen,
    }
}
