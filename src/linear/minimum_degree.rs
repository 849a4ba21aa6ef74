//! Approximate minimum degree orders (Amestoy, Davis & Duff, SIAM J. Matrix Anal. Appl. 17, 1996).
//!
//! The quotient graph stands for the matrix that is left: an eliminated variable becomes an element, whose variables are a
//! clique. Variables with the same neighbours are one, with a size; elements whose variables belong to a newer one are
//! absorbed by it.

use super::elimination::NONE;
use super::interrupt::checkpoint;
use super::sparse::SymmetricPattern;

/// A row with more than this times the square root of the number of rows is ordered last.
/// Half or double, of 128 cases: none changes.
const DENSE: f64 = 10.0;

/// An approximate minimum degree order of a matrix, `order[new] = old`.
pub fn amd(pattern: &SymmetricPattern) -> Vec<u32> {
    let (mut graph, dense) = QuotientGraph::new(pattern);
    while graph.left > 0 {
        checkpoint();
        let pivot = graph.queue.pop();
        graph.eliminate(pivot);
    }
    graph.pivots.extend(dense);
    let mut order = Vec::with_capacity(pattern.order());
    for &pivot in &graph.pivots {
        let mut member = pivot;
        while member != NONE {
            order.push(member);
            member = graph.next_member[member as usize];
        }
    }
    order
}

struct QuotientGraph {
    /// The list of a variable has its elements, then its variables; that of an element has its variables.
    list: Vec<u32>,
    start: Vec<usize>,
    /// The length of a list, 0 of what is gone.
    length: Vec<u32>,
    /// The elements in the list of a variable.
    elements: Vec<u32>,
    /// The rows that a variable stands for: 0 when it is gone, negative while it is in the element being made.
    size: Vec<i32>,
    /// An upper bound of the rows next to a variable, the rows of an element.
    degree: Vec<i32>,
    /// Of an element: 0 when it is gone, from `stamp` on the number of its rows outside the new element above `stamp`.
    mark: Vec<u32>,
    stamp: u32,
    /// The largest element so far.
    largest: u32,
    queue: DegreeQueue,
    /// The variables of equal hash, chained by the queue's `next`.
    bucket: Vec<u32>,
    /// The rows that a variable stands for, as a chain from itself.
    next_member: Vec<u32>,
    last_member: Vec<u32>,
    pivots: Vec<u32>,
    /// Rows that are not eliminated.
    left: i32,
}

impl QuotientGraph {
    /// The graph of a matrix without its dense rows, and the first of those, which stands for all.
    fn new(pattern: &SymmetricPattern) -> (Self, Option<u32>) {
        let n = pattern.order();
        let graph = pattern.adjacency();
        let length: Vec<u32> = graph.start.windows(2).map(|w| (w[1] - w[0]) as u32).collect();
        let dense = (DENSE * (n as f64).sqrt()) as u32;
        let mut this = Self {
            list: graph.neighbour,
            start: graph.start,
            elements: vec![0; n],
            size: vec![1; n],
            degree: length.iter().map(|&l| l as i32).collect(),
            mark: vec![1; n],
            stamp: 2,
            largest: 0,
            queue: DegreeQueue::new(n),
            bucket: vec![NONE; n],
            next_member: vec![NONE; n],
            last_member: (0..n as u32).collect(),
            pivots: Vec::with_capacity(n),
            left: 0,
            length,
        };
        let mut first = None;
        for i in 0..n as u32 {
            let degree = this.length[i as usize];
            if degree <= dense {
                this.queue.insert(i, degree as usize);
                this.left += 1;
                continue;
            }
            this.size[i as usize] = 0;
            this.length[i as usize] = 0;
            match first {
                Some(first) => this.merge(first, i),
                None => first = Some(i),
            }
        }
        (this, first)
    }

