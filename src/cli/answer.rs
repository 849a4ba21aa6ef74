//! Where a command's report goes: to people on stdout, and as JSON to a file, or to stdout instead.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use serde_json::Value;

use crate::failure::{ExitCode, Failure};
use crate::output::Output;

/// The destinations of a report.
pub struct Answer {
    json: Option<Json>,
    is_quiet: bool,
}

enum Json {
    Stdout,
    File(Output),
}

impl Answer {
    /// Finds out whether the report can be written, before any work is done: not over the files of the mesh.
    pub fn prepare(json: Option<&Path>, is_quiet: bool, mesh: &[&Path]) -> Result<Self, Failure> {
        let json = match json {
            None => None,
            Some(path) if path == Path::new("-") => Some(Json::Stdout),
            Some(path) if mesh.iter().any(|other| same_file(path, other)) => {
                return Err(Failure::new(format!(
                    "{}: --json would overwrite the mesh; name another file",
                    path.display()
                )));
            }
            Some(path) => Some(Json::File(Output::prepare(path)?)),
        };
        Ok(Self { json, is_quiet })
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
        say(&readable(), written)
    }
}

/// Writes to stdout; a closed pipe is not our failure.
pub fn say(text: &str, written: &[&Path]) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(why) if why.kind() != io::ErrorKind::BrokenPipe => {
            let failure = Failure::new(format!("standard output: cannot write: {why}"));
            Err(untold(failure, written))
        }
        _ => Ok(()),
    }
}

/// A report that could not be written, and what was.
fn untold(failure: Failure, written: &[&Path]) -> Failure {
    let names: Vec<String> = written.iter().map(|path| path.display().to_string()).collect();
    let failure = failure.with_code(ExitCode::Untold);
    if names.is_empty() {
        return failure;
    }
    failure.and(&format!("the result was written to {}", names.join(", ")))
}

fn same_file(a: &Path, b: &Path) -> bool {
    let resolved = |path: &Path| fs::canonicalize(path).or_else(|_| std::path::absolute(path)).ok();
    resolved(a) == resolved(b)
}
