//! Rows of different lengths, one after the other.

use std::ops::Range;

/// Row `i` holds the values that belong to number `i`: a vertex, most of the time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Rows<T> {
    /// One offset per row, and the end.
    start: Vec<u32>,
    values: Vec<T>,
}

impl<T: Copy + Default> Rows<T> {
    /// Values by their row, in the order given within each.
    pub(crate) fn collect(rows: usize, entries: impl Iterator<Item = (u32, T)> + Clone) -> Self {
        let mut start = vec![0u32; rows + 1];
        entries.clone().for_each(|(row, _)| start[row as usize + 1] += 1);
        (0..rows).for_each(|row| start[row + 1] += start[row]);
        let mut next = start.clone();
        let mut values = vec![T::default(); start[rows] as usize];
        // Not a loop: iterators of parts go through those faster.
        entries.for_each(|(row, value)| {
            let at = &mut next[row as usize];
            values[*at as usize] = value;
            *at += 1;
        });
        Self { start, values }
    }
}

impl<T> Rows<T> {
    /// How many rows there are.
    #[inline]
    pub(crate) fn len(&self) -> usize {
        self.start.len() - 1
    }

    /// Where row `i` stands among all values.
    #[inline]
    pub(crate) fn range(&self, i: usize) -> Range<usize> {
        self.start[i] as usize..self.start[i + 1] as usize
    }

    /// Row `i`.
    #[inline]
    pub(crate) fn row(&self, i: usize) -> &[T] {
        &self.values[self.range(i)]
    }

    /// All values, row after row.
    #[inline]
    pub(crate) fn values(&self) -> &[T] {
        &self.values
    }

    /// The first `rows` rows with other values.
    pub(crate) fn map_first<U>(&self, rows: usize, f: impl Fn(&T) -> U) -> Rows<U> {
        Rows {
            start: self.start[..=rows].to_vec(),
            values: self.values[..self.start[rows] as usize].iter().map(f).collect(),
        }
    }

    /// One more value of the row that is begun behind the last.
    #[inline]
    pub(crate) fn push(&mut self, value: T) {
        self.values.push(value);
    }

    /// Ends that row.
    pub(crate) fn end_row(&mut self) {
        self.start.push(self.values.len() as u32);
    }

    /// Row `i`, to be changed.
    #[inline]
    pub(crate) fn row_mut(&mut self, i: usize) -> &mut [T] {
        let range = self.range(i);
        &mut self.values[range]
    }

    /// Drops all rows from number `rows` on.
    pub(super) fn truncate(&mut self, rows: usize) {
        self.start.truncate(rows + 1);
        self.values.truncate(self.start[rows] as usize);
    }
}

impl<T> Default for Rows<T> {
    fn default() -> Self {
        Self {
            start: vec![0],
            values: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_come_to_their_rows_in_the_order_given() {
        let entries = [(2, 'a'), (0, 'b'), (2, 'c'), (3, 'd')];
        let mut rows = Rows::collect(4, entries.into_iter());
        assert_eq!(rows.len(), 4);
        assert_eq!(
            [0, 1, 2, 3].map(|i| rows.row(i).to_vec()),
            [vec!['b'], vec![], vec!['a', 'c'], vec!['d']]
        );
        rows.truncate(3);
        assert_eq!(
            (rows.len(), rows.range(2), rows.values()),
            (3, 1..3, &['b', 'a', 'c'][..])
        );
        rows.push('e');
        rows.end_row();
        assert_eq!((rows.len(), rows.row(3)), (4, &['e'][..]));
    }
}