    /// Makes a variable an element.
    fn eliminate(&mut self, pivot: u32) {
        self.compact();
        let begin = self.list.len();
        self.gather(pivot);
        let end = self.list.len();
        self.count_outside(begin..end);
        for k in begin..end {
            self.update(self.list[k], pivot);
        }
        let rows = |this: &Self| {
            (begin..end)
                .map(|k| -this.size[this.list[k] as usize])
                .sum::<i32>()
        };
        self.degree[pivot as usize] = rows(self);
        self.largest = self.largest.max(rows(self) as u32);
        self.new_stamp(self.largest);
        for k in begin..end {
            self.merge_bucket(self.list[k]);
        }
        self.finish(pivot, begin);
    }

    /// Appends the variables of the new element, whose size turns negative, and absorbs the elements of the pivot.
    fn gather(&mut self, pivot: u32) {
        let own = self.start[pivot as usize];
        let (elements, length) = (
            self.elements[pivot as usize] as usize,
            self.length[pivot as usize] as usize,
        );
        self.left -= self.size[pivot as usize];
        self.size[pivot as usize] = 0;
        self.start[pivot as usize] = self.list.len();
        for k in own..own + elements {
            let e = self.list[k] as usize;
            let variables = self.start[e]..self.start[e] + self.length[e] as usize;
            self.take(variables);
            self.remove_element(e);
        }
        self.take(own + elements..own + length);
    }

    fn take(&mut self, variables: std::ops::Range<usize>) {
        for k in variables {
            let i = self.list[k];
            let size = self.size[i as usize];
            if size > 0 {
                self.size[i as usize] = -size;
                self.queue.remove(i, self.degree[i as usize] as usize);
                self.list.push(i);
            }
        }
    }

    fn remove_element(&mut self, e: usize) {
        self.length[e] = 0;
        self.mark[e] = 0;
    }

    /// For all elements next to the variables of the new one: their rows outside of it.
    fn count_outside(&mut self, element: std::ops::Range<usize>) {
        for k in element {
            let i = self.list[k] as usize;
            let size = -self.size[i] as u32;
            for t in self.start[i]..self.start[i] + self.elements[i] as usize {
                let e = self.list[t] as usize;
                let mark = self.mark[e];
                if mark >= self.stamp {
                    self.mark[e] = mark - size;
                } else if mark != 0 {
                    self.mark[e] = self.degree[e] as u32 + self.stamp - size;
                }
            }
        }
    }

    /// The list of a variable of the new element, without what that covers; its degree outside; its bucket.
    fn update(&mut self, i: u32, pivot: u32) {
        let v = i as usize;
        let begin = self.start[v];
        let variables = begin + self.elements[v] as usize;
        let end = begin + self.length[v] as usize;
        let (mut degree, mut hash) = (0, u64::from(pivot));
        let mut to = begin;
        for k in begin..variables {
            let e = self.list[k] as usize;
            let mark = self.mark[e];
            if mark > self.stamp {
                degree += (mark - self.stamp) as i32;
                hash += e as u64;
                self.list[to] = e as u32;
                to += 1;
            } else if mark != 0 {
                self.remove_element(e);
            }
        }
        let middle = to;
        for k in variables..end {
            let j = self.list[k];
            let size = self.size[j as usize];
            if size > 0 {
                degree += size;
                hash += u64::from(j);
                self.list[to] = j;
                to += 1;
            }
        }
        if to == begin {
            // Nothing else is next to it: it is eliminated together with the pivot.
            self.left += self.size[v];
            self.size[v] = 0;
            self.length[v] = 0;
            self.merge(pivot, i);
            return;
        }
        // At least the pivot or one of its elements is gone from the list: there is room for the new element.
        self.list[to] = self.list[middle];
        self.list[middle] = self.list[begin];
        self.list[begin] = pivot;
        self.elements[v] = (middle - begin + 1) as u32;
        self.length[v] = (to - begin + 1) as u32;
        self.degree[v] = self.degree[v].min(degree);
        let slot = (hash % self.bucket.len() as u64) as usize;
        self.queue.next[v] = std::mem::replace(&mut self.bucket[slot], i);
        self.queue.previous[v] = slot as u32;
    }

