//! What went wrong, in one line.

use std::fmt;

/// One line for the user: what, where, what to do; and the exit code.
#[derive(Debug, Clone, PartialEq)]
pub struct Failure {
    message: String,
    code: ExitCode,
}

/// How the program ends. Documented in `help.rs` and docs/command-line.md.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExitCode {
    /// All that was asked for was done.
    Done = 0,
    /// Usage, input or the place of the output is wrong: nothing was written.
    Refused = 2,
    /// The result was written, but it is not what was asked for.
    Imperfect = 3,
    /// Memory or threads ran out: nothing was written.
    Exhausted = 4,
    /// The files were written, but not the report about them.
    Untold = 5,
}

impl ExitCode {
    /// Of a result that was written.
    pub fn of(is_good: bool) -> Self {
        match is_good {
            true => ExitCode::Done,
            false => ExitCode::Imperfect,
        }
    }

    /// The larger, the worse: what was not written is worse than what was.
    pub fn severity(self) -> u8 {
        match self {
            ExitCode::Done => 0,
            ExitCode::Imperfect => 1,
            ExitCode::Untold => 2,
            ExitCode::Refused => 3,
            ExitCode::Exhausted => 4,
        }
    }
}

impl Failure {
    /// A refusal with this message; line breaks (from odd file names or systems) become spaces.
    pub fn new(message: impl Into<String>) -> Self {
        Self {
            message: message.into().replace(['\n', '\r'], " "),
            code: ExitCode::Refused,
        }
    }

    /// The same with another exit code.
    pub fn with_code(self, code: ExitCode) -> Self {
        Self { code, ..self }
    }

    /// The message, with more behind it.
    pub fn and(self, more: &str) -> Self {
        Self {
            message: format!("{}; {more}", self.message),
            ..self
        }
    }

    /// The exit code that goes with it.
    pub fn code(&self) -> ExitCode {
        self.code
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
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
            // LF, CRLF and CR end a line.
            let mut before = bytes[..self.at.min(bytes.len())].iter().peekable();
            let mut line = 1;
            while let Some(byte) = before.next() {
                let is_end = *byte == b'\n' || *byte == b'\r' && before.peek() != Some(&&b'\n');
                line += usize::from(is_end);
            }
            Failure::new(format!("{name}:{line}: {}", self.what))
        } else {
            Failure::new(format!("{name}: byte {}: {}", self.at, self.what))
        }
    }
}
