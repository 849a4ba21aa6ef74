//! The symbolic half of a sparse Cholesky factorization: what depends on the pattern and the order alone.

use std::ops::Range;

use super::front::LANES;
use super::sparse::SymmetricPattern;

pub(crate) const NONE: u32 = u32::MAX;

/// Subtrees are split for two or more threads down to this depth.
const MAX_SPLIT_DEPTH: usize = 6;
/// A subtree with less than this part of all operations is not split further.
const SPLIT_FRACTION: f64 = 1.0 / 10.0;
/// A subtree with less than this number of operations is not split further.
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

/// The entries of the matrix off its diagonal in the numbering of an order. Every vertex has its smaller
/// neighbours first, then the larger ones, neither sorted.
struct Graph {
    start: Vec<usize>,
    /// Where the larger neighbours begin.
    middle: Vec<usize>,
    neighbour: Vec<u32>,
    /// Parallel to `neighbour`: the index of the entry, at larger neighbours only.
    entry: Vec<u32>,
}

impl Graph {
    fn new(pattern: &SymmetricPattern, order: &[u32]) -> Self {
        let n = pattern.order();
        let mut inverse = vec![0_u32; n];
        for (new, &old) in order.iter().enumerate() {
            inverse[old as usize] = new as u32;
        }
        // Degrees, then the ends of the two parts of every list, which grow towards each other.
        let mut front = vec![0_usize; n];
        for (i, &a) in inverse.iter().enumerate() {
            let row = &pattern.row(i)[..pattern.row(i).len() - 1];
            front[a as usize] += row.len();
            for &j in row {
                front[inverse[j as usize] as usize] += 1;
            }
        }
        let mut start = Vec::with_capacity(n + 1);
        let mut total = 0;
        start.push(0);
        for degree in &mut front {
            total += std::mem::replace(degree, total);
            start.push(total);
        }
        let mut back = start[1..].to_vec();
        let (mut neighbour, mut entry) = (vec![0_u32; total], vec![0_u32; total]);
        for (i, &a) in inverse.iter().enumerate() {
            for t in pattern.start[i]..pattern.start[i + 1] - 1 {
                let b = inverse[pattern.column[t] as usize];
                let (low, high) = (a.min(b), a.max(b));
                let slot = &mut front[high as usize];
                neighbour[*slot] = low;
                *slot += 1;
                let slot = &mut back[low as usize];
                *slot -= 1;
                neighbour[*slot] = high;
                entry[*slot] = t as u32;
            }
        }
        Self {
            start,
            middle: back,
            neighbour,
            entry,
        }
    }

    fn smaller(&self, i: u32) -> &[u32] {
        &self.neighbour[self.start[i as usize]..self.middle[i as usize]]
    }

    fn larger(&self, i: u32) -> &[u32] {
        &self.neighbour[self.larger_range(i)]
    }

    fn larger_range(&self, i: u32) -> Range<usize> {
        self.middle[i as usize]..self.start[i as usize + 1]
    }
}

/// The parent of every column (Liu's algorithm with path compression).
fn elimination_tree(graph: &Graph) -> Vec<u32> {
    let n = graph.start.len() - 1;
    let mut parent = vec![NONE; n];
    let mut ancestor = vec![NONE; n];
    for i in 0..n as u32 {
        for &j in graph.smaller(i) {
            let mut k = j;
            while k != NONE && k < i {
                let next = std::mem::replace(&mut ancestor[k as usize], i);
                if next == NONE {
                    parent[k as usize] = i;
                }
                k = next;
            }
        }
    }
    parent
}

/// The children of every node, ascending: offsets and list.
fn children(parent: &[u32]) -> (Vec<usize>, Vec<u32>) {
    let n = parent.len();
    let mut start = vec![0_usize; n + 2];
    for &p in parent.iter().filter(|&&p| p != NONE) {
        start[p as usize + 2] += 1;
    }
    for i in 0..n {
        start[i + 2] += start[i + 1];
    }
    let mut child = vec![0_u32; start[n + 1]];
    for (c, &p) in parent.iter().enumerate().filter(|(_, p)| **p != NONE) {
        child[start[p as usize + 1]] = c as u32;
        start[p as usize + 1] += 1;
    }
    start.pop();
    (start, child)
}

