//! A region deleted and its boundary filled: where the shape that it has is of no use to what it shall become, such as an ear of
//! many vertices behind a short boundary.

use super::fill::{fill_holes, fill_holes_with_progress};
use super::loops::{BoundaryLoop, boundary_loops_joined};
use super::options::{FillOptions, Join, Loops};
use super::outcome::{FillOutcome, LoopReport};
use super::remesh::Remeshed;
use crate::fairing::{BoundaryCurvature, BoundaryNormals, Options, ProgressCallback, Report};
use crate::mesh::{Joined, NONE, RegionMesh, Selection};
use crate::support::error::Error;

/// Deletes a region, and fills the loops that are left, those of each component of the region with one patch. None where that
/// leads to no fair patch that intersects nothing, where it would lose a vertex that is fixed: one inside the region, or one without
/// another triangle, and where the region lies at a boundary of the mesh.
///
/// The loops, joins and guides of the options are not read; numbers of vertices in those of the fairing are the mesh's.
///
/// ```
/// use fairmesh::{FillOptions, Selection, refill_region};
/// // A sheet of 8 by 8 squares, each divided into two triangles, with a spike.
/// let number = |i: u32, j: u32| 9 * i + j;
/// let grid = |n: u32| (0..n).flat_map(move |i| (0..n).map(move |j| (i, j)));
/// let mut positions: Vec<[f64; 3]> = grid(9).map(|(i, j)| [f64::from(i), f64::from(j), 0.0]).collect();
/// let triangles: Vec<[u32; 3]> = grid(8)
///     .flat_map(|(i, j)| {
///         let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
///         [[a, b, c], [a, c, d]]
///     })
///     .collect();
/// positions[number(4, 4) as usize][2] = 1e3;
/// let free: Vec<u32> = grid(3).map(|(i, j)| number(i + 3, j + 3)).collect();
/// let refilled = refill_region(&positions, &triangles, Selection::Vertices(&free), &FillOptions::default())?;
/// let refilled = refilled.expect("a fair patch");
/// assert_eq!(refilled.kept_vertices.len(), 81 - 9);
/// assert!(refilled.positions.iter().all(|p| p[2].abs() < 1e-9));
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// Those of [`fair`](crate::fair) for the region, and those of [`fill_holes`].
pub fn refill_region(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    options: &FillOptions,
) -> Result<Option<Remeshed>, Error> {
    refill(positions, triangles, selection, options, None)
}

