//! Boundary edges of a mesh that lie on each other are one edge of the surface: which vertices they join.
//!
//! Only vertices on boundary edges are looked at. So a mesh without copies costs one pass over its triangles, and nothing is
//! joined to a vertex that has a closed ring.

use super::disjoint_sets::DisjointSets;
use super::halfedge::NONE;
use super::places::places;
use super::rows::Rows;

/// Each round drops the stitches at vertices that would not be sound; others may get unsound by that only where the mesh was not
/// a manifold before. Then nothing is joined.
/// Half or double, of 3 cases: none changes.
const ROUNDS: usize = 32;

/// More edges between two places are not looked through: on such a mesh no two of them are alone.
/// Half or double, of 3 cases: none changes.
const MANY: usize = 64;

/// Four vertices of two edges: the first is joined to the second, the third to the fourth.
type Stitch = [u32; 4];

/// The smallest number of each vertex, where any has several. Every triangle has to name vertices that exist.
pub(super) fn representatives(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    within: f64,
) -> Option<Vec<u32>> {
    let open = open_vertices(positions.len(), triangles);
    let place = places(positions, &open, within)?;
    let mut stitches = stitches(positions, triangles, &open, &place);
    for _ in 0..ROUNDS {
        if stitches.is_empty() {
            return None;
        }
        let smallest = joined(positions.len(), &stitches);
        let unsound = unsound(triangles, &smallest);
        if unsound.is_empty() {
            return Some(smallest);
        }
        let is_sound = |v: &u32| unsound.binary_search(&smallest[*v as usize]).is_err();
        stitches.retain(|stitch| stitch.iter().all(is_sound));
    }
    None
}

/// The vertices on boundary edges, ascending. Around a vertex with a closed ring every neighbour is once the next corner
/// and once the one before: a sum over its triangles vanishes. Numbers of 64 bits that look random cancel nowhere else.
fn open_vertices(vertices: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
    let mut sum = vec![0u64; vertices];
    for tri in triangles {
        let [a, b, c] = tri.map(scattered);
        for (&v, (next, before)) in tri.iter().zip([(b, c), (c, a), (a, b)]) {
            let sum = &mut sum[v as usize];
            *sum = sum.wrapping_add(next).wrapping_sub(before);
        }
    }
    let open = (0..).zip(sum).filter(|(_, sum)| *sum != 0);
    open.map(|(v, _)| v).collect()
}

/// Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014: the mixing function of SplitMix64.
#[inline]
fn scattered(v: u32) -> u64 {
    let mut z = u64::from(v).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// An edge between two places (the smaller one first), its ends in its own direction, and the third corner of its triangle.
type Edge = ([u32; 2], [u32; 2], u32);

/// Pairs of boundary edges that lie on each other, and on no third one; not of triangles that lie on each other.
fn stitches(positions: &[[f64; 3]], triangles: &[[u32; 3]], open: &[u32], place: &[u32]) -> Vec<Stitch> {
    let mut count = vec![0u32; place.len()];
    place.iter().for_each(|&p| count[p as usize] += 1);
    let mut at = vec![NONE; positions.len()];
    open.iter().zip(place).for_each(|(&v, &p)| at[v as usize] = p);
    let is_shared = |p: u32| count[p as usize] > 1;
    let mut edges: Vec<Edge> = Vec::new();
    for &[a, b, c] in triangles {
        for (v, w, apex) in [(a, b, c), (b, c, a), (c, a, b)] {
            let (p, q) = (at[v as usize], at[w as usize]);
            if p != NONE && q != NONE && p != q && (is_shared(p) || is_shared(q)) {
                edges.push(([p.min(q), p.max(q)], [v, w], apex));
            }
        }
    }
    edges.sort_unstable();
    let mut found = Vec::new();
    let mut alone: Vec<&Edge> = Vec::new();
    for same in edges
        .chunk_by(|e, f| e.0 == f.0)
        .filter(|same| same.len() <= MANY)
    {
        let is_alone = |(_, [v, w], _): &&Edge| {
            let along = same.iter().filter(|f| f.1 == [*v, *w]).count();
            along == 1 && !same.iter().any(|f| f.1 == [*w, *v])
        };
        alone.clear();
        alone.extend(same.iter().filter(is_alone));
        if let [(_, e, a), (_, f, b)] = alone.as_slice()
            && at[e[0] as usize] == at[f[1] as usize]
            && positions[*a as usize] != positions[*b as usize]
        {
            found.push([e[0], f[1], e[1], f[0]]);
        }
    }
    found
}

/// The smallest number of each vertex.
fn joined(vertices: usize, stitches: &[Stitch]) -> Vec<u32> {
    let mut sets = DisjointSets::new(vertices);
    for &[a, b, c, d] in stitches {
        sets.unite(a, b);
        sets.unite(c, d);
    }
    (0..vertices as u32).map(|v| sets.smallest(v)).collect()
}

/// Joined vertices around which the triangles are not a single fan of sound triangles; ascending.
fn unsound(triangles: &[[u32; 3]], smallest: &[u32]) -> Vec<u32> {
    let mut is_joined = vec![false; smallest.len()];
    for (_, &s) in (0u32..).zip(smallest).filter(|(v, s)| v != *s) {
        is_joined[s as usize] = true;
    }
    let corners = triangles.iter().flat_map(|tri| {
        let [a, b, c] = tri.map(|v| smallest[v as usize]);
        [(a, [b, c]), (b, [c, a]), (c, [a, b])]
    });
    let corners = corners.filter(|(v, _)| is_joined[*v as usize]);
    let mut fans = Rows::collect(smallest.len(), corners);
    let joined = (0..smallest.len() as u32).filter(|&v| is_joined[v as usize]);
    joined.filter(|&v| !is_fan(v, fans.row_mut(v as usize))).collect()
}

/// Whether triangles `(v, a, b)`, as `[a, b]`, are one fan, open or closed, whose edges have two triangles at most.
fn is_fan(v: u32, fan: &mut [[u32; 2]]) -> bool {
    if fan.iter().any(|&[a, b]| a == v || b == v || a == b) {
        return false;
    }
    fan.sort_unstable();
    if fan.windows(2).any(|pair| pair[0][0] == pair[1][0]) {
        return false;
    }
    let after = |a: u32| {
        let found = fan.binary_search_by_key(&a, |entry| entry[0]);
        found.ok().map(|i| fan[i][1])
    };
    let mut ends: Vec<u32> = fan.iter().map(|entry| entry[1]).collect();
    ends.sort_unstable();
    let is_first = |entry: &&[u32; 2]| ends.binary_search(&entry[0]).is_err();
    let first = fan
        .iter()
        .find(is_first)
        .or(fan.first())
        .map_or(v, |entry| entry[0]);
    let mut at = first;
    for step in 0..fan.len() {
        match after(at) {
            Some(_) if step > 0 && at == first => return false,
            Some(next) => at = next,
            None => return false,
        }
    }
    // A ring of two are two triangles back to back.
    if at == first {
        fan.len() > 2
    } else {
        after(at).is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fans_and_what_is_none() {
        let is = |fan: &[[u32; 2]]| is_fan(0, &mut fan.to_vec());
        assert!(is(&[[1, 2]]));
        assert!(is(&[[2, 3], [1, 2]]));
        assert!(is(&[[2, 3], [3, 1], [1, 2]]));
        // Two fans, back to back, an edge in the same direction twice, a loop with a tail, a corner twice.
        assert!(!is(&[[1, 2], [3, 4]]));
        assert!(!is(&[[1, 2], [2, 1]]));
        assert!(!is(&[[1, 2], [1, 3]]));
        assert!(!is(&[[1, 3], [2, 3]]));
        assert!(!is(&[[1, 2], [2, 3], [3, 2]]));
        assert!(!is(&[[1, 2], [2, 3], [3, 1], [4, 5], [5, 6], [6, 4]]));
        assert!(!is(&[[1, 1]]));
        assert!(!is(&[[0, 1]]));
    }

    #[test]
    fn open_vertices_are_those_on_boundary_edges() {
        // A tetrahedron, and one without a face.
        let closed = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];
        assert_empty!(open_vertices(4, &closed));
        assert_eq!(open_vertices(5, &closed[..3]), [1, 2, 3]);
        // Triangles that name a vertex twice add nothing.
        assert_empty!(open_vertices(3, &[[0, 0, 1], [2, 2, 2]]));
    }
}
