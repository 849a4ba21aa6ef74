//! Elimination orders with little fill.

use std::collections::VecDeque;

use super::interrupt::checkpoint;
pub use super::minimum_degree::amd;
use super::parallel;
use super::sparse::{Adjacency, SymmetricPattern};

/// Parts with at most this many vertices are not split further, for separators of the 1- and 2-ring graph.
const LEAF: [usize; 2] = [20, 24];

/// Up to this number of rows, on the 1- and 2-ring graph, minimum degree alone takes less time than dissection and gives less
/// fill. On the 1-ring graph two halves are worth more: threads order, factor and solve with them side by side.
/// Half or double, of 128 cases: none changes.
const DISSECT: [usize; 2] = [60_000, 200_000];
/// Larger matrices are dissected into halves, and further into blocks of at most this number of rows, each ordered by minimum
/// degree.
/// Of 1 case, half: 1 changes by up to 1e-11 edges; double: 1 changes by up to 5e-12 edges.
const BLOCK: usize = 100_000;

/// The recommended order for a matrix of this `pattern`, that of the `ring`-ring graph (1 or 2) of the 1-ring
/// graph `graph`: `order[new] = old`. Without positions the order depends on the connectivity alone:
/// [`landmark_coordinates`] are made if the matrix is large enough to need them.
pub fn fill_reducing(
    pattern: &SymmetricPattern,
    graph: &SymmetricPattern,
    ring: usize,
    coords: Option<&[[f64; 3]]>,
) -> Vec<u32> {
    let n = pattern.order();
    let ring = ring.clamp(1, 2);
    if n <= DISSECT[ring - 1] {
        return amd(pattern);
    }
    let adjacency = graph.adjacency();
    let made;
    let coords = match coords {
        Some(coords) => coords,
        None => {
            made = landmark_coordinates(graph);
            &made
        }
    };
    let mut order: Vec<u32> = (0..n as u32).collect();
    let blocks = Dissection {
        graph: &adjacency,
        ring,
        coords,
        pattern: Some(pattern),
        leaf: BLOCK.min(n.div_ceil(2)),
    };
    blocks.order(&mut order, PARALLEL_DEPTH);
    order
}

/// The minimum degree order of the part of a matrix that belongs to some of its rows.
fn amd_within(pattern: &SymmetricPattern, rows: &mut [u32], local: &mut [u32]) {
    // In ascending order the local columns ascend as well.
    rows.sort_unstable();
    for (k, &v) in rows.iter().enumerate() {
        local[v as usize] = k as u32;
    }
    let mut part = SymmetricPattern {
        start: Vec::with_capacity(rows.len() + 1),
        column: Vec::new(),
    };
    part.start.push(0);
    for &v in &*rows {
        let inside = pattern
            .row(v as usize)
            .iter()
            .map(|&j| local[j as usize])
            .filter(|&k| k != u32::MAX);
        part.column.extend(inside);
        part.start.push(part.column.len());
    }
    for &v in &*rows {
        local[v as usize] = u32::MAX;
    }
    let order = amd(&part);
    let old = rows.to_vec();
    for (v, k) in rows.iter_mut().zip(order) {
        *v = old[k as usize];
    }
}

/// An order by recursive bisection of the vertices of the 1-ring graph `graph`, `order[new] = old`, for a
/// matrix on its `ring`-ring graph (1 or 2). The cuts are planes across the longer directions of `coords`,
/// one position per vertex; bad positions cost fill but nothing else.
pub fn nested_dissection(graph: &SymmetricPattern, ring: usize, coords: &[[f64; 3]]) -> Vec<u32> {
    let n = graph.order();
    debug_assert_eq!(coords.len(), n);
    let ring = ring.clamp(1, 2);
    let adjacency = graph.adjacency();
    let mut order: Vec<u32> = (0..n as u32).collect();
    let whole = Dissection {
        graph: &adjacency,
        ring,
        coords,
        pattern: None,
        leaf: LEAF[ring - 1],
    };
    whole.order(&mut order, PARALLEL_DEPTH);
    order
}

/// The first levels of the bisection hand their halves to two threads.
/// Half or double, of 1 case: none changes.
const PARALLEL_DEPTH: usize = 2;
/// Smaller parts are not worth a second thread.
/// Half or double, of 1 case: none changes.
const PARALLEL: usize = 10_000;

/// What is dissected, and how far.
#[derive(Clone, Copy)]
struct Dissection<'a> {
    graph: &'a Adjacency,
    ring: usize,
    coords: &'a [[f64; 3]],
    /// The matrix whose leaves are ordered by minimum degree; without it they are left as they are.
    pattern: Option<&'a SymmetricPattern>,
    /// Parts with at most this many vertices are leaves.
    leaf: usize,
}