/// A postorder of a forest, `post[k]` the k-th node.
fn postorder(parent: &[u32]) -> Vec<u32> {
    let (start, child) = children(parent);
    let mut next = start.clone();
    let mut post = Vec::with_capacity(parent.len());
    let mut path = Vec::new();
    for root in (0..parent.len()).filter(|&i| parent[i] == NONE) {
        path.push(root);
        while let Some(&node) = path.last() {
            if next[node] < start[node + 1] {
                path.push(child[next[node]] as usize);
                next[node] += 1;
            } else {
                post.push(node as u32);
                path.pop();
            }
        }
    }
    post
}

/// The number of nonzeros of every column of the factor, diagonal included (Gilbert, Ng, Peyton 1994).
fn column_counts(graph: &Graph, parent: &[u32], post: &[u32]) -> Vec<u32> {
    let n = parent.len();
    let mut delta = vec![0_i64; n];
    let mut first = vec![NONE; n];
    for (k, &j) in post.iter().enumerate() {
        delta[j as usize] = i64::from(first[j as usize] == NONE);
        let mut i = j;
        while i != NONE && first[i as usize] == NONE {
            first[i as usize] = k as u32;
            i = parent[i as usize];
        }
    }
    let mut max_first = vec![NONE; n];
    let mut last_leaf = vec![NONE; n];
    let mut ancestor: Vec<u32> = (0..n as u32).collect();
    for &j in post {
        if parent[j as usize] != NONE {
            delta[parent[j as usize] as usize] -= 1;
        }
        let low = first[j as usize];
        for &i in graph.larger(j) {
            let i = i as usize;
            if max_first[i] != NONE && low <= max_first[i] {
                continue;
            }
            // Column j is a leaf of the row subtree of i.
            max_first[i] = low;
            delta[j as usize] += 1;
            let previous = std::mem::replace(&mut last_leaf[i], j);
            if previous != NONE {
                delta[find(&mut ancestor, previous) as usize] -= 1;
            }
        }
        if parent[j as usize] != NONE {
            ancestor[j as usize] = parent[j as usize];
        }
    }
    for &j in post {
        if parent[j as usize] != NONE {
            delta[parent[j as usize] as usize] += delta[j as usize];
        }
    }
    delta.into_iter().map(|d| d as u32).collect()
}

/// The root of a disjoint set, with path compression.
fn find(ancestor: &mut [u32], node: u32) -> u32 {
    let mut root = node;
    while ancestor[root as usize] != root {
        root = ancestor[root as usize];
    }
    let mut k = node;
    while k != root {
        k = std::mem::replace(&mut ancestor[k as usize], root);
    }
    root
}

/// Groups of columns while they are formed and merged.
struct Supernodes {
    /// The columns of group `g` are `post_first[g]..post_first[g + 1]` of the postorder.
    post: Vec<u32>,
    post_first: Vec<u32>,
    parent: Vec<u32>,
    /// The group that a group was merged into.
    merged: Vec<u32>,
}

/// The final numbering of columns and supernodes.
struct Layout {
    column_order: Vec<u32>,
    first: Vec<u32>,
    parent: Vec<u32>,
}

