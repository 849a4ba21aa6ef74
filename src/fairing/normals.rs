//! Which normals hold at the boundary vertices.

use nalgebra::Vector3;

use crate::discrete::boundary_normals::estimate;
use crate::mesh::RegionMesh;
use crate::solve::Domain;
use crate::support::entries::sort_by_number;
use crate::support::error::Error;
use crate::support::table::{choices, table};

/// Where the unit normals at the boundary vertices come from. Outward or inward, as the triangles run.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum BoundaryNormals {
    /// Fitted to three rings of the surface outside the region, to second or third order, whichever is more certain
    /// there, and blended with the average where the scan is rough; by the paper's rule (7.5) where there is no outside.
    /// To eight rings where all coordinates around are single precision numbers so far from the origin that their rounding
    /// turns edges by more than 1e-4.
    #[default]
    Fitted,
    /// The average of the outside triangles, as the paper does (7.5).
    Averaged,
    /// Given for some or all boundary vertices (`(vertex, unit normal)`); the others are fitted. Entries for
    /// vertices that are not on the boundary are ignored. Those of copies of a vertex, see
    /// [`Coincident`](crate::Coincident), are averaged; they must not be further apart than 120 degrees.
    Given(Vec<(u32, [f64; 3])>),
}

table!(BoundaryNormals {
    0 "fitted" BoundaryNormals::Fitted =>
        "fitted to the surface outside the region, to second or third order; where there is no outside, averaged", "";
    1 "averaged" BoundaryNormals::Averaged => "the average of the triangles outside the region", "";
    2 "given" BoundaryNormals::Given(_) => "given, for some or all boundary vertices; fitted for the others", "";
});

choices! {
    /// The normals of fixed vertices inside the region, all of whose triangles are the region's own: interpolated points
    /// and curves. Where [`BoundaryNormals::Given`] has a normal for such a vertex, that one holds in any case. Along a curve of
    /// such vertices the surface is cut: each side meets the curve with the given normals, and has a curvature of its own. At
    /// single vertices the normal acts on the mean curvature, which is taken from all sides at once, and bends the surface
    /// little.
    #[derive(Default)]
    InteriorNormals {
        #[default] 0 "smooth" Smooth =>
            "those of the surface itself, found with it: it passes the vertices smoothly; only their positions are prescribed", "";
        1 "input" Input => "the average of their triangles in the input, or of the surroundings where they are near (paper 7.5)", "";
    }
}

/// The normals that are given, by vertex.
pub(super) struct GivenNormals(Vec<(u32, [f64; 3])>);

impl GivenNormals {
    pub(super) fn new(asked: &BoundaryNormals) -> Self {
        let mut list = match asked {
            BoundaryNormals::Given(list) => list.clone(),
            BoundaryNormals::Fitted | BoundaryNormals::Averaged => Vec::new(),
        };
        // Of repeated ones the last holds.
        sort_by_number(&mut list);
        Self(list)
    }

    /// Those of one vertex.
    fn at(&self, vertex: u32) -> &[(u32, [f64; 3])] {
        let first = self.0.partition_point(|(v, _)| *v < vertex);
        let count = self.0[first..].iter().take_while(|(v, _)| *v == vertex).count();
        &self.0[first..first + count]
    }

    /// Which boundary vertices of a region have one.
    pub(super) fn at_boundary(&self, region: &RegionMesh) -> Vec<bool> {
        let boundary = &region.vertex_ids[region.free..region.region_vertices()];
        boundary.iter().map(|&v| self.has(v)).collect()
    }

    /// Whether a vertex has one.
    pub(super) fn has(&self, vertex: u32) -> bool {
        !self.at(vertex).is_empty()
    }
}

/// A given normal may miss unit length by this much.
/// Half or double, of 25 cases: none changes.
const UNIT: f64 = 1e-3;

/// Whether a given normal can be used; not where it is not a number.
pub(super) fn is_unit(n: &Vector3<f64>) -> bool {
    (1.0 - UNIT..=1.0 + UNIT).contains(&n.norm())
}

/// Normals at the boundary, and where the surface passes instead; empty: nowhere. `prescribed` are those of `asked`.
pub(super) fn boundary_normals(
    domain: &Domain,
    asked: &BoundaryNormals,
    prescribed: &GivenNormals,
    interior: InteriorNormals,
) -> Result<(Vec<Vector3<f64>>, Vec<bool>), Error> {
    let Domain {
        region, rings, input, ..
    } = domain;
    let mut given = vec![None; region.boundary];
    let boundary = &region.vertex_ids[region.free..region.region_vertices()];
    for (given, &v) in given.iter_mut().zip(boundary) {
        for (_, n) in prescribed.at(v) {
            let n = Vector3::from(*n);
            if !is_unit(&n) {
                return Err(Error::BadNormal { vertex: v as usize });
            }
            *given = Some(n / n.norm());
        }
    }
    let mut smooth_interior = vec![false; region.boundary];
    if interior == InteriorNormals::Smooth {
        for (b, given) in given.iter_mut().enumerate() {
            if rings.closed[b] && given.is_none() {
                smooth_interior[b] = true;
                // Any will do until the first evaluation.
                *given = Some(Vector3::z());
            }
        }
    }
    if !smooth_interior.contains(&true) {
        smooth_interior.clear();
    }
    let fitted = !matches!(asked, BoundaryNormals::Averaged);
    Ok((estimate(region, rings, input, fitted, &given)?, smooth_interior))
}
