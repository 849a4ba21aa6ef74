//! Elimination trees (Liu 1986) and the column counts of the factor (Gilbert, Ng & Peyton 1994).

use std::ops::Range;

use super::sparse::SymmetricPattern;

/// No element, such as the parent of a root.
pub(crate) const NONE: u32 = u32::MAX;

/// The entries of the matrix off its diagonal in the numbering of an order. Every vertex has its smaller
/// neighbours first, then the larger ones, neither sorted.
pub(super) struct Graph {
    start: Vec<usize>,
    /// Where the larger neighbours begin.
    middle: Vec<usize>,
    pub(super) neighbour: Vec<u32>,
    /// Parallel to `neighbour`: the index of the entry, at larger neighbours only.
    pub(super) entry: Vec<u32>,
}

impl Graph {
    /// The graph of a pattern under `order[new] = old`.
    pub(super) fn new(pattern: &SymmetricPattern, order: &[u32]) -> Self {
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

    /// The place of the larger neighbours in both lists.
    pub(super) fn larger_range(&self, i: u32) -> Range<usize> {
        self.middle[i as usize]..self.start[i as usize + 1]
    }
}

/// The parent of every column (Liu's algorithm with path compression).
pub(super) fn elimination_tree(graph: &Graph) -> Vec<u32> {
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
pub(super) fn children(parent: &[u32]) -> (Vec<usize>, Vec<u32>) {
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
pub(super) fn postorder(parent: &[u32]) -> Vec<u32> {
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
pub(super) fn column_counts(graph: &Graph, parent: &[u32], post: &[u32]) -> Vec<u32> {
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
