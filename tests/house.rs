//! The house rules that neither the compiler nor clippy checks: the order of the library's modules, how long a file may be,
//! and that the documents speak of what is there.

use std::fs;
use std::path::{Path, PathBuf};

/// Lines of a file in src/, its unit tests not counted.
const LONGEST_FILE: usize = 500;

/// Folders of src/ that are crates of their own: what they import, their Cargo.toml says.
const CRATES: [&str; 4] = ["src/linear/", "src/shapes/", "src/capi/", "src/cli/"];

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

fn read(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap_or_else(|why| panic!("{name}: {why}"))
}

/// All source files without those of unit tests: the name from the root on, and the lines before `mod tests`.
fn sources() -> Vec<(String, Vec<String>)> {
    let mut sources = Vec::new();
    let mut open = vec![root().join("src")];
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.extension().is_some_and(|e| e == "rs") && !path.ends_with("tests.rs") {
            let name = path.strip_prefix(root()).unwrap().to_str().unwrap();
            let text = read(name);
            let code = text.split("\n\n#[cfg(test)]\nmod tests {").next().unwrap();
            let lines = code.lines().map(str::to_owned).collect();
            sources.push((name.replace('\\', "/"), lines));
        }
    }
    assert!(sources.len() > 20);
    sources
}

/// A word in the text, not as a part of another one.
fn has_word(text: &str, word: &str) -> bool {
    let is_letter = |c: char| c == '_' || c.is_alphanumeric();
    text.match_indices(word)
        .any(|(at, _)| !text[..at].ends_with(is_letter) && !text[at + word.len()..].starts_with(is_letter))
}

/// The modules in the order of the numbered list in ARCHITECTURE.md.
fn module_order() -> Vec<String> {
    let text = read("ARCHITECTURE.md");
    let list = text.split("\n## ").find(|s| s.starts_with("Who may import whom"));
    let list = list.expect("the list of modules").lines();
    let modules: Vec<String> = list
        .filter_map(|line| line.split_once(". `")?.1.split('`').next())
        .map(str::to_owned)
        .collect();
    assert!(modules.len() > 5, "{modules:?}");
    modules
}

/// Imports of the library go down, and so in no circle.
#[test]
fn modules_import_those_before_them() {
    let order = module_order();
    let place = |module: &str| order.iter().position(|m| m == module);
    let mut wrong = Vec::new();
    for (name, lines) in sources() {
        let inside = name.strip_prefix("src/").unwrap();
        if inside == "lib.rs" || CRATES.iter().any(|c| name.starts_with(c)) {
            continue;
        }
        let own = inside.split(['/', '.']).next().unwrap();
        let own = place(own).unwrap_or_else(|| panic!("{own} is not in the list of ARCHITECTURE.md"));
        for (number, line) in (1..).zip(&lines) {
            // What a macro names by `$crate` is for whoever calls it.
            let code = line.split("//").next().unwrap().replace("$crate::", "");
            for import in code.split("crate::").skip(1) {
                let module = import
                    .split(|c: char| c != '_' && !c.is_alphanumeric())
                    .next()
                    .unwrap();
                // A group `crate::{...}` has no place either.
                if place(module).is_none_or(|place| place > own) {
                    wrong.push(format!("{name}:{number}: {line}"));
                }
            }
            if code.contains("super::super::") {
                wrong.push(format!("{name}:{number}: `crate::` says where it leads: {line}"));
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "against the order of ARCHITECTURE.md:\n{}",
        wrong.join("\n")
    );
}

#[test]
fn files_are_short() {
    let long = sources()
        .into_iter()
        .filter(|(_, lines)| lines.len() > LONGEST_FILE);
    let long: Vec<_> = long
        .map(|(name, lines)| format!("{name}: {}", lines.len()))
        .collect();
    assert!(
        long.is_empty(),
        "more than {LONGEST_FILE} lines without tests: {long:?}"
    );
}

#[test]
fn documents_agree_with_the_manifest() {
    let readme = read("README.md");
    let rust = env!("CARGO_PKG_RUST_VERSION");
    for (at, _) in readme.match_indices("Rust 1.") {
        assert!(
            readme[at..].starts_with(&format!("Rust {rust}")),
            "another Rust version in README.md: {rust}"
        );
    }
    assert!(readme.contains(&format!("Rust {rust}")));
    let [major, minor] = [env!("CARGO_PKG_VERSION_MAJOR"), env!("CARGO_PKG_VERSION_MINOR")];
    for (at, head) in readme.match_indices("fairmesh = \"") {
        let asked = readme[at + head.len()..].split('"').next().unwrap();
        assert_eq!(asked, format!("{major}.{minor}"), "version in README.md");
    }
    let version = env!("CARGO_PKG_VERSION");
    let changes = read("CHANGELOG.md");
    assert!(
        changes.contains("## [Unreleased]") || changes.contains(&format!("## [{version}]")),
        "{version}"
    );
}

#[test]
fn linked_files_exist() {
    for document in ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md"] {
        for link in read(document)
            .split("](")
            .skip(1)
            .filter_map(|rest| rest.split(')').next())
        {
            let file = link.split('#').next().unwrap();
            if !link.contains("://") && !file.is_empty() {
                assert!(
                    root().join(PathBuf::from(file)).exists(),
                    "{document} links to {link}"
                );
            }
        }
    }
}

/// Names that stand behind a file's name in a table row of ARCHITECTURE.md are defined or used in that file.
#[test]
fn the_map_of_equations_is_true() {
    let text = read("ARCHITECTURE.md");
    let mut checked = 0;
    for row in text
        .lines()
        .filter(|line| line.starts_with('|') && line.contains(".rs`"))
    {
        let mut file = String::new();
        for name in row.split('`').skip(1).step_by(2) {
            if let Some(path) = name.strip_suffix(".rs") {
                file = read(&format!("src/{}.rs", path.trim_start_matches("src/")));
            } else if !file.is_empty() {
                let last = name.rsplit("::").next().unwrap();
                assert!(has_word(&file, last), "{name} is not where this row says: {row}");
                checked += 1;
            }
        }
    }
    assert!(checked > 20);
}
