//! Several loops made one polygon: cut open along connections from loop to loop.
//!
//! The connections are a minimum spanning tree of the loops. The polygon runs along each of them twice, so that its
//! triangulation is that of a surface with all the loops for its boundary, cut open. Whatever that triangulation is, the
//! surface winds around the loops as the connections do; so these have to lie near to where the surface will: short, and going
//! on from the mesh rather than back over it. Guides that are given come first; those that the tree has no use for divide the
//! polygon.

use nalgebra::Vector3;

use super::loop_set::LoopSet;
use crate::mesh::NONE;
use crate::mesh::disjoint_sets::DisjointSets;

/// A connection that leaves the mesh backwards counts as so many times longer, at each end (half of it where it goes sideways).
/// Of 13 cases, half: 3 change, 2 get another triangulation, +1 % iterations, 1 fails; double: 2 change, 2 get another triangulation.
const BACKWARDS: f64 = 2.0;

/// From a vertex of one loop to one of another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Connection {
    pub(super) from: u32,
    pub(super) to: u32,
}

/// A connection and its length as it counts.
type Candidate = (f64, Connection);

/// The connections between loops, one fewer than these, guides among them where they lead to another loop. No vertex has two.
pub(super) fn connections(set: &LoopSet) -> Vec<Connection> {
    let onward = set.onward();
    let mut is_used = vec![false; set.x.len()];
    let mut joined = DisjointSets::new(set.count());
    let mut found = Vec::new();
    for &[from, to] in &set.guides {
        is_used[from as usize] = true;
        is_used[to as usize] = true;
        let [a, b] = [from, to].map(|v| set.loop_of(v as usize) as u32);
        if joined.smallest(a) != joined.smallest(b) {
            joined.unite(a, b);
            found.push(Connection { from, to });
        }
    }
    let pairs = (0..set.count()).flat_map(|a| (a + 1..set.count()).map(move |b| [a, b]));
    let mut best: Vec<([usize; 2], Option<Candidate>)> = pairs
        .map(|pair| (pair, shortest(set, &onward, &is_used, pair)))
        .collect();
    while found.len() + 1 < set.count() {
        best.retain(|([a, b], _)| joined.smallest(*a as u32) != joined.smallest(*b as u32));
        for (pair, connection) in &mut best {
            let is_lost = |b: &Connection| is_used[b.from as usize] || is_used[b.to as usize];
            if connection
                .as_ref()
                .is_some_and(|(_, connection)| is_lost(connection))
            {
                *connection = shortest(set, &onward, &is_used, *pair);
            }
        }
        let candidates = best
            .iter()
            .filter_map(|(pair, connection)| Some((*pair, (*connection)?)));
        let Some(([a, b], (_, connection))) = candidates.min_by(|x, y| x.1.0.total_cmp(&y.1.0)) else {
            return found;
        };
        joined.unite(a as u32, b as u32);
        is_used[connection.from as usize] = true;
        is_used[connection.to as usize] = true;
        found.push(connection);
    }
    found
}

/// The shortest connection between two loops, and its length as it counts.
fn shortest(
    set: &LoopSet,
    onward: &[Vector3<f64>],
    is_used: &[bool],
    [a, b]: [usize; 2],
) -> Option<Candidate> {
    let mut best: Option<Candidate> = None;
    let free = |of: usize| set.range(of).filter(|&v| !is_used[v]);
    for v in free(a) {
        for w in free(b) {
            let way = set.x[w] - set.x[v];
            let length = way.norm();
            if best.is_some_and(|best| length >= best.0) {
                continue;
            }
            let turn = 2.0 * length - way.dot(&onward[v]) + way.dot(&onward[w]);
            let cost = length + 0.5 * BACKWARDS * turn;
            if best.is_none_or(|best| cost < best.0) {
                let connection = Connection {
                    from: v as u32,
                    to: w as u32,
                };
                best = Some((cost, connection));
            }
        }
    }
    best
}

/// The polygon.
#[derive(Debug)]
pub(super) struct CutPolygon {
    /// Per vertex of the polygon the loops' vertex; ends of connections come twice.
    pub(super) of: Vec<u32>,
    /// Per edge to the next vertex the mesh's normal beyond it; on a connection that of a surface which goes on from both ends.
    pub(super) normals: Vec<Vector3<f64>>,
    /// Per connection the polygon's edges along it, by their first vertices.
    pub(super) sides: Vec<[u32; 2]>,
    /// Pairs (smaller, larger) of the polygon's vertices that may have no edge, sorted.
    pub(super) taken: Vec<(u32, u32)>,
    /// Pairs (smaller, larger) of the polygon's vertices that shall have an edge, per guide that is no connection.
    pub(super) guides: Vec<(u32, u32)>,
}

