//! `src/bindings.rs` is what bindgen makes of `shim/shim.h`. To write it:
//! `OPENMESH_WRITE_BINDINGS=1 cargo build --release -p openmesh-sys --features regenerate`.

#[path = "../../../tests/common/command.rs"]
mod command;

use std::path::Path;
use std::process::Command;

/// The build with the feature `regenerate` compares them. Needs libclang.
#[test]
fn the_bindings_are_what_the_header_says() {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap();
    command::run(
        Command::new(env!("CARGO"))
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .args(["build", "--release", "--locked", "--features", "regenerate"])
            .env("CARGO_TARGET_DIR", target)
            .env_remove("OPENMESH_WRITE_BINDINGS"),
    );
}
