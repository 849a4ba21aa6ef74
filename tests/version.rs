//! `packaging/set_version.sh` knows every place that states the version.
//! The script needs GNU sed, so it is run on Linux only.
#![cfg(target_os = "linux")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Names and bytes of files, by their paths from the root on.
type Files = BTreeMap<PathBuf, Vec<u8>>;

/// What may state a version. The lock file has those of other packages, the changelog those of the past.
const KINDS: [&str; 14] = [
    "abi", "cff", "cmake", "cpp", "h", "hpp", "in", "lock", "md", "py", "rs", "sh", "toml", "ts",
];

fn files(root: &Path) -> Files {
    let mut files = Files::new();
    let mut open = vec![root.to_path_buf()];
    while let Some(path) = open.pop() {
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if path.is_dir() {
            if path == root || !(name.starts_with('.') || name == "target" || name == "__pycache__") {
                open.extend(fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
            }
        } else if name == "CMakeLists.txt"
            || path
                .extension()
                .is_some_and(|kind| KINDS.iter().any(|k| kind == *k))
        {
            let bytes = fs::read(&path).unwrap();
            files.insert(path.strip_prefix(root).unwrap().to_path_buf(), bytes);
        }
    }
    files
}

/// A copy of the project, without what states no version.
struct Copy(PathBuf);

impl Copy {
    fn new(test: &str) -> Self {
        let to = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
        let _ = fs::remove_dir_all(&to);
        for (name, bytes) in files(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))) {
            fs::create_dir_all(to.join(&name).parent().unwrap()).unwrap();
            fs::write(to.join(&name), bytes).unwrap();
        }
        Copy(to)
    }

    /// Runs the script, and returns its exit code.
    fn set(&self, words: &[&str]) -> i32 {
        let script = self.0.join("packaging/set_version.sh");
        let output = Command::new("bash").arg(script).args(words).output().unwrap();
        print_errors(&output.stderr);
        output.status.code().unwrap()
    }

    fn files(&self) -> Files {
        files(&self.0)
    }
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

#[test]
fn every_place_states_the_same_version() {
    let copy = Copy::new("version_as_it_is");
    let before = copy.files();
    assert_eq!(copy.set(&[env!("CARGO_PKG_VERSION")]), 0);
    assert_eq!(changed(&before, &copy.files()), Vec::<PathBuf>::new());
}

#[test]
fn another_version_is_set_everywhere_and_back() {
    const OTHER: &str = "7.89.10";
    let copy = Copy::new("version_other");
    let before = copy.files();
    assert_eq!(copy.set(&[OTHER]), 0);
    let after = copy.files();
    let mut left = Vec::new();
    for (name, bytes) in &after {
        // Of other packages; of the past; the script's own example.
        if ["Cargo.lock", "CHANGELOG.md", "packaging/set_version.sh"]
            .iter()
            .any(|skipped| name == Path::new(skipped))
        {
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

    assert_eq!(copy.set(&[OTHER]), 0);
    assert_eq!(
        changed(&after, &copy.files()),
        Vec::<PathBuf>::new(),
        "twice is once"
    );
    assert_eq!(copy.set(&[env!("CARGO_PKG_VERSION")]), 0);
    assert_eq!(changed(&before, &copy.files()), Vec::<PathBuf>::new(), "and back");
}

#[test]
fn what_is_no_version_is_refused() {
    let copy = Copy::new("version_wrong");
    let before = copy.files();
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
        assert_eq!(copy.set(&[wrong]), 2, "{wrong:?}");
    }
    assert_eq!(copy.set(&[]), 2);
    assert_eq!(copy.set(&["1.2.3", "1.2.4"]), 2);
    assert_eq!(changed(&before, &copy.files()), Vec::<PathBuf>::new());
}
