//! The workflows call scripts of this repository, which are run here as well, and have no logic of their own.

use std::fs;
use std::path::Path;

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// What is no script of this repository: each is one plain command.
const COMMANDS: [&str; 8] = [
    "apt-get",
    "cargo",
    "git config --global --add safe.directory",
    "npm publish",
    "pip install",
    "pipx run",
    "python packaging/",
    "rustup toolchain install",
];

/// The lines of all workflows, with their places.
fn lines() -> Vec<(String, String)> {
    let mut lines = Vec::new();
    for entry in fs::read_dir(root().join(".github/workflows")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let text = fs::read_to_string(&path).unwrap();
        for (number, line) in (1..).zip(text.lines()) {
            lines.push((format!("{name}:{number}"), line.to_owned()));
        }
    }
    assert!(lines.len() > 100);
    lines
}

/// What stands behind a key.
fn value<'a>(line: &'a str, key: &str) -> Option<&'a str> {
    let line = line.trim_start().trim_start_matches("- ");
    line.strip_prefix(key)?.strip_prefix(':').map(str::trim)
}

/// Why a step's command is not allowed.
fn objection(command: &str) -> Option<String> {
    if command.starts_with(['|', '>']) {
        return Some("a step is one line".into());
    }
    for part in command.split(" && ") {
        let script = part.split(' ').next().unwrap();
        let named = part
            .split(' ')
            .find(|word| word.ends_with(".sh") || word.ends_with(".py"));
        if let Some(named) = named
            && !root().join(named).is_file()
        {
            return Some(format!("there is no {named}"));
        }
        if named != Some(script) && !COMMANDS.iter().any(|known| part.starts_with(known)) {
            return Some(format!("{script} is no script of this repository"));
        }
    }
    None
}

#[test]
fn steps_call_scripts_that_exist() {
    let mut seen = 0;
    for (place, line) in lines() {
        // Without a command it is a table, of what shell they have.
        if let Some(command) = value(&line, "run").filter(|command| !command.is_empty()) {
            seen += 1;
            assert_eq!(objection(command), None, "{place}: {command}");
        }
    }
    assert!(seen > 15);
    assert!(objection("packaging/nothing.sh").is_some());
    assert!(objection("|").is_some());
    assert!(objection("curl https://example.com").is_some());
    assert!(objection("cargo test && rm -r target").is_some());
}

/// A tag can be moved to another program, a commit cannot.
#[test]
fn actions_are_pinned_by_commit() {
    let mut seen = 0;
    for (place, line) in lines() {
        let Some(action) = value(&line, "uses") else {
            continue;
        };
        seen += 1;
        let (_, commit) = action
            .split_once('@')
            .unwrap_or_else(|| panic!("{place}: {action}"));
        let (commit, version) = commit
            .split_once(" # v")
            .unwrap_or_else(|| panic!("{place}: {action}"));
        assert!(
            commit.len() == 40 && commit.bytes().all(|c| c.is_ascii_hexdigit()),
            "{place}: {action}"
        );
        assert!(
            version.starts_with(|c: char| c.is_ascii_digit()),
            "{place}: {action}"
        );
    }
    assert!(seen > 5);
}
