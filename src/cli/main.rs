//! The command line. [`failure::ExitCode`] lists how it ends.

#![allow(unreachable_pub, reason = "nothing of a program is reachable from outside")]

#[cfg(test)]
#[macro_use]
#[path = "../../tests/common/asserts.rs"]
mod asserts;

mod advice;
mod answer;
mod attempts;
mod bar;
mod batch;
mod bounds;
mod bridge;
mod chosen_creases;
mod comparison;
mod completions;
mod component_report;
mod components;
mod continuity;
mod demo;
mod explain;
mod failure;
mod fair;
mod figures;
mod fill;
mod formats;
mod generate;
mod help;
mod holes;
mod jobs;
mod join;
mod left_open;
mod man;
mod normals;
mod orientation;
mod output;
mod patches;
mod picture;
mod places;
mod region;
mod render;
mod report;
mod rim;
mod round;
mod rounded_file;
mod seams;
mod select;
mod selected;
mod selection;
mod sharp_edges;
mod shell;
mod similar;
mod solver;
mod surface;
mod temporary;
mod text;
mod which;

use std::io::{IsTerminal, Write};

use fairmesh_process::OrExit;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

use failure::{ExitCode, Failure};

/// Fairs a region of a triangle mesh: moves its vertices until the surface is smooth,
/// tangent to its surroundings and independent of the triangulation.
#[derive(Debug, Parser)]
#[command(name = "fairmesh", version, verbatim_doc_comment)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Fairs a region of a mesh file
    #[command(long_about = help::FAIR_ABOUT, after_long_help = help::FAIR_LONG, after_help = help::FAIR_SHORT)]
    Fair(Box<fair::FairArgs>),
    /// Writes one of the paper's inputs or an exact surface as a mesh file
    #[command(after_help = help::FILES)]
    Generate(generate::GenerateArgs),
    /// Makes a picture of one or more meshes
    #[command(after_help = help::FILES)]
    Render(render::RenderArgs),
    /// Selects faces of a mesh file by place and shape, and shows them
    #[command(after_help = help::SELECT)]
    Select(select::SelectArgs),
    /// Lists the boundary loops of a mesh file
    #[command(after_help = help::LISTS)]
    Holes(holes::HolesArgs),
    /// Fills the holes of a mesh file: triangulates, refines and fairs them
    #[command(after_help = help::FILL)]
    Fill(Box<fill::FillArgs>),
    /// Connects two runs of boundary edges of a mesh file by a fair strip
    #[command(after_help = help::BRIDGE)]
    Bridge(Box<bridge::BridgeArgs>),
    /// Rounds the sharp edges of a mesh file: blends take their place
    #[command(after_help = help::ROUND)]
    Round(Box<round::RoundArgs>),
    /// Makes the paper's blend of three cylinders: the start, the result and a picture of both
    #[command(after_help = help::DEMO)]
    Demo(demo::DemoArgs),
    /// Prints the script with which a shell completes command lines
    #[command(after_help = help::COMPLETIONS)]
    Completions(completions::CompletionsArgs),
    /// Writes manual pages of all commands into a directory
    #[command(after_help = help::FILES)]
    Man(man::ManArgs),
}

#[global_allocator]
static ALLOCATOR: OrExit = OrExit {
    message: "fairmesh: memory ran out; files are as they were, or whole\n",
    code: ExitCode::Exhausted as i32,
};

fn main() -> std::process::ExitCode {
    let code = run().unwrap_or_else(|failure| {
        let _ = writeln!(std::io::stderr(), "fairmesh: {failure}");
        failure.code()
    });
    std::process::ExitCode::from(code as u8)
}

/// The commands. A number below zero is a value that its flag may refuse, never a flag of its own.
fn command() -> clap::Command {
    Cli::command().mut_subcommands(|command| {
        command.mut_args(
            |arg| match arg.get_action().takes_values() && !arg.is_positional() {
                true => arg.allow_negative_numbers(true),
                false => arg,
            },
        )
    })
}

fn run() -> Result<ExitCode, Failure> {
    let read = command()
        .try_get_matches()
        .and_then(|found| Cli::from_arg_matches(&found));
    let cli = match read {
        Ok(cli) => cli,
        // To a terminal clap itself writes, in colours.
        Err(help) if !help.use_stderr() && !std::io::stdout().is_terminal() => {
            answer::say(&help.render().to_string(), &[])?;
            return Ok(ExitCode::Done);
        }
        Err(wrong) => wrong.exit(),
    };
    let is_good = match cli.command {
        Command::Fair(args) => return fair::run(&args),
        Command::Fill(args) => return fill::run(&args),
        Command::Generate(args) => generate::run(&args),
        Command::Render(args) => render::run(&args),
        Command::Select(args) => select::run(&args),
        Command::Holes(args) => holes::run(&args),
        Command::Bridge(args) => bridge::run(&args),
        Command::Round(args) => round::run(&args),
        Command::Demo(args) => demo::run(&args),
        Command::Completions(args) => completions::run(&args, command()),
        Command::Man(args) => man::run(&args, command()),
    }?;
    Ok(ExitCode::of(is_good))
}

#[cfg(test)]
mod tests {
    use fairmesh::{LooseReason, Outcome};

    use super::*;

    /// The flags that a text names.
    fn flags(text: &str) -> impl Iterator<Item = &str> {
        let words = text.split(|c: char| !(c.is_alphanumeric() || c == '-'));
        words.filter_map(|word| word.strip_prefix("--"))
    }

    fn outcomes() -> Vec<Outcome> {
        let reasons = [
            LooseReason::SuspiciousNormals,
            LooseReason::Rounding,
            LooseReason::Bump,
            LooseReason::Tolerance,
            LooseReason::DrawnNormals,
            LooseReason::Curvature,
            LooseReason::SharpEdge,
        ];
        let loose = reasons.map(|reason| Outcome::ConvergedLoosely { reason });
        let others = [
            Outcome::NotConverged,
            Outcome::IterationLimit,
            Outcome::TargetNotReachable { reached: 0.5 },
            Outcome::NearestMember { weight: 0.5 },
        ];
        loose.into_iter().chain(others).collect()
    }

    /// What is advised can be done with the command that advises it.
    #[test]
    fn advice_names_flags_that_the_command_has() {
        let whole = command();
        let has = |name: &str, flag: &str| {
            let command = whole.find_subcommand(name).unwrap();
            command.get_arguments().any(|arg| arg.get_long() == Some(flag))
        };
        let mut count = 0;
        for outcome in outcomes() {
            for (name, told) in [
                ("fair", advice::of_fairing(&outcome, None)),
                ("fair", advice::of_fairing(&outcome, Some(true))),
                ("fill", advice::of_patch(false, &outcome)),
                ("bridge", advice::of_patch(true, &outcome)),
            ] {
                assert!(!told.is_empty(), "{name}: {outcome:?}");
                for flag in flags(told) {
                    count += 1;
                    assert!(has(name, flag), "{name}, {outcome:?}: {told}");
                }
            }
        }
        assert!(count > 20, "{count} flags");
    }
}
