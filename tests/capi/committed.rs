//! Files that are made of others and committed: this compares them, or writes them with `FAIRMESH_WRITE=1`.

use std::fs;
use std::path::{Path, PathBuf};

/// A file of the repository.
pub(crate) fn path(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file)
}

/// Fails if the file is not what it would be made anew.
pub(crate) fn check(file: &str, made: &str) {
    let mut committed = fs::read_to_string(path(file)).unwrap_or_default();
    // What is as it should be is not touched: another test may be reading it.
    if committed != made && std::env::var_os("FAIRMESH_WRITE").is_some() {
        fs::write(path(file), made).unwrap();
        committed = made.to_owned();
    }
    assert!(
        committed == made,
        "{file} is old: run FAIRMESH_WRITE=1 cargo test --release -p fairmesh-capi --test capi generated"
    );
}
