//! Distances along the surface: a front that goes from vertex to vertex, across each triangle as if it were unfolded.
//!
//! M. Novotni, R. Klein, "Computing geodesic distances on triangular meshes", WSCG 2002: two distances at the ends of an edge place a
//! source in the plane of the next triangle. Exact where the surface unfolds to a plane without a hole.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use fairmesh_linear::interrupt::is_stopped;

use super::neighbours::Neighbours;
use super::seed::Foot;

/// Per vertex its distance from a point of the surface, along the surface; infinite where nothing leads to.
pub(super) fn distances(mesh: &Neighbours<'_>, from: &Foot) -> Vec<f64> {
    let corner = |v: u32| (v, (mesh.place(v) - from.place).norm());
    spread(mesh, mesh.triangles[from.triangle as usize].map(corner))
}

/// The same from the nearest of some vertices.
pub(super) fn distances_from(mesh: &Neighbours<'_>, vertices: &[u32]) -> Vec<f64> {
    spread(mesh, vertices.iter().map(|&v| (v, 0.0)))
}

/// From vertices whose distances are known.
fn spread(mesh: &Neighbours<'_>, known: impl IntoIterator<Item = (u32, f64)>) -> Vec<f64> {
    let mut distance = vec![f64::INFINITY; mesh.positions.len()];
    let mut is_final = vec![false; distance.len()];
    // Distances are not negative: their bits have their order.
    let mut front = BinaryHeap::new();
    let reach = |v: u32, d: f64, distance: &mut [f64], front: &mut BinaryHeap<_>| {
        if d < distance[v as usize] {
            distance[v as usize] = d;
            front.push(Reverse((d.to_bits(), v)));
        }
    };
    for (v, d) in known {
        reach(v, d, &mut distance, &mut front);
    }
    while let Some(Reverse((_, v))) = front.pop() {
        if std::mem::replace(&mut is_final[v as usize], true) {
            continue;
        }
        if is_stopped() {
            break;
        }
        for &t in mesh.at(v) {
            let [a, b, c] = mesh.triangles[t as usize];
            let (p, q) = match v {
                _ if v == a => (b, c),
                _ if v == b => (c, a),
                _ => (a, b),
            };
            for (known, new) in [(p, q), (q, p)] {
                if !is_final[new as usize] {
                    let d = across(mesh, [v, known], new, &distance);
                    reach(new, d, &mut distance, &mut front);
                }
            }
        }
    }
    distance
}

/// The distance of the third corner of a triangle from that of the first, and where it is known, the second.
fn across(mesh: &Neighbours<'_>, [u, v]: [u32; 2], w: u32, distance: &[f64]) -> f64 {
    let [x, y, z] = [u, v, w].map(|v| mesh.place(v));
    let [du, dv] = [u, v].map(|v| distance[v as usize]);
    let along = (du + (z - x).norm()).min(dv + (z - y).norm());
    let edge = y - x;
    let c = edge.norm();
    if !dv.is_finite() || c == 0.0 {
        return along;
    }
    // u at the origin, v on the first axis, w above it, the source below.
    let wx = edge.dot(&(z - x)) / c;
    let wy = ((z - x).norm_squared() - wx * wx).max(0.0).sqrt();
    let sx = (c * c + du * du - dv * dv) / (2.0 * c);
    let depth = du * du - sx * sx;
    if depth < 0.0 || wy == 0.0 {
        return along;
    }
    let sy = depth.sqrt();
    let crossing = sx + (wx - sx) * sy / (wy + sy);
    match (0.0..=c).contains(&crossing) {
        true => libm::hypot(wx - sx, wy + sy),
        false => along,
    }
}
