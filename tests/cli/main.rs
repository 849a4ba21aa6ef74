//! The program `fairmesh`: files byte for byte, texts and exit codes.
#![allow(unreachable_pub, reason = "nothing of a test is reachable from outside")]

mod answers;
mod batch;
mod bridge;
mod commands;
mod common;
#[cfg(target_os = "linux")]
mod endings;
mod erase;
mod files;
mod formats;
mod holes;
mod installed;
#[path = "../common/jargon.rs"]
mod jargon;
mod orientation;
mod pictures;
mod pipes;
mod references;
mod round;
mod select;
mod sharp;
#[path = "../common/tier.rs"]
mod tier;
mod words;
