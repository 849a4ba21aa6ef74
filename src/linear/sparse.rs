//! Symmetric sparse matrices: a pattern that is built once, values that are refreshed in place.

/// The lower triangle of a symmetric matrix by rows: row `i` holds the columns `j <= i`, ascending, the
/// diagonal last.
#[derive(Debug, Clone, Default)]
pub struct SymmetricPattern {
    /// `n + 1` offsets into `column`.
    pub start: Vec<usize>,
    /// The columns, row after row.
    pub column: Vec<u32>,
}

/// All neighbours of every vertex of a graph, both directions, without the vertex itself.
#[derive(Debug, Clone, Default)]
pub struct Adjacency {
    /// `n + 1` offsets into `neighbour`.
    pub start: Vec<usize>,
    /// The neighbours, vertex after vertex, ascending.
    pub neighbour: Vec<u32>,
}

impl Adjacency {
    /// The neighbours of one vertex.
    pub fn of(&self, i: u32) -> &[u32] {
        &self.neighbour[self.start[i as usize]..self.start[i as usize + 1]]
    }
}

impl SymmetricPattern {
    /// The number of rows.
    pub fn order(&self) -> usize {
        self.start.len().saturating_sub(1)
    }

    /// The columns of one row, the diagonal last.
    pub fn row(&self, i: usize) -> &[u32] {
        &self.column[self.start[i]..self.start[i + 1]]
    }

    /// The pattern with the given off-diagonal pairs, in any order and orientation, duplicates allowed, and
    /// a full diagonal. The indices must be less than `n`.
    pub fn from_edges(n: usize, edges: &[[u32; 2]]) -> Self {
        let mut start = vec![0_usize; n + 2];
        for &[i, j] in edges {
            start[i.max(j) as usize + 2] += usize::from(i != j);
        }
        for i in 0..n {
            start[i + 2] += start[i + 1];
        }
        let mut bucket = vec![0_u32; start[n + 1]];
        for &[i, j] in edges.iter().filter(|e| e[0] != e[1]) {
            let slot = &mut start[i.max(j) as usize + 1];
            bucket[*slot] = i.min(j);
            *slot += 1;
        }
        let mut pattern = Self {
            start: Vec::with_capacity(n + 1),
            column: Vec::with_capacity(bucket.len() + n),
        };
        pattern.start.push(0);
        for i in 0..n {
            let row = &mut bucket[start[i]..start[i + 1]];
            row.sort_unstable();
            for (k, &j) in row.iter().enumerate() {
                if k == 0 || row[k - 1] != j {
                    pattern.column.push(j);
                }
            }
            pattern.column.push(i as u32);
            pattern.start.push(pattern.column.len());
        }
        pattern
    }

    /// The pattern of the square of the matrix: the 2-ring graph of a 1-ring graph.
    pub fn square(&self) -> Self {
        let n = self.order();
        let ring = self.adjacency();
        let mut mark = vec![u32::MAX; n];
        let mut square = Self {
            start: Vec::with_capacity(n + 1),
            column: Vec::new(),
        };
        square.start.push(0);
        for i in 0..n as u32 {
            let begin = square.column.len();
            mark[i as usize] = i;
            for &j in ring.of(i) {
                for &k in std::iter::once(&j).chain(ring.of(j)) {
                    if k < i && mark[k as usize] != i {
                        mark[k as usize] = i;
                        square.column.push(k);
                    }
                }
            }
            square.column[begin..].sort_unstable();
            square.column.push(i);
            square.start.push(square.column.len());
        }
        square
    }

    /// The neighbours of every row in both directions.
    pub fn adjacency(&self) -> Adjacency {
        let n = self.order();
        let mut start = vec![0_usize; n + 2];
        for i in 0..n {
            for &j in self.row(i).iter().filter(|&&j| j as usize != i) {
                start[i + 2] += 1;
                start[j as usize + 2] += 1;
            }
        }
        for i in 0..n {
            start[i + 2] += start[i + 1];
        }
        let mut neighbour = vec![0_u32; start[n + 1]];
        for i in 0..n {
            for &j in self.row(i).iter().filter(|&&j| j as usize != i) {
                for (a, b) in [(i, j), (j as usize, i as u32)] {
                    neighbour[start[a + 1]] = b;
                    start[a + 1] += 1;
                }
            }
        }
        start.pop();
        Adjacency { start, neighbour }
    }

