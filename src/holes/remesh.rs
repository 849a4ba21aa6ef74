//! A new triangulation of an existing region, with the edge lengths of its surroundings.

use fairmesh_linear::interrupt::is_stopped;

use super::parents::{Parents, parents};
use super::patch::Patch;
use super::refine::{Fineness, Refiner};
use super::relax::settle_sizes;
use crate::fairing::{ProgressCallback, on_workers_unless_stopped};
use crate::holes::layout::limit;
use crate::mesh::coincident::{Coincident, Copies};
use crate::mesh::{Joined, NONE, RegionMesh, Selection};
use crate::support::error::Error;
use crate::support::options::options;

/// Sweeps in which edge lengths spread from the boundary into the region.
/// Half or double, of 3 cases: 2 change, 2 get another triangulation.
const SWEEPS: usize = 100;
/// In so many parts of them, between which it is told how far they are.
/// Half or double, of 3 cases: only the progress changes.
const PARTS: usize = 10;
/// The fractions of the progress at which the region is read, and refinement ends: shares of the time, measured on regions of 10,000 to
/// 144,000 vertices at densities from 1 to 4.
/// Half or double, of 3 cases: only the progress changes.
const READ: f64 = 0.04;
const REFINED: f64 = 0.9;

options! {
    /// What is asked of [`remesh_region`].
    #[derive(Debug, Clone, Copy, PartialEq)]
    RemeshOptions {
        /// How dense the vertices are, as in hole filling: at the default, the square root of 2, edges are as long as those beside the
        /// region; at twice that, half as long, away from the boundary, whose edges stay. Between 0.1 and 10.
        density: f64 = std::f64::consts::SQRT_2, real "1" in 0.1..=10.0, "between 0.1 and 10";
        /// At most this many vertices inside the region. Default 200000.
        max_vertices: usize = 200_000, count "vertices";
        /// Whether vertices at the same place are one. Default: yes, where their coordinates are equal. Of a boundary vertex the new
        /// triangles name a copy that a triangle outside has; copies that no triangle has any more are gone.
        coincident: Coincident = Coincident::default(), elsewhere;
    }
}

impl RemeshOptions {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`Error::BadOption`], which names the option.
    pub fn validate(&self) -> Result<(), Error> {
        self.coincident.validate()?;
        self.check_ranges()
    }
}

/// The mesh with a new triangulation of the region.
#[derive(Debug, Clone)]
pub struct Remeshed {
    /// The vertices that are left, in their order, then the new ones.
    pub positions: Vec<[f64; 3]>,
    /// The triangles outside the region, in their order, then the region's.
    pub triangles: Vec<[u32; 3]>,
    /// The free vertices of the region, in the new numbers.
    pub free: Vec<u32>,
    /// Per vertex that is left its number before; ascending.
    pub kept_vertices: Vec<u32>,
    /// Per triangle outside the region its number before; ascending.
    pub kept_triangles: Vec<u32>,
    /// Where the new vertices come from: vertices of the mesh given.
    pub parents: Vec<Parents>,
}

/// Triangulates a region anew: splits, collapses and flips edges until their lengths are those of the surroundings and their
/// angles are good. The surface stays where it is, up to the new edges; to be faired, it is best faired loosely
/// before, so that a feature is flat when its vertices are thinned out. Fixed vertices, and edges between them on the
/// boundary of the region, stay.
///
/// ```
/// use fairmesh::{RemeshOptions, Selection, remesh_region};
/// // A sheet of 8 by 8 squares, each divided into two triangles.
/// let number = |i: u32, j: u32| 9 * i + j;
/// let grid = |n: u32| (0..n).flat_map(move |i| (0..n).map(move |j| (i, j)));
/// let positions: Vec<[f64; 3]> = grid(9).map(|(i, j)| [f64::from(i), f64::from(j), 0.0]).collect();
/// let triangles: Vec<[u32; 3]> = grid(8)
///     .flat_map(|(i, j)| {
///         let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
///         [[a, b, c], [a, c, d]]
///     })
///     .collect();
/// let free: Vec<u32> = grid(5).map(|(i, j)| number(i + 2, j + 2)).collect();
/// let finer = RemeshOptions { density: 3.0, ..RemeshOptions::default() };
/// let remeshed = remesh_region(&positions, &triangles, Selection::Vertices(&free), &finer)?;
/// assert!(remeshed.free.len() > 2 * free.len());
/// assert!(remeshed.positions.iter().all(|p| p[2].abs() < 1e-12)); // still plane
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// Those of [`fair`](crate::fair) for the region, and [`Error::BadOption`].
pub fn remesh_region(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    options: &RemeshOptions,
) -> Result<Remeshed, Error> {
    remesh(positions, triangles, selection, options, None, &mut |_| ())
}

