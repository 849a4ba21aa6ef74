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

impl SymmetricPattern {
    /// The number of rows.
    pub fn order(&self) -> usize {
        self.start.len().saturating_sub(1)
    }

    /// The columns of one row, the diagonal last.
    pub fn row(&self, i: usize) -> &[u32] {
        &self.column[self.start[i]..self.start[i + 1]]
    }
}
