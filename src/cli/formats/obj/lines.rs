//! Lines of OBJ that go on behind a backslash.

use std::ops::Range;

use crate::text;

/// The bytes from `at` to the end of its line, joined with the next line after a backslash, and where the
/// next line begins.
pub fn logical_line(bytes: &[u8], at: usize) -> (Range<usize>, usize) {
    let (mut range, mut next) = text::line(bytes, at);
    if bytes[range.clone()].contains(&b'#') {
        // A comment is never joined.
        return (range, next);
    }
    while range.end > range.start && bytes[range.end - 1] == b'\\' && next < bytes.len() {
        let (more, after) = text::line(bytes, next);
        // An empty line after the backslash must not end in the same backslash again.
        let grown = more.end > range.end && more.start < more.end;
        (range.end, next) = (more.end, after);
        if !grown {
            break;
        }
    }
    (range, next)
}
