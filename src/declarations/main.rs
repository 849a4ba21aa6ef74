//! `fairmesh-declarations python FOLDER` writes `_abi.py`, `_enums.py`, `_records.py` and `_schema.py`, `web FOLDER` writes `abi.ts`, and `capi FOLDER` what `src/capi`
//! takes of the library's tables and schemas.
#![allow(clippy::print_stderr, reason = "a program of a build tells what went wrong")]

use std::path::Path;
use std::process::ExitCode;

use fairmesh_declarations::{numbers, options, python, python_options, python_records, source, web};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (folder, files) = match words.as_slice() {
        ["python", folder] => (
            folder,
            vec![
                ("_abi.py", python::declarations(&source::items())),
                ("_enums.py", python::enumerations()),
                ("_records.py", python_records::records(&source::items())),
                ("_schema.py", python_options::options()),
            ],
        ),
        ["web", folder] => (folder, vec![("abi.ts", web::declarations(&source::items()))]),
        ["capi", folder] => (
            folder,
            vec![
                ("numbers.rs", numbers::numbers()),
                ("texts.rs", numbers::texts()),
                ("option_structs.rs", options::structs()),
            ],
        ),
        _ => return refuse("usage: fairmesh-declarations capi|python|web FOLDER"),
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
