//! Which meshes a command takes and where each result goes: one file to another, or several into a directory or in place.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::failure::Failure;
use crate::formats::pipe_args::{Piped, PipesArgs};
use crate::formats::pipes::is_piped;

/// The files of `fair` and `fill`.
#[derive(Debug, Args)]
pub struct FilesArgs {
    /// Mesh file: .ply, .obj, .off or .stl, optionally .gz; '-': stdin. Several files are
    /// processed one after the other, with a table of the outcomes at the end
    #[arg(required = true, value_name = "INPUT", verbatim_doc_comment)]
    inputs: Vec<PathBuf>,
    /// Output file; may be the input; '-': stdout. Written completely or not at all. In a
    /// directory, or a name ending in / (which is created), results keep the names of
    /// their inputs
    #[arg(
        short,
        long,
        value_name = "FILE",
        required_unless_present = "in_place",
        verbatim_doc_comment
    )]
    output: Option<PathBuf>,
    /// Replace each input by its result
    #[arg(long, conflicts_with = "output")]
    in_place: bool,
    #[command(flatten)]
    pipes: PipesArgs,
}

/// A mesh to be read, and where its result goes.
pub struct Job {
    pub input: PathBuf,
    pub output: PathBuf,
    pub piped: Piped,
    /// Whether anyone wants the report as JSON.
    pub asks_json: bool,
}

impl FilesArgs {
    /// The meshes, as they were named.
    pub fn inputs(&self) -> &[PathBuf] {
        &self.inputs
    }

    /// What is to be done, in the order of the inputs. Makes the directory of the results.
    ///
    /// # Errors
    /// Several results at one place, or at the place of another input.
    pub fn jobs(&self, asks_json: bool) -> Result<Vec<Job>, Failure> {
        let into = match &self.output {
            Some(output) if is_directory(output) => Some(output),
            _ => None,
        };
        let mut jobs = Vec::new();
        for input in &self.inputs {
            let output = match (into, &self.output) {
                (Some(directory), _) => directory.join(name_in(directory, input)?),
                (None, Some(output)) => {
                    if self.inputs.len() > 1 {
                        return Err(Failure::new(format!(
                            "-o {}: several results need a directory; make it before, or end its name in /",
                            output.display()
                        )));
                    }
                    output.clone()
                }
                (None, None) if is_piped(input) => {
                    return Err(Failure::new("--in-place: stdin ('-') is no place; give -o"));
                }
                (None, None) => input.clone(),
            };
            jobs.push(Job {
                piped: self.pipes.of(input, Some(&output))?,
                input: input.clone(),
                output,
                asks_json,
            });
        }
        if let Some(directory) = into {
            fs::create_dir_all(directory).map_err(|why| {
                Failure::new(format!(
                    "{}: cannot make this directory: {why}",
                    directory.display()
                ))
            })?;
        }
        apart(&jobs)?;
        Ok(jobs)
    }
}

/// A directory that is there, or a name that can be nothing else.
pub fn is_directory(path: &Path) -> bool {
    path.is_dir()
        || path
            .as_os_str()
            .to_string_lossy()
            .ends_with(std::path::is_separator)
}

/// The name of a result in a directory.
fn name_in<'a>(directory: &Path, input: &'a Path) -> Result<&'a Path, Failure> {
    let name = input.file_name().filter(|_| !is_piped(input));
    name.map(Path::new).ok_or_else(|| {
        Failure::new(format!(
            "{}: this has no name that its result could have in {}; name a file by -o",
            input.display(),
            directory.display()
        ))
    })
}

/// No result takes the place of another one, or of a mesh that is still to be read.
fn apart(jobs: &[Job]) -> Result<(), Failure> {
    let mut places: BTreeMap<PathBuf, &Path> = BTreeMap::new();
    if jobs.len() < 2 {
        return Ok(());
    }
    for job in jobs {
        if let Some(other) = places.insert(place(&job.output), &job.input) {
            return Err(Failure::new(format!(
                "{} and {} would both be written to {}; do them one by one",
                other.display(),
                job.input.display(),
                job.output.display()
            )));
        }
    }
    for job in jobs {
        match places.get(&place(&job.input)) {
            Some(&other) if other != job.input => {
                return Err(Failure::new(format!(
                    "{}: the result of {} would be written over it; name another directory",
                    job.input.display(),
                    other.display()
                )));
            }
            _ => {}
        }
    }
    Ok(())
}

/// One name for every file, behind links, whether it is there or not.
fn place(path: &Path) -> PathBuf {
    let resolved = fs::canonicalize(path).or_else(|why| {
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
        let name = path.file_name().ok_or(why)?;
        fs::canonicalize(parent.unwrap_or(Path::new("."))).map(|parent| parent.join(name))
    });
    resolved.unwrap_or_else(|_| path.to_path_buf())
}
