//! Islands: a few fixed vertices inside the region that happen to have triangles among themselves. So few vertices say
//! nothing about a tangent plane; they are interpolated like single fixed vertices, and their triangles are the region's.

use super::disjoint_sets::DisjointSets;
use super::rows::Rows;

/// The most vertices of an island: with one more a normal can be fitted to the others.
/// Of 60 cases, half: 2 change by up to 0.01 edges; double: 2 change by up to 0.009 edges.
const LARGEST: usize = 6;

/// Which of the `outside` triangles belong to islands: groups connected by vertices, of at most six boundary vertices
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
    let groups = connected(outside);
    for group in (0..groups.len()).map(|i| groups.row(i)) {
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

/// The triangles' numbers: one row for each group that is connected by vertices, and empty ones.
fn connected(triangles: &[[u32; 3]]) -> Rows<u32> {
    let mut corners: Vec<(u32, u32)> = (0..)
        .zip(triangles)
        .flat_map(|(t, tri)| tri.map(|v| (v, t)))
        .collect();
    corners.sort_unstable();
    let mut sets = DisjointSets::new(triangles.len());
    for pair in corners.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        sets.unite(pair[0].1, pair[1].1);
    }
    let members: Vec<(u32, u32)> = (0..triangles.len() as u32)
        .map(|t| (sets.smallest(t), t))
        .collect();
    Rows::collect(triangles.len(), members.into_iter())
}
