//! Bands around creases, cut out of the mesh: a region to be faired.

use std::collections::BTreeMap;

use fairmesh_linear::interrupt::checkpoint;
use nalgebra::Vector3;

use super::arcs::Arc;
use super::chords::divide_chords;
use super::crease_graph::Chain;
use super::cut::Cut;
use super::face_normals::FaceNormals;
use super::rails::Rails;
use super::resolution::lengths;
use super::rounded::{CreaseChain, Narrowing, Rounded, SharpCorner};
use super::stopped::tell;
use super::surface::Surface;
use super::telling::Telling;
use crate::fairing::{
    BoundaryCurvature, BoundaryNormals, Coincident, GivenCrease, Options, Outcome, Report, Selection,
    Solution, fair_along,
};
use crate::holes::{Lengths, Parents, RemeshOptions, compose, remesh_to_lengths};
use crate::mesh::membrane::membrane;
use crate::mesh::parted::part;
use crate::mesh::{NONE, RegionMesh, Rings};
use crate::support::error::Error;

/// The mesh with bands that are cut out.
#[derive(Clone)]
pub(super) struct Bands {
    positions: Vec<[f64; 3]>,
    /// The vertices of the mesh given that they are; [`NONE`] of others, and of those that move.
    given: Vec<u32>,
    /// Of which vertices of the mesh given each one consists.
    parents: Vec<Parents>,
    /// Those of faces that stay, in the order of what they are parts of, then the bands'.
    triangles: Vec<[u32; 3]>,
    /// The triangles given that those of faces are parts of.
    sources: Vec<u32>,
    free: Vec<u32>,
    /// Normals along the rails.
    normals: Vec<(u32, [f64; 3])>,
    /// And the mean curvature of the faces there, if it is to go on.
    curvature: Vec<(u32, f64)>,
    /// Edges of creases that are not rounded, where they arrive at rails.
    creases: Vec<[u32; 2]>,
    /// The edges with which blends end at faces across from them.
    arcs: Vec<GivenCrease>,
    /// The vertices of the boundaries with which blends run out.
    on_rims: Vec<u32>,
    /// Per vertex how long edges are to be there.
    lengths: Vec<f64>,
    /// About how many vertices there are to be.
    expected: f64,
    angle: f64,
    chains: Vec<CreaseChain>,
    sharp_corners: Vec<SharpCorner>,
}