/// The edge lengths that are wanted.
#[derive(Clone, Copy)]
pub(crate) struct Lengths<'a> {
    /// At the boundary, in place of those of the surroundings.
    pub(crate) along: &'a dyn Fn(u32) -> f64,
    /// At most, at free vertices.
    pub(crate) inside: &'a dyn Fn(u32) -> f64,
}

/// [`remesh_region`] to other edge lengths than those of the surroundings.
///
/// # Errors
/// Those of [`remesh_region`].
pub(crate) fn remesh_to_lengths(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    options: &RemeshOptions,
    lengths: Lengths<'_>,
) -> Result<Remeshed, Error> {
    remesh(
        positions,
        triangles,
        selection,
        options,
        Some(lengths),
        &mut |_| (),
    )
}

/// [`remesh_region`], which calls `progress` on the calling thread, as [`fair_with_progress`](crate::fair_with_progress) does. `Break`
/// stops the run: then there is no result.
///
/// # Errors
/// Those of [`remesh_region`].
pub fn remesh_region_with_progress(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    options: &RemeshOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<Option<Remeshed>, Error> {
    on_workers_unless_stopped(1, progress, "remeshing", |tell| {
        remesh(positions, triangles, selection, options, None, tell)
    })
}

fn remesh(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    options: &RemeshOptions,
    lengths: Option<Lengths<'_>>,
    tell: &mut dyn FnMut(f64),
) -> Result<Remeshed, Error> {
    options.validate()?;
    let joined = Joined::new(positions, triangles, options.coincident)?;
    let selected = joined.copies.selection(selection);
    let region = RegionMesh::new(positions, &joined.triangles, selected.selection())?;
    let ids = ids(&region);
    let coarse = patch(&region, positions, &ids, lengths);
    let taken = taken(&region);
    let fineness = Fineness {
        factor: std::f64::consts::SQRT_2 / options.density,
        growth: 0.0,
        most: options.max_vertices,
    };
    let mut patch = coarse.clone();
    tell(READ);
    // Sweeps take as long for a vertex that there is as refinement for one that is made.
    let made = 0.5 * options.density * options.density;
    let settled = READ + (REFINED - READ) / (1.0 + made);
    for k in 1..=PARTS {
        settle_sizes(&mut patch, SWEEPS / PARTS);
        tell(READ + (settled - READ) * k as f64 / PARTS as f64);
    }
    let mut part = |fraction| tell(settled + (REFINED - settled) * fraction);
    let mut refiner = Refiner::new(&mut patch, fineness, &taken).telling(&mut part);
    refiner.run_to_end();
    if is_stopped() {
        // Nobody looks at what is returned then.
        return Err(Error::EmptyRegion);
    }
    let kept = Kept::new(positions.len(), triangles, &region, &patch, &joined.copies);
    Ok(assemble(positions, triangles, kept, &coarse, &patch, &ids))
}

/// The mesh's numbers of the patch's vertices: boundary, then free.
fn ids(region: &RegionMesh) -> Vec<u32> {
    let (free, boundary) = region.vertex_ids[..region.region_vertices()].split_at(region.free);
    boundary.iter().chain(free).copied().collect()
}

/// The region as a patch, with the sizes outside, or those asked.
fn patch(region: &RegionMesh, positions: &[[f64; 3]], ids: &[u32], lengths: Option<Lengths<'_>>) -> Patch {
    let (free, boundary) = (region.free as u32, region.boundary as u32);
    let number = |v: u32| if v < free { v + boundary } else { v - free };
    let x: Vec<_> = ids.iter().map(|&v| positions[v as usize].into()).collect();
    let triangles: Vec<[u32; 3]> = region.triangles().iter().map(|t| t.map(number)).collect();
    let mut patch = Patch::new(x, triangles, boundary as usize);
    patch.old.copy_from_slice(ids);
    // Outside where there is an outside, else inside: sums of lengths and their counts.
    let mut sums = vec![[(0.0f64, 0.0f64); 2]; boundary as usize];
    let at = |v: u32| nalgebra::Vector3::from(positions[region.vertex_ids[v as usize] as usize]);
    for (t, tri) in region.half_edges.triangles.iter().enumerate() {
        let side = usize::from(t < region.half_edges.region_triangles);
        for k in 0..3 {
            let (a, b) = (tri[k], tri[(k + 1) % 3]);
            let length = (at(a) - at(b)).norm();
            for v in [a, b] {
                if v >= free && v < free + boundary {
                    let sum = &mut sums[(v - free) as usize][side];
                    *sum = (sum.0 + length, sum.1 + 1.0);
                }
            }
        }
    }
    let mut mean = 0.0;
    for (v, [outside, inside]) in sums.into_iter().enumerate() {
        let (sum, count) = if outside.1 > 0.0 { outside } else { inside };
        patch.size[v] = lengths.map_or(sum / count.max(1.0), |of| (of.along)(ids[v]));
        mean += patch.size[v] / f64::from(boundary);
    }
    patch.size[boundary as usize..].fill(mean);
    if let Some(of) = lengths {
        let inner = patch.own.iter_mut().zip(ids).skip(boundary as usize);
        inner.for_each(|(own, &v)| *own = (of.inside)(v));
    }
    for h in 0..patch.half_edges() {
        if patch.across(h) == NONE {
            let length = patch.length(h);
            for v in [patch.origin(h), patch.target(h)].map(|v| v as usize) {
                patch.limit[v] = patch.limit[v].min(limit(length, patch.size[v]));
            }
        }
    }
    patch
}

/// Edges between boundary vertices that the outside has.
fn taken(region: &RegionMesh) -> Vec<(u32, u32)> {
    let (free, end) = (region.free as u32, region.region_vertices() as u32);
    let mut taken = Vec::new();
    for tri in &region.half_edges.triangles[region.half_edges.region_triangles..] {
        for k in 0..3 {
            let (a, b) = (tri[k], tri[(k + 1) % 3]);
            if a < end && b < end {
                taken.push((a.min(b) - free, a.max(b) - free));
            }
        }
    }
    taken.sort_unstable();
    taken.dedup();
    taken
}

/// What is left of the mesh given.
struct Kept {
    vertices: Vec<u32>,
    triangles: Vec<u32>,
    /// (joined mesh's number, the copy that stays) of boundary vertices with several copies; ascending.
    copies: Vec<(u32, u32)>,
}

impl Kept {
    fn new(
        count: usize,
        triangles: &[[u32; 3]],
        region: &RegionMesh,
        patch: &Patch,
        copies: &Copies,
    ) -> Self {
        let mut is_kept = vec![true; triangles.len()];
        let gone = &region.half_edges.triangle_ids[..region.half_edges.region_triangles];
        gone.iter().for_each(|&t| is_kept[t as usize] = false);
        let kept: Vec<u32> = (0..triangles.len() as u32)
            .filter(|&t| is_kept[t as usize])
            .collect();

        let mut stays = vec![true; count];
        let (free, boundary) = region.vertex_ids[..region.region_vertices()].split_at(region.free);
        for &v in free
            .iter()
            .chain(boundary.iter().filter(|v| copies.others(**v).next().is_some()))
        {
            stays[v as usize] = false;
            copies.others(v).for_each(|copy| stays[copy as usize] = false);
        }
        if !copies.is_empty() {
            let of_kept = kept.iter().flat_map(|&t| triangles[t as usize]);
            of_kept.for_each(|v| stays[v as usize] = true);
        }
        let mut of_boundary = Vec::new();
        for &v in boundary.iter().filter(|v| copies.others(**v).next().is_some()) {
            let named = std::iter::once(v)
                .chain(copies.others(v))
                .find(|c| stays[*c as usize]);
            stays[named.unwrap_or(v) as usize] = true;
            of_boundary.push((v, named.unwrap_or(v)));
        }
        let old = patch.old[patch.fixed..].iter().filter(|v| **v != NONE);
        old.for_each(|&v| stays[v as usize] = true);
        Self {
            vertices: (0..count as u32).filter(|&v| stays[v as usize]).collect(),
            triangles: kept,
            copies: of_boundary,
        }
    }

    /// The copy of a vertex that stays.
    fn copy(&self, v: u32) -> u32 {
        let found = self.copies.binary_search_by_key(&v, |pair| pair.0);
        found.map_or(v, |i| self.copies[i].1)
    }
}

fn assemble(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    kept: Kept,
    coarse: &Patch,
    patch: &Patch,
    ids: &[u32],
) -> Remeshed {
    let mut number = vec![NONE; positions.len()];
    for (new, &v) in (0..).zip(&kept.vertices) {
        number[v as usize] = new;
    }
    let mut out: Vec<[f64; 3]> = kept.vertices.iter().map(|&v| positions[v as usize]).collect();
    let mut numbers = Vec::with_capacity(patch.x.len());
    for (v, &old) in patch.old.iter().enumerate() {
        if old == NONE {
            numbers.push(out.len() as u32);
            out.push(patch.x[v].into());
        } else {
            let new = number[kept.copy(old) as usize];
            numbers.push(new);
            if v >= patch.fixed {
                out[new as usize] = patch.x[v].into();
            }
        }
    }
    let outside = kept
        .triangles
        .iter()
        .map(|&t| triangles[t as usize].map(|v| number[v as usize]));
    let inside = patch.triangles.iter().map(|t| t.map(|v| numbers[v as usize]));
    let from = parents(patch, coarse, ids);
    let new = patch.old[patch.fixed..]
        .iter()
        .zip(from)
        .filter(|(old, _)| **old == NONE);
    let mut free = numbers[patch.fixed..].to_vec();
    free.sort_unstable();
    Remeshed {
        positions: out,
        triangles: outside.chain(inside).collect(),
        free,
        kept_vertices: kept.vertices,
        kept_triangles: kept.triangles,
        parents: new.map(|(_, parents)| parents).collect(),
    }
}
