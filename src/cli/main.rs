//! The command line.
//!
//! Exit codes: 0 converged and sound, 2 wrong usage or input, 3 written but not converged.

#![allow(unreachable_pub, reason = "nothing of a program is reachable from outside")]

mod bar;
mod component_report;
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
mod normals;
mod output;
mod picture;
mod remesh;
mod render;
mod report;
mod selection;
mod solver;
mod surface;
mod text;

use std::io::Write;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

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
    Generate(generate::GenerateArgs),
    /// Makes a picture of one or more meshes
    Render(render::RenderArgs),
    /// Lists the boundary loops of a mesh file
    Holes(holes::HolesArgs),
    /// Fills the holes of a mesh file: triangulates, refines and fairs them
    #[command(after_help = help::FILL)]
    Fill(fill::FillArgs),
    /// Makes the paper's blend of three cylinders: the start, the result and a picture of both
    Demo(demo::DemoArgs),
}

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Fair(args) => fair::run(&args),
        Command::Generate(args) => generate::run(&args),
        Command::Render(args) => render::run(&args),
        Command::Holes(args) => holes::run(&args),
        Command::Fill(args) => fill::run(&args),
        Command::Demo(args) => demo::run(&args),
    };
    match result {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(3),
        Err(failure) => {
            let _ = writeln!(std::io::stderr(), "fairmesh: {failure}");
            ExitCode::from(2)
        }
    }
}

/// Writes to stdout; a closed pipe is not our failure.
fn say(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}
