//! The flags for the format of meshes that come from stdin or go to stdout.

use std::path::Path;

use clap::Args;

use super::format::Format;
use super::pipes::is_piped;
use crate::failure::Failure;

/// The flag of commands that either read meshes or write them.
#[derive(Debug, Args)]
pub struct PipeArgs {
    /// Format of the mesh that is read from stdin or written to stdout ('-')
    #[arg(long, value_enum, value_name = "FORMAT")]
    format: Option<Format>,
}

impl PipeArgs {
    /// The format of what is piped among these; at most one of them is.
    pub fn of(&self, paths: &[&Path]) -> Result<Option<Format>, Failure> {
        match paths.iter().filter(|path| is_piped(path)).count() {
            0 => unused("--format", self.format)?,
            1 => {}
            _ => return Err(Failure::new("-: stdin is one mesh; name it once")),
        }
        Ok(self.format)
    }
}

/// The flags of commands that read a mesh and write one.
#[derive(Debug, Args)]
pub struct PipesArgs {
    /// Format of meshes read from stdin and written to stdout ('-')
    #[arg(long, value_enum, value_name = "FORMAT")]
    format: Option<Format>,
    /// Format of stdin, if it differs from --format
    #[arg(long, value_enum, value_name = "FORMAT")]
    input_format: Option<Format>,
}

/// The formats that were said of what is piped.
#[derive(Debug, Clone, Copy, Default)]
pub struct Piped {
    pub input: Option<Format>,
    pub output: Option<Format>,
}

impl PipesArgs {
    /// The formats of an input and an output.
    pub fn of(&self, input: &Path, output: Option<&Path>) -> Result<Piped, Failure> {
        if !is_piped(input) {
            unused("--input-format", self.input_format)?;
        }
        let needs_format = is_piped(input) && self.input_format.is_none() || output.is_some_and(is_piped);
        if !needs_format {
            unused("--format", self.format)?;
        }
        Ok(Piped {
            input: self.input_format.or(self.format),
            output: self.format,
        })
    }
}

/// A format of nothing would be taken for that of a file, whose name says another.
fn unused(flag: &str, format: Option<Format>) -> Result<(), Failure> {
    match format {
        None => Ok(()),
        Some(_) => Err(Failure::new(format!(
            "{flag}: no mesh that this is the format of is piped ('-'); that of a file is told by its name"
        ))),
    }
}
