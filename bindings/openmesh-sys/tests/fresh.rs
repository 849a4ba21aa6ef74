//! `src/bindings.rs` is what bindgen makes of `shim/shim.h`. To write it:
//! `OPENMESH_WRITE_BINDINGS=1 cargo test --release -p openmesh-sys --features regenerate --test fresh`.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn committed() -> PathBuf {
    root().join("src/bindings.rs")
}

#[cfg(feature = "regenerate")]
#[test]
fn the_bindings_are_what_the_header_says() {
    let made = include_str!(concat!(env!("OUT_DIR"), "/bindings.rs"));
    if std::env::var_os("OPENMESH_WRITE_BINDINGS").is_some() {
        fs::write(committed(), made).unwrap();
    }
    assert!(
        fs::read_to_string(committed()).unwrap_or_default() == made,
        "src/bindings.rs is old: see the head of tests/fresh.rs"
    );
}

/// Without libclang at least: the same functions in both.
#[test]
fn the_bindings_have_the_functions_of_the_header() {
    let names = |file: &Path, start: &str| -> BTreeSet<String> {
        let text = fs::read_to_string(file).unwrap();
        let code = text.lines().filter(|line| {
            line.contains(start) && !line.trim().starts_with("/*") && !line.trim().starts_with('*')
        });
        code.filter_map(|line| {
            let before = line.split('(').next()?;
            let name = before.rsplit([' ', '*']).next()?;
            name.starts_with("om_").then(|| name.to_owned())
        })
        .collect()
    };
    let header = names(&root().join("shim/shim.h"), "(");
    assert!(header.len() > 10, "{header:?}");
    assert_eq!(names(&committed(), "pub fn "), header);
}
