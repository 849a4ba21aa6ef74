//! The house rules that a compiler does not check: who imports whom, where `unsafe` may stand, that the library is
//! silent, how long a file may be, and that the declared Rust version is true.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Lines of a file in src/, its unit tests not counted.
const LONGEST_FILE: usize = 500;

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

fn read(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap_or_else(|why| panic!("{name}: {why}"))
}

/// A source file: its name from the root on, and its text without comments, strings and unit tests.
struct Source {
    name: String,
    code: String,
}

/// All files of src/ that are not unit tests themselves, by name.
fn sources() -> Vec<Source> {
    let mut sources = Vec::new();
    let mut open = vec![root().join("src")];
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.extension().is_some_and(|e| e == "rs")
            && path.file_name().is_some_and(|n| n != "tests.rs")
        {
            let name = path.strip_prefix(root()).unwrap().components();
            let name = name
                .map(|c| c.as_os_str().to_str().unwrap())
                .collect::<Vec<_>>()
                .join("/");
            let code = without_tests(&blanked(&fs::read_to_string(&path).unwrap()));
            sources.push(Source { name, code });
        }
    }
    sources.sort_by(|a, b| a.name.cmp(&b.name));
    assert!(sources.len() > 20);
    sources
}

/// Everything before the unit tests, which stand last in a file.
fn without_tests(code: &str) -> String {
    let lines: Vec<&str> = code.lines().collect();
    let tests = lines.windows(2).position(|w| {
        (w[0].trim() == "#[cfg(test)]" || w[0].trim().starts_with("#[cfg(all(test,"))
            && w[1].starts_with("mod tests {")
    });
    lines[..tests.unwrap_or(lines.len())].join("\n")
}

/// The text with comments, strings and characters replaced by blanks, line by line the same.
fn blanked(text: &str) -> String {
    let bytes = text.as_bytes();
    let mut out = bytes.to_vec();
    let mut at = 0;
    while at < bytes.len() {
        let rest = &bytes[at..];
        let in_word = at > 0 && is_word(bytes[at - 1]);
        let end = if rest.starts_with(b"//") {
            rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len())
        } else if rest.starts_with(b"/*") {
            block_comment(rest)
        } else if !in_word && (rest.starts_with(b"r\"") || rest.starts_with(b"r#") || rest.starts_with(b"br"))
        {
            raw_string(rest)
        } else if rest[0] == b'"' {
            quoted(rest, b'"')
        } else if rest[0] == b'\'' {
            character(rest)
        } else {
            0
        };
        for byte in &mut out[at..at + end] {
            if *byte != b'\n' {
                *byte = b' ';
            }
        }
        at += end.max(1);
    }
    String::from_utf8(out).unwrap()
}

fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

