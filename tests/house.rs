//! The house rules that neither the compiler nor clippy checks: the order of the library's modules, how long a file and a
//! function of tests may be, and that the documents speak of what is there.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Lines of a file in src/, its unit tests not counted.
const LONGEST_FILE: usize = 500;

/// Lines of a function of tests.
const LONGEST_TEST: usize = 60;

/// Folders of src/ that are crates of their own: what they import, their Cargo.toml says.
const CRATES: [&str; 5] = [
    "src/linear/",
    "src/shapes/",
    "src/capi/",
    "src/cli/",
    "src/declarations/",
];

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

fn read(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap_or_else(|why| panic!("{name}: {why}"))
}

/// What parts a file's code from its unit tests.
const UNIT_TESTS: &str = "\n\n#[cfg(test)]\nmod tests {";

/// The names of all files of a folder with this extension, from the root on.
fn files(folder: &str, extension: &str) -> Vec<String> {
    let mut files = Vec::new();
    let mut open = vec![root().join(folder)];
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.extension().is_some_and(|e| e == extension) {
            let name = path.strip_prefix(root()).unwrap().to_str().unwrap();
            files.push(name.replace('\\', "/"));
        }
    }
    files.sort_unstable();
    assert!(!files.is_empty(), "{folder} has no .{extension}");
    files
}

fn rust_files(folder: &str) -> Vec<String> {
    let files = files(folder, "rs");
    assert!(files.len() > 20, "{folder}: {files:?}");
    files
}

/// All source files without those of unit tests: the name from the root on, and the lines before `mod tests`.
fn sources() -> Vec<(String, Vec<String>)> {
    let files = rust_files("src").into_iter();
    files
        .filter(|name| !name.ends_with("tests.rs"))
        .map(|name| {
            let text = read(&name);
            let code = text.split(UNIT_TESTS).next().unwrap();
            let lines = code.lines().map(str::to_owned).collect();
            (name, lines)
        })
        .collect()
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

/// The crates whose files import each other one way. What gathers all of a crate (`lib.rs`) is imported by none of them.
const ORDERED: [&str; 6] = [
    "src",
    "src/capi",
    "src/cli",
    "src/declarations",
    "src/linear",
    "src/shapes",
];

/// The files of a crate by their module paths, with their code.
fn modules_of(krate: &str) -> BTreeMap<Vec<String>, (String, String)> {
    let is_other = |name: &str| {
        let mut others = CRATES.iter().filter(|other| other.trim_end_matches('/') != krate);
        others.any(|other| name.starts_with(other))
    };
    let inside = format!("{krate}/");
    let own = sources()
        .into_iter()
        .filter(|(name, _)| name.starts_with(&inside) && !is_other(name) && !name.ends_with("build.rs"));
    own.map(|(name, lines)| {
        let path = name[inside.len()..].trim_end_matches(".rs");
        let mut path: Vec<String> = path.split('/').map(str::to_owned).collect();
        if ["mod", "lib", "main"].contains(&path.last().unwrap().as_str()) {
            path.pop();
        }
        let code: Vec<&str> = lines
            .iter()
            .map(|line| line.split("//").next().unwrap())
            .collect();
        // What a macro names by `$crate` is for whoever calls it.
        (path, (name, code.join("\n").replace("$crate::", "")))
    })
    .collect()
}

/// The paths of a use tree that begins here, such as `a::{b, c::d}`: those with the words before them.
fn use_tree(code: &str, before: &[String], paths: &mut Vec<Vec<String>>) {
    let code = code.trim_start();
    let is_letter = |c: char| c == '_' || c.is_alphanumeric();
    if let Some(group) = code.strip_prefix('{') {
        let (mut depth, mut begin) = (0, 0);
        for (at, c) in group.char_indices() {
            match c {
                '{' => depth += 1,
                '}' if depth > 0 => depth -= 1,
                ',' | '}' if depth == 0 => {
                    use_tree(&group[begin..at], before, paths);
                    begin = at + 1;
                    if c == '}' {
                        return;
                    }
                }
                _ => {}
            }
        }
        return;
    }
    let end = code.find(|c| !is_letter(c)).unwrap_or(code.len());
    let path = [before, &[code[..end].to_owned()]].concat();
    match code[end..].strip_prefix("::") {
        Some(rest) => use_tree(rest, &path, paths),
        None => paths.push(path),
    }
}

/// The paths into its own crate that a file names: from the crate's root on.
fn named_paths(own: &[String], code: &str) -> Vec<Vec<String>> {
    let mut paths = Vec::new();
    for start in ["crate::", "super::", "self::", "\nuse "] {
        for (at, _) in code.match_indices(start) {
            // Not within a longer path, nor who may see something.
            if !code[..at].ends_with(':') && !code[..at].ends_with("(in ") {
                use_tree(code[at..].trim_start_matches("\nuse "), &[], &mut paths);
            }
        }
    }
    // A module below can be named without its way.
    for (at, _) in code.match_indices("mod ") {
        let name = code[at + 4..].split(';').next().unwrap();
        let call = format!("{name}::");
        let is_path =
            |at: usize| !code[..at].ends_with([':', '_']) && !code[..at].ends_with(char::is_alphanumeric);
        if name.chars().all(|c| c == '_' || c.is_alphanumeric())
            && code.match_indices(&call).any(|(at, _)| is_path(at))
        {
            paths.push(vec!["self".to_owned(), name.to_owned()]);
        }
    }
    let from_root = |path: Vec<String>| {
        let ups = path.iter().take_while(|word| *word == "super").count();
        match path[0].as_str() {
            "crate" => path[1..].to_vec(),
            "self" => [own, &path[1..]].concat(),
            // Of another crate or a module below.
            _ => [&own[..own.len().saturating_sub(ups)], &path[ups..]].concat(),
        }
    };
    paths.into_iter().map(from_root).collect()
}

/// A circle of imports, if there is one from this file on.
fn circle<'m>(
    file: &'m [String],
    imports: &BTreeMap<&'m [String], Vec<&'m [String]>>,
    way: &mut Vec<&'m [String]>,
    done: &mut BTreeSet<&'m [String]>,
) -> Option<Vec<&'m [String]>> {
    if let Some(begin) = way.iter().position(|other| *other == file) {
        return Some(way[begin..].to_vec());
    }
    if !done.insert(file) {
        return None;
    }
    way.push(file);
    let found = imports[file]
        .iter()
        .find_map(|next| circle(next, imports, way, done));
    way.pop();
    found
}

