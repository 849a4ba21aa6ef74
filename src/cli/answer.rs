//! Where a command's report goes: to people on stdout (on stderr, where stdout has a mesh), and as JSON to a file, or to stdout instead.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use serde_json::Value;

use crate::failure::{ExitCode, Failure};
use crate::formats::pipes::is_piped;
use crate::output::Output;

/// The destinations of a report.
pub struct Answer {
    json: Option<Json>,
    is_quiet: bool,
    /// Whether stdout has the mesh.
    is_beside: bool,
}

enum Json {
    Stdout,
    File(Output),
}

impl Answer {
    /// Finds out whether the report can be written, before any work is done: not over the files of the mesh, and not into
    /// a mesh that goes to stdout.
    pub fn prepare(
        json: Option<&Path>,
        is_quiet: bool,
        output: Option<&Path>,
        inputs: &[&Path],
    ) -> Result<Self, Failure> {
        let is_beside = output.is_some_and(is_piped);
        let json = match json {
            None => None,
            Some(path) if is_piped(path) && is_beside => {
                return Err(Failure::new(
                    "--json -: stdout is where the mesh goes; name a file for the report",
                ));
            }
            Some(path) if is_piped(path) => Some(Json::Stdout),
            Some(path)
                if inputs
                    .iter()
                    .copied()
                    .chain(output)
                    .any(|other| same_file(path, other)) =>
            {
                return Err(Failure::new(format!(
                    "{}: --json would overwrite the mesh; name another file",
                    path.display()
                )));
            }
            Some(path) => Some(Json::File(Output::prepare(path)?)),
        };
        Ok(Self {
            json,
            is_quiet,
            is_beside,
        })
    }

    /// Tells the report. `written` are the files that stand already, for the message if it cannot be told.
    pub fn tell(
        &self,
        written: &[&Path],
        json: impl FnOnce() -> Value,
        readable: impl FnOnce() -> String,
    ) -> Result<(), Failure> {
        let text = |json: Value| format!("{json:#}\n");
        let told = match &self.json {
            Some(Json::Stdout) => return say(&text(json()), written),
            Some(Json::File(output)) => output.write(text(json()).as_bytes()),
            None => Ok(()),
        };
        told.map_err(|failure| untold(failure, written))?;
        if self.is_quiet {
            return Ok(());
        }
        match self.is_beside {
            true => say_aside(&readable(), written),
            false => say(&readable(), written),
        }
    }
}

/// Writes to stderr, where stdout has a mesh.
pub fn say_aside(text: &str, written: &[&Path]) -> Result<(), Failure> {
    told(io::stderr().lock(), "standard error", text.as_bytes(), written)
}

/// Writes to stdout; a closed pipe is not our failure.
pub fn say(text: &str, written: &[&Path]) -> Result<(), Failure> {
    say_bytes(text.as_bytes(), written)
}

/// The same of a text that need not be UTF-8.
pub fn say_bytes(text: &[u8], written: &[&Path]) -> Result<(), Failure> {
    told(io::stdout().lock(), "standard output", text, written)
}

fn told(mut to: impl Write, name: &str, text: &[u8], written: &[&Path]) -> Result<(), Failure> {
    match to.write_all(text).and_then(|()| to.flush()) {
        Err(why) if why.kind() != io::ErrorKind::BrokenPipe => {
            let failure = Failure::new(format!("{name}: cannot write: {why}"));
            Err(untold(failure, written))
        }
        _ => Ok(()),
    }
}

/// A report that could not be written, and what was.
pub fn untold(failure: Failure, written: &[&Path]) -> Failure {
    let names: Vec<String> = written.iter().map(|path| path.display().to_string()).collect();
    let failure = failure.with_code(ExitCode::Untold);
    if names.is_empty() {
        return failure;
    }
    failure.and(&format!("the result was written to {}", names.join(", ")))
}

/// Whether two names are of one file; stdin and stdout are none.
pub fn same_file(a: &Path, b: &Path) -> bool {
    if is_piped(a) || is_piped(b) {
        return false;
    }
    let resolved = |path: &Path| fs::canonicalize(path).or_else(|_| std::path::absolute(path)).ok();
    resolved(a) == resolved(b)
}
