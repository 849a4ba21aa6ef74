//! The symbolic half of a sparse Cholesky factorization: what depends on the pattern and the order alone.

use std::ops::Range;

use super::elimination::{Graph, NONE, children, column_counts, elimination_tree, postorder};
use super::interrupt::checkpoint;
use super::sparse::SymmetricPattern;
use super::supernodes::{Layout, Supernodes};
use super::tile::LANES;

/// Subtrees are split for two or more threads down to this depth.
/// Half or double, of 128 cases: none changes.
const MAX_SPLIT_DEPTH: usize = 6;
/// A subtree with less than this part of all operations is not split further.
/// Half or double, of 128 cases: none changes.
const SPLIT_FRACTION: f64 = 1.0 / 10.0;
/// A subtree with less than this number of operations is not split further.
/// Half or double, of 128 cases: none changes.
const SPLIT_FLOPS: f64 = 2e6;

/// The structure of the factor of `P A P^T = L L^T`: supernodes (groups of columns of equal structure), their
/// assembly tree in postorder, where every entry of the matrix goes, and the split of the work into tasks.
///
/// A supernode `s` with `p` columns and `r` rows below them is stored as a column-major panel of
/// `(p + r) x p` numbers. Its update matrix `r x r`, its columns padded to whole groups of `LANES` rows, is handed
/// to the parent.
#[derive(Debug, Clone)]
pub struct Symbolic {
    pub(crate) n: usize,
    /// The number of values that a factorization expects.
    pub(crate) input: usize,
    /// `order[new] = old`.
    pub(crate) order: Vec<u32>,
    /// Supernode `s` owns the columns `first[s]..first[s + 1]`.
    pub(crate) first: Vec<u32>,
    pub(crate) row_start: Vec<usize>,
    /// The rows below the columns of a supernode, new numbering, ascending.
    pub(crate) rows: Vec<u32>,
    /// Parallel to `rows`: the index of that row in the parent's panel.
    pub(crate) relative: Vec<u32>,
    pub(crate) panel_start: Vec<usize>,
    pub(crate) child_start: Vec<usize>,
    pub(crate) child: Vec<u32>,
    /// Which of the two update stacks a supernode uses: children always use the other one.
    pub(crate) stack: Vec<u8>,
    pub(crate) update_start: Vec<usize>,
    pub(crate) update_size: [usize; 2],
    /// Entries of supernode `s`: `entry_start[s]..entry_start[s + 1]`.
    pub(crate) entry_start: Vec<usize>,
    pub(crate) entry_value: Vec<u32>,
    /// Parallel to `entry_value`: the offset in the panel.
    pub(crate) entry_target: Vec<u32>,
    pub(crate) tasks: Vec<Task>,
    /// The most rows of a front.
    pub(crate) largest: usize,
    flops: f64,
    fill: usize,
}

/// A contiguous range of supernodes: a forest whose trees share their parent. With two `parts` these are done
/// first, independently of each other, and then the chain `top..range.end`.
#[derive(Debug, Clone)]
pub(crate) struct Task {
    pub range: Range<usize>,
    pub top: usize,
    pub parts: Option<[usize; 2]>,
    pub area: [Range<usize>; 2],
}

impl Symbolic {
    /// Analyses the pattern under `order[new] = old`, a permutation of the rows. The order in use is then a
    /// postorder of the elimination tree, with the same fill.
    pub fn new(pattern: &SymmetricPattern, order: &[u32]) -> Self {
        let n = pattern.order();
        debug_assert_eq!(order.len(), n);
        let graph = Graph::new(pattern, order);
        let parent = elimination_tree(&graph);
        let post = postorder(&parent);
        let count = column_counts(&graph, &parent, &post);
        let groups = Supernodes::new(&parent, &post, &count);
        let Layout {
            column_order,
            first,
            parent,
        } = groups.layout();
        let ns = first.len() - 1;

        let (child_start, child) = children(&parent);
        let mut this = Self {
            n,
            input: pattern.column.len(),
            order: column_order
                .iter()
                .map(|&middle| order[middle as usize])
                .collect(),
            first,
            row_start: Vec::with_capacity(ns + 1),
            rows: Vec::new(),
            relative: Vec::new(),
            panel_start: Vec::with_capacity(ns + 1),
            child_start,
            child,
            stack: vec![0; ns],
            update_start: vec![0; ns],
            update_size: [0; 2],
            entry_start: Vec::new(),
            entry_value: Vec::new(),
            entry_target: Vec::new(),
            tasks: Vec::new(),
            largest: 0,
            flops: 0.0,
            fill: 0,
        };
        this.find_rows(pattern, &graph, &column_order);
        drop(graph);
        this.find_relative(&parent);
        for s in (0..ns).rev() {
            if parent[s] != NONE {
                this.stack[s] = 1 - this.stack[parent[s] as usize];
            }
        }
        this.find_tasks(&parent);
        this
    }