#[test]
fn files_import_in_no_circle() {
    for krate in ORDERED {
        let modules = modules_of(krate);
        let file_of = |path: &[String]| {
            let prefixes = (1..=path.len()).rev().map(|n| &path[..n]);
            let known = prefixes.filter_map(|prefix| modules.get_key_value(prefix));
            known.map(|(path, _)| path.as_slice()).next()
        };
        let imports: BTreeMap<&[String], Vec<&[String]>> = modules
            .iter()
            .map(|(own, (_, code))| {
                let named = named_paths(own, code);
                let files = named.iter().filter_map(|path| file_of(path));
                (
                    own.as_slice(),
                    files.filter(|file| *file != own.as_slice()).collect(),
                )
            })
            .collect();
        assert!(
            imports.values().map(Vec::len).sum::<usize>() > modules.len(),
            "{krate}"
        );
        let mut done = BTreeSet::new();
        for file in modules.keys() {
            if let Some(circle) = circle(file, &imports, &mut Vec::new(), &mut done) {
                let names: Vec<&str> = circle.iter().map(|path| modules[*path].0.as_str()).collect();
                panic!("a circle of imports: {}", names.join(" -> "));
            }
        }
    }
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

/// The functions of a text that rustfmt has laid out, with their lines.
fn functions(text: &str) -> Vec<(String, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut functions = Vec::new();
    for (begin, line) in lines.iter().enumerate() {
        let code = line.trim_start();
        let before = code.split("fn ").next().unwrap();
        let is_head = ["", "pub ", "pub(crate) ", "pub(super) ", "const "].contains(&before);
        if !is_head || before == code {
            continue;
        }
        let name = code[before.len() + 3..].split(['(', '<']).next().unwrap();
        let end = format!("{}}}", &line[..line.len() - code.len()]);
        // A body of one line closes where it begins.
        let length = match code.ends_with('}') {
            true => 1,
            false => 1 + lines[begin..].iter().position(|line| **line == end).unwrap(),
        };
        functions.push((name.to_owned(), length));
    }
    functions
}

/// The functions of a C file, with their lines: each begins and ends at the beginning of a line.
fn functions_of_c(text: &str) -> Vec<(String, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let heads = lines.iter().enumerate().filter(|(_, line)| {
        let is_indented = line.starts_with(char::is_whitespace);
        !is_indented && line.ends_with(") {")
    });
    let function = |(begin, head): (usize, &&str)| {
        let name = head.split('(').next().unwrap().rsplit([' ', '*']).next();
        let length = 1 + lines[begin..].iter().position(|line| *line == "}").unwrap();
        (name.unwrap().to_owned(), length)
    };
    heads.map(function).collect()
}

#[test]
fn functions_of_tests_are_short() {
    let unit_tests = rust_files("src").into_iter().filter_map(|name| {
        let text = read(&name);
        let tests = match name.ends_with("tests.rs") {
            true => &text,
            false => text.split_once(UNIT_TESTS)?.1,
        };
        Some((name, tests.to_owned()))
    });
    let tests = rust_files("tests").into_iter();
    let tests = tests.map(|name| (name.clone(), read(&name)));
    let tests = tests.chain(unit_tests);
    let tests = tests.map(|(name, text)| (name, functions(&text)));
    let in_c = files("tests/c", "c").into_iter();
    let in_c = in_c.map(|name| (name.clone(), functions_of_c(&read(&name))));
    let mut count = 0;
    let mut long = Vec::new();
    for (name, functions) in tests.chain(in_c) {
        count += functions.len();
        for (function, lines) in functions {
            if lines > LONGEST_TEST {
                long.push(format!("{name}: {function} has {lines}"));
            }
        }
    }
    assert!(count > 1000, "only {count} functions were found");
    assert!(
        long.is_empty(),
        "more than {LONGEST_TEST} lines:\n{}",
        long.join("\n")
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
