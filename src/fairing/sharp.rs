//! Sharp edges that reach the boundary of a region: boundary data, which goes on inside.

mod along_chain;
mod between;
mod boundary_corner;
mod branch;
mod corners;
mod curve;
mod ends;
mod given_crease;
mod group;
mod groups;
mod outside;
mod parting;
mod path;
mod sides;

use super::component_solution::ComponentSolution;
use super::normals::GivenNormals;
use super::options::Options;
use super::prepared::Prepared;
use super::sharp_edge::{CreaseEnd, SharpEdge, SharpFate};
use crate::mesh::coincident::Coincident;
use crate::mesh::numbering::Numbering;
use crate::mesh::selection::Selection;
use crate::mesh::{Joined, RegionMesh};
use crate::support::error::Error;
pub(crate) use branch::{Branch, Knot};
pub(crate) use given_crease::GivenCrease;
use group::Group;
use groups::grouped;
use outside::Outside;
pub(crate) use parting::CreasePoint;
use parting::{Followed, PartedProblem};
use path::{Membrane, Path};

/// What was decided about the sharp edges that reach the boundary.
#[derive(Default)]
pub(super) struct SharpEdges {
    pub(super) told: Vec<SharpEdge>,
    /// The problem that is to be solved in place of the given one; none: no crease goes on.
    pub(super) parted: Option<PartedProblem>,
}

impl SharpEdges {
    /// Of a mesh that these components are of: those that are given, and others as far as the options ask for it.
    pub(super) fn find(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        components: &[Prepared],
        options: &Options,
        laid: &[GivenCrease],
    ) -> Self {
        if !options.asks_sharp() && laid.is_empty() {
            return Self::default();
        }
        let regions: Vec<&RegionMesh> = components.iter().map(|of| &of.domain.region).collect();
        let is_free = free(positions.len(), &regions);
        let given = GivenNormals::new(&options.boundary_normals);
        let outside = Outside::new(positions, triangles, &is_free, &options.marked_edges);
        let least = least_angle(options);
        let mut told = Vec::new();
        let mut creases = Vec::new();
        for crease in laid {
            told.push(crease.told());
            creases.push(crease.followed());
        }
        let is_laid = |end: &CreaseEnd| {
            laid.iter()
                .flat_map(|of| &of.ends)
                .any(|of| of.vertex == end.vertex)
        };
        for component in components {
            let mut ends = ends::crease_ends(&outside, boundary(&component.domain.region), least);
            ends.retain(|end| !given.has(end.vertex) && !is_laid(end));
            follow(
                (component, &options.marked_edges),
                &ends,
                positions,
                &mut told,
                &mut creases,
            );
        }
        let goes_on = told.iter().filter(|edge: &&SharpEdge| !edge.vertices.is_empty());
        let ends: Vec<&CreaseEnd> = goes_on.flat_map(|edge| &edge.ends).collect();
        let parted = (!creases.is_empty()).then(|| {
            let found: Vec<&CreaseEnd> = ends.iter().copied().filter(|end| !is_laid(end)).collect();
            let mut near = ends::normals_near(&outside, &found, least);
            near.retain(|(v, _)| !given.has(*v));
            PartedProblem::new((positions, triangles), &is_free, &creases, (&ends, near))
        });
        let parted = parted.filter(PartedProblem::has_free);
        if parted.is_none() {
            told.iter_mut().for_each(SharpEdge::stop);
        }
        Self { told, parted }
    }

    /// Has reservations about components where an edge as wide as a crease along the boundary does not go on.
    pub(super) fn judge(&self, components: &mut [ComponentSolution]) {
        let stopped = self.told.iter().filter(|edge| edge.stops_wide());
        for end in stopped.flat_map(|edge| &edge.ends) {
            let has_it =
                |of: &&mut ComponentSolution| of.boundary_normals.iter().any(|(v, _)| *v == end.vertex);
            for of in components.iter_mut().filter(has_it) {
                of.report.outcome.reserve_edge();
            }
        }
    }
}

/// The angle at which an edge that is not marked may be one of a crease; else none is.
fn least_angle(options: &Options) -> f64 {
    if options.sharp > 0.0 {
        options.sharp
    } else {
        f64::INFINITY
    }
}

/// Decides about the ends at the boundary of one component.
fn follow(
    (component, marked): (&Prepared, &[[u32; 2]]),
    ends: &[CreaseEnd],
    positions: &[[f64; 3]],
    told: &mut Vec<SharpEdge>,
    creases: &mut Vec<Followed>,
) {
    if ends.is_empty() {
        return;
    }
    let mut membrane = Membrane::new(&component.domain, positions, marked);
    for group in grouped(ends, positions) {
        let paths = match group.branches.is_empty() {
            true => None,
            false => membrane.as_mut().and_then(|membrane| membrane.paths(&group)),
        };
        told.push(SharpEdge {
            ends: group.ends.iter().map(|&e| ends[e].clone()).collect(),
            fate: SharpFate::of(group.branches.len(), paths.is_some()),
            vertices: vertices(paths.as_deref().unwrap_or_default()),
        });
        let followed = group.branches.into_iter().zip(paths.into_iter().flatten());
        creases.extend(followed.map(|(branch, path)| Followed::new(&branch, path)));
    }
}

