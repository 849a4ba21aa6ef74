//! Copies of the project, for scripts that change it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Names and bytes of files, by their paths from the root on.
pub(crate) type Files = BTreeMap<PathBuf, Vec<u8>>;

/// What may state a version. The lock file has those of other packages, the changelog those of the past.
const KINDS: [&str; 14] = [
    "abi", "cff", "cmake", "cpp", "h", "hpp", "in", "lock", "md", "py", "rs", "sh", "toml", "ts",
];

pub(crate) fn files(root: &Path) -> Files {
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
pub(crate) struct Copy(pub(crate) PathBuf);

impl Copy {
    pub(crate) fn new(test: &str) -> Self {
        let to = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
        let _ = fs::remove_dir_all(&to);
        for (name, bytes) in files(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))) {
            fs::create_dir_all(to.join(&name).parent().unwrap()).unwrap();
            fs::write(to.join(&name), bytes).unwrap();
        }
        Copy(to)
    }
}
