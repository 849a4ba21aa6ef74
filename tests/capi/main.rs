//! The C interface: its header, and C and C++ programs against the installed libraries.

#[path = "../common/command.rs"]
mod command;
mod header;
#[cfg(unix)]
mod programs;
