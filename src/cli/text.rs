//! Lines and words of a text that need not be UTF-8, by their byte offsets.

use std::ops::Range;
use std::str::FromStr;

use crate::failure::Malformed;

/// Where the text begins: behind the mark of UTF-8, if there is one.
pub fn start(bytes: &[u8]) -> usize {
    if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 }
}

/// The bytes from `at` to the end of its line, and where the next line begins. The line's own end (LF, CRLF or CR) is
/// not part of it.
pub fn line(bytes: &[u8], at: usize) -> (Range<usize>, usize) {
    let is_end = |&byte: &u8| byte == b'\n' || byte == b'\r';
    let Some(length) = bytes[at..].iter().position(is_end) else {
        return (at..bytes.len(), bytes.len());
    };
    let end = at + length;
    let next = end + if bytes[end..].starts_with(b"\r\n") { 2 } else { 1 };
    (at..end, next)
}

/// The words of a stretch of text, separated by white space. A word that begins with `#` and the rest of its line are a
/// comment.
pub fn words(bytes: &[u8], range: Range<usize>) -> Words<'_> {
    Words {
        bytes,
        at: range.start,
        end: range.end,
    }
}

/// How the rows of a table lie on the lines of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// Each on its own; what a line has behind its row is passed over.
    Lines,
    /// Anywhere: line ends are white space, and nothing may stand behind a row but the next.
    Free,
}

impl Layout {
    /// Where the row at `at` really begins, behind blank lines and comments; None at the end of the file.
    pub fn start(self, bytes: &[u8], at: usize) -> Option<usize> {
        if self == Layout::Free {
            return Some(words(bytes, at..bytes.len()).next()?.start);
        }
        let mut at = at;
        while at < bytes.len() {
            let (range, next) = line(bytes, at);
            if words(bytes, range).next().is_some() {
                return Some(at);
            }
            at = next;
        }
        None
    }

    /// The words that the row at `at` may have.
    pub fn words(self, bytes: &[u8], at: usize) -> Words<'_> {
        match self {
            Layout::Lines => words(bytes, line(bytes, at).0),
            Layout::Free => words(bytes, at..bytes.len()),
        }
    }

    /// Where the next row may begin once a row's words have been taken.
    pub fn next(self, bytes: &[u8], taken: &Words<'_>) -> usize {
        match self {
            Layout::Lines => line(bytes, taken.at).1,
            Layout::Free => taken.at,
        }
    }

    /// Refuses what stands behind the last row.
    pub fn end(self, bytes: &[u8], at: usize) -> Result<(), Malformed> {
        match words(bytes, at..bytes.len()).next() {
            Some(word) if self == Layout::Free => {
                let what = format!("{} stands behind the last row", shown(bytes, word.clone()));
                Err(Malformed::text(word.start, what))
            }
            _ => Ok(()),
        }
    }

    /// Reads a text whose rows should be on lines of their own, but need not be. What is wrong is told as if they were.
    pub fn find<T>(mut read: impl FnMut(Self) -> Result<T, Malformed>) -> Result<T, Malformed> {
        read(Layout::Lines).or_else(|why| read(Layout::Free).map_err(|_| why))
    }
}

/// Iterator of [`words`].
#[derive(Clone)]
pub struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
    end: usize,
}

impl Words<'_> {
    /// Where the next search begins.
    pub fn offset(&self) -> usize {
        self.at
    }

    /// A backslash directly before a line end joins two lines.
    fn is_gap(&self, at: usize) -> bool {
        match self.bytes[at] {
            b'\\' => matches!(self.bytes.get(at + 1), Some(b'\n' | b'\r')) && at + 1 < self.end,
            byte => byte.is_ascii_whitespace() || byte == 0x0b,
        }
    }
}

impl Iterator for Words<'_> {
    type Item = Range<usize>;

    fn next(&mut self) -> Option<Range<usize>> {
        loop {
            while self.at < self.end && self.is_gap(self.at) {
                self.at += 1;
            }
            if self.at >= self.end {
                return None;
            }
            if self.bytes[self.at] != b'#' {
                break;
            }
            self.at = line(self.bytes, self.at).0.end.min(self.end);
        }
        let start = self.at;
        while self.at < self.end && !self.is_gap(self.at) {
            self.at += 1;
        }
        Some(start..self.at)
    }
}

/// A word as people read it, shortened.
pub fn shown(bytes: &[u8], word: Range<usize>) -> String {
    let text = String::from_utf8_lossy(&bytes[word]);
    let short: String = text.chars().take(24).flat_map(char::escape_default).collect();
    if text.chars().count() > 24 {
        format!("'{short}...'")
    } else {
        format!("'{short}'")
    }
}

/// A word as a number; `what` names it in the error.
pub fn number(bytes: &[u8], word: Range<usize>, what: &str) -> Result<f64, Malformed> {
    parsed(bytes, word, what, "a number")
}

/// A word as a whole number; `what` names it in the error.
pub fn integer(bytes: &[u8], word: Range<usize>, what: &str) -> Result<i64, Malformed> {
    parsed(bytes, word, what, "a whole number")
}

fn parsed<T: FromStr>(bytes: &[u8], word: Range<usize>, what: &str, kind: &str) -> Result<T, Malformed> {
    let text = std::str::from_utf8(&bytes[word.clone()]).ok();
    let value = text.and_then(|text| text.parse().ok());
    value.ok_or_else(|| {
        let shown = shown(bytes, word.clone());
        Malformed::text(word.start, format!("{what}: {shown} is not {kind}"))
    })
}

/// Three numbers, or what is missing.
pub fn triple(bytes: &[u8], words: &mut Words<'_>, what: &str) -> Result<[f64; 3], Malformed> {
    let mut triple = [0.0; 3];
    for (axis, value) in triple.iter_mut().enumerate() {
        let at = words.offset();
        let word = words
            .next()
            .ok_or_else(|| Malformed::text(at, format!("{what} has {axis} of 3 numbers")))?;
        *value = number(bytes, word, what)?;
    }
    Ok(triple)
}

/// The shortest text that reads back as the same double; very large and very small values with an exponent.
pub fn double(value: f64) -> String {
    if value == 0.0 || (1e-5..1e16).contains(&value.abs()) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// The shortest text that reads back as the same single.
pub fn single(value: f32) -> String {
    if value == 0.0 || (1e-5..1e9).contains(&value.abs()) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}