impl Supernodes {
    fn new(parent: &[u32], post: &[u32], count: &[u32]) -> Self {
        let n = post.len();
        let mut group_of = vec![0_u32; n];
        let mut post_first = Vec::new();
        for k in 0..n {
            let joins = k > 0 && {
                let (a, b) = (post[k - 1] as usize, post[k] as usize);
                parent[a] == b as u32 && count[a] == count[b] + 1
            };
            if !joins {
                post_first.push(k as u32);
            }
            group_of[post[k] as usize] = post_first.len() as u32 - 1;
        }
        post_first.push(n as u32);
        let ng = post_first.len() - 1;
        let last = |g: usize| post[post_first[g + 1] as usize - 1] as usize;
        let up: Vec<u32> = (0..ng)
            .map(|g| match parent[last(g)] {
                NONE => NONE,
                p => group_of[p as usize],
            })
            .collect();
        let below: Vec<u32> = (0..ng).map(|g| count[last(g)] - 1).collect();
        let mut this = Self {
            post: post.to_vec(),
            post_first,
            parent: up,
            merged: vec![NONE; ng],
        };
        this.merge(&below);
        this
    }

    /// Merges groups with their parents where that costs few explicit zeros: larger fronts are faster per
    /// operation, and there is less to assemble.
    fn merge(&mut self, below: &[u32]) {
        let ng = self.parent.len();
        let (start, child) = children(&self.parent);
        let mut width: Vec<u64> = (0..ng)
            .map(|g| u64::from(self.post_first[g + 1] - self.post_first[g]))
            .collect();
        let mut zeros = vec![0_u64; ng];
        let mut candidates = Vec::new();
        for g in 0..ng {
            candidates.clear();
            candidates.extend_from_slice(&child[start[g]..start[g + 1]]);
            candidates.sort_by_key(|&c| (std::cmp::Reverse(below[c as usize]), c));
            for &c in &candidates {
                let c = c as usize;
                let rows = width[g] + u64::from(below[g]);
                let extra = zeros[c] + zeros[g] + width[c] * (rows - u64::from(below[c]));
                let total = width[c] + width[g];
                let size = total * (total + 1) / 2 + total * u64::from(below[g]);
                let part = extra as f64 / size as f64;
                let accept = match total {
                    0..=8 => part < 0.5,
                    9..=24 => part < 0.25,
                    25..=64 => part < 0.12,
                    _ => part < 0.05,
                };
                if accept {
                    self.merged[c] = g as u32;
                    width[g] = total;
                    zeros[g] = extra;
                }
            }
        }
    }

    /// Numbers the merged groups in postorder of their tree, the columns of each in the old order.
    fn layout(self) -> Layout {
        let ng = self.parent.len();
        let mut owner: Vec<u32> = (0..ng as u32).collect();
        for g in (0..ng).rev() {
            if self.merged[g] != NONE {
                owner[g] = owner[self.merged[g] as usize];
            }
        }
        // The tree of the owners; merged groups hang nowhere.
        let mut tree = vec![NONE; ng];
        let (mut member_start, mut members) = (vec![0_usize; ng + 2], vec![0_u32; ng]);
        for g in 0..ng {
            if owner[g] == g as u32 && self.parent[g] != NONE {
                tree[g] = owner[self.parent[g] as usize];
            }
            member_start[owner[g] as usize + 2] += 1;
        }
        for g in 0..ng {
            member_start[g + 2] += member_start[g + 1];
        }
        for g in 0..ng {
            let slot = &mut member_start[owner[g] as usize + 1];
            members[*slot] = g as u32;
            *slot += 1;
        }
        let order = postorder(&tree);
        let mut number = vec![NONE; ng];
        let mut layout = Layout {
            column_order: Vec::with_capacity(self.post.len()),
            first: vec![],
            parent: vec![],
        };
        for g in order.into_iter().filter(|&g| owner[g as usize] == g) {
            number[g as usize] = layout.first.len() as u32;
            layout.first.push(layout.column_order.len() as u32);
            layout.parent.push(tree[g as usize]);
            for &part in &members[member_start[g as usize]..member_start[g as usize + 1]] {
                let part = part as usize;
                let columns = self.post_first[part] as usize..self.post_first[part + 1] as usize;
                layout.column_order.extend_from_slice(&self.post[columns]);
            }
        }
        layout.first.push(layout.column_order.len() as u32);
        for parent in layout.parent.iter_mut().filter(|p| **p != NONE) {
            *parent = number[*parent as usize];
        }
        layout
    }
}
