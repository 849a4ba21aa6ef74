//! The program `fairmesh`: files byte for byte, texts and exit codes.

mod commands;
mod common;
mod formats;
mod holes;