impl CutPolygon {
    pub(super) fn new(set: &LoopSet, connections: &[Connection]) -> Self {
        let mut across = vec![NONE; set.x.len()];
        for connection in connections {
            across[connection.from as usize] = connection.to;
            across[connection.to as usize] = connection.from;
        }
        let length = set.x.len() + 2 * connections.len();
        let mut cut = Self {
            of: Vec::with_capacity(length),
            normals: Vec::with_capacity(length),
            sides: Vec::new(),
            taken: Vec::new(),
            guides: Vec::new(),
        };
        // The place of each vertex, and the place from which a connection leaves it.
        let (mut place, mut leaves) = (vec![NONE; across.len()], vec![NONE; across.len()]);
        let mut v = 0;
        let mut crossed = across[0] != NONE;
        while cut.of.len() < length {
            let at = cut.of.len() as u32;
            cut.of.push(v as u32);
            let connection = across[v];
            if connection == NONE || crossed {
                place[v] = at;
                cut.normals.push(set.normals[v]);
                v = set.after(v);
                crossed = false;
            } else {
                leaves[v] = at;
                cut.normals.push(set.normal_between(v, connection as usize));
                v = connection as usize;
                crossed = true;
            }
        }
        let sides = connections
            .iter()
            .map(|b| [b.from, b.to].map(|v| leaves[v as usize]));
        cut.sides = sides.collect();
        cut.take(set, connections, &place, &leaves);
        let is_chord = |&[a, b]: &[u32; 2]| across[a as usize] != b;
        let chord = |&[a, b]: &[u32; 2]| {
            let [p, q] = [a, b].map(|v| place[v as usize]);
            (p.min(q), p.max(q))
        };
        cut.guides = set.guides.iter().filter(|g| is_chord(g)).map(chord).collect();
        cut
    }

    /// Edges of the mesh and connections, between all copies of their ends, and edges between two copies of a vertex.
    fn take(&mut self, set: &LoopSet, connections: &[Connection], place: &[u32], leaves: &[u32]) {
        let copies = |v: u32| [place, leaves].map(|list| list[v as usize]);
        let ends = connections.iter().flat_map(|b| [b.from, b.to]);
        let twice = ends.map(|v| (v, v));
        let edges = connections.iter().map(|b| (b.from, b.to));
        for (a, b) in set.taken.iter().copied().chain(edges).chain(twice) {
            for p in copies(a).into_iter().filter(|&p| p != NONE) {
                for q in copies(b).into_iter().filter(|&q| q != NONE && q != p) {
                    self.taken.push((p.min(q), p.max(q)));
                }
            }
        }
        self.taken.sort_unstable();
        self.taken.dedup();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Circles of `n` vertices about points of the x axis, all seen counter-clockwise from above; the mesh is around them.
    fn circles(n: usize, centres: &[f64]) -> LoopSet {
        let mut set = LoopSet {
            x: Vec::new(),
            normals: vec![Vector3::z(); n * centres.len()],
            starts: (0..=centres.len()).map(|k| n * k).collect(),
            taken: Vec::new(),
            guides: Vec::new(),
        };
        for c in centres {
            set.x.extend((0..n).map(|i| {
                let (sin, cos) = (std::f64::consts::TAU * i as f64 / n as f64).sin_cos();
                Vector3::new(c + cos, sin, 0.0)
            }));
        }
        set
    }

    #[test]
    fn the_polygon_runs_along_every_edge_once_and_along_every_connection_twice() {
        let set = circles(8, &[0.0, 3.0, 6.0, 9.0]);
        let found = connections(&set);
        assert_eq!(found.len(), 3);
        let cut = CutPolygon::new(&set, &found);
        let n = cut.of.len();
        assert_eq!(n, 32 + 6);
        let mut edges: Vec<(u32, u32)> = (0..n).map(|p| (cut.of[p], cut.of[(p + 1) % n])).collect();
        edges.sort_unstable();
        let mut expected: Vec<(u32, u32)> = (0..32).map(|v| (v, set.after(v as usize) as u32)).collect();
        for connection in &found {
            expected.extend([(connection.from, connection.to), (connection.to, connection.from)]);
        }
        expected.sort_unstable();
        assert_eq!(edges, expected);
        for (side, connection) in cut.sides.iter().zip(&found) {
            let ends = side.map(|p| [cut.of[p as usize], cut.of[(p as usize + 1) % n]]);
            assert_eq!(
                ends,
                [[connection.from, connection.to], [connection.to, connection.from]]
            );
        }
    }

    #[test]
    fn connections_lead_from_neighbour_to_neighbour_and_share_no_vertex() {
        let set = circles(3, &[0.0, 9.0, 3.0, 6.0]);
        let found = connections(&set);
        let mut loops: Vec<[usize; 2]> = found
            .iter()
            .map(|b| [b.from, b.to].map(|v| set.loop_of(v as usize)))
            .collect();
        loops.iter_mut().for_each(|pair| pair.sort_unstable());
        loops.sort_unstable();
        assert_eq!(loops, [[0, 2], [1, 3], [2, 3]]);
        let mut ends: Vec<u32> = found.iter().flat_map(|b| [b.from, b.to]).collect();
        ends.sort_unstable();
        ends.dedup();
        assert_eq!(ends.len(), 6);
    }
}