impl Bands {
    pub(super) fn new(
        cut: &Cut<'_>,
        normals: &FaceNormals<'_>,
        (arcs, rims): (Vec<GivenCrease>, &[Arc]),
        asks_continuity: bool,
    ) -> Result<Self, Error> {
        let sheet = &cut.sheet;
        let count = sheet.x.len();
        let is_free = |v: &u32| cut.value[*v as usize] < 0.0;
        let there = (0..sheet.triangles.len()).filter(|&t| sheet.is_there(t as u32));
        let (band, mut faces): (Vec<usize>, Vec<usize>) = there.partition(|&t| cut.is_band[t]);
        faces.sort_unstable_by_key(|&t| (sheet.source[t], t));
        let of_band = || band.iter().flat_map(|&t| sheet.triangles[t]);
        let mut is_in_band = vec![false; count];
        of_band().for_each(|v| is_in_band[v as usize] = true);
        let rails = Rails::new(cut, &band);
        let normal = |v: u32| Some((v, rails.normal(v, cut, normals)?.into()));
        let curvature = |v: u32| Some((v, rails.curvature(v, cut, normals)?));
        let all = 0..count as u32;
        let sharp = |&(vertex, place): &(u32, Vector3<f64>)| SharpCorner {
            vertex,
            place: (place + normals.surface.centre).into(),
        };
        let mut creases = rails.creases(cut, &faces);
        let is_of_arc = |v: &u32| arcs.iter().flat_map(|of| &of.ends).any(|end| end.vertex == *v);
        creases.retain(|edge| !edge.iter().any(is_of_arc));
        let mut positions: Vec<[f64; 3]> = sheet.x.iter().map(|&p| p.into()).collect();
        let mut at_rails: BTreeMap<u32, [f64; 3]> = all.clone().filter_map(normal).collect();
        let mut is_on_rim = vec![false; count];
        // Ends are on rails.
        for (v, point) in rims.iter().flat_map(|rim| &rim[1..rim.len() - 1]) {
            positions[*v as usize] = point.place.into();
            at_rails.insert(*v, point.normals[0].into());
            is_on_rim[*v as usize] = true;
        }
        let is_given = |v: u32| (v as usize) < normals.surface.x.len() && !is_free(&v);
        let bands = Self {
            positions,
            given: all.clone().map(|v| if is_given(v) { v } else { NONE }).collect(),
            parents: sheet.parents.clone(),
            triangles: faces.iter().chain(&band).map(|&t| sheet.triangles[t]).collect(),
            sources: faces.iter().map(|&t| sheet.source[t]).collect(),
            free: all
                .clone()
                .filter(|v| is_in_band[*v as usize] && is_free(v) && !is_on_rim[*v as usize])
                .collect(),
            normals: at_rails.into_iter().collect(),
            curvature: all
                .clone()
                .filter(|_| asks_continuity)
                .filter_map(curvature)
                .collect(),
            creases,
            arcs,
            on_rims: all.clone().filter(|v| is_on_rim[*v as usize]).collect(),
            lengths: all.map(|v| cut.wanted(v).unwrap_or(0.0)).collect(),
            expected: cut.level.vertices(&normals.graph.chains),
            angle: normals.graph.least,
            chains: normals
                .graph
                .chains
                .iter()
                .zip(&cut.level.least)
                .map(|(chain, &least)| told(chain, least, normals.surface))
                .collect(),
            sharp_corners: normals.graph.sharp_corners.iter().map(sharp).collect(),
        };
        bands.bulged(|v| cut.bulge(v))
    }

    /// Bulged from their membranes towards the creases, by a part of the way there: from rail to rail it is about as far then as over the blends. Along the faces of a
    /// knife it is many times as far, and they would get as many times the vertices that they need. Bands without a membrane stay as they are.
    ///
    /// # Errors
    /// Those of [`fair`](crate::fair).
    fn bulged(mut self, part: impl Fn(u32) -> f64) -> Result<Self, Error> {
        let region = RegionMesh::new(&self.positions, &self.triangles, Selection::Vertices(&self.free))?;
        let given = region.positions(&self.positions);
        let mut x = given.clone();
        let on_arcs = self.on_arcs();
        let is_placed = |v: usize| on_arcs.binary_search(&region.vertex_ids[v]).is_ok();
        membrane(&Rings::new(&region), &mut x, is_placed);
        for (i, &v) in region.vertex_ids[..region.free].iter().enumerate() {
            self.positions[v as usize] = (x[i] + (given[i] - x[i]) * part(v)).into();
        }
        Ok(self)
    }