    /// Merges the variables with equal lists in the bucket of a variable, and empties it.
    fn merge_bucket(&mut self, of: u32) {
        if self.size[of as usize] == 0 {
            return;
        }
        let slot = self.queue.previous[of as usize] as usize;
        let mut i = std::mem::replace(&mut self.bucket[slot], NONE);
        while i != NONE {
            let mut j = self.queue.next[i as usize];
            if j != NONE {
                for k in self.tail(i) {
                    self.mark[self.list[k] as usize] = self.stamp;
                }
            }
            let mut before = i;
            while j != NONE {
                let next = self.queue.next[j as usize];
                if self.is_twin(i, j) {
                    self.size[i as usize] += self.size[j as usize];
                    self.size[j as usize] = 0;
                    self.length[j as usize] = 0;
                    self.merge(i, j);
                    self.queue.next[before as usize] = next;
                } else {
                    before = j;
                }
                j = next;
            }
            self.new_stamp(1);
            i = self.queue.next[i as usize];
        }
    }

    /// The list of a variable without the new element, which is its first.
    fn tail(&self, i: u32) -> std::ops::Range<usize> {
        let start = self.start[i as usize];
        start + 1..start + self.length[i as usize] as usize
    }

    /// Whether a variable has the list of another, whose members have the stamp.
    fn is_twin(&self, i: u32, j: u32) -> bool {
        self.length[i as usize] == self.length[j as usize]
            && self.elements[i as usize] == self.elements[j as usize]
            && self.list[self.tail(j)]
                .iter()
                .all(|&x| self.mark[x as usize] == self.stamp)
    }

    /// Puts the variables of the new element back into the queue.
    fn finish(&mut self, pivot: u32, begin: usize) {
        let rows = self.degree[pivot as usize];
        let mut to = begin;
        for k in begin..self.list.len() {
            let i = self.list[k];
            let v = i as usize;
            if self.size[v] == 0 {
                continue;
            }
            let size = -self.size[v];
            self.size[v] = size;
            self.degree[v] = (self.degree[v] + rows - size).min(self.left - size);
            self.queue.insert(i, self.degree[v] as usize);
            self.list[to] = i;
            to += 1;
        }
        self.list.truncate(to);
        self.length[pivot as usize] = (to - begin) as u32;
        self.mark[pivot as usize] = u32::from(to > begin);
        self.pivots.push(pivot);
    }

    /// Lets `i` stand for the rows of `j` too.
    fn merge(&mut self, i: u32, j: u32) {
        let last = self.last_member[i as usize];
        self.next_member[last as usize] = j;
        self.last_member[i as usize] = self.last_member[j as usize];
    }

    /// Makes all marks smaller than the stamp, of which the largest is less than `range` above it.
    fn new_stamp(&mut self, range: u32) {
        self.stamp += range;
        if self.stamp > u32::MAX / 2 {
            self.mark.iter_mut().for_each(|m| *m = (*m).min(1));
            self.stamp = 2;
        }
    }

    /// Moves the lists together when their memory is full, so that an element fits in behind them.
    fn compact(&mut self) {
        if self.list.len() + self.left as usize <= self.list.capacity() {
            return;
        }
        let live: usize = self.length.iter().map(|&l| l as usize).sum();
        let mut list = Vec::with_capacity(live + live / 2 + self.length.len());
        for (start, &length) in self.start.iter_mut().zip(&self.length) {
            let begin = list.len();
            list.extend_from_slice(&self.list[*start..*start + length as usize]);
            *start = begin;
        }
        self.list = list;
    }
}

/// Variables by degree: doubly linked lists.
struct DegreeQueue {
    head: Vec<u32>,
    next: Vec<u32>,
    previous: Vec<u32>,
    /// No variable has a smaller degree.
    least: usize,
}