impl Dissection<'_> {
    /// Orders a part of the vertices; the recursion is at most `depth` deep.
    fn order(self, order: &mut [u32], depth: usize) {
        let mut split = Bisection::new(self.graph, self.ring, self.coords);
        if depth > 0
            && order.len() > PARALLEL.max(self.leaf)
            && let Some([low, high]) = split.bisect(order)
        {
            drop(split);
            let (low, rest) = order.split_at_mut(low);
            let high = &mut rest[..high];
            parallel::join(|| self.order(low, depth - 1), || self.order(high, depth - 1));
            return;
        }
        let mut local = vec![
            u32::MAX;
            if self.pattern.is_some() {
                self.coords.len()
            } else {
                0
            }
        ];
        let mut parts = Vec::new();
        parts.push(0..order.len());
        while let Some(part) = parts.pop() {
            checkpoint();
            let begin = part.start;
            let halves = if part.len() > self.leaf {
                split.bisect(&mut order[part.clone()])
            } else {
                None
            };
            if let Some([low, high]) = halves {
                parts.push(begin..begin + low);
                parts.push(begin + low..begin + low + high);
            } else if let Some(pattern) = self.pattern {
                amd_within(pattern, &mut order[part], &mut local);
            }
        }
    }
}

/// The normals of the cutting planes: the axes, and the diagonals of their planes for large parts.
const DIRECTIONS: [[f64; 3]; 9] = {
    const D: f64 = std::f64::consts::FRAC_1_SQRT_2;
    [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [D, D, 0.0],
        [D, -D, 0.0],
        [D, 0.0, D],
        [D, 0.0, -D],
        [0.0, D, D],
        [0.0, D, -D],
    ]
};

/// Parts with more vertices try all directions that are long enough.
/// Of 1 case, half: 1 changes by up to 8e-12 edges; double: 1 changes by up to 3e-12 edges.
const TRY_ALL: usize = 1000;

fn along(direction: &[f64; 3], x: &[f64; 3]) -> f64 {
    direction[0] * x[0] + direction[1] * x[1] + direction[2] * x[2]
}

/// The state of the recursive bisection.
struct Bisection<'a> {
    graph: &'a Adjacency,
    ring: usize,
    coords: &'a [[f64; 3]],
    /// `stamp`: low side of the current part, `stamp + 1`: high side, `stamp + 2`: separator.
    side: Vec<u32>,
    stamp: u32,
    low: Vec<u32>,
    high: Vec<u32>,
    separator: Vec<u32>,
    best: Vec<u32>,
    key: Vec<(f64, u32)>,
}

impl<'a> Bisection<'a> {
    fn new(graph: &'a Adjacency, ring: usize, coords: &'a [[f64; 3]]) -> Self {
        Self {
            graph,
            ring,
            coords,
            side: vec![0; coords.len()],
            stamp: 0,
            low: Vec::new(),
            high: Vec::new(),
            separator: Vec::new(),
            best: Vec::new(),
            key: Vec::new(),
        }
    }

    /// Reorders a part to low side, high side, separator and returns the sizes of the sides. None if one of
    /// them would be empty.
    fn bisect(&mut self, part: &mut [u32]) -> Option<[usize; 2]> {
        let middle = part.len() / 2;
        let extent = self.extents(part);
        let (tried, least) = if part.len() > TRY_ALL {
            (DIRECTIONS.len(), 0.6)
        } else {
            (3, 0.8)
        };
        let longest = extent[..tried].iter().fold(0.0, |a: f64, &b| a.max(b));
        let mut chosen = None;
        for (d, direction) in DIRECTIONS.iter().enumerate().take(tried) {
            if extent[d] < least * longest {
                continue;
            }
            self.halve(part, direction);
            self.find_separator(part, middle);
            if chosen.is_none() || self.separator.len() < self.best.len() {
                std::mem::swap(&mut self.separator, &mut self.best);
                chosen = Some(d);
            }
        }
        let chosen = chosen?;
        // Back to the best cut: the same vertices whatever their order.
        self.halve(part, &DIRECTIONS[chosen]);
        self.mark(part, middle);
        for &v in &self.best {
            self.side[v as usize] = self.stamp + 2;
        }
        self.low.clear();
        self.high.clear();
        for &v in &*part {
            match self.side[v as usize] - self.stamp {
                0 => self.low.push(v),
                1 => self.high.push(v),
                _ => {}
            }
        }
        let sizes = [self.low.len(), self.high.len()];
        if sizes[0] == 0 || sizes[1] == 0 {
            return None;
        }
        let (a, rest) = part.split_at_mut(sizes[0]);
        let (b, c) = rest.split_at_mut(sizes[1]);
        a.copy_from_slice(&self.low);
        b.copy_from_slice(&self.high);
        c.copy_from_slice(&self.best);
        Some(sizes)
    }