    /// Triangulates the bands anew and fairs them; where that leads to no sound surface, or to one that bends much from triangle to triangle, once
    /// more, from the surface that it has led to: that is smooth already, vertices are spread over it evenly, and it tells how fine it is to be.
    ///
    /// The place of a vertex with too many triangles where that cannot be: there the rails leave too little room.
    ///
    /// # Errors
    /// Those of [`fair`](crate::fair).
    pub(super) fn fair(
        self,
        given: &[[f64; 3]],
        centre: &Vector3<f64>,
        options: &Options,
        telling: &mut Telling<'_, '_>,
    ) -> Result<Result<Rounded, Vector3<f64>>, Error> {
        let mut bands = self.parted().remeshed(given.len(), None)?;
        let mut solution = match bands.solve(options, telling) {
            Err(Error::ValenceTooLarge { vertex, .. }) => return Ok(Err(bands.positions[vertex].into())),
            solved => solved?,
        };
        for _ in 0..AGAIN {
            let is_good = is_sound(&solution);
            let smooth = Self {
                positions: solution.positions.clone(),
                ..bands.clone()
            };
            let sides = smooth.parted();
            // A surface that is not sound bends anyhow.
            let finer = is_good.then(|| sides.lengths());
            if finer == Some(None) {
                break;
            }
            let next = sides.remeshed(given.len(), finer.flatten().as_deref());
            // What cannot be triangulated once more stays as it is.
            match next.and_then(|next| Ok((next.solve(options, telling)?, next))) {
                Ok((found, next)) if !is_good || is_sound(&found) => (bands, solution) = (next, found),
                _ => break,
            }
        }
        bands.positions = solution.positions;
        let (faces, report) = (bands.sources.len(), &mut solution.report);
        tell(report, &bands.creases, &bands.positions, &bands.triangles, faces)?;
        Ok(Ok(bands.assemble(given, centre, solution.report)))
    }

    /// Parted along arcs, whose vertices are not free then.
    fn parted(mut self) -> PartedBands {
        let whole = self.positions.len();
        let of_arc = |arc: &GivenCrease| {
            [&arc.vertices, &arc.ends[0].chains[0], &arc.ends[1].chains[0]].map(Clone::clone)
        };
        let lines: Vec<Vec<u32>> = self.arcs.iter().flat_map(of_arc).collect();
        let steps = lines.iter().flat_map(|line| line.windows(2));
        let cut: Vec<[u32; 2]> = steps.map(|step| [step[0], step[1]]).collect();
        let parted = part(self.positions.len(), &self.triangles, &cut);
        self.triangles = parted.triangles;
        for &v in &parted.copy_of {
            let v = v as usize;
            self.positions.push(self.positions[v]);
            self.given.push(NONE);
            self.parents.push(self.parents[v]);
            self.lengths.push(self.lengths[v]);
        }
        let on_arcs = self.on_arcs();
        self.free.retain(|v| on_arcs.binary_search(v).is_err());
        PartedBands {
            bands: self,
            whole,
            copy_of: parted.copy_of,
        }
    }

    /// Which arc each of their vertices is on, and which of its vertices it is.
    fn places_on_arcs(&self) -> BTreeMap<u32, (usize, usize)> {
        let of_arc = |(a, arc): (usize, &GivenCrease)| {
            let all = arc.vertices.clone().into_iter().enumerate();
            all.map(move |(i, v)| (v, (a, i)))
        };
        self.arcs.iter().enumerate().flat_map(of_arc).collect()
    }

    /// The vertices that lie on arcs, ascending.
    fn on_arcs(&self) -> Vec<u32> {
        let inside = |arc: &GivenCrease| arc.vertices[1..arc.vertices.len() - 1].to_vec();
        let mut all: Vec<u32> = self.arcs.iter().flat_map(inside).collect();
        all.sort_unstable();
        all
    }

    /// In the numbers of the result: vertices given that stay, then the others; none without a triangle.
    fn compacted(self) -> Self {
        let count = self.positions.len();
        let mut is_used = vec![false; count];
        self.triangles
            .iter()
            .flatten()
            .for_each(|&v| is_used[v as usize] = true);
        let (stays, moves): (Vec<usize>, Vec<usize>) = (0..count)
            .filter(|&v| is_used[v])
            .partition(|&v| self.given[v] != NONE);
        let order: Vec<usize> = stays.into_iter().chain(moves).collect();
        let mut number = vec![NONE; count];
        (0..).zip(&order).for_each(|(new, &v)| number[v] = new);
        let new = |v: u32| number[v as usize];
        let mut free: Vec<u32> = self.free.iter().map(|&v| new(v)).collect();
        free.sort_unstable();
        Self {
            positions: order.iter().map(|&v| self.positions[v]).collect(),
            given: order.iter().map(|&v| self.given[v]).collect(),
            parents: order.iter().map(|&v| self.parents[v]).collect(),
            lengths: order.iter().map(|&v| self.lengths[v]).collect(),
            triangles: self.triangles.iter().map(|t| t.map(new)).collect(),
            normals: self.normals.iter().map(|&(v, n)| (new(v), n)).collect(),
            curvature: self.curvature.iter().map(|&(v, h)| (new(v), h)).collect(),
            creases: self.creases.iter().map(|edge| edge.map(new)).collect(),
            arcs: self
                .arcs
                .iter()
                .filter_map(|arc| renumbered(arc, &|v| Some(new(v))))
                .collect(),
            on_rims: self.on_rims.iter().map(|&v| new(v)).collect(),
            free,
            ..self
        }
    }

