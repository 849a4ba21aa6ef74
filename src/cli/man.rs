//! `fairmesh man`: a manual page of the program and of every command.

use std::fs;
use std::path::PathBuf;

use clap::{Args, Command};
use clap_mangen::Man;

use crate::answer::say;
use crate::failure::Failure;
use crate::output::Output;

/// What `fairmesh man` is asked.
#[derive(Debug, Args)]
pub struct ManArgs {
    /// Directory for the pages; made if it does not exist
    directory: PathBuf,
}

/// Writes the pages.
pub fn run(args: &ManArgs, program: Command) -> Result<bool, Failure> {
    let directory = args.directory.display();
    fs::create_dir_all(&args.directory)
        .map_err(|why| Failure::new(format!("{directory}: cannot make this directory: {why}")))?;
    let mut program = program.disable_help_subcommand(true);
    // Gives every command the name of its page, "fairmesh-fair".
    program.build();
    let commands = program.get_subcommands().cloned();
    let pages: Vec<Man> = std::iter::once(program.clone())
        .chain(commands)
        .map(Man::new)
        .collect();
    for page in &pages {
        let mut text = Vec::new();
        page.render(&mut text)
            .map_err(|why| Failure::new(format!("{directory}: no page can be made: {why}")))?;
        Output::prepare(&args.directory.join(page.get_filename()))?.write(&text)?;
    }
    let text = format!(
        "{} pages in {directory}; 'man -l {directory}/fairmesh.1' shows one\n",
        pages.len()
    );
    say(&text, &[&args.directory])?;
    Ok(true)
}
