//! `fairmesh-declarations python FOLDER` writes `_abi.py` and `_enums.py`, `fairmesh-declarations web FOLDER` writes `abi.ts`.
#![allow(clippy::print_stderr, reason = "a program of a build tells what went wrong")]

use std::path::Path;
use std::process::ExitCode;

use fairmesh_declarations::{python, source, web};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (folder, files) = match words.as_slice() {
        ["python", folder] => (
            folder,
            vec![
                ("_abi.py", python::declarations(&source::items())),
                ("_enums.py", python::enumerations()),
            ],
        ),
        ["web", folder] => (folder, vec![("abi.ts", web::declarations(&source::items()))]),
        _ => return refuse("usage: fairmesh-declarations python|web FOLDER"),
    };
    for (name, text) in files {
        let path = Path::new(folder).join(name);
        // Tools look at the times of files.
        if std::fs::read_to_string(&path).is_ok_and(|old| old == text) {
            continue;
        }
        if let Err(why) = std::fs::write(&path, text) {
            return refuse(&format!("{}: {why}", path.display()));
        }
    }
    ExitCode::SUCCESS
}

fn refuse(why: &str) -> ExitCode {
    eprintln!("fairmesh-declarations: {why}");
    ExitCode::FAILURE
}
