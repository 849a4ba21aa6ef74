//! Sets of numbers that are united one by one (union-find); each is known by its smallest member.

#[derive(Debug)]
pub(crate) struct DisjointSets {
    parent: Vec<u32>,
}

impl DisjointSets {
    /// Each number below `count` by itself.
    pub(crate) fn new(count: usize) -> Self {
        Self {
            parent: (0..count as u32).collect(),
        }
    }

    /// The smallest member of the set that `i` belongs to.
    pub(crate) fn smallest(&mut self, mut i: u32) -> u32 {
        while self.parent[i as usize] != i {
            let above = self.parent[self.parent[i as usize] as usize];
            self.parent[i as usize] = above;
            i = above;
        }
        i
    }

    /// The sets of the first `count`, numbered by their smallest members, and how many there are.
    pub(crate) fn numbers(&mut self, count: usize) -> (Vec<u32>, u32) {
        let (mut number, mut next) = (vec![0; count], 0);
        for i in 0..count {
            let smallest = self.smallest(i as u32) as usize;
            if smallest == i {
                number[i] = next;
                next += 1;
            } else {
                number[i] = number[smallest];
            }
        }
        (number, next)
    }

    /// Makes one set of those of `a` and `b`.
    pub(crate) fn unite(&mut self, a: u32, b: u32) {
        if self.parent[a as usize] != self.parent[b as usize] {
            let (a, b) = (self.smallest(a), self.smallest(b));
            self.parent[a.max(b) as usize] = a.min(b);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_is_known_by_its_smallest_member() {
        let mut sets = DisjointSets::new(10);
        for (a, b) in [(9, 7), (3, 5), (7, 5), (1, 2), (8, 8)] {
            sets.unite(a, b);
        }
        let smallest: Vec<u32> = (0..10).map(|i| sets.smallest(i)).collect();
        assert_eq!(smallest, [0, 1, 1, 3, 4, 3, 6, 3, 8, 3]);
        assert_eq!(sets.numbers(7), (vec![0, 1, 1, 2, 3, 2, 4], 5));
    }
}