    fn solve(&self, options: &Options, telling: &mut Telling<'_, '_>) -> Result<Solution, Error> {
        let fairing = Options {
            boundary_normals: BoundaryNormals::Given(self.normals.clone()),
            boundary_curvature: BoundaryCurvature::Given(self.curvature.clone()),
            coincident: Coincident::Separate,
            marked_edges: self.creases.clone(),
            ..options.clone()
        };
        fair_along(
            &self.positions,
            &self.triangles,
            Selection::Vertices(&self.free),
            (&fairing, &self.arcs),
            &mut telling.fairing(),
        )
    }

    /// The result; vertices given that stay have their own bits.
    fn assemble(mut self, given: &[[f64; 3]], centre: &Vector3<f64>, report: Report) -> Rounded {
        self.free.append(&mut self.on_rims);
        self.free.sort_unstable();
        let kept = self.given.iter().take_while(|v| **v != NONE).count();
        let place = |(v, p): (&u32, &[f64; 3])| match *v {
            NONE => (Vector3::from(*p) + centre).into(),
            v => given[v as usize],
        };
        Rounded {
            positions: self.given.iter().zip(&self.positions).map(place).collect(),
            triangles: self.triangles,
            kept_vertices: self.given[..kept].to_vec(),
            kept_triangles: self.sources,
            parents: self.parents[kept..].to_vec(),
            free: self.free,
            angle: self.angle,
            chains: self.chains,
            sharp_corners: self.sharp_corners,
            report,
        }
    }
}

/// Bands parted along arcs, where vertices have copies for each side.
struct PartedBands {
    bands: Bands,
    /// How many vertices there are without copies; these stand behind them.
    whole: usize,
    /// What the copies are of.
    copy_of: Vec<u32>,
}

impl PartedBands {
    /// Per vertex how long edges may be, by how much the surface bends; none if it asks for nothing.
    fn lengths(&self) -> Option<Vec<f64>> {
        let bands = &self.bands;
        lengths(&bands.positions, &bands.triangles, bands.sources.len())
    }