    /// `y = A x` for the symmetric matrix with these `values` (parallel to `column`), `K` vectors at once.
    pub fn multiply<const K: usize>(&self, values: &[f64], x: &[[f64; K]], y: &mut [[f64; K]]) {
        for (i, xi) in x.iter().enumerate().take(self.order()) {
            let entries = self.start[i]..self.start[i + 1];
            let mut sum = [0.0; K];
            for (&j, &a) in self.column[entries.clone()].iter().zip(&values[entries]) {
                let j = j as usize;
                for k in 0..K {
                    sum[k] += a * x[j][k];
                }
                if j != i {
                    for k in 0..K {
                        y[j][k] += a * xi[k];
                    }
                }
            }
            // Row i is the first to touch y[i]: later rows only add to it.
            y[i] = sum;
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A pseudo-random sequence in [0, 1).
    pub(crate) struct Noise(pub u64);

    impl Noise {
        pub(crate) fn next(&mut self) -> f64 {
            self.0 = self
                .0
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    /// A triangulated jittered grid of `side` x `side` vertices, numbered at random if `shuffle`.
    pub(crate) fn grid(side: usize, shuffle: bool) -> (SymmetricPattern, Vec<[f64; 3]>) {
        let mut noise = Noise(7);
        let n = side * side;
        let mut name: Vec<u32> = (0..n as u32).collect();
        if shuffle {
            for i in (1..n).rev() {
                name.swap(i, (noise.next() * (i + 1) as f64) as usize);
            }
        }
        let mut edges = Vec::new();
        let mut coords = vec![[0.0; 3]; n];
        for r in 0..side {
            for c in 0..side {
                let v = r * side + c;
                coords[name[v] as usize] = [
                    c as f64 + 0.6 * noise.next(),
                    r as f64 + 0.6 * noise.next(),
                    noise.next(),
                ];
                if c + 1 < side {
                    edges.push([name[v], name[v + 1]]);
                }
                if r + 1 < side {
                    edges.push([name[v], name[v + side]]);
                }
                if c + 1 < side && r + 1 < side {
                    let down = noise.next() < 0.5;
                    let diagonal = if down {
                        [v, v + side + 1]
                    } else {
                        [v + 1, v + side]
                    };
                    edges.push(diagonal.map(|v| name[v]));
                }
            }
        }
        (SymmetricPattern::from_edges(n, &edges), coords)
    }

    /// Random values that make the pattern a strictly diagonally dominant Laplacian-like matrix.
    pub(crate) fn laplacian(pattern: &SymmetricPattern, shift: f64) -> Vec<f64> {
        let mut noise = Noise(11);
        let n = pattern.order();
        let mut values = vec![0.0; pattern.column.len()];
        let mut diagonal = vec![shift; n];
        for i in 0..n {
            for t in pattern.start[i]..pattern.start[i + 1] - 1 {
                let w = 0.5 + noise.next();
                values[t] = -w;
                diagonal[i] += w;
                diagonal[pattern.column[t] as usize] += w;
            }
        }
        for i in 0..n {
            values[pattern.start[i + 1] - 1] = diagonal[i];
        }
        values
    }

    #[test]
    fn the_square_of_a_path_reaches_two_steps() {
        let path = SymmetricPattern::from_edges(4, &[[1, 0], [1, 2], [2, 1], [3, 2]]);
        assert_eq!(path.column, [0, 0, 1, 1, 2, 2, 3]);
        let square = path.square();
        assert_eq!(square.column, [0, 0, 1, 0, 1, 2, 1, 2, 3]);
        assert_eq!(square.start, [0, 1, 3, 6, 9]);
    }

    #[test]
    fn adjacency_is_symmetric_and_sorted() {
        let (pattern, _) = grid(9, true);
        let ring = pattern.adjacency();
        for i in 0..81 {
            assert!(ring.of(i).is_sorted());
            assert!(ring.of(i).iter().all(|&j| j != i && ring.of(j).contains(&i)));
        }
        assert_eq!(ring.neighbour.len(), 2 * (pattern.column.len() - 81));
    }

    #[test]
    fn multiply_matches_the_dense_product() {
        let (pattern, _) = grid(5, true);
        let values = laplacian(&pattern, 0.25);
        let x: Vec<[f64; 2]> = (0..25).map(|i| [1.0, f64::from(i)]).collect();
        let mut y = vec![[f64::NAN; 2]; 25];
        pattern.multiply(&values, &x, &mut y);
        let mut dense = [[0.0; 25]; 25];
        let rows = (0..25).flat_map(|i| pattern.row(i).iter().map(move |&j| (i, j as usize)));
        for ((i, j), &a) in rows.zip(&values) {
            dense[i][j] = a;
            dense[j][i] = a;
        }
        for (i, row) in dense.iter().enumerate() {
            let expected: f64 = row.iter().enumerate().map(|(j, a)| a * j as f64).sum();
            assert!((y[i][0] - 0.25).abs() < 1e-12 && (y[i][1] - expected).abs() < 1e-10);
        }
    }
}
