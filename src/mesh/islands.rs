//! Islands: a few fixed vertices inside the region that happen to have triangles among themselves. So few vertices say
//! nothing about a tangent plane; they are interpolated like single fixed vertices, and their triangles are the region's.

/// The most vertices of an island: with one more a normal can be fitted to the others.
const LARGEST: usize = 6;

/// Which of the `outside` triangles belong to islands: batches connected by vertices, of at most six boundary vertices
/// and no others, with a triangle on both sides of every edge. `inside` are the triangles of the region.
pub(crate) fn islands(
    inside: &[[u32; 3]],
    outside: &[[u32; 3]],
    is_boundary: impl Fn(u32) -> bool,
) -> Vec<bool> {
    let mut on_island = vec![false; outside.len()];
    let of_boundary = |tri: &[u32; 3]| tri.iter().all(|&v| is_boundary(v));
    if !outside.iter().any(of_boundary) {
        return on_island;
    }
    let edges = directed_edges(inside.iter().chain(outside), &is_boundary);
    let closed = |tri: &[u32; 3]| (0..3).all(|k| edges.binary_search(&[tri[(k + 1) % 3], tri[k]]).is_ok());
    for group in batches(outside) {
        let triangles = || group.iter().map(|&t| &outside[t as usize]);
        let mut vertices: Vec<u32> = triangles().flatten().copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        if vertices.len() <= LARGEST && triangles().all(|tri| of_boundary(tri) && closed(tri)) {
            group.iter().for_each(|&t| on_island[t as usize] = true);
        }
    }
    on_island
}

/// The triangles' edges between boundary vertices, sorted.
fn directed_edges<'a>(
    triangles: impl Iterator<Item = &'a [u32; 3]>,
    is_boundary: impl Fn(u32) -> bool,
) -> Vec<[u32; 2]> {
    let all = triangles.flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut edges: Vec<[u32; 2]> = all.filter(|&[a, b]| is_boundary(a) && is_boundary(b)).collect();
    edges.sort_unstable();
    edges
}

/// The triangles' numbers, by batches with common vertices.
fn batches(triangles: &[[u32; 3]]) -> Vec<Vec<u32>> {
    let mut by_vertex: Vec<(u32, u32)> = Vec::with_capacity(3 * triangles.len());
    for (t, tri) in triangles.iter().enumerate() {
        by_vertex.extend(tri.iter().map(|&v| (v, t as u32)));
    }
    by_vertex.sort_unstable();
    let mut seen = vec![false; triangles.len()];
    let mut batches = Vec::new();
    for first in 0..triangles.len() {
        if std::mem::replace(&mut seen[first], true) {
            continue;
        }
        let mut group = vec![first as u32];
        let mut next = 0;
        while next < group.len() {
            for v in triangles[group[next] as usize] {
                let begin = by_vertex.partition_point(|&(w, _)| w < v);
                for &(_, t) in by_vertex[begin..].iter().take_while(|&&(w, _)| w == v) {
                    if !std::mem::replace(&mut seen[t as usize], true) {
                        group.push(t);
                    }
                }
            }
            next += 1;
        }
        batches.push(group);
    }
    batches
}
