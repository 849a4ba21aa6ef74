//! Creases that are not rounded and stop at rails: the blend is smooth there.

use nalgebra::Vector3;

use super::surface::between;
use crate::fairing::{CreaseEnd, Report, SharpEdge, SharpFate};

/// Tells of those of these edges that the report does not name. The triangles of faces are the first `faces`, and these positions are a result's.
pub(super) fn tell(
    report: &mut Report,
    edges: &[[u32; 2]],
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    faces: usize,
) {
    if edges.is_empty() {
        return;
    }
    let mut is_on_band = vec![false; positions.len()];
    let of_bands = triangles[faces..].iter().flatten();
    of_bands.for_each(|&v| is_on_band[v as usize] = true);
    let at = |v: u32| Vector3::from(positions[v as usize]);
    for &[a, b] in edges {
        let [v, from] = if is_on_band[a as usize] { [a, b] } else { [b, a] };
        let is_told = report.sharp_edges.iter().flat_map(|edge| &edge.ends);
        if is_told.into_iter().any(|end| end.vertex == v) {
            continue;
        }
        let beside = triangles[..faces]
            .iter()
            .filter(|t| t.contains(&v) && t.contains(&from));
        let normals = beside.map(|t| {
            let [p, q, r] = t.map(at);
            (
                (q - p).cross(&(r - p)).normalize(),
                p + q + r - (at(v) + at(from)) - at(v),
            )
        });
        let [(m, _), (n, away)] = normals.collect::<Vec<_>>()[..] else {
            continue;
        };
        let angle = between(&m, &n).to_degrees();
        report.sharp_edges.push(SharpEdge {
            ends: vec![CreaseEnd {
                vertex: v,
                direction: (at(v) - at(from)).normalize().into(),
                curvature: [0.0; 3],
                curvature_error: f64::INFINITY,
                normals: [m.into(), n.into()],
                angle: if m.dot(&away) <= 0.0 { angle } else { -angle },
                error: 0.0,
                chains: vec![vec![v, from]],
            }],
            fate: SharpFate::Alone,
            vertices: Vec::new(),
        });
        report.outcome.reserve_edge();
    }
}
