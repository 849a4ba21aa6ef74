//! `src/bindings.rs` is what bindgen makes of `shim/shim.h`. To write it:
//! `OPENMESH_WRITE_BINDINGS=1 cargo build --release -p openmesh-sys --features regenerate`.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn committed() -> PathBuf {
    root().join("src/bindings.rs")
}

/// The build with the feature `regenerate` compares them. Needs libclang.
#[test]
fn the_bindings_are_what_the_header_says() {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap();
    let output = Command::new(env!("CARGO"))
        .current_dir(root())
        .args([
            "build",
            "--release",
            "--locked",
            "-p",
            "openmesh-sys",
            "--features",
            "regenerate",
        ])
        .env("CARGO_TARGET_DIR", target)
        .env_remove("OPENMESH_WRITE_BINDINGS")
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

/// Without bindgen: the same functions in both.
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

/// The root package neither needs OpenMesh nor anything that needs it; where it is missing, the error names Debian's package.
#[test]
fn only_this_package_needs_openmesh() {
    let tree = Command::new(env!("CARGO"))
        .current_dir(root().join("../.."))
        .args(["tree", "--locked", "--prefix", "none", "-e", "normal,build,dev"])
        .output()
        .unwrap();
    let packages = String::from_utf8_lossy(&tree.stdout).into_owned();
    assert!(tree.status.success() && packages.starts_with("fairmesh "));
    for name in ["openmesh-sys", "bindgen", "pkg-config"] {
        assert!(
            !packages.lines().any(|l| l.starts_with(&format!("{name} "))),
            "{name}"
        );
    }
    let nowhere = Path::new(env!("CARGO_TARGET_TMPDIR")).join("openmesh-missing");
    let output = Command::new(env!("CARGO"))
        .current_dir(root())
        .args(["check", "--release", "--locked", "-p", "openmesh-sys"])
        .env("CARGO_TARGET_DIR", &nowhere)
        .env("PKG_CONFIG_LIBDIR", &nowhere)
        .env_remove("PKG_CONFIG_PATH")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        !output.status.success() && said.contains("libopenmesh-dev"),
        "{said}"
    );
}
