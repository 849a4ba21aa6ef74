//! The C interface: its header, and C and C++ programs against the installed libraries.
#![allow(clippy::print_stdout, reason = "what the programs say, for --nocapture")]

#[path = "../common/command.rs"]
#[allow(unreachable_pub, reason = "other packages include the file as well")]
mod command;
mod committed;
#[cfg(unix)]
mod guide;
mod header;
#[path = "../common/interface.rs"]
mod interface;
mod numbers;
#[cfg(unix)]
mod programs;