/// [`refill_region`], which calls `progress` as [`fill_holes_with_progress`] does. `Break` stops the run: then there is no patch.
///
/// ```
/// use std::ops::ControlFlow;
/// use fairmesh::{FillOptions, Selection, refill_region_with_progress};
/// # let number = |i: u32, j: u32| 9 * i + j;
/// # let grid = |n: u32| (0..n).flat_map(move |i| (0..n).map(move |j| (i, j)));
/// # let positions: Vec<[f64; 3]> = grid(9).map(|(i, j)| [f64::from(i), f64::from(j), 0.0]).collect();
/// # let triangles: Vec<[u32; 3]> = grid(8)
/// #     .flat_map(|(i, j)| {
/// #         let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
/// #         [[a, b, c], [a, c, d]]
/// #     })
/// #     .collect();
/// # let free: Vec<u32> = grid(3).map(|(i, j)| number(i + 3, j + 3)).collect();
/// let mut stop = |_: &fairmesh::Progress| ControlFlow::Break(());
/// let (selection, options) = (Selection::Vertices(&free), FillOptions::default());
/// let refilled = refill_region_with_progress(&positions, &triangles, selection, &options, &mut stop)?;
/// assert!(refilled.is_none());
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// Those of [`refill_region`].
pub fn refill_region_with_progress(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    options: &FillOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<Option<Remeshed>, Error> {
    refill(positions, triangles, selection, options, Some(progress))
}

fn refill(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    options: &FillOptions,
    progress: Option<&mut ProgressCallback<'_>>,
) -> Result<Option<Remeshed>, Error> {
    options.validate()?;
    let coincident = options.fairing.coincident;
    let joined = Joined::new(positions, triangles, coincident)?;
    let selected = joined.copies.selection(selection);
    let region = RegionMesh::new(positions, &joined.triangles, selected.selection())?;
    let gone = &region.half_edges.triangle_ids[..region.half_edges.region_triangles];
    let mut is_gone = vec![false; triangles.len()];
    gone.iter().for_each(|&t| is_gone[t as usize] = true);
    let kept: Vec<u32> = (0..triangles.len() as u32)
        .filter(|&t| !is_gone[t as usize])
        .collect();
    let Some(rest) = Rest::new(positions, triangles, &region, &joined, &kept) else {
        return Ok(None);
    };
    let loops = boundary_loops_joined(&rest.positions, &rest.triangles, coincident)?;
    let Some(of_components) =
        loops_of_components(&region, &loops, |v| joined.copies.smallest(rest.kept[v as usize]))
    else {
        return Ok(None);
    };
    let (groups, single): (Vec<_>, Vec<_>) = of_components.into_iter().partition(|of| of.len() > 1);
    let asked = FillOptions {
        loops: Loops::Chosen(single.concat()),
        join: Join::Groups(groups),
        guides: Vec::new(),
        fairing: rest.renumbered(&options.fairing),
        ..options.clone()
    };
    let filled = match progress {
        Some(progress) => fill_holes_with_progress(&rest.positions, &rest.triangles, &asked, progress)?,
        None => fill_holes(&rest.positions, &rest.triangles, &asked)?,
    };
    if filled.loops.is_empty() || !filled.loops.iter().all(is_fair) {
        return Ok(None);
    }
    let mut parents = filled.parents;
    for v in parents.iter_mut().flat_map(|of| &mut of.vertices) {
        *v = rest.kept[*v as usize];
    }
    Ok(Some(Remeshed {
        free: (rest.kept.len() as u32..filled.positions.len() as u32).collect(),
        positions: filled.positions,
        triangles: filled.triangles,
        kept_vertices: rest.kept,
        kept_triangles: kept,
        parents,
    }))
}

/// Faired, with sound triangles, and intersecting nothing.
fn is_fair(report: &LoopReport) -> bool {
    let is_sound = |of: &Report| !of.outcome.has_poor_triangles();
    report.outcome == FillOutcome::Faired && report.fairing.as_ref().is_some_and(is_sound)
}

/// The mesh without the region.
struct Rest {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    /// Per vertex its number before.
    kept: Vec<u32>,
    /// Per vertex before its number now, or [`NONE`].
    number: Vec<u32>,
}

impl Rest {
    /// None where a fixed vertex would have no triangle any more.
    fn new(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        region: &RegionMesh,
        joined: &Joined<'_>,
        kept: &[u32],
    ) -> Option<Self> {
        let mut is_gone = vec![false; positions.len()];
        let (free, boundary) = region.vertex_ids[..region.region_vertices()].split_at(region.free);
        for &v in free {
            is_gone[v as usize] = true;
            joined
                .copies
                .others(v)
                .for_each(|copy| is_gone[copy as usize] = true);
        }
        let mut has_triangle = vec![false; positions.len()];
        for v in kept.iter().flat_map(|&t| joined.triangles[t as usize]) {
            has_triangle[v as usize] = true;
        }
        if !boundary.iter().all(|&v| has_triangle[v as usize]) {
            return None;
        }
        let left: Vec<u32> = (0..positions.len() as u32)
            .filter(|&v| !is_gone[v as usize])
            .collect();
        let mut number = vec![NONE; positions.len()];
        for (new, &v) in (0..).zip(&left) {
            number[v as usize] = new;
        }
        Some(Self {
            positions: left.iter().map(|&v| positions[v as usize]).collect(),
            triangles: kept
                .iter()
                .map(|&t| triangles[t as usize].map(|v| number[v as usize]))
                .collect(),
            kept: left,
            number,
        })
    }

    /// The options with the numbers of the vertices that are left.
    fn renumbered(&self, options: &Options) -> Options {
        fn now(number: &[u32], v: u32) -> Option<u32> {
            number.get(v as usize).copied().filter(|&new| new != NONE)
        }
        fn left<T: Copy>(number: &[u32], list: &[(u32, T)]) -> Vec<(u32, T)> {
            list.iter()
                .filter_map(|&(v, value)| Some((now(number, v)?, value)))
                .collect()
        }
        let edge = |[a, b]: &[u32; 2]| Some([now(&self.number, *a)?, now(&self.number, *b)?]);
        Options {
            boundary_normals: match &options.boundary_normals {
                BoundaryNormals::Given(list) => BoundaryNormals::Given(left(&self.number, list)),
                other => other.clone(),
            },
            boundary_curvature: match &options.boundary_curvature {
                BoundaryCurvature::Given(list) => BoundaryCurvature::Given(left(&self.number, list)),
                other => other.clone(),
            },
            loop_continuity: left(&self.number, &options.loop_continuity),
            marked_edges: options.marked_edges.iter().filter_map(edge).collect(),
            ..options.clone()
        }
    }
}

/// Per component of the region the loops that it leaves; none where one of them has an edge that was open before. `id` gives
/// the region's number of a vertex.
fn loops_of_components(
    region: &RegionMesh,
    loops: &[BoundaryLoop],
    id: impl Fn(u32) -> u32,
) -> Option<Vec<Vec<usize>>> {
    let edges = edges(region);
    let mut found = vec![Vec::new(); region.components];
    for (l, vertices) in loops.iter().map(|of| &of.vertices).enumerate() {
        let component = |i: usize| {
            let edge = [vertices[i], vertices[(i + 1) % vertices.len()]].map(&id);
            let at = edges.binary_search_by_key(&edge, |entry| entry.0).ok()?;
            Some(edges[at].1)
        };
        let of: Vec<u32> = (0..vertices.len()).filter_map(component).collect();
        match of.first() {
            None => {}
            Some(_) if of.len() < vertices.len() => return None,
            Some(&first) => found[first as usize].push(l),
        }
    }
    Some(found)
}

/// The directed edges of the region's triangles with the component that lies there, ascending.
fn edges(region: &RegionMesh) -> Vec<([u32; 2], u32)> {
    let mut edges = Vec::new();
    for t in region.triangles() {
        let Some(&free) = t.iter().find(|&&v| (v as usize) < region.free) else {
            continue;
        };
        let component = region.component[free as usize];
        for k in 0..3 {
            let edge = [t[k], t[(k + 1) % 3]].map(|v| region.vertex_ids[v as usize]);
            edges.push((edge, component));
        }
    }
    edges.sort_unstable();
    edges
}