impl DegreeQueue {
    fn new(n: usize) -> Self {
        Self {
            head: vec![NONE; n],
            next: vec![NONE; n],
            previous: vec![NONE; n],
            least: 0,
        }
    }

    fn insert(&mut self, i: u32, degree: usize) {
        let next = std::mem::replace(&mut self.head[degree], i);
        self.next[i as usize] = next;
        self.previous[i as usize] = NONE;
        if next != NONE {
            self.previous[next as usize] = i;
        }
        self.least = self.least.min(degree);
    }

    fn remove(&mut self, i: u32, degree: usize) {
        let (next, previous) = (self.next[i as usize], self.previous[i as usize]);
        if next != NONE {
            self.previous[next as usize] = previous;
        }
        if previous != NONE {
            self.next[previous as usize] = next;
        } else {
            self.head[degree] = next;
        }
    }

    /// Takes out a variable of the least degree, of which there must be one.
    fn pop(&mut self) -> u32 {
        while self.head[self.least] == NONE {
            self.least += 1;
        }
        let i = self.head[self.least];
        self.remove(i, self.least);
        i
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ordering::nested_dissection;
    use crate::sparse::tests::grid;
    use crate::symbolic::Symbolic;

    fn fill(pattern: &SymmetricPattern) -> usize {
        let order = amd(pattern);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..pattern.order() as u32));
        let symbolic = Symbolic::new(pattern, &order);
        symbolic.fill()
    }

    fn complete(n: u32) -> Vec<[u32; 2]> {
        (0..n).flat_map(|i| (0..i).map(move |j| [i, j])).collect()
    }

    #[test]
    fn a_tree_and_a_clique_have_no_fill() {
        // Every vertex hangs on a smaller one: leaves first, a tree fills nothing. (Merged supernodes would.)
        let tree: Vec<[u32; 2]> = (1..5000_u32)
            .map(|i| [i, i.wrapping_mul(2_654_435_761) % i])
            .collect();
        let order = amd(&SymmetricPattern::from_edges(5000, &tree));
        let mut place = vec![0; 5000];
        order.iter().enumerate().for_each(|(k, &v)| place[v as usize] = k);
        let mut later = vec![0; 5000];
        for [a, b] in tree {
            let first = if place[a as usize] < place[b as usize] {
                a
            } else {
                b
            };
            later[first as usize] += 1;
        }
        assert_all!(later.iter(), |&l| l <= 1);
        assert_eq!(
            fill(&SymmetricPattern::from_edges(40, &complete(40))),
            40 * 41 / 2
        );
    }

    #[test]
    fn a_dense_row_comes_last() {
        // A hub over a path, in the middle of the numbers.
        let n = 2000;
        let hub = 1000;
        let mut edges: Vec<[u32; 2]> = (0..n).map(|i| [i, hub]).collect();
        edges.extend((1..n).map(|i| [i - 1, i]));
        let order = amd(&SymmetricPattern::from_edges(n as usize, &edges));
        assert_eq!(order.last(), Some(&hub));
    }

    #[test]
    fn components_and_lone_vertices_are_ordered_too() {
        for n in [0, 1, 2, 5] {
            assert_eq!(fill(&SymmetricPattern::from_edges(n, &[])), n);
        }
        let mut edges = complete(6);
        edges.extend(complete(5).iter().map(|e| e.map(|v| v + 10)));
        fill(&SymmetricPattern::from_edges(20, &edges));
    }

    #[test]
    fn a_grid_takes_fewer_operations_than_by_dissection() {
        let (graph, coords) = grid(100, true);
        for (ring, pattern) in [(1, &graph), (2, &graph.square())] {
            let flops = |order: &[u32]| Symbolic::new(pattern, order).flops();
            assert!(
                flops(&amd(pattern)) < flops(&nested_dissection(&graph, ring, &coords)),
                "{ring}"
            );
        }
    }
}
