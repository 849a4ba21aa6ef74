//! Lines and words of a text that need not be UTF-8, by their byte offsets.

use std::ops::Range;
use std::str::FromStr;

use crate::failure::Malformed;

/// The bytes from `at` to the end of its line, and where the next line begins. The line's own end (LF or
/// CRLF) is not part of it.
pub fn line(bytes: &[u8], at: usize) -> (Range<usize>, usize) {
    let (end, next) = match bytes[at..].iter().position(|&byte| byte == b'\n') {
        Some(length) => (at + length, at + length + 1),
        None => (bytes.len(), bytes.len()),
    };
    let end = if end > at && bytes[end - 1] == b'\r' {
        end - 1
    } else {
        end
    };
    (at..end, next)
}

/// The words of a stretch of text, separated by white space, up to a word that begins with `#`.
pub fn words(bytes: &[u8], range: Range<usize>) -> Words<'_> {
    Words {
        bytes,
        at: range.start,
        end: range.end,
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
        while self.at < self.end && self.is_gap(self.at) {
            self.at += 1;
        }
        if self.at >= self.end || self.bytes[self.at] == b'#' {
            self.at = self.end;
            return None;
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
