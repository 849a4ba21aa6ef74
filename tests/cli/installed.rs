//! What is installed beside the program: completions and manual pages; and what every command says of its end.

use std::fs;
use std::path::Path;

use crate::common::*;

/// All commands, as `fairmesh --help` lists them.
fn commands(directory: &Path) -> Vec<String> {
    let (out, _) = expect(directory, &["--help"], 0);
    let list = out.split("Commands:\n").nth(1).unwrap();
    let list = list.split("\n\n").next().unwrap();
    let names = list.lines().filter_map(|line| line.split_whitespace().next());
    let names: Vec<String> = names.filter(|name| *name != "help").map(str::to_owned).collect();
    assert!(names.len() >= 10, "{names:?}");
    names
}

#[test]
fn every_command_tells_its_exit_codes() {
    let directory = directory("exit_codes_told");
    for command in commands(&directory) {
        for flag in ["-h", "--help"] {
            let (out, _) = expect(&directory, &[&command, flag], 0);
            assert!(out.contains("Exit codes: 0 "), "{command} {flag}: {out}");
        }
    }
}

#[test]
fn completions_know_commands_flags_and_values() {
    let directory = directory("completions");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let (script, err) = expect(&directory, &["completions", shell], 0);
        assert_eq!(err, "");
        for command in commands(&directory) {
            assert!(script.contains(&command), "{shell}: {command}");
        }
        // These two have no list of a flag's values.
        let has_values = script.contains("conformal") || matches!(shell, "elvish" | "powershell");
        assert!(script.contains("inner-fairness") && has_values, "{shell}");
    }
    let (_, err) = expect(&directory, &["completions", "csh"], 2);
    assert!(err.contains("bash"), "{err}");
}

/// The scripts are taken by the shell that they are for.
#[cfg(unix)]
#[test]
fn bash_completes_a_flag() {
    let directory = directory("bash_completes");
    let (script, _) = expect(&directory, &["completions", "bash"], 0);
    fs::write(directory.join("fairmesh.bash"), script).unwrap();
    let program = ". ./fairmesh.bash; COMP_WORDS=(fairmesh fair --contin); COMP_CWORD=2; \
        _fairmesh fairmesh --contin fair; printf '%s\\n' \"${COMPREPLY[@]}\"";
    let run = std::process::Command::new("bash")
        .current_dir(&directory)
        .args(["--norc", "-c", program])
        .output();
    // A system without this shell has nothing to complete.
    let Ok(run) = run else { return };
    let said = String::from_utf8(run.stdout).unwrap();
    let lines: Vec<&str> = said.lines().collect();
    assert_eq!(
        lines,
        ["--continuity", "--continuity-at"],
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
}

#[test]
fn there_is_a_manual_page_for_every_command() {
    let directory = directory("manual");
    let (out, _) = expect(&directory, &["man", "new/man1"], 0);
    let mut names: Vec<String> = commands(&directory)
        .iter()
        .map(|name| format!("fairmesh-{name}.1"))
        .collect();
    names.push("fairmesh.1".to_owned());
    assert!(
        out.starts_with(&format!("{} pages in new/man1", names.len())),
        "{out}"
    );
    for name in &names {
        let page = fs::read_to_string(directory.join("new/man1").join(name)).unwrap();
        assert!(
            page.contains(".SH NAME") && page.contains(".SH OPTIONS"),
            "{name}"
        );
    }
    assert_eq!(
        fs::read_dir(directory.join("new/man1")).unwrap().count(),
        names.len()
    );
    let page = fs::read_to_string(directory.join("new/man1/fairmesh-fill.1")).unwrap();
    assert!(
        page.contains("Exit codes: 0 all holes asked for") && page.contains("trim\\-area"),
        "{page}"
    );
    fs::write(directory.join("file"), "").unwrap();
    let (_, err) = expect(&directory, &["man", "file"], 2);
    assert!(err.contains("file: cannot make this directory"), "{err}");
}
