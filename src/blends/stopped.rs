//! Creases that are not rounded and stop at rails: the blend is smooth there.

use super::facets::Facets;
use crate::fairing::{CreaseEnd, Report, SharpEdge, SharpFate};
use crate::mesh::halfedge::{next, previous};
use crate::support::error::Error;

/// Tells of those of these edges that the report does not name. The triangles of faces are the first `faces`, and these positions are a result's.
///
/// # Errors
/// Those of [`Facets::new`].
pub(super) fn tell(
    report: &mut Report,
    edges: &[[u32; 2]],
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    faces: usize,
) -> Result<(), Error> {
    if edges.is_empty() {
        return Ok(());
    }
    let facets = Facets::new(positions, triangles)?;
    for &[a, b] in edges {
        let is_on_band = |v: u32| {
            facets
                .links
                .outgoing
                .row(v as usize)
                .iter()
                .any(|h| *h as usize >= 3 * faces)
        };
        let [v, from] = if is_on_band(a) { [a, b] } else { [b, a] };
        let ends = report.sharp_edges.iter().flat_map(|edge| &edge.ends);
        let is_told = ends.into_iter().any(|end| end.vertex == v);
        let along = |h: &&u32| facets.links.origin(next(**h)) == from;
        if let Some(&h) = facets.links.outgoing.row(v as usize).iter().find(along)
            && !is_told
        {
            report.sharp_edges.extend(end(&facets, h));
            report.outcome.reserve_edge();
        }
    }
    Ok(())
}

/// The crease along `h` ends where `h` starts.
fn end(facets: &Facets<'_>, h: u32) -> Option<SharpEdge> {
    let (o, bend) = (facets.links.across(h)?, facets.bend(h)?);
    // The crease runs against `h`.
    let normals = [o, h].map(|g| facets.cross(g).normalize());
    let v = facets.links.origin(h);
    let away = facets.at(facets.links.origin(previous(o))) - facets.at(v);
    let end = CreaseEnd {
        vertex: v,
        direction: (-facets.edge(h).normalize()).into(),
        curvature: [0.0; 3],
        curvature_error: f64::INFINITY,
        normals: normals.map(Into::into),
        angle: if normals[1].dot(&away) <= 0.0 { bend } else { -bend },
        error: 0.0,
        chains: vec![vec![v, facets.links.origin(next(h))]],
    };
    Some(SharpEdge {
        ends: vec![end],
        fate: SharpFate::Alone,
        vertices: Vec::new(),
    })
}
