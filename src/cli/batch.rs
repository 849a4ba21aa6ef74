//! Runs a command on its meshes: a report of one, a table of several.

use std::fmt::Write;
use std::io::Write as _;
use std::path::Path;
use std::time::Instant;

use serde_json::{Value, json};

use crate::answer::Answer;
use crate::failure::{ExitCode, Failure};
use crate::jobs::{FilesArgs, Job};

/// What became of a mesh; the result is written.
pub struct Done {
    pub is_good: bool,
    /// In a few words, for a table.
    pub outcome: String,
    /// The report; null if nobody asked for it.
    pub json: Value,
    pub readable: String,
    /// What there is to say of the files that the mesh names.
    pub references: Vec<String>,
}

impl Done {
    /// With what is said of other files in both reports.
    fn whole(mut self) -> Self {
        if self.json.is_object() {
            self.json["references"] = json!(self.references);
        }
        for line in &self.references {
            let _ = writeln!(self.readable, "{line}");
        }
        self
    }
}

/// Where the report goes, and how much of it.
pub struct Telling<'a> {
    pub json: Option<&'a Path>,
    pub is_quiet: bool,
    /// Of several meshes, the report of each before the table.
    pub is_verbose: bool,
}

/// What became of one of several meshes.
struct Row<'a> {
    job: &'a Job,
    ended: Result<Done, Failure>,
    seconds: f64,
}

impl Row<'_> {
    fn code(&self) -> ExitCode {
        match &self.ended {
            Ok(done) => ExitCode::of(done.is_good),
            Err(failure) => failure.code(),
        }
    }

    fn outcome(&self) -> &str {
        match &self.ended {
            Ok(done) => &done.outcome,
            Err(failure) => match failure.code() {
                ExitCode::Exhausted => "exhausted",
                ExitCode::Untold => "written, not told",
                _ => "refused",
            },
        }
    }

    /// Whether the result stands.
    fn is_written(&self) -> bool {
        let told = self.ended.as_ref().err().map(Failure::code);
        told.is_none_or(|code| code == ExitCode::Untold)
    }

    fn json(&self) -> Value {
        let (report, error) = match &self.ended {
            Ok(done) => (&done.json, Value::Null),
            Err(failure) => (&Value::Null, json!(failure.to_string())),
        };
        json!({ "input": self.job.input.display().to_string(), "output": self.job.output.display().to_string(),
            "outcome": self.outcome(), "exit_code": self.code() as u8, "seconds": self.seconds,
            "error": error, "report": report })
    }
}

/// Does all jobs. A failure of one of several does not stop the others; they are told at the end, and the worst decides.
pub fn run(
    files: &FilesArgs,
    telling: &Telling<'_>,
    mut one: impl FnMut(&Job) -> Result<Done, Failure>,
) -> Result<ExitCode, Failure> {
    let jobs = files.jobs(telling.json.is_some())?;
    if let [job] = &jobs[..] {
        let (output, input) = (Some(job.output.as_path()), [job.input.as_path()]);
        let answer = Answer::prepare(telling.json, telling.is_quiet, output, &input)?;
        let done = one(job)?.whole();
        answer.tell(&[&job.output], || done.json, || done.readable)?;
        return Ok(ExitCode::of(done.is_good));
    }
    let all = jobs.iter().flat_map(|job| [job.input.as_path(), &job.output]);
    let answer = Answer::prepare(telling.json, telling.is_quiet, None, &all.collect::<Vec<_>>())?;
    let mut rows = Vec::new();
    for job in &jobs {
        let start = Instant::now();
        let ended = one(job).map(Done::whole);
        let seconds = start.elapsed().as_secs_f64();
        rows.push(Row { job, ended, seconds });
    }
    let worst = rows.iter().map(Row::code).max_by_key(|code| code.severity());
    let worst = worst.unwrap_or(ExitCode::Done);
    let written: Vec<&Path> = rows
        .iter()
        .filter(|row| row.is_written())
        .map(|row| row.job.output.as_path())
        .collect();
    let told = answer.tell(
        &written,
        || json!({ "files": rows.iter().map(Row::json).collect::<Vec<Value>>() }),
        || table(&rows, telling.is_verbose),
    );
    for failure in rows.iter().filter_map(|row| row.ended.as_ref().err()) {
        let _ = writeln!(std::io::stderr(), "fairmesh: {failure}");
    }
    told.map_err(|failure| {
        let untold = failure.code();
        let is_worse = worst.severity() > untold.severity();
        failure.with_code(if is_worse { worst } else { untold })
    })?;
    Ok(worst)
}

/// A line for each mesh, and how many ended how.
fn table(rows: &[Row<'_>], is_verbose: bool) -> String {
    let mut text = String::new();
    if is_verbose {
        for row in rows {
            if let Ok(done) = &row.ended {
                let _ = writeln!(text, "{}:\n{}", row.job.input.display(), done.readable);
            }
        }
    }
    let names: Vec<String> = rows
        .iter()
        .map(|row| row.job.input.display().to_string())
        .collect();
    let width = |of: &mut dyn Iterator<Item = &str>| of.map(|text| text.chars().count()).max().unwrap_or(0);
    let name_width = width(&mut names.iter().map(String::as_str)).max("file".len());
    let outcome_width = width(&mut rows.iter().map(Row::outcome)).max("outcome".len());
    let _ = writeln!(
        text,
        "{:name_width$}  {:outcome_width$}  seconds",
        "file", "outcome"
    );
    for (name, row) in names.iter().zip(rows) {
        let (outcome, seconds) = (row.outcome(), row.seconds);
        let _ = writeln!(
            text,
            "{name:name_width$}  {outcome:outcome_width$}  {seconds:7.2}"
        );
    }
    let count = |code: &dyn Fn(ExitCode) -> bool| rows.iter().filter(|row| code(row.code())).count();
    let good = count(&|code| code == ExitCode::Done);
    let imperfect = count(&|code| matches!(code, ExitCode::Imperfect | ExitCode::Untold));
    let _ = writeln!(
        text,
        "{} files: {good} as asked, {imperfect} written with a reservation, {} not written",
        rows.len(),
        rows.len() - good - imperfect
    );
    text
}
