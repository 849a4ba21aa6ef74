//! The C interface: its header, and C and C++ programs against the installed libraries.

#[path = "../common/command.rs"]
mod command;
mod committed;
mod header;
mod numbers;
#[cfg(unix)]
mod programs;
mod python;
mod tables;