fn block_comment(text: &[u8]) -> usize {
    let (mut depth, mut at) = (0usize, 0);
    while at < text.len() {
        match &text[at..] {
            [b'/', b'*', ..] => (depth, at) = (depth + 1, at + 2),
            [b'*', b'/', ..] => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
        if depth == 0 {
            break;
        }
    }
    at
}

/// Length of a raw string at the start of `text`; 0 if there is none (`r` of a name, `r#name`).
fn raw_string(text: &[u8]) -> usize {
    let start = 1 + usize::from(text[0] == b'b');
    let hashes = text[start.min(text.len())..]
        .iter()
        .take_while(|&&b| b == b'#')
        .count();
    if text.get(start + hashes) != Some(&b'"') {
        return 0;
    }
    let close: Vec<u8> = std::iter::once(b'"')
        .chain(std::iter::repeat_n(b'#', hashes))
        .collect();
    let body = start + hashes + 1;
    let end = text[body..].windows(close.len()).position(|w| w == close);
    end.map_or(text.len(), |e| body + e + close.len())
}

fn quoted(text: &[u8], quote: u8) -> usize {
    let mut at = 1;
    while at < text.len() && text[at] != quote {
        at += 1 + usize::from(text[at] == b'\\');
    }
    (at + 1).min(text.len())
}

/// Length of a character literal; 0 for a lifetime.
fn character(text: &[u8]) -> usize {
    let next = std::str::from_utf8(&text[1..text.len().min(9)]);
    let first = match next {
        Ok(s) => s.chars().next(),
        Err(e) => std::str::from_utf8(&text[1..1 + e.valid_up_to()])
            .ok()
            .and_then(|s| s.chars().next()),
    };
    match first {
        Some('\\') => quoted(text, b'\''),
        Some(c) if text.get(1 + c.len_utf8()) == Some(&b'\'') => c.len_utf8() + 2,
        _ => 0,
    }
}

/// Line numbers (from 1) on which the word stands.
fn lines_with(code: &str, word: &str) -> Vec<usize> {
    let has = |line: &str| {
        line.match_indices(word).any(|(at, _)| {
            let before = line[..at].bytes().last().is_some_and(is_word);
            let after = line[at + word.len()..].bytes().next().is_some_and(is_word);
            !before && !after
        })
    };
    (1..)
        .zip(code.lines())
        .filter(|(_, line)| has(line))
        .map(|(n, _)| n)
        .collect()
}

/// The part of the house that a file belongs to, and the modules from the crate's root to it.
fn module(name: &str) -> (String, Vec<String>) {
    let inside = name.strip_prefix("src/").unwrap().strip_suffix(".rs").unwrap();
    let mut path: Vec<String> = inside.split('/').map(str::to_owned).collect();
    if path.last().is_some_and(|last| last == "mod" || last == "main") {
        path.pop();
    }
    let part = path[0].clone();
    if part == "bin" {
        path.drain(..2);
    } else if part == "lib" {
        path.clear();
    }
    (part, path)
}

/// Modules directly under the crate's root that the code names, with the line: `crate::a`, `crate::{a, b::c}`, and
/// `super::` where it leads there.
fn imports(code: &str, path: &[String]) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let starts = code.match_indices("crate::").map(|(at, s)| (at, at + s.len()));
    let supers = code
        .match_indices("super::")
        .filter(|(at, _)| !code[..*at].ends_with("super::"));
    let supers = supers.filter_map(|(at, _)| {
        let count = code[at..]
            .split("super::")
            .skip(1)
            .take_while(|s| s.is_empty())
            .count()
            + 1;
        (count >= path.len() && !path.is_empty()).then_some((at, at + count * "super::".len()))
    });
    for (at, end) in starts.chain(supers) {
        if code[..at].bytes().last().is_some_and(is_word) {
            continue;
        }
        let line = code[..at].matches('\n').count() + 1;
        found.extend(heads(&code[end..]).into_iter().map(|head| (line, head)));
    }
    found
}

/// First names of a path or of a group of paths.
fn heads(rest: &str) -> Vec<String> {
    let name = |s: &str| {
        s.trim_start()
            .chars()
            .take_while(|&c| c == '_' || c.is_alphanumeric())
            .collect::<String>()
    };
    let Some(group) = rest.strip_prefix('{') else {
        return vec![name(rest)];
    };
    let (mut depth, mut heads, mut from) = (0usize, Vec::new(), 0);
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                heads.push(name(&group[from..at]));
                from = at + 1;
                if c == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    heads.retain(|head| !head.is_empty());
    heads
}

/// The table of ARCHITECTURE.md: rows of `part` and the parts that it may import.
fn import_table() -> BTreeMap<String, BTreeSet<String>> {
    let text = read("ARCHITECTURE.md");
    let section = text
        .split("\n## ")
        .find(|s| s.starts_with("Who may import whom"))
        .expect("the import table");
    let rows = section.lines().filter(|line| line.starts_with("| `"));
    let table: BTreeMap<_, _> = rows
        .map(|row| {
            let cells: Vec<&str> = row.split('|').collect();
            let names = |cell: &str| {
                cell.split('`')
                    .skip(1)
                    .step_by(2)
                    .map(str::to_owned)
                    .collect::<Vec<_>>()
            };
            (
                names(cells[1]).remove(0),
                names(cells[2]).into_iter().collect::<BTreeSet<_>>(),
            )
        })
        .collect();
    assert!(table.len() >= 9, "{table:?}");
    table
}

