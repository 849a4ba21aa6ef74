//! What went wrong, in one line.

use std::fmt;

/// One line for the user: what, where, what to do.
#[derive(Debug, Clone, PartialEq)]
pub struct Failure(String);

impl Failure {
    /// A failure with this message; line breaks (from odd file names or systems) become spaces.
    pub fn new(message: impl Into<String>) -> Self {
        Self(message.into().replace(['\n', '\r'], " "))
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// A place in a file that makes no sense. The reader of the file adds its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Malformed {
    /// Offset of the place, in bytes.
    pub at: usize,
    /// Whether people would look it up by line (text) or by byte (binary).
    pub by_line: bool,
    /// What is wrong there.
    pub what: String,
}

impl Malformed {
    /// Wrong text at this offset.
    pub fn text(at: usize, what: impl Into<String>) -> Self {
        Self {
            at,
            by_line: true,
            what: what.into(),
        }
    }

    /// Wrong binary data at this offset.
    pub fn binary(at: usize, what: impl Into<String>) -> Self {
        Self {
            at,
            by_line: false,
            what: what.into(),
        }
    }

    /// `name:line: what` or `name: byte offset: what`.
    pub fn locate(&self, name: &str, bytes: &[u8]) -> Failure {
        if self.by_line {
            let before = &bytes[..self.at.min(bytes.len())];
            let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
            Failure::new(format!("{name}:{line}: {}", self.what))
        } else {
            Failure::new(format!("{name}: byte {}: {}", self.at, self.what))
        }
    }
}