fn vertices(paths: &[Path]) -> Vec<u32> {
    let all = paths.iter().flat_map(|path| &path.vertices);
    all.copied().collect()
}

/// The fixed vertices of triangles with a free one of this region.
fn boundary(region: &RegionMesh) -> Vec<u32> {
    region.vertex_ids[region.free..region.region_vertices()].to_vec()
}

/// Which of so many vertices are free in any of the regions.
fn free(vertices: usize, regions: &[&RegionMesh]) -> Vec<bool> {
    let mut is_free = vec![false; vertices];
    for region in regions {
        let own = &region.vertex_ids[..region.free];
        own.iter().for_each(|&v| is_free[v as usize] = true);
    }
    is_free
}

/// The ends of creases at the boundary of triangles that are all outside, as those of a hole, by whether they belong together.
pub(crate) fn creases_around(
    (positions, triangles): (&[[f64; 3]], &[[u32; 3]]),
    is_boundary: Vec<bool>,
    options: &Options,
) -> Vec<BoundaryCrease> {
    let outside = Outside::around(positions, triangles, is_boundary, &options.marked_edges);
    let given = GivenNormals::new(&options.boundary_normals);
    let least = least_angle(options);
    let mut ends = ends::crease_ends(&outside, outside.boundary(), least);
    ends.retain(|end| !given.has(end.vertex));
    let crease = |group: Group| {
        let own: Vec<CreaseEnd> = group.ends.iter().map(|&e| ends[e].clone()).collect();
        let near = match group.branches.is_empty() {
            true => Vec::new(),
            false => ends::normals_near(&outside, &own.iter().collect::<Vec<_>>(), least),
        };
        BoundaryCrease {
            near: near.into_iter().filter(|(v, _)| !given.has(*v)).collect(),
            ends: own,
            branches: group.branches,
        }
    };
    grouped(&ends, positions).into_iter().map(crease).collect()
}

/// Whether an edge at such a boundary bends so much that it may be one of a crease.
pub(crate) fn may_be_creased(
    (positions, triangles): (&[[f64; 3]], &[[u32; 3]]),
    is_boundary: Vec<bool>,
    options: &Options,
) -> bool {
    let outside = Outside::around(positions, triangles, is_boundary, &options.marked_edges);
    let bends = |v: u32| !ends::bent(&outside, v, least_angle(options)).is_empty();
    (0..positions.len() as u32).any(|v| outside.is_boundary[v as usize] && bends(v))
}

/// Ends that belong together.
pub(crate) struct BoundaryCrease {
    pub(crate) ends: Vec<CreaseEnd>,
    /// From end to end, to corners and between them; none of an end alone.
    pub(crate) branches: Vec<Branch>,
    /// Normals at boundary vertices beside the ends.
    pub(crate) near: Vec<(u32, [f64; 3])>,
}

/// Where creases of the surroundings, of at least so many degrees, arrive at the boundary of a region: two normals hold there, and no
/// smooth surface has both. The region itself is not looked at. Vertices have the smallest number of their copies.
///
/// ```
/// use fairmesh::{Coincident, Selection, crease_ends};
///
/// // A roof of 9 by 9 vertices, bent by 90 degrees along its middle row; the nine in the middle are free.
/// let at = |v: u32| [f64::from(v % 9), f64::from(v / 9), -f64::from((v / 9).abs_diff(4))];
/// let positions: Vec<[f64; 3]> = (0..81).map(at).collect();
/// let cell = |c: u32| { let v = c / 8 * 9 + c % 8; [[v, v + 1, v + 10], [v, v + 10, v + 9]] };
/// let triangles: Vec<[u32; 3]> = (0..64).flat_map(cell).collect();
/// let free = [30, 31, 32, 39, 40, 41, 48, 49, 50];
///
/// let ends = crease_ends(&positions, &triangles, Selection::Vertices(&free), Coincident::default(), 20.0)?;
/// let found: Vec<(u32, f64)> = ends.iter().map(|end| (end.vertex, end.angle.round())).collect();
/// assert_eq!(found, [(38, 90.0), (42, 90.0)]);
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// Those of [`fair`](crate::fair) about the mesh and the selection.
pub fn crease_ends(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    selection: Selection<'_>,
    coincident: Coincident,
    least: f64,
) -> Result<Vec<CreaseEnd>, Error> {
    let joined = Joined::new(positions, triangles, coincident)?;
    let selected = joined.copies.selection(selection);
    let numbering = (Numbering::AsGiven, false);
    let regions = RegionMesh::of_components(
        positions,
        &joined.triangles,
        selected.selection(),
        &|_| false,
        numbering,
    )?;
    let is_free = free(positions.len(), &regions.iter().collect::<Vec<_>>());
    let outside = Outside::new(positions, &joined.triangles, &is_free, &[]);
    let of = |region: &RegionMesh| ends::crease_ends(&outside, boundary(region), least);
    let mut ends: Vec<CreaseEnd> = regions.iter().flat_map(of).collect();
    ends.sort_by_key(|end| end.vertex);
    Ok(ends)
}
