//! Which bytes of the caller's memory a call reads and writes: what it writes overlaps nothing.

/// Rows of bytes, one every `stride`.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Bytes {
    pub start: usize,
    /// Behind the last row.
    pub end: usize,
    row: usize,
    stride: usize,
}

impl Bytes {
    /// One block.
    pub(crate) fn block<T>(pointer: *const T, bytes: usize) -> Self {
        Self::rows(pointer, bytes, bytes, bytes)
    }

    /// Rows that take up so many bytes from the first to behind the last. They are within the address space.
    pub(crate) fn rows<T>(pointer: *const T, bytes: usize, row: usize, stride: usize) -> Self {
        let start = pointer as usize;
        Self {
            start,
            end: start + bytes,
            row,
            stride,
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.start == self.end
    }

    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        let is_apart = self.end <= other.start || other.end <= self.start;
        !is_apart && !self.is_beside(other)
    }

    /// Whether the rows pass each other by, as different fields of the same structs do.
    fn is_beside(&self, other: &Self) -> bool {
        let stride = self.stride;
        if stride != other.stride {
            return false;
        }
        let ahead = (other.start % stride + stride - self.start % stride) % stride;
        ahead >= self.row && ahead + other.row <= stride
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(start: usize, count: usize, row: usize, stride: usize) -> Bytes {
        Bytes::rows(start as *const u8, (count - 1) * stride + row, row, stride)
    }

    #[test]
    fn fields_of_the_same_structs_do_not_overlap() {
        let (positions, normals) = (rows(1000, 10, 12, 32), rows(1012, 10, 12, 32));
        let last = rows(1024, 10, 8, 32);
        for (a, b) in [(&positions, &normals), (&normals, &last), (&positions, &last)] {
            assert!(!a.overlaps(b) && !b.overlaps(a));
        }
        // Also where one of them begins some structs later.
        assert!(!positions.overlaps(&rows(1012 + 3 * 32, 5, 12, 32)));
        assert!(!rows(1000 + 3 * 32, 5, 12, 32).overlaps(&normals));
    }

    #[test]
    fn rows_that_share_a_byte_overlap() {
        let positions = rows(1000, 10, 12, 32);
        for other in [
            positions,
            rows(1011, 10, 1, 32),
            rows(1012, 10, 21, 32),
            rows(1012, 10, 12, 24),
            Bytes::block(1000 as *const u8, 4),
            Bytes::block(1000 as *const u8, 1000),
        ] {
            assert!(positions.overlaps(&other) && other.overlaps(&positions));
        }
        assert!(!positions.overlaps(&Bytes::block(1300 as *const u8, 8)));
    }
}