    /// The number of rows of the matrix.
    pub fn order(&self) -> usize {
        self.n
    }

    /// The elimination order in use, `permutation[new] = old`.
    pub fn permutation(&self) -> &[u32] {
        &self.order
    }

    /// The number of supernodes.
    pub fn supernodes(&self) -> usize {
        self.first.len() - 1
    }

    /// The multiplications and additions of a factorization.
    pub fn flops(&self) -> f64 {
        self.flops
    }

    /// The nonzeros of the factor, with the explicit zeros of merged supernodes.
    pub fn fill(&self) -> usize {
        self.fill
    }

    /// The memory of this structure in bytes.
    pub fn bytes(&self) -> usize {
        let words = self.order.len() + self.first.len() + self.rows.len() + self.relative.len();
        let words = words + self.child.len() + self.entry_value.len() + self.entry_target.len();
        let long = self.row_start.len() + self.panel_start.len() + self.child_start.len();
        let long = long + self.update_start.len() + self.entry_start.len();
        4 * words + 8 * long + self.stack.len()
    }

    /// The supernodes of these rows of the matrix with all their ancestors, ascending: what a substitution passes through
    /// whose right-hand side is zero, or whose solution is not wanted, at other rows.
    pub fn reach(&self, rows: impl Iterator<Item = usize>) -> Vec<u32> {
        let mut wanted = vec![false; self.n];
        rows.for_each(|row| wanted[row] = true);
        let mut reached = vec![false; self.supernodes()];
        let mut list = Vec::new();
        for s in 0..self.supernodes() {
            let own = self.columns(s).any(|k| wanted[self.order[k] as usize]);
            reached[s] = own || self.children(s).iter().any(|&c| reached[c as usize]);
            if reached[s] {
                list.push(s as u32);
            }
        }
        list
    }

    /// The numbers that the factor and the update stacks need.
    pub(crate) fn panel_size(&self) -> usize {
        self.panel_start[self.supernodes()]
    }

    pub(crate) fn columns(&self, s: usize) -> Range<usize> {
        self.first[s] as usize..self.first[s + 1] as usize
    }

    pub(crate) fn rows(&self, s: usize) -> &[u32] {
        &self.rows[self.row_start[s]..self.row_start[s + 1]]
    }

    pub(crate) fn children(&self, s: usize) -> &[u32] {
        &self.child[self.child_start[s]..self.child_start[s + 1]]
    }

    /// The structure below a supernode, that of its own entries and of its children's update matrices, and
    /// where its entries go, so that a refactorization is a plain scatter.
    fn find_rows(&mut self, pattern: &SymmetricPattern, graph: &Graph, column_order: &[u32]) {
        let ns = self.supernodes();
        let mut position = vec![0_u32; self.n];
        for (new, &middle) in column_order.iter().enumerate() {
            position[middle as usize] = new as u32;
        }
        let mut mark = vec![NONE; self.n];
        // The index of a row in the front.
        let mut local = vec![0_u32; self.n];
        self.row_start.push(0);
        self.panel_start.push(0);
        self.entry_value.reserve_exact(self.input);
        self.entry_target.reserve_exact(self.input);
        for s in 0..ns {
            checkpoint();
            let columns = self.columns(s);
            let end = columns.end as u32;
            let begin = self.rows.len();
            let first_entry = self.entry_target.len();
            self.entry_start.push(first_entry);
            for j in columns.clone() {
                let diagonal = pattern.start[self.order[j] as usize + 1] - 1;
                self.entry_value.push(diagonal as u32);
                self.entry_target.push(j as u32);
                let range = graph.larger_range(column_order[j]);
                self.entry_value.extend_from_slice(&graph.entry[range.clone()]);
                for &other in &graph.neighbour[range] {
                    let i = position[other as usize];
                    self.entry_target.push(i);
                    if i >= end && mark[i as usize] != s as u32 {
                        mark[i as usize] = s as u32;
                        self.rows.push(i);
                    }
                }
            }
            for k in self.child_start[s]..self.child_start[s + 1] {
                let c = self.child[k] as usize;
                for t in self.row_start[c]..self.row_start[c + 1] {
                    let i = self.rows[t];
                    if i >= end && mark[i as usize] != s as u32 {
                        mark[i as usize] = s as u32;
                        self.rows.push(i);
                    }
                }
            }
            self.rows[begin..].sort_unstable();
            self.row_start.push(self.rows.len());
            let (p, r) = (columns.len(), self.rows.len() - begin);
            self.panel_start.push(self.panel_start[s] + p * (p + r));
            self.largest = self.largest.max(p + r);
            self.fill += p * (p + 1) / 2 + p * r;
            self.flops += front_flops(p, r);

            for (k, i) in columns.clone().enumerate() {
                local[i] = k as u32;
            }
            for (k, &i) in self.rows[begin..].iter().enumerate() {
                local[i as usize] = (p + k) as u32;
            }
            let mut targets = self.entry_target[first_entry..].iter_mut();
            for (k, j) in columns.enumerate() {
                let count = 1 + graph.larger_range(column_order[j]).len();
                let offset = (k * (p + r)) as u32;
                for target in targets.by_ref().take(count) {
                    *target = local[*target as usize] + offset;
                }
            }
        }
        self.entry_start.push(self.input);
    }

