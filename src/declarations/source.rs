//! The files of `src/capi` that are seen from outside, and what stands in them.

use std::path::{Path, PathBuf};

/// The names of these files, in the order of the header.
pub const SOURCES: [&str; 25] = [
    "numbers",
    "texts",
    "status",
    "types",
    "records",
    "hole_records",
    "callback",
    "loop_choice",
    "option_structs",
    "log",
    "about",
    "fair",
    "edits",
    "settings",
    "steps",
    "live",
    "fill",
    "estimate",
    "refill",
    "erase",
    "carry_over",
    "region",
    "bridge",
    "round",
    "reading",
];

/// The path of one of them.
pub fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../capi/{name}.rs"))
}

/// All items of all files.
///
/// # Panics
/// If a file cannot be read or is no Rust.
pub fn items() -> Vec<syn::Item> {
    let items = |name: &&str| {
        let text = std::fs::read_to_string(path(name)).expect("a file of src/capi");
        syn::parse_file(&text).expect("Rust").items
    };
    SOURCES.iter().flat_map(items).collect()
}
