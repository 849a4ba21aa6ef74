//! Edges that arcs have cut off.

use std::collections::BTreeMap;

use crate::holes::{Parents, Remeshed};

/// Divides edges between vertices of one arc that are not beside each other there, where triangles from number `first` on are on both sides: an arc
/// that is bent would leave the same triangle on both sides of it. `place` says which arc a
/// vertex of the mesh before is on, and which of its vertices it is.
pub(super) fn divide_chords(
    mesh: &mut Remeshed,
    first: usize,
    place: &dyn Fn(u32) -> Option<(usize, usize)>,
) {
    let kept = mesh.kept_vertices.clone();
    let place = |v: u32| kept.get(v as usize).and_then(|&before| place(before));
    let is_chord = |[a, b]: [u32; 2]| match (place(a), place(b)) {
        (Some((arc, i)), Some((other, j))) => arc == other && i.abs_diff(j) > 1,
        _ => false,
    };
    loop {
        let mut beside: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
        for (t, tri) in mesh.triangles.iter().enumerate().skip(first) {
            for [a, b] in [[tri[0], tri[1]], [tri[1], tri[2]], [tri[2], tri[0]]] {
                if is_chord([a, b]) {
                    beside.entry([a.min(b), a.max(b)]).or_default().push(t);
                }
            }
        }
        beside.retain(|_, beside| beside.len() == 2);
        if beside.is_empty() {
            return;
        }
        let mut is_divided = vec![false; mesh.triangles.len()];
        for (edge, beside) in beside {
            // What is divided already has other edges: next time.
            if !beside.iter().any(|&t| is_divided[t]) {
                beside.iter().for_each(|&t| is_divided[t] = true);
                divide(mesh, edge, &beside);
            }
        }
    }
}

/// Divides an edge and the triangles beside it in their middle.
fn divide(mesh: &mut Remeshed, [a, b]: [u32; 2], beside: &[usize]) {
    let middle = halfway(mesh, [a, b]);
    let with = |tri: [u32; 3], old: u32| tri.map(|v| if v == old { middle } else { v });
    for &t in beside {
        let tri = mesh.triangles[t];
        mesh.triangles[t] = with(tri, b);
        mesh.triangles.push(with(tri, a));
    }
}

/// A new vertex in the middle of an edge between two that are left.
fn halfway(mesh: &mut Remeshed, edge: [u32; 2]) -> u32 {
    let [p, q] = edge.map(|v| mesh.positions[v as usize]);
    let [a, b] = edge.map(|v| mesh.kept_vertices[v as usize]);
    let middle = mesh.positions.len() as u32;
    mesh.positions.push([0, 1, 2].map(|k| 0.5 * (p[k] + q[k])));
    mesh.parents.push(Parents {
        vertices: [a, b, a],
        weights: [0.5, 0.5, 0.0],
    });
    mesh.free.push(middle);
    middle
}
