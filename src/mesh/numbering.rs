//! Local numbers of free vertices that keep neighbours near each other in memory, whatever the order of the file: what is
//! gathered around a vertex is then in the cache already.

use super::rows::Rows;

/// How free vertices are numbered among themselves. Both know of connectivity and the caller's order only.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Numbering {
    /// In the caller's order: where something goes through them one after the other.
    AsGiven,
    /// Breadth first, from an end of the region: neighbours are at most two layers apart.
    BreadthFirst,
}

/// The free vertices of these triangles (local numbers) breadth first, from the vertex that another such walk came to last:
/// layers are short then.
pub(super) fn breadth_first(free: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
    let sides = triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let is_free = move |v: u32| (v as usize) < free;
    let neighbours = Rows::collect(free, sides.filter(move |&(a, b)| is_free(a) && is_free(b)));
    let there = walk(&neighbours, 0..free as u32);
    walk(&neighbours, there.iter().rev().copied())
}

/// Breadth first from the first of `starts`; where that does not lead to all others, again from the next.
fn walk(neighbours: &Rows<u32>, starts: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut reached = vec![false; neighbours.len()];
    let mut order: Vec<u32> = Vec::with_capacity(neighbours.len());
    for start in starts {
        let mut next = order.len();
        if !std::mem::replace(&mut reached[start as usize], true) {
            order.push(start);
        }
        while let Some(&v) = order.get(next) {
            next += 1;
            for &j in neighbours.row(v as usize) {
                if !std::mem::replace(&mut reached[j as usize], true) {
                    order.push(j);
                }
            }
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of triangles over `n` free vertices in a row, numbered at random, between fixed ones.
    fn strip(n: u32) -> Vec<[u32; 3]> {
        // 7 is prime to n.
        let free = |k: u32| k * 7 % n;
        (0..n - 1)
            .flat_map(|k| [[free(k), n + k, free(k + 1)], [free(k + 1), n + k, free(k)]])
            .collect()
    }

    #[test]
    fn a_row_of_vertices_is_numbered_from_one_end_to_the_other() {
        let order = breadth_first(100, &strip(100));
        let mut along: Vec<u32> = (0..100).map(|k| k * 7 % 100).collect();
        if order[0] != along[0] {
            along.reverse();
        }
        assert_eq!(order, along);
    }

    #[test]
    fn every_vertex_has_a_number_also_where_triangles_do_not_hang_together() {
        let mut order = breadth_first(9, &[[0, 8, 3], [5, 4, 20]]);
        order.sort_unstable();
        assert!(order.into_iter().eq(0..9));
    }
}