#[test]
fn imports_run_one_way() {
    let table = import_table();
    let mut wrong = Vec::new();
    for source in sources() {
        let (part, path) = module(&source.name);
        if part == "lib" || part == "bin" {
            // `crate::` is the binary itself there; it sees the library as any other program does.
            continue;
        }
        let allowed = table
            .get(&part)
            .unwrap_or_else(|| panic!("{part} is not in the table of ARCHITECTURE.md"));
        for (line, import) in imports(&source.code, &path) {
            if import != part && !allowed.contains(&import) {
                wrong.push(format!("{}:{line}: {part} imports {import}", source.name));
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "against the table of ARCHITECTURE.md:\n{}",
        wrong.join("\n")
    );
}

#[test]
fn the_import_table_has_no_circle() {
    let mut table = import_table();
    while !table.is_empty() {
        let ready = |allowed: &BTreeSet<String>| allowed.iter().all(|part| !table.contains_key(part));
        let leaf = table
            .iter()
            .find(|(_, allowed)| ready(allowed))
            .map(|(part, _)| part.clone());
        table.remove(&leaf.unwrap_or_else(|| panic!("a circle among {:?}", table.keys())));
    }
}

#[test]
fn unsafe_code_stays_in_the_c_interface() {
    let mut wrong = Vec::new();
    for source in sources().iter().filter(|s| !s.name.starts_with("src/capi")) {
        wrong.extend(
            lines_with(&source.code, "unsafe")
                .iter()
                .map(|n| format!("{}:{n}", source.name)),
        );
    }
    assert!(wrong.is_empty(), "unsafe outside src/capi: {wrong:?}");
}

#[test]
fn the_library_prints_nothing_and_reads_no_environment() {
    const FORBIDDEN: [&str; 9] = [
        "print!",
        "println!",
        "eprint!",
        "eprintln!",
        "dbg!",
        "stdout()",
        "stderr()",
        "env::var",
        "env::var_os",
    ];
    let mut wrong = Vec::new();
    for source in sources().iter().filter(|s| !s.name.starts_with("src/bin")) {
        for word in FORBIDDEN {
            wrong.extend(
                lines_with(&source.code, word)
                    .iter()
                    .map(|n| format!("{}:{n}: {word}", source.name)),
            );
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn files_are_short() {
    let mut wrong = Vec::new();
    for source in sources() {
        let lines = source.code.lines().count();
        if lines > LONGEST_FILE {
            wrong.push(format!("{}: {lines} lines without tests", source.name));
        }
    }
    assert!(wrong.is_empty(), "longer than allowed:\n{}", wrong.join("\n"));
}

#[test]
fn the_scanner_knows_comments_strings_and_groups() {
    let code =
        blanked("a /* unsafe /* x */ */ b // unsafe\nlet s = \"un\\\"safe\"; r#\"unsafe\"#; 'x' '\\'' &'a c");
    assert_eq!(lines_with(&code, "unsafe"), [0usize; 0]);
    assert_eq!(code.lines().count(), 2);
    assert!(code.contains("&'a c") && code.contains(" b "));
    assert_eq!(lines_with("x\nunsafe {}\nunsafe_code", "unsafe"), [2]);
    let path = ["a".to_owned(), "b".to_owned()];
    let heads = |code| {
        imports(code, &path)
            .into_iter()
            .map(|(_, head)| head)
            .collect::<Vec<_>>()
    };
    assert_eq!(
        heads("use crate::{x::{y, z}, w};\nuse crate::v::t;"),
        ["x", "w", "v"]
    );
    assert_eq!(heads("use super::near;\nuse super::super::far::x;"), ["far"]);
    assert_eq!(
        module("src/solve/mod.rs"),
        ("solve".to_owned(), vec!["solve".to_owned()])
    );
}

/// A version as numbers, the missing ones 0.
#[cfg(feature = "cli")]
fn version(text: &str) -> [u64; 3] {
    let mut parts = text.split('.').map(|part| part.parse().unwrap());
    std::array::from_fn(|_| parts.next().unwrap_or(0))
}

/// What cargo knows of this package and everything that it depends on. Without network where possible.
#[cfg(feature = "cli")]
fn metadata() -> serde_json::Value {
    let mut said = String::new();
    for more in [&["--offline"][..], &[]] {
        let output = std::process::Command::new(env!("CARGO"))
            .args(["metadata", "--format-version", "1", "--locked"])
            .args(more)
            .current_dir(root())
            .output()
            .unwrap();
        if output.status.success() {
            return serde_json::from_slice(&output.stdout).unwrap();
        }
        said.push_str(&String::from_utf8_lossy(&output.stderr));
    }
    panic!("cargo metadata: {said}");
}

#[cfg(feature = "cli")]
#[test]
fn no_dependency_needs_a_newer_rust() {
    let metadata = metadata();
    let ours = version(env!("CARGO_PKG_RUST_VERSION"));
    let mut wrong = Vec::new();
    let packages = metadata["packages"].as_array().unwrap();
    for package in packages {
        let Some(needs) = package["rust_version"].as_str() else {
            continue;
        };
        if version(needs) > ours {
            wrong.push(format!(
                "{} {} needs Rust {needs}",
                package["name"], package["version"]
            ));
        }
    }
    assert!(packages.len() > 20);
    assert!(
        wrong.is_empty(),
        "newer than the declared Rust version:\n{}",
        wrong.join("\n")
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
                assert!(
                    !lines_with(&file, last).is_empty(),
                    "{name} is not where this row says: {row}"
                );
                checked += 1;
            }
        }
    }
    assert!(checked > 20);
}