    /// With a new triangulation of the bands, edges no longer than these where vertices are free; the mesh given has so many vertices. The copies are one
    /// again.
    fn remeshed(self, given: usize, finer: Option<&[f64]>) -> Result<Bands, Error> {
        let Self {
            bands,
            whole,
            copy_of,
        } = self;
        let options = RemeshOptions {
            coincident: Coincident::Separate,
            max_vertices: (MOST * (bands.expected + 1.0)) as usize,
            ..RemeshOptions::default()
        };
        let lengths = Lengths {
            along: &|v| bands.lengths[v as usize],
            inside: &|v| finer.map_or(f64::INFINITY, |of| of[v as usize]),
        };
        let selection = Selection::Vertices(&bands.free);
        let mut mesh = remesh_to_lengths(&bands.positions, &bands.triangles, selection, &options, lengths)?;
        // What is stopped leaves its parents out.
        checkpoint();
        let original = |v: u32| {
            copy_of
                .get((v as usize).wrapping_sub(whole))
                .copied()
                .unwrap_or(v)
        };
        let places = bands.places_on_arcs();
        let place = |before: u32| places.get(&original(before)).copied();
        if !places.is_empty() {
            divide_chords(&mut mesh, bands.sources.len(), &place);
        }
        let on_arcs = bands.on_arcs();
        // Numbers of bands stand behind those of the mesh given.
        let mut parents = bands.parents;
        let made = parents.len();
        parents.extend(mesh.parents.iter().map(|of| Parents {
            vertices: of.vertices.map(|v| v + given as u32),
            weights: of.weights,
        }));
        compose(&mut parents, given, made);
        let kept = || mesh.kept_vertices.iter().map(|&v| v as usize);
        let new = mesh.positions.len() - mesh.kept_vertices.len();
        let moved = |v: u32| mesh.kept_vertices.binary_search(&v).ok().map(|new| new as u32);
        let joined = |v: u32| {
            let before = mesh.kept_vertices.get(v as usize);
            before.and_then(|&before| moved(original(before))).unwrap_or(v)
        };
        let arc = |arc: &GivenCrease| renumbered(arc, &moved);
        let free = mesh
            .free
            .iter()
            .copied()
            .chain(on_arcs.iter().filter_map(|&v| moved(v)));
        let result = Bands {
            given: kept().map(|v| bands.given[v]).chain(vec![NONE; new]).collect(),
            parents: kept()
                .map(|v| parents[v])
                .chain(parents[made..].iter().copied())
                .collect(),
            lengths: kept().map(|v| bands.lengths[v]).chain(vec![0.0; new]).collect(),
            normals: bands
                .normals
                .iter()
                .filter_map(|&(v, n)| Some((moved(v)?, n)))
                .collect(),
            curvature: bands
                .curvature
                .iter()
                .filter_map(|&(v, h)| Some((moved(v)?, h)))
                .collect(),
            creases: bands
                .creases
                .iter()
                .filter_map(|&[a, b]| Some([moved(a)?, moved(b)?]))
                .collect(),
            arcs: bands.arcs.iter().filter_map(arc).collect(),
            positions: mesh.positions,
            triangles: mesh.triangles.iter().map(|t| t.map(joined)).collect(),
            on_rims: bands.on_rims.iter().filter_map(|&v| moved(v)).collect(),
            free: free.collect(),
            ..bands
        };
        Ok(result.compacted())
    }
}

/// In other numbers; `None` where a vertex has none.
fn renumbered(arc: &GivenCrease, new: &impl Fn(u32) -> Option<u32>) -> Option<GivenCrease> {
    let all = |of: &[u32]| of.iter().map(|&v| new(v)).collect::<Option<Vec<u32>>>();
    let mut arc = arc.clone();
    arc.vertices = all(&arc.vertices)?;
    for end in &mut arc.ends {
        end.vertex = new(end.vertex)?;
        end.chains = end.chains.iter().map(|chain| all(chain)).collect::<Option<_>>()?;
    }
    Some(arc)
}

/// Bands have at most so many times the vertices that are expected: more come of edges without length. Of 50 runs with solids cut from each other, boxes and wedges
/// most have 1.4 times as many and none has more than 2.4; half or double changes nothing there.
/// Edges of 1e-313 are refused after 0.5 s then; half 0.3 s, double 0.8 s.
const MOST: f64 = 10.0;
/// Times that bands are triangulated once more.
/// Half or double, of 13 solids cut from each other: all stay sound, with as many vertices to 1 %.
const AGAIN: usize = 2;

/// Whether there is nothing that another triangulation could mend.
fn is_sound(solution: &Solution) -> bool {
    let outcome = &solution.report.outcome;
    outcome.is_success() || matches!(outcome, Outcome::ConvergedLoosely { .. })
}

fn told(chain: &Chain, (part, at): (f64, Vector3<f64>), surface: &Surface<'_>) -> CreaseChain {
    let narrowed = (chain.is_chosen && part < 1.0).then(|| Narrowing {
        part,
        place: (at + surface.centre).into(),
    });
    CreaseChain {
        narrowed,
        ..CreaseChain::new(chain, surface)
    }
}