    /// The extent of a part along the directions.
    fn extents(&self, part: &[u32]) -> [f64; DIRECTIONS.len()] {
        let mut low = [f64::INFINITY; DIRECTIONS.len()];
        let mut high = [f64::NEG_INFINITY; DIRECTIONS.len()];
        for &v in part {
            for (k, direction) in DIRECTIONS.iter().enumerate() {
                let x = along(direction, &self.coords[v as usize]);
                low[k] = low[k].min(x);
                high[k] = high[k].max(x);
            }
        }
        std::array::from_fn(|k| high[k] - low[k])
    }

    /// Partitions a part at its median along a direction, ties by the index.
    fn halve(&mut self, part: &mut [u32], direction: &[f64; 3]) {
        self.key.clear();
        self.key.extend(
            part.iter()
                .map(|&v| (along(direction, &self.coords[v as usize]), v)),
        );
        self.key
            .select_nth_unstable_by(part.len() / 2, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (v, key) in part.iter_mut().zip(&self.key) {
            *v = key.1;
        }
    }

    fn mark(&mut self, part: &[u32], middle: usize) {
        self.stamp += 3;
        for (k, &v) in part.iter().enumerate() {
            self.side[v as usize] = self.stamp + u32::from(k >= middle);
        }
    }

    /// The smallest of the separators at hand, for a part whose halves are its two ends.
    fn find_separator(&mut self, part: &[u32], middle: usize) {
        self.mark(part, middle);
        let (side, graph, stamp) = (&self.side, self.graph, self.stamp);
        let boundary = |half: &[u32], other: u32, out: &mut Vec<u32>| {
            out.clear();
            out.extend(
                half.iter()
                    .filter(|&&v| graph.of(v).iter().any(|&w| side[w as usize] == other)),
            );
        };
        boundary(&part[..middle], stamp + 1, &mut self.low);
        boundary(&part[middle..], stamp, &mut self.high);
        self.separator.clear();
        if self.ring == 1 {
            let smaller = if self.low.len() <= self.high.len() {
                &self.low
            } else {
                &self.high
            };
            self.separator.extend_from_slice(smaller);
        } else {
            // One ring on each side: what remains of the sides is three steps apart.
            self.separator.extend_from_slice(&self.low);
            self.separator.extend_from_slice(&self.high);
        }
    }
}

/// Positions made from the graph alone, for [`nested_dissection`]: differences of distances to far-apart
/// landmarks, smoothed over the neighbours. Connected components lie side by side.
pub fn landmark_coordinates(graph: &SymmetricPattern) -> Vec<[f64; 3]> {
    let n = graph.order();
    let ring = graph.adjacency();
    let mut coords = vec![[0.0; 3]; n];
    let mut distance: [Vec<u32>; 5] = std::array::from_fn(|_| vec![u32::MAX; n]);
    let mut component = Vec::new();
    let mut queue = VecDeque::new();
    let mut offset = 0.0;
    for root in 0..n as u32 {
        if distance[0][root as usize] != u32::MAX {
            continue;
        }
        component.clear();
        let far = breadth_first(&ring, root, &mut distance[0], &mut queue, &mut component);
        let reached = &mut Vec::new();
        let opposite = breadth_first(&ring, far, &mut distance[1], &mut queue, reached);
        breadth_first(&ring, opposite, &mut distance[2], &mut queue, reached);
        let [_, from_a, from_b, from_c, from_d] = &mut distance;
        // A third landmark off the axis of the first two: far from both, equally far if possible.
        let side = component.iter().copied().max_by_key(|&v| {
            let (a, b) = (from_a[v as usize], from_b[v as usize]);
            (
                2 * a.min(b),
                std::cmp::Reverse(a.abs_diff(b)),
                std::cmp::Reverse(v),
            )
        });
        let across = breadth_first(&ring, side.unwrap_or(root), from_c, &mut queue, reached);
        breadth_first(&ring, across, from_d, &mut queue, reached);
        let mut last = offset;
        for &v in &component {
            let [a, b, c, d] = [&*from_a, &*from_b, &*from_c, &*from_d].map(|d| f64::from(d[v as usize]));
            coords[v as usize] = [offset + 0.5 * (a - b), 0.5 * (c - d), 0.25 * (a + b)];
            last = f64::max(last, coords[v as usize][0]);
        }
        offset = last + 0.5 * f64::from(from_a[opposite as usize]) + 1.0;
    }
    for _ in 0..SMOOTHING {
        coords = smoothed(&ring, &coords);
    }
    coords
}

/// The sweeps that turn the integer distances into positions without ties.
/// Of 1 case, half: 1 changes by up to 1e-11 edges; double: 1 changes by up to 7e-12 edges.
const SMOOTHING: usize = 10;

fn smoothed(ring: &Adjacency, coords: &[[f64; 3]]) -> Vec<[f64; 3]> {
    parallel::map_each(coords.len(), PARALLEL, |i| {
        let near = ring.of(i as u32);
        let mut sum = coords[i];
        for &j in near {
            for k in 0..3 {
                sum[k] += coords[j as usize][k];
            }
        }
        sum.map(|s| s / (near.len() + 1) as f64)
    })
}

/// Distances from a root within its component. Appends the component to `reached` and returns the vertex
/// reached last.
fn breadth_first(
    ring: &Adjacency,
    root: u32,
    distance: &mut [u32],
    queue: &mut VecDeque<u32>,
    reached: &mut Vec<u32>,
) -> u32 {
    let mut last = root;
    distance[root as usize] = 0;
    queue.push_back(root);
    while let Some(v) = queue.pop_front() {
        last = v;
        reached.push(v);
        for &w in ring.of(v) {
            if distance[w as usize] == u32::MAX {
                distance[w as usize] = distance[v as usize] + 1;
                queue.push_back(w);
            }
        }
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sparse::tests::grid;
    use crate::symbolic::Symbolic;

    fn is_permutation(order: &[u32], n: usize) -> bool {
        let mut sorted = order.to_vec();
        sorted.sort_unstable();
        sorted.iter().copied().eq(0..n as u32)
    }

    #[test]
    fn orders_are_permutations_whatever_the_positions() {
        for side in [1, 2, 7, 40] {
            let (graph, coords) = grid(side, true);
            let (n, square) = (graph.order(), graph.square());
            let flat: Vec<[f64; 3]> = coords.iter().map(|x| [1.0, x[1], 0.0]).collect();
            let landmark = landmark_coordinates(&graph);
            assert!(is_permutation(&amd(&graph), n));
            assert!(is_permutation(&amd(&square), n));
            for ring in [1, 2] {
                for coords in [&coords, &flat, &vec![[0.5; 3]; n], &landmark] {
                    assert!(is_permutation(&nested_dissection(&graph, ring, coords), n));
                }
            }
        }
    }

    #[test]
    fn dissection_separates_the_two_ring_graph() {
        let (graph, coords) = grid(30, true);
        let square = graph.square().adjacency();
        let ring = graph.adjacency();
        let mut split = Bisection::new(&ring, 2, &coords);
        let mut part: Vec<u32> = (0..900).collect();
        let [low, high] = split.bisect(&mut part).unwrap();
        let (a, rest) = part.split_at(low);
        let b = &rest[..high];
        assert_all!(a.iter(), |&v| square.of(v).iter().all(|w| !b.contains(w)));
        // Two rows of the grid, and a jagged line.
        assert_below!(rest.len() - high, 4 * 30);
        assert_below!(low.abs_diff(high), 60);
    }

    #[test]
    fn connectivity_alone_orders_as_well_as_positions() {
        let (graph, coords) = grid(100, true);
        let square = graph.square();
        let flops = |order: Vec<u32>| Symbolic::new(&square, &order).flops();
        let natural = flops((0..10_000).collect());
        let by_coords = flops(nested_dissection(&graph, 2, &coords));
        let by_graph = flops(nested_dissection(&graph, 2, &landmark_coordinates(&graph)));
        let by_degree = flops(amd(&square));
        assert_below!(by_graph, 1.3 * by_coords);
        assert_below!(by_graph, 1.5 * by_degree);
        assert_below!(by_graph, 0.05 * natural);
    }

    #[test]
    fn blocks_of_minimum_degree_are_as_good_as_minimum_degree() {
        let (graph, coords) = grid(100, true);
        let (square, ring) = (graph.square(), graph.adjacency());
        let blocks = Dissection {
            graph: &ring,
            ring: 2,
            coords: &coords,
            pattern: Some(&square),
            leaf: 3000,
        };
        let mut order: Vec<u32> = (0..10_000).collect();
        blocks.order(&mut order, 0);
        assert!(is_permutation(&order, 10_000));
        let flops = |order: &[u32]| Symbolic::new(&square, order).flops();
        assert_below!(flops(&order), 1.5 * flops(&amd(&square)));
    }

    #[test]
    fn components_do_not_overlap() {
        let edges = [[0, 1], [1, 2], [3, 4], [5, 6], [6, 7]];
        let x = landmark_coordinates(&SymmetricPattern::from_edges(9, &edges));
        let side = |part: &[usize]| {
            let low = part.iter().map(|&v| x[v][0]).fold(f64::INFINITY, f64::min);
            (
                low,
                part.iter().map(|&v| x[v][0]).fold(f64::NEG_INFINITY, f64::max),
            )
        };
        let parts = [side(&[0, 1, 2]), side(&[3, 4]), side(&[5, 6, 7]), side(&[8])];
        assert!(parts.windows(2).all(|w| w[0].1 < w[1].0), "{parts:?}");
    }
}
