//! `packaging/set_version.sh` knows every place that states the version.
//! The script needs GNU sed, so it is run on Linux only.
#![cfg(target_os = "linux")]

#[path = "common/copy.rs"]
mod copy;

use std::path::{Path, PathBuf};
use std::process::Command;

use copy::{Copy, Files, files};

/// Runs the script, and returns its exit code.
fn set(copy: &Copy, words: &[&str]) -> i32 {
    let script = copy.0.join("packaging/set_version.sh");
    let output = Command::new("bash").arg(script).args(words).output().unwrap();
    print_errors(&output.stderr);
    output.status.code().unwrap()
}

#[allow(clippy::print_stdout, reason = "for a test that fails")]
fn print_errors(bytes: &[u8]) {
    print!("{}", String::from_utf8_lossy(bytes));
}

/// The files that differ.
fn changed(before: &Files, after: &Files) -> Vec<PathBuf> {
    let differs = |name: &&PathBuf| before.get(*name) != after.get(*name);
    after.keys().filter(differs).cloned().collect()
}

/// Whether the line states exactly this version.
fn states(line: &str, version: &str) -> bool {
    line.match_indices(version).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        let mut after = line[at + version.len()..].chars();
        let longer = match after.next() {
            Some('.') => after.next().is_some_and(|c| c.is_ascii_digit()),
            next => next.is_some_and(|c| c.is_ascii_digit()),
        };
        !longer && !before.is_some_and(|c| c.is_ascii_digit() || c == '.')
    })
}

/// Of other packages; of the past; as it was measured, twice; the script's own example.
const STAYS: [&str; 5] = [
    "Cargo.lock",
    "CHANGELOG.md",
    "benchmark/results.json",
    "docs/benchmark.md",
    "packaging/set_version.sh",
];

#[test]
fn every_place_states_the_same_version() {
    let copy = Copy::new("version_as_it_is");
    let before = files(&copy.0);
    assert_eq!(set(&copy, &[env!("CARGO_PKG_VERSION")]), 0);
    assert_eq!(changed(&before, &files(&copy.0)), Vec::<PathBuf>::new());
}

#[test]
fn another_version_is_set_everywhere_and_back() {
    const OTHER: &str = "7.89.10";
    let copy = Copy::new("version_other");
    let before = files(&copy.0);
    assert_eq!(set(&copy, &[OTHER]), 0);
    let after = files(&copy.0);
    let mut left = Vec::new();
    for (name, bytes) in &after {
        if STAYS.iter().any(|stays| name == Path::new(stays)) {
            continue;
        }
        for line in String::from_utf8_lossy(bytes).lines() {
            if states(line, env!("CARGO_PKG_VERSION")) && !line.contains("such as") {
                left.push(format!("{}: {line}", name.display()));
            }
        }
    }
    assert_eq!(left, Vec::<String>::new());
    assert!(changed(&before, &after).len() >= 14);

    assert_eq!(set(&copy, &[OTHER]), 0);
    assert_eq!(
        changed(&after, &files(&copy.0)),
        Vec::<PathBuf>::new(),
        "twice is once"
    );
    assert_eq!(set(&copy, &[env!("CARGO_PKG_VERSION")]), 0);
    assert_eq!(
        changed(&before, &files(&copy.0)),
        Vec::<PathBuf>::new(),
        "and back"
    );
}

#[test]
fn what_is_no_version_is_refused() {
    let copy = Copy::new("version_wrong");
    let before = files(&copy.0);
    let wrong = [
        "",
        "1.2",
        "v1.2.3",
        "1.2.3-dirty",
        "1.2.3.4",
        "01.2.3",
        "1.2.3 ",
        "1.2.x",
    ];
    for wrong in wrong {
        assert_eq!(set(&copy, &[wrong]), 2, "{wrong:?}");
    }
    assert_eq!(set(&copy, &[]), 2);
    assert_eq!(set(&copy, &["1.2.3", "1.2.4"]), 2);
    assert_eq!(changed(&before, &files(&copy.0)), Vec::<PathBuf>::new());
}