    fn find_relative(&mut self, parent: &[u32]) {
        let mut relative = vec![0; self.rows.len()];
        for s in (0..self.supernodes()).filter(|&s| parent[s] != NONE) {
            let columns = self.columns(parent[s] as usize);
            let above = self.rows(parent[s] as usize);
            let mut k = 0;
            let range = self.row_start[s]..self.row_start[s + 1];
            for (to, &i) in relative[range].iter_mut().zip(self.rows(s)) {
                *to = if (i as usize) < columns.end {
                    i - columns.start as u32
                } else {
                    while above[k] != i {
                        k += 1;
                    }
                    (columns.len() + k) as u32
                };
            }
        }
        self.relative = relative;
    }

    fn find_tasks(&mut self, parent: &[u32]) {
        let ns = self.supernodes();
        // Operations of supernodes 0..s, and the first supernode of each subtree.
        let mut sum = vec![0.0; ns + 1];
        let mut lowest: Vec<usize> = (0..ns).collect();
        for s in 0..ns {
            let (p, r) = (self.columns(s).len(), self.rows(s).len());
            sum[s + 1] = sum[s] + front_flops(p, r) + 50.0 * ((p + r) * (p + r)) as f64;
            if parent[s] != NONE {
                let above = parent[s] as usize;
                lowest[above] = lowest[above].min(lowest[s]);
            }
        }
        let least = SPLIT_FLOPS.max(sum[ns] * SPLIT_FRACTION);
        self.split(0..ns, [0, 0], MAX_SPLIT_DEPTH, &sum, &lowest, least);
        if let Some(root) = self.tasks.last() {
            self.update_size = [root.area[0].end, root.area[1].end];
        }
    }

    /// Makes the task of a range of supernodes and returns its number. The recursion is at most
    /// `MAX_SPLIT_DEPTH` deep.
    fn split(
        &mut self,
        range: Range<usize>,
        base: [usize; 2],
        depth: usize,
        sum: &[f64],
        lowest: &[usize],
        least: f64,
    ) -> usize {
        let mut top = range.end;
        while top > range.start && lowest[top - 1] == range.start {
            top -= 1;
        }
        let mut peak = base;
        let mut parts = None;
        let work = sum[range.end] - sum[range.start];
        let mut middle = top;
        if depth > 0 && work > least && top > range.start {
            middle = balanced(range.start..top, sum, lowest);
        }
        if middle < top && middle > range.start {
            let left = self.split(range.start..middle, base, depth - 1, sum, lowest, least);
            let next = [self.tasks[left].area[0].end, self.tasks[left].area[1].end];
            let right = self.split(middle..top, next, depth - 1, sum, lowest, least);
            peak = [self.tasks[right].area[0].end, self.tasks[right].area[1].end];
            parts = Some([left, right]);
            let mut free = base;
            self.place_updates(top..range.end, base, &mut free, &mut peak);
        } else {
            top = range.start;
            let mut free = base;
            self.place_updates(range.clone(), base, &mut free, &mut peak);
        }
        self.tasks.push(Task {
            range,
            top,
            parts,
            area: [base[0]..peak[0], base[1]..peak[1]],
        });
        self.tasks.len() - 1
    }

    /// Runs the two stacks of update matrices for a range of supernodes in order.
    fn place_updates(
        &mut self,
        range: Range<usize>,
        base: [usize; 2],
        free: &mut [usize; 2],
        peak: &mut [usize; 2],
    ) {
        for s in range.clone() {
            let own = usize::from(self.stack[s]);
            let r = self.row_start[s + 1] - self.row_start[s];
            self.update_start[s] = free[own];
            free[own] += r * r.next_multiple_of(LANES);
            peak[own] = peak[own].max(free[own]);
            if let Some(&c) = self.children(s).first() {
                let c = c as usize;
                free[1 - own] = if c < range.start {
                    base[1 - own]
                } else {
                    self.update_start[c]
                };
            }
        }
    }
}

/// The boundary between trees of a forest that splits its work best.
fn balanced(range: Range<usize>, sum: &[f64], lowest: &[usize]) -> usize {
    let half = 0.5 * (sum[range.start] + sum[range.end]);
    let mut best = range.end;
    let mut cut = range.end;
    while cut > range.start {
        cut = lowest[cut - 1];
        if (sum[cut] - half).abs() < (sum[best] - half).abs() {
            best = cut;
        }
    }
    best
}

fn front_flops(p: usize, r: usize) -> f64 {
    let (p, r) = (p as f64, r as f64);
    p * p * p / 3.0 + p * p * r + p * r * r
}
