//! `fairmesh completions`: what a shell has to know to complete command lines.

use clap::{Args, Command};
use clap_complete::{Shell, generate};

use crate::answer::say_bytes;
use crate::failure::Failure;

/// What `fairmesh completions` is asked.
#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Prints the script.
pub fn run(args: &CompletionsArgs, mut program: Command) -> Result<bool, Failure> {
    let name = program.get_name().to_owned();
    let mut script = Vec::new();
    generate(args.shell, &mut program, name, &mut script);
    say_bytes(&script, &[])?;
    Ok(true)
}
